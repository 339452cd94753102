# SPDX-License-Identifier: Apache-2.0
"""Functions, methods, classes and variables of Python files: signatures, types, and which values are certain."""

from __future__ import annotations

from typing import Any

import pytest
from syntax_kit import read_python

from haros_ci.syntax import Class, Field, Function, Parameter

NO_TYPE = ("", (), "")
A, X = ("name", "a"), ("name", "x")


def call(name: str, *arguments: Any, line: int = 1, column: int = 1) -> Any:
    return ("call", ("name", name), arguments, (), line, column)


def test_a_function_s_signature() -> None:
    text = "@d(1)\ndef f(a, b: String = 'q', *r: int, k, m=None, **o) -> 'std_msgs.msg.Int8':\n  return a\n"
    assert read_python(text).functions[1] == Function(
        name="f",
        owner="",
        kind="function",
        parameters=(
            Parameter("a", NO_TYPE),
            Parameter("b", ("String", (), ""), ("str", "q")),
            Parameter("*r", ("int", (), "")),
            Parameter("k", NO_TYPE),
            Parameter("m", NO_TYPE, ("none",)),
            Parameter("**o", NO_TYPE),
        ),
        returns=("std_msgs.msg.Int8", (), ""),
        line=2,
        column=1,
        body=(("return", A),),
        body_line=2,
        body_column=1,
        decorators=(call("d", ("num", 1), column=2),),
    )


def test_a_bare_star_is_a_parameter() -> None:
    assert [p.name for p in read_python("def f(a, /, b, *, c): pass\n").functions[1].parameters] == ["a", "b", "*", "c"]


@pytest.mark.parametrize(
    ("annotation", "type_"),
    [
        ("a.B", ("a.B", (), "")),
        ("List[int]", ("List", (("int", (), ""),), "")),
        ("Dict[str, a.B]", ("Dict", (("str", (), ""), ("a.B", (), "")), "")),
        ("List['B']", ("List", (("B", (), ""),), "")),
        ("A | None", ("Union", (("A", (), ""), ("None", (), "")), "")),
        ("Callable[[A], None]", ("()", (("None", (), ""), ("A", (), "")), "")),
        ("Callable[..., A]", ("Callable", (NO_TYPE, ("A", (), "")), "")),
        ("Literal['a', 1]", ("Literal", (("str", "a"), ("num", 1)), "")),
        ("Annotated[A, 'x']", ("A", (), "")),
        ("'not a type'", NO_TYPE),
        ("f()", NO_TYPE),
        ("3", NO_TYPE),
    ],
)
def test_types(annotation: str, type_: Any) -> None:
    assert read_python(f"def f(a: {annotation}): pass\n").functions[1].parameters[0].type == type_


METHODS = """class A(B, m.C, metaclass=M):
    def __init__(me, n):
        me.n = n
        t(lambda x: me.cb(x), lambda me: me.cb)
        def inner(): return me
    def __del__(self): pass
    def __new__(cls): return cls
    @staticmethod
    def s(self, a): return self
    @classmethod
    def c(k, a): return k
    @property
    def p(self): return self._p
    @p.setter
    def p(self, v): pass
    def none(*a): return a
    class D:
        def e(self): return self
"""


