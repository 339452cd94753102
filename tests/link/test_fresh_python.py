# SPDX-License-Identifier: Apache-2.0
"""rospy programs: tables of functions, plug-ins, names of packages and modules, attributes set on some paths."""

from __future__ import annotations

import pytest
from follow_kit import PYTHON_HEAD, PYTHON_INIT, case, ends, follow, names, node, python, python_files, table

from haros_ci.model.architecture import Node

PUBLISH = "def PUB(n):\n    return rospy.Publisher(n, String, queue_size=1)\n"
TWO = 'def one():\n    PUB("one")\ndef two():\n    PUB("two")\n'
CLASSES = (
    'class A(object):\n    def __init__(self, n):\n        PUB("a" + n)\n'
    'class B(object):\n    def __init__(self, n):\n        PUB("b" + n)\n'
)
LAUNCH = '<launch><node pkg="p" type="n.py" name="n" ns="s"/></launch>'
ARGUMENT = '<launch><arg name="x"/><node pkg="p" type="n.py" name="n" ns="$(arg x)"/></launch>'


def script(body: str, launch: str = "", init: str = "", **modules: str) -> Node:
    head = PYTHON_HEAD + PUBLISH + PYTHON_INIT
    files = python_files(head + body, launch, **{name: PYTHON_HEAD + PUBLISH + text for name, text in modules.items()})
    return node(follow(files | {"p/src/lib/__init__.py": init}))


def gaps(found: Node) -> list[str]:
    return [unknown.reason for unknown in found.unknowns if unknown.field == "endpoints"]


KNOWN = (
    case("table of functions", TWO + 'd = {"a": one, "b": two}\nd[x()]()', "/one", "/two"),
    case("what is taken of it is kept", TWO + "d = {}\nd[1] = one\nd[2] = two\nf = d[x()]\nf()", "/one", "/two"),
    case("get", TWO + 'd = {"a": one, "b": two}\nd.get(x(), one)()', "/one", "/two"),
    case("key that is known", TWO + 'd = {"a": one, "b": two}\nd["b"]()', "/two"),
    case("get of a key that is known", TWO + 'd = {"a": one, "b": two}\nd.get("a")()', "/one"),
    case("keys that are not known", TWO + "d = {}\nd[M.X] = one\nd[M.Y] = two\nd[x()]()", "/one", "/two"),
    case("keys of both kinds", TWO + "d = {1: one}\nd[M.Y] = two\nd[x()]()", "/one", "/two"),
    case("table of classes", CLASSES + 'd = {"a": A, "b": B}\no = d[x()]("/n")', "/a/n", "/b/n"),
    case("table of texts", 'd = {"a": "x", "b": "y"}\nPUB(d[x()])', "/?"),
    case("table of one text", 'd = {"a": "x"}\nPUB(d[x()])', "/?"),
    case("what a type checker is to take it for", 'from typing import cast\nPUB(cast(str, "x"))', "/x"),
    case("the same of the module", 'import typing\nPUB(typing.cast("str", "x"))', "/x"),
    case("a cast of one's own", 'def cast(t, v):\n    return v + "y"\nPUB(cast(str, "x"))', "/xy"),
    case("empty table", TWO + "d = {}\nd[x()]()"),
    case(
        "methods in a table of the object",
        "class T(object):\n"
        "    def __init__(self):\n        self.d = {1: self.m, 2: self.k}\n"
        '    def m(self):\n        PUB("m")\n'
        '    def k(self):\n        PUB("k")\n'
        "    def go(self):\n        self.d[x()]()\n"
        "T().go()",
        "/m",
        "/k",
    ),
    case(
        "subclasses",
        "class T(object):\n    KIND = 0\n    def __init__(self, n):\n        PUB(n)\n"
        "    @staticmethod\n    def make(kind, *args):\n"
        "        for c in T.__subclasses__():\n            if kind == c.KIND:\n                return c(*args)\n"
        "class B(T):\n    KIND = 1\n    def __init__(self, n):\n        T.__init__(self, n + 'b')\n"
        "class C(B):\n    KIND = 2\n"
        "T.make(1, 'x')",
        "/xb",
    ),
    case("no subclasses", "class T(object):\n    pass\nfor c in T.__subclasses__():\n    PUB('a')"),
    case(
        "rospy's own modules",
        "import rospy.topics\nfrom rospy.topics import Publisher\n"
        'rospy.topics.Publisher("a", String, queue_size=1)\nPublisher("b", String, queue_size=1)',
        "/a",
        "/b",
    ),
    case("one of two names, both absolute", 'PUB("/a" if x() else "/b")', "/?"),
)


