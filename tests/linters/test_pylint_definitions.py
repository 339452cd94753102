# SPDX-License-Identifier: Apache-2.0
"""Classes whose names are given away, and functions that are there twice."""

from __future__ import annotations

import pytest

from haros_ci.linters.pylint_doubts import is_refuted

CLASS = "class stop:\n    def pub(self):\n        pass\n\n\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (CLASS + "stop = stop()\nstop.pub()\n", True),
        (CLASS + "if __name__ == '__main__':\n    stop = stop()\n    while a:\n        stop.pub()\n", True),
        (CLASS + "for stop in make():\n    stop.pub()\n", True),
        (CLASS + "stop.pub()\n", False),
        (CLASS + "other = stop()\nstop.pub()\n", False),
        (CLASS + "a.stop = stop()\nstop.pub()\n", False),
        (CLASS + "# stop = stop()\nstop.pub()\n", False),
        ("import stop\nstop = stop.make()\nstop.pub()\n", False),
        (CLASS + "stop = stop()\nother.pub()\n", False),
        (CLASS + "stop = 1\nstop.pub(\n", False),
    ],
)
def test_the_name_of_a_class_that_is_given_away(text: str, expected: bool) -> None:
    last = text.rstrip("\n").split("\n")
    column = len(last[-1]) - len(last[-1].lstrip())
    assert is_refuted("no-value-for-parameter", len(last), column, text) is expected


TWICE = "{}def done(message):\n    global is_done\n    is_done = True\n\n\nother = 1\n{}def done(message):\n    global is_done{}\n    is_done = True\n"


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        (TWICE.format("", "", ""), 7, True),
        (TWICE.format("", "", "  # a comment"), 7, True),
        (TWICE.format("@a\n", "@a\n", ""), 8, True),
        (TWICE.format("", "", ", b"), 7, False),
        (TWICE.format("@a\n", "", ""), 8, False),
        (TWICE.format("", "", ""), 1, False),
        (TWICE.format("", "", "").replace("(message)", "(m)", 1), 7, False),
        ("class A:\n    def a(self):\n        pass\n    def a(self):\n        pass\n", 4, True),
        ("class A:\n    def a(self):\n        pass\nclass B:\n    def a(self):\n        pass\n", 5, False),
        ("def a():\n    pass\ndef a():\n    return 1\n", 3, False),
    ],
)
def test_a_function_that_is_there_twice(text: str, line: int, expected: bool) -> None:
    assert is_refuted("function-redefined", line, 0, text) is expected
