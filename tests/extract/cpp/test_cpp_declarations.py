# SPDX-License-Identifier: Apache-2.0
"""Functions, classes, variables, aliases, macros and registrations at namespace and class scope."""

from __future__ import annotations

from typing import Any

import pytest
from cpp_kit import T, function
from syntax_kit import read_cpp

from haros_ci.syntax import Alias, Class, Field, Parameter, Program


def names(program: Program) -> list[tuple[str, str, str]]:
    return [(each.kind, each.name, each.owner) for each in program.functions]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("void f() {}", ("function", "f", "")),
        ("void f();", ("function", "f", "")),
        ("auto f() -> int {}", ("function", "f", "")),
        ("A *f() {}", ("function", "f", "")),
        ("namespace a { namespace b { void f(); } }", ("function", "a::b::f", "a::b")),
        ("namespace a::b { void f(); }", ("function", "a::b::f", "a::b")),
        ("namespace { void f(); }", ("function", "f", "")),
        ("namespace a { namespace { void f(); } }", ("function", "a::f", "a")),
        ("inline namespace v1 { void f(); }", ("function", "f", "")),
        ('extern "C" { void f(); }', ("function", "f", "")),
        ('extern "C" void f();', ("function", "f", "")),
        ("void A::f() {}", ("function", "A::f", "A")),
        ("namespace n { void A::f() {} }", ("function", "n::A::f", "n::A")),
        ("template <class T> void A<T>::f() {}", ("function", "A::f", "A")),
        ("A::A() {}", ("constructor", "A::A", "A")),
        ("A<T>::A() {}", ("constructor", "A::A", "A")),
        ("n::A::A() {}", ("constructor", "n::A::A", "n::A")),
        ("A::~A() {}", ("destructor", "A::~A", "A")),
        ("void foo::foo() {}", ("function", "foo::foo", "foo")),
        ("struct A { A(); };", ("constructor", "A::A", "A")),
        ("struct A { explicit A(int) {} };", ("constructor", "A::A", "A")),
        ("struct A { virtual ~A() = default; };", ("destructor", "A::~A", "A")),
        ("struct A { struct B { void f() {} }; };", ("function", "A::B::f", "A::B")),
        ("struct A { bool operator()(int) const; };", ("function", "A::operator()", "A")),
        ("struct A { operator bool() const { return 1; } };", ("function", "A::operator bool", "A")),
        ("A::operator bool() {}", ("function", "A::operator bool", "A")),
        ("A &A::operator=(const A &) {}", ("function", "A::operator=", "A")),
        ("namespace n { struct A { friend void f() {} }; }", ("function", "n::f", "n")),
        ("FOO_EXPORT void f() {}", ("function", "f", "")),
        ("TEST(A, b) { }", ("function", "TEST", "")),
    ],
)
def test_function_names(text: str, expected: Any) -> None:
    assert names(read_cpp(text)) == [expected]


def test_a_function_has_all_its_parts() -> None:
    text = "template <typename T, int N, class... R>\nstatic void\nf(int a, const T &b = 3, R&&... c, char *)\n{\n}\n"
    found = function(text, "f")
    assert found.parameters == (
        Parameter("a", T("int")),
        Parameter("b", T("T", marks="c&"), ("num", 3)),
        Parameter("*c", T("R", marks="&&")),
        Parameter("", T("char", marks="*")),
    )
    assert (found.line, found.column, found.body_line, found.body_column) == (3, 1, 4, 1)
    assert (found.templates, found.is_static, found.is_virtual, found.returns) == (
        ("T", "N", "R"),
        True,
        False,
        T("void"),
    )
    assert found.body == ()


