# SPDX-License-Identifier: Apache-2.0
"""Programs that would take forever or grow without end are given up in time, with what they make before."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from follow_kit import cpp, cpp_files, follow, main, names, python_files, script

from haros_ci.follow import overloads, walk
from haros_ci.values import abstract as values

LARGE = "the node is too large to be followed to its end; some of what it makes may be missing"
#: Names that are longer than this were put together without a bound.
LONGEST = 10_000

CHAIN = "".join(f"void f{i}(ros::NodeHandle& nh) {{ f{i + 1}(nh); f{i + 1}(nh); }}\n" for i in range(24))
CHAIN = "".join(f"void f{i}(ros::NodeHandle& nh);\n" for i in range(25)) + CHAIN
CPP = {
    "exponential calls": (CHAIN + 'void f24(ros::NodeHandle& nh) { ADV("z", 1); }', 'ADV("a", 1); f0(nh);'),
    "huge loop": ("", 'ADV("a", 1); for (long i = 0; i < 1000000000; ++i) { ADV("b", 1); }'),
    "nested loops": (
        "",
        'ADV("a", 1);' + "".join(f"for (int i{n} = 0; i{n} < 60; ++i{n}) " for n in range(12)) + 'ADV("b", 1);',
    ),
    "nested loops of unknown length": ("int n();", 'ADV("a", 1);' + "while (n()) " * 18 + 'ADV("b", 1);'),
    "nested branches": ("int n();", 'ADV("a", 1);' + "if (n()) { " * 60 + 'ADV("b", 1);' + "}" * 60),
    "branches in a row": (
        "int n();",
        'ADV("a", 1);' + "".join(f"int x{i} = 0; if (n()) x{i} = 1;\n" for i in range(400)) + 'ADV("b", 1);',
    ),
    "recursion": ('void f(ros::NodeHandle& nh) { ADV("b", 1); f(nh); f(nh); }', 'ADV("a", 1); f(nh);'),
    "mutual recursion": (
        (
            'void g(ros::NodeHandle&); void f(ros::NodeHandle& nh) { ADV("b", 1); g(nh); g(nh); '
            "} void g(ros::NodeHandle& nh) { f(nh); f(nh); }"
        ),
        'ADV("a", 1); f(nh);',
    ),
    "endless template": (
        'template <class T> void f(ros::NodeHandle& nh) { ADV("b", 1); f<std::vector<T>>(nh); }',
        'ADV("a", 1); f<int>(nh);',
    ),
    "class that holds itself": ('struct C { C c; ros::NodeHandle nh; C() { ADV("b", 1); } };', 'ADV("a", 1); C c;'),
    "two classes that hold each other": ("struct D; struct C { D d; }; struct D { C c; };", 'ADV("a", 1); C c;'),
    "base of itself": ("struct C : C { };", 'ADV("a", 1); C c;'),
    "bases in a circle": ("struct D; struct C : D { int f(); }; struct D : C { };", 'ADV("a", 1); C c; c.f(); c.g();'),
    "alias of itself": ("typedef A B; typedef B A;", 'ADV("a", 1); A a; nh.advertise<A>("b", 1);'),
    "global made from itself": ("extern int a; int b = a; int a = b;", 'ADV("a", 1); if (a) ADV("b", 1);'),
    "macro of itself": ("#define A B\n#define B A\n", 'ADV("a", 1); int i = A;'),
    "deep expression": ("", 'ADV("a", 1); int i = ' + "(" * 3000 + "1" + ")" * 3000 + ";"),
    "long sum": ("", 'ADV("a", 1); int i = ' + "+".join(["1"] * 5000) + ";"),
    "deep blocks": ("", 'ADV("a", 1);' + "{" * 2000 + "}" * 2000),
    "many callbacks": (
        "".join(f"void c{i}(const std_msgs::String& m) {{}}\n" for i in range(600)),
        'ADV("a", 1);' + "".join(f'nh.subscribe("s{i}", 1, c{i});\n' for i in range(600)),
    ),
    "callbacks that register more": (
        (
            "struct C { ros::NodeHandle nh; void cb(const std_msgs::String&) { C* c = new C; "
            'nh.subscribe("s", 1, &C::cb, c); } };'
        ),
        'ADV("a", 1); C c; nh.subscribe("s", 1, &C::cb, &c);',
    ),
}


def first(found: Any) -> list[str]:
    nodes = [node for configuration in found.configurations for node in configuration.nodes]
    return names(nodes[0]) if nodes else []


def texts(what: str) -> Any:
    before, code = CPP[what]
    return cpp_files(main(code, before.replace("ADV(", "nh.advertise<std_msgs::String>(")))


@cache
def followed(what: str, again: bool = False) -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(walk, "STEPS", 8_000)  # of any number of steps all of them are taken
        return follow(texts(what))


@pytest.mark.parametrize("what", CPP)
def test_what_is_made_before_a_hostile_part_is_there(what: str) -> None:
    found = followed(what)
    assert "/a" in first(found)
    assert {problem.message for problem in found.problems} <= {LARGE} | {
        problem.message for problem in found.problems if problem.line is not None
    }


PYTHON = {
    "list that holds itself": 'PUB("a")\nl = []\nl.append(l)\nrospy.set_param("x", l)\nPUB(l == l)',
    "dict that holds itself": 'PUB("a")\nd = {}\nd["d"] = d\nrospy.set_param("x", d)',
    "object that holds itself": 'PUB("a")\nclass C:\n    pass\nc = C()\nc.c = c\nPUB(c.c.c.c.s)',
    "endless recursion": 'PUB("a")\ndef f():\n    PUB("b")\n    f()\nf()',
    "endless loop": 'PUB("a")\nwhile True:\n    PUB("b")',
    "class that makes itself": 'PUB("a")\nclass C:\n    def __init__(self):\n        PUB("b")\n        C()\nC()',
    "base of itself": 'PUB("a")\nclass C(C):\n    pass\nC().f()',
    "module that imports itself": 'PUB("a")\nimport lib.a\nPUB(lib.a.x)',
    "deep expression": 'PUB("a")\nx = ' + "(" * 150 + "1" + ")" * 150,
    "long sum": 'PUB("a")\nx = ' + " + ".join(["1"] * 3000),
    "long sum of texts": 'PUB("a")\nx = ' + " + ".join(["text()"] * 900),
    "deep calls": 'PUB("a")\nx = ' + "f(" * 80 + ")" * 80,
    "getattr of everything": 'PUB("a")\nx = rospy\nfor i in range(300):\n    x = getattr(x, "x")\nPUB(x)',
    "power": 'PUB("a")\nx = 9 ** 9 ** 9 ** 9\nPUB(str(x))',
    "shift": 'PUB("a")\nx = 1\nfor i in range(60):\n    x = x << 60\n    l.append(x)\nPUB("b")',
    "partial of itself": 'PUB("a")\nimport functools\nf = functools.partial(f, 1)\nf()',
    "decorator of itself": 'PUB("a")\n@f\ndef f():\n    pass\nf()',
}


@pytest.mark.parametrize("what", PYTHON)
def test_what_is_made_before_a_hostile_part_of_a_script_is_there(what: str) -> None:
    found = follow(
        python_files(script(PYTHON[what] + "\n"), a="import lib.b\nx = lib.b.x", b="import lib.a\nx = lib.a.x")
    )
    assert "/a" in first(found) or "nested too deeply" in found.problems[0].message


#: Ways to double a text or list; 16 turns would make 65,536 characters of one.
DOUBLING = {
    "stream": (
        'std::stringstream s; s << "a"; for (int i = 0; i < 16; ++i) { s << s.str(); ADV("b", 1); } ADV(s.str(), 1);'
    ),
    "append": 'std::string s = "a"; for (int i = 0; i < 16; ++i) { s.append(s); ADV("b", 1); } ADV(s, 1);',
    "plus": 'std::string s = "a"; for (int i = 0; i < 16; ++i) { s = s + s; ADV("b", 1); } ADV(s, 1);',
    "plus equals": 'std::string s = "a"; for (int i = 0; i < 16; ++i) { s += s; ADV("b", 1); } ADV(s, 1);',
    "f-string": 's = "a"\nfor i in range(16):\n    s = f"{s}{s}"\nPUB(s)',
    "percent": 's = "a"\nfor i in range(16):\n    s = "%s%s" % (s, s)\nPUB(s)',
    "format": 's = "a"\nfor i in range(16):\n    s = "{0}{0}".format(s)\nPUB(s)',
    "join": 's = "a"\nfor i in range(16):\n    s = "".join([s, s])\nPUB(s)',
    "replace": 's = "a"\nfor i in range(16):\n    s = s.replace("a", "aa")\nPUB(s)',
    "list": 'l = ["a"]\nfor i in range(16):\n    l = l + l\nPUB("".join(l))',
    "centred": 'PUB("a".center(100000, "a"))',
    "zeros": 'PUB("1".zfill(100000))',
    "number": "x = 3\nfor i in range(16):\n    x = x * x\nPUB(str(x))",
}


@pytest.mark.parametrize("what", DOUBLING)
def test_what_doubles_is_given_up(what: str) -> None:
    code = DOUBLING[what]
    files = cpp_files(main(code)) if ";" in code else python_files(script(code + "\n"))
    made = first(follow(files))
    assert made
    assert max(map(len, made)) < LONGEST


def test_a_list_that_doubles_is_given_up() -> None:
    code = "l = [1]\nfor i in range(16):\n    l = l + l\nrospy.set_param('x', l)\n"
    found = follow(python_files(script(code)))
    (end,) = found.configurations[0].nodes[0].endpoints
    assert end.value is None or len(end.value) < LONGEST


class TooMany(Exception):
    """More joins than a text with a handful of choices needs."""


def test_a_text_of_many_choices_is_not_multiplied_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Five parts of six values each are 7,776 texts, which no one asked for."""
    joins = 0
    join = values.join

    def counted(one: Any, other: Any) -> Any:
        nonlocal joins
        joins += 1
        if joins > 5_000:
            raise TooMany
        return join(one, other)

    monkeypatch.setattr(values, "join", counted)
    code = "".join(f's{n} = "a"\n' + "".join(f'if cond({i}):\n    s{n} = "{i}"\n' for i in range(5)) for n in range(5))
    found = follow(python_files(script(code + "PUB(f'{s0}{s1}{s2}{s3}{s4}')\n")))
    assert first(found) == ["/?"]


