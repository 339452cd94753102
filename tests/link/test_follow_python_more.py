# SPDX-License-Identifier: Apache-2.0
"""rospy programs: texts, comprehensions, dictionaries, arguments passed on, classes; and what stays unknown of them."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, case, ends, follow, names, node, python, python_files, script, table, types, well_formed

from haros_ci.follow.made import SEVERAL

KNOWN = (
    case("startswith", 'PUB("b" if "abc".startswith("a") else "c")', "/b"),
    case("endswith one of several", 'PUB("a" if "abc".endswith(("b", "c")) else "b")', "/a"),
    case("isdigit", 'PUB("a" if "abc".isdigit() else "b")', "/b"),
    case("find", 'PUB("a%d" % "abcb".find("b"))', "/a1"),
    case("rsplit", 'PUB("a/b/c".rsplit("/", 1)[0])', "/a/b"),
    case("partition", 'PUB("a/b/c".partition("/")[2])', "/b/c"),
    case("split at spaces, once", 'PUB("x" + "a b c".split(None, 1)[1].replace(" ", "_"))', "/xb_c"),
    case("strip of nothing", 'PUB(" a ".strip(None))', "/a"),
    case("zfill", 'PUB("a" + "1".zfill(3))', "/a001"),
    case("get_name without its slash", 'PUB(rospy.get_name()[1:] + "/x")', "/n/x"),
    case("last part of get_name", 'PUB(rospy.get_name().split("/")[-1])', "/n"),
    case("percent with a dictionary", 'PUB("%(x)s/%(y)d" % {"x": "a", "y": 3})', "/a/3"),
    case("percent with widths", 'PUB("a%02d/b%.1f" % (3, 1.5))', "/a03/b1.5"),
    case("percent of a tuple made of a list", 'l = ["b"]\nPUB("a%s" % tuple(l))', "/ab"),
    case("format with a width", 'PUB("a{:02d}/{x:>2}".format(3, x="bc"))', "/a03/bc"),
    case("format with an attribute", 'class C:\n    s = "a"\nPUB("{0.s}/{c.s}b".format(C(), c=C()))', "/a/ab"),
    case("format with an entry", 'PUB("{0[k]}{1[0]}".format({"k": "a"}, ["b"]))', "/ab"),
    case("format with a conversion", 'PUB("a{!s}".format("b"))', "/ab"),
    case("format with braces", 'PUB("{{a}}{}".format("b").strip("{").replace("}", ""))', "/ab"),
    case("f-string with a conversion and a width", 'x = "a"\ni = 3\nPUB(f"{x!s}{i:03d}{i!r}")', "/a0033"),
    case("join of numbers as texts", 'PUB("/".join(str(i) for i in range(3)))', "/0/1/2"),
    case("join of a dictionary", 'PUB(",".join({"a": 1}))', "/a"),
    case("join of what map gives", 'PUB("_".join(map(str, [1, 2])))', "/1_2"),
    case("letters of a text", 'for c in "ab":\n    PUB(c)', "/a", "/b"),
    case("basename", 'import os\nPUB(os.path.basename("a/b"))', "/b"),
    case("splitext", 'import os\nPUB(os.path.splitext("a.txt")[0])', "/a"),
    case("numbers", 'PUB("a%d%d%d" % (max(1, 2), sum([1, 2]), abs(-1)))', "/a231"),
    case("any and all", 'PUB("a" if any(x == "b" for x in "ab") and not all([True, False]) else "c")', "/a"),
    case("slice of text", 'PUB("xab"[1:] + "xab"[-1:])', "/abb"),
    case("slice of a list", 'for s in ["a", "b", "c"][1:]:\n    PUB(s)', "/b", "/c"),
    case("reversed by a slice", 'PUB("_".join(["a", "b"][::-1]))', "/b_a"),
    case("reversed", 'PUB("_".join(reversed(["a", "b"])))', "/b_a"),
    case("filter", 'for s in filter(lambda x: x != "a", ["a", "b"]):\n    PUB(s)', "/b"),
    case("filter of what is true", 'PUB("/".join(filter(None, ["a", "", "b"])))', "/a/b"),
    case(
        "comprehension with a condition",
        'l = [rospy.Publisher(n, String, queue_size=1) for n in ["a", "b"] if n != "b"]',
        "/a",
    ),
    case("comprehension over two", 'l = [PUB(x + y) for x in "ab" if x != "b" for y in "cd"]', "/ac", "/ad"),
    case("comprehension of pairs", 'l = [PUB(k) for k, v in {"a": 1, "b": 2}.items() if v > 1]', "/b"),
    case("comprehension within another", 'l = [[PUB(x + y) for x in "ab"] for y in "c"]', "/ac", "/bc"),
    case("comprehension's variable is its own", 'x = "a"\nl = [x for x in ["b"]]\nPUB(x)', "/a"),
    case(
        "dictionary of publishers",
        'd = {n: rospy.Publisher(n, String, queue_size=1) for n in ["a", "b"] if n}',
        "/a",
        "/b",
    ),
    case("dictionary comprehension", 'd = {k.upper(): v for k, v in {"a": "x"}.items()}\nPUB(d["A"])', "/x"),
    case("dictionary of pairs", 'd = dict((x, x + "y") for x in ["a", "b"])\nPUB(d["b"])', "/by"),
    case("dictionary and keywords", 'd = dict({"k": "a"}, j="b")\nPUB(d["k"] + d["j"])', "/ab"),
    case("dictionary unpacked in another", 'd = {"k": "a", **{"k": "b"}}\nPUB(d["k"])', "/b"),
    case(
        "ordered dictionary",
        'from collections import OrderedDict\nd = OrderedDict([("a", "x")])\nfor k, v in d.items():\n    PUB(k + v)',
        "/ax",
    ),
    case("list unpacked in another", 'for s in [*["a"], "b"]:\n    PUB(s)', "/a", "/b"),
    case("unpacked with a star", 'a, *b = ["a", "b", "c"]\nPUB(a)\nPUB(b[1])', "/a", "/c"),
    case("unpacked with a star in front", '*_, b = "x/y/z".split("/")\nPUB(b)', "/z"),
    case("unpacked with a star for nothing", 'a, *b, c = "x", "y"\nPUB(a + c)\nfor n in b:\n    PUB(n)', "/xy"),
    case("unpacked with a star in a loop", 'for a, *r in [("a", "b", "c")]:\n    PUB(a + r[1])', "/ac"),
    case("unpacked to more than there are", 'a, *b, c = ["x"]\nPUB(a)', "/?"),
    case("unpacked from what is not known", "a, *b = text()\nPUB(a)\nPUB(b[0])", "/?", "/?"),
    case("parts of a text", 'a, b = "x/y".split("/")\nPUB(b + a)', "/yx"),
    case("parts of a text that are more", 'a, b = "x/y/z".split("/")\nPUB(a)', "/?"),
    case("entry that is made", 'd = {}\nd["a"] = "x"\nd["a"] += "y"\nPUB(d["a"])', "/xy"),
    case(
        "read is not set",
        'd = {"a": 1}\ntry:\n    d["b"]\nexcept KeyError:\n    pass\nfor k in d:\n    PUB(k)',
        "/a",
    ),
    case("one of several keys", 'd = {"a": "x", "b": "x"}\nPUB(d["a" if cond() else "b"])', "/x"),
    case("key that cannot be meant", 'd = {"a": "x"}\nPUB(d["a" if cond() else "b"])', "/x"),
    case(
        "arguments passed on",
        'def f(*a, **k):\n    return rospy.Publisher(*a, **k)\nf("a", data_class=String, queue_size=1)',
        "/a",
    ),
    case("keywords passed on twice", 'def g(n="d", **k):\n    PUB(n)\ndef f(**k):\n    g(**k)\nf(n="a", x=1)', "/a"),
    case("keyword collected", 'def f(n, **k):\n    PUB(n + k["t"] + k.get("u", "c"))\nf("a", t="b")', "/abc"),
    case(
        "keywords to a base",
        (
            'class B(object):\n    def __init__(self, **k):\n        PUB(k["n"])\nclass C(B):\n'
            '    def __init__(self, **k):\n        super(C, self).__init__(**k)\nC(n="a")'
        ),
        "/a",
    ),
    case(
        "partial of Publisher",
        'from functools import partial\np = partial(rospy.Publisher, data_class=String, queue_size=1)\np("a")\np("b")',
        "/a",
        "/b",
    ),
    case(
        "partial with a keyword",
        'from functools import partial\ndef f(n, s="y"):\n    PUB(n + s)\npartial(f, s="x")("a")',
        "/ax",
    ),
    case(
        "partial of a partial",
        'from functools import partial\ndef f(n, s="y"):\n    PUB(n + s)\npartial(partial(f, s="x"), "a")()',
        "/ax",
    ),
    case(
        "partial with a keyword that is given anew",
        'from functools import partial\ndef f(n, s="y"):\n    PUB(n + s)\npartial(f, s="x")("a", s="z")',
        "/az",
    ),
    case(
        "partial as callback",
        (
            'from functools import partial\ndef cb(m, n="y"):\n    PUB(n)\n'
            'rospy.Subscriber("t", String, partial(cb, n="x"))'
        ),
        "/x",
    ),
    case(
        "partial given to a function",
        (
            'from functools import partial\ndef go(f):\n    f("a")\n'
            "go(partial(rospy.Publisher, data_class=String, queue_size=1))"
        ),
        "/a",
    ),
    case(
        "class in an attribute",
        (
            "class C:\n    Pub = rospy.Publisher\n    def __init__(self):\n"
            '        self.p = self.Pub("a", String, queue_size=1)\nC()'
        ),
        "/a",
    ),
    case(
        "class in an object",
        (
            "class C:\n    def __init__(self, c):\n        self.c = c\n    def go(self):\n"
            '        self.c("a", String, queue_size=1)\nC(rospy.Publisher).go()'
        ),
        "/a",
    ),
    case(
        "class in an attribute of a derived class",
        (
            'class B(object):\n    T = None\n    def __init__(self):\n        self.T("a", String, queue_size=1)\n'
            "class C(B):\n    T = rospy.Publisher\nC()"
        ),
        "/a",
    ),
    case(
        "class in a class",
        (
            'class C:\n    class D:\n        s = "a"\n        def go(self):\n            PUB(self.s)\n'
            '    def __init__(self):\n        self.D().go()\nC()\nPUB(C.D.s + "b")'
        ),
        "/a",
        "/ab",
    ),
    case("class in a base", 'class B:\n    class D:\n        s = "a"\nclass C(B):\n    pass\nPUB(C().D.s)', "/a"),
    case(
        "own class",
        (
            'class C:\n    s = "a"\n    def make(self):\n        return self.__class__()\n    def go(self):\n'
            "        PUB(type(self).s)\nC().make().go()"
        ),
        "/a",
    ),
    case(
        "own class's name",
        "class B:\n    def go(self):\n        PUB(self.__class__.__name__)\nclass C(B):\n    pass\nC().go()",
        "/C",
    ),
    case("lambda as method", 'class C:\n    s = "a"\n    f = lambda self, n: PUB(self.s + n)\nC().f("b")', "/ab"),
    case(
        "method by another name",
        'class C:\n    s = "a"\n    def go(self):\n        PUB(self.s)\n    run = go\nC().run()',
        "/a",
    ),
    case(
        "methods in a table",
        'class C:\n    def go(self, n):\n        PUB(n)\n    table = {"x": go}\nC.table["x"](C(), "a")',
        "/a",
    ),
    case("class body", 'class C:\n    p = rospy.Publisher("a", String, queue_size=1)', "/a"),
    case(
        "class body with names of its own",
        'class C:\n    names = ["a", "b"]\n    p = [rospy.Publisher(n, String, queue_size=1) for n in names]',
        "/a",
        "/b",
    ),
    case(
        "own constructor of a library's class",
        (
            "class P(rospy.Publisher):\n    def __init__(self, n):\n"
            '        rospy.Publisher.__init__(self, n, String, queue_size=1)\nP("a")'
        ),
        "/a",
    ),
    case(
        "name of a publisher",
        'p = rospy.Publisher("a", String, queue_size=1)\nPUB(p.resolved_name + "/b")\nPUB(p.name + "/c")',
        "/a",
        "/a/b",
        "/a/c",
    ),
    case("waiting for a service", 'rospy.wait_for_service("s")\nPUB("a")', "/a"),
    case(
        "resolve_name",
        (
            'PUB(rospy.resolve_name("a") + "/x")\nPUB(rospy.resolve_name("~b") + "/x")\n'
            'PUB(rospy.resolve_name("/c") + "/x")'
        ),
        "/a/x",
        "/c/x",
        "/n/b/x",
    ),
    case("canonicalize_name", 'import rosgraph\nPUB(rosgraph.names.canonicalize_name("/a//b/") + "x")', "/a/bx"),
)

UNKNOWN = (
    case("condition that is not known", 'for s in [n for n in ["a", "b"] if cond()]:\n    PUB(s)', "/?"),
    case(
        "element of a list with a condition that is not known",
        'l = [n for n in ["a", "b"] if cond()]\nPUB(l[0])',
        "/?",
    ),
    case("comprehension over what is not known", 'for s in [n + "x" for n in text()]:\n    PUB(s)', "/?"),
    case("dictionary of what is not known", 'd = {k: "a" for k in text()}\nPUB(d["b"])', "/?"),
    case("dictionary of pairs that are not known", 'd = dict(text())\nPUB(d["b"])', "/?"),
    case("dictionary with a key that is not known", 'd = {text(): "a"}\nPUB(d["b"])', "/?"),
    case("appended in a comprehension of unknown length", 'l = ["a"]\n[l.append(x) for x in text()]\nPUB(l[-1])', "/?"),
    case(
        "taken away in a comprehension of unknown length",
        'l = ["a", "b"]\n[l.pop() for x in text()]\nPUB(l[-1])',
        "/?",
    ),
    case(
        "set in a comprehension under a condition",
        's = "a"\ndef f():\n    global s\n    s = "b"\n[f() for x in ["x"] if cond()]\nPUB(s)',
        "/?",
    ),
    case(
        "set in a comprehension of unknown length",
        's = "a"\ndef f():\n    global s\n    s = "b"\n[f() for x in text()]\nPUB(s)',
        "/?",
    ),
    case(
        "walrus in a comprehension",
        'def f():\n    z = "a"\n    l = [(z := y) for y in text()]\n    PUB(z)\nf()',
        "/?",
    ),
    case("key that is not there", 'd = {"k": "a"}\nPUB(d["x"])', "/?"),
    case(
        "key that is not there, caught",
        'd = {"k": "a"}\ntry:\n    s = d["x"]\nexcept KeyError:\n    s = "b"\nPUB(s)',
        "/b",
    ),
    case("key that is not there, as text", 'd = {"k": "a"}\nPUB(str(d["x"]))', "/?"),
    case("key that is not in a parameter", 'd = rospy.get_param("~d", {"k": "a"})\nPUB(str(d["x"]))', "/?"),
    case("element that is not there", 'l = ["a"]\nPUB(l[3])', "/?"),
    case("sort with a key", 'PUB(sorted(["b", "a"], key=text)[0])', "/?"),
    case("sort the other way", 'PUB(sorted(["b", "a"], reverse=text())[0])', "/?"),
    case("arguments behind what is not known", 'def f(a, b="c"):\n    PUB(a + b)\nf(*text(), "b")', "/?"),
    case("arguments that are not known, collected", 'def f(*a):\n    PUB("n%d" % len(a))\nf("a", *text())', "/n?"),
    case("keywords that are not known, collected", 'def f(**k):\n    PUB("n%d" % len(k))\nf(a=1, **text())', "/n?"),
    case("keyword that may be among those not known", 'def f(n="a", **k):\n    PUB(n)\nf(x=1, **text())', "/?"),
    case("join of what is no text", 'PUB("/".join(["a", 1]))', "/?"),
    case("startswith what is not known", 'PUB("a" if "ab".startswith(text()) else "b")', "/?"),
    case("startswith what is no text", 'PUB("a" if "ab".startswith(1) else "b")', "/?"),
    case("part of a text that is not known", 'PUB(("a" + text())[:1])', "/?"),
    case("slice between what is not known", 'PUB("abc"[number():])', "/?"),
    case("slice set", 'l = ["a", "b"]\nl[0:1] = ["c"]\nPUB(l[0])', "/?"),
    case("nothing of a list", 'for s in ["a"][1:]:\n    PUB(s)', "/?"),
    case("percent of a list", 'l = ["b"]\nPUB("a%s" % ["b"])', "/?"),
    case("percent of a dictionary", 'PUB("a%s" % {"b": 1})', "/a?"),
    case("percent of too many", 'PUB("a%s" % ("b", "c"))', "/?"),
    case("percent of a text as number", 'PUB("a%d" % "b")', "/a?"),
    case("format of what is not known with a width", 'PUB("a{:>4}".format(text()))', "/a?"),
    case("format of a width that is computed", 'PUB("a{:{}}".format("b", 4))', "/a?"),
    case("format of a text in quotes", 'PUB("a{!r}".format("b"))', "/a?"),
    case("format of what is mixed", 'PUB("{}{0}".format("a"))', "/?"),
    case("format of a list", 'PUB("a{}".format(["b"]))', "/a?"),
    case("f-string with a width that is computed", 'i = 3\nPUB(f"a{i:{i}}")', "/a?"),
    case("huge width", 'PUB("a".center(10 ** 9))', "/?"),
    case("partial of what is not known", 'from functools import partial\nPUB(partial(text(), "a")())', "/?"),
    case(
        "partial of arguments that are not known",
        (
            'from functools import partial\ndef cb(m, n="a"):\n    PUB(n)\n'
            'rospy.Subscriber("t", String, partial(cb, *text()))'
        ),
        "/?",
    ),
    case("method of a class that is not known", "class C(text()):\n    pass\nPUB(C().s)", "/?"),
    case("class of what is not known", "PUB(type(text()).__name__)", "/?"),
    case("resolve_name of what is not known", 'PUB(rospy.resolve_name(text()) + "/x")', "/?/x"),
    case("resolve_name of a part that is not known", 'PUB(rospy.resolve_name("a" + text()))', "/a?"),
    case("resolve_name of nothing", 'PUB(rospy.resolve_name(""))', "/?"),
)


@table(KNOWN)
def test_the_only_name_is_known(before: str, code: str, expected: list[str]) -> None:
    got = python(code + "\n")
    assert names(got) == expected
    well_formed(got)


@table(UNKNOWN)
def test_no_name_is_made_up(before: str, code: str, expected: list[str]) -> None:
    got = python(code + "\n")
    assert names(got) == expected
    well_formed(got)
    assert all("fault" not in unknown.reason for end in got.endpoints for unknown in end.unknowns)


def test_a_condition_of_a_comprehension_is_one_of_what_is_made() -> None:
    got = python('l = [rospy.Publisher(n, String, queue_size=1) for n in ["a", "b"] if n != "b" if cond(n)]\n')
    (end,) = ends(got)
    assert (end.name, [(c.statement, c.condition) for c in end.conditions]) == ("/a", [("if", 'n != "b" if cond(n)')])
    assert end.unknowns == ()


def test_what_is_made_in_a_comprehension_of_unknown_length_may_not_be_made() -> None:
    (end,) = ends(python('l = [rospy.Publisher("a", String, queue_size=1) for n in text()]\n'))
    assert end.name == "/a"
    assert [unknown.field for unknown in end.unknowns] == ["conditions"]
    assert SEVERAL not in end.unknowns[0].reason


LAUNCH = """<launch><group ns="g"><param name="x" value="v"/><param name="s/t" value="v"/><node pkg="p" type="n.py" name="me">
<param name="y" value="w"/><remap from="a" to="r"/></node></group></launch>"""
#: Code, the names of publishers, and of getters.
NAMES = (
    ('PUB(rospy.search_param("x"))', ["/g/x"], ["/g/x"]),
    ('PUB(rospy.search_param(param_name="x"))', ["/g/x"], ["/g/x"]),
    ('PUB(rospy.search_param("y"))', ["/g/me/y"], ["/g/me/y"]),
    ('PUB(rospy.search_param("s/u"))', ["/g/s/u"], ["/g/s/u"]),
    ('PUB(rospy.search_param("/x"))', ["/?"], ["/x"]),
    ("PUB(rospy.search_param(text()))", ["/?"], ["/?"]),
    ('PUB(rospy.resolve_name("a") + "/b")', ["/g/r/b"], []),
    ('PUB(rospy.resolve_name("b") + "/b")', ["/g/b/b"], []),
    ('PUB(rospy.resolve_name("~b") + "/b")', ["/g/me/b/b"], []),
    ('PUB(rospy.remap_name("a") + "/b")', ["/g/r/b"], []),
    ('PUB(rospy.remap_name("b") + "/b")', ["/g/b/b"], []),
    ('s = rospy.Subscriber("a", String)\nPUB(s.resolved_name + "/b")', ["/g/r/b"], []),
)


@pytest.mark.parametrize(("code", "publishers", "getters"), NAMES)
def test_names_that_rospy_resolves(code: str, publishers: list[str], getters: list[str]) -> None:
    got = python(code + "\n", LAUNCH)
    assert (names(got), names(got, "getters")) == (publishers, getters)


#: A package with interfaces and a Python package of the same name.
BOTH = {
    "p/CMakeLists.txt": CMAKE.format("p")
    + "catkin_python_setup()\nadd_service_files(FILES S.srv)\nadd_message_files(FILES M.msg)\n"
    "add_action_files(FILES Do.action)\ngenerate_messages()\ncatkin_install_python(PROGRAMS scripts/n.py)\n",
    "p/setup.py": "from distutils.core import setup\nsetup(packages=['p'], package_dir={'': 'src'})\n",
    "p/src/p/__init__.py": "",
    "p/src/p/names.py": 'T = "a"\n',
    "p/srv/S.srv": "---\n",
    "p/msg/M.msg": "int32 a\n",
    "p/action/Do.action": "---\n---\n",
}
INTERFACES = (
    ('from p.srv import S\nrospy.Service("s", S, f)', "servers", [("/s", "p/S")]),
    ('import p.srv\nrospy.Service("s", p.srv.S, f)', "servers", [("/s", "p/S")]),
    ('import p.srv as q\nrospy.Service("s", q.S, f)', "servers", [("/s", "p/S")]),
    ('from p import srv\nrospy.Service("s", srv.S, f)', "servers", [("/s", "p/S")]),
    ('from p.srv import *\nrospy.Service("s", S, f)', "servers", [("/s", "p/S")]),
    ("from p.names import T\nfrom p.msg import M\nrospy.Publisher(T, M, queue_size=1)", "publishers", [("/a", "p/M")]),
    ("import p.names\nimport p.msg\nrospy.Publisher(p.names.T, p.msg.M)", "publishers", [("/a", "p/M")]),
    ('from p.other import S\nrospy.Service("s", S, f)', "servers", [("/s", None)]),
    ('from p.names import S\nrospy.Service("s", S, f)', "servers", [("/s", None)]),
    (
        'import actionlib\nfrom p.msg import *\nactionlib.SimpleActionClient("n", DoAction)',
        "action_clients",
        [("/n", "p/Do")],
    ),
    (
        ('import actionlib, p.msg\ndef f(*a):\n    return actionlib.SimpleActionClient(*a)\nf("n", p.msg.DoAction)'),
        "action_clients",
        [("/n", "p/Do")],
    ),
    ("import actionlib\nactionlib.SimpleActionClient(*text())", "action_clients", [("/?", None)]),
)


@pytest.mark.parametrize(("code", "kind", "expected"), INTERFACES)
def test_interfaces_beside_a_python_package_of_that_name(
    code: str, kind: str, expected: list[tuple[str, str | None]]
) -> None:
    assert types(node(follow(python_files(script(code + "\n")) | BOTH)), kind) == expected


def test_a_package_s_own_module_is_no_generated_one() -> None:
    own = {"p/src/p/msg.py": "class M:\n    pass\n"}
    code = 'from p.msg import M\nrospy.Publisher("a", M, queue_size=1)\n'
    assert types(node(follow(python_files(script(code)) | BOTH | own))) == [("/a", None)]


#: What a function of the language is given, however odd, is no reason to stop.
ODD = (
    '"a".startswith(None)',
    '"a".startswith(["b"])',
    '"a".center(10 ** 12)',
    '"a".zfill(-1)',
    '"a".join(None)',
    '"a".replace("", "b" * 9)',
    '"a".split("")',
    '"%d%%%" % "a"',
    '"%(a" % {}',
    '"{0.a[}".format(1)',
    '"{:z}".format(1)',
    '"{[0]}".format(None)',
    "dict([[]])",
    "dict([[[], 1]])",
    "dict(1, 2, a=3)",
    "max([])",
    "max(1, 'a')",
    "sum(['a'])",
    "abs('a')",
    "chr(-1)",
    "ord('ab')",
    "reversed(1)",
    "sorted([1, 'a'])",
    "[1, 2][::0]",
    "[1, 2]['a':]",
    "'ab'[10 ** 30:]",
    "{}[[]]",
    "{1: 2}[{}]",
    "map(1, [1])",
    "filter(None, 1)",
    "type()",
    "functools.partial()",
    "functools.partial(1)(2)",
    "rospy.Publisher.__init__()",
    "rospy.Publisher.__init__(1, 2)",
    "rospy.resolve_name(1)",
    "rospy.remap_name(None)",
    "rospy.search_param([])",
    "f(*1, **2)",
    "[x for x in 1 if 2 for y in x]",
    "{x: y for x, y in [1]}",
)


@pytest.mark.parametrize("code", ODD)
def test_odd_values_do_not_stop_it(code: str) -> None:
    got = python(f'import functools\nv = {code}\nfor w in v:\n    PUB(w)\nPUB("end")\n')
    assert "/end" in names(got)
    well_formed(got)
