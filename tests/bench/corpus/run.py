# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check``, as installed, on every checkout in a directory, one after the other.

    python tests/bench/corpus/run.py CHECKOUTS OUT [--only NAME]… [--timeout 300] [--option=--profile=strict]…

The haros-ci measured is the one installed for the Python that runs this. CHECKOUTS holds a directory for each repository. OUT
gets of each NAME its report, ``NAME.json``, what was written to the standard error, ``NAME.err``, and a line in ``runs.jsonl``; a
repository that has one is left out, so that a run may be continued. In the end tables of all rows, of what went wrong, the
slowest, and the rules by the number of their findings are printed; ``--tables`` prints them alone. Seconds are wall time; CPU
seconds are those of the process and of all that it waited for, so they mean the same on a busy machine.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

OURS = "haros-ci"
TROUBLE = re.compile(r"internal error|Traceback \(most recent call last\)", re.IGNORECASE)


def measured(checkout: Path, out: Path, options: list[str], timeout: float) -> dict[str, Any]:
    """One row: the run on *checkout*, its report and its standard error beside each other in *out*."""
    report, errors = out / f"{checkout.name}.json", out / f"{checkout.name}.err"
    report.unlink(missing_ok=True)
    command = [sys.executable, "-I", "-m", "haros_ci", "check", ".", "--no-cache", f"--output=json={report.resolve()}"]
    start = time.monotonic()
    with errors.open("wb") as written:
        child = subprocess.Popen(
            [*command, *options],
            cwd=checkout,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=written,
            start_new_session=True,
        )
        code, cpu = ended(child, start + timeout)
    seconds = time.monotonic() - start
    said = errors.read_text("utf-8", "replace")
    return {"name": checkout.name, "code": code, "seconds": round(seconds, 1), "cpu": round(cpu, 1)} | read(
        report, said
    )


def ended(child: subprocess.Popen[bytes], until: float) -> tuple[int | None, float]:
    """Exit code and CPU seconds of *child*; None if it was still running at *until* and has been ended with its session."""
    late = False
    try:
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                child.returncode = os.waitstatus_to_exitcode(status)
                return (None if late else child.returncode), usage.ru_utime + usage.ru_stime
            if not late and time.monotonic() > until:
                os.killpg(child.pid, signal.SIGKILL)
                late = True
            time.sleep(0.05)
    finally:
        if child.returncode is None:
            os.killpg(child.pid, signal.SIGKILL)


def read(report: Path, said: str) -> dict[str, Any]:
    """What a row has of the *report*, and of what was *said* on the standard error."""
    trouble = [line.strip() for line in said.splitlines() if TROUBLE.search(line)]
    row: dict[str, Any] = {"packages": 0, "files": 0, "lines": 0, "findings": {}, "failed": [], "trouble": trouble}
    try:
        data = json.loads(report.read_bytes())
    except (OSError, ValueError):
        return row | {"report": False}
    counts: Counter[str] = Counter()
    for result in data["results"]:
        if result["open"] and not result.get("copyOf"):
            counts[f"{result['level']} {result['tool']} {result['rule']}"] += 1
    notes = [note for note in data["notifications"] if TROUBLE.search(note["message"])]
    row |= {key: data["coverage"][key] for key in ("packages", "files", "lines")}
    row |= {"report": True, "findings": dict(sorted(counts.items())), "gave up": len(given_up(data))}
    row["failed"] = sorted(run["tool"] for run in data["runs"] if not run["successful"])
    row["trouble"] += [note["message"] for note in notes]
    row["errors"] = sorted({note["message"] for note in data["notifications"] if note["level"] == "error"})
    return row


def given_up(report: Mapping[str, Any]) -> set[tuple[str, str]]:
    """Tool and path of each file that a tool gave up on."""
    return {(note["tool"], note["path"]) for note in report["notifications"] if note.get("tool") and note.get("path")}


