# SPDX-License-Identifier: Apache-2.0
"""Metrics of C and C++ with lizard; the results belong to the tool ``metrics``."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.linters import installed, metrics
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, When
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace

NAME = "lizard"
LANGUAGES = frozenset({"cpp"})
WHEN = When.ALWAYS
COST = 2.7


def locate(options: LintOptions) -> Program | None:
    return installed.python_tool(NAME, "lizard_worker.py")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """The results depend on the bytes of each file alone; the number counts changes of how we measure."""
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def command(program: Program, batch: Batch) -> Command:
    return metrics.command(program, batch)


def parse(output: Output, batch: Batch) -> Iterable[Finding | GaveUp]:
    return metrics.parse(output, batch)