def test_parameters() -> None:
    text = "void f(void); void g(int a[], int (*b)(char), std::function<void()> c, ...); void h(A a = B(1));"
    one, two, three = read_cpp(text).functions
    assert one.parameters == ()
    assert two.parameters == (
        Parameter("a", T("int", marks="*")),
        Parameter("b", ("()", (T("int"), T("char")), "*")),
        Parameter("c", T("std::function", ("()", (T("void"),), ""))),
    )
    assert three.parameters == (Parameter("a", T("A"), ("call", ("name", "B"), (("num", 1),), (), 1, 91)),)


def test_virtual_and_bodiless_methods() -> None:
    text = "struct A { virtual void a() = 0; void b() override; static void c(); void d() = delete; A() = default; };"
    found = read_cpp(text).functions
    assert [(each.is_virtual, each.is_static, each.body) for each in found] == [
        (True, False, None),
        (True, False, None),
        (False, True, None),
        (False, False, None),
        (False, False, None),
    ]


def test_initialisers() -> None:
    found = function('A::A(B b) : C<int>(b), d_{1, 2},\n  e_("x") { }', "A::A")
    assert found.inits == (
        ("C", T("C", T("int")), (("name", "b"),), 1, 13, ()),
        ("d_", T("d_"), (("num", 1), ("num", 2)), 1, 24, ()),
        ("e_", T("e_"), (("str", "x"),), 2, 3, ()),
    )
    assert (found.body_line, found.body_column) == (2, 11)


def test_function_try_blocks() -> None:
    found = function("A::A() try : a(1) { g(); } catch (...) { }", "A::A")
    assert found.inits == (("a", T("a"), (("num", 1),), 1, 14, ()),)
    call = ("do", ("call", ("name", "g"), (), (), 1, 21))
    assert found.body == (("try", (call,), ((1, 28, "...", "", T(""), ()),)),)
    assert (found.body_line, found.body_column) == (1, 19)


def test_classes() -> None:
    text = (
        "namespace n {\n"
        "template <class T> class A final : public virtual B<T>, private c::D {\n"
        "  int a, *b = nullptr;\n"
        '  static constexpr const char *C = "x";\n'
        "  E e{1}; std::function<void(int)> f; mutable M m : 3;\n"
        "  struct I { int i; };\n"
        "  union { int u; };\n"
        "  class F; friend class G;\n"
        "};\n"
        "struct X;\n"
        "}\n"
    )
    program = read_cpp(text)
    assert program.classes == (
        Class(
            "n::A",
            (T("B", T("T")), T("c::D")),
            (
                Field("a", T("int"), None, 3, 7),
                Field("b", T("int", marks="*"), ("=", ("none",)), 3, 11),
                Field("C", T("char", marks="c*"), ("=", ("str", "x")), 4, 32, True),
                Field("e", T("E"), ("{", (("num", 1),)), 5, 5),
                Field("f", T("std::function", ("()", (T("void"), T("int")), "")), None, 5, 36),
                Field("m", T("M"), None, 5, 49),
                Field("u", T("int"), None, 7, 15),
            ),
            2,
            26,
            ("T",),
        ),
        Class("n::A::I", (), (Field("i", T("int"), None, 6, 18),), 6, 10),
    )
    assert (program.variables, program.functions, program.problems) == ((), (), ())


@pytest.mark.parametrize(
    "head",
    [
        "class A_EXPORT K",
        "class ROSCPP_DECL K",
        "struct my_API K",
        "class FOO(1) K",
        "class [[nodiscard]] K final",
        "class A_EXPORT K final",
    ],
)
def test_macros_in_class_heads(head: str) -> None:
    (found,) = read_cpp(f"{head} : public B {{ int a; }};").classes
    assert (found.name, found.bases, len(found.fields), found.column) == ("K", (T("B"),), 1, head.index("K") + 1)


def test_macros_in_class_bodies() -> None:
    text = "class K : public Q {\n Q_OBJECT\npublic Q_SLOTS:\n void a();\n"
    text += " RCLCPP_SMART_PTR_DEFINITIONS(K)\nsignals:\n void b();\n int c; };"
    program = read_cpp(text)
    assert [each.name for each in program.functions] == ["K::a", "K::b"]
    assert [each.name for each in program.classes[0].fields] == ["c"]
    assert program.problems == ()


