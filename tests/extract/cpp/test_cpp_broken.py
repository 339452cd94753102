# SPDX-License-Identifier: Apache-2.0
"""Broken, deep and random input: nothing is raised, what comes out is bounded, what is lost is said."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from haros_ci.extract.cpp.read import read_cpp
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded, encoded

DEEP = 3000
OPEN = "void f() { "


def check(text: str) -> Program:
    """The Program, which fits in JSON and comes back as itself."""
    program = read_cpp(text)
    dumped = encoded(program)
    assert dumped is not None
    assert len(dumped) < 20_000 + 200 * len(text)
    assert len(program.problems) <= 5
    lines = text.count("\n") + 1
    assert all(1 <= line <= lines for line, _ in program.problems)
    assert all(1 <= each.line <= lines and each.column >= 1 for each in program.functions)
    again = decoded(dumped)
    assert again == program and encoded(again) == dumped
    return program


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\0",
        "\0" * 100,
        "\ufeff",
        "\ud800\udfff void f() {}",
        "\x7fELF\x02\x01\x01\0\0",
        "{",
        "}",
        "}}}}",
        '"',
        "'",
        '"\\',
        "/*",
        "//",
        "// \\",
        'R"(',
        'R"x(a)y"',
        "#",
        "#if",
        "#if A",
        "#endif",
        "#else",
        "#define",
        "#define A(",
        "#define A(a a\nvoid f() { A(1); }",
        "#include",
        "class",
        "class {",
        "class A :",
        "namespace",
        "namespace {",
        "enum",
        "enum {",
        "enum { A = ",
        "template <",
        "template <class T",
        "using",
        "using namespace;",
        "typedef",
        "void f(",
        "void f() {",
        "A::A() : ",
        "A::A() : b( {}",
        OPEN + "if (",
        OPEN + "for (",
        OPEN + "for (:) {}",
        OPEN + "switch (a) { case",
        OPEN + "try {",
        OPEN + "a(",
        OPEN + "a.",
        OPEN + "a->",
        OPEN + "[",
        OPEN + "[&](",
        OPEN + "new",
        OPEN + "A v(",
        OPEN + "A v(a,",
        OPEN + "x = ;",
        OPEN + "return",
        OPEN + "goto",
        OPEN + "a ? b",
        OPEN + "(int)",
        OPEN + "sizeof",
        OPEN + "'",
        OPEN + "operator",
        "~",
        "operator",
        "friend",
        'extern "C"',
        "BOOST_FOREACH(",
        "void f() { BOOST_FOREACH(a) }",
        "def f():\n    return 1\n",
        "<xml a='b'/>",
        "\r\n\r\r\n",
    ],
)
def test_broken(text: str) -> None:
    check(text)


@pytest.mark.parametrize(
    ("start", "repeated", "end"),
    [
        (OPEN, "(", ""),
        (OPEN, "{", ""),
        (OPEN + "x = ", "(", "a" + ")" * DEEP + ";}"),
        (OPEN, "{", "}" * DEEP + "}"),
        (OPEN, "g(", ")" * DEEP + ";}"),
        (OPEN + "x = ", "a + ", "b;}"),
        (OPEN, "a << ", "b;}"),
        (OPEN, "a = ", "b;}"),
        (OPEN, "a, ", "b;}"),
        (OPEN, "if (a) {} else ", "{}}"),
        (OPEN, "if (a) ", "b; }"),
        (OPEN, "for (;;) ", "b; }"),
        (OPEN, "try { ", "} catch (...) {} " * DEEP + "}"),
        (OPEN + "x", ".a()", ";}"),
        (OPEN + "x", "[0]", ";}"),
        (OPEN + "x = ", "!", "a;}"),
        (OPEN + "x = ", "a ? b : ", "c;}"),
        (OPEN + "x = ", "{", "}" * DEEP + ";}"),
        (OPEN, "[]{", "}" * DEEP + ";}"),
        (OPEN, "l: ", ";}"),
        (OPEN, "(int)", "a;}"),
        (OPEN, "switch (a) { case 1: ", "}" * DEEP + "}"),
        (OPEN, "new ", "a;}"),
        (OPEN, "[[a]] ", "a;}"),
        (OPEN, "A v(a * b);", "}"),
        (OPEN, "#if A\n", "\n"),
        ("", "#if A\n", "#endif\n" * DEEP),
        ("", "namespace a { ", "}" * DEEP),
        ("", "class a { ", "};" * DEEP),
        ("", "template <", ""),
        ("", "A<", "int" + ">" * DEEP + " v;"),
        ("int ", "*", "x;"),
        ("int x", "[0]", ";"),
        ("int ", "(", "x" + ")" * DEEP + ";"),
        ("", "a::", "b x;"),
        ("", "typedef ", "int x;"),
        ("auto f()", "->auto(*)()", ";"),
        (OPEN + "x = f(", "a @ b, ", "c);}"),
        (OPEN + "a<", "b>>", "c;}"),
        ("", "/*", ""),
        ("", '"\\', ""),
        ("", 'R"(', ""),
        ("#define M(x) M(x); M(x)\n" + OPEN, "M(1);", "}"),
        ("enum { ", "a, ", "};"),
        ("enum { a = b, ", "a, ", "};"),
    ],
)
def test_deep_or_long(start: str, repeated: str, end: str) -> None:
    check(start + repeated * DEEP + end)


def test_what_is_too_deep_is_said() -> None:
    assert check(OPEN + "\nx = " + "!" * DEEP + "a; }").problems == (
        (2, "nested too deeply: what is inside is not read"),
    )


def test_a_long_chain_within_the_limit_is_read_wholly() -> None:
    program = check(OPEN + "a" + " << b()" * 80 + "; }")
    assert program.problems == ()
    assert str(encoded(program)).count('"call"') == 80


def test_an_error_loses_its_function_only() -> None:
    program = check("void a() { g(); }\nvoid b() {\n x = = 1; }\nvoid c() { h(); }")
    assert [each.name for each in program.functions] == ["a", "b", "c"]
    assert program.problems == ((3, "syntax that is not understood: part of the function is not read"),)


def test_at_most_five_problems() -> None:
    assert len(check("void a() { x = = 1; }\n" * 20).problems) == 5


def test_a_huge_file_is_not_read() -> None:
    program = read_cpp("int a;\n" * 600_000)
    assert program == Program("cpp", problems=((1, "larger than 4000000 characters: the file is not read"),))


SPLICED = """
void f() {@}@(@)@[@]@{@;@,@:@::@<@>@->@.@*@&@=@==@"@'@#if A\n@#else\n@#endif\n@#define M(x) g(x)\n@M(1);@class A
@struct A_EXPORT B : C {@};@namespace n {@template <class T>@A v(b);@A v(b * c, d());@auto [a, b] = c;@if (a)@else
@for (;;)@for (auto x : y)@while@do@switch (a) {@case 1:@default:@try {@} catch (...) {@return@throw@new A(b)@delete
@this@[&](int a) {@operator@~@enum E { A, B = 2 };@using namespace x;@using A = B<C>;@typedef@int@const@static@a@b@1
@1.5@"s"@R"(@)"@'c'@/*@*/@//@\\\n@\n@\t@\r\n@ä@😀@sizeof@static_cast<A>(@a ? b : c@Q_OBJECT@Q_EMIT@co_await
@BOOST_FOREACH(A a, b)@A::A() : b(1) {@typename
"""
FRAGMENTS = SPLICED.split("@")


@settings(max_examples=120, deadline=None, derandomize=True, database=None)
@given(st.lists(st.sampled_from(FRAGMENTS), max_size=40))
def test_random_splices(pieces: list[str]) -> None:
    check(" ".join(pieces))


@settings(max_examples=40, deadline=None, derandomize=True, database=None)
@given(st.text(max_size=80))
def test_random_text(text: str) -> None:
    check(text)
    check(OPEN + text + "}")
