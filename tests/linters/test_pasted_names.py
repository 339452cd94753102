# SPDX-License-Identifier: Apache-2.0
"""Names that are pasted of what a macro stands for that cppcheck does not have are named; names that are pasted as they stand are not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.macros_elsewhere import MacrosElsewhere
from haros_ci.linters.pasted_names import pasted

CAT = "#define CAT_(a, b) a##b\n#define CAT(a, b) CAT_(a, b)\n"
USE = "int & pick()\n{\n  return CAT(give_, EINTR);\n}\n"


def found(place: Path, files: dict[str, str]) -> list[str]:
    made = replace(workspace(place, files), names=frozenset(files))
    (file,) = (file for file in made.files if file.path == "a.cpp")
    return list(pasted(file, made, MacrosElsewhere(made)))


NAMED = {
    "a macro of the system": (f"{CAT}{USE}", "EINTR"),
    "one of the compiler": (f"{CAT}int a = CAT(give_, unix);\n", "unix"),
    "in a macro": (f"{CAT}#define GIVE CAT(give_, EINTR)\nint a = GIVE;\n", "EINTR"),
    "before it": (f"{CAT}int a = CAT(EINTR, _give);\n", "EINTR"),
    "through two macros": (f"{CAT}#define GIVE(x) CAT(give_, x)\nint a = GIVE(EINTR);\n", "EINTR"),
    "any arguments": ("#define P(...) a##__VA_ARGS__\n#define Q(...) P(__VA_ARGS__)\nint a = Q(EINTR);\n", "EINTR"),
    "a name of the system's": (f"{CAT}int a = CAT(give_, st_atime);\n", "st_atime"),
    "one of terminals": (f"#include <term.h>\n{CAT}int a = CAT(give_, key_down);\n", "key_down"),
    "a keyword of C's": (f"#include <stdbool.h>\n{CAT}int a = CAT(give_, bool);\n", "bool"),
    "a digraph": (f"{CAT.replace('##', '%:%:')}{USE}", "EINTR"),
    "over two lines": (f"{CAT.replace('a##b', chr(92) + chr(10) + ' a##b')}{USE}", "EINTR"),
    "a number of a line": (f"{CAT}#define give_7 1\nint a = CAT(give_,\n  __LINE__);\n", "__LINE__"),
}
QUIET = {
    "a number": f"{CAT}int a = CAT(give_, 4);\n",
    "a macro of the file": f"#define EINTR 4\n{CAT}{USE}",
    "as it stands": "#define MAKE(a) int a##_one()\nMAKE(EINTR);\n",
    "a text": f"#define TEXT_(a) #a\n#define TEXT(a) TEXT_(a)\n{CAT}const char * a = TEXT(EINTR);\n",
    "a parameter": f"{CAT}#define GIVE(x) CAT(give_, x)\nint a = GIVE(3);\n",
    "a number of a line in one line": f"{CAT}#define give_7 1\nint a = CAT(give_, __LINE__);\n",
    "a name of its own over two lines": f"{CAT}int CAT(give_,\n  __LINE__);\n",
    "an expression": f"{CAT}int a = CAT(give_, COUNT(1, 2));\n",
    "a comment": f"{CAT}// CAT(give_, EINTR)\n",
    "a class": "#define PTR(N) N##Ptr\n#define FORWARD(C) class C; typedef shared_ptr<C> PTR(C)\nFORWARD(Node);\n",
    "a function": "#define CALL(a) call(a)\nint b = CALL(EINTR);\n",
    "a variable's name": f"{CAT}int a = CAT(give_, base_dir);\n",
    "a keyword": f"{CAT}int a = CAT(give_, double);\n",
    "a longer one": "#define OPT(a) a##_ = get(#a)\n#define REQ(a) check(#a); OPT(a)\nvoid f() { REQ(map_frame_2); }\n",
    "nothing": USE,
}


@pytest.mark.parametrize("name", NAMED)
def test_named(tmp_path: Path, name: str) -> None:
    text, word = NAMED[name]
    assert [words.rpartition(" ")[2] for words in found(tmp_path, {"a.cpp": text})] == [word]


@pytest.mark.parametrize("name", QUIET)
def test_quiet(tmp_path: Path, name: str) -> None:
    assert found(tmp_path, {"a.cpp": QUIET[name]}) == []


def test_macros_of_headers(tmp_path: Path) -> None:
    files = {"cat.hpp": CAT, "more.hpp": '#include "cat.hpp"\n', "a.cpp": f'#include "more.hpp"\n{USE}'}
    assert len(found(tmp_path, files)) == 1
    assert found(tmp_path, files | {"more.hpp": f"{files['more.hpp']}#define EINTR 4\n"}) == []


def test_hostile_text_takes_linear_time(tmp_path: Path) -> None:
    for number, text in enumerate(
        ("CAT(" * 20_000, "CAT(a," * 20_000, "#define A(x) CAT(x, x)\n" * 3_000, "a##" * 30_000)
    ):
        found(tmp_path / str(number), {"a.cpp": CAT + text})
