# SPDX-License-Identifier: Apache-2.0
"""Globs on workspace paths."""

from __future__ import annotations

import pytest

from haros_ci.model.globs import fault, matches


@pytest.mark.parametrize(
    ("glob", "path"),
    [
        ("a.py", "a.py"),
        ("a.py", "src/pkg/a.py"),
        ("*.py", "src/a.py"),
        ("third_party", "src/third_party/lib/a.c"),
        ("third_party/", "src/third_party/a.c"),
        ("src/pkg", "src/pkg/a.py"),
        ("src/*/a.py", "src/pkg/a.py"),
        ("src/*", "src/pkg/deep/a.py"),
        ("src/**", "src/pkg/a.py"),
        ("**/test/**", "test/a.py"),
        ("**/test/**", "x/y/test/z/a.py"),
        ("**", "a.py"),
        ("src/**/a.py", "src/a.py"),
        ("src/**/a.py", "src/x/y/a.py"),
        ("./a.py", "a.py"),
        ("/a.py", "a.py"),
        ("/src", "src/a.py"),
        ("a[^0-9].py", "ab.py"),
        ("a[0-9].py", "x/a1.py"),
        ("?.py", "a.py"),
        ("üb*", "src/über.py"),
    ],
)
def test_matches(glob: str, path: str) -> None:
    assert matches(glob, path)


@pytest.mark.parametrize(
    ("glob", "path"),
    [
        ("a.py", "a.pyc"),
        ("a.py", "aa.py"),
        ("A.py", "a.py"),
        ("*.py", "a.cpp"),
        ("pkg/a.py", "src/pkg/a.py"),
        ("src/*.py", "src/pkg/a.py"),
        ("src/?", "src/ab"),
        ("src/a*b", "src/a/b"),
        ("src/**", "src"),
        ("**/test/**", "test"),
        ("**/test/**", "src/tests/a.py"),
        ("src/**/a.py", "src/b.py"),
        ("src/**/a.py", "x/src/a.py"),
        ("./a.py", "src/a.py"),
        ("/a.py", "src/a.py"),
        ("a[^0-9].py", "a1.py"),
        ("a[0-9].py", "ab.py"),
        ("third_party", "src/my_third_party/a.c"),
        ("src/pkg/deep", "src/pkg"),
    ],
)
def test_stays_quiet(glob: str, path: str) -> None:
    assert not matches(glob, path)


def test_many_stars_end() -> None:
    assert not matches("/".join(["**", "*a*a*a*a*a*a*a*b"] * 20), "/".join(["a" * 200] * 40))


@pytest.mark.parametrize("glob", ["", "  ", "/", ".", "./", "../x", "/..", "a/../b", "a/..", "x" * 1001])
def test_fault(glob: str) -> None:
    assert fault(glob)


@pytest.mark.parametrize("glob", ["a", "*", "**", "a..b", "..a", "./a", "/a", "a/", ".hidden", "a b/c"])
def test_no_fault(glob: str) -> None:
    assert fault(glob) is None
