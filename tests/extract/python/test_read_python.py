# SPDX-License-Identifier: Apache-2.0
"""Python 3 files in the little language: exact statements, expressions, types and places."""

from __future__ import annotations

from typing import Any

import pytest
from syntax_kit import read_python

from haros_ci.syntax import Alias, Function, Program

NO_TYPE = ("", (), "")


def body(text: str) -> tuple[Any, ...]:
    """The module's statements; the text has no problem."""
    program = read_python(text)
    assert program.problems == ()
    return program.functions[0].body or ()


def value(text: str) -> Any:
    """The expression that a one-line text consists of."""
    ((kind, found),) = body(text + "\n")
    assert kind == "do"
    return found


def inside(text: str) -> tuple[Any, ...]:
    """The statements of the first function but the module's."""
    return read_python(text).functions[1].body or ()


def call(name: str, *arguments: Any, line: int = 1, column: int = 1) -> Any:
    return ("call", ("name", name), arguments, (), line, column)


def managed(manager: Any, method: str, column: int) -> Any:
    return ("call", ("field", manager, method), (), (), 1, column)


def formatted(form: str, argument: Any) -> Any:
    return ("call", ("field", ("str", form), "format"), (argument,), (), 1, 1)


A, B, C, X = ("name", "a"), ("name", "b"), ("name", "c"), ("name", "x")


@pytest.mark.parametrize(
    ("text", "lowered"),
    [
        ("a", A),
        ("a.b.c", ("field", ("field", A, "b"), "c")),
        ("a[b]", ("index", A, B)),
        ("a[1, 'k']", ("index", A, ("list", (("num", 1), ("str", "k"))))),
        ("setattr(a, 'b', c)", ("set", "=", ("field", A, "b"), C)),
        ("setattr(a, b, c)", call("setattr", A, B, C)),
        ("setattr(a, 'b c', c)", call("setattr", A, ("str", "b c"), C)),
        ("a[1:b]", ("index", A, call("[slice]", ("num", 1), B, ("none",), column=3))),
        ("a[::2]", ("index", A, call("[slice]", ("none",), ("none",), ("num", 2), column=3))),
        ("x = 'a' \"b\"", ("set", "=", X, ("str", "ab"))),
        ("x = -1.5", ("set", "=", X, ("op", "-", (("num", 1.5),)))),
        ("x = True", ("set", "=", X, ("bool", True))),
        ("x = None", ("set", "=", X, ("none",))),
        ("x = ...", ("set", "=", X, ("?", "..."))),
        ("x = b'raw'", ("set", "=", X, ("?", "b'raw'"))),
        ("x = 1e999", ("set", "=", X, ("?", "1e999"))),
        ("x = 0x10000000000000000", ("set", "=", X, ("?", "0x10000000000000000"))),
        ("x = 0xFFFFFFFFFFFFFFFF", ("set", "=", X, ("num", 2**64 - 1))),
        ("x = '\\ud800'", ("set", "=", X, ("?", "'\\ud800'"))),
        ("not a", ("op", "!", (A,))),
        ("a and b and c", ("op", "&&", (("op", "&&", (A, B)), C))),
        ("a or b", ("op", "||", (A, B))),
        ("a < b", ("op", "<", (A, B))),
        ("a < b <= c", ("op", "&&", (("op", "<", (A, B)), ("op", "<=", (B, C))))),
        ("a is not None", ("op", "is not", (A, ("none",)))),
        ("a not in b", ("op", "not in", (A, B))),
        ("a << b", ("op", "<<", (A, B))),
        ("'%s/x' % a", ("op", "%", (("str", "%s/x"), A))),
        ("a if b else c", ("if", B, A, C)),
        ("[a, *b]", ("list", (A, ("star", B)))),
        ("(a, b)", ("list", (A, B))),
        ("{a, b}", ("list", (A, B))),
        ("{'k': a}", ("dict", ((("str", "k"), A),))),
        ("{**a, 'k': b}", ("dict", ((("starstar", A), ("?", "a")), (("str", "k"), B)))),
        ("a += 1", ("set", "+=", A, ("num", 1))),
        ("a //= b", ("set", "//=", A, B)),
        ("a = b = c", ("set", "=", A, ("set", "=", B, C))),
        ("a, *b = c", ("set", "=", ("list", (A, ("star", B))), C)),
        ("(a := b)", ("set", "=", A, B)),
        ("a()", call("a")),
        ("a(b, *c, k=1, **x)", call("a", B, ("star", C), ("kw", "k", ("num", 1)), ("starstar", X))),
        ("a(1)(2)", ("call", call("a", ("num", 1)), (("num", 2),), (), 1, 1)),
        ("'é'.a()", ("call", ("field", ("str", "é"), "a"), (), (), 1, 1)),
        ("f'a{b}c'", ("format", (("str", "a"), B, ("str", "c")))),
        ("f'{a!s}'", ("format", (A,))),
        ("f'{a!r}'", ("format", (formatted("{!r:}", A),))),
        ("f'cam{a:02d}'", ("format", (("str", "cam"), formatted("{:02d}", A)))),
        ("f'{a=}'", ("format", (("str", "a="), formatted("{!r:}", A)))),
        ("f'{a:{b}}'", ("format", (("?", "f'{a:{b}}'"),))),
        ("'%s' % [a]", ("?", "'%s' % [a]")),
        ("'%s' % (a,)", ("op", "%", (("str", "%s"), ("list", (A,))))),
        ("{a: b for a in c}", call("[dict]", call("[for]", C, ("lambda", 1)))),
        ("[a for a in b if c]", call("[for]", B, ("lambda", 1), ("lambda", 2), ("str", "c"))),
        (
            "{a for a in b if c if x}",
            call("[for]", B, ("lambda", 1), ("lambda", 2), ("str", "c if x")),
        ),
        ("[a for b in c for a in b]", call("[for in]", C, ("lambda", 1))),
        ("[a async for a in b]", ("?", "[a async for a in b]")),
        ("assert a, b", A),
        ("del a", ("?", "del a")),
    ],
)
def test_expressions(text: str, lowered: Any) -> None:
    assert value(text) == lowered


