# SPDX-License-Identifier: Apache-2.0
"""What manifests say under the ROS of their packages, and what comes with a package."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from haros_ci.checking.manifests import BUILD, EXPORTED, brings, build_types, holds, is_nested, needs, reaches, word
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.knowledge.knowledge import Knowledge
from haros_ci.workspace.discover import discover
from haros_ci.workspace.xml import parse_xml


def project_of(manifests: Mapping[str, str], tmp_path: Path) -> Project:
    for path, body in manifests.items():
        place = tmp_path / path / "package.xml"
        place.parent.mkdir(parents=True, exist_ok=True)
        name = path.rpartition("/")[2] if path != "." else "top"
        place.write_text(f'<package format="3"><name>{name}</name>{body}</package>', encoding="utf-8")
    workspace = discover(tmp_path, (".",))
    read = lambda path: parse_xml(workspace.text(path).encode())  # noqa: E731
    return Project(workspace, {}, {}, (), read_xml=read, knowledge=Knowledge())


def only(body: str, tmp_path: Path) -> ProjectPackage:
    package = project_of({"demo": body}, tmp_path).package("demo")
    assert package is not None
    return package


ROS_2 = "<buildtool_depend>ament_cmake</buildtool_depend>"
ROS_1 = "<buildtool_depend>catkin</buildtool_depend>"


@pytest.mark.parametrize(
    ("body", "condition", "verdict"),
    [
        (ROS_2, None, True),
        (ROS_2, "$ROS_VERSION == 2", True),
        (ROS_2, "$ROS_VERSION == 1", False),
        (ROS_1, "$ROS_VERSION == 1", True),
        (ROS_2, "$ROS_DISTRO == humble", None),
        (ROS_2, "$ROS_VERSION == 1 and $ROS_DISTRO == noetic", False),
        ("", "$ROS_VERSION == 1", None),
    ],
)
def test_conditions(body: str, condition: str | None, verdict: bool | None, tmp_path: Path) -> None:
    assert holds(only(body, tmp_path), condition) is verdict


def test_what_a_condition_rules_out_is_not_needed(tmp_path: Path) -> None:
    package = only(
        f'{ROS_2}<buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend><depend condition="$ROS_DISTRO == x">b</depend>'
        '<exec_depend>c</exec_depend><export><build_type condition="$ROS_VERSION == 1">catkin</build_type>'
        '<build_type condition="$ROS_VERSION == 2"> ament_cmake </build_type></export>',
        tmp_path,
    )
    assert [need.name for need in needs(package)] == ["ament_cmake", "b", "c"]
    assert [need.name for need in needs(package, "depend")] == ["b"]
    assert [word(each) for each in build_types(package)] == ["ament_cmake"]


def test_what_comes_with_a_package(tmp_path: Path) -> None:
    project = project_of(
        {
            "a": f"{ROS_2}<depend>b</depend><exec_depend>f</exec_depend>",
            "b": "<build_export_depend>c</build_export_depend><build_depend>d</build_depend>",
            "c": "<exec_depend>a</exec_depend><test_depend>e</test_depend>",
            "d": "",
            "e": "",
            "f": "",
        },
        tmp_path,
    )
    package = project.package("a")
    assert package is not None
    assert brings(package, ["b"], "c") is True and brings(package, ["b"], "b") is True
    assert brings(package, ["d"], "e") is False
    assert brings(package, ["d", "somewhere_else"], "e") is None
    assert reaches(package, ("depend",), "c") is True
    assert (
        reaches(package, ("depend",), "d") is False
    )  # what b is built with stays with b; c leads back to a, and so to f
    assert reaches(package, ("depend",), "f") is True
    assert reaches(package, BUILD, "f") is True and reaches(package, EXPORTED, "e") is False


@pytest.mark.parametrize(
    ("paths", "kept"),
    [
        (("a", "a/test/b"), ["a"]),
        (("a/b", "a/b/c", "a/b/c/d", "a/e"), ["a/b", "a/e"]),
        ((".", "a"), ["."]),
        (("a", "ab"), ["a", "ab"]),
        (("x/a", "x/b"), ["x/a", "x/b"]),
        (("a/b", "a-b/c", "a-b"), ["a-b", "a/b"]),
    ],
)
def test_packages_in_packages(paths: tuple[str, ...], kept: list[str], tmp_path: Path) -> None:
    project = project_of(dict.fromkeys(paths, ""), tmp_path)
    assert [package.path for package in project.packages] == kept
    assert not any(is_nested(package) for package in project.packages)
