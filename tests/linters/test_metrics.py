# SPDX-License-Identifier: Apache-2.0
"""Thresholds: at the limit nothing is said, just beyond it is; and what the adapters make of the worker's answers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from haros_ci.linters import lizard, metrics, radon
from haros_ci.linters.linter import Batch, Finding, GaveUp, LintOptions, Output, Program
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

QUIET_FUNCTION = {"name": "ns::f", "line": 7, "column": 3, "cc": 1, "nloc": 1, "eloc": 1, "parameters": 0}
QUIET_FILE = {"nloc": 10, "comment_ratio": 0.25, "volume": 100.0, "bugs": 0.1, "mi": 80.0}


class Nothing:
    def text(self, path: str) -> str:
        return ""


def batch(*paths: str) -> Batch:
    files = tuple(SourceFile(path, "cpp", 1, "0" * 64) for path in paths)
    return Batch(Workspace(Path("/nowhere"), (), files, Nothing()), files, LintOptions(), Path("/nowhere"))


def parsed(answer: dict[str, Any]) -> list[Finding | GaveUp]:
    output = Output(json.dumps({"path": "a.cpp", **answer}).encode() + b"\n", b"", 0)
    return list(lizard.parse(output, batch("a.cpp")))


def results(function: dict[str, Any] | None = None, file: dict[str, Any] | None = None) -> list[Result]:
    functions = [{**QUIET_FUNCTION, **function}] if function else []
    found = parsed({"functions": functions, "file": {**QUIET_FILE, **(file or {})}})
    return [f.result for f in found if isinstance(f, Finding)]


@pytest.mark.parametrize(
    ("metric", "limit", "rule"),
    [
        ("cc", 10, "max-cyclomatic-complexity-10"),
        ("cc", 15, "max-cyclomatic-complexity-15"),
        ("nloc", 40, "max-function-length-40"),
        ("eloc", 50, "max-eloc-50"),
        ("eloc", 70, "max-eloc-70"),
        ("parameters", 6, "max-function-parameters-6"),
    ],
)
def test_functions(metric: str, limit: int, rule: str) -> None:
    assert rule not in [r.rule for r in results({metric: limit})]
    (result,) = [r for r in results({metric: limit + 1}) if r.rule == rule]
    assert (result.tool, result.value, result.limit) == ("metrics", limit + 1, limit)
    assert (result.location, result.scope) == (Location("a.cpp", 7, 3), "ns::f")
    assert result.message.startswith("Function 'ns::f' has ")
    assert f" {limit + 1} " in result.message and f"(limit {limit})." in result.message


@pytest.mark.parametrize(
    ("metric", "limit", "beyond", "rule"),
    [
        ("nloc", 400, 401, "max-file-length-400"),
        ("comment_ratio", 0.20, 0.19, "min-comment-ratio-20"),
        ("comment_ratio", 0.30, 0.31, "max-comment-ratio-30"),
        ("comment_ratio", 0.40, 0.41, "max-comment-ratio-40"),
        ("volume", 8000.0, 8000.5, "halstead-volume-above-8000"),
        ("bugs", 2.0, 2.1, "halstead-bugs-above-2"),
        ("mi", 20.0, 19.9, "mi-below-20"),
        ("mi", 65.0, 64.9, "mi-below-65"),
    ],
)
def test_files(metric: str, limit: float, beyond: float, rule: str) -> None:
    assert rule not in [r.rule for r in results(file={metric: limit})]
    (result,) = [r for r in results(file={metric: beyond}) if r.rule == rule]
    assert (result.value, result.limit, result.location, result.scope) == (beyond, limit, Location("a.cpp", 1), "")
    assert result.message.startswith("File has ") and result.message.endswith(").")


def test_messages() -> None:
    complexity = results({"cc": 23})[-1]
    assert complexity.message == "Function 'ns::f' has a cyclomatic complexity of 23 (limit 15)."
    assert results(file={"comment_ratio": 0.125})[0].message == "File has a comment ratio of 12.5% (limit 20%)."
    assert results(file={"mi": 12.34})[-1].message == "File has a maintainability index of 12.3 (limit 20)."


@pytest.mark.parametrize("file", [{}, {"nloc": 0, "comment_ratio": 0.0, "mi": 100.0}])
def test_quiet(file: dict[str, Any]) -> None:
    assert results({}, file) == []


def test_gave_up() -> None:
    assert parsed({"problem": "not text", "line": 3}) == [GaveUp("a.cpp", "not text", 3)]


@pytest.mark.parametrize(
    "stdout", [b"", b"nonsense\n", b"[]\n", b'{"path": 3}\n', b'{"path": "a.cpp"}\n', b'{"path": "b.cpp"}\n']
)
def test_other_output_is_refused(stdout: bytes) -> None:
    with pytest.raises(ValueError):
        list(lizard.parse(Output(stdout, b"", 0), batch("a.cpp")))


def test_command_names_no_file() -> None:
    command = radon.command(Program(("python", "worker"), "1"), batch("--option", "a\nb.py"))
    assert command.argv == ("python", "worker")
    assert json.loads(command.stdin)["files"] == ["--option", "a\nb.py"]


def bands(*rules: str, scope: str = "f", line: int = 1) -> list[Result]:
    return [Result("metrics", rule, Level.WARNING, rule, Location("a", line), scope=scope) for rule in rules]


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        (["max-cyclomatic-complexity-10", "max-cyclomatic-complexity-15"], ["max-cyclomatic-complexity-15"]),
        (["max-eloc-50", "max-eloc-70"], ["max-eloc-70"]),
        (["max-comment-ratio-30", "max-comment-ratio-40"], ["max-comment-ratio-40"]),
        (["mi-below-65", "mi-below-20"], ["mi-below-20"]),
        # quiet: nothing to drop
        ([], []),
        (["max-cyclomatic-complexity-10"], ["max-cyclomatic-complexity-10"]),
        (["max-cyclomatic-complexity-15"], ["max-cyclomatic-complexity-15"]),
        (["max-eloc-50", "max-cyclomatic-complexity-15"], ["max-eloc-50", "max-cyclomatic-complexity-15"]),
        (["max-function-length-40", "max-eloc-70"], ["max-function-length-40", "max-eloc-70"]),
        (
            ["halstead-volume-above-8000", "halstead-bugs-above-2"],
            ["halstead-volume-above-8000", "halstead-bugs-above-2"],
        ),
        (["min-comment-ratio-20", "mi-below-65"], ["min-comment-ratio-20", "mi-below-65"]),
    ],
)
def test_keep_worst_band(given: list[str], kept: list[str]) -> None:
    assert [r.rule for r in metrics.keep_worst_band(bands(*given))] == kept


def test_bands_of_other_functions_and_tools_stay() -> None:
    elsewhere = bands("max-eloc-70", line=2) + bands("max-eloc-70", scope="g")
    other = [Result("other", "max-eloc-50", Level.NOTE, "x", Location("a", 1), scope="f")]
    given = (*bands("max-eloc-50"), *elsewhere, *other)
    assert metrics.keep_worst_band(given) == given
