# SPDX-License-Identifier: Apache-2.0
"""Bandit: security of Python code; of the workspace's settings what names tests, paths and calls."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from haros_ci.linters import columns, installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "bandit"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 8.0

MARKS = {".bandit": ("[bandit]",), "pyproject.toml": ("[tool.bandit",)}
#: Lists that any settings file may have, by the names that .bandit has for them.
LISTS = {"tests": "tests", "skips": "skips", "exclude_dirs": "exclude_dirs", "exclude": "exclude_dirs"}
#: Tests with settings of their own: names of calls, directories and protocols.
TESTS = frozenset(
    """
    assert_used hardcoded_tmp_directory shell_injection ssl_with_bad_version ssl_with_bad_defaults try_except_continue
    try_except_pass weak_cryptographic_key
    """.split()
)
LEVELS = {"HIGH": Level.ERROR, "MEDIUM": Level.WARNING, "LOW": Level.NOTE, "UNDEFINED": Level.NOTE}


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    import sys

    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    return json.dumps([sys.version_info[:2], installed.providers("bandit.plugins"), own])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    return settings_files.units(workspace, LANGUAGES, MARKS)


def command(program: Program, batch: Batch) -> Command:
    settings = settings_files.read(batch.workspace, batch.group).get(NAME, {})
    lists = {LISTS[k]: settings_files.words(v) for k, v in settings.items() if k in LISTS and settings_files.plain(v)}
    tests = {key: value for key, value in settings.items() if key in TESTS and _is_table(value)}
    own = batch.scratch / "bandit.yaml"  # JSON is YAML
    own.write_text(json.dumps({**lists, **tests}, default=str), encoding="utf-8")
    more = batch.options.arguments.get(NAME, ()) if batch.options.trust_config else ()
    options = ("--quiet", "--format=json", "--exit-zero", f"--configfile={own}", *more)
    return Command((*program.argv, *options, "--", *("./" + file.path for file in batch.files)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The JSON report; columns there are bytes from 0, and the end column is on the last line of the range."""
    if output.code != 0:
        raise ValueError(f"exit code {output.code}")
    report, paths = json.loads(output.stdout), {"./" + file.path: file.path for file in batch.files}
    for error in report["errors"]:
        path = _path(error["filename"], paths)
        yield GaveUp(
            path, python2.why_unreadable(batch.workspace.text(path)) if "syntax" in error["reason"] else error["reason"]
        )
    for finding in report["results"]:
        path = _path(finding["filename"], paths)
        place = _place(path, batch.workspace.text(path), finding)
        yield Finding(
            path, Result(NAME, finding["test_id"], LEVELS[finding["issue_severity"]], finding["issue_text"], place)
        )


def _path(name: str, paths: dict[str, str]) -> str:
    """Bandit puts ``./`` before names of its own accord."""
    return paths[name] if name in paths else paths[name.removeprefix("./")]


def _place(path: str, text: str, finding: dict[str, object]) -> Location:
    line, lines = finding["line_number"], finding["line_range"]
    if not isinstance(line, int) or not isinstance(lines, list):
        raise ValueError("not a position")
    column = columns.from_bytes(columns.line_of(text, line), finding["col_offset"])
    last = max([line, *lines])
    end = columns.from_bytes(columns.line_of(text, last), finding.get("end_col_offset"))
    if column is None or end is None or line != min(lines, default=line) or (last == line and end <= column):
        return Location(path, max(line, 1), column)
    return Location(path, line, column, last, end)


def _is_table(value: object) -> bool:
    return isinstance(value, dict) and all(isinstance(k, str) and settings_files.plain(v) for k, v in value.items())
