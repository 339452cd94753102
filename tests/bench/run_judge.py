# SPDX-License-Identifier: Apache-2.0
"""Whether the model of a generated program is what the program made when it ran: for every language the same."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from haros_ci.model.architecture import Architecture

KINDS = ("publishers", "subscribers")
#: Kinds of problems that are mistakes of the model.
WRONG = ("missing", "ruled out", "phantom")


@dataclass
class Run:
    """What one run of a program made, by kind, name and type, each with its queue size; *error* if it did not come to its end."""

    made: list[tuple[str, str, str, int | None]]
    error: str = "it does not spin"


@dataclass
class Report:
    """Counts over generated programs; a disagreement is printed when it is found, what no run makes only if *show*."""

    show: bool
    total: Counter[str] = field(default_factory=Counter)
    bad: int = 0

    def add(self, number: int, runs: Sequence[Run], problems: list[str], counts: Counter[str]) -> None:
        """Take in the program generated from *number*, and where its model disagrees with its runs."""
        self.total.update({"programs": 1, "programs that end": int(any(not one.error for one in runs))})
        self.total.update(counts)
        for problem in problems:
            kind = problem.partition(":")[0]
            self.total[kind] += 1
            if kind in WRONG or (self.show and kind == "never") or "nodes" in kind:
                self.bad += kind != "never"
                print(f"{number}: {problem}", flush=True)

    def end(self) -> int:
        """Print the counts; the exit code, 1 where a program and its model disagree."""
        for key, value in self.total.items():
            print(f"{key}: {value}")
        return 1 if self.bad else 0


def full(name: str) -> str:
    """A name as the node ``/n`` has it (rospy/names.py, canonicalize_name)."""
    return "/" + re.sub(r"/+", "/", name).strip("/")


def admits(pattern: str, name: str) -> bool:
    parts = (
        "(?:.*/)?" if part == "?/" else ".*" if part == "?" else re.escape(part)
        for part in re.findall(r"(?<=/)\?/|.", pattern, re.DOTALL)
    )
    return re.fullmatch("".join(parts), name, re.DOTALL) is not None


def compare(found: Architecture, runs: Sequence[Run], interface: str = "std_msgs/{}") -> tuple[list[str], Counter[str]]:
    """Where a model disagrees with the runs of its program, whose types are called like *interface*, and counts."""
    counts: Counter[str] = Counter()
    nodes = [node for configuration in found.configurations for node in configuration.nodes]
    if not nodes and not any(one.made for one in runs):  # a program that makes nothing is left out
        return [], counts
    if len(nodes) != 1:
        return [f"{len(nodes)} nodes"], counts
    (node,) = nodes
    ends = [end for end in node.endpoints if end.kind in KINDS and not end.implicit]
    is_open = any(unknown.field == "endpoints" for unknown in node.unknowns)
    problems: list[str] = []
    whole = [one for one in runs if not one.error]
    made = {(kind, full(name), type_) for one in runs for kind, name, type_, _ in one.made}
    for kind, name, type_ in sorted(made):
        if re.search(r"[^\w/]", name) or not name[1:]:
            counts["names that are none"] += 1
            continue
        alike = [e for e in ends if e.kind == kind and admits(e.name, name)]
        fits = [e for e in alike if e.type in (None, interface.format(type_))]
        counts["made"] += 1
        if any("?" not in e.name for e in fits):
            counts["made, name known"] += 1
        # An end of unknown name that is ruled out may be another one than this, which a gap of the node may be.
        if not fits or (is_open and all(e.is_ruled_out and "?" in e.name for e in fits)):
            problems.append(
                f"missing: {kind} {name} {type_}" if not is_open else f"missing, said: {kind} {name} {type_}"
            )
        elif all(e.is_ruled_out for e in fits):
            problems.append(f"ruled out: {kind} {name} {type_}")
    for end in ends:
        if end.is_ruled_out or "?" in end.name or end.type is None:
            continue
        counts["known"] += 1
        times = [
            any((k, full(n), interface.format(t)) == (end.kind, end.name, end.type) for k, n, t, _ in one.made)
            for one in whole
        ]
        is_conditional = end.conditions or end.early_ways or any(one.field == "conditions" for one in end.unknowns)
        if whole and not is_conditional and not all(times):
            problems.append(f"phantom: {end.kind} {end.name} {end.type} line {end.location and end.location.line}")
        elif whole and not any(times):
            counts["never"] += 1
            problems.append(
                f"never: {end.kind} {end.name} {end.type} line {end.location and end.location.line} {[c.condition for c in end.conditions]}"
            )
    return problems, counts
