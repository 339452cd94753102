# SPDX-License-Identifier: Apache-2.0
"""A launch file that no launch can read is a finding, at its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import Settings
from haros_ci.pipeline import analyse
from haros_ci.workspace.cache import MemoryCache

MANIFEST = """<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>Apache-2.0</license>
<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>
"""


def found(root: Path, name: str, text: str) -> list[tuple[str, int | None]]:
    place = root / "launch" / name
    place.parent.mkdir(parents=True)
    place.write_text(text, encoding="utf-8")
    (root / "package.xml").write_text(MANIFEST, encoding="utf-8")
    report, _ = analyse(Settings(root=root, profile="architecture"), MemoryCache())
    return [(r.location.path, r.location.line) for r in report.results if r.rule == "malformed-launch-file"]


@pytest.mark.parametrize("name", ["a.launch", "a.launch.xml"])
@pytest.mark.parametrize(
    "text", ["<launch>\n  <node>\n</launch>\n", '<launch>\n\n<arg name="a" default="a & b"/></launch>\n']
)
def test_fires(name: str, text: str, tmp_path: Path) -> None:
    assert found(tmp_path, name, text) == [(f"launch/{name}", 3)]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.launch", "<launch/>\n"),
        ("a.launch.xml", '<launch><arg name="a" default="a &amp; b"/></launch>\n'),
        ("a.launch", "<!-- nothing yet -->\n<launch>\n</launch>\n"),
        ("a.launch.yaml", "launch: []\n"),
        ("a.launch.py", "def generate_launch_description(:\n"),
        ("a.launch", ""),
        ("template/a.launch", "<launch>\n  [NODES]<arg [NAME]/>\n</launch>\n"),
        ("a.launch", "launch:\n  - arg: {name: a}\n"),
    ],
)
def test_stays_quiet(name: str, text: str, tmp_path: Path) -> None:
    assert found(tmp_path, name, text) == []
