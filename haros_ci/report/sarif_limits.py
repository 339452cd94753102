# SPDX-License-Identifier: Apache-2.0
"""What GitHub's code scanning accepts in one log, and a spoken cut to it («SARIF results exceed one or more limits»)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from haros_ci.records import dataclass
from haros_ci.results.result import BaselineState, Notification, Related, Result, Run, is_open
from haros_ci.results.rule import Level, Rule

Cut = tuple[tuple[Run, ...], tuple[Notification, ...]]


@dataclass(frozen=True, slots=True)
class Limits:
    """Hard limits; *bytes* is the gzip-compressed size of the log."""

    runs: int = 20
    results: int = 25_000
    rules: int = 25_000
    locations: int = 1_000
    steps: int = 10_000
    tags: int = 20
    bytes: int = 10_000_000


GITHUB = Limits()


def for_github(runs: Iterable[Run]) -> tuple[Run, ...]:
    """Without suppressed and absent results, which code scanning would show as open alerts; known ones stay."""
    return tuple(
        replace(
            run, results=tuple(r for r in run.results if not r.suppressions and r.state is not BaselineState.ABSENT)
        )
        for run in runs
    )


def fit(runs: tuple[Run, ...], limits: Limits) -> Cut:
    """*runs* within the limits on counts, each cut noted in its run; and those notes."""
    kept: list[Run] = []
    notes: list[Notification] = []
    for run in runs[: limits.runs]:
        run, messages = _fit_run(run, limits)
        kept.append(run)
        notes.extend(messages)
    if runs[limits.runs :] and kept:
        names = ", ".join(run.tool.name for run in runs[limits.runs :])
        note = _note(None, f"Only {limits.runs} runs fit in one log; left out: {names}.")
        kept[0] = replace(kept[0], notifications=(*kept[0].notifications, note))
        notes.append(note)
    return tuple(kept), tuple(notes)


def without_graphs(runs: tuple[Run, ...]) -> Cut:
    """The runs without the graphs that results traverse, which are the first to go where a log would be too big."""
    note = _note(None, "The graphs of nodes and topics are not in this log, which would be too big for GitHub.")
    kept = [replace(run, graphs=()) for run in runs]
    kept[0] = replace(kept[0], notifications=(*kept[0].notifications, note))
    return tuple(kept), (note,)


def shed(runs: tuple[Run, ...], keep: int) -> Cut:
    """Only the *keep* highest-ranked results of all runs, because the compressed log would be too big."""
    total = sum(len(run.results) for run in runs)
    ranked = sorted(((_rank(r), i) for i, run in enumerate(runs) for r in run.results), key=lambda pair: pair)
    share = [0] * len(runs)
    for _, i in ranked[:keep]:
        share[i] += 1
    note = _note(
        None, f"Only the {keep} most severe of {total} results are in this log, which would be too big for GitHub."
    )
    kept = [replace(run, results=_highest(run.results, share[i])) for i, run in enumerate(runs)]
    kept[0] = replace(kept[0], notifications=(*kept[0].notifications, note))
    return tuple(kept), (note,)


def _fit_run(run: Run, limits: Limits) -> tuple[Run, tuple[Notification, ...]]:
    messages: list[str] = []
    results, rules = run.results, run.rules
    if len(results) > limits.results:
        messages.append(f"Only the {limits.results} most severe of {len(results)} results are in this log.")
        results = _highest(results, limits.results)
    if len(rules) > limits.rules:
        used = {r.rule for r in results}
        messages.append(f"Only {limits.rules} of {len(rules)} rules are described in this log.")
        rules = tuple(sorted(rules, key=lambda rule: (rule.id not in used, rule.id)))[: limits.rules]
    if crowded := sum(len(r.related) >= limits.locations for r in results):
        messages.append(f"Related locations past the first {limits.locations - 1} are left out of {crowded} results.")
        results = tuple(replace(r, related=r.related[: limits.locations - 1]) for r in results)
    if winding := sum(len(r.flow) > limits.steps for r in results):
        messages.append(
            f"Steps of the flow past the first {limits.steps - 1} and the last are left out of {winding} results."
        )
        results = tuple(replace(r, flow=_with_ends(r.flow, limits.steps)) for r in results)
    if tagged := sum(len(rule.tags) + len(rule.cwe) > limits.tags for rule in rules):
        messages.append(f"Tags past the first {limits.tags} are left out of {tagged} rules.")
        rules = tuple(_with_tags(rule, limits.tags) for rule in rules)
    notes = tuple(_note(run.tool.name, message) for message in messages)
    return replace(run, results=results, rules=rules, notifications=(*run.notifications, *notes)), notes


def _with_tags(rule: Rule, limit: int) -> Rule:
    cwe = rule.cwe[: limit // 2]
    return replace(rule, cwe=cwe, tags=rule.tags[: limit - len(cwe)])


def _with_ends(flow: tuple[Related, ...], limit: int) -> tuple[Related, ...]:
    return flow if len(flow) <= limit else (*flow[: limit - 1], flow[-1])


def _rank(result: Result) -> tuple[object, ...]:
    """New before known, worse before better, then output order."""
    return (not is_open(result), result.level.rank, result.sort_key)


def _highest(results: tuple[Result, ...], keep: int) -> tuple[Result, ...]:
    return tuple(sorted(sorted(results, key=_rank)[:keep], key=lambda r: r.sort_key))


def _note(tool: str | None, message: str) -> Notification:
    return Notification(Level.WARNING, message, tool=tool)
