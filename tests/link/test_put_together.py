# SPDX-License-Identifier: Apache-2.0
"""Names in lists, sets, tuples, maps and enumerations, in formats, and in functions that maps and packs hold."""

from __future__ import annotations

from follow_kit import case, cpp, names, python, table

LAUNCH = (
    '<launch><node pkg="p" type="{}" name="n"><rosparam param="x">{{b: /y, a: /z}}</rosparam>'
    '<rosparam param="l">[/a, /b]</rosparam></node></launch>'
)
PYTHON = (
    case("union", 'A = {"a"}\nB = A | {"b"}\nfor s in sorted(B):\n    PUB(s)', "/a", "/b"),
    case("union of more", 'A = frozenset(("a",)).union(["b"], {"c"})\nfor s in A:\n    PUB(s)', "/a", "/b", "/c"),
    case("an element of both", 'for s in sorted({"a", "b"} | {"b"}):\n    PUB(s)', "/a", "/b"),
    case("difference", 'for s in {"a", "b", "c"} - {"c"}:\n    PUB(s)', "/a", "/b"),
    case("intersection", 'for s in {"a", "b"} & {"b", "c"}:\n    PUB(s)', "/b"),
    case("in one of them", 'for s in {"a", "b"} ^ {"b", "c"}:\n    PUB(s)', "/a", "/c"),
    case(
        "added",
        's = set()\ns.add("a")\ns.add("a")\ns |= {"b"}\ns.update(["c"])\nfor t in s:\n    PUB(t)',
        "/a",
        "/b",
        "/c",
    ),
    case("removed", 's = {"a", "b"}\ns.discard("a")\ns.discard("x")\nfor t in s:\n    PUB(t)', "/b"),
    case(
        "sorted entries of a parameter",
        'for k, v in sorted(rospy.get_param("~x").items()):\n    PUB(k + v)',
        "/a/z",
        "/b/y",
    ),
    case("the first entry", 'PUB(sorted(rospy.get_param("~x").items())[0][1])', "/z"),
    case("inserted", 't = ["a"]\nt.insert(0, "b")\nPUB(t[0])', "/b"),
    case("popped", 't = ["a", "b"]\nPUB(t.pop(0) + t[0])', "/ab"),
    case("repeated", 'PUB("".join(["a"] * 2))', "/aa"),
    case("None in a format", 'x = None\nPUB("%s/a" % x)\nPUB("{}/b".format(x))\nPUB(f"{x}/c")', "/?/a", "/?/b", "/?/c"),
    case("None as a text", "PUB(str(None))", "/?"),
    case("None beside it", 'x = None\nPUB("%s" % (x or "a"))', "/a"),
    case("chain", 'import itertools\nfor s in itertools.chain(["a"], ("b",)):\n    PUB(s)', "/a", "/b"),
    case(
        "product", 'import itertools\nfor s, t in itertools.product(["a"], ["b", "c"]):\n    PUB(s + t)', "/ab", "/ac"
    ),
    case("update by name", 'd = {}\nd.update({"x": "a"}, y="b")\nfor s in d.values():\n    PUB(s)', "/a", "/b"),
    case(
        "enumeration",
        'from enum import Enum\nclass E(Enum):\n    A = "a"\n    B = "b"\nPUB(E.B.value + E.A.name)',
        "/bA",
    ),
    case(
        "all of an enumeration",
        'from enum import Enum\nclass E(str, Enum):\n    A = "a"\n    B = "b"\nfor e in E:\n    PUB(e.value)',
        "/a",
        "/b",
    ),
    # What stays unknown: the order of a set, and what is made of what is not known.
    case("the first of a set", 'PUB(list(set(["a", "b"]))[0])', "/?"),
    case("one of a set", 's = set(["a", "b"])\nPUB(s.pop())', "/?"),
    case("union with what is not known", 'for s in {"a"} | text():\n    PUB(s)', "/?"),
    case("added in a branch", 's = {"a"}\nif cond():\n    s.add("b")\nfor t in s:\n    PUB(t)', "/?", "/a"),
    case("pairs of one key", 'PUB(sorted([("a", text()), ("a", "b")])[0][1])', "/?"),
    case("computed member", "from enum import Enum\nclass E(Enum):\n    A = text()\nPUB(E.A.value)", "/?"),
    case("a value that is no member", "class C:\n    A = D()\nPUB(C.A.value)", "/?"),
)


@table(PYTHON)
def test_python(before: str, code: str, expected: list[str]) -> None:
    assert names(python(f"{code}\n", LAUNCH.format("n.py"))) == expected


