# SPDX-License-Identifier: Apache-2.0
"""Handles of endpoints tell their names: as they are resolved and remapped (ros/publisher.h, rclcpp/service.hpp, rclpy/service.py)."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends
from ros2_cpp_kit import component, explicit

IN_A_GROUP = '<launch><group ns="g"><node pkg="p" type="n" name="n"><remap from="t" to="u"/></node></group></launch>'
OTHER = '\nnh.advertise<std_msgs::String>(h.%s() + "/z", 1);'
SERVICE = "std_srvs::srv::SetBool"


@pytest.mark.parametrize(
    ("made", "getter", "expected"),
    [
        ('ros::Publisher h = nh.advertise<std_msgs::String>("t", 1);', "getTopic", "/g/u/z"),
        ('ros::Subscriber h = nh.subscribe("t", 1, callback);', "getTopic", "/g/u/z"),
        ('ros::Subscriber h = nh.subscribe("/v", 1, callback);', "getTopic", "/v/z"),
        ('ros::NodeHandle pnh("~");\nros::Subscriber h = pnh.subscribe("v", 1, callback);', "getTopic", "/g/n/v/z"),
        ('ros::ServiceServer h = nh.advertiseService("t", callback);', "getService", "/g/u/z"),
        ('ros::ServiceClient h = nh.serviceClient<std_srvs::SetBool>("t");', "getService", "/g/u/z"),
        # what is not known, wholly or in part
        ('ros::Publisher h = nh.advertise<std_msgs::String>("/a/" + x(), 1);', "getTopic", "/a/?/z"),
        ("ros::Publisher h = nh.advertise<std_msgs::String>(x(), 1);", "getTopic", "/g/?/z"),
        ('ros::Publisher h;\nif (x()) h = nh.advertise<std_msgs::String>("t", 1);', "getTopic", "/?/z"),
        ("ros::Publisher h = make();", "getTopic", "/?/z"),
    ],
)
def test_roscpp(made: str, getter: str, expected: str) -> None:
    names = [end.name for end in ends(cpp(made + OTHER % getter, launch=IN_A_GROUP), "publishers")]
    assert expected in names


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (f'auto h = create_client<{SERVICE}>("t");', ["/t/z"]),
        (f'auto h = create_service<{SERVICE}>("t", callback);', ["/t/z"]),
        ("auto h = make();", ["/?/z"]),
        (f"rclcpp::Client<{SERVICE}>::SharedPtr h;", ["/?/z"]),
    ],
)
def test_rclcpp(made: str, expected: list[str]) -> None:
    body = f'{made}\ncreate_publisher<String>(std::string(h->get_service_name()) + "/z", 1);'
    assert [end.name for end in explicit(component(body))] == expected


def test_a_handle_that_is_not_known_is_the_reason() -> None:
    node = cpp("ros::Publisher h = make();" + OTHER % "getTopic")
    (end,) = ends(node, "publishers")
    assert [unknown.reason for unknown in end.unknowns] == ["what ros::Publisher::getTopic returns is not known"]
