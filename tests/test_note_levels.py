# SPDX-License-Identifier: Apache-2.0
"""Findings that are a note: paths of credentials, and sleeps that hold nothing up."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CMAKE, ROS2, levels

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("/home/anna/certificates/robot.pem", Level.NOTE),
        ("/home/anna/robot.KEY", Level.NOTE),
        ("/data/tls/server.crt", Level.NOTE),
        ("/data/tls/client.p12", Level.NOTE),
        ("/home/anna/.ssh/id_rsa", Level.NOTE),
        ("/home/anna/keys/id_ed25519.pub", Level.NOTE),
        ("/home/anna/api_token.txt", Level.NOTE),
        ("/home/anna/credentials.json", Level.NOTE),
        ("/home/anna/maps/keyframes.yaml", Level.WARNING),
        ("/home/anna/tokenizer/words.json", Level.WARNING),
        ("/home/anna/maps/monkey.dae", Level.WARNING),
        ("/data/secretariat/hall.yaml", Level.WARNING),
    ],
)
def test_paths_of_credentials(path: str, expected: Level, tmp_path: Path) -> None:
    launch = f'<launch><arg name="x" default="{path}"/><node pkg="demo" exec="n" args="$(var x)"/></launch>\n'
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
        "launch/a.launch.xml": launch,
    }
    check = next(check for check in checks() if check.id == "machine-specific-path")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected
    assert ("find-pkg-share" in result.message) == (expected is Level.WARNING)


NODE = """#!/usr/bin/env python3
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        {0}

    def on_call(self, request, response):
        self.move()
        return response

    def on_message(self, message):
        {1}

    def move(self):
        {2}


rclpy.init()
rclpy.spin(Arm())
"""
SERVICE = 'self.create_service(Trigger, "home", self.on_call)'
SUBSCRIPTION = 'self.create_subscription(Empty, "stop", self.on_message, 1)'
LONG = "time.sleep(2.0)"


@pytest.mark.parametrize(
    ("made", "on_message", "move", "expected"),
    [
        (SERVICE, "pass", LONG, Level.NOTE),  # requests wait, and none is lost
        (f"{SERVICE}; {SUBSCRIPTION}", "pass", LONG, Level.WARNING),
        (f"{SERVICE}; self.create_timer(0.1, self.tick)", "pass", LONG, Level.WARNING),
        (SUBSCRIPTION, LONG, "pass", Level.WARNING),
        (SUBSCRIPTION, f"if not self.port.is_open:\n            {LONG}\n            return", "pass", Level.NOTE),
        (SUBSCRIPTION, f"if self.has_failed:\n            {LONG}\n            self.reconnect()", "pass", Level.NOTE),
        (
            SUBSCRIPTION,
            f"try:\n            self.send()\n        except OSError:\n            {LONG}\n            self.connect()",
            "pass",
            Level.NOTE,
        ),
        (SUBSCRIPTION, f"if not self.port.is_open:\n            {LONG}\n        self.send()", "pass", Level.WARNING),
        (SUBSCRIPTION, f"if self.is_open:\n            {LONG}\n            return", "pass", Level.WARNING),
    ],
)
def test_sleeps_that_hold_nothing_up(made: str, on_message: str, move: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": NODE.format(made, on_message, move),
    }
    assert levels("sleep-in-callback", files, tmp_path) == [expected]


def test_a_sleep_is_named_with_its_function_and_time(tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": NODE.format(SERVICE, "pass", LONG),
    }
    check = next(check for check in checks() if check.id == "sleep-in-callback")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert "sleeps for 2 s in Arm.move, which Arm.on_call, the callback of a service, runs" in result.message
