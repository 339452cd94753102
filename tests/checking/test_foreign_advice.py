# SPDX-License-Identifier: Apache-2.0
"""foreign-dependency says what to do: write the counterpart, or remove what has none, is declared already or is not needed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.architectures import project_of
from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.checking.run import run_on_project
from haros_ci.checking.system import systems
from haros_ci.config.settings import Settings
from haros_ci.registry import checks
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>{tool}</buildtool_depend>'
    "{depends}<export><build_type>{kind}</build_type></export></package>\n"
)


@pytest.mark.parametrize(
    ("depends", "files", "kind", "expected"),
    [
        ("roscpp", {}, "ament_cmake", "write rclcpp for roscpp"),
        ("roscpp rclcpp", {}, "ament_cmake", "remove roscpp"),
        ("roscpp rospy rclpy", {}, "ament_cmake", "remove rospy, and write rclcpp for roscpp"),
        ("dynamic_reconfigure rclcpp", {}, "ament_cmake", "remove dynamic_reconfigure"),
        ("message_generation message_runtime", {}, "ament_python", "remove message_generation and message_runtime"),
        (
            "message_generation",
            {"msg/A.msg": "int8 a\n"},
            "ament_cmake",
            "write rosidl_default_generators for message_generation",
        ),
        (
            "message_generation rosidl_default_generators",
            {"msg/A.msg": "int8 a\n"},
            "ament_cmake",
            "remove message_generation",
        ),
        ("actionlib rclpy", {}, "ament_python", "remove actionlib"),
        ("actionlib", {}, "ament_python", "write rclpy for actionlib"),
        ("actionlib", {}, "ament_cmake", "write rclcpp_action for actionlib"),
        ("rospy rclcpp", {"src/a.cpp": ""}, "ament_cmake", "remove rospy"),
        ("rospy rclcpp", {"src/a.cpp": "", "launch/a.launch.py": ""}, "ament_cmake", "remove rospy"),
        ("roscpp rclpy", {"demo/a.py": ""}, "ament_python", "remove roscpp"),
        ("rospy", {"src/a.cpp": "", "scripts/a.py": ""}, "ament_cmake", "write rclpy for rospy"),
        ("rospy", {"demo/a.py": ""}, "ament_python", "write rclpy for rospy"),
        ("rospy", {"launch/a.launch.py": ""}, "ament_cmake", "write rclpy for rospy"),
        ("roscpp", {"src/a.cpp": "", "setup.py": ""}, "ament_cmake", "write rclcpp for roscpp"),
        ("gmapping rclcpp", {}, "ament_cmake", "nothing in the package names it: remove it, or add the sources to the workspace"),
    ],
)  # fmt: skip
def test_advice(depends: str, files: dict[str, str], kind: str, expected: str, tmp_path: Path) -> None:
    tool = "ament_cmake" if kind == "ament_cmake" else "python3-setuptools"
    manifest = MANIFEST.format(
        tool=tool, kind=kind, depends="".join(f"<depend>{name}</depend>" for name in depends.split())
    )
    check = next(check for check in checks() if check.id == "foreign-dependency")
    (result,) = said(check, Example("", True, {"package.xml": manifest, **files}), tmp_path)
    assert result.message.rstrip(".").endswith(f"rosdep stops here; {expected}")


@pytest.mark.parametrize(
    ("link", "depends", "expected"),
    [
        ("src/gmapping", "gmapping", 0),  # a git link, whatever .gitmodules says
        ("src/other", "gmapping", 1),
        ("src/gmapping2", "gmapping", 1),
        ("src/roscpp", "roscpp", 1),  # the other ROS itself
    ],
)
def test_what_a_commit_of_another_repository_may_bring(link: str, depends: str, expected: int, tmp_path: Path) -> None:
    text = MANIFEST.format(tool="ament_cmake", kind="ament_cmake", depends=f"<depend>{depends}</depend>")
    files = {"src/demo/package.xml": text, "src/demo/CMakeLists.txt": ""}
    for path, content in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(content)
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["update-index", "--add", "--cacheinfo", f"160000,{'1' * 40},{link}"],
    ):
        subprocess.run(["git", *command], cwd=tmp_path, check=True)
    workspace = discover(tmp_path, (".",))
    made = varied(workspace, Settings(root=tmp_path), MemoryCache(), alternatives=False)
    project = project_of(made, workspace, tuple(systems(made.architecture, workspace)))
    check = next(check for check in checks() if check.id == "foreign-dependency")
    assert len(run_on_project((check,), project, "haros-ci").results) == expected
    assert workspace.unfetched == {link}