def test_the_same_twice() -> None:
    assert followed("exponential calls", again=True) == followed("exponential calls")


def test_what_is_nested_too_deeply_is_named() -> None:
    """Calls in branches in calls: Python's own stack ends before the bound of calls in calls."""
    made = 'ADV("deep", 1);'
    for _ in range(60):
        made = f"if (flag) {{ {made} }}"
    functions = [f"void f24(ros::NodeHandle& nh) {{ {made} }}\n"]
    functions += [
        f"void f{i}(ros::NodeHandle& nh) {{ {'if (flag) { ' * 12}f{i + 1}(nh);{'}' * 12} }}\n" for i in range(24)
    ][::-1]
    found = follow(cpp_files(main('ADV("a", 1); f0(nh);', "extern bool flag;\n" + "".join(functions))))
    (node,) = found.configurations[0].nodes
    assert names(node) == ["/a"]
    assert [each.reason for each in node.unknowns] == ["the code is nested too deeply to be followed"]


def test_aliases_that_multiply() -> None:
    """Each is eight of the next: 8 ** 10 types in one, of which those beyond a bound are not resolved."""
    eight = {number: ", ".join([f"T{number + 1}"] * 8) for number in range(18)}
    aliases = "".join(f"using T{number} = std::tuple<{of}>;\n" for number, of in eight.items())
    found = cpp(
        'C c; c.go(nh); ADV("a", 1);',
        f'{aliases}struct B {{}};\nclass C : public B {{ public: T0 t; void go(ros::NodeHandle& nh) {{ T0 t; nh.advertise<std_msgs::String>("b", 1); }} }};\n',
    )
    assert names(found) == ["/a", "/b"]


