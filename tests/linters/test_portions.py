# SPDX-License-Identifier: Apache-2.0
"""Units in portions: each unit once, of one tool and group, none too large, priced by what is remembered."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

from haros_ci.linters.linter import Linter, Program, Unit
from haros_ci.linters.portions import LEAST, portions, unique
from haros_ci.linters.work import Work
from haros_ci.model.package import SourceFile


def work(tool: str, sizes: dict[str, int], *, cost: float = 10.0, groups: dict[str, str] | None = None, revision: str = "", **more: Any) -> Work:  # fmt: skip
    """The work of a tool on files of these sizes; the keys of all of them change with the *revision*."""
    linter = cast(Linter, SimpleNamespace(NAME=tool, COST=cost, **more))
    units = tuple(
        Unit(
            SourceFile(path=path, package=None, language="cpp", size=size, lines=1, digest=""),
            (groups or {}).get(path, ""),
        )
        for path, size in sizes.items()
    )
    keys = {path: f"{tool} {path} {revision}" for path in sizes}
    return Work(linter, Program((), "1"), "", units, keys=keys)


def paths(work: Work) -> set[str]:
    return set(work.keys.values())


def test_each_unit_is_in_one_portion() -> None:
    tools = [work("a", {f"{n}.cpp": n * 1000 for n in range(50)}), work("b", {f"{n}.cpp": 500 for n in range(20)})]
    found = portions([tools], {}, 3)
    keys = [key for portion in found for key in portion.keys]
    assert sorted(keys) == sorted(paths(tools[0]) | paths(tools[1]))
    assert {key.split()[0] for portion in found if portion.tool == "a" for key in portion.keys} == {"a"}


def test_what_both_sides_have_is_there_once() -> None:
    head, base = work("a", {"x": 1, "y": 1}), work("a", {"y": 1, "z": 1})
    assert [unit.file.path for _, unit in unique([[head], [base]])] == ["x", "y", "z"]
    changed = work("a", {"x": 1}, revision="old")
    assert len(list(unique([[head], [changed]]))) == 3


def test_a_portion_is_no_larger_than_its_part_of_a_share_or_one_unit() -> None:
    one = work("a", {f"{n:02d}": 1000 for n in range(64)} | {"large": 100_000})
    found = portions([[one]], {}, 4)
    largest = sum(portion.cost for portion in found) // (4 * 8)
    assert all(portion.cost <= largest or len(portion.keys) == 1 for portion in found)
    assert any(len(portion.keys) > 1 for portion in found)


def test_a_portion_is_no_longer_than_a_process_of_the_tool() -> None:
    one = work("a", {f"{n:02d}": 100_000 for n in range(64)}, cost=10.0, BATCH_SECONDS=2.0)
    assert max(portion.cost for portion in portions([[one]], {}, 1)) == 2_000_000


def test_groups_are_not_mixed() -> None:
    groups = {"a.cpp": "one", "b.cpp": "two", "c.cpp": "one"}
    found = portions([[work("a", dict.fromkeys(groups, 10), groups=groups)]], {}, 1, besides=10**9)
    assert sorted(portion.keys for portion in found) == [("a a.cpp ", "a c.cpp "), ("a b.cpp ",)]


def test_what_is_remembered_counts_and_what_is_not_is_reckoned_alike() -> None:
    one = work("a", {"known": 1000, "new": 3000}, cost=10.0)
    [[known], [new]] = [
        [p.cost for p in portions([[one]], {"a": {"known": 50_000}}, 1) if key in p.keys]
        for key in ("a known ", "a new ")
    ]
    assert (known, new) == (50_000, 150_000)  # an estimate would have been 10 000 and 30 000: a fifth


def test_what_is_remembered_of_other_tools_and_files_does_not_count() -> None:
    one = work("a", {"x": 1000}, cost=10.0)
    assert [p.cost for p in portions([[one]], {"b": {"x": 5}, "a": {"gone": 7}}, 1)] == [10_000]


def test_an_empty_file_is_not_free() -> None:
    assert [p.cost for p in portions([[work("a", {"x": 0})]], {}, 1)] == [LEAST]


def test_nothing_to_do_gives_no_portions() -> None:
    assert portions([[]], {}, 4) == []
    assert portions([[work("a", {})]], {"a": {"x": 1}}, 4) == []
