# SPDX-License-Identifier: Apache-2.0
"""What ``get_parameters`` returns in rclpy and rclcpp: a parameter for each name, its value as far as that is known."""

from __future__ import annotations

import pytest
from follow_kit import explicit
from ros2_cpp_kit import component
from test_ros2_python import node

DECLARED = "self.declare_parameter('raw', False)\nself.declare_parameter('topic', 't')\n"
USED = "\nif raw: self.create_publisher(String, 'raw', 10)\nself.create_publisher(String, topic, 10)\n"
READ = "p = self.get_parameters(['raw', 'topic'])\n"
PYTHON = {
    "by index": READ + "raw = p[0].value\ntopic = p[1].value",
    "from the end": READ + "raw = p[-2].value\ntopic = p[-1].value",
    "messages": READ + "raw = p[0].get_parameter_value().bool_value\ntopic = p[1].get_parameter_value().string_value",
    "by keyword": "p = self.get_parameters(names=('raw', 'topic'))\nraw = p[0].value\ntopic = p[1].value",
    "names in a variable": "n = ['raw', 'topic']\np = self.get_parameters(n)\nraw = p[0].value\ntopic = p[1].value",
    "unpacked": "r, t = self.get_parameters(['raw', 'topic'])\nraw = r.value\ntopic = t.value",
    "a comprehension": "raw, topic = [x.value for x in self.get_parameters(['raw', 'topic'])]",
    "a dictionary": (
        "p = {x.name: x.value for x in self.get_parameters(['raw', 'topic'])}\nraw, topic = p['raw'], p['topic']"
    ),
    "appended": "v = []\nfor x in self.get_parameters(['raw', 'topic']):\n    v.append(x.value)\nraw, topic = v",
    "a loop that asks for the name": (
        "for p in self.get_parameters(['raw', 'topic']):\n"
        "    if p.name == 'raw': raw = p.get_parameter_value().bool_value\n"
        "    else: topic = p.get_parameter_value().string_value"
    ),
}
#: What is not known: the names of the publishers, whether the first is ruled out, and the getters with their types.
QUIET = {
    "a name that is not known": (
        "p = self.get_parameters(['raw', input()])\nraw = p[0].value\ntopic = p[1].value",
        {"/s/raw": True, "/?": False},
        {"/s/n:raw": "bool", "/s/n:?": None},
    ),
    "a list that is not known": (
        "p = self.get_parameters(input())\nraw = p[0].value\ntopic = p[1].value",
        {"/s/raw": False, "/?": False},
        {},
    ),
    "a list that is longer on some ways": (
        "n = ['raw']\nif input(): n.append('topic')\np = self.get_parameters(n)\nraw = p[0].value\ntopic = p[1].value",
        {"/s/raw": False, "/?": False},
        {},
    ),
    "one that is not declared": (
        "p = self.get_parameters(['raw', 'other'])\nraw = p[0].value\ntopic = p[1].value",
        {"/s/raw": True, "/?": False},
        {"/s/n:raw": "bool", "/s/n:other": None},
    ),
    "beyond the end": (
        READ + "raw = p[0].value\ntopic = p[2].value",
        {"/s/raw": True, "/?": False},
        {"/s/n:raw": "bool", "/s/n:topic": "str"},
    ),
    "unpacked to fewer": (
        "raw = False\nr, topic = self.get_parameters(['raw', 'topic', 'other'])",
        {"/s/raw": True, "/?": False},
        {"/s/n:raw": "bool", "/s/n:topic": "str", "/s/n:other": None},
    ),
    "types only": (
        "p = self.get_parameter_types(['raw', 'topic'])\nraw = p[0]\ntopic = p[1]",
        {"/s/raw": False, "/?": False},
        {"/s/n:raw": "bool", "/s/n:topic": "str"},
    ),
    "below a prefix": (
        "raw = False\ntopic = self.get_parameters_by_prefix('topic')['topic'].value",
        {"/s/raw": True, "/?": False},
        {},
    ),
}


@pytest.mark.parametrize("code", PYTHON.values(), ids=PYTHON)
def test_in_python(code: str) -> None:
    found = node(DECLARED + code + USED)
    assert {end.name: end.is_ruled_out for end in explicit(found)} == {"/s/raw": True, "/s/t": False}
    assert {end.name: end.type for end in explicit(found, "getters")} == {"/s/n:raw": "bool", "/s/n:topic": "str"}


@pytest.mark.parametrize(("code", "expected", "getters"), QUIET.values(), ids=QUIET)
def test_what_is_not_known_in_python(code: str, expected: dict[str, bool], getters: dict[str, str | None]) -> None:
    found = node(DECLARED + code + USED)
    assert {end.name: end.is_ruled_out for end in explicit(found)} == expected
    assert {end.name: end.type for end in explicit(found, "getters")} == getters


def test_values_are_those_at_the_call() -> None:
    set_ = "self.set_parameters([Parameter('topic', Parameter.Type.STRING, 'u')])\n"
    read = READ + "raw = p[0].value\n"
    before, after = (
        [end.name for end in explicit(node(DECLARED + code + "\ntopic = p[1].value" + USED))]
        for code in (set_ + read, read + set_)
    )
    assert "/s/u" in before and "/s/t" in after


CPP = (
    'declare_parameter("raw", false); declare_parameter("topic", "t"); %s '
    'if (raw) create_publisher<String>("raw", 1); create_publisher<String>(topic, 1);'
)
VECTOR = "std::vector<rclcpp::Parameter>"
LISTS = {
    "by index": (
        'auto p = get_parameters({"raw", "topic"}); bool raw = p[0].as_bool(); std::string topic = p[1].as_string();',
        {"/raw": True, "/t": False},
    ),
    "of a vector": (
        f'std::vector<std::string> n{{"raw", "topic"}}; {VECTOR} p = this->get_parameters(n); '
        "auto raw = p.at(0).get_parameter_value().get<bool>(); auto topic = p.back().get_value<std::string>();",
        {"/raw": True, "/t": False},
    ),
    "a loop that asks for the name": (
        'bool raw; std::string topic; for (const auto & p : get_parameters({"raw", "topic"})) '
        '{ if (p.get_name() == "raw") { raw = p.as_bool(); } else { topic = p.as_string(); } }',
        {"/raw": True, "/t": False},
    ),
    "a name that is not known": (
        'auto p = get_parameters({"raw", f()}); bool raw = p[0].as_bool(); auto topic = p[1].as_string();',
        {"/raw": True, "/?": False},
    ),
    "a list that is not known": (
        "auto p = get_parameters(f()); bool raw = p[0].as_bool(); auto topic = p[1].as_string();",
        {"/raw": False, "/?": False},
    ),
    "below a prefix": (
        'std::map<std::string, std::string> m; get_parameters("a", m); bool raw = false; auto topic = m["topic"];',
        {"/raw": True, "/?": False},
    ),
}


@pytest.mark.parametrize(("code", "expected"), LISTS.values(), ids=LISTS)
def test_in_cpp(code: str, expected: dict[str, bool]) -> None:
    found = component(CPP % code)
    assert {end.name: end.is_ruled_out for end in explicit(found)} == expected
    types = {"/n:raw": "bool", "/n:topic": "str"} if "/t" in expected else {}
    assert {end.name: end.type for end in explicit(found, "getters")}.items() >= types.items()
