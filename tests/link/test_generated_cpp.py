# SPDX-License-Identifier: Apache-2.0
"""C++ that generated programs had when they ran beside the model (tests/bench/run_oracle_cpp.py), class by class."""

from __future__ import annotations

import pytest
from follow_kit import cpp


def made(body: str, before: str = "") -> list[str]:
    """The publishers of a program, ``!`` for those that are ruled out, ``*`` for those that are made under a condition."""
    found = []
    for end in cpp(body, before).endpoints:
        is_conditional = end.conditions or end.early_ways or any(one.field == "conditions" for one in end.unknowns)
        if end.kind == "publishers":
            found.append(end.name + ("!" if end.is_ruled_out else "*" if is_conditional else ""))
    return sorted(found)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        # a part of a std::string is what stands behind a position
        ('std::string(std::string("hub"), 1)', "/?"),
        ("std::string(named(), 1)", "/?"),
        ("std::string(s, 1)", "/ub"),
        ("std::string(a ? s : t, 1)", "/?"),
        # of an array of characters it is the first ones
        ('std::string("hub", 1)', "/h"),
        ("std::string(s.c_str(), 1)", "/h"),
        ("std::string(s.data(), 2)", "/hu"),
        ("std::string(c, 2)", "/hu"),
        ('std::string("hub", 1, 1)', "/u"),
        ("std::string(s, 1, 1)", "/u"),
        ('std::string(std::string("hub"), 1, 1)', "/u"),
        ("std::string(2, 'c')", "/cc"),
    ],
)
def test_a_part_of_a_text_by_one_number(text: str, expected: str) -> None:
    before = 'std::string named() { return "hub"; }\n'
    body = f'std::string s = "hub", t = "gear"; bool a = x(); const char* c = "hub";\nADV({text}, 1);'
    assert [name.rstrip("*") for name in made(body, before)] == [expected]


#: What stands behind a return that is taken is there under its condition, so one level more.
DEEPER = 'void f(ros::NodeHandle& nh, const std::string& n, int d) {\nif (d <= 0) return;\nADV(n, 1);\nf(nh, n + "/d", d - 1);\n}\n'
LATER = (
    'void f(ros::NodeHandle& nh, const std::string& n, int d) {\nif (d > 1) f(nh, n + "/d", d - 1);\nADV(n, 1);\n}\n'
)
AGAIN = 'void f(ros::NodeHandle& nh, int d) {\nADV("a", 1);\nif (x()) f(nh, d + 1);\n}\n'
OPEN = 'void f(ros::NodeHandle& nh, const std::string& n) {\nADV(n, 1);\nif (x()) f(nh, n + "/d");\n}\n'
ENDLESS = 'void f(ros::NodeHandle& nh) {\nADV("a", 1);\nf(nh);\n}\n'


@pytest.mark.parametrize(
    ("before", "call", "expected", "is_open"),
    [
        (DEEPER, 'f(nh, "a", 3);', ["/a", "/a/d", "/a/d/d", "/a/d/d/d"], False),
        (LATER, 'f(nh, "a", 4);', ["/a", "/a/d", "/a/d/d", "/a/d/d/d"], False),
        # where what is not known decides, it is said that there may be more
        (OPEN, 'f(nh, "a");', ["/a", "/a/d"], True),
        # unless calls inside make nothing new
        (AGAIN, "f(nh, 1);", ["/a"], False),
        (ENDLESS, "f(nh);", ["/a"], False),
        (DEEPER, 'f(nh, "a", 1);', ["/a", "/a/d"], False),
    ],
)
def test_functions_that_call_themselves(before: str, call: str, expected: list[str], is_open: bool) -> None:
    written = before.replace("ADV(", "nh.advertise<std_msgs::String>(")
    node = cpp(call, written)
    assert [name.rstrip("*") for name in made(call, written)] == expected
    assert any(unknown.field == "endpoints" for unknown in node.unknowns) == is_open


