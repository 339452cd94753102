# SPDX-License-Identifier: Apache-2.0
"""The adapter of the small linter in todo_tool.py; for a program of its own see haros_ci.api.linters.binary."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from haros_ci.api.linters import (
    Batch,
    Command,
    Finding,
    Level,
    LintOptions,
    Location,
    Output,
    Program,
    Result,
    Rule,
    SourceFile,
    When,
    Workspace,
)

NAME = "acme-todo"
LANGUAGES = frozenset({"cpp", "python"})
WHEN = When.ALWAYS
COST = 0.1

RULES = (
    Rule(
        id="no-owner",
        summary="Every TODO names who is to do it.",
        level=Level.NOTE,
        help="A TODO that is nobody's stays. Write `TODO(ada): ...`.",
        profiles=("ros", "strict"),
        tags=("maintainability",),
    ),
)


def locate(options: LintOptions) -> Program | None:
    """The tool is a script of this package, run isolated: nothing of the workspace is on its path."""
    return Program((sys.executable, "-I", str(Path(__file__).with_name("todo_tool.py"))), "1.0.0")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return "1"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def command(program: Program, batch: Batch) -> Command:
    return Command((*program.argv, *("./" + file.path for file in batch.files)))


def parse(output: Output, batch: Batch) -> Iterator[Finding]:
    for path, line, column, text in json.loads(output.stdout):
        unit = path.removeprefix("./")
        place = Location(unit, line, column)
        yield Finding(unit, Result(NAME, "no-owner", Level.NOTE, f"nobody is named to do it: {text}", place))
