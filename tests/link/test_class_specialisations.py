# SPDX-License-Identifier: Apache-2.0
"""C++: class templates with specialisations: which one is meant is known where none fits, and is named as not known elsewhere."""

from __future__ import annotations

from follow_kit import case, cpp, ends, names, table

HEAD = 'struct W%s { ros::NodeHandle& nh; W(ros::NodeHandle& n): nh(n) {} void make() { nh.advertise<std_msgs::%s>("%s", 1); } };\n'
FULL = "template<typename T> " + HEAD % ("", "Bool", "any") + "template<> " + HEAD % ("<int>", "Int32", "ints")
PARTIAL = FULL + "template<typename T> " + HEAD % ("<std::vector<T>>", "Int8", "vectors")
NUMBERED = "template<int N> " + HEAD % ("", "Bool", "any") + "template<> " + HEAD % ("<2>", "Int32", "two")
NESTED = "struct Outer { template<typename T> struct W; };\n" + FULL.replace("struct W", "struct Outer::W")
TRAITS = (
    'template<typename T> struct Traits { static constexpr const char* name = "any"; static std::string topic() { return "any"; } };\n'
    'template<> struct Traits<int> { static constexpr const char* name = "int"; static std::string topic() { return "int"; } };\n'
    "template<typename T> void add(ros::NodeHandle& nh) { nh.advertise<std_msgs::String>(%s, 1); }\n"
)


@table((
    case("a full one", "W<int> w(nh); w.make();", before=FULL),
    case("behind a pointer", "auto w = std::make_shared<W<int>>(nh); w->make();", before=FULL),
    case("a partial one", "W<std::vector<int>> w(nh); w.make();", before=PARTIAL),
    case("a number", "W<2> w(nh); w.make();", before=NUMBERED),
    case("without a name of its own", "W<int>(nh).make();", before=FULL),
    case("without a name, a partial one", "W<std::vector<int>>(nh).make();", before=PARTIAL),
    case("without a name, in braces", "W<int>{nh}.make();", before=FULL),
    case("without a name, a number", "W<2>(nh).make();", before=NUMBERED),
    case("in another class", "Outer::W<int>(nh).make();", before=NESTED),
))  # fmt: skip
def test_what_a_specialisation_makes_is_named_as_not_known(before: str, code: str, expected: list[str]) -> None:
    found = cpp(code, before)
    assert names(found) == expected
    assert [
        u.field
        for u in found.unknowns
        if u.reason.startswith(("the class template W has", "the class template Outer::W has"))
    ] == ["endpoints"]


@table((
    case("a method", "add<int>(nh);", "/?", before=TRAITS % "Traits<T>::topic()"),
    case("a constant", "add<int>(nh);", "/?", before=TRAITS % "Traits<T>::name"),
    case("a method, of another type", "add<bool>(nh);", "/?", before=TRAITS % "Traits<T>::topic()"),
))  # fmt: skip
def test_what_a_class_says_is_not_known(before: str, code: str, expected: list[str]) -> None:
    (end,) = ends(cpp(code, before))
    assert [end.name] == expected and end.unknowns


ONE = "template<typename T> " + HEAD % ("", "Bool", "any")
INSIDE = (
    'template<typename T> struct C { static std::string topic() { return "c"; } static std::string all() { return C::topic() + "all"; } };\n'
    "template<typename T> void add(ros::NodeHandle& nh) { nh.advertise<std_msgs::String>(C<T>::all(), 1); }\n"
)
UNRELATED = "namespace k { template<typename T> struct convert; }\ntemplate<> struct k::convert<int> { static int f(int a) { return a; } };\n"


@table((
    case("another type", "W<bool> w(nh); w.make();", "/any", before=FULL),
    case("another type, with a partial one", "W<std::map<int, int>> w(nh); w.make();", "/any", before=PARTIAL),
    case("another number", "W<3> w(nh); w.make();", "/any", before=NUMBERED),
    case("a template without any", "W<int> w(nh); w.make();", "/any", before=ONE),
    case("another type, without a name", "W<bool>(nh).make();", "/any", before=FULL),
    case("another number, without a name", "W<3>(nh).make();", "/any", before=NUMBERED),
    case("a template without any, without a name", "W<int>(nh).make();", "/any", before=ONE),
    case("another type, in another class", "Outer::W<bool>(nh).make();", "/any", before=NESTED),
    case("a class's own names", "add<int>(nh);", "/call", before=INSIDE),
    case("specialisations of another's", 'ADV("a", k::convert<int>::f(1));', "/a", before=UNRELATED),
    case("a class without templates", "S s; ADV(s.n, 1);", "/n", before='struct S { std::string n = "n"; };'),
))  # fmt: skip
def test_what_is_meant_is_known(before: str, code: str, expected: list[str]) -> None:
    found = cpp(code, before)
    assert names(found) == expected and not any("specialisations" in u.reason for u in found.unknowns)
