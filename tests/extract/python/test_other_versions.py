# SPDX-License-Identifier: Apache-2.0
"""Files for Python 2 and for Python 3.12: what is respelled, what is left alone, and that places stay those of the file."""

from __future__ import annotations

import sys
from typing import Any

import pytest
from syntax_kit import read_python

from haros_ci.extract.python.other_versions import repair


@pytest.mark.parametrize(
    ("text", "repaired"),
    [
        ("class A[T]:", "class A:"),
        ("class A[T](B[T]):", "class A(B[T]):"),
        ("class A[T: (int, B[str]), *U, **P](B[T]): pass", "class A(B[T]): pass"),
        ("def f[T](a: T) -> list[T]:", "def f(a: T) -> list[T]:"),
        ("def f[\n  T: B = C[int],\n](a: T): return a", "def f(a: T): return a"),
        ("async def f[T](a: T):", "async def f(a: T):"),
        ("type A = list[int]", "A = list[int]"),
        ("type A[T] = list[T]; type B = A[int]", "A = list[T]; B = A[int]"),
        ("print 'a'", "print( 'a')"),
        ("print 'a', b,  # c", "print( 'a', b,)  # c"),
        ("print", "print()"),
        ("print 'a' % (b)", "print( 'a' % (b))"),
        ("print ('a') % b", "print( ('a') % b)"),
        ("print -1", "print( -1)"),
        ("print not a", "print( not a)"),
        ("print'a'", "print('a')"),
        ("print >>f, a", "print (f, a)"),
        ("print >> f", "print ( f)"),
        ("print (\n  a) + \\\n b", "print( (\n  a) + \\\n b)"),
        ("if a: print b; print c", "if a: print( b); print( c)"),
        ("else: print b", "else: print( b)"),
        ("x = lambda: 1; print x", "x = lambda: 1; print( x)"),
        ("if f(lambda: 1)[a:b]: print x", "if f(lambda: 1)[a:b]: print( x)"),
        ("if lambda: 1: print x", "if lambda: 1: print( x)"),
        ("except A, e:", "except A as  e:"),
        ("except (A, B), e: pass", "except (A, B) as  e: pass"),
        ("except A, (n, m):", "except A:"),
        ("raise E, 'x'", "raise E( 'x')"),
        ("raise E, 'x', t", "raise E( 'x').with_traceback( t)"),
        ("exec 'a'", "exec( 'a')"),
        ("exec a in b", "exec( a , b)"),
        ("`a`", "repr(a)"),
        ("a <> b", "a != b"),
        ("0777", "0o777"),
        ("0777L + 10L + 0xFFl", "0o777 + 10 + 0xFF"),
        ("ur'a' + UR'b'", "r'a' + R'b'"),
        ("if a:\n\tb\n        c", "if a:\n        b\n        c"),
        ("def f(a, (b, c)):\n  d", "def f(a, _9):\n  (b, c) = _9; d"),
        ("def f((b,), (c, (d, e))=g()): return b", "def f(_6, _12=g()): (b,) = _6; (c, (d, e)) = _12; return b"),
        ("def f((a,\n b)):\n  'c'\n  d", "def f(_6):\n  (a, b) = _6; 'c'\n  d"),
        ("def f(a, (b, c)):\n  if b: d", "def f(a, _9, b=_unpacked_(), c=_unpacked_()):\n  if b: d"),
        ("def f(a, (b, c), **d):\n  if b: d", "def f(a, (b, c), **d):\n  if b: d"),
        ("def f(a, b=(1, 2), c=g((1, 2))): d", "def f(a, b=(1, 2), c=g((1, 2))): d"),
        ("def f(a): return (a, (1, 2))", "def f(a): return (a, (1, 2))"),
    ],
)
def test_repaired(text: str, repaired: str) -> None:
    assert repair(text)[0] == repaired


@pytest.mark.parametrize(
    "text",
    [
        "type = 3",
        "type(a)",
        "type[0] = 1",
        "a = type[int]",
        "def f(a: list[int]): pass",
        "class A(B[int]): pass",
        "b[0].class_[1]",
        "print('a')",
        "print ('a', b)",
        "print = a",
        "print, a",
        "print.a",
        "print in a",
        "x.print",
        "f(print, a)",
        "'print a'",
        "'''\nprint a\n'''",
        "# print a",
        "a = [\n  print\n]",
        "from __future__ import print_function\nprint ('a') % b",
        "except A as e:",
        "except (A, B):",
        "except:",
        "raise E('x')",
        "raise",
        "raise E, ",
        "exec('a')",
        "exec('a', b)",
        "0 + 00 + 0.7 + 07.5 + 0x1e+1 + 1e5 + 10j + 0b11 + 1_000",
        "u'a' + r'b' + b'c' + rb'd'",
        "a < b > c",
        "'`' + \"<>\"",
        '"\\"`<>"',
        "'unterminated `",
        "'''unterminated `\n print a",
        "",
    ],
)
def test_left_alone(text: str) -> None:
    assert repair(text) == (text, {})


PLACES = """print "x", f("é"), g(1)
try:
\tpass
except E, e: h(0777, `i(2)`, j())
"""


def test_places_and_texts_are_those_of_the_file() -> None:
    program = read_python(PLACES)
    assert program.problems == ()

    def call(name: str, line: int, column: int, *arguments: Any) -> Any:
        return ("call", ("name", name), arguments, (), line, column)

    printed = call("print", 1, 1, ("str", "x"), call("f", 1, 12, ("str", "é")), call("g", 1, 20, ("num", 1)))
    handled = call("h", 4, 14, ("num", 511), call("repr", 4, 22, call("i", 4, 23, ("num", 2))), call("j", 4, 30))
    assert program.functions[0].body == (
        ("do", printed),
        ("try", (), ((4, 1, "E as e", "e", ("E", (), ""), (("do", handled),)),)),
    )


def test_conditions_keep_their_spelling() -> None:
    ((_, line, column, text, *_),) = read_python("if a <> 0777L and `b`: print c\n").functions[0].body or ()
    assert (line, column, text) == (1, 1, "a <> 0777L and `b`")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a\nb c\n", 2),
        ("print 'a'\nlambda (a, b): a\n", 2),
        ("print 'a'\n\nasync = 1\n", 3),
        ("def f(:\n", 1),
        ("a\n  b\n", 2),
        ("if a:\n", 1),
        ("a\n'''\n", 2),
    ],
)
def test_given_up(text: str, line: int) -> None:
    program = read_python(text)
    ((found, message),) = program.problems
    assert (program.language, program.functions, found) == ("python", (), line)
    assert "cannot parse the file" in message and message.endswith(
        "with the Python version that the file is written for"
    )


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="this Python reads it as it is")
def test_type_parameters_change_nothing() -> None:
    newer = "type Some = int\nclass A[T](B):\n    def f[U: Some](self, a: U) -> T:\n        return g(a)\n"
    older = "Some = int\nclass A(B):\n    def f(self, a: U) -> T:\n        return g(a)\n"
    found, expected = read_python(newer), read_python(older)
    assert found.problems == ()
    assert [(each.name, each.bases) for each in found.classes] == [(each.name, each.bases) for each in expected.classes]
    assert [each.name for each in found.functions] == [each.name for each in expected.functions]
    assert found.functions[-1].parameters == expected.functions[-1].parameters
