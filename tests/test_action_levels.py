# SPDX-License-Identifier: Apache-2.0
"""Goals of actions without an outcome: a note where another function ends them, or a comment leaves them to be aborted."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example, filled
from haros_ci.registry import checks
from haros_ci.results.rule import Level

DOCKING = """import rclpy
from demo.action import Dock
from rclpy.action import ActionServer
from rclpy.node import Node


class Docking(Node):
    def __init__(self):
        super().__init__("docking")
        self.handle = None
        self.server = ActionServer(self, Dock, "dock", self.execute, handle_accepted_callback=self.accepted)
        self.timer = self.create_timer(1.0, self.tick)

    def accepted(self, goal_handle):
        {accepted}
        self.handle = goal_handle
        goal_handle.execute()

    def tick(self):
        {tick}

    def execute(self, goal_handle):
        if not goal_handle.request.name:
            return Dock.Result()
        goal_handle.succeed()
        return Dock.Result()


rclpy.init()
rclpy.spin(Docking())
"""


@pytest.mark.parametrize(
    ("accepted", "tick", "expected"),
    [
        ("pass", "pass", Level.WARNING),
        ("self.handle and self.handle.abort()", "pass", Level.WARNING),
        ("pass", "self.server.abort()", Level.WARNING),
        ("pass", "self.handle.abort()", Level.NOTE),
    ],
)
def test_goals_that_another_function_ends(accepted: str, tick: str, expected: Level, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "action-without-result")
    example = Example("", True, filled({"dock.py": DOCKING.format(accepted=accepted, tick=tick)}))
    (result,) = said(check, example, tmp_path)
    assert result.level is expected


@pytest.mark.parametrize(
    ("comment", "expected"),
    [
        ("It docks and aborts.", Level.WARNING),
        ("Otherwise it waits.", Level.WARNING),
        ("It succeeds if there is a name, otherwise it will abort.", Level.NOTE),
        ("Without a name the goal is aborted by itself.", Level.NOTE),
    ],
)
def test_goals_that_a_comment_leaves_to_be_aborted(comment: str, expected: Level, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "action-without-result")
    code = DOCKING.format(accepted="pass", tick="pass")
    code = code.replace("execute(self, goal_handle):\n", f'execute(self, goal_handle):\n        """{comment}"""\n')
    (result,) = said(check, Example("", True, filled({"dock.py": code})), tmp_path)
    assert result.level is expected
