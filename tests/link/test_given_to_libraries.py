# SPDX-License-Identifier: Apache-2.0
"""Functions and objects that are given to a library which is not in the workspace, in a function that makes nothing else."""

from __future__ import annotations

import pytest
from follow_kit import case, cpp, ends, names, python, table

MAIN = 'import lib\nimport signal\ndef f(*a):\n    PUB("f")\ndef main():\n    %s\nmain()\n'
CLASS = 'import lib\nclass K:\n    def __init__(self):\n        self.go()\n    def go(self):\n        %s\n    def f(self, *a):\n        PUB("f")\nK()\n'


@table((
    case("a function", MAIN % "lib.start(f)", "/f"),
    case("by a keyword", MAIN % "lib.start(callback=f)", "/f"),
    case("for a signal", MAIN % "signal.signal(signal.SIGINT, f)", "/f"),
    case("inside of another call", MAIN % 'lib.add("a", lib.State(f))', "/f"),
    case("a method", CLASS % 'lib.on("a", self.f)', "/f"),
))  # fmt: skip
def test_functions_that_are_given(before: str, code: str, expected: list[str]) -> None:
    assert names(python(code)) == expected


@table((
    case("none", MAIN % "lib.start(1)"),
    case("a text of its name", MAIN % 'lib.start("f")'),
    case("what is printed", CLASS % "print(self.g)"),
    case("a name that is another's", MAIN % "f2 = 1\n    lib.start(f2)"),
))  # fmt: skip
def test_what_is_no_function(before: str, code: str, expected: list[str]) -> None:
    assert names(python(code)) == expected


STATE = (
    "import smach\nclass S(smach.State):\n    def __init__(self):\n        smach.State.__init__(self, outcomes=['a'])\n"
    "    def execute(self, data):\n        self.inner()\n        return 'a'\n    def inner(self):\n        PUB('s')\n"
)
APP = "import lib\nclass App(lib.App):\n    def build(self):\n        PUB('b')\n    @property\n    def p(self):\n        PUB('p')\n    @staticmethod\n    def q():\n        PUB('q')\n"
TREE = (
    "import py_trees\nclass B(py_trees.behaviour.Behaviour):\n    def __init__(self, n):\n        super().__init__(n)\n        self.n = n\n"
    "    def setup(self):\n        PUB(self.n)\n    def update(self):\n        pass\nclass C(B):\n    pass\n"
)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (STATE + "def main():\n    sm = smach.StateMachine(outcomes=['x'])\n    with sm:\n        smach.StateMachine.add('S', S())\nmain()\n", "/s"),
        (APP + "def main():\n    App().run()\nmain()\n", "/b"),
        (APP + "def main():\n    app = App()\n    lib.serve(app)\nmain()\n", "/b"),
        (APP.replace("(lib.App)", "(lib.App, abc.ABC)") + "def main():\n    App().run()\nmain()\n", "/b"),
        (APP.replace("(lib.App)", "(Generic[T], lib.App)") + "def main():\n    lib.serve(App())\nmain()\n", "/b"),
        (TREE + "def main():\n    root = py_trees.composites.Sequence()\n    root.add_child(C('c'))\nmain()\n", "/c"),
    ],
)  # fmt: skip
def test_objects_whose_base_class_is_a_librarys_may_be_called(code: str, expected: str) -> None:
    (end,) = ends(python(code))
    assert end.name == expected
    assert [u.field for u in end.unknowns] == ["conditions"] and "may call it by its base class" in end.unknowns[
        0
    ].reason


KNOWN = "import %s\nclass A(%s):\n    def made(self):\n        PUB('m')\ndef main():\n    a = A()\n    lib.take(a)\nmain()\n"


@pytest.mark.parametrize(
    "code",
    [
        "import lib\n" + KNOWN % ("enum", "enum.Enum"),
        "import lib\n" + KNOWN % ("abc", "abc.ABC"),
        "import lib\n" + KNOWN % ("threading", "object"),
        "import lib\n" + KNOWN % ("tkinter", "tkinter.Frame"),
        "import lib\nclass P:\n    pass\nclass A(P):\n    def made(self):\n        PUB('m')\ndef main():\n    lib.take(A())\nmain()\n",
        STATE + "def main():\n    pass\nmain()\n",
    ],
)
def test_objects_that_nothing_of_a_library_calls(code: str) -> None:
    assert not names(python(code))


def test_a_method_that_the_program_calls_is_known_by_that_call() -> None:
    helper = "import lib\nclass A(lib.Base):\n    def made(self, name):\n        PUB(name)\ndef main():\n    a = A()\n    lib.take(a)\n    a.made('m')\nmain()\n"
    (end,) = ends(python(helper))
    assert end.name == "/m" and not end.unknowns


def test_what_is_called_for_sure_stays_certain() -> None:
    (end,) = ends(python(APP + "def main():\n    app = App()\n    app.build()\n    app.run()\nmain()\n"))
    assert end.name == "/b" and not end.unknowns


WORKER = "import multiprocessing\nfrom multiprocessing import Process\nclass W(%s):\n    def run(self):\n        %s\ndef main():\n    w = W()\n    w.start()\nmain()\n"


@pytest.mark.parametrize("base", ["Process", "multiprocessing.Process"])
def test_a_process_of_its_own_is_followed_and_named(base: str) -> None:
    found = python(WORKER % (base, "rospy.init_node('w')\n        PUB('w')"))
    assert names(found) == ["/w"]
    assert [(u.field, u.reason) for u in found.unknowns][:1] == [
        ("endpoints", "W is a process of its own: what that makes is told of the node that starts it")
    ]


def test_a_process_that_makes_nothing_is_not_named() -> None:
    assert not python(WORKER % ("Process", "print(1)")).unknowns


SERVICE = (
    "struct Own { virtual ~Own() {} };\nstruct S : %s {\n  ros::NodeHandle h;\n  ros::Publisher p;\n"
    '  virtual void onStart() { p = h.advertise<std_msgs::String>("s", 1); }\n'
    '  void other() { p = h.advertise<std_msgs::String>("o", 1); }\n'
    "};\nlib::Context context;\n"
)


@pytest.mark.parametrize(
    "bases",
    [
        "lib::Service",
        "Own, lib::Service",
        "boost::enable_shared_from_this<S>, public lib::Service",
        "private boost::noncopyable, public lib::Service, public std::enable_shared_from_this<S>",
    ],
)
def test_objects_of_cpp_that_a_library_may_call(bases: str) -> None:
    found = cpp("auto s = boost::make_shared<S>(); context.add(s);", before=SERVICE % bases)
    (end,) = ends(found)
    assert end.name == "/s" and "may call it by its base class lib::Service" in end.unknowns[0].reason


@pytest.mark.parametrize("bases", ["Own", "boost::noncopyable", "std::enable_shared_from_this<S>, Own"])
def test_objects_of_cpp_that_no_library_calls(bases: str) -> None:
    assert not names(cpp("auto s = boost::make_shared<S>(); context.add(s);", before=SERVICE % bases))
