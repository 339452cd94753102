# SPDX-License-Identifier: Apache-2.0
"""cmakelint, of which ROS 2's ament_lint_cmake holds a copy, on CMake files; with the workspace's .cmakelintrc."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.linters import settings_files, texts
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace

NAME = "cmakelint"
LANGUAGES = frozenset({"cmake"})
WHEN = When.ASKED
COST = 8.0

MARKS: settings_files.Marks = {".cmakelintrc": ()}
#: What ament_lint_cmake allows; a .cmakelintrc may say otherwise.
LINE_LENGTH = 140


def locate(options: LintOptions) -> Program | None:
    return texts.locate("cmakelint", NAME)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return f"{LINE_LENGTH}"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows it


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    return settings_files.units(workspace, LANGUAGES, MARKS)


def command(program: Program, batch: Batch) -> Command:
    """A .cmakelintrc has lines ``filter=``, ``spaces=`` and ``linelength=``: none of them leads to another file."""
    lines = batch.workspace.setting(batch.group).splitlines() if batch.group else []
    return texts.command(program, batch, {"lines": lines, "length": LINE_LENGTH})


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    return texts.parse(output, batch, NAME)
