# SPDX-License-Identifier: Apache-2.0
"""What two revisions of a change have in common is made once, and is the same as if each were alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import write
from mutations import LAUNCH_XML, LISTENER_CPP, ROS2, TALKER_CPP

from haros_ci.analysis.architecture import Common, varied
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

PARAMETERS, PYTHON, OLD = "walker/config/walker.yaml", "walker/launch/more.launch.py", "older/launch/older.launch"
FILES = {
    **ROS2,
    PARAMETERS: "listener:\n  ros__parameters:\n    depth: 3\n",
    PYTHON: "from launch import LaunchDescription\n\ndef generate_launch_description():\n    return LaunchDescription([])\n",
    "older/package.xml": "<package><name>older</name><buildtool_depend>catkin</buildtool_depend></package>\n",
    OLD: '<launch><node pkg="older" type="old" name="old"/></launch>\n',
}
#: The head of a change, in which only C++ is another, and what has to be launched for it anew.
SHARED = {
    "a comment": {LISTENER_CPP: "// more\n" + ROS2[LISTENER_CPP]},
    "another type": {LISTENER_CPP: ROS2[LISTENER_CPP].replace("Int32", "String")},
    "both programs": {LISTENER_CPP: "\n" + ROS2[LISTENER_CPP], TALKER_CPP: "\n\n" + ROS2[TALKER_CPP]},
}
ANEW = {
    "a launch file": {LAUNCH_XML: ROS2[LAUNCH_XML].replace("steps", "paces")},
    "a launch file of ROS 1": {OLD: FILES[OLD].replace('name="old"', 'name="young"')},
    "parameters": {PARAMETERS: FILES[PARAMETERS].replace("3", "4")},
    "Python": {PYTHON: FILES[PYTHON] + "\n# more\n"},
    "a manifest": {"walker/package.xml": ROS2["walker/package.xml"].replace("<package", "\n<package", 1)},
    "CMake": {"walker/CMakeLists.txt": ROS2["walker/CMakeLists.txt"] + "\n"},
    "one file more": {"walker/src/other.cpp": "int main() {}\n"},
    "another file that is not read": {"walker/maps/hall.pgm": "P5"},
}


def architecture(root: Path, store: MemoryCache, common: Common | None) -> Architecture:
    settings = Settings(root=root)
    workspace = discover(root, (), exclude=settings.exclude, max_file_size=settings.max_file_size)
    return varied(workspace, settings, store, common=common).architecture


def made(tmp_path: Path, change: dict[str, str]) -> tuple[Common, Architecture, Architecture]:
    """What two revisions share, and the base's architecture: made after the head's with that, and by itself."""
    base, head = write(tmp_path / "base", FILES), write(tmp_path / "head", {**FILES, **change})
    store, common = MemoryCache(), Common()
    architecture(base, store, None)  # what an earlier run has kept
    architecture(head, store, common)
    return common, architecture(base, store, common), architecture(base, MemoryCache(), None)


@pytest.mark.parametrize("change", SHARED.values(), ids=SHARED)
def test_launched_once(tmp_path: Path, change: dict[str, str]) -> None:
    common, with_head, alone = made(tmp_path, change)
    assert [len(launched) > 1 for launched in common.launched.values()] == [True]
    assert with_head == alone


@pytest.mark.parametrize("change", ANEW.values(), ids=ANEW)
def test_launched_anew(tmp_path: Path, change: dict[str, str]) -> None:
    common, with_head, alone = made(tmp_path, change)
    assert len(common.launched) == 2
    assert with_head == alone


def test_what_was_followed_is_read_once(tmp_path: Path) -> None:
    common, _, _ = made(tmp_path, SHARED["a comment"])
    held = [record for record in common.records.values() if record is not None]
    assert held
    assert all(record.made for record in held)


def test_what_is_found_in_a_file_is_found_once(tmp_path: Path) -> None:
    common, with_head, alone = made(tmp_path, SHARED["a comment"])
    assert len(common.calls) == 3, "the talker, and the listener of each"
    assert with_head == alone
