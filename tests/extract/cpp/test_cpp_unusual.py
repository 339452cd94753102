# SPDX-License-Identifier: Apache-2.0
"""Sound C++ that the grammar does not know by itself: it is read without a complaint, and at its own places."""

from __future__ import annotations

from typing import Any

import pytest
from cpp_kit import T, body, function, value
from syntax_kit import read_cpp

from haros_ci.extract.cpp.blanks import readable

A, B = ("name", "a"), ("name", "b")


def call(name: str, line: int, column: int, *arguments: Any) -> Any:
    return ("do", ("call", ("name", name), arguments, (), line, column))


def test_members_by_pointers_to_them() -> None:
    assert value("a->*b") == ("op", ".*", (A, B))
    assert value("(a->*b)(1)") == ("call", ("op", ".*", (A, B)), (("num", 1),), (), 2, 5)
    assert value('"a->*b"') == ("str", "a->*b")


def test_pointers_to_members_by_their_own_names() -> None:
    kind = ("()", (T("void"),), "*")
    (declared,) = body("void (C::*m)(int) = &C::x;")
    assert declared == ("var", "m", kind, ("=", ("&", ("name", "C::x"))), 2, 7)
    given = function("void f(void (a::C::*m)(int) const) {}", "f")
    assert [(each.name, each.type) for each in given.parameters] == [("m", kind)]
    assert [(each.name, each.type) for each in read_cpp("int C::*p;").variables] == [("p", T("int", marks="*"))]


def test_limits_of_numbers_keep_their_type() -> None:
    limit = ("call", ("name", "std::numeric_limits::max"), (), (T("double"),), 2, 5)
    assert value("std::numeric_limits<double>::max()") == limit
    assert value("K<double>::max()") == ("call", ("name", "K::max"), (), (T("[class]", T("double")),), 2, 5)
    assert value("K<double>::max<int>()") == ("call", ("name", "K::max"), (), (T("int"),), 2, 5)


def test_elements_by_the_operators_name() -> None:
    assert value('a->operator[]("b").c') == ("field", ("index", A, ("str", "b")), "c")
    assert value("a.operator [] (b)") == ("index", A, B)


def test_dependent_types_in_expressions() -> None:
    assert value("a << typename D::T(1)") == (
        "op",
        "<<",
        (A, ("call", ("name", "D::T"), (("num", 1),), (), 2, 19)),
    )


@pytest.mark.parametrize("gap", ["\n ", "  \n", "  // why\n", "\n\n\t"])
@pytest.mark.parametrize("after", ["b();", "a->b();", "const int n = 3;", "if (a) { b(); }", "return b;"])
def test_macros_without_a_semicolon(gap: str, after: str) -> None:
    statements = body(f"g();\nFOO_CHECK(a){gap}{after}")
    assert statements[:2] == (call("g", 2, 1), call("FOO_CHECK", 3, 1, A))
    assert len(statements) == 3


def test_macros_without_semicolons_in_a_row() -> None:
    found = body("FOO_A(a)\n FOO_B(b)\n\n  g();")
    assert found == (call("FOO_A", 2, 1, A), call("FOO_B", 3, 2, B), call("g", 5, 3))


@pytest.mark.parametrize(
    "text",
    [
        "int x = FOO_A(a)\n + b;",
        "g(FOO_A(a)\n , b);",
        "FOO_A(a)\n .b();",
        "FOO_A(a)\n { g(); }",
        "return FOO_A(a)\n ? a : b;",
    ],
)
def test_what_goes_on_behind_a_macro_gets_no_semicolon(text: str) -> None:
    assert len(body(text)) <= 2


def test_a_macro_in_a_class_is_no_method_of_the_next_line() -> None:
    program = read_cpp("class K {\n void a();\n FOO_DEFINITIONS(K)\n void b();\n};")
    assert program.problems == ()
    assert "K::a" in [each.name for each in program.functions]


def test_a_semicolon_within_a_macro() -> None:
    assert body("ROS_DEBUG_STREAM(a;);\ng();")[1:] == (call("g", 3, 1),)
    assert [each[0] for each in body("for (;;);\ng();")] == ["loop", "do"]


@pytest.mark.parametrize("symbol", ["<", ">", "<=", ">=", "==", "!="])
def test_operators_as_arguments_of_a_condition(symbol: str) -> None:
    program = read_cpp(f"void f() {{\n#if VERSION({symbol}, 1, 2)\n g();\n#else\n h();\n#endif\n}}")
    assert program.problems == ()
    (found,) = function(f"void f() {{\n#if VERSION({symbol}, 1, 2)\n g();\n#else\n h();\n#endif\n}}", "f").body or ()
    assert [(line, text) for line, _, text, _ in found[1]] == [(2, f"#if VERSION({symbol}, 1, 2)"), (4, "#else")]


def test_attributes_with_a_text() -> None:
    text = 'class K {\npublic:\n [[deprecated("use (b)")]] bool a(int i);\n [[nodiscard]] int b();\n'
    program = read_cpp(text + ' std::string s = "[[deprecated]]";\n};')
    assert program.problems == ()
    assert [(each.name, each.line, each.column) for each in program.functions] == [("K::a", 3, 33), ("K::b", 4, 20)]
    assert program.classes[0].fields[0].init == ("=", ("str", "[[deprecated]]"))


@pytest.mark.parametrize(
    "text",
    ["FOO_A(", ";FOO_A(x)\n", ";FOO_A(x) ", '[[a("b"', "#if A(<", ", typename a::b", "FOO_A(a;", "->*", ";FOO_A((a)"],
)
def test_much_of_it_is_read_to_its_end(text: str) -> None:
    assert len(read_cpp(text * 2000).problems) <= 5


def test_directives_behind_a_digraph() -> None:
    same = "void f() {{\n{hash}ifdef A\n  a();\n{hash}else\n  b();\n{hash}endif\n}}\n"
    assert read_cpp(same.format(hash="%:")) == read_cpp(same.format(hash="# "))
    assert value('"%:if"') == ("str", "%:if")
    assert not read_cpp("int f(int a) { return 7 %a; }\n").problems


def test_brackets_in_other_letters() -> None:
    code = 'void f(T n) { int a[ 3] = { 1} ; auto g = [ &] (int i) { n.pub<T>("b", a[ 0] ); } ; } '
    digraphs = code.replace("[ ", "<:").replace("] ", ":>").replace("{ ", "<%").replace("} ", "%>")
    assert not {*"{}["} & {*digraphs}
    assert read_cpp(digraphs) == read_cpp(code)
    assert read_cpp("int f() { int a<::> = <%1%>; }") == read_cpp("int f() { int a[  ] = { 1} ; }")


@pytest.mark.parametrize(
    "code", ["v<::A> x;", 'auto x = "<: %> :>";', 'auto x = R"(<%)";', "auto x = '%>';", "auto x = a<b::c>(0);"]
)
def test_what_is_no_bracket(code: str) -> None:
    assert readable(code) == code
