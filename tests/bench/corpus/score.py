# SPDX-License-Identifier: Apache-2.0
"""What the verdicts of a filled sheet come to.

    python tests/bench/corpus/score.py SHEET.jsonl… [--runs OUT/runs.jsonl] [--facts FACTS.jsonl]

A verdict is ``true`` (the finding is right and the maintainer would change the code for it), ``unwelcome`` (right, but nobody would
change anything, or the same is said elsewhere) or ``false``. Precision is the share that is true of those with a verdict. Prints
Markdown: by group of the sheet, by level and tool, by rule, and what is not true with its reason. With ``--runs`` also findings per 1000 lines of the
repositories on the sheets. ``--facts`` writes the sheets without the code that they show, which may be published.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

VERDICTS = ("true", "unwelcome", "false")
#: What of a row is published: no line of the analysed code.
FACTS = ("group", "repository", "path", "line", "level", "tool", "rule", "message", "verdict", "reason")


def rows_of(text: str) -> list[dict[str, Any]]:
    """The rows of a sheet; ``ValueError`` with the line's number for a verdict that is none, or one without a reason."""
    rows = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        row = json.loads(line)
        if row["verdict"] and row["verdict"] not in VERDICTS:
            raise ValueError(f"line {number}: {row['verdict']!r} is no verdict; one of {', '.join(VERDICTS)}")
        if row["verdict"] and not row["reason"].strip():
            raise ValueError(f"line {number}: a verdict without a reason")
        rows.append(row)
    return rows


def precision(counts: Mapping[str, int]) -> str:
    """The share of ``true`` in per cent; a dash where nothing is judged."""
    judged = sum(counts[verdict] for verdict in VERDICTS)
    return f"{100 * counts['true'] / judged:.0f} %" if judged else "–"


def table(title: str, rows: Iterable[Mapping[str, Any]], key: Callable[[Mapping[str, Any]], str]) -> str:
    """Markdown: verdicts and precision by *key*, most judged first."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for row in rows:
        counts[key(row)][row["verdict"] or "open"] += 1
    lines = [f"| {title} | true | unwelcome | false | not judged | precision |", "|---|---|---|---|---|---|"]
    for name, by in sorted(counts.items(), key=lambda item: (-sum(item[1].values()), item[0])):
        cells = [name, *(by[verdict] for verdict in VERDICTS), by["open"], precision(by)]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines)


def wrong(rows: Sequence[Mapping[str, Any]]) -> str:
    """The rows that are not true, by rule, the rule with most of them first, each with its place and reason."""
    by: dict[str, list[Mapping[str, Any]]] = defaultdict(list)
    for row in rows:
        if row["verdict"] in ("unwelcome", "false"):
            by[f"{row['tool']} {row['rule']}"].append(row)
    lines = []
    for name, found in sorted(by.items(), key=lambda item: (-len(item[1]), item[0])):
        lines.append(f"- {name}, {len(found)}")
        for row in found:
            lines.append(f"  - {row['repository']}:{row['path']}:{row['line']}: {row['verdict']}: {row['reason']}")
    return "\n".join(lines)


def density(runs: Iterable[Mapping[str, Any]], repositories: Iterable[str]) -> str:
    """One line: the findings per 1000 lines that *runs* had in *repositories*."""
    names = {name.replace("/", "+") for name in repositories}
    some = [run for run in runs if run["name"] in names]
    lines = sum(run["lines"] for run in some)
    found = sum(sum(run["findings"].values()) for run in some)
    rate = f"{1000 * found / lines:.2f} per 1000 lines" if lines else "no lines"
    return f"{len(some)} repositories, {found} findings, {lines} lines: {rate}"


def scored(rows: Sequence[Mapping[str, Any]]) -> str:
    """The whole report on *rows*."""
    parts = [
        table("group", rows, lambda row: str(row["group"])),
        table("level, tool", rows, lambda row: f"{row['level']} {row['tool']}"),
        table("rule", rows, lambda row: f"{row['tool']} {row['rule']}"),
        wrong(rows),
    ]
    return "\n\n".join(filter(None, parts))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sheets", nargs="+", type=Path)
    parser.add_argument("--runs", type=Path, help="runs.jsonl of run.py")
    parser.add_argument("--facts", type=Path, help="write the sheets to this file, without code")
    given = parser.parse_args()
    rows: list[dict[str, Any]] = []
    for sheet in given.sheets:
        try:
            rows += rows_of(sheet.read_text("utf-8"))
        except ValueError as error:
            sys.exit(f"{sheet}: {error}")
    print(scored(rows))
    if given.runs:
        runs = [json.loads(line) for line in given.runs.read_text("utf-8").splitlines()]
        print("\n" + density(runs, {row["repository"] for row in rows}))
    if given.facts:
        facts = ({key: row[key] for key in FACTS} for row in rows)
        given.facts.write_text("".join(json.dumps(row, ensure_ascii=False) + "\n" for row in facts), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
