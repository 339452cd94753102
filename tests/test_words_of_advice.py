# SPDX-License-Identifier: Apache-2.0
"""What findings advise fits where they stand: no method inside of itself, the node that declares a parameter, the script that is no copy."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

import pytest
from test_check_levels import CMAKE, ROS2

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.checking.set_aside import is_copy_by_name
from haros_ci.registry import checks
from haros_ci.substitutions.files import Files
from haros_ci.workspace.discover import discover

HEAD = "import rclpy\nfrom rclpy.node import Node\n\n\n"
MAIN = "\n\nrclpy.init()\nrclpy.spin({}())\n"


def messages(rule: str, files: dict[str, str], tmp_path: Path, executables: frozenset[str] = frozenset()) -> list[str]:
    check = next(check for check in checks() if check.id == rule)
    found = said(check, Example("", True, files, executables=executables), tmp_path)
    return [result.message for result in found]


@pytest.mark.parametrize(
    ("method", "hint"),
    [("publish_grip_cmd", "set it in __init__()"), ("publish_grips", "did you mean self.publish_grips?")],
)
def test_no_method_is_meant_inside_of_itself(method: str, hint: str, tmp_path: Path) -> None:
    body = (
        f"class Hand(Node):\n    def __init__(self):\n        super().__init__('hand')\n        self.{method}()\n\n"
        f"    def {method}(self):\n        {'self.other()' if 'cmd' not in method else 'self.publish_grip_cmds.publish(1)'}\n\n"
        f"    def other(self):\n        {'pass' if 'cmd' in method else 'self.publish_grip(1)'}\n"
    )
    files = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format("install(PROGRAMS hand.py DESTINATION lib/demo)")}
    (message,) = messages("undefined-attribute", {**files, "hand.py": HEAD + body + MAIN.format("Hand")}, tmp_path)
    assert hint in message


def node(name: str, *parameters: str) -> str:
    declared = "".join(f"        self.declare_parameter('{key}', 1)\n" for key in parameters)
    return f"{HEAD}class N(Node):\n    def __init__(self):\n        super().__init__('{name}')\n{declared or '        pass'}\n{MAIN.format('N')}"


@pytest.mark.parametrize(
    ("key", "of_head", "of_tail", "expected"),
    [
        ("head_frame", ("head_frame",), (), "; /head declares it: give it to that node"),
        ("head_frame", ("head_frame",), ("head_frame",), "; correct the name, or remove it"),  # two declare it
        ("rate", ("rate",), (), "; correct the name, or remove it"),  # everybody has one
        ("head_frame", (), (), "; correct the name, or remove it"),
    ],
)
def test_the_node_that_declares_a_parameter(
    key: str, of_head: tuple[str, ...], of_tail: tuple[str, ...], expected: str, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS head.py map.py tail.py DESTINATION lib/demo)"),
        "head.py": node("head", *of_head),
        "tail.py": node("tail", *of_tail),
        "map.py": node("map", "size_of_map"),
        "launch/a.launch.xml": '<launch><node pkg="demo" exec="head.py"/><node pkg="demo" exec="tail.py"/>'
        f'<node pkg="demo" exec="map.py"><param name="{key}" value="1"/></node></launch>\n',
    }
    found = messages("parameter-not-declared", files, tmp_path, frozenset(("head.py", "tail.py", "map.py")))
    assert len(found) == 1
    assert expected in found[0]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("a/drive (Copy).py", True),
        ("a/drive (copy 2).py", False),
        ("a/drive (1).py", True),
        ("drive - Copy.py", True),
        ("copy of drive.py", True),
        ("drive_copy.py", True),
        ("a (copy)/drive.py", False),
        ("drive.py", False),
        ("copy_files.py", False),
        ("photocopy.py", False),
    ],
)
def test_copies_by_their_names(path: str, expected: bool) -> None:
    assert is_copy_by_name(path) is expected


def test_why_a_file_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "map.png").write_bytes(b"\x89PNG\r\n\x1a\n\0")
    workspace = discover(tmp_path, (".",))
    files = Files(workspace, {}, frozenset(), MappingProxyType({}))
    assert files.why_not("map.png") == "is no text file of the workspace"
    assert files.why_not("map.yaml") == "is not in the workspace"