def test_comprehensions_within_each_other_are_functions_within_each_other() -> None:
    program = read_python("[f(a, b) for a in b if a for (a, c) in a if c]\n{a: x for a in b}\n")
    pair = ("do", ("set", "=", ("list", (A, C)), ("name", "")))
    inner = call("[for]", A, ("lambda", 2), ("lambda", 3), ("str", "c"))
    assert [function.body for function in program.functions[1:]] == [
        (("return", inner),),
        (pair, ("return", call("f", A, B, column=2))),
        (pair, ("return", C)),
        (("return", A),),
        (("return", ("list", (A, X))),),
    ]
    assert [(function.line, function.column) for function in program.functions[3:5]] == [(1, 45), (1, 24)]


def test_a_walrus_in_a_comprehension_sets_a_variable_outside() -> None:
    program = read_python("[(x := a) for a in b]\n")
    assert program.functions[1].body == (("nonlocal", ("x",)), ("return", ("set", "=", X, A)))


def test_columns_are_code_points() -> None:
    assert value("x = ('é', a('ü', b()))") == (
        "set",
        "=",
        X,
        ("list", (("str", "é"), call("a", ("str", "ü"), call("b", column=18), column=11))),
    )


def test_unknown_text_is_cut() -> None:
    found = value("['" + "x" * 500 + "' async for a in b]")
    assert found == ("?", "['" + "x" * 198)


