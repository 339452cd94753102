# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: nodes, endpoints, actions, callbacks, sub-nodes, lifecycle."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import names, ros2_cpp, ros2_main
from ros2_cpp_kit import PUB, SUB, by_name, component, explicit, last, only, policies


@pytest.mark.parametrize(
    ("call", "kind", "name", "type_", "qos"),
    (
        (f'{PUB}("a", 1)', "publishers", "/a", "std_msgs/msg/String", last(1)),
        (f'this->{PUB}("~/a", 1)', "publishers", "/n/a", "std_msgs/msg/String", last(1)),
        (f'{PUB}("/x/a", 1)', "publishers", "/x/a", "std_msgs/msg/String", last(1)),
        (
            'create_publisher<rclcpp::TypeAdapter<std::string, String>>("a", 1)',
            "publishers",
            "/a",
            "std_msgs/msg/String",
            last(1),
        ),
        (f'{SUB}("a", 1, [](String::ConstSharedPtr m) {{}})', "subscribers", "/a", "std_msgs/msg/String", last(1)),
        ('create_generic_publisher("a", "std_msgs/msg/String", 1)', "publishers", "/a", "std_msgs/msg/String", last(1)),
        (
            'create_generic_subscription("a", "std_msgs/msg/String", 1, [](auto m) {})',
            "subscribers",
            "/a",
            "std_msgs/msg/String",
            last(1),
        ),
        (
            'create_service<std_srvs::srv::Empty>("a", [](auto q, auto r) {})',
            "servers",
            "/a",
            "std_srvs/srv/Empty",
            last(10),
        ),
        (
            'create_service<std_srvs::srv::Empty>("a", [](auto q, auto r) {}, rmw_qos_profile_parameters)',
            "servers",
            "/a",
            "std_srvs/srv/Empty",
            last(1000),
        ),
        ('create_client<std_srvs::srv::Empty>("a")', "clients", "/a", "std_srvs/srv/Empty", last(10)),
        ('create_generic_client("a", "std_srvs/srv/Empty")', "clients", "/a", "std_srvs/srv/Empty", last(10)),
        ('rclcpp::create_publisher<String>(this, "a", 1)', "publishers", "/a", "std_msgs/msg/String", last(1)),
        ('rclcpp::create_publisher<String>(*this, "a", 1)', "publishers", "/a", "std_msgs/msg/String", last(1)),
        (
            'rclcpp::create_publisher<String>(get_node_parameters_interface(), get_node_topics_interface(), "a", 1)',
            "publishers",
            "/a",
            "std_msgs/msg/String",
            last(1),
        ),
        (
            'rclcpp::create_subscription<String>(this, "a", 1, [](String::SharedPtr m) {})',
            "subscribers",
            "/a",
            "std_msgs/msg/String",
            last(1),
        ),
        (
            (
                'rclcpp::create_subscription<String>(get_node_parameters_interface(), get_node_topics_interface(), "a",'
                " 1, [](String::SharedPtr m) {})"
            ),
            "subscribers",
            "/a",
            "std_msgs/msg/String",
            last(1),
        ),
        (
            (
                "rclcpp::create_client<std_srvs::srv::Empty>(get_node_base_interface(), get_node_graph_interface(),"
                ' get_node_services_interface(), "a", rclcpp::ServicesQoS(), nullptr)'
            ),
            "clients",
            "/a",
            "std_srvs/srv/Empty",
            last(10),
        ),
        (
            (
                "rclcpp::create_service<std_srvs::srv::Empty>(get_node_base_interface(), get_node_services_interface(),"
                ' "a", [](auto q, auto r) {}, rclcpp::ServicesQoS(), nullptr)'
            ),
            "servers",
            "/a",
            "std_srvs/srv/Empty",
            last(10),
        ),
    ),
)
def test_endpoints(call: str, kind: str, name: str, type_: str, qos: tuple[Any, ...]) -> None:
    end = only(component(f"auto e = {call};"), kind)
    assert (end.name, end.type, policies(end), end.unknowns) == (name, type_, qos, ())


@pytest.mark.parametrize(
    ("call", "kind"),
    (
        ('rclcpp_action::create_server<p::action::Do>(this, "a", g, c, d)', "action_servers"),
        (
            (
                "rclcpp_action::create_server<p::action::Do>(get_node_base_interface(), get_node_clock_interface(),"
                ' get_node_logging_interface(), get_node_waitables_interface(), "a", g, c, d)'
            ),
            "action_servers",
        ),
        ('rclcpp_action::create_client<p::action::Do>(this, "a")', "action_clients"),
        (
            (
                "rclcpp_action::create_client<p::action::Do>(get_node_base_interface(), get_node_graph_interface(),"
                ' get_node_logging_interface(), get_node_waitables_interface(), "a")'
            ),
            "action_clients",
        ),
        ('tf2_ros::BufferClient(this, "a")', "action_clients"),
    ),
)
def test_actions(call: str, kind: str) -> None:
    end = only(component(f"auto e = {call};"), kind)
    wanted = "tf2_msgs/action/LookupTransform" if call.startswith("tf2") else "p/action/Do"
    assert (end.name, end.type, end.unknowns) == ("/a", wanted, ())


MADE_LATER = f'p_ = {PUB}("later", 1);'