@table(KNOWN)
def test_names(before: str, code: str, expected: list[str]) -> None:
    assert names(script(code)) == sorted(expected)


def test_one_of_several_is_called() -> None:
    found = ends(script(TWO + 'd = {"a": one, "b": two}\nd[x()]()'))
    assert [[(u.field, u.reason) for u in end.unknowns] for end in found] == [
        [("conditions", "one of several functions is called")]
    ] * 2


def test_a_function_under_a_key_that_is_not_known_gets_what_is_not_known() -> None:
    found = script('def one(m):\n    PUB(m.name + "/x")\nd = {}\nd[M.X] = one\nd[x()](y())')
    assert names(found) == ["/?/x"]
    assert gaps(found) == []


def test_a_class_under_a_key_that_is_not_known() -> None:
    found = script(CLASSES + "d = {}\nd[M.X] = A\nd[x()]('n')")
    assert (names(found), gaps(found)) == (
        [],
        ["class A is kept under a key that is not known: who makes it is not seen"],
    )


SUBMODULES = (
    case("all names", "from .Foo import *\n", "/a"),
    case("by name", "from .Foo import Foo\n", "/a"),
    case("by its whole name", "from lib.Foo import Foo\n", "/a"),
    case("under another name", "from .Foo import Foo as Bar\n"),
    case("the module", "from . import Foo\n"),
    case("nothing", ""),
)


@table(SUBMODULES)
def test_a_package_binds_the_name_of_its_module(before: str, code: str, expected: list[str]) -> None:
    module = "class Foo(object):\n    def __init__(self, n):\n        PUB(n)\n"
    assert names(script("from lib import Foo\nFoo('a')", init=code, Foo=module)) == expected
    assert names(script("import lib\nlib.Foo('a')", init=code, Foo=module)) == expected
    assert names(script("from lib.Foo import Foo\nFoo('a')", init=code, Foo=module)) == ["/a"]
    if not expected:
        assert names(script("from lib import Foo\nFoo.Foo('a')", init=code, Foo=module)) == ["/a"]


def test_a_module_beside() -> None:
    beside = {"b": "def one():\n    PUB('one')\n", "c": "class C(object):\n    def __init__(self):\n        PUB('c')\n"}
    found = script(
        "from lib.a import go\ngo()", a="import b\nfrom c import C\ndef go():\n    b.one()\n    C()\n", **beside
    )
    assert names(found) == ["/c", "/one"]


def test_a_library_goes_before_a_module_beside() -> None:
    found = script("from lib.a import go\ngo()", a="import tf\ndef go():\n    tf.TransformBroadcaster()\n", tf="")
    assert names(found) == ["/tf"]
    assert names(script("import b\nb.one()", b="def one():\n    PUB('one')\n")) == []  # a script is in no package


#: What is imported of packages of messages.
OF_MESSAGES = (
    ("from {0}.msg import String as S", "std_msgs"),
    ("from {0}.msg import String as S", "some_msgs"),
    ("from {0}.msg import String as S", "example_interfaces"),
    ("from {0} import msg\nS = msg.String", "some_msgs"),
    ("import {0}.msg\nS = {0}.msg.String", "std_msgs"),
    ("import {0}.msg\nS = {0}.msg.String", "some_msgs"),
)


@pytest.mark.parametrize(("form", "package"), OF_MESSAGES)
def test_a_file_of_the_name_of_a_message_package_changes_no_type(form: str, package: str) -> None:
    code = form.format(package) + "\ndef go():\n    rospy.Publisher('a', S, queue_size=1)\n"
    found = script("from lib.a import go\ngo()", a=code, **{package: ""})
    assert [end.type for end in found.endpoints if not end.implicit] == [f"{package}/String"]
    assert gaps(found) == []