def test_lambda_and_comprehension_are_functions() -> None:
    program = read_python("f(lambda m, *r: g(m))\n[h(i) for i in t]\n(j for k, l in t)\n")
    assert program.functions[0].body == (
        ("do", call("f", ("lambda", 1))),
        ("do", call("[for]", ("name", "t"), ("lambda", 2), line=2)),
        ("do", call("[for]", ("name", "t"), ("lambda", 3), line=3)),
    )
    by_name = [(f.name, f.kind, tuple(p.name for p in f.parameters), f.line, f.column) for f in program.functions[1:]]
    assert by_name == [
        ("<lambda>", "lambda", ("m", "*r"), 1, 3),
        ("<lambda>", "lambda", ("i",), 2, 1),
        ("<lambda>", "lambda", ("",), 3, 1),
    ]
    assert [f.body for f in program.functions[1:]] == [
        (("return", call("g", ("name", "m"), column=17)),),
        (("return", call("h", ("name", "i"), line=2, column=2)),),
        (("do", ("set", "=", ("list", (("name", "k"), ("name", "l"))), ("name", ""))), ("return", ("name", "j"))),
    ]


@pytest.mark.parametrize(
    ("text", "lowered"),
    [
        ("pass\n'doc'\n", ()),
        ("if a: b\n", (("if", 1, 1, "a", A, (("do", B),), 0, 0, ()),)),
        (
            "if (a and\n      b):\n  x\n\n# no\nelse :\n  c\n",
            (("if", 1, 1, "a and b", ("op", "&&", (A, B)), (("do", X),), 6, 1, (("do", C),)),),
        ),
        (
            "if a:\n  b\nelif c: x\nelse: a\n",
            (("if", 1, 1, "a", A, (("do", B),), 3, 1, (("if", 3, 1, "c", C, (("do", X),), 4, 1, (("do", A),)),)),),
        ),
        (
            "if a:\n  b\nelse:\n  if c: x\n",
            (("if", 1, 1, "a", A, (("do", B),), 3, 1, (("if", 4, 3, "c", C, (("do", X),), 0, 0, ()),)),),
        ),
        (
            "if __name__ == '__main__':\n  a()\n",
            (
                (
                    "if",
                    1,
                    1,
                    "__name__ == '__main__'",
                    ("op", "==", (("name", "__name__"), ("str", "__main__"))),
                    (("do", call("a", line=2, column=3)),),
                    0,
                    0,
                    (),
                ),
            ),
        ),
        ("while a: break\n", (("loop", "while", 1, 1, "a", (), A, (("break",),)),)),
        ("for x in a: continue\n", (("each", 1, 1, "x in a", "x", NO_TYPE, A, (("continue",),)),)),
        (
            "for a, b in c: x\n",
            (
                (
                    "each",
                    1,
                    1,
                    "a, b in c",
                    "",
                    NO_TYPE,
                    C,
                    (("do", ("set", "=", ("list", (A, B)), ("name", ""))), ("do", X)),
                ),
            ),
        ),
        ("for x in a: b\nelse: c\n", (("each", 1, 1, "x in a", "x", NO_TYPE, A, (("do", B),)), ("do", C))),
        (
            "for x in a: break\nelse: c\n",
            (
                ("each", 1, 1, "x in a", "x", NO_TYPE, A, (("break",),)),
                ("if", 2, 1, "else", ("?", "else"), (("do", C),), 0, 0, ()),
            ),
        ),
        (
            "with open(a) as x, b.lock: c\n",
            (("do", ("set", "=", X, call("open", A, column=6))), ("do", ("field", B, "lock")), ("do", C)),
        ),
        (
            "with a() as x, b: c\n",
            (
                ("do", ("set", "=", X, call("a", column=6))),
                ("do", ("set", "=", X, managed(X, "__enter__", 6))),
                ("do", managed(B, "__enter__", 16)),
                ("do", C),
                ("do", managed(X, "__exit__", 6)),
                ("do", managed(B, "__exit__", 16)),
            ),
        ),
        (
            "try:\n  a\nexcept (a.E,\n  F) as x: b\nexcept: c\nelse: x\nfinally: c\n",
            (
                (
                    "try",
                    (("do", A), ("do", X)),
                    (
                        (3, 1, "(a.E, F) as x", "x", ("Union", (("a.E", (), ""), ("F", (), "")), ""), (("do", B),)),
                        (5, 1, "", "", NO_TYPE, (("do", C),)),
                    ),
                ),
                ("do", C),
            ),
        ),
        ("raise a from b\n", (("throw", A),)),
        ("raise\n", (("throw", None),)),
        ("x: Foo = a\n", (("var", "x", ("Foo", (), ""), ("=", A), 1, 1),)),
        ("x: Foo\n", (("var", "x", ("Foo", (), ""), None, 1, 1),)),
        ("a.b: Foo = c\n", (("do", ("set", "=", ("field", A, "b"), C)),)),
        (
            "match a:\n  case 1 | 2: b\n  case None: raise\n  case [x]: c\n  case 3 if b: c\n  case _: x\n",
            (
                (
                    "switch",
                    1,
                    1,
                    "a",
                    A,
                    (
                        (("num", 1), ()),
                        (("num", 2), (("do", B), ("break",))),
                        (("none",), (("throw", None),)),
                        (("?", "[x]"), (("do", ("set", "=", X, ("?", "[x]"))), ("do", C), ("break",))),
                        (("?", "3 if b"), (("do", C), ("break",))),
                        (None, (("do", X), ("break",))),
                    ),
                ),
            ),
        ),
        ("import a\nfrom b import c\ndef f(): pass\n", ()),
        ("class D:\n  class E: pass\n", (("class", "D"),)),
    ],
)
def test_statements(text: str, lowered: tuple[Any, ...]) -> None:
    assert body(text) == lowered


