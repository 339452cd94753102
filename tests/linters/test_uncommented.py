# SPDX-License-Identifier: Apache-2.0
"""Texts without the comments that silence tools: what these say is gone, and everything stays where it was."""

from __future__ import annotations

import pytest

from haros_ci.linters.uncommented import _may_silence, without_silencers

GONE = [
    ("c", "int a;  // NOLINT\n", "int a;  // xxxxxx\n"),
    ("c", "// cppcheck-suppress [a, b]\nint c;\n", "// xxxxxxxx-xxxxxxxx [x, x]\nint c;\n"),
    ("c", "/* cppcheck-suppress-begin a */ int c; // d\n", "/* xxxxxxxx-xxxxxxxx-xxxxx x */ int c; // d\n"),
    ("c", "// cppcheck-suppress-macro a\n#define M 1\n", "// xxxxxxxx-xxxxxxxx-xxxxx x\n#define M 1\n"),
    ("c", "// cppcheck-sup\\\npress a\nint b;\n", "// xxxxxxxx-xxx\\\nxxxxx x\nint b;\n"),
    ("c", "/* \\\n cppcheck-suppress a */\nint b;\n", "/* \\\n xxxxxxxx-xxxxxxxx x */\nint b;\n"),
    ("python", "a = 'b'  # noqa: F821\r\nc\r\n", "a = 'b'  # xxxx: xxxx\nc\n"),
    ("python", "# pylint: skip-file\na\n", "# xxxxxx: xxxx-xxxx\na\n"),
    ("python", "a = '# noqa'; b  # noqa\n", "a = '# noqa'; b  # xxxx\n"),
    ("python", "é = 1  # è noqa # noqa: F821\n", "é = 1  # è xxxx # xxxx: xxxx\n"),
]
STAYS = [
    ("c", "int a;  // no lint\n"),
    ("c", 'char a[] = "// NOLINT";\n'),
    ("c", "// TODO: say cppcheck why\n"),
    ("python", "a = '# noqa'\n"),
    ("python", "# haros: ignore[x] why\na\n"),
    ("python", '"""Say noqa.\n\n# noqa\n"""\n'),
    ("", "# noqa\n"),
]


@pytest.mark.parametrize(("kind", "text", "expected"), GONE)
def test_what_says_nothing_any_more(kind: str, text: str, expected: str) -> None:
    assert without_silencers(text, kind) == expected
    assert without_silencers(expected, kind) is expected


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        ("// cppcheck-suppress a\n", ["a"]),
        ("// cppcheck-suppress [a, b] why\n", ["a", "b"]),
        ("/* cppcheck-suppress [a,\n b] */\n", ["a", "b"]),
        ("// cppcheck-suppress [a, \\\n b]\n", ["a", "b"]),
        ("// cppcheck-suppress \\\n b\n", ["b"]),
        ("// cppcheck-suppress a\\\nb\n", ["ab"]),
        ("// cppcheck-suppress a; [why]\n", ["a"]),
        ("// NOLINT(a, b)\n", []),
    ],
)
def test_the_rules_that_are_meant(text: str, rules: list[str]) -> None:
    assert list(_may_silence("cppcheck", text, "c")) == rules


@pytest.mark.parametrize(("kind", "text"), STAYS)
def test_what_stays(kind: str, text: str) -> None:
    assert without_silencers(text, kind) is text
