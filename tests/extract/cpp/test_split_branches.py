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


def _read(lines: str) -> str:
    return str(read_cpp(f"void f(int a) {{\n{lines}}}\n").functions[0].body)


#: How the call and the variable go on in a branch, and what they are with it.
FURTHER = (
    ("+ 2", "('op', '+', (('name', 'a'), ('num', 2)))"),
    ("+ 2 + 3", "('op', '+', (('op', '+', (('name', 'a'), ('num', 2))), ('num', 3)))"),
    ("&& b", "('op', '&&', (('name', 'a'), ('name', 'b')))"),
    ("? 2 : 3", "('if', ('name', 'a'), ('num', 2), ('num', 3))"),
)


@pytest.mark.parametrize(("branch", "value"), FURTHER)
def test_a_branch_that_goes_on_with_an_expression(branch: str, value: str) -> None:
    """What it adds is there under its condition only."""
    wanted = "('if', ('compiled', (({0}, 1, '#ifdef A'),)), {1}, ('name', 'a'))"
    body = _read(
        f"  g(\n    a\n#ifdef A\n    {branch}\n#endif\n  );\n  int x = a\n#ifdef A\n    {branch}\n#endif\n  ;\n"
    )
    assert wanted.format(4, value) in body
    assert wanted.format(9, value) in body
    assert "('pre'" not in body


@pytest.mark.parametrize("branch", ["+ 2", ".b()", "[0]"])
def test_a_branch_that_goes_on_with_an_else(branch: str) -> None:
    """What it is with the other branch is not known."""
    body = _read(f"  g(a\n#ifdef A\n    {branch}\n#else\n    .c()\n#endif\n  );\n")
    assert "('if', ('compiled', ((3, 1, '#ifdef A'),))" in body and "('?', 'a" in body


@pytest.mark.parametrize(("branch", "own"), [("* 2", "b"), (".c", "b"), ("[3]", "b"), (".c(4)", "b")])
def test_a_branch_that_goes_on_with_the_last_part(branch: str, own: str) -> None:
    body = _read(f"  g(a + {own}\n#ifdef A\n    {branch}\n#endif\n  );\n")
    assert body.startswith("(('do', ('call', ('name', 'g'), (('op', '+', (('name', 'a'), ('if', ('compiled'")
    assert "('name', 'b')))),), (), 2, 3)),)" in body.replace("('name', 'b'))))),", "('name', 'b')))),)")


def test_texts_and_arguments_in_a_branch() -> None:
    body = _read('  g("a"\n#ifdef A\n    "b"\n#endif\n  , 1\n#ifdef A\n    , true\n#endif\n  );\n')
    assert "('str', 'ab'), ('str', 'a'))" in body
    assert "('bool', True), ('?', 'true'))" in body


@pytest.mark.parametrize(
    "branch",
    ["++b;", "--b;", "*b = 1;", "&b;", "::g();", "[] {}();", "{ g(); }", "g(1); g(2);", "G(b)", "if (b) g(1);"],
)
def test_a_branch_of_statements(branch: str) -> None:
    body = _read(f"  int b = 1;\n#ifdef A\n  {branch}\n#endif\n  g(3);\n")
    assert body.count("#ifdef A") == 1
    assert body.endswith("('do', ('call', ('name', 'g'), (('num', 3),), (), 6, 3)))")


def test_a_text_that_an_else_ends() -> None:
    """``#ifdef A``, ``g(1)``, ``#else``, ``h(2)``, ``#endif``, ``;``: one of both is called."""
    body = _read("#ifdef A\n  g(1)\n#else\n  h(2)\n#endif\n  ;\n")
    assert body.startswith("(('do', ('if', ('compiled', ((2, 1, '#ifdef A'),)), ('call', ('name', 'g')")
    assert body.count("('name', 'h')") == 1


@pytest.mark.parametrize("head", ["if (a)", "if (a) {", "if (a && g(1))"])
def test_the_head_of_an_if_alone_in_a_branch(head: str) -> None:
    end = "#ifdef A\n  }\n#endif\n" if head.endswith("{") else ""
    body = _read(f"#ifdef A\n  {head}\n#endif\n  g(2);\n{end}")
    assert body.count("('name', 'g'), (('num', 2)") == 2, "with the condition, and without it"
    assert "'#else'" in body


def test_the_head_of_an_if_in_both_branches() -> None:
    body = _read("#ifdef A\n  if (a) {\n#else\n  if (!a) {\n#endif\n  g(2);\n  }\n")
    assert body.count("('name', 'g')") == 1


def test_a_condition_has_the_directives_in_it() -> None:
    body = _read("  if (a\n#ifdef A\n    && a > 2\n#endif\n  ) { g(1); }\n")
    assert "'a #ifdef A && a > 2 #endif'" in body
