# SPDX-License-Identifier: Apache-2.0
"""Which files are robots by themselves, and what commands of launch files give to xacro."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.robot.commands import xacro_command
from haros_ci.robot.descriptions import Descriptions
from haros_ci.robot.unknown import UNKNOWN
from haros_ci.workspace.build import builds
from haros_ci.workspace.discover import discover

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
MANIFEST = "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>a</maintainer><license>x</license><buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>"


@pytest.mark.parametrize(
    ("command", "file", "arguments"),
    [
        ("xacro $(find-pkg-share demo)/urdf/a.xacro", "$(find-pkg-share demo)/urdf/a.xacro", {}),
        ("$(find xacro)/xacro --inorder '$(find demo)/a.urdf' x:=1", "$(find demo)/a.urdf", {"x": "1"}),
        ("xacro a.xacro x:=? y:=''", "a.xacro", {"x": UNKNOWN, "y": ""}),
        ("? $(find-pkg-share demo)/a.urdf.xacro", "$(find-pkg-share demo)/a.urdf.xacro", {}),
        ("ros2 run xacro xacro a.xacro", "a.xacro", {}),
        ("/opt/bin/xacro a.xacro p:=$(find demo)/b", "a.xacro", {"p": "/find:/demo/b"}),
        ("python3 $(find xacro)/xacro.py a.xacro", "a.xacro", {}),
    ],
)
def test_commands_of_xacro(command: str, file: str, arguments: object) -> None:
    made = xacro_command(command)
    assert made is not None and made.file == file and made.arguments == arguments


@pytest.mark.parametrize(
    "command",
    [
        "",
        "cat a.xacro",
        "xacro ?.xacro",
        "xacro",
        "xacro a.xacro | sed s/a/b/",
        "xacro 'a",
        "? a.urdf",
        "xacro a.xacro ?:=1",
        "xacro a b",
    ],
)
def test_other_commands(command: str) -> None:
    assert xacro_command(command) is None


def robots(root: Path, **files: str) -> dict[str, tuple[str | None, ...]]:
    (root / "package.xml").write_text(MANIFEST)
    (root / "CMakeLists.txt").write_text("project(demo)\n")
    for name, text in files.items():
        (root / name.replace("__", ".")).write_text(text)
    workspace = discover(root, (".",))
    found = Descriptions(workspace, builds(workspace)).of_files()
    return {each.robot.path: tuple(link.name for link in each.robot.links) for each in found}


def test_a_file_that_nobody_includes_is_a_robot(tmp_path: Path) -> None:
    found = robots(
        tmp_path,
        a__xacro=f"{HEAD}<xacro:include filename='$(find demo)/b.xacro'/><link name='a'/></robot>",
        b__xacro=f"{HEAD}<link name='b'/></robot>",
        c__xacro="<robot xmlns:xacro='http://www.ros.org/wiki/xacro'><link name='c'/></robot>",
        d__xacro=f"{HEAD}<xacro:macro name='m'><link name='d'/></xacro:macro></robot>",
        e__xml="<launch><robot name='x'/></launch>",
        f__srdf=f"{HEAD}<link name='f'/></robot>",
    )
    assert found == {"a.xacro": ("b", "a")}


def test_what_a_pattern_or_an_expression_may_include_is_none(tmp_path: Path) -> None:
    found = robots(
        tmp_path,
        a__xacro=f"{HEAD}<xacro:include filename='${{x}}_arm.xacro'/><link name='a'/></robot>",
        left_arm__xacro=f"{HEAD}<link name='b'/></robot>",
    )
    assert list(found) == ["a.xacro"]


def test_arguments_that_launch_files_pass_are_not_known(tmp_path: Path) -> None:
    found = robots(
        tmp_path,
        a__xacro=f"{HEAD}<xacro:arg name='p' default='x'/><xacro:arg name='q' default='y'/><link name='$(arg p)'/><link name='$(arg q)'/></robot>",
        a__launch__py="Command(['xacro ', 'a.xacro', ' p:=', x])",
    )
    assert found == {"a.xacro": (None, "y")}


def test_of_a_file_that_nobody_names_no_argument_is_known(tmp_path: Path) -> None:
    found = robots(
        tmp_path,
        a__xacro=f"{HEAD}<xacro:arg name='p' default='x'/><link name='$(arg p)'/><link name='$(arg q)'/></robot>",
    )
    assert found == {"a.xacro": (None, None)}


UNREAD = {
    "cut": HEAD + '<link name="a"/>',
    "entities": f'<!DOCTYPE r [<!ENTITY a "b">]>{HEAD}<link name="&a;"/></robot>',
    "deep": HEAD + "<a>" * 2_000 + "</a>" * 2_000 + "</robot>",
    "no tag": "<robot",
}
READ = {
    "plain": HEAD + '<link name="a"/></robot>',
    "no robot": "<a>",
    "empty": "",
    "another root": "<a><robot/></a>",
    "expression": HEAD + '<link name="${9**9**9**9}"/></robot>',
    "comment": "<!-- <robot --><a/>",
}


@pytest.mark.parametrize(
    ("text", "is_unread"), [*((text, True) for text in UNREAD.values()), *((text, False) for text in READ.values())]
)
def test_files_that_cannot_be_read_are_named(tmp_path: Path, text: str, is_unread: bool) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "CMakeLists.txt").write_text("project(demo)\n")
    (tmp_path / "a.urdf").write_text(text)
    workspace = discover(tmp_path, (".",))
    descriptions = Descriptions(workspace, builds(workspace))
    list(descriptions.of_files())
    found = [
        (problem.path, "not read as a description of a robot" in problem.message) for problem in descriptions.problems
    ]
    assert found == ([("a.urdf", True)] if is_unread else [])
