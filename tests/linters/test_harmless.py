# SPDX-License-Identifier: Apache-2.0
"""Findings that are so and change nothing are notes; those beside them keep their levels."""

from __future__ import annotations

import pytest

from haros_ci.linters.harmless import with_harmless
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

KEY = "Duplicate key 'rate' in dictionary."
TWICE = "Redeclared variable 'h' in assignment."
JOINED = "Implicit string concatenation found in list"
SURPLUS = "sprintf format string requires 1 parameter but 2 are given."
FLOAT = "%f in format string (no. 1) requires 'double' but the argument type is 'unsigned char'."


def level(tool: str, rule: str, message: str, text: str, *, is_given: bool = False) -> Level:
    """The level of a warning at the line of HERE, or at the first."""
    line = text[: max(text.find("HERE"), 0)].count("\n") + 1
    result = Result(tool, rule, Level.WARNING, message, Location("demo/a", line, 1))
    (weighed,) = with_harmless([result], lambda path: text, lambda result: is_given)
    return weighed.level


HARMLESS = [
    ("duplicate-key", KEY, "d = {'rate': 1, 'size': 2, 'rate': 1}\n"),
    ("duplicate-key", KEY, "d = {\n    'rate': Config('rate'),\n    'rate': Config('rate'),\n}\n"),
    ("duplicate-key", "Duplicate key 3 in dictionary.", "d = {3: [1, a], 3: [1, a]}\n"),
    ("redeclared-assigned-name", TWICE, "def f(i):\n    h, cs, h = find(i)  # HERE\n    return cs\n"),
    (
        "redeclared-assigned-name",
        TWICE,
        "def f(i):\n    h, cs, h = find(i)  # HERE\n    h = 1\n\n\ndef g(h):\n    return h\n",
    ),
    ("redeclared-assigned-name", TWICE, "h, a, h = find(1)\nprint(a)\n"),
    ("implicit-str-concat", JOINED, "a = ['the arm ' 'is here', 'and the other one']\n"),
    ("implicit-str-concat", JOINED, "a = ['the arm' ' is here']\n"),
    ("implicit-str-concat", JOINED, "a = [\n    'x',\n    ('one\\n' 'two '  'three'),  # HERE\n]\n"),
    ("implicit-str-concat", JOINED, "log('%s of ' \"%s\", a, b)\n"),
]
REST = [
    ("duplicate-key", KEY, "d = {'rate': 1, 'size': 1, 'rate': 2}\n"),
    ("duplicate-key", KEY, "d = {'rate': 1, 'rate': 1, 'rate': 2}\n"),
    ("duplicate-key", KEY, "d = {'rate': Config('rate'), 'rate': Config('size')}\n"),
    ("duplicate-key", KEY, "d = {'size': 1, 'size': 1}\n"),
    ("duplicate-key", KEY, "e = {'rate': 1, 'rate': 1}\n\nd = {'rate': 1, 'rate': 2}  # HERE\n"),
    ("duplicate-key", "Duplicate key 1 in dictionary.", "d = {1: 2, '1': 2}\n"),
    ("duplicate-key", KEY, "d = {\n"),
    ("redeclared-assigned-name", TWICE, "def f(i):\n    h, cs, h = find(i)  # HERE\n    return h\n"),
    ("redeclared-assigned-name", TWICE, "def f(i):\n    h, cs, h = find(i)  # HERE\n    return [c for c in cs if h]\n"),
    ("redeclared-assigned-name", TWICE, "h, a, h = find(1)\n\n\ndef f():\n    return h\n"),
    ("redeclared-assigned-name", "Redeclared", "h, a, h = find(1)\n"),
    ("implicit-str-concat", JOINED, "a = ['elbow' 'wrist']\n"),
    ("implicit-str-concat", JOINED, "a = ['the arm ' 'is here' 'and there']\n"),
    ("implicit-str-concat", JOINED, "a = ['the arm ' 'is here', 'elbow' 'wrist']\n"),
    ("implicit-str-concat", JOINED, "a = ['elbow',\n     'wrist']\n"),
    ("implicit-str-concat", JOINED, "b = ['the arm ' 'is here']\na = ['elbow' 'wrist']  # HERE\n"),
    ("implicit-str-concat", JOINED, "a = ['elbow' 'wrist'\n"),
    ("unused-import", KEY, "d = {'rate': 1, 'rate': 1}\n"),
]


