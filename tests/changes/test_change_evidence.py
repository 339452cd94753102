# SPDX-License-Identifier: Apache-2.0
"""An end that is on one side alone counts where the text of the change bears it out; calls are read file by file."""

from __future__ import annotations

import pytest

from haros_ci.analysis.comparison import call_rows
from haros_ci.changes.calls import ChangedCall, calls_in
from haros_ci.changes.change import Difference
from haros_ci.changes.evidence import RevisionCode, TextEvidence, functions_of
from haros_ci.changes.wrappers import Wrappers
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.model.location import Location

LIBRARY = "struct Maker {\n  void make() {\n    node->create_publisher<T>(name, 1);\n  }\n  void rest() {\n    stop();\n  }\n};\n"
USER = "void user() {\n  start();\n}\n"


def source(files: dict[str, str], changed: set[str], languages: frozenset[str] = frozenset({"cpp"})) -> RevisionCode:
    functions = {path: functions_of(read_cpp(text)) for path, text in files.items()}
    return RevisionCode(functions, {path: files[path] for path in changed & files.keys()}, languages)


def is_borne_out(base: dict[str, str], head: dict[str, str], languages: frozenset[str] = frozenset({"cpp"})) -> bool:
    """Whether the publisher of LIBRARY is new by this change."""
    changed = {path for path in base.keys() | head.keys() if base.get(path) != head.get(path)}
    evidence = TextEvidence(source(base, changed, languages), source(head, changed, languages), lambda path: path)
    line = head["lib.hpp"].split("\n").index("    node->create_publisher<T>(name, 1);") + 1
    found = Difference(what="publisher", action="added", name="/x", head=Location("lib.hpp", line, 5))
    return evidence.bears_out(found)


BORNE_OUT = {
    "the call is new": ({"lib.hpp": LIBRARY.replace("    node->create_publisher<T>(name, 1);\n", "")}, {"lib.hpp": LIBRARY}),
    "the file is new": ({}, {"lib.hpp": LIBRARY}),
    "its class is named now": (
        {"lib.hpp": LIBRARY, "u.cpp": USER},
        {"lib.hpp": LIBRARY, "u.cpp": USER.replace("start();", "Maker maker;")},
    ),
    "its function is named now": (
        {"lib.hpp": LIBRARY, "u.cpp": USER},
        {"lib.hpp": LIBRARY, "u.cpp": USER.replace("start();", "some.make();")},
    ),
}  # fmt: skip
NOT_BORNE_OUT = {
    "something else has changed": (
        {"lib.hpp": LIBRARY, "u.cpp": USER},
        {"lib.hpp": LIBRARY, "u.cpp": USER.replace("start();", "begin();")},
    ),
    "the function after it has changed": ({"lib.hpp": LIBRARY}, {"lib.hpp": LIBRARY.replace("stop();", "halt();")}),
    "it has moved down": ({"lib.hpp": LIBRARY}, {"lib.hpp": "// a comment\n\n" + LIBRARY}),
    "it is indented": ({"lib.hpp": LIBRARY}, {"lib.hpp": LIBRARY.replace("    stop", "      stop")}),
}


@pytest.mark.parametrize("name", BORNE_OUT)
def test_borne_out(name: str) -> None:
    assert is_borne_out(*BORNE_OUT[name])


@pytest.mark.parametrize("name", NOT_BORNE_OUT)
def test_not_borne_out(name: str) -> None:
    base, head = NOT_BORNE_OUT[name]
    assert not is_borne_out(base, head)
    assert is_borne_out(base, head, frozenset({"cpp", "yaml"})), "YAML says which plug-ins run"


def calls(text: str, ros: int = 2, python: bool = False) -> list[tuple[str, str, str | None, str | None]]:
    rows = call_rows()["python" if python else "cpp", ros]
    program = read_python(text) if python else read_cpp(text)
    found: tuple[ChangedCall, ...] = calls_in("a", program, rows, Wrappers([(program, rows)]).named)
    return [(call.what, call.name, call.type, call.default) for call in found if call.name.strip("?.")]


CALLS = {
    'node->declare_parameter(name + ".gain", 1.5);': [("parameter", "?.gain", None, "1.5")],
    'declare_parameter<bool>("x", -1);': [("parameter", "x", None, "-1")],
    'this->declare_parameter("x", rclcpp::ParameterValue(std::string("a")));': [("parameter", "x", None, '"a"')],
    'n->declare_parameter("x", compute());': [("parameter", "x", None, None)],
    'p = n->create_publisher<std_msgs::msg::Bool>("~/x", 1);': [("publisher", "~/x", "std_msgs/msg/Bool", None)],
    's = n->create_service<A>("s" + std::to_string(i), cb);': [("service server", "s?", "A", None)],
    "n->declare_parameter(name, 1);": [],
    'n->get_parameter("x", x);': [],
    'publish("x", 1);': [],
    "": [],
}


@pytest.mark.parametrize("body", CALLS)
def test_calls_of_cpp(body: str) -> None:
    assert calls(f"void f() {{ {body} }}\n") == CALLS[body]


def test_calls_of_python() -> None:
    text = (
        "class P:\n    def f(self, node):\n        node.create_subscription(LaserScan, f'{self.n}/scan', self.cb, 1)\n"
    )
    assert calls(text, python=True) == [("subscriber", "?/scan", "LaserScan", None)]
    assert calls("def f():\n    rospy.get_param('~x', 3)\n", 1, python=True) == [("parameter", "~x", None, "3")]


WRAPPER = "template<class T> void Handler::getParam(T & to, const std::string & name, T value) {{ node->declare_parameter({}, value); }}\n"


def test_a_wrapper_is_seen_through() -> None:
    use = 'void f() { getParam(x, "gain", 2); h->getParam(y, "rate", 0.5); }\n'
    found = [("parameter", "gain", None, "2"), ("parameter", "rate", None, "0.5")]
    assert calls(WRAPPER.format("name") + use) == found
    assert calls(WRAPPER.format('prefix + "." + name') + use) == found
    assert calls(WRAPPER.format("full(ns, name)") + use) == found


@pytest.mark.parametrize("inner", ['name + ".gain"', '"fixed"', "other", "value"])
def test_what_is_no_wrapper(inner: str) -> None:
    use = 'void f() { getParam(x, "plugin", 2); }\n'
    assert [call for call in calls(WRAPPER.format(inner) + use) if call[1] == "plugin"] == []
