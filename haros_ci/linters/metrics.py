# SPDX-License-Identifier: Apache-2.0
"""What the two measuring adapters share: thresholds, and from measurements to results of the tool ``metrics``."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, Output, Program
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

TOOL = "metrics"


@dataclass(frozen=True, slots=True)
class Threshold:
    """A rule: crossed when *metric* of a function or file is above *limit* (below it where *below*).

    *phrase* is the message after its subject; ``{value}`` and ``{limit}`` are filled in.
    """

    rule: str
    metric: str
    limit: float
    phrase: str
    below: bool = False

    def crossed(self, value: float) -> bool:
        return value < self.limit if self.below else value > self.limit


_COMPLEXITY = "has a cyclomatic complexity of {value:.0f} (limit {limit:.0f})"
_EFFECTIVE = "has {value:.0f} effective lines of code (limit {limit:.0f})"
_COMMENTS = "has a comment ratio of {value:.1%} (limit {limit:.0%})"
_VOLUME = "has a Halstead volume of {value:.0f} (limit {limit:.0f})"
_BUGS = "has an estimate of {value:.1f} bugs by Halstead (limit {limit:.0f})"
_INDEX = "has a maintainability index of {value:.1f} (limit {limit:.0f})"

#: HAROS's thresholds (its definitions.yaml); the bands of one metric stand together, the mildest first.
FUNCTION_THRESHOLDS = (
    Threshold("max-cyclomatic-complexity-10", "cc", 10, _COMPLEXITY),
    Threshold("max-cyclomatic-complexity-15", "cc", 15, _COMPLEXITY),
    Threshold("max-function-length-40", "nloc", 40, "has {value:.0f} lines of code (limit {limit:.0f})"),
    Threshold("max-eloc-50", "eloc", 50, _EFFECTIVE),
    Threshold("max-eloc-70", "eloc", 70, _EFFECTIVE),
    Threshold("max-function-parameters-6", "parameters", 6, "has {value:.0f} parameters (limit {limit:.0f})"),
)
FILE_THRESHOLDS = (
    Threshold("max-file-length-400", "nloc", 400, "has {value:.0f} lines of code (limit {limit:.0f})"),
    Threshold("min-comment-ratio-20", "comment_ratio", 0.20, _COMMENTS, below=True),
    Threshold("max-comment-ratio-30", "comment_ratio", 0.30, _COMMENTS),
    Threshold("max-comment-ratio-40", "comment_ratio", 0.40, _COMMENTS),
    Threshold("halstead-volume-above-8000", "volume", 8000, _VOLUME),
    Threshold("halstead-bugs-above-2", "bugs", 2, _BUGS),
    Threshold("mi-below-65", "mi", 65, _INDEX, below=True),
    Threshold("mi-below-20", "mi", 20, _INDEX, below=True),
)

_CALLS = "calls {value:.0f} different functions (limit {limit:.0f})"
_NESTING = "nests control structures {value:.0f} deep (limit {limit:.0f})"
_PATHS = "has {value:.0f} static paths (limit {limit:.0f})"
_WEIGHT = "has methods of a complexity of {value:.0f} together (limit {limit:.0f})"

#: HAROS's thresholds on what the syntax and the index of the workspace tell; the metrics are named as in docs/metrics.md.
STRUCTURE_THRESHOLDS = (
    Threshold("max-function-calls-7", "unique-function-calls", 7, _CALLS),
    Threshold("max-function-calls-10", "unique-function-calls", 10, _CALLS),
    Threshold("max-control-nesting-4", "nested-control", 4, _NESTING),
    Threshold("max-control-nesting-5", "nested-control", 5, _NESTING),
    Threshold("max-static-path-80", "static-path-count", 80, _PATHS),
    Threshold("max-static-path-200", "static-path-count", 200, _PATHS),
    Threshold("max-static-path-250", "static-path-count", 250, _PATHS),
)
CLASS_THRESHOLDS = (
    Threshold("max-coupling-objects-5", "coupling", 5, "is coupled to {value:.0f} other classes (limit {limit:.0f})"),
    Threshold("max-immediate-children-10", "number-of-children", 10, "has {value:.0f} children (limit {limit:.0f})"),
    Threshold("max-weighted-methods-50", "weighted-methods", 50, _WEIGHT),
    Threshold("max-weighted-methods-100", "weighted-methods", 100, _WEIGHT),
    Threshold(
        "max-methods-available-20", "methods-available", 20, "has {value:.0f} public methods (limit {limit:.0f})"
    ),
    Threshold(
        "max-deepest-inheritance-5", "depth-in-tree", 5, "is {value:.0f} levels deep in inheritance (limit {limit:.0f})"
    ),
)
#: The rules of both: nothing is measured unless one of them is on.
STRUCTURE_RULES = tuple(threshold.rule for threshold in (*STRUCTURE_THRESHOLDS, *CLASS_THRESHOLDS))

#: A milder rule and the stricter bands of the same metric that make it redundant.
WORSE_BANDS: Mapping[str, frozenset[str]] = {
    "max-cyclomatic-complexity-10": frozenset({"max-cyclomatic-complexity-15"}),
    "max-eloc-50": frozenset({"max-eloc-70"}),
    "max-comment-ratio-30": frozenset({"max-comment-ratio-40"}),
    "mi-below-65": frozenset({"mi-below-20"}),
    "max-function-calls-7": frozenset({"max-function-calls-10"}),
    "max-control-nesting-4": frozenset({"max-control-nesting-5"}),
    "max-static-path-80": frozenset({"max-static-path-200", "max-static-path-250"}),
    "max-static-path-200": frozenset({"max-static-path-250"}),
    "max-weighted-methods-50": frozenset({"max-weighted-methods-100"}),
}


def keep_worst_band(results: Iterable[Result]) -> tuple[Result, ...]:
    """*results* without those of a milder band where the same place also crosses a worse one; call it after selection.

    Results of other tools pass through; the order stays.
    """
    found = tuple(results)
    crossed = {(r.location, r.scope, r.rule) for r in found if r.tool == TOOL}
    return tuple(
        r
        for r in found
        if r.tool != TOOL or not any((r.location, r.scope, w) in crossed for w in WORSE_BANDS.get(r.rule, ()))
    )


def command(program: Program, batch: Batch) -> Command:
    """The worker reads the names of the files from stdin, so that none can be taken for an option."""
    request = {"root": str(batch.workspace.root), "files": [file.path for file in batch.files]}
    return Command(program.argv, stdin=json.dumps(request).encode())


#: What was measured of a file: of each function with its name and place, and of the whole.
Measured = tuple[list[dict[str, Any]], dict[str, Any]]


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """One result per threshold crossed, every band; ValueError if the worker did not answer for every file."""
    for path, answer in answers(output, batch):
        if isinstance(answer, GaveUp):
            yield answer
            continue
        functions, whole = answer
        for function in functions:
            name = function["name"]
            place = Location(path, function["line"], function["column"])
            yield from _crossed(path, place, f"Function '{name}'", name, function, FUNCTION_THRESHOLDS)
        if whole["nloc"]:  # a file without code has no ratio to speak of
            yield from _crossed(path, Location(path, 1), "File", "", whole, FILE_THRESHOLDS)


def answers(output: Output, batch: Batch) -> Iterator[tuple[str, Measured | GaveUp]]:
    """What the worker said of each file; ValueError if it did not answer for every one, or not in full."""
    by_path = {answer["path"]: answer for answer in map(_answer, output.stdout.splitlines())}
    for file in batch.files:
        answer = by_path.get(file.path)
        if answer is None:
            raise ValueError(f"no measurement of {file.path}")
        if "problem" in answer:
            line = answer.get("line")
            yield file.path, GaveUp(file.path, str(answer["problem"]), line if isinstance(line, int) else None)
            continue
        functions, whole = answer.get("functions"), answer.get("file")
        if not isinstance(functions, list) or not isinstance(whole, dict):
            raise ValueError(f"half a measurement of {file.path}")
        yield file.path, (functions, whole)


def _answer(line: bytes) -> dict[str, Any]:
    answer = json.loads(line)
    if not isinstance(answer, dict) or not isinstance(answer.get("path"), str):
        raise ValueError("not a measurement")
    return answer


def _crossed(
    path: str, place: Location, subject: str, scope: str, values: Mapping[str, float], thresholds: Iterable[Threshold]
) -> Iterator[Finding]:
    for result in crossed(place, subject, scope, values, thresholds):
        yield Finding(path, result)


def crossed(
    place: Location, subject: str, scope: str, values: Mapping[str, float], thresholds: Iterable[Threshold]
) -> Iterator[Result]:
    """A result for each of *thresholds* that *values*, by metric, cross; one whose metric has no value is not crossed."""
    for threshold in thresholds:
        value = values.get(threshold.metric)
        if value is not None and threshold.crossed(value):
            message = f"{subject} {threshold.phrase.format(value=value, limit=threshold.limit)}."
            yield Result(
                TOOL, threshold.rule, Level.WARNING, message, place, scope=scope, value=value, limit=threshold.limit
            )


__all__ = [
    "CLASS_THRESHOLDS",
    "FILE_THRESHOLDS",
    "FUNCTION_THRESHOLDS",
    "STRUCTURE_RULES",
    "STRUCTURE_THRESHOLDS",
    "TOOL",
    "WORSE_BANDS",
    "Measured",
    "Threshold",
    "answers",
    "command",
    "crossed",
    "keep_worst_band",
    "parse",
]
