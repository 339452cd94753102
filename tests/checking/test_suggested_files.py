# SPDX-License-Identifier: Apache-2.0
"""What is suggested for a launch file that does not exist: never one whose include would include itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license><buildtool_depend>catkin</buildtool_depend></package>\n'
)
INCLUDE = '<launch><include file="$(find demo)/launch/{}"/></launch>\n'


@pytest.mark.parametrize(
    ("files", "suggested"),
    [
        ({"robot_parts.launch": INCLUDE.format("robots_parts.launch")}, ""),
        (
            {"a.launch": INCLUDE.format("robots_parts.launch"), "robot_parts.launch": "<launch/>\n"},
            "robot_parts.launch",
        ),
        (
            {
                "robot_parts.launch": INCLUDE.format("inner.launch"),
                "inner.launch": INCLUDE.format("robots_parts.launch"),
            },
            "",
        ),
    ],
)
def test_no_file_that_includes_itself(files: dict[str, str], suggested: str, tmp_path: Path) -> None:
    every = {f"launch/{name}": text for name, text in files.items()} | {"package.xml": MANIFEST}
    check = next(check for check in checks() if check.id == "missing-launch-file")
    messages = [result.message for result in said(check, Example("", True, every), tmp_path)]
    assert len(messages) == 1
    assert ("did you mean" in messages[0]) == bool(suggested) and suggested in messages[0], messages
