# SPDX-License-Identifier: Apache-2.0
"""A manifest that cannot be parsed: that is said once, and nothing is said of what it declares."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import Settings
from haros_ci.pipeline import analyse
from haros_ci.workspace.cache import MemoryCache

MANIFEST = """<?xml version="1.0"?>
<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>Apache-2.0</license>
<buildtool_depend>ament_cmake</buildtool_depend>{more}<export><build_type>ament_cmake</build_type></export></package>
"""
LAUNCH = """<launch><include file="$(find-pkg-share {name})/launch/{file}.launch.xml"/></launch>
"""


def found(root: Path, manifest: str) -> list[tuple[str, str]]:
    """Rules and messages for two packages: one includes a launch file of the other, whose directory has another name and whose manifest this is."""
    for directory, text, launch in (
        (
            "first",
            MANIFEST.format(name="first", more="<exec_depend>second</exec_depend>"),
            LAUNCH.format(name="second", file="down"),
        ),
        ("other_name", manifest, LAUNCH.format(name="nav2_bringup", file="a")),
    ):
        place = root / directory
        (place / "launch").mkdir(parents=True)
        (place / "package.xml").write_text(text, encoding="utf-8")
        name = "up" if directory == "first" else "down"
        (place / "launch" / f"{name}.launch.xml").write_text(launch, encoding="utf-8")
        cmake = "find_package(ament_cmake REQUIRED)\ninstall(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()\n"
        (place / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.8)\nproject({'first' if directory == 'first' else 'second'})\n{cmake}",
            encoding="utf-8",
        )
    report, _ = analyse(Settings(root=root, profile="ros"), MemoryCache())
    return [(result.rule, result.message) for result in report.results]


GOOD = MANIFEST.format(name="second", more="")


def test_with_a_manifest_that_is_read(tmp_path: Path) -> None:
    rules = [rule for rule, _ in found(tmp_path, GOOD)]
    assert "undeclared-launch-dependency" in rules
    assert "malformed-manifest" not in rules


@pytest.mark.parametrize("broken", ["\n" + GOOD, GOOD.replace("</license>", ""), GOOD + "</package>"])
def test_with_one_that_is_not(broken: str, tmp_path: Path) -> None:
    said = found(tmp_path, broken)
    rules = [rule for rule, _ in said]
    assert rules.count("malformed-manifest") == 1
    assert "undeclared-launch-dependency" not in rules
    assert not any("second" in message and "not in the workspace" in message for _, message in said)
