# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: parameters that are declared, read and set, and clients of other nodes' parameters."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, follow, ros2_files
from ros2_cpp_kit import PUB, component, explicit, last, only, policies


def parameter(body: str) -> tuple[Any, ...]:
    """Name, type and default of the only parameter that the body declares."""
    (end,) = explicit(component(body), "parameters")
    return end.name, end.type, end.value


@pytest.mark.parametrize(
    ("constant", "expected"),
    (
        ('char FRAME[]{"map"}', ("str", "map")),
        ('char FRAME[] = "map"', ("str", "map")),
        ('char FRAME[4] = "map"', ("str", "map")),
        ('char * FRAME = "map"', ("str", "map")),
        ("char FRAME = 'm'", ("int", 109)),
        ("float FRAME{5.0}", ("double", 5.0)),
    ),
)
def test_constants_as_defaults(constant: str, expected: tuple[Any, ...]) -> None:
    assert parameter(f'static constexpr const {constant}; declare_parameter("a", FRAME);')[1:] == expected


@pytest.mark.parametrize(
    ("call", "expected"),
    (
        ('declare_parameter("a", 1)', ("/n:a", "int", 1)),
        ('declare_parameter("a", 1.5)', ("/n:a", "double", 1.5)),
        ('declare_parameter("a", true)', ("/n:a", "bool", True)),
        ('declare_parameter("a", "x")', ("/n:a", "str", "x")),
        ('declare_parameter("a", std::string("x"))', ("/n:a", "str", "x")),
        ('declare_parameter<double>("a", 1)', ("/n:a", "double", 1.0)),
        ('declare_parameter<std::string>("a")', ("/n:a", "str", None)),
        ('declare_parameter<bool>("a", rcl_interfaces::msg::ParameterDescriptor())', ("/n:a", "bool", None)),
        ('declare_parameter("a", rclcpp::ParameterValue(3))', ("/n:a", "int", 3)),
        ('declare_parameter("a", rclcpp::ParameterValue{"x"}).get<std::string>()', ("/n:a", "str", "x")),
        ('this->declare_parameter<int>("a.b", 1)', ("/n:a.b", "int", 1)),
        ('get_node_parameters_interface()->declare_parameter("a", rclcpp::ParameterValue(3))', ("/n:a", "int", 3)),
        ('autoware_utils::get_or_declare_parameter<double>(*this, "a")', ("/n:a", "double", None)),
        ('nav2::declare_or_get_parameter(shared_from_this(), "a", 2.0)', ("/n:a", "double", 2.0)),
        (
            'nav2_util::declare_parameter_if_not_declared(this, "a", rclcpp::ParameterValue(2.0))',
            ("/n:a", "double", 2.0),
        ),
    ),
)
def test_declared_parameters(call: str, expected: tuple[Any, ...]) -> None:
    assert parameter(f"auto v = {call};") == expected


@pytest.mark.parametrize(
    "read",
    (
        'auto v = declare_parameter<std::string>("t", "topic");',
        'declare_parameter("t", "topic"); auto v = get_parameter("t").as_string();',
        'declare_parameter("t", "topic"); auto v = get_parameter("t").get_value<std::string>();',
        'declare_parameter("t", "topic"); auto v = get_parameter("t").get_parameter_value().get<std::string>();',
        'declare_parameter("t", "topic"); std::string v; get_parameter("t", v);',
        'declare_parameter("t", "topic"); std::string v; get_parameter_or<std::string>("t", v, "other");',
        'std::string v; get_parameter_or<std::string>("t", v, "topic");',
        'auto v = get_parameter_or<std::string>("t", "topic");',
        'auto v = declare_parameter("t", rclcpp::ParameterValue("topic")).get<std::string>();',
        (
            'declare_parameter("t", "x"); set_parameter(rclcpp::Parameter("t", "topic"));'
            'auto v = get_parameter("t").as_string();'
        ),
        'if (!has_parameter("t")) { declare_parameter("t", "topic"); } auto v = get_parameter("t").as_string();',
    ),
)
def test_names_from_parameters(read: str) -> None:
    end = only(component(f"{read} p_ = {PUB}(v, 1);"))
    assert (end.name, end.unknowns) == ("/topic", ())


@pytest.mark.parametrize(
    "read",
    (
        'auto v = declare_parameter<std::string>("t");',
        'auto v = declare_parameter<std::string>("t", name_from_file());',
        'declare_parameter<std::string>("t"); auto v = get_parameter("t").as_string();',
        'declare_parameter<std::string>("t"); std::string v; get_parameter("t", v);',
        'declare_parameter("t", rclcpp::PARAMETER_STRING); std::string v; get_parameter("t", v);',
        'declare_parameter<std::string>("t"); std::string v; get_parameter_or<std::string>("t", v, "other");',
        (
            'if (!has_parameter("t")) { declare_parameter<std::string>("t"); } std::string v;'
            'if (has_parameter("t")) { get_parameter("t", v); } else { v = "other"; }'
        ),
    ),
)
def test_names_that_parameters_do_not_tell(read: str) -> None:
    end = only(component(f"{read} p_ = {PUB}(v, 1);"))
    assert end.name == "/?"
    assert [unknown.field for unknown in end.unknowns] == ["name"]


