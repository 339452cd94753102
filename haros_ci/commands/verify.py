# SPDX-License-Identifier: Apache-2.0
"""``haros-ci verify``: runs that keep the properties of nodes and violate those of a configuration."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.verified import ToVerify, to_verify
from haros_ci.commands.common import reported, settings_from, store_for
from haros_ci.commands.output import parse_outputs
from haros_ci.commands.verify_shown import shown, traces
from haros_ci.errors import RunFailure, UserError
from haros_ci.model.location import Location
from haros_ci.pipeline import finished, found, own_run, selection_of
from haros_ci.registry import registry
from haros_ci.report.escape import terminal
from haros_ci.report.verify_mermaid import render
from haros_ci.report.verify_text import ShownFinding, ShownStep, Verification, as_json, step_text, text
from haros_ci.results import own
from haros_ci.results.coverage import coverage
from haros_ci.results.result import Notification, Related, Report, Result
from haros_ci.results.rule import Level
from haros_ci.verification.outcomes import Finding
from haros_ci.verification.problem import MILLISECOND, Limits, Network
from haros_ci.verification.running import demand_extra, verified
from haros_ci.writing import append, put_below, write

#: The rules under which answers are reported, and their levels where they are not those of the rules.
RULES = {
    "violated": (own.VIOLATED, None),
    "axioms contradictory": (own.NEVER_EXERCISED, Level.WARNING),
    "vacuous": (own.NEVER_EXERCISED, None),
    "undetermined": (own.UNDECIDED, None),
    "not modelled": (own.UNDECIDED, None),
}
#: Formats that are made of the runs, not of the findings.
OF_RUNS: Mapping[str, Callable[[Verification], str]] = {"text": text, "json": as_json, "mermaid": render}
#: The greatest latency in milliseconds.
LATEST = 1e9


def verify(flags: Mapping[str, Any]) -> int:
    """Extract, search, write every output; exit code 1 for a property that is violated, 2 for wrong usage, else 0."""
    demand_extra()
    network = network_of(flags)
    limits = Limits(flags["depth"], flags["budget"])
    outputs = parse_outputs(flags["output"], {"mermaid": str})
    paths = (flags["path"],) if flags["path"] else ()
    settings = settings_from({**flags, "paths": paths, "no_baseline": True, "profile": "architecture"})
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    workspace = found(settings, selection)
    store = store_for(settings)
    asked = to_verify(
        workspace,
        Architectures(settings, store, known),
        flags["configuration"],
        flags["property"],
        settings.project_file or "",
        network,
        limits,
    )
    if trouble := store.flush():
        click.echo(f"warning: {trouble}", err=True)
    answers = tuple(sorted(progress(asked), key=lambda finding: finding.number))
    verification = shown(asked, answers)
    for note in verification.notes:
        if not any(format == "text" and path is None for format, path in outputs):
            click.echo(f"note: {terminal(note)}", err=True)
    if flags["traces"] is not None:
        put_below(Path(flags["traces"]), traces(asked, answers))
    notifications = tuple(Notification(Level.NOTE, note, path=None) for note in verification.notes)
    run = replace(own_run(workspace, known), results=tuple(results(verification)), notifications=notifications)
    rules = tuple({rule.id: rule for rule, _ in RULES.values()}.values())
    runs = tuple(replace(done, rules=rules) for done in finished((run,), workspace, selection, settings))
    report = Report(runs=runs, coverage=coverage(workspace), fail_on=settings.fail_on)
    others = []
    for format, path in outputs:
        if format in OF_RUNS:
            write(OF_RUNS[format](verification), path)
        else:
            others.append((format, path))
        if format == "github":
            summarise(verification)
    return reported(report, workspace, tuple(others), {}, settings, {**flags, "statistics": False, "why": False})


def network_of(flags: Mapping[str, Any]) -> Network:
    """The network that the flags describe; UserError for what is none."""
    is_async = flags["network"] == "async"
    if not is_async and (flags["latency"] is not None or flags["loss"]):
        raise UserError("--latency and --loss are of an asynchronous network", help="give --network async, too")
    if flags["latency"] is None:
        return Network(is_async, loses=flags["loss"])
    low, separator, high = flags["latency"].rpartition(":")
    try:
        first, last = float(low if separator else 0), float(high)
    except ValueError:
        first, last = -1.0, -1.0
    if not 0 <= first <= last <= LATEST:
        raise UserError(f"--latency {flags['latency']}: is no latency", help="write milliseconds: 20, or 5:20")
    return Network(is_async, round(first * MILLISECOND), round(last * MILLISECOND), flags["loss"])


def progress(asked: ToVerify) -> Iterator[Finding]:
    """The answers as they come; on a terminal the standard error says how many there are."""
    total = len(asked.problem.claims)
    for count, finding in enumerate(verified(asked.problem), 1):
        if sys.stderr.isatty():
            sys.stderr.write(f"\r{count} of {total} properties\x1b[K")
        yield finding
    if sys.stderr.isatty():
        sys.stderr.write("\r\x1b[K")


def summarise(verification: Verification) -> None:
    """The diagrams of counterexamples in the summary of the job, if there is one."""
    page, drawn = os.environ.get("GITHUB_STEP_SUMMARY"), render(verification)
    if not page or verification.is_clean:
        return
    try:
        append(Path(page), f"\n{drawn}")
    except (RunFailure, UserError) as err:
        click.echo(f"warning: the job summary cannot be written: {terminal(err.message)}", err=True)


def results(verification: Verification) -> Iterator[Result]:
    """The answers that are no good ones as findings at the places of the properties; one of the command line has none in the workspace."""
    for one in verification.properties:
        if one.verdict not in RULES:
            continue
        rule, level = RULES[one.verdict]
        message = f"{one.title}: {one.verdict} in {verification.configuration}: {one.sentence}"
        yield Result(
            "haros-ci", rule.id, level or rule.level, message, one.location or Location("."),
            subject=(f"the configuration {verification.configuration}", one.title), flow=tuple(_flow(one)),
            related=tuple(Related(axiom.location, f"axiom: {axiom.title}") for axiom in one.axioms if axiom.location is not None),
        )  # fmt: skip


def _flow(one: ShownFinding) -> Iterator[Related]:
    """The places in the source that publish and receive the messages of a counterexample, in their order."""
    for number, step in enumerate(one.run.steps if one.run is not None else ()):
        again = "repeats from here: " if one.run is not None and one.run.loop == number else ""
        message = f"{again}t = {step.time:+.4f} s: {step_text(step)}{f' ({step.role})' if step.role else ''}"
        for place in step.places:
            yield Related(place, message)
        yield from _receivers(step)


def _receivers(step: ShownStep) -> Iterator[Related]:
    for node, place in step.receivers:
        if place is not None:
            yield Related(place, f"t = {step.time:+.4f} s: {node} receives {step.topic}")
