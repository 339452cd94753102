# SPDX-License-Identifier: Apache-2.0
"""What metrics weigh: a change that crosses a limit warns; of code that was there before they are counted, not listed.

A function that has been long for years is no news. With a baseline a change that crosses a limit is a finding; without one nothing is known of
what has changed, so the findings are set aside (SARIF §3.35, kind ``external``) and the summary says how many there
are. A baseline made of such a run knows them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.results.result import BaselineState, Result, Run, Suppression
from haros_ci.results.rule import Level

TOOL = "metrics"

#: A whole sentence, so that a log repeats it as it is.
REASON = "Counted as a metric: it is listed where a change crosses the limit, and under --profile strict."


def count_metrics(runs: Iterable[Run], is_asked_for: Callable[[str, str, str], bool]) -> tuple[Run, ...]:
    """*runs* without a baseline, with open metrics set aside unless the settings ask for their tool, rule and path."""
    mark = Suppression("external", REASON)

    def marked(result: Result) -> Result:
        if result.suppressions or is_asked_for(result.tool, result.rule, result.location.path):
            return result
        return replace(result, suppressions=(mark,))

    return tuple(
        replace(run, results=tuple(marked(result) for result in run.results)) if run.tool.name == TOOL else run
        for run in runs
    )


def raise_exceeded(runs: Iterable[Run], weighs: Callable[[Result], bool]) -> tuple[Run, ...]:
    """*runs* that were compared with a baseline; metrics that are new are warnings if their rule *weighs* so much."""

    def raised(result: Result) -> Result:
        is_new = result.state is BaselineState.NEW and result.level is Level.NOTE
        return replace(result, level=Level.WARNING) if is_new and weighs(result) else result

    return tuple(
        replace(run, results=tuple(raised(result) for result in run.results)) if run.tool.name == TOOL else run
        for run in runs
    )


def is_counted(result: Result) -> bool:
    """Whether *result* is set aside only because it is a metric."""
    return bool(result.suppressions) and all(s.justification == REASON for s in result.suppressions)


def is_set_aside(result: Result) -> bool:
    """Whether a comment, an exception or another tool's log suppresses *result*."""
    return bool(result.suppressions) and not is_counted(result)


def counted(results: Iterable[Result]) -> str:
    """One line on the metrics among *results* that are only counted, the most frequent first; "" if there is none."""
    rules = Counter(result.rule for result in results if is_counted(result))
    if not rules:
        return ""
    listed = ", ".join(f"{rule} ({number:,})" for rule, number in sorted(rules.items(), key=lambda r: (-r[1], r[0])))
    return f"Metrics beyond their limits: {listed}; --profile strict lists them."
