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
    "#error /etc/passwd",
    "#if X\n#else\n#endif",
    "import std;",
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
    assert '"/' not in made and "</" not in made and "../" not in made


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
        "\\\n",
    ):
        text = piece * (300_000 // len(piece))
        assert len(confined(text, "", THERE)) == len(text)
