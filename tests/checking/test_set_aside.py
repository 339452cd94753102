# SPDX-License-Identifier: Apache-2.0
"""Findings on launch files in directories of what is no longer used are notes, unless something outside names the file."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license><buildtool_depend>catkin</buildtool_depend></package>\n'
)
BROKEN = '<launch><include file="$(find demo)/launch/not_there.launch"/></launch>\n'


def level(files: dict[str, str], tmp_path: Path) -> Level:
    check = next(check for check in checks() if check.id == "missing-launch-file")
    (result,) = said(check, Example("", True, {"package.xml": MANIFEST, **files}), tmp_path)
    assert ("(nothing" in result.message) == (result.level is Level.NOTE)
    return result.level


@pytest.mark.parametrize(
    "folder",
    [
        *("launch/deprecated", "launch/old", "old/launch", "launch/Archive/2012", "launch/temp", "launch/not_used"),
        *(
            "launch/Not Used",
            "not-in-use/launch",
            "launch/files_not_needed",
            "launch/no usado",
            "old_launch",
            "launch_bak/old",
        ),
    ],
)
def test_in_an_archive(folder: str, tmp_path: Path) -> None:
    assert level({f"{folder}/drive.launch": BROKEN, "README.md": "# demo\n"}, tmp_path) is Level.NOTE


@pytest.mark.parametrize(
    "name", ["Copy of drive.launch", "drive (copy).launch", "drive (2).launch", "drive_copy.launch"]
)
def test_a_copy(name: str, tmp_path: Path) -> None:
    assert level({f"launch/{name}": BROKEN}, tmp_path) is Level.NOTE


@pytest.mark.parametrize(
    "name",
    ["drive_old.launch", "drive.backup2.launch", "drive-bak.launch", "drive_old_kiss.launch", "old_drive.launch"],
)
def test_a_former_version(name: str, tmp_path: Path) -> None:
    whole = "<launch/>\n"
    assert level({f"launch/{name}": BROKEN, "launch/drive.launch": whole}, tmp_path) is Level.NOTE
    assert level({f"launch/{name}": BROKEN, "launch/drives.launch": whole}, tmp_path / "b") is Level.ERROR


@pytest.mark.parametrize(
    "files",
    [
        {"launch/drive.launch": BROKEN},
        {"launch/drive_old.launch": BROKEN, "launch/drive.launch": "<launch/>\n", "README.md": "roslaunch demo drive_old.launch\n"},
        {"launch/drive_bold.launch": BROKEN, "launch/drive.launch": "<launch/>\n"},
        {"launch/old.launch": BROKEN, "launch/drive.launch": "<launch/>\n"},
        {"launch/notes/drive.launch": BROKEN},
        {"launch/used/drive.launch": BROKEN},
        {"launch/re_used/drive.launch": BROKEN},
        {"launch/knot_used/drive.launch": BROKEN},
        {"launch/not_used/drive.launch": BROKEN, "README.md": "roslaunch demo drive.launch\n"},
        {"launch/household.launch": BROKEN, "launch/house.launch": "<launch/>\n"},
        {"launch/older/drive.launch": BROKEN},
        {"launch/copy_files.launch": BROKEN},
        {"launch/photocopy.launch": BROKEN},
        {"launch/drive_copy.launch": BROKEN, "README.md": "roslaunch demo drive_copy.launch\n"},
        {"launch/deprecated.launch": BROKEN},
        {"launch/old/drive.launch": BROKEN, "README.md": "roslaunch demo drive.launch\n"},
        {"launch/old/drive.launch": BROKEN, "launch/all.launch": '<launch><include file="$(find demo)/launch/old/drive.launch"/></launch>\n'},
        {"launch/old/drive.launch": BROKEN, "scripts/start.sh": "roslaunch demo drive.launch\n"},
    ],
)  # fmt: skip
def test_in_use(files: dict[str, str], tmp_path: Path) -> None:
    assert level(files, tmp_path) is Level.ERROR
