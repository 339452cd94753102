# SPDX-License-Identifier: Apache-2.0
"""Ids are file names, parts of addresses and of HTML at once, whatever somebody calls a package or a configuration."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.haros_json.names import safe, unique

HARD = re.compile(r"""[<>&"'/\\?#%:*|;`$\x00-\x1f\x7f\ud800-\udfff]|^[.\- ]|[. ]$|  """)
NAMES = st.one_of(
    st.text(max_size=20),
    st.text(alphabet="aA_/.-<& ", max_size=6),
    st.text(min_size=200, max_size=400),
    st.sampled_from(
        ("..", ".", "", "/", "../x", "con", "NUL.json", "constructor", "__proto__", "ß", "ﬁ", "\ud800", "projects.json")
    ),
)


@pytest.mark.parametrize(
    "name",
    ["kobuki_node", "nav2_bringup", "random walker", "Kobuki Code Quality Analysis", "größe", "a.b-c+d", "minimal"],
)
def test_names_as_people_give_them_stay(name: str) -> None:
    assert safe(name) == name
    assert unique([(name, "")]) == {(name, ""): name}


@pytest.mark.parametrize(
    ("name", "id"),
    [
        ("base/launch/base.launch", "base_launch_base.launch"),
        ("../x", "_._x"),
        ("..", "__"),
        ("", "_"),
        ("-rf", "_rf"),
        ("a  \t b", "a b"),
        ("<b>", "_b_"),
        ("50%?#", "50___"),
        ("aux", "aux_"),
        ("Constructor", "Constructor_"),
        ("projects.json", "projects.json_"),
        ("name.", "name_"),
    ],
)
def test_others_are_changed(name: str, id: str) -> None:
    assert safe(name) == id


def test_names_that_become_one_get_a_digest_each() -> None:
    ids = unique([("a/b", ""), ("a_b", ""), ("c", "")])
    assert ids["c", ""] == "c"
    assert all(re.fullmatch(r"a_b-[0-9a-f]{8}", ids[name, ""]) for name in ("a/b", "a_b"))
    assert len(set(ids.values())) == 3


def test_a_name_that_looks_like_a_digest_takes_none_away() -> None:
    first = unique([("a/b", ""), ("a_b", "")])
    again = unique([("a/b", ""), ("a_b", ""), (first["a/b", ""], "")])
    assert len({id.casefold() for id in again.values()}) == 3


@given(st.lists(st.tuples(NAMES, st.sampled_from(("", "1", "2"))), max_size=12))
def test_every_id_is_safe_and_its_own(keys: list[tuple[str, str]]) -> None:
    ids = unique(keys)
    assert ids == unique(reversed(keys))
    assert len({id.casefold() for id in ids.values()}) == len(set(keys)) == len(ids)
    for id in ids.values():
        assert not HARD.search(id), id
        assert 0 < len(id.encode()) < 200
        assert id.lower() not in ("constructor", "__proto__", "tostring", "projects.json", "con", "nul.json")
