# SPDX-License-Identifier: Apache-2.0
"""Real git histories made of the mutations, and what the real command says of each against each kind of baseline.

All mutations of one tool share a history, each in a directory and with names of its own, so that few runs serve many.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from commandline import commit, haros, write
from mutations import Files, Mutation

Log = dict[str, Any]

TOOLS = ("cpplint", "pylint", "cppcheck", "lizard", "radon", "ruff", "clang-tidy", "catkin_lint")
#: Words that get the number of the case, in names of files too: no line with a finding is like one of another case.
_OWN = re.compile(r"\b(walker|runner|Walker|Runner|start|first|initial|second|goal|steps)\b")


@dataclass(frozen=True)
class History:
    """A repository with the states ``base`` and ``head`` of some mutations, and the findings of ``base`` in two files.

    ``cases`` has the directory of each mutation.
    """

    root: Path
    options: tuple[str, ...]
    cases: dict[str, Mutation]
    base: str
    head: str

    @property
    def log(self) -> Path:
        return self.root.parent / "base.sarif"

    @property
    def compact(self) -> Path:
        return self.root.parent / "base.jsonl"

    def check(self, *arguments: str) -> Log:
        """The JSON report of a run."""
        done = haros("check", *self.options, *arguments, "--fail-on=never", "--output=json", cwd=self.root)
        assert done.returncode == 0, done.stderr
        report: Log = json.loads(done.stdout)
        return report

    def baseline(self, kind: str) -> str:
        """The flag for a baseline of that kind."""
        flags = {"revision": f"--baseline-rev={self.base}", "sarif": f"--baseline={self.log}"}
        return flags.get(kind, f"--baseline={self.compact}")

    def results(self, kind: str, *arguments: str) -> dict[str, list[Log]]:
        """The watched results of each case against a baseline of that kind."""
        found: dict[str, list[Log]] = {case: [] for case in self.cases}
        for result in self.check(self.baseline(kind), *arguments)["results"]:
            case = result["path"].partition("/")[0]
            if case in self.cases and f"{result['tool']}:{result['rule']}" in self.cases[case].rules:
                found[case].append(result)
        return found


def histories(scratch: Path, mutations: Sequence[Mutation]) -> Iterator[History]:
    """One history for each set of tools."""
    for tools in sorted({mutation.tools for mutation in mutations}):
        cases = {f"c{number}": m for number, m in enumerate(mutations) if m.tools == tools}
        yield history(scratch / "-".join(("tools", *tools)), cases, scratch / "cache")


def history(scratch: Path, cases: dict[str, Mutation], cache: Path) -> History:
    """The repository at ``scratch/ws``; the project file and the files of known findings lie outside of it."""
    (tools,) = {mutation.tools for mutation in cases.values()}
    root = scratch / "ws"
    off = ", ".join(f"{tool}: {str(tool in tools).lower()}" for tool in TOOLS)
    project = write(scratch, {"project.yaml": f"linters: {{{off}}}\n"}) / "project.yaml"
    rules = sorted({rule for mutation in cases.values() for rule in mutation.rules})
    options = (f"--project={project}", f"--cache-dir={cache}", *(f"--select={rule}" for rule in rules))
    for case, mutation in cases.items():
        write(root, own(case, mutation.before))
    base = commit(root)
    done = haros("check", *options, "--fail-on=never", f"--output=sarif={scratch / 'base.sarif'}", cwd=root)
    assert done.returncode == 0, done.stderr
    made = haros("baseline", "create", *options, f"--file={scratch / 'base.jsonl'}", cwd=root)
    assert made.returncode == 0, made.stderr
    age(scratch / "base.sarif", cases)
    heads = [change(root, dict(half)) for half in (list(cases.items())[::2], list(cases.items())[1::2])]
    return History(root, options, cases, base, heads[-1])


def change(root: Path, cases: dict[str, Mutation]) -> str:
    """Commit what comes after in some of the cases; the revision."""
    for case, mutation in cases.items():
        for path in own(case, mutation.before):
            (root / path).unlink()
        write(root, own(case, mutation.after))
    return commit(root)


def own(case: str, files: Files) -> Files:
    """The files below the directory of the case, with names of its own."""

    def named(text: str) -> str:
        return _OWN.sub(lambda found: found[0] + case, text)

    return {f"{case}/{named(path)}": named(text) for path, text in files.items()}


def age(path: Path, cases: dict[str, Mutation]) -> None:
    """Let the log of the base be one of another version of the tool, for the mutations that ask for it."""
    log = json.loads(path.read_text(encoding="utf-8"))
    for case, mutation in cases.items():
        if mutation.log:
            mutation.log(part(log, case))
    path.write_text(json.dumps(log), encoding="utf-8")


def part(log: Log, case: str) -> Log:
    """The log with the results of one case alone."""
    runs = [{**run, "results": [r for r in run["results"] if path_of(r).startswith(f"{case}/")]} for run in log["runs"]]
    return {**log, "runs": runs}


def path_of(result: Log) -> str:
    path: str = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    return path


def states(results: Iterable[Log]) -> Counter[str]:
    """How many results are in which state, each as ``state@tool:rule``."""
    found: Counter[str] = Counter()
    for result in results:
        state = "suppressed" if result.get("suppressions") else result["state"]
        found[f"{state}@{result['tool']}:{result['rule']}"] += 1
    return found


def expected(mutation: Mutation, kind: str) -> Counter[str]:
    """The same, as the mutation asks for it. *kind* is "revision", "sarif" or "compact"."""
    words = {"sarif": mutation.sarif, "compact": mutation.compact}.get(kind) or mutation.states
    return Counter(word if "@" in word else f"{word}@{mutation.rules[0]}" for word in words.split())
