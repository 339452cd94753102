# SPDX-License-Identifier: Apache-2.0
"""A missing file is an error; a note where the default of an environment variable names it, and the package has one for another value."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_missing_files_off_by_default import ROS1

from haros_ci.config.settings import Settings
from haros_ci.pipeline import analyse
from haros_ci.results.rule import Level
from haros_ci.workspace.cache import MemoryCache

PARTS = {"launch/parts_north.launch": "<launch/>\n"}


def levels(text: str, tmp_path: Path) -> list[Level]:
    files = {**ROS1, **PARTS, "launch/a.launch": f"<launch>{text}</launch>\n"}
    for name, content in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content, encoding="utf-8")
    report, _ = analyse(Settings(root=tmp_path, profile="architecture"), MemoryCache())
    return [each.level for each in report.results if each.rule == "missing-launch-file"]


@pytest.mark.parametrize(
    "text",
    [
        '<include file="$(find demo)/launch/parts_none.launch"/>',
        '<arg name="site" default="none"/><include file="$(find demo)/launch/parts_$(arg site).launch"/>',
        '<arg name="sim" default="$(optenv SIM 0)"/><include file="$(find demo)/launch/parts_none.launch"/>',
        '<include file="$(find demo)/other/$(optenv KIND x)/quite_different.launch"/>',
    ],
)
def test_errors(text: str, tmp_path: Path) -> None:
    assert levels(text, tmp_path) == [Level.ERROR]


@pytest.mark.parametrize(
    "text",
    [
        '<include file="$(find demo)/launch/parts_$(optenv SITE none).launch"/>',
        '<arg name="site" default="$(optenv SITE none)"/><include file="$(find demo)/launch/parts_$(arg site).launch"/>',
        '<arg name="site" value="$(optenv SITE sou)th"/><include file="$(find demo)/launch/parts_$(arg site).launch"/>',
        "<include file=\"$(eval find('demo') + '/launch/parts_' + optenv('SITE', 'none') + '.launch')\"/>",
    ],
)
def test_notes(text: str, tmp_path: Path) -> None:
    assert levels(text, tmp_path) == [Level.NOTE]


def test_a_default_that_is_there(tmp_path: Path) -> None:
    assert levels('<include file="$(find demo)/launch/parts_$(optenv SITE north).launch"/>', tmp_path) == []