def test_methods() -> None:
    functions = read_python(METHODS).functions[1:]
    this = ("return", ("this",))
    found = [(f.name, f.owner, f.kind, tuple(p.name for p in f.parameters), f.is_static) for f in functions]
    assert found == [
        ("A.__init__", "A", "constructor", ("n",), False),
        ("A.__init__.<lambda>", "", "lambda", ("x",), False),
        ("A.__init__.<lambda>", "", "lambda", ("me",), False),
        ("A.__init__.inner", "", "function", (), False),
        ("A.__del__", "A", "destructor", (), False),
        ("A.__new__", "A", "function", (), True),
        ("A.s", "A", "function", ("self", "a"), True),
        ("A.c", "A", "function", ("a",), True),
        ("A.p", "A", "function", (), False),
        ("A.p", "A", "function", ("v",), False),
        ("A.none", "A", "function", ("*a",), False),
        ("A.D.e", "A.D", "function", (), False),
    ]
    assert functions[0].body == (
        ("do", ("set", "=", ("field", ("this",), "n"), ("name", "n"))),
        ("do", call("t", ("lambda", 2), ("lambda", 3), line=4, column=9)),
        ("def", "inner", 4),
    )
    assert functions[1].body == (("return", ("call", ("field", ("this",), "cb"), (X,), (), 4, 21)),)
    assert functions[2].body == (("return", ("field", ("name", "me"), "cb")),)
    assert [functions[i].body for i in (3, 5, 7, 11)] == [(this,)] * 4
    assert functions[6].body == (("return", ("name", "self")),)
    assert functions[10].body == (("return", A),)
    assert functions[9].decorators == (("field", ("name", "p"), "setter"),)


def test_classes_and_their_fields() -> None:
    text = "@d\nclass A(B, m.C, f(), metaclass=M):\n  k = 1\n  j: int = 2\n  n: str\n  a, b = 3, 4\n"
    text += "  k2 = g()\n  if x:\n    o = 5\n  r = 1\n  r = 2\n  c, e = h()\n  class D: pass\n"
    program = read_python(text)

    def field(name: str, init: Any, line: int, column: int = 3, type_: Any = NO_TYPE) -> Field:
        return Field(name, type_, init, line, column, is_static=True)

    assert program.classes == (
        Class(
            "A",
            (("B", (), ""), ("m.C", (), ""), NO_TYPE),
            (
                field("k", ("=", ("num", 1)), 3),
                field("j", ("=", ("num", 2)), 4, type_=("int", (), "")),
                field("n", None, 5, type_=("str", (), "")),
                field("a", ("=", ("num", 3)), 6),
                field("b", ("=", ("num", 4)), 6, 6),
                field("k2", ("=", call("g", line=7, column=8)), 7),
                field("o", ("=", ("?", "o = 5")), 9, 5),
                field("r", ("=", ("?", "r = 1")), 10),
                field("c", ("=", ("?", "c, e = h()")), 12),
                field("e", ("=", ("?", "c, e = h()")), 12, 6),
            ),
            2,
            1,
            decorators=(("name", "d"),),
        ),
        Class("A.D", (), (), 13, 3),
    )


@pytest.mark.parametrize(
    "text",
    ["x = 1\n", "x = y = 1\n", "x, y = 1, 2\n", "with a:\n  x = 1\n", "x = 1\ndef f():\n  x = 2\n"],
)
def test_variables_that_have_one_value(text: str) -> None:
    assert read_python(text).variables[0].init == ("=", ("num", 1))


@pytest.mark.parametrize(
    "text",
    [
        "x = 1\nx = 2\n",
        "x = 1\nx += 2\n",
        "x = 1\nif a: x = 2\n",
        "if a: x = 1\n",
        "try: x = 1\nexcept E: pass\n",
        "for i in a: x = 1\n",
        "for x in a: pass\n",
        "x = 1\ndef f():\n  global x\n  x = 2\n",
        "x = 1\ndel x\n",
        "x = 1\nfrom a import x\n",
        "x = 1\ndef x(): pass\n",
        "x = 1\n(x := 2)\n",
        "x = 1\nwith a as x: pass\n",
        "x = 1\ntry: pass\nexcept E as x: pass\n",
        "x = 1\nmatch a:\n  case x: pass\n",
        "x, *y = 1, 2\n",
        "x, y = z\n",
    ],
)
def test_variables_that_have_no_single_value(text: str) -> None:
    (kind, (mark, _)) = read_python(text).variables[0].init
    assert (kind, mark) == ("=", "?")
