# SPDX-License-Identifier: Apache-2.0
"""Quality of service that parameters override: of ends that are given the options for it, and of no others."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, ends, explicit, follow, only, ros2_files
from ros2_cpp_kit import BEST, KEPT, PUB, SUB, last, policies
from test_ros2_python import HEAD, MAIN, files

from haros_ci.model.architecture import Endpoint, Node, Qos

LAUNCH = '<launch><node pkg="p" exec="n"{}>{}</node></launch>'
OPTIONS = "rclcpp::PublisherOptions o; o.qos_overriding_options = {};"
DEFAULTS = "rclcpp::QosOverridingOptions::with_default_policies()"
KIND = "rclcpp::QosPolicyKind::"
MAKE = f'p_ = {PUB}("t", 10, o);'
HEAD_OF = "qos_overrides./t.publisher."


def node(body: str, given: str = "", attributes: str = "") -> Node:
    """The node of a launch file that gives it parameters."""
    text = ROS2_HEAD + ROS2_NODE % (body, "rclcpp::PublisherBase::SharedPtr p_;")
    launch = LAUNCH.format(attributes, given)
    found = only(follow(ros2_files(text, {"l.launch.xml": launch}), 2))
    return found.nodes[0]


def param(policy: str, value: object, head: str = HEAD_OF) -> str:
    return f'<param name="{head}{policy}" value="{value}"/>'


def of(found: Node, kind: str = "publishers") -> list[Endpoint]:
    return sorted(explicit(found, kind), key=lambda end: (end.name, end.location and end.location.sort_key))


def declared(found: Node) -> dict[str, tuple[object, ...]]:
    """Type, default and effective value of what overriding options declare, by name after the node's."""
    return {
        end.name.partition(":qos_overrides.")[2]: (end.type, end.value, end.effective)
        for end in ends(found, "parameters")
        if "qos_overrides." in end.name
    }


def test_what_is_declared() -> None:
    found = node(OPTIONS.format(DEFAULTS) + MAKE)
    assert declared(found) == {
        "/t.publisher.history": ("str", "keep_last", "keep_last"),
        "/t.publisher.depth": ("int", 10, 10),
        "/t.publisher.reliability": ("str", "reliable", "reliable"),
    }
    assert all(
        end.implicit and end.read_only and not end.unknowns
        for end in ends(found, "parameters")
        if "qos_overrides." in end.name
    )
    assert policies(of(found)[0]) == last(10)


FIRES = (
    ("depth", DEFAULTS, param("depth", 3), last(3)),
    ("reliability", DEFAULTS, param("reliability", BEST), last(10, BEST)),
    ("all of history", DEFAULTS, param("history", "keep_all"), ("keep_all", None, "reliable", "volatile")),
    ("two", DEFAULTS, param("depth", 3) + param("reliability", BEST), last(3, BEST)),
    ("a list", f"{{{KIND}Depth, {KIND}Durability}}", param("durability", KEPT), last(10, "reliable", KEPT)),
    (
        "a list and an id",
        f'{{{{{KIND}Depth, {KIND}Durability}}, nullptr, "left"}}',
        param("durability", KEPT, "qos_overrides./t.publisher_left."),
        last(10, "reliable", KEPT),
    ),
    (
        "a list, constructed",
        f"rclcpp::QosOverridingOptions({{{KIND}Depth, {KIND}Durability}})",
        param("durability", KEPT),
        last(10, "reliable", KEPT),
    ),
    (
        "an id",
        'rclcpp::QosOverridingOptions::with_default_policies([](const rclcpp::QoS &) { return true; }, "left")',
        param("depth", 3, "qos_overrides./t.publisher_left."),
        last(3),
    ),
    ("the last", DEFAULTS, param("depth", 3) + param("depth", 4), last(4)),
    ("remapped", DEFAULTS, param("depth", 3, "qos_overrides./r.publisher.") + '<remap from="t" to="/r"/>', last(3)),
)


@pytest.mark.parametrize(("options", "given", "expected"), [row[1:] for row in FIRES], ids=[row[0] for row in FIRES])
def test_what_is_overridden(options: str, given: str, expected: tuple[object, ...]) -> None:
    (end,) = of(node(OPTIONS.format(options) + MAKE, given))
    assert policies(end) == expected
    assert end.unknowns == ()


QUIET = (
    ("no options", f'p_ = {PUB}("t", 10);', param("depth", 3)),
    ("options without overriding", f"rclcpp::PublisherOptions o; {MAKE}", param("depth", 3)),
    ("no policies", OPTIONS.format("rclcpp::QosOverridingOptions()") + MAKE, param("depth", 3)),
    ("another policy", OPTIONS.format(DEFAULTS) + MAKE, param("durability", KEPT)),
    ("another topic", OPTIONS.format(DEFAULTS) + MAKE, param("depth", 3, "qos_overrides./u.publisher.")),
    ("a relative topic", OPTIONS.format(DEFAULTS) + MAKE, param("depth", 3, "qos_overrides.t.publisher.")),
    ("the name before remapping", OPTIONS.format(DEFAULTS) + MAKE, param("depth", 3) + '<remap from="t" to="/r"/>'),
    ("the other end", OPTIONS.format(DEFAULTS) + MAKE, param("depth", 3, "qos_overrides./t.subscription.")),
    ("an id", OPTIONS.format(DEFAULTS) + MAKE, param("depth", 3, "qos_overrides./t.publisher_left.")),
    ("a file that is not seen", OPTIONS.format(DEFAULTS) + MAKE, '<param from="/etc/of_this_robot.yaml"/>'),
    ("options that are not known", f'p_ = {PUB}("t", 10, options_from_file());', ""),
)


