# SPDX-License-Identifier: Apache-2.0
"""Every form of statement, local declarations and macros in bodies, with exact tuples."""

from __future__ import annotations

from typing import Any

import pytest
from cpp_kit import T, body, function
from syntax_kit import read_cpp

A, B, C = ("name", "a"), ("name", "b"), ("name", "c")


def call(name: str, line: int, column: int, *arguments: Any) -> tuple[Any, ...]:
    return ("do", ("call", ("name", name), arguments, (), line, column))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            'ros::NodeHandle nh("~"), pn;',
            [("nh", T("ros::NodeHandle"), ("(", (("str", "~"),))), ("pn", T("ros::NodeHandle"), None)],
        ),
        (
            "A a, &b = a, *const c = nullptr;",
            [("a", T("A"), None), ("b", T("A", marks="&"), ("=", A)), ("c", T("A", marks="*c"), ("=", ("none",)))],
        ),
        ("A v{a}, w = {b};", [("v", T("A"), ("{", (A,))), ("w", T("A"), ("=", ("list", (B,))))]),
        ("A v(a);", [("v", T("A"), ("(", (A,)))]),
        ("A v(a::b);", [("v", T("A"), ("(", (("name", "a::b"),)))]),
        ("A<B> v(a, b);", [("v", T("A", T("B")), ("(", (A, B)))]),
        ("A v(a * b);", [("v", T("A"), ("(", (("op", "*", (A, B)),)))]),
        ("A v(a & b, c);", [("v", T("A"), ("(", (("op", "&", (A, B)), C)))]),
        ("A v(a[0]);", [("v", T("A"), ("(", (("index", A, ("num", 0)),)))]),
        ("A v(a(b));", [("v", T("A"), ("(", (("call", A, (B,), (), 2, 5),)))]),
        ("A v(a());", [("v", T("A"), ("(", (("call", A, (), (), 2, 5),)))]),
        ("A v(*a);", [("v", T("A"), ("(", (("*", A),)))]),
        ("const A & v(a.b.c);", [("v", T("A", marks="c&"), ("=", ("field", ("field", A, "b"), "c")))]),
        ("A *v(new A);", [("v", T("A", marks="*"), ("(", (("new", T("A"), (), 2, 6),)))]),
        ("int v[3] = {1};", [("v", T("int", marks="*"), ("=", ("list", (("num", 1),))))]),
        ("const char *v[] = {a};", [("v", T("char", marks="c**"), ("=", ("list", (A,))))]),
        ("int (*v)(char) = a;", [("v", ("()", (T("int"), T("char")), "*"), ("=", A))]),
        ("auto v = a;", [("v", T("auto"), ("=", A))]),
        (
            "auto &[v, w] = a;",
            [
                ("", T("auto", marks="&"), ("=", A)),
                ("v", T("auto", marks="&"), ("=", ("index", ("name", ""), ("num", 0)))),
                ("w", T("auto", marks="&"), ("=", ("index", ("name", ""), ("num", 1)))),
            ],
        ),
        ("A v();", []),
        ("A v(int);", []),
        ("A v(const B &);", []),
        ("A v(B b);", []),
        ("A v(B b = 1);", []),
    ],
)
def test_local_variables(text: str, expected: Any) -> None:
    found = body(text)
    assert [each[1:4] for each in found] == expected
    assert all(each[0] == "var" for each in found)


