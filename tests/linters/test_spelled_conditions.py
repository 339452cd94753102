# SPDX-License-Identifier: Apache-2.0
"""Directives and conditions in unusual forms are the usual ones in the copies that cppcheck gets; what has no usual form is named."""

from __future__ import annotations

import time

import pytest

from haros_ci.linters.compiler_macros import predefined
from haros_ci.linters.ros_macros import header
from haros_ci.linters.seen_otherwise import seen_otherwise
from haros_ci.linters.spelled_conditions import spelled

SPELLED = {
    "#if true": "#if 1   ",
    "#elif ! true && A": "#elif ! 1    && A",
    "#if A \\\n  || true": "#if A \\\n  || 1   ",
    "#if A \\ \n  || true": "#if A \\ \n  || 1   ",
    "#if 0b11 == 3": "#if 3    == 3",
    "#if 0B1'0 > A": "#if 2     > A",
    "#if A > 201'703L": "#if A > 201703L ",
    "#if 0x1'0 == 16": "#if 16    == 16",
    "#if 01'0u == 8": "#if 8u    == 8",
    "#if !!A": "#if   A",
    "#if ! !defined(A) && !!!B": "#if    defined(A) &&   !B",
    "%:if 1": "# if 1",
    "  %: ifdef A": "  #  ifdef A",
    "/* a\nb */ %:ifndef A": "/* a\nb */ # ifndef A",
    "%\\\n:endif": "#\\\n endif",
    "%:define A(x, y) x%:%:y": "# define A(x, y) x# # y",
    "#define A(x) %:x": "#define A(x) # x",
    "#define A \\\\\n": "#define A  \\\n",
    "#pragma once \\ \\ \n": "#pragma once   \\ \n",
    "#if 0\n\\\\ \n\n#endif\n#if 1": "#if 0\n \\ \n\n#endif\n#if 1",
    "// a \\\\\n": "// a  \\\n",
    "#if 1\n#endif \\\\\\\n\n#if A": "#if 1\n#endif   \\\n\n#if A",
    "#warning a \\\n  b's": "#warning   \\\n     ",
    "#ifdef linux": "#if 1       ",
    "#  ifndef unix": "#  if 0       ",
    "#elifdef linux": "#elif 1       ",
    "#if defined(linux) || defined __APPLE__": "#if 1              || defined __APPLE__",
    "%:if defined unix": "# if 1           ",
}
SAME = (
    *("#if 1", "#if A", "#if !A", "#ifdef A", "#if A != 0", "#if defined(A) && !defined(B)", "#if 'a' == 97", "#else"),
    *("#if trueish", "#if is_true", "#if A.true1", "bool a = true;", "int a = 1'000;", "int b = 0b11;", "a = !!b;"),
    *("#define A true", "#define A 1'000", "// #define B: if true", "#error it's true", '#include "true.hpp"'),
    *(
        "// a \\ b \\\n",
        'char a[] = "\\\\";\n',
        "#define A \\\n  \\\n",
        "#define A \\\\ b",
        "#define A(x) \\\n  x \\ \n  + 1",
    ),
    *(
        "#warning it's",
        "/*\n#warning a \\\n*/ int b;",
        "#if !!A == B",
        "#if !!A + 1",
        "#if 0x",
        "#if 1'",
        "#if 0b2",
        "#if ''",
        "#if u8'a' == 97",
    ),
    *(
        'printf("100%:");',
        'a = "%:if 1";',
        "a = b %: c;",
        '#define A "%:"',
        "int linux = 0;",
        "#include <linux/joystick.h>",
    ),
    *(
        "#define linux 1\n#ifdef linux",
        "#undef linux\n#if defined(linux)",
        "#ifdef linux_kernel",
        "#if defined(__linux__)",
    ),
)
NAMED = {
    "#if -1 > 0u": "numbers without a sign",
    "#if 0xFFU * A > B": "numbers without a sign",
    "#if - -1": "two signs",
    "#if ~-1 == 0": "two signs",
    "#if !!A == B": "two signs",
    "#if (1, 1)": "a comma",
    "#if A(1, B(2, 3)) , 1": "a comma",
    "#if __has_include(<vector>)\nint a;\n#endif": "what a compiler has",
    "#ifdef __has_cpp_attribute\n#define A\n#else\nint a;\n#endif": "what a compiler has",
    "#if defined(__has_builtin) && __has_builtin(__a)\nvoid f() {\n#endif": "what a compiler has",
    "int a;\n/\\\n/ /*\n": "whose beginning is written over two lines",
    "#if 0\n/* */ /\\\n* a */\n#endif": "whose beginning is written over two lines",
    "#warning a \\\n  b- /* c */": "#warning over several lines",
    "#define A # warning \\ \n b": "#warning or #error",
    "#define A(error) \\\n b(#error) \\\n + 1": "#warning or #error",
    '#if 0\n1\\\nR"(\n#endif\n)"': "a raw text",
    "/??/\n/ /*\n": "whose beginning is written over two lines",
}
QUIET = (
    *(
        "#if true",
        "#if !!A",
        "#if 0b1",
        "#if A > 0u",
        "#if A >= 201703L",
        "#if A == -1",
        "#if A - B > 2",
        "#if !A",
        "#if A != !B",
    ),
    *(
        "#if RCLCPP_VERSION_GTE(28, 0, 0)",
        "#if A(1, B(2, 3)) && C",
        "#if A > (1u << 4)",
        "#ifdef linux\nint a;\n#endif",
        "%:if 1",
    ),
    *("a = - -1;", "int a = -1 > 0u;", "f(1, 2);", "// #if -1 > 0u", "#define A - -1", "#define B (1, 1)"),
    "#if __has_include(<tf2/a.hpp>)\n#include <tf2/a.hpp>\n#else\n#include <tf2/a.h>\n#endif\nint a;",
    '#if __has_include("a.hpp")\nint a;\n#endif',
    "#ifdef __has_attribute\n#if __has_attribute(unused)\n#define UNUSED __attribute__((unused))\n#endif\n#endif",
    *(
        *(
            "#warning a \\\n b",
            "#define A(error) b(#error)",
            "#define A(error) \\\n  b(#error)",
            'a = b \\\nR"(c)";',
            'a = \\\n  R"(c)";',
        ),
        "//   /\\\n//  /  \\\n",
        "/*  /\\\n*/ int a;\n",
        "#define A a /\\\n  b\n",
        'a = "/\\\n/";\n',
        "a = '/'; // \\\n/ b",
    ),
    *("int a = b /\n/* c */ 2;\n", "// a\\\n/ b\n", "/* a */ // b\n"),
)


