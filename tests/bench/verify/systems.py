# SPDX-License-Identifier: Apache-2.0
"""Random systems: no counterexample that the monitor does not confirm, and none for what is proved by composition.

    python tests/bench/verify/systems.py [--count 300] [--seed 1] [--depth 4]

Each system has three nodes, two to five random axioms and three random questions, and is looked at in both networks. What is proved is searched for
counterexamples, too.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3]), str(Path(__file__).resolve().parents[2])]

from monitoring.traces import PATTERNS, SCOPES, drawn

from haros_ci.behaviour.parser import parse_property
from haros_ci.verification import groups
from haros_ci.verification.outcomes import Result
from haros_ci.verification.problem import Claim, Limits, Member, Network, Problem
from haros_ci.verification.search import findings

MS = 1_000_000
MEMBERS = (
    Member("/n1", frozenset(("/a", "/b")), {"/d": 2}),
    Member("/n2", frozenset(("/c",)), {"/a": 1, "/b": 10}),
    Member("/n3", frozenset(("/b",)), {"/c": 0, "/a": 2}),
)
NETWORKS = {
    "instant": Network(),
    "async": Network(True, 0, 3 * MS),
    "async with loss": Network(True, 1 * MS, 4 * MS, True),
}


def system(draw: random.Random, depth: int) -> Problem:
    """Axioms of the whole, which chains are made of, are more frequent than others."""

    def claim(number: int, node: str) -> Claim:
        scope = draw.choice(SCOPES) if draw.random() < 0.4 else "globally"
        return Claim(number, "", parse_property(str(drawn(draw, draw.choice(PATTERNS), scope))), node=node)

    axioms = tuple(claim(n, draw.choice(("/n1", "/n2", "/n3", ""))) for n in range(draw.randrange(2, 6)))
    return Problem(MEMBERS, axioms, tuple(claim(100 + n, "") for n in range(3)), limits=Limits(depth, 20))


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--depth", type=int, default=4)
    flags = parser.parse_args()
    seen: Counter[str] = Counter()
    wrong = 0
    usual = groups.suffices
    for number in range(flags.count):
        made = system(random.Random(f"{flags.seed} {number}"), flags.depth)
        for name, network in NETWORKS.items():
            problem = replace(made, network=network)
            found = {finding.number: finding for finding in findings(problem)}
            proved = tuple(c for c in problem.claims if found[c.number].result is Result.PROVED)
            groups.suffices = lambda *_: False
            for finding in findings(replace(problem, claims=proved)):
                if finding.result is Result.VIOLATED:
                    wrong += 1
                    print(f"PROVED AND VIOLATED: system {number}, {name}, {finding.number}")
            groups.suffices = usual
            for finding in found.values():
                seen[f"{name}: {finding.result.value}"] += 1
                if "disagrees" in finding.reason:
                    wrong += 1
                    print(f"DISAGREES: system {number}, {name}, {finding.number}: {finding.reason}")
    for name, count in sorted(seen.items()):
        print(f"{name}: {count}")
    print(f"{wrong} wrong, {sum(os.times()[:2]):.0f} s of the processor")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