@pytest.mark.parametrize(("rule", "message", "text"), HARMLESS)
def test_what_changes_nothing_is_a_note(rule: str, message: str, text: str) -> None:
    assert level("pylint", rule, message, text) is Level.NOTE
    assert level("pylint", rule, message, text, is_given=True) is Level.WARNING
    assert level("ruff", rule, message, text) is Level.WARNING


@pytest.mark.parametrize(("rule", "message", "text"), REST)
def test_what_changes_something_is_not(rule: str, message: str, text: str) -> None:
    assert level("pylint", rule, message, text) is Level.WARNING


@pytest.mark.parametrize(
    ("message", "line", "expected"),
    [
        (SURPLUS, 'sprintf(name, "cloud_%d.txt", i, NULL);', Level.NOTE),
        (SURPLUS, 'sprintf(name, "cloud, %d.txt", f(i, 2), nullptr);', Level.NOTE),
        (SURPLUS.replace("1 parameter but 2 are", "0 parameters but 1 is"), 'sprintf (name, "a", 0);', Level.NOTE),
        (
            SURPLUS.replace("1 parameter but 2", "1 parameter but 3"),
            'sprintf(name, "%d", i,\n  NULL, NULL);',
            Level.NOTE,
        ),
        (SURPLUS, 'sprintf(name, "cloud_%d.txt", NULL, i);', Level.WARNING),
        (SURPLUS, 'sprintf(name, "cloud_%d.txt", i, size);', Level.WARNING),
        (SURPLUS, 'sprintf(name, "cloud_%d.txt", i, 1);', Level.WARNING),
        (SURPLUS, 'printf("%d", i, NULL);', Level.WARNING),
        (SURPLUS, 'sprintf(name, "%d"', Level.WARNING),
        (SURPLUS.replace("1 parameter but 2", "2 parameters but 2"), 'sprintf(name, "%d", 0);', Level.WARNING),
        (
            SURPLUS.replace("1 parameter but 2 are", "2 parameters but only 1 is"),
            'sprintf(name, "%d%s", 0);',
            Level.WARNING,
        ),
        ("no message", 'sprintf(name, "%d", i, NULL);', Level.WARNING),
    ],
)
def test_arguments_that_are_nothing(message: str, line: str, expected: Level) -> None:
    assert level("cppcheck", "wrongPrintfScanfArgNum", message, line + "\n}\n") is expected


SHOW = "template <class T> void Matrix<T>::show() const\n{\n  for (int i = 0; i < size_; i++) {\n    CALL  // HERE\n  }\n}\n"


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ('printf("%f ", data_[i * size_ + 1]);', Level.NOTE),
        ('std::printf("%f %d", data_[i], i);', Level.NOTE),
        ('fprintf(stderr, "%f", data_[i]);', Level.NOTE),
        ('printf("%f ", i);', Level.WARNING),
        ('printf("%f ", size());', Level.WARNING),
        ('printf("%f ", int(data_[i]));', Level.WARNING),
        ('printf("%f ", sizeof(T));', Level.WARNING),
        ('printf("%f ");', Level.WARNING),
        ("show(data_[i]);", Level.WARNING),
    ],
)
def test_formats_in_templates(call: str, expected: Level) -> None:
    text = SHOW.replace("CALL", call)
    assert level("cppcheck", "invalidPrintfArgType_float", FLOAT, text) is expected
    plain = text.replace("template <class T> ", "").replace("Matrix<T>", "Matrix")
    assert level("cppcheck", "invalidPrintfArgType_float", FLOAT, plain) is Level.WARNING
