# SPDX-License-Identifier: Apache-2.0
"""``haros-ci monitor``: properties held against a recording."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.monitored import Chosen, Monitored, chosen, with_properties
from haros_ci.commands.common import reported, settings_from, store_for
from haros_ci.commands.monitor_export import export, target_of
from haros_ci.commands.monitor_generate import check_flags, write_files
from haros_ci.commands.output import parse_outputs
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.monitoring.clock import Clock
from haros_ci.monitoring.monitor import BEHAVIOUR
from haros_ci.monitoring.verdict import Outcome, Verdict
from haros_ci.monitoring.watch import Watch
from haros_ci.pipeline import finished, found, own_run, selection_of
from haros_ci.recordings.recording import Recording, Unreadable
from haros_ci.registry import Registry, registry
from haros_ci.report import monitor_junit
from haros_ci.report.escape import terminal
from haros_ci.report.monitor_text import Held, Judged, Moment, as_json, text
from haros_ci.results import own
from haros_ci.results.coverage import coverage
from haros_ci.results.result import Notification, Related, Report, Result
from haros_ci.results.rule import Level
from haros_ci.writing import write

#: The rules under which verdicts are reported.
RULES = {"violated": own.VIOLATED, "never exercised": own.NEVER_EXERCISED, "undecided": own.UNDECIDED}
#: Messages between two looks at the clock, and seconds between two lines of progress.
_EVERY, _PAUSE = 20_000, 0.5
SECOND = 1_000_000_000
#: Formats in which the verdict of each property stands; in the others those but "held" are findings.
RENDERED: Mapping[str, Callable[[Held], str]] = {"text": text, "json": as_json, "junit": monitor_junit.render}


def monitor(flags: Mapping[str, Any]) -> int:
    """Read, judge, write every output; exit code 1 for a property that is violated, 2 for wrong usage, else 0."""
    if flags["generate"] is not None:
        check_flags(flags)
        return generated(flags, settings_of(flags))
    if flags["export"] is not None:
        target = target_of(flags)
        return export(picked_by(flags, settings_of(flags))[0], target)
    recording = recording_of(flags)
    outputs = parse_outputs(flags["output"])
    settings = settings_of(flags)
    picked, workspace, known, selection = picked_by(flags, settings)
    if not picked.properties:
        for note in picked.notes:
            click.echo(f"note: {terminal(note)}", err=True)
        raise UserError(
            "there are no properties", help="state them in the project file under hpl, or give --property 'globally: …'"
        )
    held = judged(recording, picked, by_header=flags["clock"] == "header")
    for note in held.notes:
        if not any(format == "text" and path is None for format, path in outputs):
            click.echo(f"note: {terminal(note)}", err=True)
    notifications = tuple(Notification(Level.NOTE, note, path=None) for note in held.notes)
    run = replace(own_run(workspace, known), results=tuple(results(held)), notifications=notifications)
    runs = tuple(
        replace(done, rules=tuple(RULES.values())) for done in finished((run,), workspace, selection, settings)
    )
    report = Report(runs=runs, coverage=coverage(workspace), fail_on=settings.fail_on)
    others = []
    for format, path in outputs:
        if format in RENDERED:
            write(RENDERED[format](held), path)
        else:
            others.append((format, path))
    return reported(report, workspace, tuple(others), {}, settings, {**flags, "statistics": False, "why": False})


def settings_of(flags: Mapping[str, Any]) -> Settings:
    """The settings of the workspace that the flags name."""
    paths = (flags["path"],) if flags["path"] else ()
    return settings_from({**flags, "paths": paths, "no_baseline": True, "profile": "architecture"})


def picked_by(flags: Mapping[str, Any], settings: Settings) -> tuple[Chosen, Workspace, Registry, Selection]:
    """The properties that the flags name, and what they were found in."""
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    workspace = found(settings, selection)
    store = store_for(settings)
    picked = chosen(
        workspace,
        Architectures(settings, store, known),
        flags["configuration"],
        flags["property"],
        settings.project_file or "",
    )
    if trouble := store.flush():
        click.echo(f"warning: {trouble}", err=True)
    return picked, workspace, known, selection


def generated(flags: Mapping[str, Any], settings: Settings) -> int:
    """Write a monitor for the configuration that the flags name, else for each that has properties."""
    if flags["configuration"] is not None or flags["property"]:
        return write_files(flags["generate"], [picked_by(flags, settings)[0]], settings.project)
    known = registry(settings)
    workspace = found(settings, selection_of(settings, known)[0])
    store = store_for(settings)
    architectures = Architectures(settings, store, known)
    where = settings.project_file or ""
    names = with_properties(workspace, architectures, where)
    every = [chosen(workspace, architectures, name, (), where) for name in names]
    if trouble := store.flush():
        click.echo(f"warning: {trouble}", err=True)
    return write_files(flags["generate"], every, settings.project)


def recording_of(flags: Mapping[str, Any]) -> Recording:
    """The one recording that the flags name."""
    if (flags["bag"] is None) == (flags["jsonl"] is None):
        raise UserError("one recording is needed", help="give --bag FILE or --jsonl FILE")
    if flags["jsonl"] is not None:
        from haros_ci.recordings.jsonl import JsonLines

        return JsonLines(Path(flags["jsonl"]))
    from haros_ci.recordings.bag import Bag

    return Bag(Path(flags["bag"]))


def judged(recording: Recording, picked: Chosen, *, by_header: bool) -> Held:
    """What *recording* says of the properties."""
    watch = Watch((item.monitor for item in picked.properties), by_header=by_header)
    feed(watch, recording)
    recording.demand_messages()
    outcomes = watch.finish(recording.last, frozenset(recording.topics))
    notes = (*picked.notes, *recording.notes, *_of_times(watch.clock))
    last = watch.clock.last
    return Held(
        recording.name,
        picked.configuration,
        "header" if by_header else "log",
        recording.count,
        None if watch.began is None or not recording.count else watch.began / SECOND,
        None if last is None or not recording.count else max(last, 0) / SECOND,
        watch.counts,
        tuple(_judged(item, outcome, picked) for item, outcome in zip(picked.properties, outcomes)),
        notes,
    )


def feed(watch: Watch, recording: Recording) -> None:
    """Give *watch* all messages that it needs."""
    for topic, message, at, number in shown(recording, recording.messages(watch.topics)):
        _begin(watch, recording)
        if isinstance(message, Unreadable):
            watch.miss(topic, message.reason, at, number)
        else:
            watch.take(topic, message, at, number)
    _begin(watch, recording)


def _begin(watch: Watch, recording: Recording) -> None:
    """By log time a recording begins with its first message, on whatever topic; stamps are known of the others only."""
    if watch.began is None and watch.stamped is None and recording.first is not None:
        watch.begin(recording.first)


def _of_times(clock: Clock) -> Iterator[str]:
    if clock.jumps:
        how = "once, at" if clock.jumps == 1 else f"{clock.jumps} times, first at"
        yield f"times jump back {how} message {clock.first_jump}; no time counts as passed between"
    if clock.noise:
        yield f"{clock.noise} messages are older than one before them, by less than 1 s; they count as of the same time"


def shown(recording: Recording, messages: Iterator[tuple[str, Any, int, int]]) -> Iterator[tuple[str, Any, int, int]]:
    """The same messages, with progress on the standard error if that is a terminal."""
    if not sys.stderr.isatty():
        yield from messages
        return
    begun = shown_at = time.monotonic()
    for count, message in enumerate(messages):
        if count % _EVERY == 0 and (now := time.monotonic()) - shown_at > _PAUSE:
            shown_at = now
            share = recording.share()
            left = f", {(now - begun) * (1 - share) / share:.0f} s left" if share else ""
            sys.stderr.write(f"\r{recording.count:,} messages{left}\x1b[K")
        yield message
    sys.stderr.write("\r\x1b[K")


def _judged(monitored: Monitored, outcome: Outcome, picked: Chosen) -> Judged:
    moments = tuple(
        Moment(witness.role, witness.topic, witness.number, witness.time, witness.values, tuple((p.node, p.location) for p in picked.publishers.get(witness.topic, ())))
        for witness in outcome.witnesses
    )  # fmt: skip
    note = f"{outcome.faults} times a message had not what a predicate asks for, first on {outcome.faulty_topic}; it is false then"
    return Judged(
        monitored.title,
        monitored.text,
        str(monitored.stated.owner),
        monitored.node,
        monitored.stated.is_axiom,
        monitored.location,
        outcome.verdict.value,
        outcome.reason,
        outcome.time,
        moments,
        (outcome.scopes, outcome.triggers, outcome.behaviours),
        note if outcome.faults else "",
        tuple(_missing(monitored, outcome, picked)),
    )


def _missing(
    monitored: Monitored, outcome: Outcome, picked: Chosen
) -> Iterator[tuple[str, tuple[tuple[str, Location], ...]]]:
    """The topics of the behaviour that did not come, with the places that publish on them."""
    if outcome.verdict is not Verdict.VIOLATED or any(one.role == BEHAVIOUR for one in outcome.witnesses):
        return
    monitor = monitored.monitor
    for topic in dict.fromkeys(map(monitor.name, monitor.property.pattern.behaviour)):
        yield topic, tuple((p.node, p.location) for p in picked.publishers.get(topic, ()))


def results(held: Held) -> Iterator[Result]:
    """The verdicts but "held" as findings at the places of the properties; those of the command line have the recording's."""
    for judgement in held.properties:
        if judgement.verdict == Verdict.HELD.value:
            continue
        rule = RULES[judgement.verdict]
        level = Level.WARNING if judgement.is_axiom and judgement.verdict == Verdict.VIOLATED.value else rule.level
        node = f" of {judgement.node}" if judgement.node else ""
        after = (
            ""
            if judgement.time is None or held.begin is None
            else f", {judgement.time - held.begin:.3f} s after its begin"
        )
        message = f"{judgement.title}{node}: {judgement.verdict} in {held.name}{after}: {judgement.reason}"
        yield Result(
            "haros-ci", rule.id, level, message, judgement.location or Location(held.name),
            subject=tuple(name for name in (judgement.owner, judgement.title, judgement.node) if name), flow=tuple(_flow(judgement, held)),
        )  # fmt: skip


def _flow(judged: Judged, held: Held) -> Iterator[Related]:
    """The places in the source that publish the messages of a violation, in the order of the messages, and what did not come."""
    for moment in judged.moments:
        values = ", ".join(f"{name} = {value}" for name, value in moment.values.items())
        message = f"t = {moment.time - (held.begin or 0):+.3f} s: {moment.role} on {moment.topic}{f' with {values}' if values else ''}"
        may = "may publish" if len(moment.sources) > 1 else "publishes"
        for node, place in moment.sources:
            yield Related(place, f"{message}; {node} {may} it here")
    for topic, sources in judged.missing:
        for node, place in sources:
            after = (judged.time or 0) - (held.begin or 0)
            yield Related(place, f"t = {after:+.3f} s: {topic} did not come; {node} publishes it here")