@pytest.mark.parametrize("place", ["std_msgs.py", "std_msgs/__init__.py", "std_msgs/msg/__init__.py", "p/std_msgs.py"])
def test_a_directory_of_the_name_of_a_message_package_changes_no_type(place: str) -> None:
    text = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\ndef main():\n    rclpy.init()\n"
    files = {
        "p/package.xml": "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>",
        "p/setup.py": "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        f"p/{place}": "",
        "p/p/n.py": text + "    node = Node('n')\n    node.create_publisher(String, 'a', 1)\n    rclpy.spin(node)\n",
    }
    (configuration,) = follow(files, 2).configurations
    (found,) = configuration.nodes
    assert [(end.name, end.type) for end in found.endpoints if not end.implicit] == [("/a", "std_msgs/msg/String")]


@pytest.mark.parametrize("form", ["from {0} import name", "import {0}\nname = {0}.name", "from {0}.inner import name"])
@pytest.mark.parametrize("package", ["arm_interfaces", "interfaces", "tool"])
def test_a_module_with_such_a_name_that_is_no_message_package(package: str, form: str) -> None:
    text = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
    main = "def main():\n    rclpy.init()\n    node = Node('n')\n    node.create_publisher(String, name(), 1)\n    rclpy.spin(node)\n"
    files = {
        "p/package.xml": "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>",
        "p/setup.py": f"from setuptools import setup\nsetup(name='p', packages=['p', '{package}'], entry_points={{'console_scripts': ['n = p.n:main']}})\n",
        "p/p/__init__.py": "",
        f"p/{package}/__init__.py": "from .inner import name\n",
        f"p/{package}/inner.py": "def name():\n    return 'right'\n",
        "p/p/n.py": text + form.format(package) + "\n" + main,
    }
    (configuration,) = follow(files, 2).configurations
    (found,) = configuration.nodes
    assert [end.name for end in found.endpoints if not end.implicit] == ["/right"]


def test_python_3_finds_nothing_beside() -> None:
    head = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
    files = {
        "p/package.xml": "<package format='3'><name>p</name><export><build_type>ament_python</build_type></export></package>",
        "p/setup.py": "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        "p/p/other.py": "def name():\n    return 'wrong'\n",
        "p/p/n.py": head + "import other\ndef main():\n    rclpy.init()\n    node = Node('n')\n"
        "    node.create_publisher(String, other.name(), 1)\n    rclpy.spin(node)\n",
    }
    (configuration,) = follow(files, 2).configurations
    (found,) = configuration.nodes
    assert [end.name for end in found.endpoints if not end.implicit] == ["/?"]


EARLY = (
    "class T(object):\n    def __init__(self):\n        if x():\n            return\n        self.%s\n"
    "    def go(self):\n        %s\nT().go()"
)
UNSET = (
    case("object", CLASSES + EARLY % ("d = T2()", "self.d.go()"), "/g"),
    case("text", EARLY % ('t = "a"', "PUB(self.t)"), "/a"),
    case("two texts", EARLY % ('t = "a" if x() else "b"', "PUB(self.t)"), "/?"),
    case("text that a base class outside may set", (EARLY % ('t = "a"', "PUB(self.t)")).replace("object", "l.B"), "/?"),
    case("object with such a base class", (EARLY % ("d = T2()", "self.d.go()")).replace("object", "l.B"), "/g"),
    case(
        "text of the class",
        (EARLY % ('t = "a"', "PUB(self.t)")).replace("    def __init__", '    t = "b"\n    def __init__', 1),
        "/?",
    ),
    case("text of an object from elsewhere", 'm = l.M()\nif x():\n    m.t = "a"\nPUB(m.t)', "/?"),
)


@table(UNSET)
def test_attributes_that_are_set_on_some_paths(before: str, code: str, expected: list[str]) -> None:
    other = "class T2(object):\n    def go(self):\n        PUB('g')\n"
    assert names(script("import l\n" + other + code)) == expected


