# SPDX-License-Identifier: Apache-2.0
"""Every launch file of ROS 2 in workspaces, each evaluated by itself with its default arguments: what there is to say of it.

    python tests/bench/launch_all.py CHECKOUT...

Prints a row for each checkout: launch files by dialect, what they start by kind, rows under a condition, unknown parts by
reason, problems, exceptions, the slowest file; then the reasons, with texts in quotes left out, most frequent first.
"""

from __future__ import annotations

import argparse
import re
import time
import traceback
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from haros_ci.analysis.architecture import ros2_launch
from haros_ci.launch.ros2.dialect import is_ros2_file
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.model.launch import LaunchedSystem
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.build import builds
from haros_ci.workspace.discover import discover

_KINDS = ("node", "lifecycle", "container", "component")
_QUOTED = re.compile(r"'[^']*'|`[^`]*`|\"[^\"]*\"|\S*[/$]\S*")


@dataclass
class Counts:
    """What has been counted in one checkout."""

    files: Counter[str] = field(default_factory=Counter)
    started: Counter[str] = field(default_factory=Counter)
    conditional: int = 0
    parameters: int = 0
    unknown: Counter[tuple[str, str]] = field(default_factory=Counter)
    problems: Counter[str] = field(default_factory=Counter)
    exceptions: list[tuple[str, str]] = field(default_factory=list)
    slowest: tuple[float, str] = (0.0, "")

    def add(self, system: LaunchedSystem) -> None:
        for node in system.nodes:
            self.started[node.kind] += 1
            self.conditional += bool(node.conditions)
            self.parameters += len(node.parameters)
            self.unknown.update((u.field, plain(u.reason)) for u in node.unknowns)
            self.unknown.update(
                (f"parameter's {u.field}", plain(u.reason)) for rule in node.parameters for u in rule.unknowns
            )
        self.problems.update(plain(problem.message) for problem in system.problems)


def plain(reason: str) -> str:
    """*reason* without what it says of this place alone."""
    return _QUOTED.sub("…", reason)[:100]


def candidates(workspace: Workspace) -> list[str]:
    """Files that are launch files by their name or directory, those of tests too."""
    is_ros2 = is_ros2_file(workspace)
    found = []
    for file in workspace.files:
        parts = file.path.split("/")
        named = re.search(r"(?:\A|[._])launch\.(?:py|xml|ya?ml)\Z|\.launch\Z", parts[-1])
        if (named or ("launch" in parts[:-1] and parts[-1].endswith((".py", ".xml")))) and is_ros2(file.path):
            found.append(file.path)
    return found


def count(root: Path) -> Counts:
    workspace = discover(root, ())
    reader = ros2_launch(workspace, builds(workspace))
    counts = Counts()
    for path in candidates(workspace):
        start = time.perf_counter()
        try:
            if reader.loader({})(path) is None:
                counts.files["no launch file of ROS 2"] += 1
                continue
            system = launch_system((path,), workspace, reader.loader({}), {}, {}, reader.places)
        except Exception:
            counts.exceptions.append((path, traceback.format_exc()))
            continue
        counts.slowest = max(counts.slowest, (time.perf_counter() - start, path))
        counts.files["Python" if path.endswith(".py") else "YAML" if path.endswith(("yaml", "yml")) else "XML"] += 1
        counts.add(system)
    return counts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", nargs="+", type=Path)
    parser.add_argument("--reasons", type=int, default=8, help="how many reasons of each kind are shown")
    options = parser.parse_args()
    print(
        "| workspace | Python | XML | YAML | " + " | ".join(_KINDS) + " | conditional | parameters | unknown |", end=""
    )
    print(" problems | exceptions | slowest |")
    print("|---" * (4 + len(_KINDS) + 6) + "|")
    details: list[str] = []
    for root in options.root:
        counts = count(root)
        cells = [root.name, *(counts.files[kind] for kind in ("Python", "XML", "YAML"))]
        cells += [counts.started[kind] for kind in _KINDS]
        cells += [counts.conditional, counts.parameters, counts.unknown.total(), counts.problems.total()]
        cells += [len(counts.exceptions), f"{counts.slowest[0]:.2f} s {counts.slowest[1]}"]
        print("| " + " | ".join(map(str, cells)) + " |")
        details.append(f"\n{root.name}: {counts.files['no launch file of ROS 2']} other files")
        details += [f"  unknown {what}: {n} x {why}" for (what, why), n in counts.unknown.most_common(options.reasons)]
        details += [f"  problem: {n} x {why}" for why, n in counts.problems.most_common(options.reasons)]
        details += [f"  exception: {path}\n{text}" for path, text in counts.exceptions]
    print("\n".join(details))


if __name__ == "__main__":
    main()
