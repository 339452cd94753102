# SPDX-License-Identifier: Apache-2.0
"""Controllers of ros2_control: which nodes a spawner brings, of which class, with which interface; what is not known."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, Nothing, explicit, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.graph.words import shell_words
from haros_ci.model.architecture import Node

MANAGER = '<node pkg="controller_manager" exec="ros2_control_node"{}>{}</node>'
SPAWNER = '<node pkg="controller_manager" exec="spawner" args="{}"{}/>'
FILE = '<param from="$(find-pkg-share p)/config/c.yaml"/>'
OWN_FILE = "--param-file $(find-pkg-share p)/config/c.yaml"
#: The classes as the manager's parameters and as sections of the controllers have them.
BY_MANAGER = (
    "/**/controller_manager:\n  ros__parameters:\n    jsb:\n      type: joint_state_broadcaster/JointStateBroadcaster\n"
    "    base.type: diff_drive_controller/DiffDriveController\nbase:\n  ros__parameters:\n    enable_odom_tf: false\n"
)
BY_SECTION = (
    "/**:\n  jsb:\n    ros__parameters:\n      type: joint_state_broadcaster/JointStateBroadcaster\n"
    "  base:\n    ros__parameters: {type: diff_drive_controller/DiffDriveController, enable_odom_tf: false}\n"
)
KINDS = ("publishers", "subscribers")


def started(body: str, config: str = BY_MANAGER) -> list[Node]:
    """What a launch file with this in it starts, but for the manager."""
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p") + "ament_auto_package(INSTALL_TO_SHARE launch config)\n",
        "p/launch/l.launch.xml": f"<launch>{body}</launch>",
        "p/config/c.yaml": config,
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return [node for node in only(found).nodes if node.type != "ros2_control_node"]


PYTHON = (
    "from controller_manager.launch_utils import (generate_controllers_spawner_launch_description as every,\n"
    "  generate_controllers_spawner_launch_description_from_dict as by_name, generate_load_controller_launch_description as one)\n"
    "from ament_index_python.packages import get_package_share_directory\nfrom launch import LaunchDescription\n"
    "FILE = get_package_share_directory('p') + '/config/c.yaml'\n"
    "def generate_launch_description():\n    return LaunchDescription([{}])\n"
)


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("every(['jsb', 'base'], controller_params_files=[FILE])", ["/base", "/jsb"]),
        ("every(['jsb'], [FILE], ['--inactive'])", ["/jsb"]),
        ("by_name({'jsb': FILE, 'base': [FILE]})", ["/base", "/jsb"]),
        ("one('jsb', FILE)", ["/jsb"]),
        ("one('jsb', controller_type='joint_state_broadcaster/JointStateBroadcaster')", ["/jsb"]),
    ],
)
def test_functions_that_launch_spawners(call: str, expected: list[str]) -> None:
    texts = {
        "p/CMakeLists.txt": ROS2_CMAKE.format("p") + "ament_auto_package(INSTALL_TO_SHARE launch config)\n",
        "p/launch/l.launch.py": PYTHON.format(call),
        "p/config/c.yaml": BY_SECTION,
    }
    found = architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    assert sorted(node.name for node in only(found).nodes if node.kind == "lifecycle") == expected
    assert found.problems == ()


def told(nodes: list[Node]) -> dict[str, str]:
    """The types by name, spawners left out."""
    return {node.name: node.type for node in nodes if node.type != "spawner"}


def topics(node: Node) -> list[str]:
    return sorted(end.name for kind in KINDS for end in explicit(node, kind) if "?" not in end.name)


JSB, BASE = "joint_state_broadcaster/JointStateBroadcaster", "diff_drive_controller/DiffDriveController"


@pytest.mark.parametrize(
    ("manager", "spawner", "config", "expected"),
    [
        (MANAGER.format("", FILE), SPAWNER.format("jsb base", ""), BY_MANAGER, {"/jsb": JSB, "/base": BASE}),
        (MANAGER.format("", ""), SPAWNER.format(f"jsb {OWN_FILE}", ""), BY_SECTION, {"/jsb": JSB}),
        (MANAGER.format("", ""), SPAWNER.format(f"jsb -p {OWN_FILE[13:]} --inactive", ""), BY_SECTION, {"/jsb": JSB}),
        (MANAGER.format("", ""), SPAWNER.format(f"-t {BASE} base", ""), "", {"/base": BASE}),
        ("", SPAWNER.format(f"{OWN_FILE} jsb base", ""), BY_SECTION, {"/jsb": JSB, "/base": BASE}),
        (
            MANAGER.format(' namespace="a"', FILE),
            SPAWNER.format("jsb -c /a/controller_manager", ""),
            BY_MANAGER,
            {"/a/jsb": JSB},
        ),
        (
            MANAGER.format(' namespace="a"', FILE),
            SPAWNER.format("jsb --controller-manager=controller_manager", ' namespace="a"'),
            BY_MANAGER,
            {"/a/jsb": JSB},
        ),
        (
            MANAGER.format(' name="m"', FILE),
            SPAWNER.format("jsb -c m", ""),
            BY_MANAGER.replace("controller_manager", "m"),
            {"/jsb": JSB},
        ),
        (
            MANAGER.format("", FILE),
            SPAWNER.format("--controller jsb --load-only --controller base", ""),
            BY_MANAGER,
            {"/jsb": JSB, "/base": BASE},
        ),
        (
            MANAGER.format("", FILE),
            SPAWNER.format("jsb --controller-manager-timeout 30 --switch-timeout 5 --unload-on-kill", ""),
            BY_MANAGER,
            {"/jsb": JSB},
        ),
        (MANAGER.format("", FILE), SPAWNER.format("jsb", "") * 2, BY_MANAGER, {"/jsb": JSB}),
    ],
)
def test_what_a_spawner_brings(manager: str, spawner: str, config: str, expected: dict[str, str]) -> None:
    nodes = started(manager + spawner, config)
    assert told(nodes) == expected
    assert all(node.kind == "lifecycle" for node in nodes if node.type != "spawner")


def test_the_interface_of_a_controller() -> None:
    ros = "--controller-ros-args '-r ~/cmd_vel:=/cmd_vel'"
    nodes = started(MANAGER.format("", FILE) + SPAWNER.format(f"base {ros}", ' if="$(env ON)"'))
    base = next(node for node in nodes if node.name == "/base")
    assert topics(base) == ["/base/odom", "/cmd_vel"]  # no /tf, nor the limited velocity
    assert (base.package, base.process, base.container) == (
        "diff_drive_controller",
        "/controller_manager",
        "/controller_manager",
    )
    assert [condition.statement for condition in base.conditions] == ["if"]
    assert base.location is not None and base.location.path == "p/launch/l.launch.xml"


def test_a_spawner_names_itself_after_its_first_controller() -> None:
    names = [node.name for node in started(SPAWNER.format("jsb base", "") + SPAWNER.format("x", ' name="s"'))]
    assert sorted(names) == ["/base", "/jsb", "/s", "/spawner_jsb", "/x"]


@pytest.mark.parametrize(
    ("body", "config", "fields", "reason"),
    [
        (
            SPAWNER.format("jsb", ""),
            BY_MANAGER,
            {"type", "endpoints"},
            "nothing sets the parameter jsb.type of /controller_manager, which no launch file starts",
        ),
        (
            MANAGER.format("", FILE) + SPAWNER.format("gone", ""),
            BY_MANAGER,
            {"type", "endpoints"},
            "nothing sets the parameter gone.type of /controller_manager",
        ),
        (
            MANAGER.format("", '<param from="/etc/robot.yaml"/>') + SPAWNER.format("jsb", ""),
            BY_MANAGER,
            {"type", "endpoints"},
            "it may be set: parameter file '/etc/robot.yaml'",
        ),
        (
            MANAGER.format("", "") + SPAWNER.format("jsb -t acme/Own", ""),
            "",
            {"endpoints"},
            "the code of acme/Own is not in the workspace",
        ),
    ],
)
def test_what_is_not_known_of_a_controller(body: str, config: str, fields: set[str], reason: str) -> None:
    (node,) = (node for node in started(body, config) if node.type != "spawner")
    assert {unknown.field for unknown in node.unknowns} == fields
    assert any(unknown.reason.startswith(reason) for unknown in node.unknowns), node.unknowns
    assert node.endpoints == ()


@pytest.mark.parametrize(
    "body",
    [
        MANAGER.format("", FILE),
        MANAGER.format("", FILE) + SPAWNER.format("", ""),
        MANAGER.format("", FILE) + SPAWNER.format("--controller-manager jsb", ""),
        MANAGER.format("", FILE) + '<node pkg="controller_manager" exec="unspawner" args="jsb"/>',
        MANAGER.format("", FILE) + '<node pkg="controller_manager" exec="hardware_spawner" args="jsb"/>',
        MANAGER.format("", FILE) + '<node pkg="other" exec="spawner" args="jsb"/>',
    ],
)
def test_no_controller(body: str) -> None:
    assert not [node for node in started(body) if node.container is not None]


def test_a_package_in_words_is_one_word() -> None:
    assert shell_words("-d $(find p)/a.rviz '-r x:=y' $(find-pkg-share q)/b") == [
        "-d",
        "$(find p)/a.rviz",
        "-r x:=y",
        "$(find-pkg-share q)/b",
    ]
    assert shell_words("a 'b $(find p)") == ["a", "'b", "$(find p)"]


def test_a_controller_of_the_workspace_is_not_followed() -> None:
    (node,) = (
        node for node in started(MANAGER.format("", "") + SPAWNER.format("own -t p/Own", "")) if node.type == "p/Own"
    )
    assert [unknown.reason for unknown in node.unknowns] == [
        "p/Own is in the workspace, but what calls it is not: it is not followed"
    ]


@pytest.mark.parametrize(
    ("program", "args", "container"),
    [
        ("spawner.py", "jsb", "/controller_manager"),
        ("spawner.py", "jsb -c controller_manager", "/controller_manager"),
        ("spawner.py", "jsb -c /a/controller_manager", "/a/controller_manager"),
        ("spawner", "jsb", "/a/controller_manager"),
        ("spawner", "jsb -c controller_manager", "/a/controller_manager"),
        ("spawner", "jsb -c /controller_manager", "/controller_manager"),
    ],
)
def test_the_manager_of_a_spawner_with_a_namespace(program: str, args: str, container: str) -> None:
    body = f'<node pkg="controller_manager" exec="{program}" namespace="a" args="{args}"/>'
    assert [node.container for node in started(body) if node.container] == [container]