ITEM = (
    'struct I { std::string n; void set(const std::string& s) { n = s; } };\nI larger(I i) { i.n += "x"; return i; }\n'
)
ITEM += 'I& same(I& i) { return i; }\nvoid grow(I& i) { i.n += "x"; }\n'
ITEMS = 'std::vector<I> v{{"a"}};\n'
MAP = 'std::map<std::string, std::string> m{{"k", "a"}};\n'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        # a parameter, a variable or an element that a loop copies is another one
        (ITEMS + "larger(v.back());\nADV(v[0].n, 1);", "/a"),
        (ITEMS + "larger(v.at(0));\nADV(v[0].n, 1);", "/a"),
        (ITEMS + "larger(v[0]);\nADV(v[0].n, 1);", "/a"),
        ('I i{"a"};\nlarger(same(i));\nADV(i.n, 1);', "/a"),
        (ITEMS + 'auto f = [](I i) { i.n = "x"; };\nf(v.front());\nADV(v[0].n, 1);', "/a"),
        (ITEMS + 'auto c = *v.begin();\nc.n = "x";\nADV(v[0].n, 1);', "/a"),
        (ITEMS + 'auto it = v.begin();\nauto c = *it;\nc.n = "x";\nADV(v[0].n, 1);', "/a"),
        (MAP + 'auto c = *m.begin();\nc.second = "x";\nADV(m["k"], 1);', "/a"),
        (MAP + 'for (auto c : m) c.second = "x";\nADV(m["k"], 1);', "/a"),
        (MAP + 'for (auto [k, c] : m) c = "x";\nADV(m["k"], 1);', "/a"),
        (ITEMS + 'for (auto c : v) c.n.append("x");\nADV(v[0].n, 1);', "/a"),
        (ITEMS + 'for (auto c : v) c.set("x");\nADV(v[0].n, 1);', "/a"),
        (ITEMS + "for (auto c : v) grow(c);\nADV(v[0].n, 1);", "/a"),
        (ITEMS + 'for (auto c : v) { auto& d = c; d.n = "x"; }\nADV(v[0].n, 1);', "/a"),
        # what refers to it is the same one
        (ITEMS + "grow(v.back());\nADV(v[0].n, 1);", "/ax"),
        (ITEMS + "grow(v[0]);\nADV(v[0].n, 1);", "/ax"),
        ('I i{"a"};\ngrow(same(i));\nADV(i.n, 1);', "/ax"),
        (ITEMS + 'auto& c = *v.begin();\nc.n = "x";\nADV(v[0].n, 1);', "/x"),
        (ITEMS + 'auto it = v.begin();\nit->n = "x";\nADV(v[0].n, 1);', "/x"),
        (MAP + 'for (auto& [k, c] : m) c += "x";\nADV(m["k"], 1);', "/ax"),
        (MAP + 'auto& [k, c] = *m.begin();\nc += "x";\nADV(m["k"], 1);', "/ax"),
        (MAP + 'for (auto& c : m) c.second = "x";\nADV(m["k"], 1);', "/x"),
        ('std::pair<std::string, int> p("a", 1);\nauto& [n, i] = p;\nn += "x";\nADV(p.first, 1);', "/ax"),
        ('std::pair<std::string, int> p("a", 1);\nauto [n, i] = p;\nn += "x";\nADV(p.first, 1);', "/a"),
        ('I i{"a"};\nauto& [n] = i;\nn += "x";\nADV(i.n, 1);', "/ax"),
        (MAP + "for (const auto& [k, c] : m) ADV(k + c, 1);", "/ka"),
        ('std::vector<I*> p;\np.push_back(new I{"a"});\nfor (auto c : p) c->set("x");\nADV(p[0]->n, 1);', "/x"),
        (
            'std::vector<std::shared_ptr<I>> p;\np.push_back(std::make_shared<I>());\nfor (auto c : p) c->set("x");\nADV(p[0]->n, 1);',
            "/x",
        ),
        (ITEMS + "for (auto c : v) ADV(c.n, 1);", "/a"),
    ],
)
def test_what_is_copied_and_what_refers_to_it(body: str, expected: str) -> None:
    assert [name.rstrip("*") for name in made(body, ITEM)] == [expected]


KIN = 'struct B { virtual ~B() {} std::string k; std::string n() { return "b"; } virtual std::string v() { return "b"; } };\n'
KIN += 'struct D : B { std::string n() { return "d"; } std::string v() { return "d"; } };\n'
KIN += "std::string f(B& b) { return b.n(); }\nstd::string g(const B& b) { return const_cast<B&>(b).n(); }\n"
KIN += 'std::string h(D& d) { return d.n(); }\nstd::string w(B& b) { return b.v(); }\nvoid set(B& b) { b.k = "x"; }\n'
KIN += "template <class T> std::string t(T& b) { return b.n(); }\n"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("D d;\nB& b = d;\nADV(b.n(), 1);", "/b"),
        ("D d;\nADV(f(d), 1);", "/b"),
        ("D d;\nstd::vector<D> e{d};\nfor (B& b : e) ADV(b.n(), 1);", "/b"),
        # the class of the object decides where the method is virtual, or nothing names the base
        ("D d;\nauto& b = d;\nADV(b.n(), 1);", "/d"),
        ("D d;\nD& b = d;\nADV(b.n(), 1);", "/d"),
        ("D d;\nB& b = d;\nADV(b.v(), 1);", "/d"),
        ("D d;\nADV(w(d), 1);", "/d"),
        ("D d;\nADV(h(d), 1);", "/d"),
        ("D d;\nADV(t(d), 1);", "/d"),
        ("D d;\nB& b = d;\nADV(d.n(), 1);", "/d"),
        ("B d;\nB& b = d;\nADV(b.n(), 1);", "/b"),
        # it is the same object
        ("D d;\nset(d);\nADV(d.k, 1);", "/x"),
        ('D d;\nB& b = d;\nb.k = "y";\nADV(d.k, 1);', "/y"),
        ('D d;\nB& b = d;\nd.k = "y";\nADV(b.k, 1);', "/y"),
    ],
)
def test_references_of_a_base_class(body: str, expected: str) -> None:
    assert [name.rstrip("*") for name in made(body, KIN)] == [expected]


