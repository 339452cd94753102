# SPDX-License-Identifier: Apache-2.0
"""What the command writes for the examples passes the validator whole, GitHub's old limits included."""

from __future__ import annotations

import shutil
from pathlib import Path

import multitool
from commandline import commit, haros

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
CASES = {
    "archive": [],
    "github": ["--sarif-for", "github"],
    "strict": ["--profile", "strict"],
    "baseline": ["--baseline-rev", "HEAD"],
}


def test_the_logs_of_every_example(tmp_path: Path) -> None:
    logs = {}
    for example in ("warehouse_ws", "legacy_ws"):
        workspace = tmp_path / example
        shutil.copytree(EXAMPLES / example, workspace)
        commit(workspace)
        off = ["--ignore", "ruff,clang-tidy,catkin_lint"]
        for name, arguments in CASES.items():
            log = tmp_path / f"{example}-{name}.sarif"
            done = haros("check", *arguments, *off, "--output", f"sarif={log}", cwd=workspace)
            assert done.returncode in (0, 1), done.stderr
            logs[f"{example}, {name}"] = log
    said = multitool.validate_all(logs, large=False)
    assert said == {name: [] for name in logs}
