# SPDX-License-Identifier: Apache-2.0
"""Every form of expression, with its exact tuple."""

from __future__ import annotations

from typing import Any

import pytest
from cpp_kit import T, body, value
from syntax_kit import read_cpp

A, B, C = ("name", "a"), ("name", "b"), ("name", "c")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('"a"', ("str", "a")),
        ('"a" "b"\n  "c"', ("str", "abc")),
        ('L"a"', ("str", "a")),
        ('u8"ü"', ("str", "ü")),
        ('R"(a\\n"b")"', ("str", 'a\\n"b"')),
        ('R"x(a)" b)x"', ("str", 'a)" b')),
        (r'"\x41\101\n\t\\\"\u00e9"', ("str", 'AA\n\t\\"é')),
        ('"//x" "/*y*/"', ("str", "//x/*y*/")),
        ('"a"s', ("str", "a")),
        ('"a" PRIu64 "b"', ("op", "+", (("str", "a"), ("format", (("name", "PRIu64"), ("str", "b")))))),
        ('PRE "b"', ("format", (("name", "PRE"), ("str", "b")))),
        ('f(" a" " emit b", " typename " X "c")', None),
        ("'a'", ("cast", T("char"), ("num", 97))),
        (r"'\n'", ("cast", T("char"), ("num", 10))),
        (r"'\''", ("cast", T("char"), ("num", 39))),
        ("L'x'", ("num", 120)),
        ("'ab'", ("?", "'ab'")),
        ("10", ("num", 10)),
        ("010", ("num", 8)),
        ("0x1F'0uLL", ("num", 0x1F0)),
        ("0b101", ("num", 5)),
        ("1'000'000", ("num", 1000000)),
        ("-1", ("num", -1)),
        ("- 1", ("num", -1)),
        ("1.5f", ("num", 1.5)),
        (".5", ("num", 0.5)),
        ("2.", ("num", 2.0)),
        ("1e3", ("num", 1000.0)),
        ("0x1p3", ("num", 8.0)),
        ("1e999", ("?", "1e999")),
        ("true", ("bool", True)),
        ("false", ("bool", False)),
        ("nullptr", ("none",)),
        ("NULL", ("none",)),
        ("500ms", ("call", ("name", 'operator""ms'), (("num", 500),), (), 2, 5)),
        ("this", ("this",)),
        ("a", A),
        ("a::b", ("name", "a::b")),
        ("::a::b", ("name", "::a::b")),
        ("a :: b", ("name", "a::b")),
        ("a<int>::b", ("name", "a::b")),
        ("a.b", ("field", A, "b")),
        ("a->b", ("field", A, "b")),
        ("a->b::c", ("field", A, "b::c")),
        ("a.*b", ("op", ".*", (A, B))),
        ("a[b]", ("index", A, B)),
        ("a(b)[0]", ("index", ("call", A, (B,), (), 2, 5), ("num", 0))),
        ("!a", ("op", "!", (A,))),
        ("not a", ("op", "!", (A,))),
        ("a and b or c", ("op", "||", (("op", "&&", (A, B)), C))),
        ("a << b << c", ("op", "<<", (("op", "<<", (A, B)), C))),
        ("a + b * c", ("op", "+", (A, ("op", "*", (B, C))))),
        ("a -1", ("op", "-", (A, ("num", 1)))),
        ("-a", ("op", "-", (A,))),
        ("&a", ("&", A)),
        ("*a", ("*", A)),
        ("(a)", A),
        ("(a, b)", ("op", ",", (A, B))),
        ("a = b", ("set", "=", A, B)),
        ("a += b", ("set", "+=", A, B)),
        ("a++", ("op", "-", (("set", "+=", A, ("num", 1)), ("num", 1)))),
        ("--a", ("set", "-=", A, ("num", 1))),
        ("a ? b : c", ("if", A, B, C)),
        ("a ?: b", ("if", A, A, B)),
        ("{a, {b}}", ("list", (A, ("list", (B,))))),
        ("{.k = a}", ("list", (("kw", "k", A),))),
        ("(int)a", ("cast", T("int"), A)),
        ("(unsigned char *)a", ("cast", T("unsigned char", marks="*"), A)),
        ("static_cast<const A *>(a)", ("cast", T("A", marks="c*"), A)),
        ("sizeof(int)", ("op", "sizeof", (("type", T("int")),))),
        ("sizeof a", ("op", "sizeof", (A,))),
        ("std::string(a)", ("call", ("name", "std::string"), (A,), (), 2, 5)),
        ("int(a)", ("call", ("name", "int"), (A,), (), 2, 5)),
        ("A{a}", ("call", ("name", "A"), (A,), (), 2, 5)),
        ("std::vector<int>{a, b}", ("call", ("name", "std::vector"), (("list", (A, B)),), (T("int"),), 2, 5)),
        ("std::vector<int>(a, b)", ("call", ("name", "std::vector"), (A, B), (T("int"),), 2, 5)),
        ("Point<int>{a, b}", ("call", ("name", "Point"), (A, B), (T("int"),), 2, 5)),
        ("a(b...)", ("call", A, (("star", B),), (), 2, 5)),
        ("a<3>()", ("call", A, (), (("num", 3),), 2, 5)),
        ("a<b::c, true>()", ("call", A, (), (T("b::c"), ("bool", True)), 2, 5)),
        ("::a::b(c)", ("call", ("name", "::a::b"), (C,), (), 2, 5)),
        ("a<b>::c()", ("call", ("name", "a::c"), (), (T("[class]", T("b")),), 2, 5)),
        ("std::make_shared<A>(a)", ("call", ("name", "std::make_shared"), (A,), (T("A"),), 2, 5)),
        ("a.template b<C>(c)", ("call", ("field", A, "b"), (C,), (T("C"),), 2, 5)),
        ("A::template b<C>(c)", ("call", ("name", "A::b"), (C,), (T("C"),), 2, 5)),
        ("this->a<B::C>()", ("call", ("field", ("this",), "a"), (), (T("B::C"),), 2, 5)),
        ("(*this)(a)", ("call", ("*", ("this",)), (A,), (), 2, 5)),
        (
            "a.b(1)\n .c()",
            ("call", ("field", ("call", ("field", A, "b"), (("num", 1),), (), 2, 5), "c"), (), (), 2, 5),
        ),
        ("new A", ("new", T("A"), (), 2, 5)),
        ("new A<B>(a, b)", ("new", T("A", T("B")), (A, B), 2, 5)),
        ("new A{a}", ("new", T("A"), (A,), 2, 5)),
        ("new (a) A(b)", ("new", T("A"), (B,), 2, 5)),
        ("new int[3]", ("new", T("int", marks="*"), (), 2, 5)),
        ("boost::bind(&A::b, this, _1)", None),
        ("typeid(a)", ("call", ("name", "typeid"), (A,), (), 2, 5)),
    ],
)
def test_expression(text: str, expected: Any) -> None:
    found = value(text)
    if text.startswith("f("):
        second = ("op", "+", (("str", " typename "), ("format", (("name", "X"), ("str", "c")))))
        expected = ("call", ("name", "f"), (("str", " a emit b"), second), (), 2, 5)
    elif expected is None:
        bound = (("&", ("name", "A::b")), ("this",), ("name", "_1"))
        expected = ("call", ("name", "boost::bind"), bound, (), 2, 5)
    assert found == expected