def test_a_variable_stands_at_its_name() -> None:
    assert [each[4:] for each in body("A a,\n  *b;")] == [(2, 3), (3, 4)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("if (a)  b(); else c();", ("if", 2, 1, "a", A, (call("b", 2, 9),), 2, 14, (call("c", 2, 19),))),
        ("if (a  &&\n b) { }", ("if", 2, 1, "a && b", ("op", "&&", (A, B)), (), 0, 0, ())),
        ("if constexpr (a) { }", ("if", 2, 1, "a", A, (), 0, 0, ())),
        (
            "if (a) { } else if (b) { } else { c(); }",
            ("if", 2, 1, "a", A, (), 2, 12, (("if", 2, 17, "b", B, (), 2, 28, (call("c", 2, 35),)),)),
        ),
        (
            "if (auto a = b) { }",
            ("block", (("var", "a", T("auto"), ("=", B), 2, 10), ("if", 2, 1, "auto a = b", A, (), 0, 0, ()))),
        ),
        (
            "if (A a; b) { }",
            ("block", (("var", "a", T("A"), None, 2, 7), ("if", 2, 1, "A a; b", B, (), 0, 0, ()))),
        ),
        ("while (a) b();", ("loop", "while", 2, 1, "a", (), A, (call("b", 2, 11),))),
        (
            "while (A a = b) { }",
            ("loop", "while", 2, 1, "A a = b", (("var", "a", T("A"), ("=", B), 2, 10),), A, ()),
        ),
        ("do { b(); } while (a);", ("loop", "do", 2, 1, "a", (), A, (call("b", 2, 6),))),
        ("do { b(); } while (0);", ("loop", "do", 2, 1, "0", (), ("num", 0), (call("b", 2, 6),))),
        (
            "for (int a = 0; a < 3; ++a) { continue; }",
            (
                "loop",
                "for",
                2,
                1,
                "a < 3",
                (("var", "a", T("int"), ("=", ("num", 0)), 2, 10),),
                ("op", "<", (A, ("num", 3))),
                (("continue",), ("step", ("set", "+=", A, ("num", 1)))),
            ),
        ),
        ("for (a = 0; ; ) { }", ("loop", "for", 2, 1, "", (("do", ("set", "=", A, ("num", 0))),), None, ())),
        ("for (;;) break;", ("loop", "for", 2, 1, "", (), None, (("break",),))),
        (
            "for (const A &a : b) c();",
            ("each", 2, 1, "const A &a : b", "a", T("A", marks="c&"), B, (call("c", 2, 22),)),
        ),
        (
            "for (auto [k, v] : a) { }",
            (
                "each",
                2,
                1,
                "auto [k, v] : a",
                "",
                T("auto"),
                A,
                (
                    ("var", "k", T("auto"), ("=", ("index", ("name", ""), ("num", 0))), 2, 12),
                    ("var", "v", T("auto"), ("=", ("index", ("name", ""), ("num", 1))), 2, 15),
                ),
            ),
        ),
        (
            "for (A a; auto b : c) { }",
            ("block", (("var", "a", T("A"), None, 2, 8), ("each", 2, 1, "auto b : c", "b", T("auto"), C, ()))),
        ),
        ("BOOST_FOREACH(A &a, b) { c(); }", ("each", 2, 1, "A &a: b", "a", T("A", marks="&"), B, (call("c", 2, 26),))),
        (
            "switch (a) { case 1: case B: b(); break; default: { c(); } }",
            (
                "switch",
                2,
                1,
                "a",
                A,
                (
                    (("num", 1), ()),
                    (("name", "B"), (call("b", 2, 30), ("break",))),
                    (None, (("block", (call("c", 2, 53),)),)),
                ),
            ),
        ),
        (
            "try { a(); } catch (const E &e) { throw; } catch (...) { }",
            (
                "try",
                (call("a", 2, 7),),
                (
                    (2, 14, "const E &e", "e", T("E", marks="c&"), (("throw", None),)),
                    (2, 44, "...", "", T(""), ()),
                ),
            ),
        ),
        ("throw A(b);", ("throw", ("call", ("name", "A"), (B,), (), 2, 7))),
        ("return;", ("return", None)),
        ("return {a};", ("return", ("list", (A,)))),
        ("co_return a;", ("return", A)),
        ("{ a(); }", ("block", (call("a", 2, 3),))),
        ("here: a();", call("a", 2, 7)),
        ("[[likely]] a();", call("a", 2, 12)),
        ("Q_EMIT a(b);", call("a", 2, 8, B)),
        ("struct A { int b; };", ("class", "A")),
    ],
)
def test_statement(text: str, expected: Any) -> None:
    assert body(text) == (expected,)


@pytest.mark.parametrize("text", ["static A v;", "static const A v;", "thread_local static A v;"])
def test_a_static_variable_is_made_once(text: str) -> None:
    ((kind, variable),) = body(text)
    assert (kind, variable[:2]) == ("static", ("var", "v"))


@pytest.mark.parametrize("text", [";", "static_assert(a);", "using A = B;", "enum E { X };", "#pragma once", "// a"])
def test_nothing_to_do(text: str) -> None:
    assert body(text + "\n") == ()


def test_conditionals_in_bodies_keep_all_branches() -> None:
    assert body("#ifdef A\na();\n#elif defined(B)\nb();\n#else\nc();\n#endif") == (
        (
            "pre",
            (
                (2, 1, "#ifdef A", (call("a", 3, 1),)),
                (4, 1, "#elif defined(B)", (call("b", 5, 1),)),
                (6, 1, "#else", (call("c", 7, 1),)),
            ),
        ),
    )


def test_what_is_never_compiled_is_not_there() -> None:
    assert body("#if 0\na();\n#else\nb();\n#endif") == (
        ("pre", ((2, 1, "#if 0", ()), (4, 1, "#else", (call("b", 5, 1),)))),
    )


def test_cases_under_a_conditional() -> None:
    (switch,) = body("switch (a) {\n#ifdef A\ncase 1: b();\n#endif\ncase 2: c(); }")
    assert switch[5] == (
        (("num", 1), (("pre", ((3, 1, "#ifdef A", (call("b", 4, 9),)),)),)),
        (("num", 2), (call("c", 6, 9),)),
    )


