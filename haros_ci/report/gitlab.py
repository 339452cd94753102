# SPDX-License-Identifier: Apache-2.0
"""GitLab's Code Quality report, a subset of Code Climate's format: the open findings as one JSON array.

GitLab shows ``description`` alone, so that it names the rule; it compares the reports of two branches by ``fingerprint``
and shows equal ones once, so that no two are. The format has no place for what is known, suppressed or gone, nor for
trouble with tools; GitLab drops what follows an entry that breaks its schema, so every entry has all of it.
"""

from __future__ import annotations

import json
from typing import Any

from haros_ci.report.escape import terminal
from haros_ci.report.message import plain
from haros_ci.results.result import Report, Result, is_open
from haros_ci.results.rule import Level, Rule
from haros_ci.results.stable_id import stable_ids

#: GitLab's are info, minor, major, critical and blocker. Nothing that a text reader finds is a blocker.
SEVERITIES = {Level.ERROR: "critical", Level.WARNING: "major", Level.NOTE: "info"}
#: Code Climate's categories, by the tag of a rule that tells of one; the first counts.
CATEGORIES = {
    "security": "Security",
    "metrics": "Complexity",
    "duplication": "Duplication",
    "performance": "Performance",
    "portability": "Compatibility",
    "formatting": "Style",
    "whitespace": "Style",
    "convention": "Style",
    "style": "Style",
    "readability": "Clarity",
    "comments": "Clarity",
    "refactor": "Clarity",
}


def render(report: Report) -> str:
    """The array, one finding a line; ASCII, without a byte-order mark, which GitLab would not read."""
    rules = {(run.tool.name, rule.id): rule for run in report.runs for rule in run.rules}
    entries = [
        json.dumps(_entry(result, id, rules.get((result.tool, result.rule))))
        for id, result in stable_ids(report.results)
        if is_open(result)
    ]
    lines = ",\n".join(entries)
    return f"[\n{lines}\n]\n" if entries else "[]\n"


def _entry(result: Result, id: str, rule: Rule | None) -> dict[str, Any]:
    place = result.location
    first = place.line or 1
    name = terminal(result.full_id)
    return {
        "type": "issue",
        "check_name": name,
        "description": f"{name}: {plain(result)}",
        "categories": [_category(rule)],
        "severity": SEVERITIES[result.level],
        "fingerprint": id,
        "location": {"path": terminal(place.path), "lines": {"begin": first, "end": max(first, place.end_line or 0)}},
    }


def _category(rule: Rule | None) -> str:
    tags = rule.tags if rule else ()
    return next((category for tag, category in CATEGORIES.items() if tag in tags), "Bug Risk")
