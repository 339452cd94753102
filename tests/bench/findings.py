# SPDX-License-Identifier: Apache-2.0
"""Findings per profile on real workspaces, per 1000 lines of C++ and Python.

    python tests/bench/findings.py WORKSPACE...

Uses the five default tools; the first profile fills a cache that the others read.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

PROFILES = ("bugs-only", "ros", "strict", "google", "all")


def main() -> None:
    print("| workspace | packages | lines |", " | ".join(PROFILES), "| gave up |")
    print("|---|---|---|" + "---|" * (len(PROFILES) + 1))
    with tempfile.TemporaryDirectory() as scratch:
        project = Path(scratch, "haros-ci.yaml")
        project.write_text("fail-on: never\nlinters: {ruff: false, clang-tidy: false, catkin_lint: false}\n")
        for workspace in map(Path, sys.argv[1:]):
            cells, coverage, given_up = [], {}, set()
            for profile in PROFILES:
                command = [
                    sys.executable,
                    "-I",
                    "-m",
                    "haros_ci",
                    "check",
                    ".",
                    "--output=json",
                    f"--profile={profile}",
                ]
                command += [f"--project={project}", f"--cache-dir={scratch}/cache"]
                done = subprocess.run(command, cwd=workspace, capture_output=True, check=False)
                if done.returncode:
                    sys.exit(
                        f"{workspace}, {profile}: exit code {done.returncode}\n{done.stderr.decode(errors='replace')}"
                    )
                report = json.loads(done.stdout)
                coverage = report["coverage"]
                number = report["counts"]["open"]
                cells.append(f"{number} ({1000 * number / max(coverage['lines'], 1):.2f})")
                given_up = {n["path"] for n in report["notifications"] if n.get("path") and n.get("tool")}
            print(
                f"| {workspace.name} | {coverage['packages']} | {coverage['lines']} |",
                " | ".join(cells),
                f"| {len(given_up)} files |",
            )


if __name__ == "__main__":
    main()
