# SPDX-License-Identifier: Apache-2.0
"""Directives that lead out of the analysed tree are blanked; all others stay, to the byte."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.linters.inclusions import confined

THERE = {"src/a.h", "include/p/b.h", "src/deep/c.h"}.__contains__

LEADS_OUT = [
    '#include "/etc/passwd"',
    "#include </etc/passwd>",
    '  #  include\t"/etc/passwd"',
    '#include"/etc/passwd"',
    '#include "../../x"',
    '#include "a/../../../x"',
    '#include "../src/missing.h"',
    "#include <../src/a.h>",
    '#include "C:/x"',
    '#include "..\\\\..\\\\x"',
    "#include MACRO",
    "#include MACRO(x)",
    '#include "unclosed',
    "#include",
    '#import "/x"',
    '#include_next "/x"',
    '#embed "/x"',
    '%:include "/x"',
    '??=include "/x"',
    '#inc\\\nlude "/x"',
    '#include \\\n"/x"',
    '#include \\ \t\n"/x"',
    '#include ??/\n"/x"',
    '#include "../\\\n../x"',
    '#/* a */include/* b */"/x"',
    '#/*\n*/include "/x"',
    '// #include "/x"',
    'R"( #include "/x" )"',
    "int x;\f#\finclude\v</x>",
    '#pragma GCC dependency "/x"',
    '#pragma include_alias("a", "/x")',
    'import "/x";',
    "export import </x>;",
    '#if __has_include("/x")',
    "#if __has_include(MACRO)",
    '#if __has_embed("/x")',
    '#if __has_\\\ninclude("/x")',
    "#define H __has_include",
]
STAYS = [
    '#include "a.h"',
    "#include <vector>",
    "#include <p/b.h>",
    '#include "deep/c.h"',
    '#include "deep/../a.h"',
    '#include "../src/a.h"',
    '#include "../include/p/b.h"',
    '#include "./a.h"',
    '#import "a.h"',
    '#include "a.h" // the rest "/etc/x"',
    "#include /* why */ <vector> /* not */",
    "#inc\\\nlude <vector>",
    "#if __has_include(<optional>)",
    '#if __has_include("a.h") && X',
    "#ifdef __has_include",
    "#ifndef __has_include",
    "#if defined(__has_include) && defined __has_include_next",
    "#pragma once",
    "#pragma omp parallel for private(x)",
    '#pragma GCC diagnostic ignored "-Wx"',
    "#define INCLUDE(x) #x",
    "#define S(x) #x\nS(/etc/passwd)",
    'const char* a = "/etc/passwd";',
    "#warning /etc/passwd",
    "#if X\n#else\n#endif",
    "import std;",
    'f("see #12"); // #3',
    "int line = 3; // # line",
    "#define LINE(x) #x",
    "a ## 1",
    "#warning in line 3",
    "// an #error in a comment",
    'f("#error");',
    "int import = 1; f(import < 3);",
    'reimport("/x");',
    "// includes are in /etc",
    "int include = 3 / 2;",
    "",
]


@pytest.mark.parametrize("text", LEADS_OUT)
def test_it_goes(text: str) -> None:
    made = confined(f"int a;\n{text}\nint b;\n", "src", THERE)
    assert made != f"int a;\n{text}\nint b;\n"
    assert len(made) == len(text) + 15 and made.startswith("int a;\n") and made.endswith("\nint b;\n")
    assert [i for i, c in enumerate(made) if c == "\n"] == [
        i for i, c in enumerate(f"int a;\n{text}\nint b;\n") if c == "\n"
    ]
    plain = made.replace("\\\n", "")
    assert not any(word in plain for word in ("include", "import", "embed", "pragma"))


#: What has to go, behind what a compiler takes for something else, and what has to stay of it.
AROUND = [
    ("/*#include*/ CODE", "CODE"),
    ("/*#include*/#define CODE 1", "#define CODE 1"),
    ("/*\n#include */ #pragma CODE", "*/ #pragma CODE"),
    ("/*\n#include*/ CODE", "*/ CODE"),
    ('/*\n#include "/x*/ CODE "', "*/ CODE"),
    ("/*\n#/**/include\nCODE", "/**/"),
    ("/*\n#include /**/ CODE", "*/ CODE"),
    ('/*#pragma comment "a"*/ CODE', "*/ CODE"),
    ('/*\n#pragma comment "a"*/ CODE', "*/ CODE"),
    ('s = "#include"; CODE', '"; CODE'),
    ('s = "#include"/"; CODE', '"/"; CODE'),
    ('s = "*/#include"/"; CODE', '"/"; CODE'),
    ('s = R"(\n#include)"; CODE', ')"; CODE'),
    ('s = R"x(\n#include )x"; CODE', ')x"; CODE'),
    ('s = R"(\n#include "/x)"; CODE "', '"/x)"; CODE'),
    ('s = R"(\n#include </x)"; CODE >', '</x)"; CODE'),
    ('s = "__has_include("; CODE', '("; CODE'),
    ('s = "__has_include("/"; CODE', '("/"; CODE'),
    ('s = R"(\n#if __has_include(X)"; CODE', '(X)"; CODE'),
    ('s = ";import "/*"*/+"; CODE', '"/*"*/+"; CODE'),
    ("#include X\rCODE", "\rCODE"),
    ('#pragma comment "a"\rCODE', "\rCODE"),
    ('#include "/x\rCODE"', "\rCODE"),
]


@pytest.mark.parametrize(
    "text",
    [
        "// \\ #include",
        "#define A \\ #include",
        "/* */ // \\ \\ #line 3",
        "// ??/ #include",
        "// ??/ \\ #pragma include 'a'",
    ],
)
def test_the_next_line_does_not_become_a_part_of_it(text: str) -> None:
    """By a backslash behind which all is blank now."""
    made = confined(f"{text}\nCODE\n", "src", THERE)
    assert made.endswith("\nCODE\n") and len(made) == len(text) + 6
    assert not made.partition("\nCODE")[0].rstrip().endswith(("\\", "??/"))


@pytest.mark.parametrize("text", ["#include /**/\\\n a\nCODE", "// \\ #include \\\nCODE", "#inc\\\nlude X\nCODE"])
def test_a_line_that_went_on_goes_on(text: str) -> None:
    made = confined(f"{text}\n", "src", THERE)
    assert made != f"{text}\n" and made.count("\\\n") == text.count("\\\n") and made.endswith("CODE\n")


@pytest.mark.parametrize(("text", "left"), AROUND)
def test_code_around_it_stays(text: str, left: str) -> None:
    made = confined(f"{text}\nint b;\n", "src", THERE)
    assert made != f"{text}\nint b;\n" and left in made and made.endswith("\nint b;\n")


@pytest.mark.parametrize(
    "text",
    [
        '#line 1 "b.cpp"',
        "#error in this line",
        "#line 7",
        '  #  line\t7 "b.cpp"',
        '# 1 "/etc/passwd" 3',
        '\x01#\x02line 1 "b.cpp"',
        '#li\\\nne 1 "b.cpp"',
        '/* a */ # /* b */ line 1 "b.cpp"',
        '/*\n*/ #line 1 "b.cpp"',
        '\\\n#line 1 "b.cpp"',
        '\r#line 1 "b.cpp"',
        '%:line 1 "b.cpp"',
        "#line LINE",
        "#pragma once\n#line 1",
    ],
)
def test_nothing_leads_astray(text: str) -> None:
    for before in ("", "\xef\xbb\xbf", "int a;\n"):
        made = confined(f"{before}{text}\nint b;\n", "src", THERE)
        assert "line" not in made.replace("\\\n", "") and "# 1" not in made and made.endswith("\nint b;\n")


@pytest.mark.parametrize("rest", ["#if 0", "/**/ #if 0", "// #if 0", '#line 1 "x"', "%:if 0"])
@pytest.mark.parametrize("gone", ['#include "/x"', "#include X", '#pragma comment "a"', "#line 1", "# 1"])
def test_nothing_becomes_a_directive(gone: str, rest: str) -> None:
    """Behind a directive there is no other one; that it is gone makes none."""
    made = confined(f"{gone} {rest}\nint b;\n", "src", THERE)
    assert "#" not in made and "%:" not in made


@pytest.mark.parametrize("text", STAYS)
def test_it_stays(text: str) -> None:
    written = f"int a;\n{text}\nint b;\n"
    assert confined(written, "src", THERE) is written


PIECES = [
    "#",
    "%:",
    "include",
    "import",
    "__has_include",
    "embed",
    "pragma",
    "dependency",
    "line 1",
    ')"',
    '"/x"',
    "</x>",
    '"a.h"',
    "<v>",
]
BETWEEN = [" ", "\t", "\n", "\\\n", "\\ \n", "/*", "*/", "//", '"', "<", ">", "(", ")", "MACRO", "../", "\r\n", "??/\n"]


@given(st.lists(st.sampled_from(PIECES + BETWEEN), max_size=30).map("".join))
def test_nothing_is_moved_and_nothing_is_left(text: str) -> None:
    made = confined(text, "src", THERE)
    assert len(made) == len(text)
    assert all(a == b or (b in " 0" and a not in "\r\n") for a, b in zip(text, made, strict=True))
    assert confined(made, "src", THERE) is made, "what is left leads nowhere"


def test_hostile_texts_end() -> None:
    """Texts on which a search that goes back would take hours."""
    for piece in (
        "#",
        "#/*",
        "#\\\n",
        "__has_include(",
        'import "',
        "#include <",
        "#include \\\n",
        "#pragma \\\n",
        '#pragma include "/x" */ \\\n',
        "\\\n",
        "#line ",
        "#1",
        "/**/",
        "/*#include*/",
        '"#include"',
        "#include )",
    ):
        text = piece * (60_000 // len(piece))
        assert len(confined(text, "", THERE)) == len(text)