@pytest.mark.parametrize(("body", "given"), [row[1:] for row in QUIET], ids=[row[0] for row in QUIET])
def test_what_is_not_overridden(body: str, given: str) -> None:
    (end,) = of(node(body, given))
    assert policies(end) == last(10)
    assert not [unknown for unknown in end.unknowns if unknown.field == "qos"]


UNKNOWN = (
    ("a value", OPTIONS.format(DEFAULTS) + MAKE, param("depth", "$(env DEPTH)"), last("?")),
    ("a wrong value", OPTIONS.format(DEFAULTS) + MAKE, param("reliability", "always"), last(10, "?")),
    ("options", f'p_ = {PUB}("t", 10, options_from_file());', param("depth", 3), last("?")),
)


@pytest.mark.parametrize(("body", "given", "expected"), [row[1:] for row in UNKNOWN], ids=[row[0] for row in UNKNOWN])
def test_what_is_not_known(body: str, given: str, expected: tuple[object, ...]) -> None:
    (end,) = of(node(body, given))
    assert policies(end) == expected
    assert [unknown.field for unknown in end.unknowns] == ["qos"]


def test_an_override_under_a_condition() -> None:
    launch = (
        '<launch><arg name="deep" default="$(env DEEP)"/>'
        '<set_parameter name="qos_overrides./t.publisher.depth" value="3" if="$(var deep)"/>'
        '<node pkg="p" exec="n"/></launch>'
    )
    text = ROS2_HEAD + ROS2_NODE % (OPTIONS.format(DEFAULTS) + MAKE, "")
    (end,) = of(only(follow(ros2_files(text, {"l.launch.xml": launch}), 2)).nodes[0])
    assert policies(end) == last("?")
    assert [unknown.field for unknown in end.unknowns] == ["qos"]


def test_a_subscription_with_times() -> None:
    body = (
        f"rclcpp::SubscriptionOptions o; o.qos_overriding_options = {{{KIND}Deadline, {KIND}Lifespan,"
        f"{KIND}LivelinessLeaseDuration}};"
        f's_ = {SUB}("t", rclcpp::QoS(1).deadline(100ms), [](String::SharedPtr) {{}}, o);'
    )
    head = "qos_overrides./t.subscription."
    found = node(body, param("deadline", 500_000_000, head) + param("lifespan", 1, head))
    (end,) = of(found, "subscribers")
    assert end.qos == Qos(history="keep_last", depth=1, reliability="reliable", durability="volatile", deadline=0.5)
    assert declared(found) == {
        "/t.subscription.deadline": ("int", 100_000_000, 500_000_000),
        "/t.subscription.liveliness_lease_duration": ("int", None, None),
    }


def test_a_second_end_has_what_the_first_has_declared() -> None:
    found = node(OPTIONS.format(DEFAULTS) + MAKE + f'q_ = {PUB}("t", rclcpp::SensorDataQoS(), o);')
    assert [policies(end) for end in of(found)] == [last(10), last(10)]
    assert {name: effective for name, (_, _, effective) in declared(found).items()} == {
        "/t.publisher.history": "keep_last",
        "/t.publisher.depth": 10,
        "/t.publisher.reliability": "reliable",
    }


def test_transforms_may_be_overridden() -> None:
    body = "b_ = std::make_shared<tf2_ros::TransformBroadcaster>(*this);"
    (end,) = of(node(body, param("depth", 7, "qos_overrides./tf.publisher.")))
    assert policies(end) == last(7)


def python(call: str, given: str = "") -> Node:
    """A rclpy node that makes this, with parameters from a launch file."""
    text = (
        HEAD
        + "from rclpy.qos_overriding_options import QoSOverridingOptions\nfrom rclpy.qos import QoSPolicyKind\n"
        + MAIN
        + f"    node = Node('n')\n    node.{call}\n"
    )
    more = {"p/launch/l.launch.xml": LAUNCH.format("", given)}
    return only(follow({**files(text), **more}, 2)).nodes[0]


IN_PYTHON = (
    ("defaults", "QoSOverridingOptions.with_default_policies()", param("depth", 3), last(3)),
    (
        "an id",
        "QoSOverridingOptions.with_default_policies(entity_id='left')",
        param("depth", 3, "qos_overrides./t.publisher_left."),
        last(3),
    ),
    (
        "a list",
        "QoSOverridingOptions([QoSPolicyKind.DURABILITY])",
        param("durability", KEPT),
        last(10, "reliable", KEPT),
    ),
    ("a tuple", "QoSOverridingOptions((QoSPolicyKind.DEPTH,))", param("depth", 3), last(3)),
    ("another policy", "QoSOverridingOptions((QoSPolicyKind.DEPTH,))", param("durability", KEPT), last(10)),
    ("none", "None", param("depth", 3), last(10)),
)


@pytest.mark.parametrize(
    ("options", "given", "expected"), [row[1:] for row in IN_PYTHON], ids=[row[0] for row in IN_PYTHON]
)
def test_python(options: str, given: str, expected: tuple[object, ...]) -> None:
    (end,) = of(python(f"create_publisher(String, 't', 10, qos_overriding_options={options})", given))
    assert policies(end) == expected
    assert end.unknowns == ()