@pytest.mark.parametrize("text", SPELLED)
def test_they_are_spelled_in_the_usual_form(text: str) -> None:
    assert spelled(f"{text}\nint a;\n#endif\n") == f"{SPELLED[text]}\nint a;\n#endif\n"


@pytest.mark.parametrize("text", SAME)
def test_what_is_usual_stays(text: str) -> None:
    whole = f"{text}\nint a;\n#endif\n"
    assert spelled(whole) == whole


def test_all_of_it_keeps_its_length_and_what_is_spelled_stays() -> None:
    for text in (*SPELLED, *SAME, *NAMED, *QUIET):
        made = spelled(text)
        assert len(made) == len(text)
        assert made.count("\n") == text.count("\n")
        assert spelled(made) == made


@pytest.mark.parametrize("text", NAMED)
def test_what_has_no_usual_form_is_named(text: str) -> None:
    assert any(NAMED[text] in words for words in seen_otherwise(f"{text}\n"))


@pytest.mark.parametrize("text", QUIET)
def test_it_is_not_named(text: str) -> None:
    assert list(seen_otherwise(f"{text}\n")) == []


def test_hostile_text_takes_linear_time() -> None:
    begin = time.process_time()
    for part in (
        "#if \\\n",
        "%:",
        "#if !",
        "%\\\n",
        "#if 1'",
        "/\\\n",
        "#if a(",
        "#if true\\",
        "'",
        '#define A "%:',
        "0b1'",
        "/* ",
        '"\\\n',
    ):
        for text in (part * 3_000, f"/\\\n/ a\n{part * 3_000}"):
            spelled(text)
            list(seen_otherwise(text))
    assert time.process_time() - begin < 3


def test_names_of_compilers() -> None:
    """By which code asks for what there is; none stands for a type or a word, and none takes another one's place."""
    names = predefined()
    assert {"__cpp_lambdas", "__cpp_lib_optional", "__SSE2__", "__SIZEOF_INT128__", "_GNU_SOURCE"} <= names.keys()
    assert all(name.startswith("_") and value[:1].isdigit() for name, value in names.items())
    assert {"__cplusplus", "__OPTIMIZE__", "NDEBUG", "linux", "unix", "__ARM_NEON", "_WIN32"}.isdisjoint(names)
    assert "#define __cpp_concepts 202002L\n" in header(())
