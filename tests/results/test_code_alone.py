# SPDX-License-Identifier: Apache-2.0
"""What is left of a text where comments and texts are no evidence."""

from __future__ import annotations

import pytest

from haros_ci.results.code_alone import code_alone


@pytest.mark.parametrize(
    ("kind", "text", "left"),
    [
        ("python", "a = 1  # if a:\n", "a = 1         \n"),
        ("python", "b = 'from numpy import *'\n", "b = '                   '\n"),
        ("python", '"""Doc.\n\nfrom a import *\n"""\nc = 1\n', '"""    \n\n               \n"""\nc = 1\n'),
        ("python", "d = 'if d:", "d = '     "),
        ("c", "int a;  // auto a\n", "int a;           \n"),
        ("c", "/* using b =\n c */ int b;\n", "            \n      int b;\n"),
        ("c", 'puts("using a = b;");\n', 'puts("            ");\n'),
        ("c", 'auto a = R"(if (a)\n)"; int b;\n', 'auto a = R"       \n "; int b;\n'),
    ],
)
def test_what_is_no_code(kind: str, text: str, left: str) -> None:
    assert code_alone(text, kind) == left


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        ("python", "if __name__ == '__main__':\n    main()\n"),
        ("python", "row['x'], a[\"b\"], '', \"\", '''c'''\n"),
        ("python", "import os.path as path\n"),
        ("c", 'm.def("f", &f, "steps"_a = false);\n'),
        ("c", "char c = 'x'; int n = 1'000'000;\n"),
        ("c", "a = b / c / d;\n"),
        ("c", "#define FAIL throw 1\n"),
        ("yaml", "a: 'b c'  # d\n"),
        ("", "// all of it\n"),
    ],
)
def test_what_stays(kind: str, text: str) -> None:
    assert code_alone(text, kind) == text


def test_lines_and_columns_stay() -> None:
    text = "x = 1  # \u00e9 two\ny = '''a b\nc d'''; z = 2\n"
    left = code_alone(text, "python")
    assert len(left) == len(text) and left.count("\n") == text.count("\n") and left.index("z") == text.index("z")
