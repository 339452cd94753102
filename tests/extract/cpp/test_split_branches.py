# SPDX-License-Identifier: Apache-2.0
"""Conditionals that open one brace in each branch: the parser makes up a brace at the end of the file instead of failing."""

from __future__ import annotations

import re

import pytest
from syntax_kit import read_cpp


def test_a_brace_opened_in_each_branch() -> None:
    text = """namespace a {
void C::first(int x) {
#ifdef NEW
  if (x) {
#else
  if (!x) {
#endif
    f();
  }
}
void C::second() { g(); }
}
"""
    program = read_cpp(text)
    assert [f.name for f in program.functions] == ["a::C::first", "a::C::second"]
    assert program.functions[1].body == (("do", ("call", ("name", "g"), (), (), 11, 20)),)


def _called(head: str, rest: str = "") -> list[int]:
    """The numbers that ``g`` is called with where an ``else if`` stands under *head*; without it, the last else has a way of its own."""
    text = f"void f(int a) {{\n  if (a == 1) {{ g(1); }}\n{head}\n  else if (a == 2) {{ g(2); }}\n{rest}#endif\n  else {{ g(3); }}\n}}\n"
    return [
        int(found)
        for found in re.findall(r"\('call', \('name', 'g'\), \(\('num', (\d)", str(read_cpp(text).functions[0].body))
    ]


@pytest.mark.parametrize("head", ["#if 0", "#if false", "# if 0 "])
def test_an_else_that_is_never_compiled(head: str) -> None:
    assert _called(head) == [1, 3]
    assert _called(head, "#else\n  else if (a == 4) { g(4); }\n") == [1, 4, 3, 3]


@pytest.mark.parametrize("head", ["#if 1", "#ifdef A", "#if A"])
def test_an_else_that_may_be(head: str) -> None:
    assert _called(head) == [1, 2, 3, 3]