@pytest.mark.parametrize(
    ("text", "sign"),
    [("a++;", "+="), ("a--;", "-="), ("++a;", "+="), ("for (;; a++) {}", "+="), ("for (;; --a) {}", "-=")],
)
def test_a_step_whose_value_is_not_used(text: str, sign: str) -> None:
    changed = ("set", sign, A, ("num", 1))
    found = body(text)
    assert found == (("do", changed),) or found[0][-1] == (("step", changed),)


def test_delete_and_comma_are_ops() -> None:
    assert body("delete a; delete[] b; a, b;") == (
        ("do", ("op", "delete", (A,))),
        ("do", ("op", "delete", (B,))),
        ("do", ("op", ",", (A, B))),
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "std::function<void(const M &, int)>",
            T("std::function", ("()", (T("void"), T("M", marks="c&"), T("int")), "")),
        ),
        ("A<B<C>, 3>", T("A", T("B", T("C")), ("num", 3))),
        ("A<B>::C", T("A::C", T("B"))),
        ("typename A<B>::template C<D>", T("A::C", T("D"))),
        ("const A *const", T("A", marks="c*c")),
        ("A const &", T("A", marks="c&")),
        ("unsigned   int", T("unsigned int")),
        ("struct A", T("A")),
        ("::a::B", T("::a::B")),
        ("decltype(a)", T("decltype(a)")),
        ("volatile A", T("A")),
        ("static constexpr A", T("A", marks="c")),
        ("auto &&", T("auto", marks="&&")),
        ("A **", T("A", marks="**")),
    ],
)
def test_type(text: str, expected: Any) -> None:
    (found,) = body(f"{text} v = x;")
    found = found[1] if found[0] == "static" else found
    assert found[:3] == ("var", "v", expected)


def test_lambdas_are_functions_of_the_program() -> None:
    program = read_cpp("struct A { void f() { g([this, n = 1](int q) -> bool { return h(q); }); } };")
    method, inner = program.functions
    assert method.body == (("do", ("call", ("name", "g"), (("lambda", 1),), (), 1, 23)),)
    assert (inner.name, inner.owner, inner.kind) == ("A::f::(lambda)", "A", "lambda")
    assert (inner.line, inner.column, inner.body_line, inner.body_column) == (1, 25, 1, 54)
    assert [(each.name, each.type) for each in inner.parameters] == [("q", T("int"))]
    assert inner.returns == T("bool")
    assert inner.body == (
        ("var", "n", T("auto"), ("=", ("num", 1)), 1, 32),
        ("return", ("call", ("name", "h"), (("name", "q"),), (), 1, 63)),
    )


def test_blocks_in_expressions_are_lambdas() -> None:
    program = read_cpp("void f() { EXPECT_NO_THROW({ g(); }); x = ({ h(); }); }")
    assert program.functions[0].body == (
        ("do", ("call", ("name", "EXPECT_NO_THROW"), (("lambda", 1),), (), 1, 12)),
        ("do", ("set", "=", ("name", "x"), ("call", ("lambda", 2), (), (), 1, 44))),
    )
    assert program.functions[1].body == (("do", ("call", ("name", "g"), (), (), 1, 30)),)
    assert program.functions[2].body == (("do", ("call", ("name", "h"), (), (), 1, 46)),)
