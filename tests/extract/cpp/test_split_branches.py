# SPDX-License-Identifier: Apache-2.0
"""Conditionals that open one brace in each branch: the parser makes up a brace at the end of the file instead of failing."""

from __future__ import annotations

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
