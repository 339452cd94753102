# SPDX-License-Identifier: Apache-2.0
"""Every property of the given project files as a question about nodes that may publish anything: all are decided, and no replay disagrees.

    python tests/bench/verify/corpus.py PROJECT.yaml...

Nothing is taken for granted, so that each property is violated unless it is a tautology, and each counterexample is replayed. A property may take
two minutes.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from pathlib import Path
from typing import Any

sys.path[:0] = [str(Path(__file__).resolve().parents[3])]

import yaml

from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.parser import parse_property
from haros_ci.verification.problem import Claim, Limits, Problem
from haros_ci.verification.search import findings


def texts(data: Any) -> Any:
    """All texts in ``hpl`` lists."""
    if isinstance(data, dict):
        for key, value in data.items():
            if key in ("properties", "assumptions") and isinstance(value, list):
                yield from (text for text in value if isinstance(text, str))
            else:
                yield from texts(value)
    elif isinstance(data, list):
        for value in data:
            yield from texts(value)


def main() -> int:
    seen: Counter[str] = Counter()
    slowest, whole = 0.0, 0.0
    for path in sys.argv[1:]:
        for text in texts(yaml.safe_load(Path(path).read_text())):
            try:
                property = parse_property(text)
            except HplFault:
                seen["no HPL"] += 1
                continue
            if mistakes(property):
                seen["no HPL"] += 1
                continue
            begun = sum(os.times()[:2])
            problem = Problem((), (), (Claim(0, text, property),), limits=Limits(5, 120))
            (finding,) = findings(problem)
            spent = sum(os.times()[:2]) - begun
            slowest, whole = max(slowest, spent), whole + spent
            seen[finding.result.value] += 1
            if finding.result.value not in ("violated", "not modelled"):
                print(f"{finding.result.value} ({finding.reason or finding.depth}): {text}")
    for name, count in sorted(seen.items()):
        print(f"{name}: {count}")
    print(f"{whole:.0f} s of the processor, the slowest {slowest:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
