# SPDX-License-Identifier: Apache-2.0
"""Which launch files a workspace is started by, and how ROS 1 ones are told from ROS 2 ones."""

from __future__ import annotations

import pytest
from roslaunch_kit import loader, workspace

from haros_ci.extract.launch.xml import read_launch
from haros_ci.launch.ros1.dialect import is_ros1
from haros_ci.launch.ros1.entry import entry_files


def entries(files: dict[str, str], packages: dict[str, str] | None = None, ros: int | None = None) -> tuple[str, ...]:
    return entry_files(workspace(files, packages, ros), loader(files))


@pytest.mark.parametrize(
    "include",
    [
        '<include file="$(find b)/launch/in.launch"/>',
        '<include file="$(find b)/launch/../launch//in.launch" if="false"/>',
        '<group if="0"><group><include file="$(find b)/launch/in.launch" unless="$(env X)"/></group></group>',
        '<arg name="f" default="in"/><include file="$(find b)/launch/$(arg f).launch"/>',
        '<arg name="p" default="$(find b)/launch"/><group><arg name="f" value="$(arg p)/in.launch"/>'
        '<include file="$(arg f)"/></group>',
        '<include file="$(optenv NONE $(find b)/launch/in.launch)"/><include file="$(find b)/launch/in.launch"/>',
        "<include file=\"$(eval find('b') + '/launch/in.launch')\"/>",
        '<include file="$(dirname)/../../b/launch/in.launch"/>',
    ],
)
def test_included_files_are_no_entries(include: str) -> None:
    files = {"a/launch/top.launch": f"<launch>{include}</launch>", "b/launch/in.launch": "<launch/>"}
    assert entries(files) == ("a/launch/top.launch",)


@pytest.mark.parametrize(
    "include",
    [
        "",
        '<include file="$(find elsewhere)/launch/in.launch"/>',
        '<include file="$(env X)/launch/in.launch"/>',
        '<arg name="f"/><include file="$(arg f)"/>',
        '<arg name="f" default="$(find b)/launch/in.launch" if="$(env X)"/><include file="$(arg f)"/>',
        '<include file="in.launch"/>',
        "<include/>",
        '<!-- <include file="$(find b)/launch/in.launch"/> -->',
        '<node pkg="p" type="t" name="n" args="$(find b)/launch/in.launch"/>',
    ],
)
def test_includes_that_are_not_known_do_not_count(include: str) -> None:
    files = {"a/launch/top.launch": f"<launch>{include}</launch>", "b/launch/in.launch": "<launch/>"}
    assert entries(files) == ("a/launch/top.launch", "b/launch/in.launch")


def test_only_launch_files_of_ros_1_in_packages_sorted() -> None:
    files = {
        "b/z.launch": "<launch/>",
        "a/y.launch.xml": "<launch/>",
        "a/broken.launch": "<launch>",
        "a/robot.launch": "<robot/>",
        "a/ros2.launch.xml": '<launch><node pkg="p" exec="e"/></launch>',
        "a/x.launch.yaml": "launch: []",
        "a/x.launch.py": "",
        "a/plain.yaml": "a: 1",
        "tools/x.launch": "<launch/>",
    }
    assert entries(files, {"a": "a", "b": "b"}) == ("a/y.launch.xml", "b/z.launch")
    assert entries(files, {"a": "a", "b": "b"}, ros=2) == ()


def test_a_file_that_includes_itself_is_an_entry() -> None:
    assert entries({"a/x.launch": '<launch><include file="$(find a)/x.launch" if="0"/></launch>'}) == ("a/x.launch",)


@pytest.mark.parametrize(
    "body",
    [
        '<node pkg="p" type="t" name="n"/>',
        "<rosparam>a: 1</rosparam>",
        '<group ns="a"/>',
        '<include file="$(find p)/x.launch"/>',
        '<param name="p" command="c"/>',
        '<arg name="a"/><param name="p" value="$(arg a)"/>',
        '<node pkg="p" type="$(arg t)" name="n" exec="typo"/>',
    ],
)
def test_signs_of_ros_1(body: str) -> None:
    assert is_ros1(read_launch(f"<launch>{body}</launch>"), 2)


@pytest.mark.parametrize(
    "body",
    [
        '<node pkg="p" exec="e"/>',
        '<let name="a" value="b"/>',
        '<include file="$(find-pkg-share p)/x.launch.xml"/>',
        '<arg name="a"/><group if="$(var a)"/>',
        '<node_container pkg="p" exec="e" name="n" namespace=""/>',
        '<push-ros-namespace namespace="a"/>',
        '<group scoped="false"/>',
    ],
)
def test_signs_of_ros_2(body: str) -> None:
    assert not is_ros1(read_launch(f"<launch>{body}</launch>"), 1)


@pytest.mark.parametrize("body", ["", '<arg name="a" default="b"/>', '<include file="$(dirname)/x.launch"/>'])
def test_without_a_sign_the_package_decides(body: str) -> None:
    made = read_launch(f"<launch>{body}</launch>")
    assert [is_ros1(made, ros) for ros in (None, 1, 2)] == [True, True, False]


def test_what_is_no_launch_file_is_none_of_ros_1() -> None:
    assert not is_ros1(read_launch("<robot/>"), 1)
    assert not is_ros1(read_launch(""), 1)
