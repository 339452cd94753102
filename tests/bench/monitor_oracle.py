# SPDX-License-Identifier: Apache-2.0
"""Holds our monitors against those that hpl-rv-gen 0.2 generates: the same violations on random recordings of all scopes and patterns.

    python -m venv ORACLE && ORACLE/bin/pip install 'hpl-rv-gen==0.2.0'
    python tests/bench/monitor_oracle.py --oracle ORACLE/bin/python [--count 10000] [--each 6] [--seed 1]

hpl-rv-gen wants hpl-specs below 1.0, so it runs in an environment of its own: this script, under its Python, answers one line of JSON for each
line that it is given. *count* recordings are drawn, *each* of them for one property. Its monitors do not say "undecided" or "never exercised": a
property is violated or it is not. Two differences are allowed, those of docs/hpl.md: ``causes`` where one message is trigger and answer, and
``requires`` one of several events of which only some ask for values of the behaviour. Those recordings are held to the sentences of
tests/monitoring/traces.py instead. hpl-rv-gen is given seconds for our milliseconds: it subtracts
times as floating point numbers, so that 42 ms - 37 ms would be less than 5 ms.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
from collections import Counter, deque, namedtuple
from pathlib import Path
from threading import Lock
from typing import Any

Message = namedtuple("Message", ("data",))


def answer() -> None:
    """Answers as the monitors of hpl-rv-gen do; runs in its environment."""
    from hpl.parser import property_parser  # type: ignore[import-not-found]
    from hplrv.rendering import TemplateRenderer  # type: ignore[import-not-found]

    parse, renderer = property_parser(), TemplateRenderer()
    for line in sys.stdin:
        asked = json.loads(line)
        code = renderer.render_monitor(parse.parse(asked["property"]), class_name="Told")
        names: dict[str, Any] = {
            "deque": deque,
            "Lock": Lock,
            "MsgRecord": namedtuple("MsgRecord", "topic timestamp msg"),
        }
        exec(code, names)
        print(json.dumps([_violated(names["Told"](), trace) for trace in asked["traces"]]), flush=True)


def _violated(monitor: Any, trace: list[tuple[str, int, int]]) -> bool:
    monitor.on_launch(0.0)
    for topic, data, time in trace:
        if topic in monitor.cb_map:
            monitor.cb_map[topic](Message(data), float(time))
    monitor.on_timer(float(trace[-1][2] if trace else 0))
    return monitor.verdict is False


def differs(property: Any) -> str:
    """Which of the documented differences *property* can have, "" if none."""
    triggers = {each.topic for each in property.trigger}
    if property.pattern == "causes" and any(each.topic in triggers for each in property.behaviour):
        return "a message is trigger and answer"
    aliases = {each.alias for each in property.behaviour if each.alias}
    if (
        property.pattern == "requires"
        and len({each.of in aliases and bool(each.sign) for each in property.trigger}) > 1
    ):
        return "some of several events ask for the behaviour"
    return ""


def main() -> int:
    here = Path(__file__).resolve()
    sys.path[:0] = [str(here.parents[2]), str(here.parents[1])]
    from monitoring.test_monitor import outcome
    from monitoring.traces import PATTERNS, SCOPES, drawn, traced, verdict

    parser = argparse.ArgumentParser()
    parser.add_argument("--oracle", required=True, help="the Python that has hpl-rv-gen")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--each", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    seen: Counter[str] = Counter()
    with subprocess.Popen(
        [arguments.oracle, __file__, "--answer"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as oracle:
        assert oracle.stdin is not None and oracle.stdout is not None
        for number in range(arguments.count // arguments.each):
            scope = SCOPES[number % 4]
            property = drawn(draw, PATTERNS[number // 4 % 5], scope)
            traces = [traced(draw, 20) for _ in range(arguments.each)]
            print(
                json.dumps({"property": str(property).replace(" ms", " s"), "traces": traces}),
                file=oracle.stdin,
                flush=True,
            )
            for trace, theirs in zip(traces, json.loads(oracle.stdout.readline())):
                ours = outcome(str(property), trace)
                seen["recordings"] += 1
                seen[ours.verdict.value] += 1
                seen[f"{property.pattern}, {scope}"] += 1
                if (ours.verdict.value == "violated") == theirs:
                    continue
                if (why := differs(property)) and ours.verdict.value == verdict(property, trace)[0]:
                    seen[f"differs, as documented: {why}"] += 1
                else:
                    seen["DIFFERS"] += 1
                    print(f"DIFFERS {property}\n  {trace}\n  ours: {ours.verdict.value}, hpl-rv-gen: {theirs}")
        oracle.stdin.close()
    for name, count in sorted(seen.items()):
        print(f"{name}: {count}")
    return 1 if seen["DIFFERS"] else 0


if __name__ == "__main__":
    if "--answer" in sys.argv:
        answer()
    else:
        sys.exit(main())
