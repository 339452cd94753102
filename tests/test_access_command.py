# SPDX-License-Identifier: Apache-2.0
"""Access rules in a whole run: where findings stand, and that a change cannot allow itself anything."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, write

from haros_ci.cli import main

MANIFEST = (
    "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.org'>a</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>"
    "<depend>rclpy</depend><depend>std_msgs</depend><export><build_type>ament_cmake</build_type></export></package>"
)
FILES = {
    "demo/package.xml": MANIFEST,
    "demo/CMakeLists.txt": "project(demo)\nfind_package(ament_cmake)\ninstall(PROGRAMS talker.py DESTINATION lib/demo)\nament_package()\n",
    "demo/talker.py": "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\n\nrclpy.init()\n"
    "node = rclpy.create_node('talker')\nnode.create_publisher(String, 'chatter', 10)\nrclpy.spin(node)\n",
    "haros.yaml": "project: demo\naccess:\n  publish:\n    /chatter: [/other]\n",
}
OPEN = "# rules\nproject: demo\naccess:\n  publish:\n    /chatter: [/other, /talker]\n"


def findings(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[dict[str, Any]]:
    main(["check", ".", "--no-cache", "--profile", "architecture", "--output", "sarif", *arguments])
    log = json.loads(capsys.readouterr().out)
    return [one for run in log["runs"] for one in run["results"] if one["ruleId"] == "access-not-allowed"]


def place(of: dict[str, Any]) -> tuple[str, int]:
    physical = of["physicalLocation"]
    return physical["artifactLocation"]["uri"], physical["region"]["startLine"]


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    write(tmp_path, FILES)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_it_stands_at_the_call_with_the_rule_beside_it(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (found,) = findings(capsys)
    assert found["level"] == "error" and place(found["locations"][0]) == ("demo/talker.py", 7)
    assert [place(one) for one in found["relatedLocations"]] == [("haros.yaml", 4)]
    assert found["message"]["text"].startswith(
        "/talker publishes /chatter, which only /other may publish (haros.yaml:4)"
    )


def test_the_rules_of_the_base_revision_count(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    base = commit(workspace)
    (workspace / "haros.yaml").write_text(OPEN, encoding="utf-8")
    (found,) = findings(capsys, f"--baseline-rev={base}")
    assert [place(one) for one in found["relatedLocations"]] == [("haros.yaml", 5)]
    (workspace / "haros.yaml").unlink()
    assert len(findings(capsys, f"--baseline-rev={base}")) == 1
    (workspace / "haros.yaml").write_text(OPEN, encoding="utf-8")
    commit(workspace)
    assert findings(capsys, "--baseline-rev=HEAD") == []


def test_a_call_is_one_finding_under_all_its_names(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    start = "<node pkg='demo' exec='talker.py' namespace='{}'/>"
    launch = f"<launch>{start.format('left')}{start.format('right')}</launch>"
    (workspace / "demo" / "all.launch.xml").write_text(launch, encoding="utf-8")
    (workspace / "haros.yaml").write_text("access:\n  publish:\n    /**/chatter: []\n", encoding="utf-8")
    (found,) = findings(capsys)
    text = found["message"]["text"]
    assert "/left/talker publishes /left/chatter, which no node may publish (haros.yaml:3)" in text
    assert "; likewise for /right/talker (/right/chatter)" in text
