# SPDX-License-Identifier: Apache-2.0
"""Python functions measured: every construct by hand, and paths against a walk through all of them."""

from __future__ import annotations

import ast
import textwrap

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from haros_ci.measuring.facts import DEEPEST, MOST_PATHS, FunctionFacts
from haros_ci.measuring.python import read_python


def only(body: str) -> FunctionFacts:
    facts = read_python("def f():\n" + textwrap.indent(body, "    ") + "\n    pass\n")
    assert facts.problems == ()
    return facts.functions[0]


@pytest.mark.parametrize(
    ("body", "paths"),
    [
        ("pass", 1),
        ("a(); b()", 1),
        ("if a: b()", 2),
        ("if a: pass\nelif b: pass\nelse: pass", 3),
        ("if a: pass\nelif b: pass", 3),
        ("if a: pass\nif b: pass\nif c: pass", 8),
        ("if a and b or c: pass", 4),
        ("if a and b and c: pass", 4),
        ("while a: pass", 2),
        ("while a:\n  if b: pass\nelse:\n  if c: pass", 4),
        ("for a in b: pass", 2),
        ("for a in b:\n  if c: continue\nelse: d()", 3),
        ("with a as b: pass", 1),
        ("with a as b:\n  if c: pass", 2),
        ("try: a()\nexcept E: b()\nexcept (F, G): c()", 3),
        ("try: a()\nexcept E: b()\nelse:\n  if c: pass", 3),
        ("try: a()\nfinally: b()", 1),
        ("try:\n  if a: pass\nexcept E: pass\nfinally:\n  if b: pass", 6),
        ("match a:\n  case 1: pass\n  case 2: pass", 3),
        ("match a:\n  case 1: pass\n  case _: pass", 2),
        ("match a:\n  case 1 if b and c: pass\n  case x: pass", 3),
        ("x = a if b else c", 2),
        ("x = a if b else c if d else e", 4),
        ("return a and b", 1),
        ("return a and b and c", 2),
        ("x = [a for a in b]", 2),
        ("x = {a: c for a in b if a if c}", 4),
        ("x = any(a for b in c for a in b)", 3),
        ("x = lambda: a if b else c", 2),
        ("g(lambda: a if b else c); g(lambda: d if e else f)", 3),
        ("def g():\n  if a: pass\n  if b: pass", 1),
        ("class G:\n  def h(self):\n    if a: pass", 1),
        ("assert a, b", 1),
        ("raise E", 1),
        ("async def g(): pass", 1),
    ],
)
def test_paths(body: str, paths: int) -> None:
    assert only(body).paths == paths


@pytest.mark.parametrize(
    ("body", "nesting"),
    [
        ("pass", 0),
        ("x = [a for a in b if c]", 0),
        ("with a: pass", 0),
        ("if a: pass\nelif b: pass\nelif c: pass", 1),
        ("if a: pass\nelse:\n  if b: pass", 2),
        ("if a: pass\nelse:\n  if b: pass\n  c()", 2),
        ("for a in b:\n  while c:\n    if d: pass", 3),
        ("try:\n  if a: pass\nexcept E:\n  for b in c:\n    if d: pass\nfinally: pass", 3),
        ("match a:\n  case 1:\n    if b: pass", 2),
        ("def g():\n  if a:\n    if b: pass", 0),
    ],
)
def test_nesting(body: str, nesting: int) -> None:
    assert only(body).nesting == nesting


@pytest.mark.parametrize(
    ("body", "calls", "distinct"),
    [
        ("a(); b(); a()", 3, 2),
        ("x.append(1); y.append(2); append(3)", 3, 1),
        ("a(b(c()))", 3, 3),
        ("super().__init__()", 2, 2),
        ("x = [a(b) for b in c() if d(b)]", 3, 3),
        ("with open(a) as b: b.read()", 2, 2),
        ("g(lambda: h())", 2, 2),
        ("x[0](); x[1]()", 2, 2),
        ("@g()\ndef h(a=b()): c()", 2, 2),
        ("f'{a(b)}'", 1, 1),
        # quiet: no calls
        ("pass", 0, 0),
        ("def g(): h()", 0, 0),
        ("x = a + b[c] - d.e", 0, 0),
        ("'f()'", 0, 0),
    ],
)
def test_calls(body: str, calls: int, distinct: int) -> None:
    function = only(body)
    assert (function.calls, function.distinct) == (calls, distinct)