STATIC = 'struct C { void step() { s = "x"; }\nstatic void put() { s = "x"; }\n%s };\n%sstruct D : C { };\n'
STATIC += "struct E : C { ros::NodeHandle nh; E() { nh.advertise<std_msgs::String>(s, 1); } };\n"
STATIC += "struct F : C { ros::NodeHandle nh; F() { nh.advertise<std_msgs::String>(C::s, 1); } };\n"
STATIC += 'struct H : C { std::string s = "own"; };\n'
STATIC += 'template <class T> struct T1 { static std::string t; };\ntemplate <class T> std::string T1<T>::t = "t";\n'


@pytest.mark.parametrize(
    "declared",
    [('inline static std::string s = "base";', ""), ("static std::string s;", 'std::string C::s = "base";\n')],
)
@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("C c;\nc.step();\nE e;", "/x"),
        ("D d;\nd.step();\nE e;", "/x"),
        ("D d;\nd.step();\nF f;", "/x"),
        ("C::put();\nE e;", "/x"),
        ('D::s = "x";\nE e;', "/x"),
        ('D::s = "x";\nADV(C::s, 1);', "/x"),
        ('C::s = "x";\nADV(D::s, 1);', "/x"),
        ('D d;\nd.s = "x";\nC c;\nADV(c.s, 1);', "/x"),
        # what is no static member of the base, or has not changed
        ("E e;", "/base"),
        ("D d;\nADV(d.s, 1);", "/base"),
        ('H h;\nh.s = "x";\nADV(C::s, 1);', "/base"),
    ],
)
def test_a_static_member_is_one_for_all_derived_classes(declared: tuple[str, str], body: str, expected: str) -> None:
    before = STATIC % declared
    assert [name.rstrip("*") for name in made(body, before)] == [expected]


def test_a_static_member_that_another_file_defines() -> None:
    header = "struct C { void step(); static std::string s; };\nstruct D : C { };\n"
    other = '#include "c.h"\nstd::string C::s = "base";\nvoid C::step() { s = "x"; }\n'
    node = cpp("D d;\nd.step();\nADV(C::s, 1);\nADV(D::s, 1);", '#include "c.h"\n', c__h=header, c__cpp=other)
    assert {end.name for end in node.endpoints if end.kind == "publishers"} == {"/x"}


CALLBACK = 'void h(const std_msgs::String& m) { ros::NodeHandle nh; nh.advertise<std_msgs::String>("a", 2); }\n'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("switch (n()) { case 3: { if (x()) return; } }", "/a*"),
        ("if (x()) return;", "/a*"),
        ("while (y()) { if (z()) { if (x()) return; } }", "/a*"),
        # nothing that may be in the way
        ("switch (n()) { case 3: { x(); } }", "/a"),
        ("", "/a"),
    ],
)
def test_doubts_of_a_registration_are_those_of_its_callback(body: str, expected: str) -> None:
    go = f'void go() {{ ros::NodeHandle nh; {body}\nnh.subscribe("t", 1, h); }}\n'
    assert made("go();", CALLBACK + go) == [expected]


UPPER = "std::string upper(std::string t) { std::transform(t.begin(), t.end(), t.begin(), ::toupper); return t; }\n"
UPPER += "std::string turned(std::string t) { std::reverse(t.begin(), t.end()); return t; }\n"
UPPER += "std::string other(std::string t) { std::replace(t.begin(), t.end(), '_', '/'); return t; }\n"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('upper(unknown() + "_x")', "/?_X"),
        ('other(unknown() + "_x")', "/?/x"),
        ('upper(x() ? "ab" : "cd")', "/?"),
        ('turned(unknown() + "_x")', "/?"),
        ('upper(std::string("ab"))', "/AB"),
        ('unknown() + "_x"', "/?_x"),
    ],
)
def test_texts_of_which_a_part_is_known_are_changed_in_place(text: str, expected: str) -> None:
    (name,) = {name.rstrip("*") for name in made(f"ADV({text}, 1);", "std::string unknown();\n" + UPPER)}
    assert name == expected
