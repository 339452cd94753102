# SPDX-License-Identifier: Apache-2.0
"""hadolint on Dockerfiles, with the workspace's .hadolint.yaml, which can run nothing and names no other file."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from haros_ci.linters import copies, installed, settings_files, yaml_settings
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "hadolint"
LANGUAGES = frozenset({"dockerfile"})
WHEN = When.ASKED
COST = 60.0

SETTINGS = ".hadolint.yaml"
MARKS: settings_files.Marks = {SETTINGS: (), ".hadolint.yml": ()}
#: hadolint cannot read the file: its syntax, or one that is newer than hadolint.
UNREADABLE = "DL1000"
LEVELS = {"error": Level.ERROR, "warning": Level.WARNING}


def locate(options: LintOptions) -> Program | None:
    return installed.binary("hadolint", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows it


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    return settings_files.units(workspace, LANGUAGES, MARKS)


def command(program: Program, batch: Batch) -> Command:
    """ValueError for settings that are no map, which hadolint would go on without."""
    settings = batch.workspace.setting(batch.group) if batch.group else "ignored: []\n"
    try:
        yaml_settings.read(settings)
    except ValueError as err:
        raise ValueError(f"{batch.group}: {err}") from err
    copied = copies.names(batch)
    copies.lay(batch, copied)
    copies.put(batch, SETTINGS, settings)
    options = ("--format=json", "--no-fail", "--no-color", f"--config=./{SETTINGS}")
    return Command((*program.argv, *options, "--", *copied), cwd=copies.tree(batch))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The JSON report; a finding's column is always 1 there, so its line is meant."""
    if output.code or b"Error parsing your config file" in output.stderr:
        raise ValueError(f"exit code {output.code}, or invalid settings")
    paths = copies.names(batch)
    for report in json.loads(output.stdout):
        path, line = paths[report["file"]], report["line"]
        if report["code"] == UNREADABLE:
            yield GaveUp(path, " ".join(report["message"].split()), line)
            continue
        level = LEVELS.get(report["level"], Level.NOTE)
        yield Finding(path, Result(NAME, report["code"], level, report["message"], Location(path, line)))
