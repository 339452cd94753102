# SPDX-License-Identifier: Apache-2.0
"""Packages that a change takes out of the model while their code stays, and those that go, move or change otherwise."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.model.workspace import Hiding
from haros_ci.workspace.discover import discover
from haros_ci.workspace.lost_packages import lost_packages

NODE = "import rclpy\nrclpy.init()\nnode = rclpy.create_node('n')\n"
CPP = "#include <rclcpp/rclcpp.hpp>\nint main() {}\n"
LAUNCH = (
    "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return LaunchDescription()\n"
)
Files = dict[str, str | None]


def manifest(name: str, kind: str = "ament_python") -> str:
    kind = f"<export><build_type>{kind}</build_type></export>"
    return f"<package format='3'><name>{name}</name><version>1.0.0</version>{kind}</package>\n"


ARM: Files = {"arm/package.xml": manifest("arm"), "arm/arm/node.py": NODE, "arm/setup.py": "", "README.md": "An arm.\n"}
LEG: Files = {"leg/package.xml": manifest("leg", "ament_cmake"), "leg/src/node.cpp": CPP, "leg/CMakeLists.txt": ""}
PLAIN: Files = {"arm/package.xml": manifest("arm"), "arm/arm/sums.py": "A = 1\n", "arm/src/a.cpp": "int a;\n"}
BOTH = ARM | LEG


def lost(place: Path, base: Files, head: Files, renames: dict[str, str] | None = None) -> list[tuple[str, str]]:
    """The problems of *head*, which is *base* with other files; those that are None are gone."""
    spaces = []
    for side, files in (("base", base), ("head", base | head)):
        subprocess.run(["git", "init", "-q", place / side], check=True)
        for name, text in files.items():
            if text is not None:
                path = place / side / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
        spaces.append(discover(place / side, ()))
    later = (
        path.rpartition("/")[0] for path, text in head.items() if text is not None and path.endswith("package.xml")
    )
    now = replace(spaces[1], hiding=Hiding(later=tuple(sorted(later))))
    return [(problem.path, problem.message) for problem in lost_packages(now, spaces[0], renames or {})]


GONE: Files = {"arm/package.xml": None}
FIRES: dict[str, tuple[Files, Files, str, str]] = {
    "gone": (ARM, GONE, "arm/arm/node.py", "lies in no package, as arm/package.xml is gone"),
    "gone, of C++": (LEG, {"leg/package.xml": None}, "leg/src/node.cpp", "as leg/package.xml is gone"),
    "gone, with a launch file": (ARM | {"arm/launch/a.launch.py": LAUNCH}, GONE, "arm/arm/node.py", "1 more files"),
    "another name of the file": (ARM, GONE | {"arm/package.xml.bak": manifest("arm")}, "arm/arm/node.py", "is gone"),
    "deeper": (ARM, GONE | {"arm/data/package.xml": manifest("arm")}, "arm/arm/node.py", "arm/package.xml is gone"),
    "another program in its place": (ARM, GONE | {"arm/arm/node.py": None, "arm/n.py": NODE}, "arm/n.py", "is gone"),
    "around both": (
        BOTH,
        {"package.xml": manifest("all")},
        "package.xml",
        "2 packages of the base revision (arm, leg)",
    ),
    "moved up": (
        {f"src/{path}": text for path, text in BOTH.items()},
        {"src/arm/package.xml": None, "src/package.xml": manifest("arm")},
        "src/package.xml",
        "a package around a package of the base revision (src/leg)",
    ),
    "the name of another": (BOTH, {"leg/package.xml": manifest("arm")}, "leg/package.xml", "is called 'arm', too"),
    "the name of a later one": (BOTH, {"arm/package.xml": manifest("leg")}, "arm/package.xml", "is called 'leg', too"),
    "a new one of its name": (
        ARM,
        {"new/package.xml": manifest("arm"), "new/n.py": NODE},
        "new/package.xml",
        "another package is called 'arm', too, and the model has that one",
    ),
}


@pytest.mark.parametrize("name", FIRES)
def test_lost(name: str, tmp_path: Path) -> None:
    base, head, path, words = FIRES[name]
    ((at, message),) = lost(tmp_path, base, head)
    assert at == path and words in message


QUIET: dict[str, tuple[Files, Files]] = {
    "nothing": (BOTH, {}),
    "gone with its code": (BOTH, dict.fromkeys(ARM)),
    "gone, and code without ROS stays": (PLAIN, GONE),
    "gone, and words on ROS stay": (ARM, GONE | {"arm/arm/node.py": "# import rclpy\nprint('import rospy')\n"}),
    "another name": (ARM, {"arm/package.xml": manifest("hand")}),
    "another build": (ARM, {"arm/package.xml": manifest("arm", "ament_cmake")}),
    "moved whole": (ARM, dict.fromkeys(ARM) | {f"src/{path}": text for path, text in ARM.items()}),
    "moved up whole": ({f"src/{path}": text for path, text in ARM.items()}, {"src/arm/package.xml": None, "src/package.xml": manifest("arm")}),
    "parted": (ARM, {"arm/package.xml": None, "arm/arm/node.py": None, "arm/a/package.xml": manifest("a"), "arm/a/n.py": NODE}),
    "put into another": (ARM | {"arm/arm/node.py": None, "arm/hand/package.xml": manifest("hand"), "arm/hand/n.py": NODE}, {"arm/hand/package.xml": None}),
    "a package inside a new one": (ARM, {"new/package.xml": manifest("new"), "new/in/package.xml": manifest("in"), "new/in/n.py": NODE}),
    "two of one name before": (ARM | {"b/package.xml": manifest("arm"), "b/n.py": NODE}, {"b/n.py": f"{NODE}# more\n"}),
    "two of one name before, and another manifest": (
        ARM | {"b/package.xml": manifest("arm"), "b/n.py": NODE},
        {"b/package.xml": manifest("arm", "ament_cmake")},
    ),
    "two of one name, without code": (BOTH, {"new/package.xml": manifest("arm"), "new/arm.urdf": "<robot name='a'/>\n"}),
    "one of its name that is ignored": (ARM, {"new/package.xml": manifest("arm"), "new/n.py": NODE, "new/COLCON_IGNORE": ""}),
    "ignored before, and gone": (ARM | {"arm/COLCON_IGNORE": ""}, GONE),
    "a manifest that no parser takes": (ARM, {"arm/package.xml": "<package>\n"}),
    "a program that never was in a package": (BOTH | {"tools/t.py": NODE}, {"tools/t.py": f"{NODE}# more\n"}),
    "a new program in no package": (BOTH, {"tools/t.py": NODE}),
    "first packages": ({"README.md": "An arm.\n"}, BOTH),
}  # fmt: skip


@pytest.mark.parametrize("name", QUIET)
def test_not_lost(name: str, tmp_path: Path) -> None:
    base, head = QUIET[name]
    assert lost(tmp_path, base, head) == []


def test_a_double_that_moves_is_as_it_was(tmp_path: Path) -> None:
    base: Files = ARM | {"b/package.xml": manifest("arm"), "b/n.py": NODE}
    head: Files = {"b/package.xml": None, "b/n.py": None, "c/package.xml": manifest("arm"), "c/n.py": NODE}
    assert lost(tmp_path / "known", base, head, {"b/package.xml": "c/package.xml"}) == []
    assert [path for path, _ in lost(tmp_path / "new", base, head)] == ["c/package.xml"]
