# SPDX-License-Identifier: Apache-2.0
"""How well "new issues only" holds on the mutations, beside three other ways; or how long matching takes.

    SARIF_MULTITOOL=.../Sarif.Multitool python tests/bench/mutations.py
    python tests/bench/mutations.py --match 10000

The others: SARIF Multitool's match-results-forward, once on our logs, whose fingerprints it makes good use of, and once
on the same logs as most linters would write them (no fingerprint but GitHub's); the plain difference by rule, path and
primaryLocationLineHash; and a filter that calls new what is on a line that ``git diff -U0`` adds. The last knows
nothing of absent findings and is not judged by them. All judge the same repositories, each with many mutations.
Mutations 26 and 35 to 38 are about logs, histories and flags, and are in the tests alone.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from commandline import git, haros
from histories import History, Log, expected, histories, part, path_of
from mutations import MUTATIONS, Mutation  # haros: ignore[import-self] tests/mutations.py is meant

from haros_ci.model.location import Location
from haros_ci.results.fingerprint import digest
from haros_ci.results.known import ComparedFiles, known_from_results
from haros_ci.results.matching import match
from haros_ci.results.result import Identity, Result
from haros_ci.results.rule import Level

#: (state, line) of each watched result; the state is old, new, absent or suppressed.
Verdicts = list[tuple[str, int]]
_OLD = ("unchanged", "updated")
_COLUMNS = (
    "--baseline-rev",
    "compact file",
    "SARIF file",
    "Multitool, our logs",
    "Multitool, plain logs",
    "line hashes",
    "diff lines",
)


def main() -> None:
    if sys.argv[1:2] == ["--match"]:
        return time_matching(int(sys.argv[2]))
    totals = {column: Counter[str]() for column in _COLUMNS}
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for history in histories(Path(scratch), MUTATIONS):
            for case, columns in verdicts(history).items():
                mutation = history.cases[case]
                cells = []
                for column in _COLUMNS:
                    wrong = judge(columns[column], mutation, knows_absent=column != "diff lines")
                    totals[column].update(wrong, right=not wrong)
                    cells.append(", ".join(f"{n} {what}" for what, n in wrong.items()) or "right")
                rows.append((int(case[1:]), f"| {mutation.number} | {mutation.name} | {' | '.join(cells)} |"))
    print("| # | mutation |", " | ".join(_COLUMNS), "|")
    print("|---|---|" + "---|" * len(_COLUMNS))
    for _, row in sorted(rows):
        print(row)
    for what in ("right", "false new", "false old", "absent missed", "wrong place"):
        of = f" of {len(rows)}" if what == "right" else ""
        print(f"| | **{what}** |", " | ".join(f"{totals[column][what]}{of}" for column in _COLUMNS), "|")


def judge(found: Verdicts, mutation: Mutation, *, knows_absent: bool) -> Counter[str]:
    """What is wrong, by kind; nothing if all is as the mutation asks."""
    want = Counter(collapsed(name.partition("@")[0]) for name in expected(mutation, "revision").elements())
    have = Counter(state for state, _ in found)
    wrong = Counter({"false new": have["new"] - want["new"], "false old": have["old"] - want["old"]})
    if knows_absent and not +wrong:
        wrong["absent missed"] = want["absent"] - have["absent"]
    lines = tuple(line for state, line in found if state == "new")
    if not +wrong and mutation.lines not in (None, lines):
        wrong["wrong place"] = 1
    return +wrong


def collapsed(state: str) -> str:
    return "old" if state in _OLD else state


def verdicts(history: History) -> dict[str, dict[str, Verdicts]]:
    """For each case what each column says of it."""
    log = history.root.parent / "head.sarif"
    done = haros("check", *history.options, "--fail-on=never", f"--output=sarif={log}", cwd=history.root)
    assert done.returncode == 0, done.stderr
    head, base = (json.loads(path.read_text(encoding="utf-8")) for path in (log, history.log))
    kinds = {"--baseline-rev": "revision", "compact file": "compact", "SARIF file": "sarif"}
    ours = {column: history.results(kind) for column, kind in kinds.items()}
    matched = {
        "Multitool, our logs": multitool(head, base, history.root.parent),
        "Multitool, plain logs": multitool(plain(head), plain(base), history.root.parent),
    }
    found: dict[str, dict[str, Verdicts]] = {}
    for case, mutation in history.cases.items():
        now, past = watched(part(head, case), mutation), watched(part(base, case), mutation)
        found[case] = {
            **{column: [(state_of(r), r.get("line") or 0) for r in ours[column][case]] for column in kinds},
            **{name: found_by(watched(part(log, case), mutation)) for name, log in matched.items()},
            "line hashes": by_hash(results_of(now), results_of(past)),
            "diff lines": by_lines(results_of(now), added_lines(history, case)),
        }
    return found


def state_of(result: Log) -> str:
    return "suppressed" if result.get("suppressions") else collapsed(result["state"])


def watched(log: Log, mutation: Mutation) -> Log:
    """The log with the results of watched rules alone."""
    rules = {rule.partition(":")[2] for rule in mutation.rules}
    return {
        **log,
        "runs": [{**run, "results": [r for r in run["results"] if r["ruleId"] in rules]} for run in log["runs"]],
    }


def plain(log: Log) -> Log:
    """The log without what other tools do not write."""
    runs = []
    for run in log["runs"]:
        results = []
        for result in run["results"]:
            kept = {k: v for k, v in result.items() if k not in ("partialFingerprints", "properties")}
            hashes = result.get("partialFingerprints", {})
            if line_hash := hashes.get("primaryLocationLineHash"):
                kept["partialFingerprints"] = {"primaryLocationLineHash": line_hash}
            kept["locations"] = [
                {k: v for k, v in place.items() if k == "physicalLocation"} for place in kept["locations"]
            ]
            results.append(kept)
        runs.append({**run, "results": results})
    return {**log, "runs": runs}


def results_of(log: Log) -> list[Log]:
    return [result for run in log["runs"] for result in run["results"]]


def line_of(result: Log) -> int:
    line: int = result["locations"][0]["physicalLocation"].get("region", {}).get("startLine", 0)
    return line


def multitool(now: Log, past: Log, scratch: Path) -> Log:
    """The log that match-results-forward makes of two."""
    binary = os.environ.get("SARIF_MULTITOOL") or shutil.which("Sarif.Multitool")
    if not binary:
        sys.exit("name SARIF Multitool's binary in SARIF_MULTITOOL")
    paths = [scratch / f"{name}.sarif" for name in ("now", "past", "matched")]
    for path, log in zip(paths, (now, past), strict=False):
        path.write_text(json.dumps(log), encoding="utf-8")
    command = [binary, "match-results-forward", str(paths[0]), "--previous", str(paths[1])]
    command += ["--output-file-path", str(paths[2]), "--log", "ForceOverwrite"]
    environment = {**os.environ, "DOTNET_SYSTEM_GLOBALIZATION_INVARIANT": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    result: Log = json.loads(paths[2].read_text(encoding="utf-8-sig"))
    return result


def found_by(log: Log) -> Verdicts:
    return [
        ("suppressed" if r.get("suppressions") else collapsed(r.get("baselineState", "unchanged")), line_of(r))
        for r in results_of(log)
    ]


def by_hash(now: Iterable[Log], past: Iterable[Log]) -> Verdicts:
    def key(result: Log) -> tuple[str, str, str]:
        return (
            result["ruleId"],
            path_of(result),
            result.get("partialFingerprints", {}).get("primaryLocationLineHash", ""),
        )

    here, there = list(now), [r for r in past if not r.get("suppressions")]
    known = {key(result) for result in there}
    left = known - {key(result) for result in here}
    found = [("old" if key(r) in known else "new", line_of(r), r) for r in here]
    return [
        *(("suppressed" if r.get("suppressions") else state, line) for state, line, r in found),
        *(("absent", line_of(r)) for r in there if key(r) in left),
    ]


def by_lines(now: Iterable[Log], added: set[tuple[str, int]]) -> Verdicts:
    return [
        ("suppressed" if r.get("suppressions") else "new" if (path_of(r), line_of(r)) in added else "old", line_of(r))
        for r in now
    ]


def added_lines(history: History, case: str) -> set[tuple[str, int]]:
    added: set[tuple[str, int]] = set()
    path = ""
    for line in git(history.root, "diff", "-U0", "-M", history.base, history.head, "--", case).split("\n"):
        if line.startswith("+++ b/"):
            path = line[6:].rstrip()
        elif hunk := re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line):
            first = int(hunk[1])
            added.update((path, number) for number in range(first, first + int(hunk[2] or 1)))
    return added


def time_matching(count: int) -> None:
    """CPU seconds of matching *count* results with *count* known findings, in 100 files, the best of five."""
    old = findings(count, 0)
    known = known_from_results(old)
    sides = ComparedFiles(head=lambda path: "", language=lambda path: "cpp", exists=lambda path: True)
    foreign = Identity(scope="z", text="0" * 16, before="1" * 16, after="2" * 16, shape="3" * 16, template="q")
    cases = {
        "all shifted": findings(count, 3),
        "a tenth edited": findings(count, 3, edited=10),
        "nothing in common": [replace(result, identity=foreign) for result in findings(count, 3)],
    }
    compact = tuple(replace(entry, line=None, message="", level=None, value=None) for entry in known)
    print(f"| {count} × {count} | known with lines | known from a compact file |")
    print("|---|---|---|")
    for name, new in cases.items():
        cells = [cpu(lambda new=new, past=past: match(new, past, sides)) for past in (known, compact)]
        print(f"| {name} |", " | ".join(f"{seconds:.2f} s" for seconds in cells), "|")


def cpu(work: Callable[[], object]) -> float:
    taken = []
    for _ in range(5):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return min(taken)


def findings(count: int, shift: int, *, edited: int = 0) -> list[Result]:
    """Findings of 20 rules; a third of the lines is like another's, and one of *edited* has other text."""
    return [
        Result(
            tool="t",
            rule=f"r{i % 20}",
            level=Level.NOTE,
            message="Bad.",
            location=Location(f"f{i % 100}.cpp", i // 100 * 7 + shift + 1),
            identity=Identity(
                scope=f"s{i % 9}",
                text=digest(f"{i if i % 3 else 0}{'x' if edited and i % edited == 0 else ''}"),
                before=digest(f"b{i}"),
                after=digest(f"a{i}"),
                shape=digest(str(i % 5)),
                template="Bad",
            ),
        )
        for i in range(count)
    ]


if __name__ == "__main__":
    main()
