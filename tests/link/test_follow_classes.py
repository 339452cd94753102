# SPDX-License-Identifier: Apache-2.0
"""C++ classes: members, inheritance, templates, smart pointers, and which of several things of one name is meant."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, PUBLISH, admits, because, case, cpp, follow, names, table, types, well_formed

OUTSIDE = "#include <string>\n#include <memory>\nbool cond();\nstd::string text();\n"
#: A class around ``s``; its methods and constructors stand for ``BODY``.
PUB = "ros::NodeHandle nh; ros::Publisher p; void start() { p = ADV(s, 1); } "


def a_class(body: str) -> str:
    return "struct C { " + PUB + body + " };"


RESOLVED = (
    case(
        "reference to a member that is initialised later",
        "D d(nh);",
        "/a",
        before=(
            "struct R { R(std::string& x) : r(x) {} std::string& r; };\n"
            'struct D { D(ros::NodeHandle& nh) : c(s), s("a") { ADV(c.r, 1); } R c; std::string s; };'
        ),
    ),
    case(
        "such a reference to what is set again",
        "D d(nh);",
        "/b",
        before=(
            "struct R { R(std::string& x) : r(x) {} std::string& r; };\n"
            'struct D { D(ros::NodeHandle& nh) : c(s), s("a") { s = "b"; ADV(c.r, 1); } R c; std::string s; };'
        ),
    ),
    case(
        "the method of a base, which that inherits",
        "D d; d.go();",
        "/a",
        before=a_class('std::string s; virtual void set() { s = "a"; }')
        + " template<typename T> struct M : C {}; struct B : M<int> { B() : M<int>() {} };"
        + ' struct D : B { virtual void set() { s = "b"; } void go() { B::set(); start(); } };',
    ),
    case(
        "its own method by the name of the class",
        "D d; d.go();",
        "/b",
        before=a_class('std::string s; virtual void set() { s = "a"; }')
        + ' struct D : C { virtual void set() { s = "b"; } void go() { D::set(); start(); } };',
    ),
    case("set in the constructor", "C c;", "/a", before=a_class('std::string s; C() { s = "a"; start(); }')),
    case("set in the list", "C c; c.start();", "/a", before=a_class('std::string s; C() : s("a") {}')),
    case("set in the list by braces", "C c; c.start();", "/a", before=a_class('std::string s; C() : s{"a"} {}')),
    case("default member initialiser", "C c; c.start();", "/a", before=a_class('std::string s = "a";')),
    case("list before default", "C c; c.start();", "/b", before=a_class('std::string s = "a"; C() : s("b") {}')),
    case(
        "constructor's argument",
        'C c("a"); c.start();',
        "/a",
        before=a_class("std::string s; C(const std::string& n) : s(n) {}"),
    ),
    case(
        "constructor's default",
        "C c; c.start();",
        "/a",
        before=a_class('std::string s; C(std::string n = "a") : s(n) {}'),
    ),
    case(
        "delegating constructor",
        "C c; c.start();",
        "/a",
        before=a_class('std::string s; C(std::string n) : s(n) {} C() : C("a") {}'),
    ),
    case(
        "delegating constructor of a template, by its class",
        "C<int> c; c.start();",
        "/a",
        before="template<typename T> " + a_class('std::string s; C(std::string n) : s(n) {} C() : C<T>::C("a") {}'),
    ),
    case(
        "overloaded methods by type",
        'C c; c.go("x");',
        "/b",
        before=(
            'struct C { ros::NodeHandle nh; void go(int i) { ADV("a", 1); } void go(const '
            'std::string& s) { ADV("b", 1); } };'
        ),
    ),
    case(
        "constructors by type",
        'C c("x"); c.start();',
        "/b",
        before=a_class('std::string s; C(int i) : s("a") {} C(const char* t) : s("b") {}'),
    ),
    case(
        "overloaded methods by class",
        "C c; D d; c.go(d);",
        "/b",
        before=(
            "struct B { }; struct D : B { }; struct C { ros::NodeHandle nh; void go(const std::string& s) "
            '{ ADV("a", 1); } void go(const B& b) { ADV("b", 1); } };'
        ),
    ),
    case(
        "delegating constructors by type",
        'C c("x"); c.start();',
        "/load_x",
        before=(
            "struct L { std::string n; L(const std::string& n) : n(n) {} };"
            "typedef std::shared_ptr<L> LPtr; struct C { ros::NodeHandle root; std::string s;"
            "C(const std::string& d, int i = 0) : C(std::make_shared<L>(d), i) {}"
            'C(const std::shared_ptr<L>& l, int i) : s("load_" + l->n) {}'
            "void start() { root.advertise<std_msgs::String>(s, 1); } };"
        ),
    ),
    case(
        "delegating constructors by a pointer's name",
        'C c("x"); c.start();',
        "/load_x",
        before=(
            "FORWARD(L) struct L { std::string n; L(const std::string& n) : n(n) {} };"
            "struct C { ros::NodeHandle root; std::string s;"
            "C(const std::string& d, int i = 0) : C(std::make_shared<L>(d), i) {}"
            'C(const LPtr& l, int i) : s("load_" + l->n) {}'
            "void start() { root.advertise<std_msgs::String>(s, 1); } };"
        ),
    ),
    case(
        "another method",
        "C c; c.set(); c.start();",
        "/b",
        before=a_class('std::string s = "a"; void set() { s = "b"; }'),
    ),
    case(
        "this->", "C c; c.set(); c.start();", "/b", before=a_class('std::string s = "a"; void set() { this->s = "b"; }')
    ),
    case(
        "two objects",
        'C c("a"), d("b"); c.start(); d.start();',
        "/a",
        "/b",
        before=a_class("std::string s; C(std::string n) : s(n) {}"),
    ),
    case(
        "order of members", "C c; c.start();", "/a/x", before=a_class('std::string t = "a"; std::string s = t + "/x";')
    ),
    case(
        "method outside the class",
        "C c; c.go();",
        "/a",
        before=a_class("std::string s; void go();") + 'void C::go() { s = "a"; start(); }',
    ),
    case("new", "C* c = new C(); c->start();", "/a", before=a_class('std::string s = "a";')),
    case("make_shared", "auto c = std::make_shared<C>(); c->start();", "/a", before=a_class('std::string s = "a";')),
    case(
        "shared_ptr of new", "boost::shared_ptr<C> c(new C); c->start();", "/a", before=a_class('std::string s = "a";')
    ),
    case("unique_ptr", "std::unique_ptr<C> c(new C); c->start();", "/a", before=a_class('std::string s = "a";')),
    case("reset", "std::shared_ptr<C> c; c.reset(new C); c->start();", "/a", before=a_class('std::string s = "a";')),
    case(
        "member of base",
        "D d; d.start();",
        "/b",
        before=a_class('std::string s = "a";') + 'struct D : C { D() { s = "b"; } };',
    ),
    case(
        "base constructor",
        "D d; d.start();",
        "/b",
        before=a_class("std::string s; C(std::string n) : s(n) {}") + 'struct D : C { D() : C("b") {} };',
    ),
    case(
        "inherited constructor's body",
        "D d;",
        "/a",
        before=a_class('std::string s = "a"; C() { start(); }') + "struct D : C { };",
    ),
    case(
        "override by pointer",
        "C* c = new D; c->go();",
        "/b",
        before=a_class('std::string s; virtual std::string name() { return "a"; } void go() { s = name(); start(); }')
        + 'struct D : C { std::string name() override { return "b"; } };',
    ),
    case(
        "override called by this",
        "D d; d.go();",
        "/b",
        before=a_class(
            'std::string s; virtual std::string name() { return "a"; } void go() { s = this->name(); start(); }'
        )
        + 'struct D : C { std::string name() { return "b"; } };',
    ),
    case(
        "pure virtual",
        "D d; d.go();",
        "/b",
        before=a_class("std::string s; virtual std::string name() = 0; void go() { s = name(); start(); }")
        + 'struct D : C { std::string name() { return "b"; } };',
    ),
    case(
        "inherited method without this",
        "D d; d.go();",
        "/a",
        before=a_class('std::string s = "a";') + "struct D : C { void go() { start(); } };",
    ),
    case(
        "inherited method of a template",
        "D<int> d; d.go();",
        "/a",
        before="template <class T> "
        + a_class('std::string s = "a";')
        + "template <class T> struct D : C<T> { void go() { this->start(); } };",
    ),
    case(
        "base's own by name",
        "D d; d.go();",
        "/a",
        before=a_class('std::string s; virtual std::string name() { return "a"; }')
        + 'struct D : C { std::string name() { return "b"; } void go() { s = C::name(); start(); } };',
    ),
    case(
        "member hides a global",
        "C c; c.start();",
        "/a",
        before='std::string s = "b"; ' + a_class('std::string s = "a";'),
    ),
    case(
        "static constant",
        "C c; c.go();",
        "/a",
        before=a_class('std::string s; static constexpr const char* S = "a"; void go() { s = S; start(); }'),
    ),
    case(
        "nested namespaces",
        "a::b::C c; c.start();",
        "/a",
        before="namespace a { namespace b { " + a_class('std::string s = "a";') + " } }",
    ),
    case(
        "wrapper of one's own",
        'W w(nh, "a");',
        "/a",
        before=(
            "class W { ros::Publisher p; public: W(ros::NodeHandle& nh, const std::string& s) : p(ADV(s, 1)) {} };"
        ),
    ),
    case(
        "wrapper in a member",
        "V v;",
        "/a",
        before=(
            "class W { ros::Publisher p; public: void init(ros::NodeHandle nh, std::string s) { "
            'p = ADV(s, 1); } }; struct V { W w; V() { ros::NodeHandle nh; w.init(nh, "a"); } };'
        ),
    ),
    case(
        "objects in a vector",
        (
            'std::vector<std::shared_ptr<C>> v; v.push_back(std::make_shared<C>("a")); '
            'v.push_back(std::make_shared<C>("b")); for (auto& c : v) c->start();'
        ),
        "/a",
        "/b",
        before=a_class("std::string s; C(std::string n) : s(n) {}"),
    ),
    case(
        "functor",
        'F f; ADV(f("a"), 1);',
        "/ab",
        before='struct F { std::string operator()(std::string s) const { return s + "b"; } };',
    ),
    case("copy of an object", "C c; C d(c); d.start();", "/a", before=a_class('std::string s = "a";')),
)

NOT_SURE = (
    case(
        "copy of a member that is initialised later",
        "D d(nh);",
        "/?",
        before='struct D { D(ros::NodeHandle& nh) : t(s), s("a") { ADV(t, 1); } std::string t; std::string s; };',
    ),
    case(
        "member under #if",
        "C c; ADV(c.s, 1);",
        "/a|/b",
        before='struct C {\n#ifdef X\nstd::string s = "a";\n#else\nstd::string s = "b";\n#endif\n};',
    ),
    case(
        "counted by itself",
        "C c; c.f(nh); c.f(nh);",
        "/a0",
        "/a1",
        before='struct C { int n = 0; void f(ros::NodeHandle& nh) { ADV("a" + std::to_string(n++), 1); } };',
    ),
    case(
        "specialised class template",
        "ADV(T<int>::f(), 1);",
        "/b",
        before='template <class X> struct T { static std::string f() { return "a"; } };'
        'template <> struct T<int> { static std::string f() { return "b"; } };',
    ),
    case(
        "function of the argument's namespace",
        "k::S s; ADV(name(s), 1);",
        "/b",
        before='namespace k { struct S {}; std::string name(S) { return "b"; } }'
        'struct U {}; std::string name(U) { return "a"; }',
    ),
    case(
        "template of a value",
        "ADV(T<3>().s(), 1);",
        "/a3",
        before='template <int N> struct T { std::string s() { return "a" + std::to_string(N); } };',
    ),
    case(
        "set by a method that is called sometimes",
        "C c; if (cond()) c.set(); c.start();",
        "/a|/b",
        before=a_class('std::string s = "a"; void set() { s = "b"; }'),
    ),
    case("set by what is not known", "C c; c.start();", "/?", before=a_class("std::string s; C() { s = text(); }")),
    case("member never set", "C c; c.start();", "/?", before=a_class("const char* s;")),
    case(
        "one object of two",
        'C c("a"), d("b"); C* e = cond() ? &c : &d; e->start();',
        "/a",
        "/b",
        before=a_class("std::string s; C(std::string n) : s(n) {}"),
    ),
    case(
        "virtual in the base's constructor",
        "D d;",
        "/a",
        before=a_class('std::string s; C() { s = name(); start(); } virtual std::string name() { return "a"; }')
        + 'struct D : C { std::string name() { return "b"; } };',
    ),
    case(
        "virtual without this",
        "D d; d.go();",
        "/b",
        before=a_class('std::string s; virtual std::string name() { return "a"; } void go() { s = name(); start(); }')
        + 'struct D : C { std::string name() { return "b"; } };',
    ),
    case(
        "virtual that advertises",
        "D d; d.go();",
        "/b",
        before=a_class('std::string s = "a"; virtual void init() { ADV("a", 1); } void go() { init(); }')
        + 'struct D : C { void init() { ADV("b", 1); } };',
    ),
    case(
        "override in a grandchild",
        "E e; e.go();",
        "/c",
        before=a_class(
            'std::string s; virtual std::string name() { return "a"; } void go() { s = this->name(); start(); }'
        )
        + ('struct D : C { std::string name() { return "b"; } }; struct E : D { std::string name() { return "c"; } };'),
    ),
    case("method of a base not known", "D d; ADV(d.name(), 1);", "/?", before="struct D : Elsewhere { };"),
    case(
        "const and not",
        "const C c; ADV(c.name(), 1);",
        "/b",
        before='struct C { std::string name() { return "a"; } std::string name() const { return "b"; } };',
    ),
    case(
        "conversion",
        "C c; std::string s = c; ADV(s, 1);",
        "/a",
        before='struct C { operator std::string() const { return "a"; } };',
    ),
    case(
        "assignment of one's own",
        'C c; c = std::string("x"); ADV(c.s, 1);',
        "/xy",
        before='struct C { std::string s; C& operator=(const std::string& t) { s = t + "y"; return *this; } };',
    ),
    case(
        "copy of one's own",
        "C c; C d(c); ADV(d.s, 1);",
        "/b",
        before='struct C { std::string s; C() { s = "a"; } C(const C& o) { s = "b"; } };',
    ),
    case("copied and changed", 'C c; C d(c); d.s = "b"; c.start();', "/a", before=a_class('std::string s = "a";')),
    case(
        "member of value",
        'D d; d.c.s = "b"; C e = d.c; e.s = "x"; ADV(d.c.s, 1);',
        "/b",
        before="struct C { std::string s; }; struct D { C c; };",
    ),
    case("aggregate", 'C c{"a"}; ADV(c.s, 1);', "/a", before="struct C { std::string s; };"),
    case("aggregate by =", 'C c = {"a", "b"}; ADV(c.t, 1);', "/b", before="struct C { std::string s, t; };"),
    case("aggregate over a default", 'C c{"a"}; ADV(c.s, 1);', "/a", before='struct C { std::string s = "x"; };'),
    case(
        "array of aggregates",
        'C v[] = {{"a"}, {"b"}}; for (auto& c : v) ADV(c.s, 1);',
        "/a",
        "/b",
        before="struct C { std::string s; };",
    ),
    case(
        "vector of aggregates",
        'std::vector<C> v = {{"a"}, {"b"}}; for (auto& c : v) ADV(c.s, 1);',
        "/a",
        "/b",
        before="struct C { std::string s; };",
    ),
    case("destructor", "{ C c; } ADV(s, 1);", "/b", before='std::string s = "a"; struct C { ~C() { s = "b"; } };'),
    case(
        "setter that is chained",
        'C c; c.set("b").set("c"); ADV(c.s, 1);',
        "/c",
        before="struct C { std::string s; C& set(std::string t) { s = t; return *this; } };",
    ),
    case(
        "pointer member that moves",
        "C c; c.move(); ADV(*c.p, 1);",
        "/b",
        before='struct C { std::string a = "a", b = "b"; std::string* p = &a; void move() { p = &b; } };',
    ),
    case(
        "static member counted",
        "C c, d; ADV(d.s, 1);",
        "/a2",
        before=('struct C { static int n; std::string s; C() { ++n; s = "a" + std::to_string(n); } }; int C::n = 0;'),
    ),
    case(
        "operator plus of one's own",
        'C c{"a"}, d{"b"}; C e = c + d; ADV(e.s, 1);',
        "/ba",
        before="struct C { std::string s; }; C operator+(const C& x, const C& y) { return C{y.s + x.s}; }",
    ),
    case(
        "comparison of one's own",
        'C c{1}, d{1}; ADV(c == d ? "a" : "b", 1);',
        "/b",
        before="struct C { int i; bool operator==(const C& o) const { return false; } };",
    ),
    case(
        "same pointer compared",
        'C c, d; C* p = &c; C* q = &d; ADV(p == q ? "a" : "b", 1);',
        "/b|/?",
        before="struct C { int i; };",
    ),
    case(
        "dynamic_cast",
        'C* c = new C; D* d = dynamic_cast<D*>(c); ADV(d ? "a" : "b", 1);',
        "/b",
        before="struct C { virtual ~C() {} }; struct D : C { };",
    ),
    case(
        "null after reset",
        'std::shared_ptr<C> c(new C); c.reset(); ADV(c ? "a" : "b", 1);',
        "/b",
        before="struct C { int i; };",
    ),
    case(
        "moved away",
        'std::unique_ptr<C> c(new C), d; d = std::move(c); ADV(c ? "a" : "b", 1);',
        "/b",
        before="struct C { int i; };",
    ),
    case(
        "shared by two",
        'auto c = std::make_shared<C>(); auto d = c; d->s = "b"; ADV(c->s, 1);',
        "/b",
        before='struct C { std::string s = "a"; };',
    ),
    case(
        "reference to a smart pointer's object",
        'auto c = std::make_shared<C>(); C& d = *c; d.s = "b"; ADV(c->s, 1);',
        "/b",
        before='struct C { std::string s = "a"; };',
    ),
    case(
        "copy of a smart pointer's object",
        'auto c = std::make_shared<C>(); C d = *c; d.s = "b"; ADV(c->s, 1);',
        "/a",
        before='struct C { std::string s = "a"; };',
    ),
    case("shared_ptr<std::string>", 'auto c = std::make_shared<std::string>("a"); *c = "b"; ADV(*c, 1);', "/b"),
    case(
        "shared_ptr<std::string> shared",
        'auto c = std::make_shared<std::string>("a"); auto d = c; *d = "b"; ADV(*c, 1);',
        "/b",
    ),
    case(
        "new std::string shared",
        'std::string* c = new std::string("a"); std::string* d = c; *d = "b"; ADV(*c, 1);',
        "/b",
    ),
    case(
        "friend that sets",
        "C c; f(c); ADV(c.s, 1);",
        "/b",
        before='class C { public: std::string s = "a"; friend void f(C& c); }; void f(C& c) { c.s = "b"; }',
    ),
    case(
        "union",
        'U u; u.i = 1; u.j = 2; ADV("a" + std::to_string(u.i), 1);',
        "/a2|/a?",
        before="union U { int i; int j; };",
    ),
)

#: Why a row does not hold yet.
DEFECTS = (
    because(
        ("overloads and specialisations are told apart by their number of arguments only (construct.overload)"),
        "function of the argument's namespace",
    )
    | because(
        "destructors are not called",
        "destructor",
    )
    | because(
        ("a pointer to text is the text itself, so other pointers to it do not see what is set (create, new)"),
        "shared_ptr<std::string> shared",
        "new std::string shared",
    )
    | because(
        "a union's members do not share their place",
        "union",
    )
)


@table(RESOLVED, DEFECTS)
def test_a_member_with_one_value_is_known(before: str, code: str, expected: list[str]) -> None:
    found = cpp(code, (OUTSIDE + before).replace("ADV(", "nh.advertise<std_msgs::String>("))
    assert names(found) == expected
    well_formed(found)


@table(NOT_SURE, DEFECTS)
def test_a_member_that_is_not_sure_is_not_told(before: str, code: str, expected: list[str]) -> None:
    found = cpp(code, OUTSIDE + before)
    assert admits(names(found), expected)
    well_formed(found)


#: (before, code, [(name, type)])
TYPES = (
    case(
        "class template",
        "W<std_msgs::Int32> w(nh);",
        "/a std_msgs/Int32",
        before=(
            'template <class T> struct W { ros::Publisher p; W(ros::NodeHandle& nh) { p = nh.advertise<T>("a", 1); } };'
        ),
    ),
    case(
        "function template",
        "f<std_msgs::Int32>(nh);",
        "/a std_msgs/Int32",
        before='template <typename T> void f(ros::NodeHandle& nh) { nh.advertise<T>("a", 1); }',
    ),
    case(
        "template twice",
        "f<std_msgs::Int32>(nh); f<std_msgs::Bool>(nh);",
        "/a std_msgs/Bool",
        "/a std_msgs/Int32",
        before='template <typename T> void f(ros::NodeHandle& nh) { nh.advertise<T>("a", 1); }',
    ),
    case(
        "deduced from an argument",
        "std_msgs::Int32 m; f(nh, m);",
        "/a std_msgs/Int32",
        before='template <typename T> void f(ros::NodeHandle& nh, const T& m) { nh.advertise<T>("a", 1); }',
    ),
    case("alias", 'nh.advertise<M>("a", 1);', "/a std_msgs/Int32", before="typedef std_msgs::Int32 M;"),
    case("using", 'nh.advertise<M>("a", 1);', "/a std_msgs/Int32", before="using M = std_msgs::Int32;"),
    case(
        "alias in a class",
        'nh.advertise<C::M>("a", 1);',
        "/a std_msgs/Int32",
        before="struct C { typedef std_msgs::Int32 M; };",
    ),
    case("namespace alias", 'nh.advertise<m::Int32>("a", 1);', "/a std_msgs/Int32", before="namespace m = std_msgs;"),
    case(
        "using-directive",
        'nh.advertise<Int32>("a", 1);',
        "/a std_msgs/Int32",
        before="#include <std_msgs/Int32.h>\nusing namespace std_msgs;",
    ),
    case(
        "template of a base",
        "D d;",
        "/a std_msgs/Int32",
        before=(
            'template <class T> struct B { ros::NodeHandle nh; B() { nh.advertise<T>("a", 1); } '
            "}; struct D : B<std_msgs::Int32> { };"
        ),
    ),
    case(
        "type of a trait",
        "W<int> w;",
        "/a None",
        before=(
            "template <class T> struct Trait; template <class T> struct W { ros::NodeHandle nh; "
            'W() { nh.advertise<typename Trait<T>::Message>("a", 1); } };'
        ),
    ),
    case(
        "trait of one's own",
        "W<C> w;",
        "/a std_msgs/Int32",
        before=(
            "struct C { typedef std_msgs::Int32 M; }; template <class T> struct W { "
            'ros::NodeHandle nh; W() { nh.advertise<typename T::M>("a", 1); } };'
        ),
    ),
    case(
        "class of the workspace",
        'nh.advertise<mine::Thing>("a", 1);',
        "/a None",
        before="namespace mine { struct Thing { int i; }; }",
    ),
    case(
        "template that is never bound",
        "g(nh);",
        "/a None",
        before=(
            'template <class T> void f(ros::NodeHandle& nh) { nh.advertise<T>("a", 1); } void '
            "g(ros::NodeHandle& nh) { f<Unheard>(nh); }"
        ),
    ),
)


@table(TYPES, DEFECTS)
def test_types_are_those_bound(before: str, code: str, expected: list[str]) -> None:
    assert [f"{name} {kind}" for name, kind in types(cpp(code, OUTSIDE + before))] == expected


def test_two_classes_of_one_name_in_two_packages_are_two() -> None:
    head = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
    one = 'struct C { ros::NodeHandle nh; C() { nh.advertise<std_msgs::String>("%s", 1); } };\n'
    run = 'int main(int c, char** v) { ros::init(c, v, "n"); C x; }\n'
    found = follow(
        {
            "a/CMakeLists.txt": CMAKE.format("a") + "add_executable(n main.cpp)\n",
            "a/main.cpp": head + one % "of_a" + run,
            "b/CMakeLists.txt": CMAKE.format("b") + "add_executable(n main.cpp)\n",
            "b/main.cpp": head + one % "of_b" + run,
        }
    )
    assert {c.name: names(c.nodes[0]) for c in found.configurations} == {"a/n": ["/of_a"], "b/n": ["/of_b"]}


def two_headers(kind: str) -> list[str]:
    """What ``main`` finds in ``b.h``, where ``a.h`` of the same package says something else."""
    found = cpp("ADV(NAME, 1);", '#include "b.h"\n', a__h=kind % "of_a", b__h=kind % "of_b")
    return names(found)


INCLUDED = {
    "macro": '#define NAME "%s"\n',
    "constant": '#include <string>\nconst std::string NAME = "%s";\n',
    "class": '#include <string>\nstruct K { std::string s = "%s"; };\nstatic K k;\n#define NAME k.s\n',
}


@pytest.mark.parametrize("kind", INCLUDED)
def test_what_a_header_says_that_is_not_included_does_not_count(kind: str) -> None:
    assert two_headers(INCLUDED[kind]) in (["/of_b"], ["/?"])


W = "struct W { ros::NodeHandle nh; W() { ADV_ } W(std::string s) { ADV(s, 1); } };".replace(
    "ADV_", 'ADV("w", 1);'
).replace("ADV(", PUBLISH)
#: Lists of pointers are made without what they point to; lists of objects and numbers are not.
SIZED = (
    case("pointers", "std::vector<W*> v; v.resize(2);", before=W),
    case("pointers at once", "std::vector<W*> v(2);", before=W),
    case("shared pointers", "std::vector<std::shared_ptr<W>> v; v.resize(2);", before=W),
    case("one more pointer", "std::vector<W*> v; v.emplace_back();", before=W),
    case("pointers that are set", 'std::vector<W*> v; v.resize(2); v[1] = new W("a");', "/a", before=W),
    case("objects", "std::vector<W> v; v.resize(2);", "/w", before=W),
    case("objects at once", "std::vector<W> v(2);", "/w", before=W),
    case("numbers", 'std::vector<int> v; v.resize(2); ADV("n" + std::to_string(v[1]), 1);', "/n0"),
    case("numbers of a value", 'std::vector<int> v; v.resize(2, 7); ADV("n" + std::to_string(v[1]), 1);', "/n7"),
    case("a number is kept", 'std::vector<int> v = {5}; v.resize(2, 7); ADV("n" + std::to_string(v[0]), 1);', "/n5"),
)


@table(SIZED)
def test_lists_of_a_size(before: str, code: str, expected: list[str]) -> None:
    assert sorted(set(names(cpp(code, "#include <vector>\n#include <memory>\n" + before)))) == expected
