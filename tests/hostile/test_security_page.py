# SPDX-License-Identifier: Apache-2.0
"""docs/security.md counts the attacks as the suite has them."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs" / "security.md"

#: What each module attacks, and so the order of the table.
CLASSES = {
    "test_hostile_leaks.py": "a tool is made to read what lies outside, once with the sandbox and once without",
    "test_hostile_code.py": "code of the workspace is to run",
    "test_hostile_linters.py": "linters that run if asked for: imports, settings and names that lead out",
    "test_hostile_silencing.py": "settings of linters that a change adds, alters or removes",
    "test_hostile_hiding.py": "the base revision is not to be had",
    "test_hostile_hiding_markers.py": "marker files, moved and renamed directories",
    "test_hostile_hiding_unread.py": "changed files that no tool can read",
    "test_hostile_hiding_comments.py": "comments that silence",
    "test_hostile_hiding_conditions.py": "directives and conditions that cppcheck would read otherwise than a compiler",
    "test_hostile_hiding_brought.py": "what a change brings that neither linters nor the model see",
    "test_hostile_hiding_limits.py": "files that a change makes too large, or too deeply nested, to be analysed",
    "test_hostile_settings.py": "project files",
    "test_hostile_git.py": "repositories, revisions, git's own settings",
    "test_hostile_tree.py": "names, links, devices, sizes, depths",
    "test_hostile_tools.py": "tools that crash, hang, flood or lie; bombs",
    "test_hostile_signals.py": "signals at any moment",
    "test_hostile_environment.py": "closed streams, full disks, limits, odd environments",
    "test_hostile_outputs.py": "outputs that are led elsewhere",
    "test_hostile_sinks.py": "text that an output would obey",
    "test_hostile_cache.py": "planted and damaged caches",
    "test_hostile_cache_answers.py": "answers planted in caches",
    "test_hostile_logs.py": "SARIF logs, baselines",
    "test_hostile_model.py": "models that grow without end",
    "test_hostile_packages.py": "manifests and CMake",
    "test_hostile_robots.py": "robot descriptions",
    "test_hostile_declarations.py": "declared tools",
    "test_hostile_monitors.py": "names and texts in monitors that are generated",
}


def table() -> str:
    """The table as the suite has it now."""
    done = subprocess.run(
        [sys.executable, "-m", "pytest", str(HERE), "--collect-only", "-q", "-p", "no:cacheprovider"],
        capture_output=True,
        text=True,
        cwd=HERE.parents[1],
        check=False,
    )
    counts = dict(re.findall(r"^tests/hostile/(test_hostile_\w+\.py): (\d+)$", done.stdout, re.MULTILINE))
    assert counts.keys() == CLASSES.keys(), "name the class of each module"
    rows = [f"| {counts[name]} | {what} | `{name}` |" for name, what in CLASSES.items()]
    total = f"| **{sum(map(int, counts.values()))}** | **all** | |"
    return "\n".join(("| Attacks | Class | Tests |", "|---|---|---|", *rows, total))


def test_the_page_counts_the_attacks() -> None:
    text = PAGE.read_text(encoding="utf-8")
    found = re.search(r"<!-- attacks -->\n(.*?)\n\n", text, re.S)
    assert found is not None and found[1] == table()
