# SPDX-License-Identifier: Apache-2.0
"""The form for ROS 2 was never run on it. That it is bytecode for every Python that reads it, and calls what rclpy has, is held here."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from test_files.suites import suite

from haros_ci.extract.apis import ros2_node, ros2_rclpy
from haros_ci.test_files.written import written

PROPERTIES = ("globally: /level {data = 1} causes /stop within 1 s", "after /bumper {left}: no /out {data > 3}")
FILES = written([suite(*PROPERTIES, ros=2)]).files


@pytest.mark.parametrize("name", sorted(FILES))
def test_each_file_becomes_bytecode(name: str) -> None:
    compile(FILES[name], name, "exec")


def test_a_node_is_asked_for_what_the_tables_have() -> None:
    rows = {str(row.get("call", "")).rpartition(".")[2] for table in (ros2_rclpy.ROWS, ros2_node.ROWS) for row in table}
    found = [node for node in ast.walk(ast.parse(FILES["property_tests/ros2.py"])) if isinstance(node, ast.Call)]
    called = {node.func.attr for node in found if isinstance(node.func, ast.Attribute)}
    made = {name for name in called if name.startswith("create_")}
    assert made and made <= rows


def test_nothing_of_ros_1_is_loaded() -> None:
    loaded = {
        name.name.split(".")[0]
        for text in FILES.values()
        for node in ast.walk(ast.parse(text))
        if isinstance(node, (ast.Import, ast.ImportFrom))
        for name in (node.names if isinstance(node, ast.Import) else [ast.alias(node.module or "")])
    }
    assert not loaded & {"rospy", "roslaunch", "rospkg"}


def test_the_page_says_that_it_was_never_run() -> None:
    page = (Path(__file__).resolve().parents[2] / "docs/testgen.md").read_text(encoding="utf-8")
    assert "This form has never been run" in page
