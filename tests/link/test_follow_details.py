# SPDX-License-Identifier: Apache-2.0
"""Queue sizes, latches, types of services and actions, and the number of endpoints that one call site makes."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from follow_kit import admits, because, case, conditions, cpp, ends, names, python, table, types

from haros_ci.model.architecture import Node

BEFORE = """#include <string>
#include <std_srvs/Empty.h>
bool cond();
int number();
const int SIZE = 7;
enum { FIVE = 5 };
#define EIGHT 8
bool serve(std_srvs::Empty::Request& i, std_srvs::Empty::Response& o) { return true; }
bool event(ros::ServiceEvent<std_srvs::Empty::Request, std_srvs::Empty::Response>& e) { return true; }
struct C { bool serve(std_srvs::EmptyRequest& i, std_srvs::EmptyResponse& o) { return true; } };
"""
#: Why a row does not hold yet.
DEFECTS = because("integers have no width (operators._computed, converted)", "(uint32_t) -1")

#: Queue size as written, and as it is.
QUEUES = (
    ("1", 1),
    ("SIZE", 7),
    ("FIVE", 5),
    ("EIGHT", 8),
    ("2 * SIZE + 1", 15),
    ("7 / 2", 3),
    ("1e2", 100),
    ("10u", 10),
    ("0x10", 16),
    ("true ? 2 : 3", 2),
    ("static_cast<uint32_t>(4)", 4),
    ("number()", None),
    ("cond() ? 1 : 2", None),
    ("argc", 1),
    ("SIZE % number()", None),
    ("(uint32_t) -1", None),
)


@pytest.mark.parametrize(("written", "expected"), QUEUES)
def test_queue_sizes(written: str, expected: int | None, request: pytest.FixtureRequest) -> None:
    if written in DEFECTS:
        request.applymarker(pytest.mark.xfail(strict=True, reason=DEFECTS[written]))
    (end,) = ends(cpp(f'ADV("a", {written});', BEFORE))
    assert end.queue_size == expected
    assert ("queue_size" in {unknown.field for unknown in end.unknowns}) == (expected is None)


#: Arguments after the queue size, and whether it is latched.
LATCHES = (
    ("", False),
    (", true", True),
    (", false", False),
    (", cond()", None),
    (", !cond()", None),
    (", SIZE > 3", True),
)


@pytest.mark.parametrize(("written", "expected"), LATCHES)
def test_latches(written: str, expected: bool | None) -> None:
    (end,) = ends(cpp(f'ADV("a", 1{written});', BEFORE))
    assert end.latched == expected
    assert ("latched" in {unknown.field for unknown in end.unknowns}) == (expected is None)


#: Code, the kind of its endpoint, its type.
SERVICES = (
    ('nh.advertiseService("a", serve);', "servers", "std_srvs/Empty"),
    ('nh.advertiseService("a", event);', "servers", "std_srvs/Empty"),
    ('C c; nh.advertiseService("a", &C::serve, &c);', "servers", "std_srvs/Empty"),
    ('nh.advertiseService("a", elsewhere);', "servers", None),
    ('nh.serviceClient<std_srvs::Empty>("a");', "clients", "std_srvs/Empty"),
    ('std_srvs::Empty s; ros::service::call("a", s);', "clients", "std_srvs/Empty"),
    ('actionlib::SimpleActionClient<p::DoAction> c("a", true);', "action_clients", "p/Do"),
    ('auto c = std::make_shared<actionlib::SimpleActionClient<p::DoAction>>("a", true);', "action_clients", "p/Do"),
    ('typedef actionlib::SimpleActionClient<p::DoAction> T; T c("a", true);', "action_clients", "p/Do"),
)


@pytest.mark.parametrize(
    ("name", "expected"),
    [("MmCLI", "mm_srvs/MmCLI"), ("mmCLI", "mm_srvs/mmCLI"), ("mmWaveCLI", None)],
)
def test_the_namespace_around_says_the_package_of_a_service(name: str, expected: str | None) -> None:
    """A class of a service need not begin with a capital letter; one without its header has no package that is known."""
    method = f"bool on({name}::Request & q, {name}::Response & r) {{ return true; }}"
    before = f"#include <mm_srvs/MmCLI.h>\n#include <mm_srvs/mmCLI.h>\nnamespace mm_srvs {{ {method} }}\n"
    found = types(cpp('nh.advertiseService("a", mm_srvs::on);', before), "servers")
    assert found == [("/a", expected)]


@pytest.mark.parametrize(("code", "kind", "expected"), SERVICES)
def test_services_and_actions(code: str, kind: str, expected: str | None, request: pytest.FixtureRequest) -> None:
    if code in DEFECTS:
        request.applymarker(pytest.mark.xfail(strict=True, reason=DEFECTS[code]))
    assert types(cpp(code, BEFORE), kind) == [("/a", expected)]


#: Code, and (name, queue size, conditions) of what it makes.
SITES = (
    ('for (int i = 0; i < 2; ++i) ADV("a", 1);', [("/a", 1, 1)]),
    ('for (int i = 0; i < 2; ++i) ADV("a", i + 1);', [("/a", 1, 1), ("/a", 2, 1)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; f("a"); f("a"); f("b");', [("/a", 1, 0), ("/b", 1, 0)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); f("a");', [("/a", 1, 0)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); else f("a");', [("/a", 1, 0)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); if (cond()) {} else f("a");', [("/a", 1, 1)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); else if (number()) f("a");', [("/a", 1, 1)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); else while (cond()) f("a");', [("/a", 1, 1)]),
    ('auto f = [&](std::string s) { ADV(s, 1); }; if (cond()) f("a"); else f("b");', [("/a", 1, 1), ("/b", 1, 1)]),
    ('if (cond()) ADV("a", 1); else ADV("a", 1);', [("/a", 1, 1), ("/a", 1, 1)]),
    ('ADV("a", 1); ADV("a", 1);', [("/a", 1, 0), ("/a", 1, 0)]),
    ('ADV("a", cond() ? 1 : 2);', [("/a", None, 0)]),
)


@pytest.mark.parametrize(("code", "expected"), SITES)
def test_one_site_makes_one_endpoint_for_each_name(code: str, expected: list[tuple[str, int | None, int]]) -> None:
    """Name, queue size, and how many conditions there are: one if they are not the same on every way."""
    found = ends(cpp(code, BEFORE))
    several = [sum(unknown.field == "conditions" for unknown in e.unknowns) for e in found]
    counts = [len(conditions(e)) + number for e, number in zip(found, several, strict=True)]
    assert [(e.name, e.queue_size, count) for e, count in zip(found, counts, strict=True)] == expected


GO = "void go(std::string s) { ros::NodeHandle nh; ADV(s, 1); }\n".replace("ADV(", "nh.advertise<std_msgs::String>(")
LAMBDA = "auto f = [&](std::string s) { ADV(s, 1); }; "
W = "struct W { ros::NodeHandle nh; void init(std::string s) { ADV(s, 1); } };".replace(
    "ADV(", "nh.advertise<std_msgs::String>("
)
#: Ways to call something whose name does not tell what it makes.
REACHED = (
    case("lambda in a loop of known length", LAMBDA + 'for (auto s : {"a", "b"}) f(s);', "/a", "/b"),
    case("lambda in a loop of unknown length", LAMBDA + 'while (cond()) f("a");', "/a"),
    case(
        "functor in a loop of unknown length",
        'F f; while (cond()) f("a");',
        "/a",
        before=GO + "struct F { void operator()(std::string s) { go(s); } };",
    ),
    case("std::function", 'std::function<void(std::string)> f = go; f("a");', "/a", before=GO),
    case(
        "std::function in a loop of unknown length",
        'std::function<void(std::string)> f = go; while (cond()) f("a");',
        "/a",
        before=GO,
    ),
    case("function pointer", 'void (*f)(std::string) = go; f("a");', "/a", before=GO),
    case("function pointer by auto", 'auto f = go; f("a");', "/a", before=GO),
    case(
        "function given to a function",
        "call(go);",
        "/a",
        before=GO + 'void call(std::function<void(std::string)> f) { f("a"); }',
    ),
    case(
        "function given to a loop of unknown length",
        "call(go);",
        "/a",
        before=GO + 'void call(std::function<void(std::string)> f) { while (cond()) f("a"); }',
    ),
    case(
        "function given to a template", "call(go);", "/a", before=GO + 'template <class F> void call(F f) { f("a"); }'
    ),
    case("method by pointer", 'W w; void (W::*f)(std::string) = &W::init; (w.*f)("a");', "/a", before=W),
    case("bound", 'auto f = std::bind(go, "a"); f();', "/a", before=GO),
    case("bound in a loop of unknown length", 'auto f = std::bind(go, "a"); while (cond()) f();', "/a", before=GO),
    case(
        "function from a map",
        'std::map<std::string, std::function<void(std::string)>> m; m["k"] = go; m["k"]("a");',
        "/a",
        before=GO,
    ),
    case("object of a map", 'std::map<std::string, W> m; m["k"].init("a");', "/a", before=W),
    case("objects of a vector", 'std::vector<W> v(1); for (auto& w : v) w.init("a");', "/a", before=W),
    case("object by emplace_back", 'std::vector<W> v; v.emplace_back(); v.back().init("a");', "/a", before=W),
    case("object of an array", 'W v[2]; v[1].init("a");', "/a", before=W),
    case("object returned", 'make().init("a");', "/a", before=W + "W make() { return W(); }"),
    case("object by dereference", 'W* w = new W; (*w).init("a");', "/a", before=W),
    case("object of an unknown list", 'for (auto& w : list()) w.init("a");', "/a", before=W + "std::vector<W> list();"),
    case(
        "std::for_each", 'std::vector<std::string> v = {"a"}; std::for_each(v.begin(), v.end(), go);', "/a", before=GO
    ),
    case("macro that calls", 'GO("a");', "/a", before=GO + "#define GO(x) go(x)"),
    case("constructor of a temporary", 'C("a");', "/a", before=GO + "struct C { C(const char* s) { go(s); } };"),
    case("destructor", "C c;", "/a", before=GO + 'struct C { ~C() { go("a"); } };'),
    case(
        "operator",
        'C c; c << "a";',
        "/a",
        before=GO + "struct C { C& operator<<(const char* s) { go(s); return *this; } };",
    ),
    case(
        "default argument that makes",
        "f();",
        "/a",
        before=GO + 'int make() { go("a"); return 1; } void f(int i = make()) {}',
    ),
    case(
        "member's initialiser that makes",
        "C c;",
        "/a",
        before=GO + 'int make() { go("a"); return 1; } struct C { int i = make(); };',
    ),
)
PYTHON_REACHED = (
    case("alias of Publisher", 'P = rospy.Publisher\nwhile cond():\n    P("a", String, queue_size=1)', "/a"),
    case("alias of a function", 'f = make\nwhile cond():\n    f("a")', "/a"),
    case("function given to a function", 'def call(f):\n    f("a")\ncall(make)', "/a"),
    case(
        "function given to a loop of unknown length",
        'def call(f):\n    while cond():\n        f("a")\ncall(make)',
        "/a",
    ),
    case(
        "partial in a loop of unknown length",
        'import functools\nf = functools.partial(make, "a")\nwhile cond():\n    f()',
        "/a",
    ),
    case(
        "class in a variable",
        'class W:\n    def __init__(self, s):\n        make(s)\nK = W\nwhile cond():\n    K("a")',
        "/a",
    ),
    case("function from a dict", 'd = {"k": make}\nd["k"]("a")', "/a"),
    case("functions of a dict in a loop", 'd = {"k": make}\nfor k in d:\n    d[k]("a")', "/a"),
    case("getattr", 'class W:\n    def f(self, s):\n        make(s)\ngetattr(W(), "f")("a")', "/a"),
    case("wrapper by a decorator", 'def d(f):\n    def g():\n        f("a")\n    return g\ng = d(make)\ng()', "/a"),
    case(
        "context manager",
        (
            'class W:\n    def __enter__(self):\n        make("a")\n    def __exit__(self, '
            "*a):\n        pass\nwith W():\n    pass"
        ),
        "/a",
    ),
    case("property", 'class W:\n    @property\n    def s(self):\n        make("a")\nW().s', "/a"),
    case("generator", 'def g():\n    make("a")\n    yield 1\nfor x in g():\n    pass', "/a"),
    case("comprehension", '[make(s) for s in ["a", "b"]]', "/a", "/b"),
    case("comprehension of unknown length", '[make("a") for s in text()]', "/a"),
    case("map", 'list(map(make, ["a"]))', "/a"),
    case("assert", 'assert make("a") is None', "/a"),
    case("default argument", 'def f(x=make("a")):\n    pass', "/a"),
    case("class body", 'class W:\n    p = make("a")', "/a"),
)
NOT_REACHED = because("what a default argument calls is not seen to matter", "default argument that makes")
NOT_REACHED_IN_PYTHON = because("default arguments are not carried out", "default argument")


@table(REACHED, NOT_REACHED)
def test_what_is_called_by_another_name_is_followed(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(cpp(code, BEFORE + before)), expected)


@table(PYTHON_REACHED, NOT_REACHED_IN_PYTHON)
def test_what_a_script_calls_by_another_name_is_followed(before: str, code: str, expected: list[str]) -> None:
    assert admits(names(python(f"def make(s):\n    PUB(s)\n{code}\n")), expected)


INFINITE = (
    (cpp, 'ADV("x", INFINITY);'),
    (cpp, 'ADV("x", std::numeric_limits<double>::infinity());'),
    (cpp, 'ADV("x", -HUGE_VAL);'),
    (python, 'rospy.Publisher("x", String, queue_size=float("inf"))\n'),
)


@pytest.mark.parametrize(("followed", "code"), INFINITE)
def test_no_queue_is_infinite(followed: Callable[[str], Node], code: str) -> None:
    (end,) = ends(followed(code))
    assert (end.name, end.queue_size) == ("/x", None)
    assert [(unknown.field, unknown.reason) for unknown in end.unknowns] == [("queue_size", "it is infinite")]
