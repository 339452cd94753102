# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions and frames: one finding for one mistake, the mesh of another format, nodes without a name, frames that MoveIt strips."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend><depend>rclpy</depend><depend>tf2_ros</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)


def messages(check_id: str, files: dict[str, str], folder: Path) -> list[tuple[str, str]]:
    check = next(check for check in checks() if check.id == check_id)
    found = said(check, Example("", True, {"package.xml": MANIFEST, **files}), folder)
    return [(result.level.value, result.message) for result in found]


def arm(mesh: str) -> str:
    return f'<robot name="arm"><link name="a"><visual><geometry><mesh filename="package://demo/meshes/{mesh}"/></geometry></visual></link></robot>\n'


@pytest.mark.parametrize(
    ("mesh", "hint"),
    [
        ("base.stl", "; the directory has base.dae and base.obj: write that ending, or add the file"),
        ("base_left.stl", "; add the file, or correct its path"),
    ],
)
def test_a_mesh_of_another_format(mesh: str, hint: str, tmp_path: Path) -> None:
    there = {f"meshes/{name}": "solid\n" for name in ("base.obj", "base.dae")}
    ((_, message),) = messages("mesh-not-loaded", {"urdf/arm.urdf": arm(mesh), **there}, tmp_path)
    assert message.endswith(hint), message


SCENE = """#!/usr/bin/env python3
import rclpy
from moveit_msgs.msg import CollisionObject
from geometry_msgs.msg import PoseStamped


def main():
    rclpy.init()
    node = rclpy.create_node("scene")
    thing = {}()
    thing.header.frame_id = "/world"
    node.create_publisher({}, "thing", 10).publish(thing)
    rclpy.spin(node)


main()
"""


@pytest.mark.parametrize(("kind", "count"), [("PoseStamped", 1), ("CollisionObject", 0)])
def test_frames_that_moveit_strips(kind: str, count: int, tmp_path: Path) -> None:
    files = {
        "scripts/scene.py": SCENE.format(kind, kind),
        "launch/a.launch.xml": '<launch><node pkg="demo" exec="scene.py"/></launch>\n',
    }
    assert len(messages("frame-leading-slash", files, tmp_path)) == count


def test_broadcasters_without_a_name(tmp_path: Path) -> None:
    sender = '<node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 0 0 0 0 {} base"/>'
    files = {"launch/a.launch.xml": f"<launch>{sender.format('map')}{sender.format('odom')}</launch>\n"}
    ((_, message),) = messages("conflicting-transforms", files, tmp_path)
    assert "by a static_transform_publisher without a name of its own, in 'odom' by" in message and "/?" not in message


BARE = """<robot name="arm"><link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="0" upper="1"/></joint>
</robot>
"""
CHAIN = "from ikpy.chain import Chain\n\nARM = Chain.from_urdf_file('urdf/arm.urdf')\n"


@pytest.mark.parametrize(
    ("files", "level"),
    [
        ({}, "error"),
        ({"scripts/kinematics.py": CHAIN}, "note"),
        ({"scripts/kinematics.py": CHAIN, "launch/a.launch.py": "ARM = 'urdf/arm.urdf'\n"}, "error"),
        ({"scripts/kinematics.py": CHAIN, "scripts/show.py": "ARM = open('urdf/arm.urdf').read()\n"}, "error"),
        ({"scripts/kinematics.py": CHAIN.replace("arm.urdf", "leg.urdf")}, "error"),
        ({"scripts/kinematics.py": CHAIN.replace("from ikpy", "# from ikpy")}, "error"),
    ],
)
def test_limits_that_only_another_reader_sees(files: dict[str, str], level: str, tmp_path: Path) -> None:
    ((found, message),) = messages("broken-robot-model", {"urdf/arm.urdf": BARE, **files}, tmp_path)
    assert (found, "here ikpy alone reads the file" in message) == (level, level == "note")
