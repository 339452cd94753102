# SPDX-License-Identifier: Apache-2.0
"""Holds the formulas of haros-ci verify against the monitor: the same violations in random runs, with and without loops, of all scopes and patterns.

    python tests/bench/verify/agreement.py [--count 30000] [--each 6] [--seed 1] [--defect]

*count* pairs of a property and a run are compared, *each* runs for one property: the run is fixed, and the solver is asked for both answers, of
which one must be possible and the other not. --defect makes windows closed in the formulas: there must be differences, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3]), str(Path(__file__).resolve().parents[2])]

from verification.agreement import disagreements

#: Properties whose cases are drawn with one seed.
TOGETHER = 100


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=30_000)
    parser.add_argument("--each", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--defect", action="store_true")
    flags = parser.parse_args()
    if flags.defect:
        from haros_ci.verification.patterns import Formula

        Formula.near = lambda self, since, time: True if self.window is None else time - since <= self.window  # type: ignore[method-assign]  # the defect
    seen: Counter[str] = Counter()
    differences = 0
    for number in range(-(-flags.count // (flags.each * TOGETHER))):
        found, more = disagreements(f"{flags.seed} {number}", TOGETHER, flags.each)
        seen += more
        differences += len(found)
        for case, expected, answer in found[:3]:
            print(f"DIFFERS {case}\n  monitor: {expected}, formulas: {answer}")
        if flags.defect and differences:
            break
    for name, count in sorted(seen.items()):
        print(f"{name}: {count:,}")
    spent = sum(os.times()[:2])
    print(f"{seen.total():,} comparisons, {differences} disagreements, {spent:.0f} s of the processor")
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