def total(row: Mapping[str, Any], level: str = "", ours: bool | None = None) -> int:
    """How many open findings of *level* (any, if empty) a row has, of our own checks, of other tools, or of all (None)."""
    return sum(
        number
        for key, number in row["findings"].items()
        if key.startswith(level) and (ours is None or (key.split(" ")[1] == OURS) == ours)
    )


def tables(rows: list[Mapping[str, Any]]) -> str:
    """Markdown: every run, those with trouble, the five slowest, the rules."""
    parts = ["| repository | exit | s | CPU s | packages | lines | errors, ours | warnings, ours | errors, tools | "]
    parts[0] += "warnings, tools | notes | per 1000 lines | gave up |"
    parts.append("|---" * 13 + "|")
    for row in sorted(rows, key=lambda row: str(row["name"])):
        cells = [row["name"].replace("+", "/"), "timeout" if row["code"] is None else row["code"], row["seconds"]]
        cells += [row["cpu"], row["packages"], row["lines"], total(row, "error", True), total(row, "warning", True)]
        cells += [total(row, "error", False), total(row, "warning", False), total(row, "note")]
        cells += [f"{1000 * total(row) / max(row['lines'], 1):.2f}", row.get("gave up", "")]
        parts.append("| " + " | ".join(map(str, cells)) + " |")
    lines = sum(row["lines"] for row in rows)
    found = sum(map(total, rows))
    parts.append(
        f"\n{len(rows)} repositories, {lines} lines, {found} findings, {1000 * found / max(lines, 1):.2f} per 1000 lines"
    )
    parts.append("\nNot 0 or 1, or with trouble:")
    for row in rows:
        if row["code"] not in (0, 1) or row["trouble"] or not row["report"]:
            said = "; ".join([*row["trouble"], *row.get("errors", ())]) or "no report"
            parts.append(f"- {row['name']}: exit {row['code']}, failed {', '.join(row['failed']) or 'none'}: {said}")
    parts.append("\nSlowest:")
    slow = sorted(rows, key=lambda row: -float(row["seconds"]))[:5]
    parts += [f"- {row['name']}: {row['seconds']} s, {row['cpu']} CPU s, {row['lines']} lines" for row in slow]
    return "\n".join([*parts, "", by_rule(rows, lines)])


def by_rule(rows: Iterable[Mapping[str, Any]], lines: int) -> str:
    """Markdown: the rules, most findings first, each with the number of repositories it fires in."""
    counts: Counter[str] = Counter()
    where: Counter[str] = Counter()
    for row in rows:
        counts.update(row["findings"])
        where.update(row["findings"].keys())
    table = ["| level, tool, rule | findings | repositories | per 1000 lines |", "|---|---|---|---|"]
    for key, number in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        table.append(f"| {key} | {number} | {where[key]} | {1000 * number / max(lines, 1):.3f} |")
    return "\n".join(table)


def rows_of(file: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in file.read_text("utf-8").splitlines()] if file.exists() else []


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkouts", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", action="append", default=[], help="the checkouts of these names")
    parser.add_argument("--timeout", type=float, default=300, help="seconds for each repository")
    parser.add_argument("--option", action="append", default=[], help="for check, as --option=--profile=strict")
    parser.add_argument("--tables", action="store_true", help="run nothing, print the tables of what OUT has")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    file = given.out / "runs.jsonl"
    done = {row["name"] for row in rows_of(file)}
    for checkout in sorted(given.checkouts.iterdir()) if not given.tables else ():
        if checkout.is_dir() and checkout.name not in done and (not given.only or checkout.name in given.only):
            row = measured(checkout.resolve(), given.out, given.option, given.timeout)
            with file.open("a", encoding="utf-8") as kept:
                kept.write(json.dumps(row) + "\n")
            print(
                f"{row['name']}: {row['code']}, {row['seconds']} s, {total(row)} findings", file=sys.stderr, flush=True
            )
    print(tables(rows_of(file)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