@pytest.mark.parametrize(
    "call",
    (
        f"create_wall_timer(100ms, [this]() {{ {MADE_LATER} }})",
        f"create_timer(1s, [this]() {{ {MADE_LATER} }})",
        f"rclcpp::create_timer(this, get_clock(), 100ms, [this]() {{ {MADE_LATER} }})",
        f"add_on_set_parameters_callback([this](auto v) {{ {MADE_LATER} }})",
        f'{SUB}("s", 1, [this](String::ConstSharedPtr m) {{ {MADE_LATER} }})',
        f'create_service<std_srvs::srv::Empty>("s", [this](auto q, auto r) {{ {MADE_LATER} }})',
        "create_wall_timer(100ms, std::bind(&N::later, this))",
    ),
)
def test_callbacks(call: str) -> None:
    members = f"rclcpp::Publisher<String>::SharedPtr p_; void later() {{ {MADE_LATER} }}"
    assert [end.name for end in explicit(component(f"auto e = {call};", members))] == ["/later"]


def test_nodes_that_are_given_to_other_classes() -> None:
    before = (
        "using Publisher = rclcpp::Publisher<String>::SharedPtr;\n"
        f'struct A {{ A(rclcpp::Node & node) : p_(node.{PUB}("a", 1)) {{}} Publisher p_; }};\n'
        f'struct B {{ B(rclcpp::Node * node) {{ p_ = node->{PUB}("~/b", 1); }} Publisher p_; }};\n'
        "struct C { C(rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics,"
        " rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parameters)"
        ' { p_ = rclcpp::create_publisher<String>(parameters, topics, "c", rclcpp::QoS(1)); }'
        " rclcpp::Publisher<String>::SharedPtr p_; };\n"
    )
    body = (
        "a_ = std::make_unique<A>(*this); b_ = std::make_unique<B>(this);"
        "c_ = std::make_unique<C>(get_node_topics_interface(), get_node_parameters_interface());"
    )
    found = component(body, "std::unique_ptr<A> a_; std::unique_ptr<B> b_; std::unique_ptr<C> c_;", before)
    assert [end.name for end in explicit(found)] == ["/a", "/c", "/n/b"]


def test_sub_nodes() -> None:
    body = (
        f'auto sub = create_sub_node("sub"); a_ = sub->{PUB}("a", 1); b_ = sub->{PUB}("/b", 1);'
        f'c_ = sub->{PUB}("~/c", 1);'
        f'auto below = sub->create_sub_node("below"); d_ = below->{PUB}("d", 1); e_ = {PUB}("e", 1);'
    )
    found = ros2_cpp(body)
    assert [node.name for node in found.nodes] == ["/n"]
    assert [end.name for end in explicit(found.nodes[0])] == ["/b", "/e", "/n/c", "/sub/a", "/sub/below/d"]


def test_nodes_of_a_program() -> None:
    found = by_name(
        ros2_main(
            'auto one = rclcpp::Node::make_shared("one", "left");\n'
            f'auto p = one->{PUB}("a", 1);\n'
            'auto two = std::make_shared<rclcpp::Node>("two", rclcpp::NodeOptions().use_intra_process_comms(true));\n'
            f'auto q = two->{PUB}("~/a", 1);\n'
            'rclcpp::Node three("three", "/right", rclcpp::NodeOptions());\n'
            f'auto r = three.{PUB}("a", 1);\n'
            "rclcpp::executors::MultiThreadedExecutor executor;\n"
            "executor.add_node(one); executor.add_node(two->get_node_base_interface()); executor.spin();"
        )
    )
    assert {name: [end.name for end in explicit(node)] for name, node in found.items()} == {
        "/left/one": ["/left/a"],
        "/two": ["/two/a"],
        "/right/three": ["/right/a"],
    }


def test_lifecycle_nodes() -> None:
    before = f"""
class L : public rclcpp_lifecycle::LifecycleNode {{
public:
  explicit L(const std::string & name) : rclcpp_lifecycle::LifecycleNode(name, rclcpp::NodeOptions()) {{}}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) {{
    configured_ = {PUB}("configured", 1);
    return CallbackReturn::SUCCESS;
  }}
  CallbackReturn on_activate(const rclcpp_lifecycle::State & state) {{
    LifecycleNode::on_activate(state);
    activated_ = {PUB}("activated", 1);
    return CallbackReturn::SUCCESS;
  }}
  void nobody() {{ {PUB}("nobody", 1); }}
  rclcpp_lifecycle::LifecyclePublisher<String>::SharedPtr configured_, activated_;
}};
"""
    (found,) = ros2_main('auto l = std::make_shared<L>("l"); rclcpp::spin(l->get_node_base_interface());', before).nodes
    assert (found.name, found.kind) == ("/l", "lifecycle")
    assert [end.name for end in explicit(found)] == ["/activated", "/configured"]
    assert "/l/change_state" in names(found, "servers")


@pytest.mark.parametrize(
    "body",
    (
        "rclcpp::WallRate rate(10);",
        "auto g = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);",
        "rclcpp::SubscriptionOptions options; options.callback_group = nullptr;",
        'auto c = count_publishers("a");',
        "tf2_ros::Buffer buffer(get_clock());",
        "message_filters::Cache<String> cache(10);",
        "message_filters::Subscriber<String> one;",
        "auto q = rclcpp::QoS(1).best_effort();",
        'auto r = resolve_topic("a");',
        'RCLCPP_INFO(get_logger(), "%s", get_name());',
    ),
)
def test_quiet(body: str) -> None:
    found = component(body)
    assert [end for end in found.endpoints if not end.implicit] == []


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ('"/"', "/?"),
        ('std::string("/") + std::string("")', "/?"),
        ('"/a"', "/a"),
        ('"a/b"', "/a/b"),
        ('std::string("/") + "a"', "/a"),
    ],
)
def test_a_slash_alone_is_no_name(written: str, expected: str) -> None:
    (end,) = (one for one in component(f"create_publisher<String>({written}, 1);").endpoints if not one.implicit)
    assert (end.name, [one.field for one in end.unknowns]) == (expected, ["name"] if "?" in expected else [])
