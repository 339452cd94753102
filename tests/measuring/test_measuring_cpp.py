# SPDX-License-Identifier: Apache-2.0
"""C++ functions measured: every construct by hand."""

from __future__ import annotations

import pytest

from haros_ci.measuring.cpp import read_cpp
from haros_ci.measuring.facts import DEEPEST, MOST_PATHS, FunctionFacts


def only(body: str) -> FunctionFacts:
    facts = read_cpp(f"void f()\n{{\n{body}\n}}\n")
    assert facts.problems == ()
    (function,) = facts.functions
    return function


@pytest.mark.parametrize(
    ("body", "paths"),
    [
        ("", 1),
        ("a(); b(); c = 1;", 1),
        ("if (a) { b(); }", 2),
        ("if (a) b(); else c();", 2),
        ("if (a) {} if (b) {} if (c) {}", 8),
        ("if (a) { if (b) {} }", 3),
        ("if (a) {} else if (b) {} else if (c) {} else {}", 4),
        ("if (a) {} else if (b) {}", 3),
        ("if (a && b || c) {}", 4),
        ("if (a and b or c) {}", 4),
        ("if (int a = b(); a && c) {}", 3),
        ("if constexpr (a) {} else {}", 2),
        ("while (a) {}", 2),
        ("while (a && b) { if (c) {} }", 4),
        ("do { if (c) {} } while (a);", 3),
        ("for (int i = 0; i < n; ++i) {}", 2),
        ("for (;;) { while (a) {} }", 3),
        ("for (int i = a ? 1 : 2; i < n && b; ++i) {}", 5),
        ("for (auto & a : b) { if (a) {} }", 3),
        ("BOOST_FOREACH(auto a, b) { if (a) {} }", 3),
        ("switch (a) { case 1: b(); break; case 2: c(); break; default: d(); }", 3),
        ("switch (a) { case 1: b(); break; case 2: c(); }", 3),
        ("switch (a) { case 1: case 2: case 3: b(); break; default: c(); }", 2),
        ("switch (a) { case 1: if (b) {} case 2: c(); default: d(); }", 4),
        ("switch (a) { case 1: { if (b) {} break; } }", 3),
        ("switch (a) {}", 1),
        ("x = a ? b : c;", 2),
        ("x = a ? b : c ? d : e;", 4),
        ("return a && b;", 1),
        ("return a && b && c;", 2),
        ("try { a(); } catch (E & e) { b(); } catch (...) {}", 3),
        ("try { if (a) {} } catch (...) { if (b) {} }", 4),
        ("auto g = [&](int i) { if (i) {} };", 2),
        ("g([] { if (i) {} }); g([] { if (i) {} });", 3),
        ("g([] { h(); });", 1),
        ("label: if (a) goto label;", 2),
        ("#if A\nif (a) {}\n#else\nwhile (b) {} while (c) {}\n#endif", 2),
        ("#if 0\nif (a) {}\n#else\nwhile (b) {} while (c) {}\n#endif", 4),
        ("#ifdef A\nif (a) {\n#else\nif (b) {\n#endif\n}", 2),
        ("auto && x = std::move(y); T && z = w;", 1),
        ('log("if (a) && b ? c : d"); // if (a) while (b)', 1),
    ],
)
def test_paths(body: str, paths: int) -> None:
    assert only(body).paths == paths


def test_paths_are_bounded() -> None:
    assert only("if (a) {}\n" * 200).paths == MOST_PATHS
    assert only("g([] { " + "if (a) {}\n" * 40 + "});").paths == MOST_PATHS


@pytest.mark.parametrize(
    ("body", "nesting"),
    [
        ("", 0),
        ("a(); { { b(); } }", 0),
        ("if (a) {}", 1),
        ("if (a) {} else if (b) {} else if (c) {}", 1),
        ("if (a) {} else { if (b) {} }", 2),
        ("if (a)\n  for (;;)\n    while (b)\n      c();", 3),
        ("do { switch (a) { case 1: if (b) {} } } while (c);", 3),
        ("try { if (a) {} } catch (...) { if (b) { if (c) {} } }", 3),
        ("if (a) { g([] { for (;;) {} }); }", 2),
        ("x = a ? b : c && d;", 0),
        ("if (a) {} for (;;) {} while (b) {}", 1),
        ("struct L { void m() { if (a) { if (b) {} } } };", 0),
    ],
)
def test_nesting(body: str, nesting: int) -> None:
    functions = read_cpp(f"void f()\n{{\n{body}\n}}\n").functions
    assert functions[0].nesting == nesting


