# SPDX-License-Identifier: Apache-2.0
"""A header of which cppcheck would see nothing through the files that include it is analysed by itself."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import MemoryStore, workspace

from haros_ci.linters import cppcheck
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.unseen_headers import Sight, sight, sights

GUARDED = "#ifndef PART_HPP\n#define PART_HPP\nint part();\n#endif\n"
ONCE = "#pragma once\nint part();\n"
INCLUDE = '#include "part.hpp"\n'

#: The text of part.hpp, and of a.cpp that includes it.
ALONE = {
    "its guard is defined": (GUARDED, f"#define PART_HPP\n{INCLUDE}"),
    "its guard is defined behind a comment": (GUARDED, f"#/**/define PART_HPP\n{INCLUDE}"),
    "its guard is defined over two lines": (GUARDED, f"#def\\\nine PART_HPP\n{INCLUDE}"),
    "its guard is defined by a digraph": (GUARDED, f"%:define PART_HPP\n{INCLUDE}"),
    "its guard is defined by another header": (GUARDED, f'#include "b.hpp"\n{INCLUDE}'),
    "a macro that it asks for": (f"#pragma once\n#ifndef QUIET\n{ONCE}#endif\n", f"#define QUIET 1\n{INCLUDE}"),
    "a macro in a condition": ("#pragma once\n#if 1 && !defined(QUIET)\nint a;\n#endif\n", f"#define QUIET\n{INCLUDE}"),
    "a condition around": (ONCE, f"#ifdef NOISY\n{INCLUDE}#endif\n"),
    "a condition of a version": (ONCE, f"#if VERSION > 3\nint a;\n#else\n{INCLUDE}#endif\n"),
    "a condition in a header": (ONCE, '#include "c.hpp"\n'),
    "a condition behind a guard": (ONCE, f"#ifndef A\n#define A\n#ifdef B\n{INCLUDE}#endif\n#endif\n"),
    "the other way of a guard": (ONCE, f"#ifndef A\n#define A\n#else\n{INCLUDE}#endif\n"),
    "another way of a guard": (ONCE, f"#ifndef A\n#define A\n#elif B\n{INCLUDE}#endif\n"),
    "an end in a comment": (ONCE, f"#ifdef B\n/*\n#endif\n*/\n{INCLUDE}#endif\n"),
    "import": (ONCE, '#import "part.hpp"\n'),
    "an end in a raw text": (ONCE, f'#ifdef B\nconst char * a = R"(\n#endif\n)";\n{INCLUDE}#endif\n'),
    "an end in a raw text with a word": (ONCE, f'#ifdef B\nauto a = u8R"x(\n)"\n#endif\n)x";\n{INCLUDE}#endif\n'),
    "a raw text behind a comment of two lines": (ONCE, f'#ifdef B\n// why \\\n R"(\n{INCLUDE}#endif\n// )"\n'),
    "behind many macros": (GUARDED, "".join(f"#define M{n}\n" for n in range(3000)) + f"#define PART_HPP\n{INCLUDE}"),
    "a guard that ends early": (ONCE, f"#ifndef A\n#define A\n#endif\n#ifdef B\n{INCLUDE}#endif\n"),
}
THROUGH = {
    "plain": (GUARDED, INCLUDE),
    "once": (ONCE, INCLUDE),
    "in a guarded file": (ONCE, f"#ifndef A_CPP\n#define A_CPP\n{INCLUDE}#endif\n"),
    "behind a condition": (ONCE, f"#ifdef A\nint a;\n#endif\n{INCLUDE}"),
    "with and without a condition": (ONCE, f"#ifdef A\n{INCLUDE}#endif\n{INCLUDE}"),
    "another macro": (GUARDED, f"#define QUIET\n{INCLUDE}"),
    "a macro that the header has from another one": (
        '#pragma once\n#include "b.hpp"\n#ifdef PART_HPP\nint a;\n#endif\n',
        INCLUDE,
    ),
    "a macro of nobody": ("#pragma once\n#ifdef WINDOWS\nint a;\n#endif\n", INCLUDE),
    "a macro in a comment": (GUARDED, f"// #define PART_HPP\n{INCLUDE}"),
    "a macro that begins alike": (GUARDED, f"#define PART_HPP_TWO\n{INCLUDE}"),
    "a condition in a raw text": (ONCE, f'const char * a = R"(\n#ifdef B\n)";\n{INCLUDE}'),
    "in angle brackets, and in quotes": (ONCE, f"#include <part.hpp>\n{INCLUDE}"),
    "in angle brackets, in a directory that is looked in": (ONCE, "#include <part.hpp>\n"),
    "guards around everything": (GUARDED, f"#ifndef A\n#define A\n#ifdef B\n#endif\n{INCLUDE}#endif\n"),
    "a way of a condition that is over": (ONCE, f"#ifndef A\n#define A\n#ifdef B\n#else\n#endif\n{INCLUDE}#endif\n"),
    "imported and included": (ONCE, f'#import "part.hpp"\n{INCLUDE}'),
    "a macro of a file that does not include it": (GUARDED, f"{INCLUDE}int a;\n"),
}
MORE = {
    "b.hpp": "#define PART_HPP\n",
    "c.hpp": f"#ifdef NOISY\n{INCLUDE}#endif\n",
    "other.cpp": "#define PART_HPP\nint other;\n",
}


def analysed(place: Path, files: dict[str, str]) -> set[str]:
    space = workspace(place, {**MORE, **files})
    return {unit.file.path for unit in cppcheck.plan(space, LintOptions(), MemoryStore())}


@pytest.mark.parametrize("name", ALONE)
def test_it_is_analysed_by_itself(name: str, tmp_path: Path) -> None:
    header, source = ALONE[name]
    assert "part.hpp" in analysed(tmp_path, {"part.hpp": header, "a.cpp": source})


@pytest.mark.parametrize("name", THROUGH)
def test_it_is_analysed_through_what_includes_it(name: str, tmp_path: Path) -> None:
    header, source = THROUGH[name]
    assert "part.hpp" not in analysed(tmp_path, {"part.hpp": header, "a.cpp": source})


def test_a_name_in_angle_brackets_is_not_looked_for_beside_the_file(tmp_path: Path) -> None:
    files = {"a/b/use.cpp": "#include <beside.hpp>\n", "a/b/beside.hpp": ONCE}
    assert "a/b/beside.hpp" in analysed(tmp_path, files)


def test_a_name_in_quotes_is(tmp_path: Path) -> None:
    files = {"a/b/use.cpp": '#include "beside.hpp"\n', "a/b/beside.hpp": ONCE}
    assert "a/b/beside.hpp" not in analysed(tmp_path, files)


def test_one_file_that_shows_it_is_enough(tmp_path: Path) -> None:
    files = {"part.hpp": GUARDED, "a.cpp": f"#define PART_HPP\n{INCLUDE}", "d.cpp": INCLUDE}
    assert "part.hpp" not in analysed(tmp_path, files)


def test_what_a_file_has_is_kept_by_its_contents(tmp_path: Path) -> None:
    space, store = workspace(tmp_path, {"a.cpp": "#ifdef A\n#include <b.hpp>\n#endif\n#define C\n"}), MemoryStore()
    first = sights(space, space.files, store)
    assert first == {"a.cpp": Sight(("<b.hpp",), ("C",), ("A",))} == sights(space, space.files, store)


def test_hostile_text_takes_linear_time() -> None:
    for text in ("#if\n", "#/*", "#define A\n", "# /**/ ", "#endif\n", "/* */ "):
        sight(text * 20_000)
