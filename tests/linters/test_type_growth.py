# SPDX-License-Identifier: Apache-2.0
"""Types that double with every typedef: the file is named, and cppcheck is not asked about it."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import MemoryStore, workspace

from haros_ci.linters import cppcheck
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.type_growth import LARGE_TYPE, typedefs

STEPS = range(30)


def chain(form: str) -> str:
    return "typedef int T0;\n" + "".join(form.format(i, i + 1) for i in STEPS)


PAIRS = chain("typedef std::pair<T{0}, T{0}> T{1};\n")
LARGE = {
    "pairs": PAIRS,
    "last first": "\n".join(reversed(PAIRS.splitlines())),
    "pointers to functions": chain("typedef T{0} (*T{1})(T{0}, T{0});\n"),
    "functions": chain("typedef T{0} T{1}(T{0}, T{0});\n"),
    "members": chain("typedef T{0} (Own::*T{1})(T{0});\n"),
    "arrays": chain("typedef std::pair<T{0}, T{0}> T{1}[2];\n"),
    "templates in templates": chain("typedef W<std::pair<T{0}, T{0}>> T{1};\n"),
    "by a macro": chain("typedef TWICE(T{0}) T{1};\n"),
    "many at once": "typedef int T0;\n"
    + "".join(f"typedef P<{', '.join([f'T{i}'] * 60)}> T{i + 1};\n" for i in range(3)),
}
QUIET = {
    "nothing": "",
    "few steps": "typedef int T0;\n" + "".join(f"typedef std::pair<T{i}, T{i}> T{i + 1};\n" for i in range(6)),
    "a chain": chain("typedef T{0} T{1};\n") + chain("typedef std::shared_ptr<T{0}> T{1};\n"),
    "structs": chain("typedef struct {{ T{0} a; T{0} b; }} T{1};\n"),
    "aliases": chain("using T{1} = std::pair<T{0}, T{0}>;\n"),
    "of each other": "typedef std::pair<B, B> A;\ntypedef std::pair<A, A> B;\n" * 30,
    "of itself": "typedef Matrix<Matrix, Matrix> Matrix;\n" * 30,
    "of one name in many classes": "".join(f"struct S{i} {{ typedef std::pair<Base, Base> Base; }};\n" for i in STEPS),
    "many": "".join(f"typedef std::map<std::string, int> T{i};\n" for i in range(2_000)),
}


def declined(root: Path, files: dict[str, str]) -> dict[str, str]:
    space = workspace(root, files)
    return cppcheck.declined(space, list(cppcheck.plan(space, LintOptions(), MemoryStore())))


@pytest.mark.parametrize("name", LARGE)
def test_declined(tmp_path: Path, name: str) -> None:
    assert declined(tmp_path, {"a.cpp": LARGE[name]}) == {"a.cpp": LARGE_TYPE}


@pytest.mark.parametrize("name", QUIET)
def test_asked(tmp_path: Path, name: str) -> None:
    assert declined(tmp_path, {"a.cpp": QUIET[name]}) == {}


def test_only_what_has_them(tmp_path: Path) -> None:
    half = PAIRS.splitlines(keepends=True)
    files = {
        "a.hpp": "".join(half[:8]),
        "b.hpp": '#include "a.hpp"\n' + "".join(half[8:]),
        "c.cpp": '#include "a.hpp"\n',
    }
    files |= {"a.cpp": '#include "b.hpp"\n', "d.cpp": "int d;\n"}
    assert declined(tmp_path, files) == {"a.cpp": LARGE_TYPE}


def test_hostile_text_takes_linear_time() -> None:
    for text in ("typedef ", "typedef (*a", "typedef a b(", "typedef a[", "typedef a;", "typedef {;"):
        list(typedefs(text * 10_000))
