# SPDX-License-Identifier: Apache-2.0
"""Random systems: no counterexample that the monitor does not confirm, and none for what is proved by composition.

    python tests/bench/verify/systems.py [--count 300] [--seed 1] [--depth 4]

Each system has three nodes, two to five random axioms and three random questions; every other one is a chain with links of several scopes, of which
much is proved, and four questions. It is looked at in three networks. What is proved is searched for counterexamples, too.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
from collections import Counter
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[3]), str(Path(__file__).resolve().parents[2])]

from verification.systems import chained, system, wrong


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--depth", type=int, default=4)
    flags = parser.parse_args()
    seen: Counter[str] = Counter()
    count = 0
    for number in range(flags.count):
        draw = random.Random(f"{flags.seed} {number}")
        for sentence in wrong((chained if number % 2 else system)(draw, flags.depth), seen):
            count += 1
            print(f"WRONG: system {number}, {sentence}")
    for name, many in sorted(seen.items()):
        print(f"{name}: {many}")
    print(f"{count} wrong, {sum(os.times()[:2]):.0f} s of the processor")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
