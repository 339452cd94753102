# SPDX-License-Identifier: Apache-2.0
"""The monitor as a program: its arguments, its loop, its report."""

from __future__ import annotations

import argparse
import json
import sys
import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from haros_ci.monitor_files.parts.monitors import HELD, NEVER_EXERCISED, SECOND, UNDECIDED, VIOLATED, Property
from haros_ci.monitor_files.parts.suite import Monitors, as_json

#: Exit codes: nothing is violated, something is; wrong usage is 2 (argparse).
FINE, FOUND, USAGE, TROUBLE = 0, 1, 2, 3
#: Seconds after which the loop looks again whether it has to end.
PATIENCE = 0.2
#: Seconds after which the state is said again, if there were messages.
HEARTBEAT = 1.0
MOST_NOTES = 20


@dataclass
class System:
    """What is known of the configuration: of *topics* their types ("" if that is not known), the places in the source that publish on them, the
    *actions* of properties by their titles ("*": of all), and in ROS 2 the *qos* of subscriptions that differs from the usual."""

    configuration: str
    node: str
    topics: Mapping[str, str]
    publishers: Mapping[str, Sequence[tuple[str, str, int]]] = field(default_factory=dict)
    actions: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)
    qos: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


def main(
    system: System,
    properties: Sequence[type[Property]],
    run: Callable[[System, Monitors, argparse.Namespace, list[str]], None],
    arguments: Sequence[str] | None = None,
) -> int:
    """Read the arguments, judge, write the report; the exit code. *run* watches the running system until it, or its time, is over."""
    parser = argparse.ArgumentParser(
        description="Hold the properties of this file against the running system, or against lines of JSON."
    )
    parser.add_argument(
        "--jsonl", metavar="FILE", help="a recording instead of the running system: a message in each line"
    )
    parser.add_argument(
        "--report", metavar="FILE", help="write the verdicts as JSON, as haros-ci monitor --output json does"
    )
    parser.add_argument(
        "--duration", metavar="SECONDS", type=float, help="end after this time of the clock of the system"
    )
    parser.add_argument("--stop-at-violation", action="store_true", help="end as soon as a property is violated")
    parser.add_argument(
        "--act", action="store_true", help="do what on_violation of the project file says, instead of naming it"
    )
    options, rest = parser.parse_known_args(arguments)
    if any(word.startswith("-") for word in rest) and "--ros-args" not in rest:
        parser.error(f"unrecognized arguments: {' '.join(rest)}")
    monitors = Monitors(properties)
    try:
        notes = replay(monitors, options.jsonl) if options.jsonl else []
        if not options.jsonl:
            run(system, monitors, options, rest)
    except (OSError, Trouble) as err:
        print(f"error: {err}", file=sys.stderr)
        return TROUBLE
    document = report(system, monitors, options.jsonl or "live", notes)
    if options.report:
        with open(options.report, "w", encoding="utf-8") as file:
            file.write(as_json(document, indent=2) + "\n")
    for line in summary(document["properties"]):
        print(line)
    sys.stdout.flush()
    return FOUND if any(one["verdict"] == VIOLATED for one in document["properties"]) else FINE


class Trouble(Exception):
    """Why the system cannot be watched."""


def replay(monitors: Monitors, path: str) -> list[str]:
    """Give *monitors* the messages of a file of lines of JSON; notes on lines that are none."""
    notes: list[str] = []
    with open(path, encoding="utf-8") as file:
        for row, line in enumerate(file, 1):
            try:
                found = json.loads(line)
                topic, at = found["topic"], round(found["time"] * SECOND)
                message = found.get("msg", found)
            except (ValueError, LookupError, TypeError, AttributeError, OverflowError, RecursionError):
                if line.strip() and len(notes) < MOST_NOTES:
                    notes.append(f"line {row} is no message")
                continue
            topic = str(topic)
            monitors.on_message(topic if topic[:1] in "/~" else f"/{topic}", message, at)
            monitors.last = at
    return notes


def report(system: System, monitors: Monitors, name: str, notes: Iterable[str]) -> dict[str, Any]:
    """The verdicts at the end, in the form of ``haros-ci monitor --output json``."""
    properties = monitors.finish()
    for one in properties:
        for witness in one["witnesses"]:
            places = system.publishers.get(witness["topic"], ())
            witness["publishers"] = [{"node": node, "path": path, "line": line} for node, path, line in places]
    found = [*notes]
    if monitors.clock.jumps:
        found.append(f"times jump back {monitors.clock.jumps} times; no time counts as passed between")
    found += [f"{one['id']}: {one['warning']}" for one in properties if one["warning"]]
    is_empty = monitors.began is None
    recording = {
        "name": name,
        "messages": monitors.number,
        "begin": None if is_empty else (monitors.began or 0) / SECOND,
        "end": None if is_empty else (monitors.clock.last or 0) / SECOND,
        "topics": monitors.counts,
        "notes": found,
    }
    return {
        "recording": recording,
        "configuration": system.configuration or None,
        "clock": "log",
        "properties": properties,
    }


