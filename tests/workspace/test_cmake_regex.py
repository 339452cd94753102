# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.workspace.cmake_regex import find_all, replace, search


@pytest.mark.parametrize(
    ("pattern", "text", "expected"),
    [
        (r"([0-9]+)\.([0-9]+)", "v1.20", ("1.20", "1", "20")),
        ("a|bc", "xbc", ("bc",)),
        ("^b", "ab", ()),
        ("b$", "b\n", ()),
        ("a.c", "a\nc", ("a\nc",)),
        ("[^/]+$", "src/a.cpp", ("a.cpp",)),
        ("[]a]+", "x]a", ("]a",)),
        (r"[\.]", "a.b", (".",)),
        (r"[\d]", "d", ("d",)),
        ("a{2}", "a{2}", ("a{2}",)),
        (r"\d", "d1", ("d",)),
        ("(a)?b", "b", ("b", "")),
        (r"(x|y)z", "yz", ("yz", "y")),
    ],
)
def test_search(pattern: str, text: str, expected: tuple[str, ...]) -> None:
    assert search(pattern, text) == expected


@pytest.mark.parametrize(
    ("pattern", "text"),
    [
        ("(a+)+$", "aaaa"),
        ("(a|aa)*b", "aaaa"),
        ("((a*)b)*", "ab"),
        ("a*?", "a"),
        ("*a", "a"),
        ("(a", "a"),
        ("a)", "a"),
        ("[a", "a"),
        ("a\\", "a"),
        (".*.*.*.*.*x", "a" * 200),
        ("a" * 600, "a"),
    ],
)
def test_refused(pattern: str, text: str) -> None:
    assert search(pattern, text) is None


def test_replace_and_find_all() -> None:
    assert replace(r"(.*)/(.*)\.cpp", r"\2_\1\\", "src/a.cpp") == "a_src\\"
    assert replace("a", "", "banana") == "bnn"
    assert replace(".*", "x", "abc") == "x"
    assert replace("a*", "x", "baa") is None
    assert find_all("[0-9]+", "a1b22") == ["1", "22"]
    assert find_all("x*", "ab") is None
