# SPDX-License-Identifier: Apache-2.0
"""Short ways to lower a piece of C++."""

from __future__ import annotations

from typing import Any

from syntax_kit import read_cpp


def T(name: str, *arguments: Any, marks: str = "") -> tuple[Any, ...]:
    """A type."""
    return (name, arguments, marks)


def function(text: str, name: str) -> Any:
    """The first function called *name*."""
    return next(each for each in read_cpp(text).functions if each.name == name)


def body(statements: str) -> tuple[Any, ...]:
    """The lowered body of a function of *statements*, which start on line 2, column 1."""
    program = read_cpp(f"void f() {{\n{statements}\n}}\n")
    assert program.problems == ()
    found = program.functions[0].body
    assert found is not None
    return found


def value(expression: str) -> Any:
    """The lowered form of *expression*, which starts on line 2, column 5."""
    (statement,) = body(f"x = {expression};")
    assert statement[0] == "do"
    return statement[1][3]
