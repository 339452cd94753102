# SPDX-License-Identifier: Apache-2.0
"""The linters that are asked about texts through text_worker.py: how they are started and what they answer."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator

from haros_ci.linters import installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, Output, Program
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level


def locate(distribution: str, tool: str) -> Program | None:
    """The worker for *tool*, which comes with the Python *distribution*; None if that is not installed."""
    program = installed.python_tool(distribution, "text_worker.py")
    return program and Program((*program.argv, tool), program.version)


def command(program: Program, batch: Batch, settings: object, name: Callable[[str], str] = str) -> Command:
    """The texts of the batch go in through stdin; *name* tells under which name the tool is to know a path."""
    text = batch.workspace.text
    files = [{"path": f.path, "name": name(f.path), "text": text(f.path)} for f in batch.files]
    return Command(program.argv, stdin=json.dumps({"settings": settings, "files": files}).encode(), cwd=batch.scratch)


def parse(output: Output, batch: Batch, tool: str) -> Iterator[Finding | GaveUp]:
    """One answer for each file, or ValueError."""
    answers = {}
    for line in output.stdout.splitlines():
        answer = json.loads(line)
        answers[answer["path"]] = answer
    for file in batch.files:
        if file.path not in answers:
            raise ValueError(f"no answer for {file.path}")
        answer = answers[file.path]
        if "problem" in answer:
            yield GaveUp(file.path, str(answer["problem"]))
            continue
        for rule, line, column, message in answer["said"]:
            place = Location(file.path, line or None, column if line else None)
            yield Finding(file.path, Result(tool, rule, Level.WARNING, message, place))