GAPS = (
    case(
        "module by a name that is not known",
        "import importlib\nm = importlib.import_module(x())\nk = getattr(m, y())\nk('a').start()",
        "k is called: it is imported by a name that is not known",
    ),
    case(
        "module by a name that is known in part",
        "m = __import__(x() + '.plugins', fromlist=['P'])\nm2 = m.P\nm2()",
        "m2 is called: it is imported by a name that is not known",
    ),
    case("message by a name that is not known", "m = __import__(x() + '.msg')\nk = getattr(m.msg, y())\nk()"),
    case("message of a package that is not known", "m = __import__(x())\nk = getattr(getattr(m, 'msg'), y())\nk()"),
    case("module that is known", "import importlib\nm = importlib.import_module('l')\nm.one()"),
    case(
        "callback that is not known",
        "rospy.Subscriber('s', String, y())",
        "what it calls back is not known: what y returns is not known",
    ),
    case("callback of a library", "import l\nrospy.Subscriber('s', String, l.seen)"),
    case("no callback", "rospy.Subscriber('s', String, None)"),
    case("callback that is not given", "rospy.Subscriber('s', String)"),
)


@table(GAPS)
def test_what_is_not_seen_is_told(before: str, code: str, expected: list[str]) -> None:
    assert gaps(script(code)) == expected


def test_a_module_by_its_name() -> None:
    module = "def one():\n    PUB('one')\n"
    assert names(script("import importlib\nimportlib.import_module('lib.b').one()", b=module)) == ["/one"]
    assert names(script("__import__('lib.b').b.one()", b=module)) == ["/one"]
    assert names(script("__import__('lib.b', fromlist=['one']).one()", b=module)) == ["/one"]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('"/a" if x() else "/b"', ["/?"]),
        ('"/a" if x() else "b"', ["/?"]),
        ('"a" if x() else "b"', ["/s/?"]),
        ('"~a" if x() else "~b"', ["/s/n/?"]),
        ('"~a" if x() else "b"', ["/s/?"]),
    ],
)
def test_one_of_two_names_below_a_namespace(code: str, expected: list[str]) -> None:
    assert names(script(f"PUB({code})", LAUNCH)) == expected


@pytest.mark.parametrize(
    ("code", "launch", "value", "told"),
    [
        ("rospy.get_name()", ARGUMENT, None, True),
        ('rospy.get_namespace() + "x"', ARGUMENT, None, True),
        ('"what?"', ARGUMENT, "what?", False),
        ("rospy.get_name()", LAUNCH, "/s/n", False),
    ],
)
def test_a_value_made_of_a_name_that_is_not_known(code: str, launch: str, value: str | None, told: bool) -> None:
    (found,) = ends(script(f'rospy.set_param("/v", {code})', launch), "setters")
    assert (found.value, any(unknown.field == "value" for unknown in found.unknowns)) == (value, told)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("f == ''", "yes"),
        ("f != ''", "no"),
        ("'' == f", "yes"),
        ("f + '/x' == ''", "yes"),
        ("g == ''", "no"),
        ("g != ''", "yes"),
        ("n == ''", "yes"),
        ("f == 'a'", "?"),
        ("f == g + 'a'", "?"),
    ],
)
def test_a_path_of_a_launch_file_is_not_empty(code: str, expected: str) -> None:
    launch = (
        '<launch><arg name="f" default="$(find p)/a"/><arg name="g" default=""/><arg name="n" default="3"/>'
        f'<arg name="t" value="yes" unless="$(eval {code})"/><arg name="t" value="no" if="$(eval {code})"/>'
        '<node pkg="p" type="n.py" name="n" args="$(arg t)"/></launch>'
    )
    assert script("", launch).arguments == expected


def test_parameters_in_brackets_of_python_2() -> None:
    body = (
        'class C:\n    def __init__(self, n):\n        rospy.Subscriber("in", String, self.cb, (n, "x"))\n'
        "    def cb(self, m, (number, name)):\n        PUB(name + str(number))\nC(3)\n"
        "def g(a, (b, c)):\n    if b:\n        PUB(c)\ng(1, (2, 'z'))\n"
    )
    assert names(python(body)) == ["/?", "/x3"]