def test_a_macro_alone_on_its_line_takes_nothing_with_it() -> None:
    text = "class K {\npublic:\n  EIGEN_MAKE_NEW // a\nprivate:\n  std::string a; // b\n  FOO_BAR\n  int b;\n};"
    (found,) = read_cpp(text).classes
    assert found.fields == (Field("a", T("std::string"), None, 5, 15), Field("b", T("int"), None, 7, 7))


def test_lambdas_in_members_know_their_class() -> None:
    found = read_cpp("struct A { F f = [this] { g(); }; };").functions
    assert names(read_cpp("struct A { F f = [this] { g(); }; };")) == [("lambda", "A::(lambda)", "A")]
    assert found[0].body == (("do", ("call", ("name", "g"), (), (), 1, 27)),)


def test_unnamed_classes() -> None:
    program = read_cpp("typedef struct { int a; } S, *P; struct { int b; } v;")
    assert [each.name for each in program.classes] == ["S", "(anonymous 1:34)"]
    assert program.aliases == (Alias("P", T("S", marks="*")),)
    assert program.variables == (Field("v", T("(anonymous 1:34)"), None, 1, 52),)


def test_variables() -> None:
    text = 'namespace n { static const std::string A = "x", B("y"); int c, *d; extern int e; extern int g = 1; }\n'
    text += "int n::K::s = 3;"
    constant = T("std::string", marks="c")
    assert read_cpp(text).variables == (
        Field("n::A", constant, ("=", ("str", "x")), 1, 40, True),
        Field("n::B", constant, ("(", (("str", "y"),)), 1, 49, True),
        Field("n::c", T("int"), None, 1, 61),
        Field("n::d", T("int", marks="*"), None, 1, 65),
        Field("n::g", T("int"), ("=", ("num", 1)), 1, 93),
        Field("n::K::s", T("int"), ("=", ("num", 3)), 2, 5),
    )


def test_enumerations() -> None:
    text = "namespace n { enum E { A, B = 5, C }; enum class F : int { D = 1 }; enum { G = X + 1, H }; }"
    computed = ("op", "+", (("name", "X"), ("num", 1)))
    assert [(each.name, each.type[0], each.init) for each in read_cpp(text).variables] == [
        ("n::E::A", "n::E", ("=", ("num", 0))),
        ("n::A", "n::E", ("=", ("num", 0))),
        ("n::E::B", "n::E", ("=", ("num", 5))),
        ("n::B", "n::E", ("=", ("num", 5))),
        ("n::E::C", "n::E", ("=", ("num", 6))),
        ("n::C", "n::E", ("=", ("num", 6))),
        ("n::F::D", "n::F", ("=", ("num", 1))),
        ("n::G", "int", ("=", computed)),
        ("n::H", "int", ("=", ("op", "+", (computed, ("num", 1))))),
    ]


def test_aliases_and_scopes() -> None:
    text = (
        "namespace n {\n"
        "using A = std::vector<int>; typedef A B, *C; typedef void (*D)(int); template <class T> using E = V<T>;\n"
        "using std::string; using namespace x::y; namespace fs = std::filesystem;\n"
        "struct K : L { using L::L; using M = int; };\n"
        "void f() { using namespace z; using N = int; }\n"
        "}"
    )
    program = read_cpp(text)
    assert program.aliases == (
        Alias("n::A", T("std::vector", T("int"))),
        Alias("n::B", T("A")),
        Alias("n::C", T("A", marks="*")),
        Alias("n::D", ("()", (T("void"), T("int")), "*")),
        Alias("n::E", T("V", T("T")), ("T",)),
        Alias("n::string", T("std::string")),
        Alias("n::fs", ("std::filesystem", (), "namespace")),
        Alias("n::K::M", T("int")),
        Alias("n::f::N", T("int")),
    )
    assert program.scopes == (("n", "x::y"), ("n::f", "z"))


