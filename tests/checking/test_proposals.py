# SPDX-License-Identifier: Apache-2.0
"""Dependencies that several checks propose in one run close no cycle, neither with declared ones nor with each other."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license>{1}<export><build_type>ament_python</build_type></export></package>\n'
)
SETUP = (
    "from setuptools import setup\nsetup(name='{0}', version='1.0.0', packages=['{0}'], data_files=[('share/{0}/launch', ['launch/{0}.launch.xml'])],\n"
    "      entry_points={{'console_scripts': ['run = {0}.run:main']}})\n"
)
LOOKUP = "from ament_index_python.packages import get_package_share_directory\n\n\ndef main():\n    print(get_package_share_directory('{}'))\n"
NODE = '<launch><node pkg="{}" exec="run"/></launch>\n'


def package(
    name: str, *, declares: str = "", launches: str = "", looks_up: str = "", imports: str = ""
) -> dict[str, str]:
    declared = "".join(f"<exec_depend>{item}</exec_depend>" for item in ("ament_index_python", *declares.split()))
    run = LOOKUP.format(looks_up) if looks_up else f"import {imports or 'os'}\n\n\ndef main():\n    pass\n"
    return {
        f"{name}/package.xml": MANIFEST.format(name, declared),
        f"{name}/setup.py": SETUP.format(name),
        f"{name}/{name}/__init__.py": "",
        f"{name}/{name}/run.py": run,
        f"{name}/launch/{name}.launch.xml": NODE.format(launches or name),
    }


def found(files: dict[str, str], folder: Path) -> dict[str, list[tuple[str, str]]]:
    """By check, what it says of the workspace: levels and messages."""
    names = ("undeclared-launch-dependency", "undeclared-lookup-dependency", "undeclared-import")
    all_checks = {check.id: check for check in checks()}
    return {
        name: [(r.level.value, r.message) for r in said(all_checks[name], Example("", True, files), folder / name)]
        for name in names
    }


def test_a_launch_file_and_a_program_need_each_other(tmp_path: Path) -> None:
    files = {**package("sim", launches="tasks"), **package("tasks", looks_up="sim")}
    said_of = found(files, tmp_path)
    ((level, message),) = said_of["undeclared-launch-dependency"]
    assert level == "warning" and message.endswith("add <exec_depend>tasks</exec_depend>")
    ((level, message),) = said_of["undeclared-lookup-dependency"]
    assert level == "note" and "<exec_depend>" not in message
    assert "it needs tasks in turn" in message and "move what is looked up to a package that both depend on" in message


def test_a_circle_of_three(tmp_path: Path) -> None:
    files = {**package("a", imports="b"), **package("b", launches="c"), **package("c", looks_up="a")}
    said_of = found(files, tmp_path)
    assert [level for level, _ in said_of["undeclared-import"]] == ["error"]
    assert [level for level, _ in said_of["undeclared-launch-dependency"]] == ["warning"]
    assert [level for level, _ in said_of["undeclared-lookup-dependency"]] == ["note"]


def test_two_programs_look_each_other_up(tmp_path: Path) -> None:
    files = {**package("a", looks_up="b"), **package("b", looks_up="a")}
    said_of = found(files, tmp_path)
    assert [level for level, _ in said_of["undeclared-lookup-dependency"]] == ["warning", "note"]


def test_an_import_comes_before_a_launch_file(tmp_path: Path) -> None:
    files = {**package("a", launches="b"), **package("b", imports="a")}
    said_of = found(files, tmp_path)
    assert [level for level, _ in said_of["undeclared-import"]] == ["error"]
    assert said_of["undeclared-launch-dependency"] == []


@pytest.mark.parametrize(
    ("first", "second", "third"),
    [
        ({"launches": "b"}, {"looks_up": "c"}, {}),
        ({"launches": "b"}, {"looks_up": "c"}, {"looks_up": "b", "declares": "b"}),  # declared already: its own finding
        ({"launches": "b", "declares": "b"}, {"looks_up": "a"}, {}),
        ({"launches": "a"}, {"looks_up": "a"}, {}),
        ({"launches": "turtlesim"}, {"looks_up": "a"}, {}),
        ({"imports": "rclpy"}, {"looks_up": "a"}, {"launches": "a"}),
        ({"looks_up": "b"}, {"looks_up": "c"}, {"launches": "turtlesim"}),
    ],
)
def test_what_closes_no_cycle_is_proposed_as_ever(
    first: dict[str, str], second: dict[str, str], third: dict[str, str], tmp_path: Path
) -> None:
    files = {**package("a", **first), **package("b", **second), **package("c", **third)}
    assert all(level != "note" for messages in found(files, tmp_path).values() for level, _ in messages)