@pytest.mark.parametrize(
    ("made", "remote"),
    (
        ('std::make_shared<rclcpp::AsyncParametersClient>(this, "/other")', "/other"),
        ('std::make_shared<rclcpp::SyncParametersClient>(this, "other")', "/other"),
        ("std::make_shared<rclcpp::AsyncParametersClient>(this)", "/n"),
        (
            (
                "std::make_shared<rclcpp::AsyncParametersClient>(get_node_base_interface(),"
                ' get_node_topics_interface(), get_node_graph_interface(), get_node_services_interface(), "/other")'
            ),
            "/other",
        ),
    ),
)
def test_clients_of_parameters(made: str, remote: str) -> None:
    found = explicit(component(f"c_ = {made};"), "clients")
    assert [end.name for end in found] == [
        f"{remote}/{service}"
        for service in [
            "describe_parameters",
            "get_parameter_types",
            "get_parameters",
            "list_parameters",
            "set_parameters",
            "set_parameters_atomically",
        ]
    ]
    assert {policies(end) for end in found} == {last(1000)}


LATER = """
std::string topic() {
  if (has_parameter("topic")) { return get_parameter("topic").as_string(); }
  return declare_parameter("topic", std::string("out"));
}
void one() { p_ = create_publisher<String>(topic(), 1); }
void two() { q_ = create_publisher<String>(topic() + "_2", 1); }
rclcpp::Publisher<String>::SharedPtr q_;
"""


def test_callbacks_that_may_each_declare_a_parameter_first() -> None:
    timers = "create_wall_timer(1s, [this]() { one(); }); create_wall_timer(1s, [this]() { two(); });"
    assert [end.name for end in explicit(component(timers, LATER))] == ["/out", "/out_2"]


def test_callbacks_that_declare_a_parameter_with_other_values() -> None:
    timers = (
        'create_wall_timer(1s, [this]() { declare_parameter("topic", "else"); });'
        "create_wall_timer(1s, [this]() { one(); });"
    )
    found = explicit(component(timers, LATER))
    assert [(end.name, [unknown.field for unknown in end.unknowns]) for end in found] == [
        ("/else", ["conditions"]),
        ("/out", ["conditions"]),
    ]


@pytest.mark.parametrize(
    ("declared", "read", "names"),
    (
        ('std::vector<std::string>{"a", "b"}', "for (auto & name : param.as_string_array())", ["/a", "/b"]),
        ('std::vector<std::string>{"a"}', "for (auto & name : param.get_value<std::vector<std::string>>())", ["/a"]),
        ('"x" + std::to_string(1)', "auto name = param.as_string();", ["/x1"]),
        ("from_file()", "auto name = param.as_string();", ["/?"]),
    ),
)
def test_a_parameter_that_is_read_into_an_object(declared: str, read: str, names: list[str]) -> None:
    body = f'declare_parameter("p", {declared}); rclcpp::Parameter param("p", {declared}); get_parameter("p", param);'
    found = component(f"{body} {read} {{ {PUB}(name, 1); }}".replace("; {", f"; {PUB}(name, 1); if (false) {{"))
    assert sorted({end.name for end in explicit(found)}) == names


LIST = 'for (const auto & each : list_parameters({%s}, %s).%s) { create_publisher<String>("/" + each, 1); }'


@pytest.mark.parametrize(
    ("prefixes", "depth", "what", "expected"),
    (
        ('"a"', 0, "names", ["/a.b", "/a.c.d"]),
        ('"a"', 1, "names", ["/a.b"]),
        ('"a", "x"', 1, "names", ["/a.b", "/x"]),
        ("", 0, "names", ["/a.b", "/a.c.d", "/ab", "/x"]),
        ("", 1, "names", ["/ab", "/x"]),
        ('"a"', 0, "prefixes", ["/a", "/a.c"]),
        ('"n"', 0, "names", []),
    ),
)
def test_parameters_that_are_listed(prefixes: str, depth: int, what: str, expected: list[str]) -> None:
    declared = 'for (const std::string name : {"x", "ab", "a.c.d", "a.b"}) { declare_parameter<int>(name, 1); }'
    found = explicit(component(declared + LIST % (prefixes, depth, what)))
    assert [end.name for end in found] == expected


def test_lists_of_what_is_not_known() -> None:
    for declared in ('declare_parameter<int>("a." + get_name_from_file(), 1);', 'prefix_ = std::getenv("P");'):
        prefix = '"a"' if "declare" in declared else "prefix_"
        (end,) = explicit(component(declared + LIST % (prefix, 0, "names"), "std::string prefix_;"))
        assert end.name == "/?"


@pytest.mark.parametrize(("option", "expected"), (("true", ["/n.one", "/n.two"]), ("false", [])))
def test_parameters_that_are_declared_because_they_are_given(option: str, expected: list[str]) -> None:
    head = f'Node("n", rclcpp::NodeOptions(options).automatically_declare_parameters_from_overrides({option}))'
    code = ROS2_HEAD + (ROS2_NODE % (LIST % ('"n"', 0, "names"), "")).replace('Node("n", options)', head)
    launch = (
        '<launch><node pkg="p" exec="n"><param name="n.two" value="2"/><param name="n.one" value="1"/>'
        '<param name="other" value="1"/></node></launch>'
    )
    (found,) = follow(ros2_files(code, {"l.launch.xml": launch}), 2).configurations
    assert [end.name for end in explicit(found.nodes[0])] == expected


def test_names_as_the_node_resolves_them() -> None:
    code = ROS2_HEAD + ROS2_NODE % (
        'auto topics = get_node_topics_interface(); create_publisher<String>(topics->resolve_topic_name("a") + "/1", 1);'
        'create_publisher<String>(topics->resolve_topic_name("a", false) + "/2", 1);'
        'create_publisher<String>(topics->resolve_topic_name("a", true) + "/3", 1);',
        "",
    )
    launch = '<launch><node pkg="p" exec="n"><remap from="a" to="b"/></node></launch>'
    (found,) = follow(ros2_files(code, {"l.launch.xml": launch}), 2).configurations
    assert [end.name for end in explicit(found.nodes[0])] == ["/a/3", "/b/1", "/b/2"]