@pytest.mark.parametrize(
    ("body", "calls", "distinct"),
    [
        ("a(); b(); a();", 3, 2),
        ("x.size(); y->size(); z.w.size();", 3, 1),
        ("A::f(); B::f(); f();", 3, 3),
        ("f<int>(); f<double>(); x.g<T>(1);", 3, 2),
        ("a(b(c()));", 3, 3),
        ("x.a().b()->c();", 3, 3),
        ("(*p)(1); q[0](2);", 2, 2),
        ("std::string(a); Foo(b);", 2, 2),
        ("if (a()) {} for (int i = b(); c(i); d()) {}", 4, 4),
        ("g([&] { h(); });", 2, 2),
        ("RCLCPP_INFO(get_logger(), a());", 2, 2),
        # quiet: no calls
        ("", 0, 0),
        ("int x(3); Foo y{1}; auto z = new Foo(2); delete z;", 0, 0),
        ("x = static_cast<int>(y) + int(z) + sizeof(w) + (double)(v);", 0, 0),
        ("assert(x); EXPECT_TRUE(y); x = y + z << w;", 0, 0),
        ("typeid(x); decltype(y) z; alignof(T);", 0, 0),
        ("// f();\n/* g(); */", 0, 0),
    ],
)
def test_calls(body: str, calls: int, distinct: int) -> None:
    function = only(body)
    assert (function.calls, function.distinct) == (calls, distinct)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("namespace a { class B { void c() {} }; }", ["a::B::c"]),
        ("namespace a::b { inline namespace v1 { void c() {} } }", ["a::b::c"]),
        ("namespace { void c() {} }", ["c"]),
        ("void a::B::c() const {}", ["a::B::c"]),
        ("A::A() : x(1) { } A::~A() { }", ["A::A", "A::~A"]),
        ("A::A() try : x(f()) { } catch (...) { }", ["A::A"]),
        ("template <typename T> void A<T>::f() {}", ["A::f"]),
        ("bool operator << (int a, int b) {} A::operator bool() const {}", ["operator<<", "A::operator bool"]),
        ("class A { class B { void c() {} }; void d() {} };", ["A::B::c", "A::d"]),
        ("class A { friend void f() {} };", ["f"]),
        ("auto f() -> int { return 1; }", ["f"]),
        ("TEST_F(Fixture, does_it) { }", ["TEST_F(Fixture, does_it)"]),
        ('extern "C" { void f() {} }', ["f"]),
        ("int main() { struct L { void m() {} }; }", ["main", "main::L::m"]),
        ("class API_EXPORT A { void f() {} };", ["A::f"]),
        ("struct A { void f() const LIB_NOEXCEPT { } bool g() LIB_NOEXCEPT { } };", ["A::f", "A::g"]),
        ("template <class T>\nLIB_INLINE A<T>::A(int x) : x_{x} {}", ["A::A"]),
        ("#ifndef X_H\n#define X_H\nvoid f() {}\n#endif", ["f"]),
        ("int f(a, b) int a; char * b; { if (a) {} }\nint g() {}", ["f", "g"]),
        # quiet: no functions
        ("", []),
        ("void f(); class A; struct B { B() = default; B(const B &) = delete; virtual void g() = 0; };", []),
        ("#define F(x) void f() { if (x) {} }", []),
        ("int x = f(3); using A = B; typedef int C;", []),
        ("auto l = [] { return 1; };", []),
        ("#if A\n#elif B\nvoid f() {}\n#endif", []),
    ],
)
def test_functions(text: str, names: list[str]) -> None:
    assert [each.name for each in read_cpp(text).functions] == names


def test_a_constructor_is_its_initialisers_too() -> None:
    (function,) = read_cpp("A::A(int a) : B(f(a)), c_(a ? 1 : g()) { h(); }").functions
    assert (function.calls, function.paths, function.complexity) == (3, 2, 2)


def test_the_place_is_the_name() -> None:
    (function,) = read_cpp("template<class T>\nvoid\nA::f(\n  int a)\n{\n}\n").functions
    assert (function.line, function.column) == (3, 1)


@pytest.mark.parametrize(
    ("text", "methods", "available"),
    [
        ("class A { public: void f(); int g() { return 1; } };", 2, 2),
        ("struct A { void f(); private: void g(); protected: void h(); public: void i(); };", 4, 2),
        ("class A { void f(); };", 1, 0),
        ("class A { public: A(); A(int); ~A(); void f(); };", 4, 1),
        ("class A { public: A & operator=(const A &) = delete; bool operator==(const A &) const; };", 2, 1),
        ("class A { public: operator bool() const; virtual void f() = 0; static int g(); };", 3, 3),
        ("class A { public: template <class T> void f(T t); template <class T> T g() { return T(); } };", 2, 2),
        ("class A { public: void f(int); void f(double); };", 2, 2),
        ("class A { public:\n#ifdef X\nvoid f();\n#else\nvoid g();\n#endif\n};", 1, 1),
        # quiet: no methods
        ("class A { public: int x; int (*callback)(int); std::function<void()> g; };", 0, 0),
        ("class A { public: friend void f(); friend bool operator==(A, A) { return true; } };", 0, 0),
        ("class A { public: class B { public: void f(); }; enum C { D }; using E = int; };", 0, 0),
        ("class A { public: SMART_PTR(A) Q_OBJECT };", 0, 0),
    ],
)
def test_methods(text: str, methods: int, available: int) -> None:
    found = next(each for each in read_cpp(text).classes if each.name == "A")
    assert (found.methods, found.available) == (methods, available)


def test_a_broken_function_is_told_of_and_costs_no_other() -> None:
    facts = read_cpp("void f() { if (a { } }\nvoid g() { if (a) {} }\nvoid h() { else } \n")
    assert [(each.name, each.paths) for each in facts.functions if each.name == "g"] == [("g", 2)]
    assert facts.problems
    assert all("not" in message for _, message in facts.problems)


def test_what_is_nested_too_deeply_is_told_of() -> None:
    deep = DEEPEST + 20
    facts = read_cpp("void f() { " + "if (a) { " * deep + "}" * deep + " }\nvoid g() {}\n")
    assert [each.name for each in facts.functions] == ["f", "g"]
    assert [message for _, message in facts.problems] == ["nested too deeply: what is inside is not measured"]


@pytest.mark.parametrize("text", ["\0\0\0", "((((((((((" * 5000, "{" * 100_000, "a" * 4_000_001, "void f() {" * 3000])
def test_hostile_text_is_bounded(text: str) -> None:
    facts = read_cpp(text)
    assert len(facts.problems) <= 5
    assert all(len(each.name) < 10_000_000 for each in facts.functions)
