# SPDX-License-Identifier: Apache-2.0
"""Shards that belong together are joined; whatever else is given is refused, and what is wrong is named."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from shard_values import HEADER, KEYS, RUN, SHARD

from haros_ci.shards.joining import OtherSettings, fits, join
from haros_ci.shards.shard import Failed, Had, RecordedAnswer, Shard, ShardError, WorkspaceRun

ONE = replace(SHARD, name="one")
TWO = Shard(
    replace(HEADER, number=2),
    (RecordedAnswer("cppcheck", "c.cpp", KEYS[3], 7, '{"rules":[],"gave_up":[]}'),),
    name="two",
)


def other(**members: Any) -> Shard:
    """The second shard with another header."""
    return replace(TWO, header=replace(TWO.header, **members))


def refused(*shards: Shard) -> str:
    with pytest.raises(ShardError) as caught:
        join(shards)
    assert caught.value.help
    return caught.value.message


def test_all_that_shards_say_is_joined() -> None:
    for shards in ((ONE, TWO), (TWO, ONE)):
        joined = join(shards)
        assert set(joined.answers) == {("cppcheck", KEYS[n]) for n in (0, 1, 3)}
        assert joined.answers["cppcheck", KEYS[1]] == {"rules": [], "gave_up": [["no", 3]]}
        assert joined.failures == {("cppcheck", KEYS[2]): (("cppcheck failed: x", ("b.cpp",)),)}
        assert joined.wholes == {("architecture", "head"): RUN}
        assert joined.costs == {
            "cppcheck": {'odd "name", [x].cpp': 1200, "c.cpp": 7},
            "": {"architecture": 5_000_000},
        }
        assert joined.versions("head") == {"cppcheck": "2.17", "pylint": None}
        assert joined.versions("base") == {}


def test_a_single_shard_is_a_whole() -> None:
    assert join([replace(SHARD, header=replace(HEADER, of=1))]).header.of == 1


def test_an_answer_that_is_no_json_is_none() -> None:
    broken = replace(TWO, answers=(replace(TWO.answers[0], value="{"),))
    assert join([ONE, broken]).answers.get(("cppcheck", KEYS[3])) is None


@pytest.mark.parametrize(
    ("shards", "words"),
    [
        ((), ("no shards",)),
        ((ONE,), ("missing", "2/2")),
        ((TWO,), ("missing", "1/2")),
        ((ONE, replace(ONE, name="again")), ("one", "again", "both shard 1/2")),
        ((ONE, TWO, replace(TWO, name="again")), ("two", "again", "both shard 2/2")),
        ((ONE, other(version="0.2.0")), ("one", "two", "haros-ci 0.1.0 and 0.2.0")),
        ((ONE, other(of=3)), ("into 2", "into 3")),
        ((ONE, other(workspace="x")), ("different files",)),
        ((ONE, other(base="c" * 40)), ("nothing", "c" * 40)),
        ((ONE, other(settings={"profile": "q", "select": "s"})), ("settings: profile",)),
        ((ONE, other(settings={"profile": "p"})), ("settings: select",)),
        ((ONE, other(tools=(replace(HEADER.tools[0], version="2.18"), HEADER.tools[1]))), ("cppcheck 2.17 and 2.18",)),
        ((ONE, other(tools=(HEADER.tools[0], replace(HEADER.tools[1], version="3")))), ("pylint (missing) and 3",)),
        ((ONE, other(tools=HEADER.tools[:1])), ("pylint (missing) and (not asked)",)),
        (
            (ONE, other(tools=(*HEADER.tools, Had("ruff", "head", "", "")))),
            ("ruff (not asked) and (of unknown version)",),
        ),
        ((ONE, other(plan="e" * 64)), ("divided the work differently",)),
        ((ONE, replace(TWO, answers=ONE.answers[:1])), ("two and one both answer for", "odd")),
        ((ONE, replace(TWO, wholes=(WorkspaceRun("architecture", "head", 1, RUN),))), ("two: a second architecture",)),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) and value and isinstance(value[0], str) else "",
)
def test_what_makes_no_whole_is_refused(shards: tuple[Shard, ...], words: tuple[str, ...]) -> None:
    message = refused(*shards)
    assert all(word in message for word in words), message


def test_many_missing_shards_are_not_all_named() -> None:
    message = refused(replace(ONE, header=replace(HEADER, of=200)))
    assert message.endswith("9/200 …")


def test_the_same_failure_in_two_shards_is_one() -> None:
    same = replace(TWO, answers=(), failures=(*SHARD.failures, Failed("cppcheck", "other", (), (KEYS[2],))))
    assert join([ONE, same]).failures["cppcheck", KEYS[2]] == (("cppcheck failed: x", ("b.cpp",)), ("other", ()))


HERE: dict[str, Any] = {"version": "0.1.0", "settings": HEADER.settings, "workspace": HEADER.workspace, "base": None}


def test_what_is_merged_where_it_was_made_fits() -> None:
    fits(join([ONE, TWO]), **HERE)


@pytest.mark.parametrize(
    ("here", "words"),
    [
        ({"version": "9"}, "haros-ci 0.1.0, and this is 9"),
        ({"workspace": "other"}, "other files"),
        ({"base": "c" * 40}, "compared with nothing, and here it would be commit cccccccccccc"),
    ],
)
def test_what_is_merged_elsewhere_does_not(here: dict[str, Any], words: str) -> None:
    with pytest.raises(ShardError, match=words):
        fits(join([ONE, TWO]), **HERE | here)


def test_other_options_are_a_matter_of_usage() -> None:
    with pytest.raises(OtherSettings) as caught:
        fits(join([ONE, TWO]), **HERE | {"settings": {"profile": "x", "ignore": "y", "select": "s"}})
    assert caught.value.names == ("ignore", "profile")
