# SPDX-License-Identifier: Apache-2.0
"""Every value that lizard and radon measure, not only those across a threshold: adapters for ``haros-ci metrics``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.linters import lizard, metrics, radon
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, Linter, LintOptions, Output, Program, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

TOOL = "values"
#: What the names of these adapters have behind those of the tools.
SUFFIX = " values"
#: HAROS's names of what the workers call otherwise.
FUNCTION_METRICS = {
    "cyclomatic-complexity": "cc",
    "ploc": "nloc",
    "eloc": "eloc",
    "function-parameters": "parameters",
}
FILE_METRICS = {
    "cyclomatic-complexity": "cc",
    "ploc": "nloc",
    "sloc": "sloc",
    "lloc": "lloc",
    "eloc": "eloc",
    "comments": "comments",
    "comment-ratio": "comment_ratio",
    "halstead-volume": "volume",
    "halstead-bugs": "bugs",
    "halstead-time": "time",
    "maintainability-index": "mi",
}


class ValuesLinter:
    """An adapter beside *of*: the same process, and of its answer a result for each value, its rule the metric."""

    def __init__(self, of: Linter) -> None:
        self.of = of
        self.NAME = f"{of.NAME}{SUFFIX}"
        self.LANGUAGES = of.LANGUAGES
        self.WHEN = When.ALWAYS
        self.COST = of.COST

    def locate(self, options: LintOptions) -> Program | None:
        return self.of.locate(options)

    def fingerprint(self, workspace: Workspace, options: LintOptions) -> str:
        return f"{self.of.fingerprint(workspace, options)} values"

    def dependencies(self, workspace: Workspace, file: SourceFile) -> Iterable[str]:
        return ()

    def command(self, program: Program, batch: Batch) -> Command:
        return metrics.command(program, batch)

    def parse(self, output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
        """One result per value; its scope is the function."""
        for path, answer in metrics.answers(output, batch):
            if isinstance(answer, GaveUp):
                yield answer
                continue
            functions, whole = answer
            for function in functions:
                place = Location(path, function["line"], function["column"])
                for metric, key in FUNCTION_METRICS.items():
                    yield _value(metric, place, function[key], function["name"])
            for metric, key in FILE_METRICS.items():
                yield _value(metric, Location(path), whole[key])


def _value(metric: str, place: Location, value: float, scope: str = "") -> Finding:
    return Finding(place.path, Result(TOOL, metric, Level.NOTE, "", place, scope=scope, value=value))


ADAPTERS: tuple[ValuesLinter, ...] = (ValuesLinter(lizard), ValuesLinter(radon))
