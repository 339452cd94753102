# SPDX-License-Identifier: Apache-2.0
"""Metrics of Python with radon; the results belong to the tool ``metrics``."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.linters import installed, metrics
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, When
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace

NAME = "radon"
LANGUAGES = frozenset({"python"})
WHEN = When.ALWAYS
COST = 3.9


def locate(options: LintOptions) -> Program | None:
    return installed.python_tool(NAME, "radon_worker.py")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """The results depend on the bytes of each file and on this Python's grammar; the number counts changes of how we measure."""
    import sys

    return f"{sys.version_info[:2]}"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def command(program: Program, batch: Batch) -> Command:
    return metrics.command(program, batch)


def parse(output: Output, batch: Batch) -> Iterable[Finding | GaveUp]:
    return metrics.parse(output, batch)
