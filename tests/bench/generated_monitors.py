# SPDX-License-Identifier: Apache-2.0
"""Generated monitors held against the offline monitor on many random properties and recordings, and how fast their core is.

    python tests/bench/generated_monitors.py agree [--count 10000] [--seed 1]
    python tests/bench/generated_monitors.py public PROJECT.yaml …
    python tests/bench/generated_monitors.py speed [--count 200000]

``agree`` draws as tests/monitor_files/core_kit.py does: all scopes and patterns in turn, aliases, disjunctions, bounds, every second time with predicates
about nested fields, arrays and functions; verdicts, times, witnesses, counts and faults are compared, and two cores of three are woken at their deadlines.
Then it does the same with a defect (windows that are closed), and fails if that is not seen. ``public`` takes the properties of project files, and ten random recordings for each. ``speed`` counts messages per second of processor time, for the
same properties as tests/bench/monitor_speed.py.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

sys.path[:0] = [str(Path(__file__).resolve().parents[2]), str(Path(__file__).resolve().parents[1])]

from monitor_files.core_kit import core, disagreements, generated, offline, run
from monitoring.traces import PATTERNS, SCOPES

from haros_ci.behaviour.declared import in_project
from haros_ci.behaviour.meaning import mistakes
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import core_text
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.predicates import key_of


def agree(count: int, seed: int) -> int:
    """Prints how many were compared; exit code 1 for a disagreement, or if the defect is not seen."""
    seen: Counter[str] = Counter()
    found = list(
        disagreements(
            count, seed, on_pair=lambda said: seen.update((said[0], "with faults" if said[4] else "without faults"))
        )
    )
    for text, messages, ours, theirs in found[:5]:
        print(f"DIFFERS {text}\n  {messages}\n  generated: {ours}\n  offline: {theirs}")
    counts = ", ".join(f"{name}: {number:,}" for name, number in sorted(seen.items()))
    print(
        f"{count:,} recordings, {len(SCOPES)} scopes, {len(PATTERNS)} patterns, seed {seed}: {len(found)} disagreements ({counts})"
    )

    def defective(*texts: str) -> dict[str, Any]:
        return run(core_source(*texts).replace("time - since < self.window", "time - since <= self.window"))

    is_seen = next(disagreements(count, seed, defective), None) is not None
    print(f"with closed windows: {'a disagreement, as it must be' if is_seen else 'NO DISAGREEMENT'}")
    return 1 if found or not is_seen else 0


def public(paths: list[str]) -> int:
    """Prints a line for each project file; exit code 1 for a disagreement."""
    draw = random.Random(1)
    total = 0
    for path in paths:
        stated = in_project(Path(path).read_text(encoding="utf-8"), path, lambda name: None)
        sound = [one for one in stated if one.parsed is not None and not mistakes(one.parsed)]
        different = left_out = 0
        for one in sound:
            monitor = monitor_of(one.parsed)
            made, out = core_text([Described(monitor, one.identity, one.identity)])
            left_out += len(out)
            if out:
                continue
            asked: dict[str, set[str]] = {}
            for event in one.parsed.events:
                keys = asked.setdefault(event.topic, set())
                keys.update(filter(None, (key_of(part) for parts in monitor.asked_of(event) for part in parts)))
            names = run(made)
            for _ in range(10):
                messages = recorded(draw, asked)
                different += generated(names, messages) != offline([one.source.text], messages)
        total += different
        print(
            f"{path}: {len(sound)} properties, {left_out} left out, {different} disagreements on {10 * len(sound)} recordings"
        )
    return 1 if total else 0


def recorded(draw: random.Random, asked: dict[str, set[str]]) -> list[tuple[str, dict[str, Any], int]]:
    """Thirty messages on the topics, with the fields that are asked for; one in ten is an array."""
    found = []
    for number in range(30):
        topic = draw.choice(sorted(asked))
        sent: dict[str, Any] = {}
        for key in sorted(asked[topic]):
            *outer, last = key.partition("[")[0].split(".")
            inner = sent
            for name in outer:
                inner = inner.setdefault(name, {}) if isinstance(inner.get(name, {}), dict) else {}
            value = draw.choice((0, 1, -1.0, 5, 32, 100, True, False))
            inner[last] = [value, value] if draw.random() < 0.1 else value
        found.append((topic, sent, 10 * number + draw.choice((0, 5, 9))))
    return found


def core_source(*texts: str) -> str:
    from monitor_files.test_core import text_of

    return text_of(*texts)


def speed(count: int) -> None:
    """Prints a line for one property without trigger, one with, and for fifty."""
    from monitor_speed import PATTERNS as TEXTS
    from monitor_speed import TOPICS

    def text(number: int) -> str:
        return TEXTS[number % len(TEXTS)].format(n=number % TOPICS, m=(number + 1) % TOPICS)

    for texts, topics in (([text(0)], 1), ([text(1)], 2), ([text(number) for number in range(50)], TOPICS)):
        made = core(*texts)
        monitors = made["Monitors"](made["PROPERTIES"])
        monitors.start(0)
        first = 1 if topics == 2 else 0
        messages = [(f"/t{first + number % topics}", {"data": number}) for number in range(count)]
        start = time.process_time()
        for number, (topic, message) in enumerate(messages, 1):
            monitors.on_message(topic, message, number * 1_000_000)
        used = time.process_time() - start
        verdicts = Counter(one["verdict"] for one in monitors.finish(count * 1_000_000))
        counts = ", ".join(f"{number} {name}" for name, number in sorted(verdicts.items()))
        print(f"{len(texts)} properties on {topics} topics: {count / used:,.0f} messages per second ({counts})")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["agree", "public", "speed"])
    parser.add_argument("paths", nargs="*")
    parser.add_argument("--count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    if given.what == "agree":
        return agree(given.count or 10_000, given.seed)
    if given.what == "public":
        return public(given.paths)
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    speed(given.count or 200_000)
    return 0


if __name__ == "__main__":
    sys.exit(main())