@pytest.mark.parametrize(
    ("text", "cases"),
    [
        (
            "case 1:\n#ifdef A\nb(); break;\n#else\nc();\n#endif\nd();\ncase 2: e();",
            (
                (
                    ("num", 1),
                    (
                        (
                            "pre",
                            ((4, 1, "#ifdef A", (call("b", 5, 1), ("break",))), (6, 1, "#else", (call("c", 7, 1),))),
                        ),
                        call("d", 9, 1),
                    ),
                ),
                (("num", 2), (call("e", 10, 9),)),
            ),
        ),
        (
            "case 1: b();\n#ifdef A\nc();\ncase 2: d();\n#endif\ndefault: e();",
            (
                (("num", 1), (call("b", 3, 9), ("pre", ((4, 1, "#ifdef A", (call("c", 5, 1),)),)))),
                (("num", 2), (("pre", ((4, 1, "#ifdef A", (call("d", 6, 9),)),)),)),
                (None, (call("e", 8, 10),)),
            ),
        ),
        ("#ifdef A\nb();\n#endif\ncase 1: c();", ((("num", 1), (call("c", 6, 9),)),)),
        ("b();\ncase 1: c();", ((("num", 1), (call("c", 4, 9),)),)),
        (
            "case 1:\n#ifdef A\n#endif\ncase 2: c();",
            ((("num", 1), (("pre", ((4, 1, "#ifdef A", ()),)),)), (("num", 2), (call("c", 6, 9),))),
        ),
    ],
)
def test_blocks_under_a_conditional_go_on_with_the_case_before_them(text: str, cases: Any) -> None:
    (switch,) = body(f"switch (a) {{\n{text} }}")
    assert switch[5] == cases


def test_a_conditional_that_splits_braces_is_read_in_its_first_branch() -> None:
    text = "#ifdef A\nif (a) {\n#else\nif (b) {\n#endif\nc(); }\nd();"
    compiled = ("if", ("compiled", ((2, 1, "#ifdef A"),)), A, ("?", "a"))
    assert body(text) == (
        ("if", 3, 1, "a", compiled, (call("c", 7, 1),), 0, 0, ()),
        call("d", 8, 1),
    )


def test_a_conditional_within_a_list() -> None:
    assert body("f(a,\n#ifdef A\nb,\n#endif\nc);") == (
        call("f", 2, 1, A, ("if", ("compiled", ((3, 1, "#ifdef A"),)), B, ("?", "b")), C),
    )


@pytest.mark.parametrize(
    ("macro", "use", "expected"),
    [
        (
            "M(n, d) nh.param(#n, n, d)",
            "M(a, 1);",
            [("do", ("call", ("field", ("name", "nh"), "param"), (("str", "a"), A, ("num", 1)), (), 3, 1))],
        ),
        ("M(x) do { g(x); } while (0)", "M(a);", [("block", (call("g", 3, 1, A),))]),
        (
            'M(x) pub_##x = adv<X>("/" #x)',
            "M(a);",
            [("do", ("set", "=", ("name", "pub_a"), ("call", ("name", "adv"), (("str", "/a"),), (T("X"),), 3, 1)))],
        ),
        ("M(...) g(1, __VA_ARGS__)", "M(a, b);", [call("g", 3, 1, ("num", 1), A, B)]),
        ("M() g()", "M();", [call("g", 3, 1)]),
        ("M(x) g(x); M(x)", "M(1);", None),
        ("M(x) x", "M(g());", [("do", ("call", ("name", "M"), (("call", ("name", "g"), (), (), 3, 3),), (), 3, 1))]),
        ("M(x) if (x) { g()", "M(a);", [call("M", 3, 1, A)]),
        ("M(x, y) g(x)", "M(a);", [call("M", 3, 1, A)]),
    ],
)
def test_macros_as_statements(macro: str, use: str, expected: Any) -> None:
    found = function(f"#define {macro}\nvoid f() {{\n{use}\n}}", "f").body
    assert found is not None
    if expected is None:
        assert found == (*[call("g", 3, 1, ("num", 1))] * 3, call("M", 3, 1, ("num", 1)))
    else:
        assert found == tuple(expected)


def test_a_macro_as_an_expression_stays_a_name() -> None:
    program = read_cpp('#define TOPIC "a"\nvoid f() { g(TOPIC); }')
    assert program.macros == (("TOPIC", None, '"a"'),)
    assert program.functions[0].body == (call("g", 2, 12, ("name", "TOPIC")),)


def test_what_is_around_an_error_is_of_unknown_value_but_keeps_its_calls() -> None:
    program = read_cpp("void f() {\na = g(1) @ h(2);\nreturn b;\n}")
    assert program.problems == ((2, "syntax that is not understood: part of the function is not read"),)
    assigned, returned = program.functions[0].body or ()
    assert assigned[1][:3] == ("set", "=", A)
    assert assigned[1][3][:2] == ("op", "?")
    assert returned == ("return", B)
