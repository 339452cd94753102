# SPDX-License-Identifier: Apache-2.0
"""What is decided as things are: branches that are ruled out, nodes that are null, types that a later reading tells."""

from __future__ import annotations

import pytest
from follow_kit import conditions, ros2_cpp
from test_ros2_python import program

from haros_ci.checking.coexistence import can_meet
from haros_ci.checking.system import End
from haros_ci.model.architecture import Configuration, Endpoint

LISTENER = """struct Listener {
template <class NodeT>
Listener(NodeT && node, bool thread = true) {
  if (thread) sub_ = node->template create_subscription<String>("a", 1, [](String::SharedPtr) {});
  else sub_ = node->template create_subscription<String>("b", 1, [](String::SharedPtr) {});
}
rclcpp::Subscription<String>::SharedPtr sub_;
};
"""
BUFFER = """struct Buffer {
template <typename NodeT = rclcpp::Node::SharedPtr>
Buffer(int size, NodeT && node = NodeT()) {
  if (node) server_ = node->template create_publisher<String>("frames", 1);
}
rclcpp::Publisher<String>::SharedPtr server_;
};
"""


def made(found: Configuration, kinds: str) -> list[Endpoint]:
    return sorted(
        (end for node in found.nodes for end in node.endpoints if end.kind in kinds.split() and not end.implicit),
        key=lambda end: end.name,
    )


def test_what_a_default_argument_rules_out_is_marked() -> None:
    found = ros2_cpp("listener_ = std::make_shared<Listener>(this);", "std::shared_ptr<Listener> listener_;", LISTENER)
    ends = made(found, "subscribers")
    assert [(end.name, end.is_ruled_out, [c[1] for c in conditions(end)]) for end in ends] == [
        ("/a", False, ["thread"]),
        ("/b", True, ["thread"]),
    ]


@pytest.mark.parametrize("argument", ["on", "is_on()", 'declare_parameter<bool>("on")'])
def test_what_is_not_known_rules_nothing_out(argument: str) -> None:
    body = f"bool on = is_on(); listener_ = std::make_shared<Listener>(this, {argument});"
    found = ros2_cpp(body, "std::shared_ptr<Listener> listener_;", "bool is_on();\n" + LISTENER)
    assert {end.name: end.is_ruled_out for end in made(found, "subscribers")} == {"/a": False, "/b": False}


def test_what_is_ruled_out_meets_nothing() -> None:
    body = 'bool on = false; p_ = create_publisher<String>("a", 1); if (on) q_ = create_publisher<String>("a", 1);'
    found = ros2_cpp(body, "rclcpp::Publisher<String>::SharedPtr p_, q_;")
    system = next(iter(node for node in found.nodes if node.name == "/n"))
    ends = [End(None, end) for end in system.endpoints if end.kind == "publishers" and not end.implicit]  # type: ignore[arg-type]
    assert sorted(end.raw.is_ruled_out for end in ends) == [False, True]
    assert list(can_meet(ends, ends[1:])) == [] or not any(e.raw.is_ruled_out for p in can_meet(ends, ends) for e in p)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("b_ = std::make_shared<Buffer>(1);", []),
        ("b_ = std::make_shared<Buffer>(1, this);", ["/frames"]),
        ("b_ = std::make_shared<Buffer>(1, shared_from_this());", ["/frames"]),
    ],
)
def test_a_node_that_is_null_makes_nothing(body: str, expected: list[str]) -> None:
    found = ros2_cpp(body, "std::shared_ptr<Buffer> b_;", BUFFER)
    assert [end.name for end in made(found, "publishers")] == expected


def test_a_private_name_of_several_is_below_the_node() -> None:
    body = 'std::string s = "~/a"; if (wide()) s = "~/b"; publish(s + "");'
    found = ros2_cpp(body, "void publish(std::string s);", "bool wide();\n")
    assert made(found, "publishers") == []
    body = 'std::stringstream s; s << "~/" << name() << "/raw"; p_ = create_publisher<String>(s.str(), 1);'
    found = ros2_cpp(body, "rclcpp::Publisher<String>::SharedPtr p_;", "std::string name();\n")
    assert [end.name for end in made(found, "publishers")] == ["/n/?/raw"]
    body = 'for (auto& each : names()) { std::string s = "~/" + each; if (wide()) s = "~/x/" + each + "/y"; '
    body += "p_ = create_publisher<String>(s, 1); }"
    found = ros2_cpp(
        body, "rclcpp::Publisher<String>::SharedPtr p_;", "std::vector<std::string> names(); bool wide();\n"
    )
    assert {end.name for end in made(found, "publishers")} == {"/n/?"}


#: Code, and the type that the parameter "a" is read with.
READ = (
    ('double d = get_parameter("a").as_double();', "double"),
    ('auto d = get_parameter("a").get_value<double>();', "double"),
    ('auto d = get_parameter("a").get_value<std::vector<std::string>>();', "str[]"),
    ('auto p = get_parameter("a"); auto d = p.as_string_array();', "str[]"),
    ('auto d = get_parameter("a").get_parameter_value().get<std::string>();', "str"),
    ('declare_parameter("a", rclcpp::PARAMETER_INTEGER); auto d = get_parameter("a");', "int"),
    ('auto d = get_parameter("a");', None),
    ('auto p = get_parameter("b"); auto q = get_parameter("a"); p.as_int();', None),
    ('auto d = get_parameter("a").get_type_name();', None),
)


@pytest.mark.parametrize(("body", "expected"), READ)
def test_how_a_parameter_is_read_tells_its_type(body: str, expected: str | None) -> None:
    (end,) = [end for end in made(ros2_cpp(body), "getters") if end.name == "/n:a"]
    assert end.type == expected


def test_a_member_of_a_parameter_value_tells_the_type_in_python() -> None:
    body = "n = Node('a')\nn.declare_parameter('p')\nx = n.get_parameter('p').get_parameter_value().double_value\n"
    ends = made(program(body + "y = n.get_parameter('q').value"), "getters parameters")
    assert [(end.kind, end.name, end.type) for end in ends] == [
        ("getters", "/a:p", "double"),
        ("parameters", "/a:p", "double"),
        ("getters", "/a:q", None),
    ]
    assert [unknown.field for end in ends for unknown in end.unknowns if end.name == "/a:p"] == []


#: A device that is loaded from a file, or by a thread; the callback of a timer looks for what has changed.
DEVICE = """struct Device {
rclcpp::Node & node; std::vector<acme::Sensor> sensors; rclcpp::TimerBase::SharedPtr timer; bool changed = true;
explicit Device(rclcpp::Node & n) : node(n) {}
void start() {
  timer = node.create_wall_timer(1s, [this] { for (int i = 0; i < 60; i++) update(); });
  for (auto & sensor : acme::sensors()) { sensors.push_back(sensor); }
  update();
}
void update() { %s for (auto & sensor : sensors) { if (changed) { changed = false; publish(sensor.name()); } } }
void publish(const std::string & name) { node.create_publisher<String>(name, 1); }
};
"""


def test_what_is_ruled_out_does_not_use_up_what_another_way_may_spend() -> None:
    found = ros2_cpp(
        'std::string file = declare_parameter("file", "");\n'
        "if (!file.empty()) { device = std::make_shared<Device>(*this); device->start(); }\n"
        "else { thread = std::thread([this] { device = std::make_shared<Device>(*this); device->start(); }); }",
        "std::shared_ptr<Device> device; std::thread thread;",
        DEVICE % ("int a = 0; " + "a++; " * 60),
    )
    assert {end.is_ruled_out for end in made(found, "publishers")} == {False}