def test_includes_and_macros() -> None:
    text = '#include <a/b.h>\n#  include "c.h" // d\n#define A 1 /* e */\n#define B(x, y) \\\n  x + y\n'
    text += "#define C\n#define D() d\n"
    program = read_cpp(text)
    assert program.includes == ("<a/b.h>", '"c.h"')
    assert program.macros == (("A", None, "1"), ("B", ("x", "y"), "x + y"), ("C", None, ""), ("D", (), "d"))


def test_registrations_with_and_without_semicolon() -> None:
    text = (
        "PLUGINLIB_EXPORT_CLASS(a::B, c::D)\n"
        "PLUGINLIB_DECLARE_CLASS(p, n, a::B<X>, c::D);\n"
        "namespace n {\n RCLCPP_COMPONENTS_REGISTER_NODE( a::B )\n}\n"
        "void f() {}\n"
    )
    program = read_cpp(text)
    assert program.registered == (
        ("PLUGINLIB_EXPORT_CLASS", ("a::B", "c::D"), 1, 1),
        ("PLUGINLIB_DECLARE_CLASS", ("p", "n", "a::B<X>", "c::D"), 2, 1),
        ("RCLCPP_COMPONENTS_REGISTER_NODE", ("a::B",), 4, 2),
    )
    assert [each.name for each in program.functions] == ["f"]


@pytest.mark.parametrize(
    ("head", "kept"),
    (
        ("#define KIND A\n", ("x::A",)),
        ("#define KIND 2\n", ("x::B",)),
        ("#define KIND 3\n", ("x::C",)),
        ("", ("x::A", "x::B", "x::C")),
        ("#ifndef KIND\n#define KIND A\n#endif\n", ("x::A", "x::B", "x::C")),
        ("#define KIND A\n#define KIND B\n", ("x::A", "x::B", "x::C")),
        ("#define KIND other()\n", ("x::A", "x::B", "x::C")),
        ("#define KIND KIND\n", ("x::A", "x::B", "x::C")),
    ),
)
def test_macros_of_branches_that_are_never_taken(head: str, kept: tuple[str, ...]) -> None:
    text = (
        "#define A 1\n#define B 2\n" + head + "#if KIND == A\n#define BASE x::A\n#elif KIND == B\n#define BASE x::B\n"
        "#else\n#define BASE x::C\n#endif\n"
    )
    assert tuple(body for name, _, body in read_cpp(text).macros if name == "BASE") == kept


def test_guards_around_functions() -> None:
    text = (
        "#ifndef A_H\n#define A_H\n"
        "void a();\n"
        "#if defined(X) && \\\n  Y\nvoid b();\n#ifdef Z\nvoid c();\n#endif\n"
        "#elif W\nvoid d();\n#else\nvoid e();\n#endif\n"
        "#if 0\nvoid f();\n#endif\n"
        "#ifdef __cplusplus\nvoid g();\n#endif\n"
        "#endif\n"
    )
    first = (4, 1, "#if defined(X) && Y")
    assert {each.name: each.guards for each in read_cpp(text).functions} == {
        "a": (),
        "b": (first,),
        "c": (first, (7, 1, "#ifdef Z")),
        "d": ((10, 1, "#elif W"),),
        "e": ((12, 1, "#else"),),
        "g": (),
    }


@pytest.mark.parametrize("comment", ["", "// NOLINT", "//NOLINT", "/* for the macro */", "// NOLINT\r"])
def test_a_comment_after_an_include_takes_nothing_of_the_next_line(comment: str) -> None:
    program = read_cpp(f"#include <macro.hpp> {comment}\nREGISTER(Talker)\n")
    assert program.includes == ("<macro.hpp>",)
    assert program.registered == (("REGISTER", ("Talker",), 2, 1),)