def test_callbacks_beyond_those_that_are_followed_are_named() -> None:
    """Each makes something by a helper that the others call, too, so that no call is unseen."""
    helper = "struct C { ros::NodeHandle nh; std::vector<ros::Publisher> all;\nvoid make(const std::string& name) { all.push_back(ADV(name, 1)); }\n"
    methods = "".join(f'void c{i}(const std_msgs::String&) {{ make("t{i}"); }}\n' for i in range(walk.ROOTS + 2))
    body = "C c;\n" + "".join(f'nh.subscribe("s{i}", 1, &C::c{i}, &c);\n' for i in range(walk.ROOTS + 2))
    found = cpp(body, helper + methods + "};")
    assert f"/t{walk.ROOTS - 1}" in names(found) and f"/t{walk.ROOTS}" not in names(found)
    assert [each.reason for each in found.unknowns] == ["there are more callbacks than the 400 that are followed"]


def test_callbacks_up_to_the_bound_leave_nothing_open() -> None:
    """As many as are followed, and any number that make nothing."""
    quiet = "".join(f"void q{i}(const std_msgs::String&) {{}}\n" for i in range(walk.ROOTS + 2))
    body = 'ADV("a", 1);\n' + "".join(f'nh.subscribe("s{i}", 1, q{i});\n' for i in range(walk.ROOTS + 2))
    assert cpp(body, quiet).unknowns == ()


def test_a_call_with_more_overloads_than_are_compared_is_not_sure(monkeypatch: pytest.MonkeyPatch) -> None:
    """None is taken for the right one, and the node says so."""
    kinds = "".join(f'struct S{i} {{}};\nvoid f(S{i}, ros::NodeHandle& nh) {{ ADV("t{i}", 1); }}\n' for i in range(4))
    assert names(cpp('ADV("a", 1); f(S2(), nh);', kinds)) == ["/a", "/t2"]
    monkeypatch.setattr(overloads, "MOST", 3)
    found = cpp('ADV("a", 1); f(S2(), nh);', kinds)
    assert names(found) == ["/a"]
    assert "f has more overloads than are compared with the arguments of a call" in [
        one.reason for one in found.unknowns
    ]