def state(system: System, monitors: Monitors) -> dict[str, Any]:
    """What is known while the system runs: the latched message on the topic of verdicts."""
    properties = []
    for one in monitors.properties:
        found = one.violation
        properties.append(
            {
                "id": one.title,
                "node": one.node or None,
                "verdict": VIOLATED if found else "open",
                "reason": found["reason"] if found else one.unusable or None,
                "time": found["time"] / SECOND if found else None,
                "witnesses": found["witnesses"] if found else [],
            }
        )
    count = sum(one["verdict"] == VIOLATED for one in properties)
    found = {"configuration": system.configuration or None, "messages": monitors.number, "violated": count}
    return {**found, "properties": properties}


def summary(properties: Iterable[Mapping[str, Any]]) -> Iterable[str]:
    """The verdicts for a terminal."""
    counts = dict.fromkeys((HELD, VIOLATED, NEVER_EXERCISED, UNDECIDED), 0)
    for one in properties:
        counts[one["verdict"]] += 1
        node = f" ({one['node']})" if one["node"] else ""
        reason = f": {one['reason']}" if one["reason"] else ""
        yield printable(f"{one['verdict']}: {one['id']}{node}{reason}")
        for witness in one["witnesses"]:
            values = "".join(f", {key} = {value}" for key, value in witness["values"].items())
            yield printable(
                f"    {witness['role']}: message {witness['number']} on {witness['topic']}, {witness['time']:.3f} s{values}"
            )
    yield ", ".join(f"{count} {verdict}" for verdict, count in counts.items())


def printable(text: str) -> str:
    """*text* on one line, without what moves a terminal's cursor."""
    return "".join(sign if sign.isprintable() and sign < "\ud800" else ascii(sign)[1:-1] for sign in text)


class Live:
    """The monitors of a running system: threads give messages to ``receive``, one waits in ``loop``.

    *now* is the time of the clock that counts, in nanoseconds; *violated* is called for each property that is violated, by whoever finds it, *say* from time to time.
    """

    def __init__(
        self,
        monitors: Monitors,
        options: argparse.Namespace,
        now: Callable[[], int],
        violated: Callable[[Property], None],
        say: Callable[[], None],
    ) -> None:
        self.monitors, self.options, self.now, self.violated, self.say = monitors, options, now, violated, say
        #: The state that was said: how many messages there were, and when it was.
        self.said = (-1, 0.0)
        self.condition = threading.Condition()
        self.is_over = False

    def receive(self, topic: str, message: Any, unreadable: str = "") -> None:
        """A message has come, or one that is *unreadable* for that reason."""
        with self.condition:
            if self.is_over:
                return
            if unreadable:
                found = self.monitors.on_unreadable(topic, unreadable, self.now())
            else:
                found = self.monitors.on_message(topic, message, self.now())
            self.condition.notify_all()
        self.tell(found)

    def loop(self, is_shut_down: Callable[[], bool]) -> None:
        """Wait for deadlines until *is_shut_down*, or the duration is over, or a violation ends it."""
        begin = self.now()
        self.monitors.start(begin)
        duration = self.options.duration
        end = None if duration is None else begin + int(duration * SECOND)
        while not is_shut_down():
            self.beat()
            with self.condition:
                now = self.now()
                due = self.monitors.deadline()
                found = self.monitors.on_timer(now) if due is not None and due <= now else []
                if end is not None and now >= end or self.options.stop_at_violation and self.monitors.has_violation:
                    self.is_over = True
                else:
                    times = [at for at in (due, end) if at is not None and at > now]
                    if not found:
                        self.condition.wait(min([PATIENCE, *((at - now) / SECOND for at in times)]))
            self.tell(found)
            if self.is_over:
                break
        with self.condition:
            self.is_over = True
            self.monitors.last = self.now()

    def beat(self) -> None:
        """Say the state, if there were messages since, and not too often."""
        count, when = self.said
        if self.monitors.number != count and time.monotonic() - when >= HEARTBEAT:
            self.said = (self.monitors.number, time.monotonic())
            self.say()

    def tell(self, found: Iterable[Property]) -> None:
        for one in found:
            self.violated(one)
