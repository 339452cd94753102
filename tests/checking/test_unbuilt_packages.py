# SPDX-License-Identifier: Apache-2.0
"""Packages that are analysed though the build tools pass over them: a marker lies in the directory that was given."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license><buildtool_depend>ament_cmake</buildtool_depend>'
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(other)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"
FILES = {"demo/package.xml": MANIFEST, "demo/CMakeLists.txt": CMAKE}


def levels(files: dict[str, str], tmp_path: Path, base: dict[str, str] | None = None) -> list[Level]:
    check = next(check for check in checks() if check.id == "wrong-package-name")
    return [result.level for result in said(check, Example("", True, files, base=base), tmp_path)]


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"])
def test_below_a_marked_root_a_finding_on_a_build_is_a_note(marker: str, tmp_path: Path) -> None:
    assert levels({**FILES, marker: ""}, tmp_path) == [Level.NOTE]


@pytest.mark.parametrize("other", ["COLCON_IGNORED", "third_party/COLCON_IGNORE", "demo/test/COLCON_IGNORE"])
def test_other_files_and_other_folders_change_nothing(other: str, tmp_path: Path) -> None:
    assert levels({**FILES, other: ""}, tmp_path) == [Level.ERROR]


def test_a_marker_that_a_change_adds_hides_nothing(tmp_path: Path) -> None:
    assert levels({**FILES, "COLCON_IGNORE": ""}, tmp_path, base=FILES) == [Level.ERROR]
    assert levels({**FILES, "COLCON_IGNORE": ""}, tmp_path / "both", base={**FILES, "COLCON_IGNORE": ""}) == [
        Level.NOTE
    ]