@pytest.mark.parametrize(
    ("text", "lowered"),
    [
        ("def f():\n  return\n", (("return", None),)),
        ("def f():\n  global a\n  a = 1\n", (("global", ("a",)), ("do", ("set", "=", A, ("num", 1))))),
        ("def f():\n  nonlocal a, b\n", (("nonlocal", ("a", "b")),)),
        ("async def f():\n  await a\n", (("do", A),)),
        ("async def f():\n  yield\n  yield a\n", (("do", ("none",)), ("do", A))),
        ("@a\ndef f():\n  yield\n  yield a\n  yield from b\n", (("do", ("none",)), ("do", A), ("do", B))),
        ("def f():\n  def g(): pass\n", (("def", "g", 2),)),
        ("def f():\n  class G: pass\n", (("class", "f.G"),)),
        (
            "def f():\n  import a.b\n  import a.b as c\n  from ..d import e\n  from . import g\n",
            (("import", "a", "a"), ("import", "c", "a.b"), ("import", "e", "..d.e"), ("import", "g", ".g")),
        ),
    ],
)
def test_statements_of_functions(text: str, lowered: tuple[Any, ...]) -> None:
    assert inside(text) == lowered


def test_aliases_are_the_module_s_imports() -> None:
    text = "import a.b\nimport a.c\nimport d.e as f\nfrom g.h import i as j\nfrom k import *\ntry:\n  from . import l\n"
    program = read_python(text + "except E:\n  l = None\n")
    assert program.aliases == tuple(
        Alias(name, (target, (), ""))
        for name, target in (("a", "a"), ("f", "d.e"), ("j", "g.h.i"), ("*", "k"), ("l", ".l"))
    )


def test_an_empty_file() -> None:
    module = Function("", "", "module", (), NO_TYPE, 1, 1, (), body_line=1, body_column=1)
    assert read_python("") == Program("python", functions=(module,))


@pytest.mark.parametrize("text", ["a\nb()", "\ufeffa\r\nb()\r\n", "a\rb()"])
def test_line_ends_and_marks(text: str) -> None:
    program = read_python(text)
    assert program.functions[0].body == (("do", A), ("do", call("b", line=2)))