A_CLASS = (
    "struct C { ros::NodeHandle& nh; std::map<int, std::function<void()>> m; C(ros::NodeHandle& h) : nh(h) { %s }"
    ' void b() { ADV("b", 1); } void go(int i) { %s } };'
)
BOTH = '{ m[1] = [this] { ADV("a", 1); }; m.emplace(2, std::bind(&C::b, this)); }'
CPP = (
    case("functions of a map", "C(nh).go(1);", "/a", "/b", before=A_CLASS % (BOTH, "for (auto& f : m) f.second();")),
    case("functions by binding", "C(nh).go(1);", "/a", "/b", before=A_CLASS % (BOTH, "for (auto& [k, f] : m) f();")),
    case(
        "functions by iterator",
        "C(nh).go(1);",
        "/a",
        "/b",
        before=A_CLASS % (BOTH, "for (auto i = m.begin(); i != m.end(); ++i) i->second();"),
    ),
    case("one function of a map", "C(nh).go(2);", "/b", before=A_CLASS % (BOTH, "m.at(i)();")),
    case("some function of a map", "C(nh).go(number());", "/a", "/b", before=A_CLASS % (BOTH, "m.at(i)();")),
    case(
        "a parameter's list", 'std::vector<std::string> l; nh.getParam("/n/l", l); ADV(l.at(1) + l.front(), 1);', "/b/a"
    ),
    case(
        "a map filled by a function",
        "std::map<std::string, std::string> m; fill(m); for (auto& p : m) ADV(p.second, 1);",
        "/a",
        "/b",
        "/c",
        before='void fill(std::map<std::string, std::string>& m) { m.insert({"x", "a"}); m.emplace("y", "b");'
        ' m.insert(std::make_pair("z", "c")); m.insert({"x", "d"}); }',
    ),
    case(
        "an array filled by a function",
        "std::array<std::string, 2> v; fill(v); for (auto& s : v) ADV(s, 1);",
        "/a",
        "/b",
        before='void fill(std::array<std::string, 2>& v) { v[0] = "a"; v[1] = "b"; }',
    ),
    case("numbers of an array that are not set", 'std::array<int, 2> v; ADV("a" + std::to_string(v[0]), 1);', "/a?"),
    case(
        "pointers of an array", "std::array<C*, 2> v;", before='struct C { ros::NodeHandle nh; C() { ADV("a", 1); } };'
    ),
    case("tuple", 'auto t = std::make_tuple("a", "b"); ADV(std::get<1>(t), 1);', "/b"),
    case(
        "tuples",
        'std::vector<std::tuple<std::string, int>> v = {{"a", 1}, {"b", 2}}; for (auto& t : v) ADV(std::get<0>(t), 1);',
        "/a",
        "/b",
    ),
    case("tie", 'std::string s; int i; std::tie(s, i) = std::make_tuple("a", 1); ADV(s, 1);', "/a"),
    case("binding of a pair", 'auto [s, i] = std::make_pair("a", 1); ADV(s, 1);', "/a"),
    case(
        "binding of a struct",
        "S v; auto [s, t] = v; ADV(t, 1);",
        "/b",
        before='struct S { std::string s = "a"; std::string t = "b"; };',
    ),
    case(
        "for_each",
        'std::vector<std::string> v = {"a", "b"}; std::for_each(v.begin(), v.end(), [&](std::string s) { ADV(s, 1); });',
        "/a",
        "/b",
    ),
    case(
        "fold",
        'all(nh, "a", "b");',
        "/a",
        "/b",
        before="template <class... T> void all(ros::NodeHandle& nh, T... t) { (ADV(t, 1), ...); }",
    ),
    case("fmt", 'ADV(fmt::format(FMT_COMPILE("{}_{:02d}"), "a", 3), 1);', "/a_03"),
    case("sprintf", 'char b[20]; sprintf(b, "a%02d", 3); ADV(b, 1);', "/a03"),
    case(
        "snprintf", 'char b[20]; snprintf(b, sizeof(b), "a%lu_%s", 3ul, std::string("b").c_str()); ADV(b, 1);', "/a3_b"
    ),
    case("snprintf that cuts", 'char b[4]; snprintf(b, 4, "%s", "abcdef"); ADV(b, 1);', "/abc"),
    # What stays unknown.
    case(
        "binding of what is not known",
        "auto [s, i] = pair(); ADV(s, 1);",
        "/?",
        before="std::pair<std::string, int> pair();",
    ),
    case(
        "a map with a key that is not known",
        'std::map<std::string, std::string> m; m.emplace(text(), "b"); ADV(m.at("a"), 1);',
        "/?",
    ),
    case("tuple of what is not known", "auto t = std::make_tuple(text()); ADV(std::get<0>(t), 1);", "/?"),
    case("fmt of what is not known", 'ADV(fmt::format("{}", text()), 1);', "/?"),
    case("a format that is not known", "char b[20]; snprintf(b, 20, text().c_str(), 3); ADV(b, 1);", "/?"),
    case(
        "a pack that is folded by another operator",
        "all(nh, 1, 2);",
        "/?",
        before="template <class... T> void all(ros::NodeHandle& nh, T... t) { ADV(std::to_string((t + ...)), 1); }",
    ),
)
HEAD = "#include <array>\n#include <functional>\n#include <map>\n#include <tuple>\nstd::string text();\nint number();\n"


@table(CPP)
def test_cpp(before: str, code: str, expected: list[str]) -> None:
    before = before.replace("ADV(", "nh.advertise<std_msgs::String>(")
    assert sorted(set(names(cpp(code, HEAD + before, LAUNCH.format("n"))))) == expected