def test_functions_and_classes_are_named_by_what_they_stand_in() -> None:
    facts = read_python(
        "class A:\n"
        "    class B:\n"
        "        def c(self):\n"
        "            def d(): pass\n"
        "    if x:\n"
        "        def e(self): pass\n"
        "async def f():\n"
        "    class G:\n"
        "        def h(self): pass\n"
    )
    assert [(each.name, each.class_name, each.line, each.column) for each in facts.functions] == [
        ("A.B.c", "A.B", 3, 13),
        ("A.B.c.d", "", 4, 17),
        ("A.e", "A", 6, 13),
        ("f", "", 7, 11),
        ("f.G.h", "f.G", 9, 13),
    ]
    assert [each.name for each in facts.classes] == ["A", "A.B", "f.G"]


@pytest.mark.parametrize(
    ("body", "methods", "available"),
    [
        ("def f(self): pass\ndef g(self): pass", 2, 2),
        ("def __init__(self): pass\ndef _f(self): pass\ndef __g(self): pass", 3, 0),
        ("@property\ndef f(self): pass\n@f.setter\ndef f(self, value): pass", 1, 1),
        ("@staticmethod\ndef f(): pass\n@classmethod\ndef g(cls): pass", 2, 2),
        ("class B:\n  def f(self): pass", 0, 0),
        ("f = lambda self: 1\nx = 2", 0, 0),
    ],
)
def test_methods(body: str, methods: int, available: int) -> None:
    found = read_python("class A:\n" + textwrap.indent(body, "    ") + "\n").classes[0]
    assert (found.methods, found.available) == (methods, available)


def test_python_2_is_measured_where_it_differs_in_spelling_only() -> None:
    facts = read_python("def f():\n    print 'a'\n    if b:\n        c()\n")
    assert [(each.name, each.paths) for each in facts.functions] == [("f", 2)]


@pytest.mark.parametrize("text", ["def f(:\n", "\0", "(" * 5000, "x = " + "-" * 200_000 + "1\n"])
def test_a_broken_file_is_told_of(text: str) -> None:
    facts = read_python(text)
    assert facts.functions == ()
    assert facts.problems


def test_what_is_nested_too_deeply_is_told_of() -> None:
    deep = min(DEEPEST - 2, 96)
    rows = [f"{' ' * depth}if a:" for depth in range(1, deep)]
    assert read_python("\n".join(["def f():", *rows, " " * deep + "b()"])).functions[0].nesting == deep - 1


def test_paths_are_bounded() -> None:
    assert only("if a: pass\n" * 100).paths == MOST_PATHS


# -- paths of programs without operators in conditions are those of their flow graph, each loop gone round once or not


def programs(depth: int) -> st.SearchStrategy[str]:
    simple = st.just("a()")
    if depth == 0:
        return simple
    block = st.lists(programs(depth - 1), min_size=1, max_size=3).map("\n".join)

    def indented(text: str) -> str:
        return textwrap.indent(text, "  ")

    return st.one_of(
        simple,
        block.map(lambda b: f"if a:\n{indented(b)}"),
        st.tuples(block, block).map(lambda p: f"if a:\n{indented(p[0])}\nelse:\n{indented(p[1])}"),
        block.map(lambda b: f"while a:\n{indented(b)}"),
        st.tuples(block, block).map(lambda p: f"for a in b:\n{indented(p[0])}\nelse:\n{indented(p[1])}"),
        st.tuples(block, block).map(
            lambda p: f"match a:\n  case 1:\n{indented(indented(p[0]))}\n  case _:\n{indented(indented(p[1]))}"
        ),
    )


def walks(statements: list[ast.stmt]) -> list[tuple[str, ...]]:
    """Every way through *statements*, as the decisions taken."""
    ways: list[tuple[str, ...]] = [()]
    for statement in statements:
        if isinstance(statement, ast.If):
            options = [("yes", *way) for way in walks(statement.body)] + [
                ("no", *way) for way in walks(statement.orelse)
            ]
        elif isinstance(statement, (ast.While, ast.For)):
            options = [("in", *way) for way in walks(statement.body)] + [
                ("past", *way) for way in walks(statement.orelse)
            ]
        elif isinstance(statement, ast.Match):
            options = [(str(n), *way) for n, case in enumerate(statement.cases) for way in walks(case.body)]
        else:
            options = [()]
        ways = [(*way, *option) for way in ways for option in options]
    return ways


@settings(max_examples=25, deadline=None)
@given(st.lists(programs(2), min_size=1, max_size=2).map("\n".join))
def test_paths_are_the_walks_through_the_function(body: str) -> None:
    assert only(body).paths == len(walks(ast.parse(body).body))
