# SPDX-License-Identifier: Apache-2.0
"""C++: what braces without an element, or with one, make of numbers, truth values and texts (value initialisation)."""

from __future__ import annotations

import pytest
from follow_kit import case, cpp, ends, names, python, table
from ros2_cpp_kit import component, explicit

TEXT = 'void made(ros::NodeHandle& nh, const std::string& s) { nh.advertise<std_msgs::String>("x" + s, 1); }\n'
NUMBER = 'void made(ros::NodeHandle& nh, int n, bool b = {}) { if (!b) nh.advertise<std_msgs::String>("x" + std::to_string(n), 1); }\n'
GIVEN = "int one() { return {}; } std::string two() { return {}; } int three() { return {3}; }\n"
OBJECT = "struct S { std::string a; int b = 2; int c{}; int d; S(): d() {} };\n"


@table((
    case("a text", 'std::string s = {}; ADV("x" + s, 1);', "/x"),
    case("a number", 'int n = {}; ADV("x" + std::to_string(n), 1);', "/x0"),
    case("a number without a sign", 'int n{}; ADV("x" + std::to_string(n), 1);', "/x0"),
    case("an argument", "made(nh, {});", "/x", before=TEXT),
    case("an argument with an element", 'made(nh, {"a"});', "/xa", before=TEXT),
    case("arguments of numbers, and a default", "made(nh, {}); made(nh, {4});", "/x0", "/x4", before=NUMBER),
    case("what is returned", 'ADV("x" + std::to_string(one()) + two() + std::to_string(three()), 1);', "/x03", before=GIVEN),
    case("members", 'S s; ADV("x" + std::to_string(s.c) + std::to_string(s.d), 1);', "/x00", before=OBJECT),
))  # fmt: skip
def test_numbers_and_texts_begin_with_nothing(before: str, code: str, expected: list[str]) -> None:
    assert names(cpp(code, before)) == expected


@table((
    case("not set", 'int n; ADV("x" + std::to_string(n), 1);', "/x?"),
    case("a list of texts", 'std::vector<std::string> v{}; v.push_back("a"); ADV("x" + v[0], 1);', "/xa"),
    case("a list of one text", 'std::vector<std::string> v = {"a"}; ADV("x" + v[0], 1);', "/xa"),
    case("a pointer", 'std::string* s{}; if (s) ADV(*s, 1); ADV("a", 1);', "/a"),
    case("an object", 'S s{}; ADV("x" + s.a + std::to_string(s.b), 1);', "/x2", before=OBJECT),
    case("a text of several characters", "std::string s = {'a', 'b'}; ADV(\"x\" + s, 1);", "/xab"),
    case("a text of one character several times", "std::string s(2, 'a'); ADV(\"x\" + s, 1);", "/xaa"),
    case("a parameter of a list", "made(nh, {});", "/empty", before=(
        "void made(ros::NodeHandle& nh, std::vector<std::string> v) { if (v.empty()) nh.advertise<std_msgs::String>(\"empty\", 1); }\n")),
))  # fmt: skip
def test_what_is_none_of_them(before: str, code: str, expected: list[str]) -> None:
    assert [name for name in names(cpp(code, before)) if name != "/?"] == expected


@pytest.mark.parametrize(
    ("call", "default"),
    [
        ('declare_parameter<std::string>("a", {});', ""),
        ('declare_parameter<int64_t>("a", {}, rcl_interfaces::msg::ParameterDescriptor());', 0),
        ('declare_parameter<double>("a", {});', 0.0),
        ('declare_parameter<bool>("a", {});', False),
        ('declare_parameter<int>("a", {5});', 5),
        ('declare_parameter<std::vector<double>>("a", {});', []),
        ('declare_parameter<std::vector<double>>("a", {1.0});', [1.0]),
        ('declare_parameter("a", std::vector<std::string>{});', []),
    ],
)
def test_a_default_has_the_type_of_its_parameter(call: str, default: object) -> None:
    (end,) = explicit(component(call), "parameters")
    assert end.value == default and type(end.value) is type(default)


def test_a_default_of_ros_1_has_the_type_of_its_parameter() -> None:
    found = cpp('std::string s; nh.param<std::string>("a", s, {}); int n; nh.param<int>("b", n, {2}); ADV("x" + s, 1);')
    assert {end.name: end.value for end in ends(found, "getters")} == {"/a": "", "/b": 2} and names(found) == ["/x"]


def test_lists_of_python_stay_lists() -> None:
    code = 'def made(n: int = [], s: str = ["a"]):\n    PUB("x" if n == [] and s == ["a"] else "y")\nmade()\nmade([], ["a"])\n'
    assert set(names(python(code))) == {"/x"}
