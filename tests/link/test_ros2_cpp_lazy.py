# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: events of options, names beside topics, pointers of macros, static variables, lists known in part."""

from __future__ import annotations

import pytest
from follow_kit import ROS2_HEAD, ROS2_NODE, follow, ros2_files
from follow_kit import only as only_of
from ros2_cpp_kit import PUB, component, explicit, last, only, policies

MATCHED = (
    "rclcpp::PublisherOptions options;"
    "options.event_callbacks.matched_callback = [this](rclcpp::MatchedInfo & info) {{"
    "if (info.current_count == 0) {{ one_.unsubscribe(); }} else {{ {} }} }};{}"
)
LAZY = "message_filters::Subscriber<String> one_; image_transport::Publisher image_;"


@pytest.mark.parametrize(
    "made",
    (
        f'pub_ = {PUB}("out", 1, options);',
        'image_ = image_transport::create_publisher(this, "out", rmw_qos_profile_default, options);',
    ),
)
def test_what_an_event_of_the_options_calls_is_followed(made: str) -> None:
    found = component(MATCHED.format('one_.subscribe(this, "in");', made), LAZY)
    (end,) = explicit(found, "subscribers")
    assert (end.name, end.type) == ("/in", "std_msgs/msg/String")
    assert [each.condition for each in end.conditions] == ["info.current_count == 0"]


def test_options_that_are_not_used_call_nothing() -> None:
    found = component(MATCHED.format('one_.subscribe(this, "in");', f'{PUB}("out", 1);'), LAZY)
    assert explicit(found, "subscribers") == []


@pytest.mark.parametrize(
    ("image", "info"),
    (
        ('"image"', "/camera_info"),
        ('"left/image"', "/left/camera_info"),
        ('"/stereo//left/image"', "/stereo/left/camera_info"),
        ('get_node_base_interface()->resolve_topic_or_service_name("left/image", false)', "/left/camera_info"),
    ),
)
def test_the_topic_of_a_camera_s_info(image: str, info: str) -> None:
    body = f"one_.subscribe(this, image_transport::getCameraInfoTopic({image}));"
    assert only(component(body, LAZY), "subscribers").name == info


@pytest.mark.parametrize(
    ("name", "full"), (('"in"', "/space/in"), ('"/x/in"', "/x/in"), ('"~/in"', "/space/me/in"), ('"{ns}/in"', "/?"))
)
def test_a_name_is_expanded(name: str, full: str) -> None:
    body = f'one_.subscribe(this, rclcpp::expand_topic_or_service_name({name}, "me", "/space"));'
    assert only(component(body, LAZY), "subscribers").name == full


DEFAULTS = 'static const char* const DEFAULTS[] = {"b", "a", "b"};'
FILLED = "std::set<std::string> topics; for (const char* each : DEFAULTS) { topics.insert(each); }"
EACH = "for (const std::string& each : topics) { %s(each, 1); }" % PUB


@pytest.mark.parametrize(
    ("more", "expected"),
    (
        ("", ["/a", "/b"]),
        ('std::vector<std::string> v = {"c", "a"}; topics.insert(v.begin(), v.end());', ["/a", "/b", "/c"]),
        ("topics.insert(words.begin(), words.end());", ["/?", "/a", "/b"]),
        ("while (rclcpp::ok()) { topics.insert(next()); }", ["/?", "/a", "/b"]),
        ('if (rclcpp::ok()) { topics.insert("c"); }', ["/?", "/a", "/b"]),
        ("topics.erase(next());", ["/?"]),
        ("topics = others();", ["/?"]),
        ("while (rclcpp::ok()) { topics.erase(next()); }", ["/?"]),
    ),
)
def test_a_set_of_which_some_elements_are_known(more: str, expected: list[str]) -> None:
    found = explicit(component(f"{FILLED} {more} {EACH}", before=DEFAULTS))
    assert sorted(end.name for end in found) == expected


def test_the_entries_of_a_map() -> None:
    filled = 'std::map<std::string, int> all; all["a"] = 1; all["b"] = 2;'
    found = explicit(component(f"{filled} for (const auto& each : all) {{ {PUB}(each.first, each.second); }}"))
    assert [(end.name, policies(end)) for end in found] == [("/a", last(1)), ("/b", last(2))]


def test_pointers_that_a_macro_declares() -> None:
    before = """
FORWARD(Part);
class Part { public: explicit Part(rclcpp::Node & node) : node_(node) {}
  void start() { pub_ = node_.create_publisher<String>("part", 1); }
  rclcpp::Node & node_; rclcpp::Publisher<String>::SharedPtr pub_; };
"""
    assert only(component("part_.reset(new Part(*this)); part_->start();", "PartPtr part_;", before)).name == "/part"


def test_what_a_static_variable_makes_is_made_once_in_each_process() -> None:
    body = 'std::string topic = declare_parameter("topic", "x"); log(*this, topic); log(*this, "again");'
    before = "void log(rclcpp::Node & node, std::string topic) { static auto p = node.%s(topic, 1); }" % PUB
    text = ROS2_HEAD + before + ROS2_NODE % (body, "")
    node = '<node pkg="p" exec="n" name="{0}"><param name="topic" value="of_{0}"/></node>'
    launch = f"<launch>{node.format('a')}{node.format('b')}</launch>"
    found = only_of(follow(ros2_files(text, {"l.launch.xml": launch}), 2))
    made = {each.name: [end.name for end in explicit(each)] for each in found.nodes}
    assert made == {"/a": ["/of_a"], "/b": ["/of_b"]}
