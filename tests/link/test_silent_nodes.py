# SPDX-License-Identifier: Apache-2.0
"""ROS 1: a node of which nothing is seen says so."""

from __future__ import annotations

import pytest
from follow_kit import cpp, python

UNSEEN = ["nothing that it makes is seen"]
LAUNCH = '<launch><node pkg="p" type="{}" name="q"/></launch>'


@pytest.mark.parametrize("body", ["", "pkg::Driver<int> d(nh); d.run();", "pkg::run(&nh);"])
@pytest.mark.parametrize("launch", ["", LAUNCH.format("n")])
def test_cpp(body: str, launch: str) -> None:
    assert [unknown.reason for unknown in cpp(body, launch=launch).unknowns] == UNSEEN


@pytest.mark.parametrize("launch", ["", LAUNCH.format("n.py")])
def test_python(launch: str) -> None:
    assert [unknown.reason for unknown in python("from pkg import D\nD().run()\n", launch).unknowns] == UNSEEN


@pytest.mark.parametrize(
    "body",
    [
        'ros::Publisher a = nh.advertise<std_msgs::String>("a", 1);',
        'pkg::Driver d; ros::Publisher a = nh.advertise<std_msgs::String>("a", 1);',
        'int x; nh.getParam("x", x);',
        'ros::Subscriber s = nh.subscribe("a", 1, cb);',
    ],
)
@pytest.mark.parametrize("launch", ["", LAUNCH.format("n")])
def test_stays_quiet_where_something_is_seen(body: str, launch: str) -> None:
    assert cpp(body, "void cb(const std_msgs::String&) {}", launch).unknowns == ()
