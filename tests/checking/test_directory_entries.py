# SPDX-License-Identifier: Apache-2.0
"""What each directory holds, by the paths of all files."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from haros_ci.checking.entries import Entries, below, entries_of, paths_by_name

NAMES = frozenset({"README.md", "a/package.xml", "a/src/n.cpp", "a/src/deep/er/n.cpp", "b/n.cpp"})


def test_directories_and_files() -> None:
    found = entries_of(NAMES)
    assert found[""] == Entries(frozenset({"README.md", "a", "b"}), frozenset({"a", "b"}))
    assert found["a"] == Entries(frozenset({"package.xml", "src"}), frozenset({"src"}))
    assert found["a/src"] == Entries(frozenset({"n.cpp", "deep"}), frozenset({"deep"}))
    assert found["a/src/deep"] == Entries(frozenset({"er"}), frozenset({"er"}))
    assert found["b"] == Entries(frozenset({"n.cpp"}), frozenset())
    assert "a/src/n.cpp" not in found and "c" not in found


def test_nothing() -> None:
    assert entries_of(frozenset()) == {"": Entries()}
    assert paths_by_name(frozenset()) == {}


def test_paths_by_name() -> None:
    assert paths_by_name(NAMES)["n.cpp"] == ("a/src/deep/er/n.cpp", "a/src/n.cpp", "b/n.cpp")


PATHS = st.lists(st.text("ab", min_size=1, max_size=2), min_size=1, max_size=4).map("/".join)


@given(st.frozensets(PATHS, max_size=8))
def test_as_one_by_one(names: frozenset[str]) -> None:
    found = entries_of(names)
    for folder in {"", *found}:
        inside = [
            name[len(folder) + 1 if folder else 0 :]
            for name in names
            if name.startswith(f"{folder}/" if folder else "")
        ]
        assert found[folder].names == {name.partition("/")[0] for name in inside}
        assert found[folder].directories == {name.partition("/")[0] for name in inside if "/" in name}


def test_below_a_directory() -> None:
    assert below(NAMES, "a/src") == ("a/src/deep/er/n.cpp", "a/src/n.cpp")
    assert below(frozenset({"a", "a.b/c", "a/b", "a0/c", "aa/b"}), "a") == ("a/b",)
    assert below(NAMES, ".") == below(NAMES, "") == tuple(sorted(NAMES))
    assert below(NAMES, "c") == ()


@given(st.frozensets(PATHS, max_size=8), PATHS)
def test_below_as_one_by_one(names: frozenset[str], folder: str) -> None:
    assert list(below(names, folder)) == sorted(name for name in names if name.startswith(f"{folder}/"))
