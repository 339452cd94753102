# SPDX-License-Identifier: Apache-2.0
"""flawfinder: calls of C functions that are hard to use safely, each with its CWE."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator

from haros_ci.linters import copies, installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "flawfinder"
LANGUAGES = frozenset({"cpp"})
WHEN = When.ASKED
COST = 2.0

#: The risk that flawfinder gives a call in its context, 1–5.
SERIOUS = 4


def locate(options: LintOptions) -> Program | None:
    program = installed.python_tool("flawfinder", "isolation.py")
    return program and Program((*program.argv, "flawfinder"), program.version)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """It reads no configuration."""
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def command(program: Program, batch: Batch) -> Command:
    """Copies, for it skips what is not UTF-8; a name that begins with ``./`` is no option."""
    copied = copies.names(batch)
    copies.lay(batch, copied)
    return Command((*program.argv, "--csv", "--quiet", "--dataonly", "--", *copied), cwd=copies.tree(batch))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The CSV report; columns count code points from 1 and are those of the function's name."""
    text = output.stdout.decode("utf-8", "replace")
    if output.code or not text.startswith("File,Line,Column,"):
        raise ValueError(f"exit code {output.code}, and no table")
    paths = copies.names(batch)
    for row in csv.DictReader(text.split("\n")):
        path, line, column = paths[row["File"]], int(row["Line"]), int(row["Column"])
        place = Location(path, line, column, line, column + len(row["Name"]))
        level = Level.WARNING if int(row["Level"]) >= SERIOUS else Level.NOTE
        message = " ".join(filter(None, (row["Warning"], row["Suggestion"], row["Note"])))
        yield Finding(path, Result(NAME, row["RuleId"], level, f"{row['Name']}: {message}", place))
