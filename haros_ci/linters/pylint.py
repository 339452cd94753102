# SPDX-License-Identifier: Apache-2.0
"""pylint, with a configuration of our own unless the user trusts the workspace's; runs as a process, never imported."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from posixpath import dirname
from typing import Any

from haros_ci.linters import columns, doubled_values, growth, imports, installed, python2
from haros_ci.linters.catalogue.pylint import NOT_FATAL
from haros_ci.linters.dead_statements import OF_FILES, is_dead, is_for_python2
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.linter import (
    SILENCED,
    Batch,
    Command,
    Finding,
    GaveUp,
    LintOptions,
    Output,
    Program,
    Unit,
    When,
    refuted,
)
from haros_ci.linters.noqa import is_silenced
from haros_ci.linters.pylint_config import config_path, inert_options
from haros_ci.linters.pylint_doubts import is_refuted
from haros_ci.linters.pylint_statements import is_made_by_hand
from haros_ci.linters.settings_files import continued
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level
from haros_ci.results.same_cause import OF_A_NAME

NAME = "pylint"
LANGUAGES = frozenset({"python"})
WHEN = When.ALWAYS
COST = 25.0
#: Long batches: every process starts for half a second, and parses all modules anew that its files import.
BATCH_SECONDS = (10.0, 40.0)

#: duplicate-code and cyclic-import speak of the set of files in a process, which is ours to choose.
DISABLED = "duplicate-code,cyclic-import"
LEVELS = {"fatal": Level.ERROR, "error": Level.ERROR, "warning": Level.WARNING}
#: Messages on the analysis itself.
TROUBLE = frozenset({"astroid-error", "parse-error", "fatal", "method-check-failed", "config-parse-error"})
#: What no-value-for-parameter says of ``__new__`` where the class is what it misses.
_OF_CLASS = regex(r"argument '(?:cls|klass|mcs|mcls)'")
#: Messages on pylint's options, which are not findings in code.
ABOUT_OPTIONS = frozenset(
    {"unknown-option-value", "unrecognized-option", "useless-option-value", "bad-configuration-section"}
)


def locate(options: LintOptions) -> Program | None:
    program = installed.python_tool("pylint", "isolation.py")
    return program and Program((*program.argv, "pylint"), program.version)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    import sys

    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    astroid = installed.distribution("astroid")
    return json.dumps([sys.version_info[:2], astroid and astroid.version, options.trust_config, own])


#: What it writes when it parses a file, and when it looks at one.
PROGRESS = regex(rb"^(?=AST for .|.+ \(\d+ of \d+\)$)(?:AST for )?(?:\./)?(.+?)(?: \(\d+ of \d+\))?$", re.MULTILINE)
#: The whole line, for a file may have this name.
_NOTHING = regex(rb"^No files to lint: exiting\.?\r?$", re.MULTILINE)
#: How the report begins. Before it stands what pylint is at, and what modules of Python say that it imports to look into them: ``this`` its poem.
_REPORT = b'{\n    "messages"'


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return imports.closures(workspace, across=True).get(file.path, ())


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """One group per configuration file; a file depends on the modules that it imports, of its package or, as those of one
    process see each other, at the top of another one.
    """
    closures = imports.closures(workspace, across=True)
    configs: dict[str, str | None] = {}
    for file in workspace.files:
        if file.language in LANGUAGES:
            directory = dirname(file.path)
            if directory not in configs:
                configs[directory] = config_path(workspace, directory)
            config = configs[directory]
            own = (config,) if config else ()
            yield Unit(file, group=config or "", dependencies=closures[file.path], settings=own)


def declined(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """Files on which the tool would not end, with the reason: it is not asked about them."""
    units = list(units)
    return growth.why_not_python(workspace, units) | doubled_values.why_not(workspace, units)


def command(program: Program, batch: Batch) -> Command:
    rc = batch.scratch / "pylintrc"
    extra: tuple[str, ...] = ()
    if batch.options.trust_config and batch.group:
        rc = batch.workspace.root / batch.group
        extra = (f"--disable={DISABLED}",)
    else:
        rc.write_text(_rc(batch), encoding="utf-8")
        extra = ("--load-plugins=", "--init-hook=")
    if batch.options.trust_config:
        extra += batch.options.arguments.get(NAME, ())
    argv = (
        *program.argv,
        f"--rcfile={rc}",
        *extra,
        "--output-format=json2",
        "--persistent=n",
        "--score=n",
        "--jobs=1",
        "--verbose",
    )
    from glob import escape  # pylint expands wildcards in the names that it is given

    names = ("./" + escape(file.path) for file in batch.files)
    return Command((*argv, "--", *names), environment={"PYLINTHOME": str(batch.scratch)}, progress=PROGRESS)


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The json2 report; columns there count code points from 0. Exit codes below 32 only say what was found."""
    if _NOTHING.search(output.stderr) or _NOTHING.search(output.stdout[:100]):
        return  # the configuration disables every check or ignores every file
    if output.code & 32:
        raise ValueError("wrong usage")
    files = {"./" + file.path: file for file in batch.files} | {file.path: file for file in batch.files}
    silenced, doubting = set(), Doubting()
    start = max(output.stdout.find(_REPORT), 0)
    for report in json.loads(output.stdout[start:])["messages"]:
        file, rule = files.get(report["path"]), report["symbol"]
        if file is None or rule in ABOUT_OPTIONS or file.path in silenced:
            continue
        if rule == "syntax-error" and _is_of_import(report, batch.workspace.text(file.path)):
            continue  # pylint reports it for the imported file
        if rule == "syntax-error" and _is_of_another_python(batch.workspace.text(file.path), report):
            silenced.add(file.path)
            yield GaveUp(file.path, python2.why_unreadable(batch.workspace.text(file.path)), report["line"] or None)
        elif rule in TROUBLE:
            yield GaveUp(file.path, f"{rule}, a fault of pylint")  # the message holds paths of this machine
        elif _is_doubted(report, file.path, batch.workspace.text(file.path), doubting):
            yield Finding(file.path, refuted(_result(file.path, report)))
        else:
            result = _result(file.path, report)
            is_quiet = is_silenced(rule, batch.workspace.text(file.path), report["line"])
            yield Finding(file.path, _told_as_silenced(result) if is_quiet else result)


def _is_of_import(report: Any, text: str) -> bool:
    """Whether a syntax error is in what the file imports: a script ``monitor`` and ``monitor.py`` are one module to pylint."""
    return report["message"].startswith("Cannot import ") or (report["line"] or 0) > text.count("\n") + 1


def _told_as_silenced(result: Result) -> Result:
    """What pylint says of a finding that a comment of its own silences, of one that another tool's comment does."""
    message = f"Suppressed '{result.rule}' (from line {result.location.line})"
    return Result(NAME, SILENCED, Level.NOTE, message, Location(result.location.path, result.location.line))


def _is_doubted(report: dict[str, Any], path: str, text: str, doubting: Doubting) -> bool:
    """Whether the *text* refutes what pylint has *report*."""
    rule, line = report["symbol"], report["line"]
    if doubting.may(path, rule, text):
        if is_refuted(rule, line, report["column"], text):
            return True
        if report["type"] == "error" and rule not in OF_FILES:
            at = (text, line, report["column"])
            if is_dead(*at) or (f"pylint:{rule}" not in OF_A_NAME and is_for_python2(*at)):
                return True
        if rule == "no-value-for-parameter" and _OF_CLASS.search(report["message"]) is not None:
            return is_made_by_hand(text, line, report["column"])
    return False


def _is_of_another_python(text: str, report: dict[str, Any]) -> bool:
    return python2.is_python2(text) or python2.is_newer(columns.line_of(text, report["line"]), report["message"])


def _result(path: str, report: dict[str, object]) -> Result:
    line, column, end_line, end_column = (report[key] for key in ("line", "column", "endLine", "endColumn"))
    place = Location(path, _count(line) or 1, _count(column, 1), _count(end_line), _count(end_column, 1))
    level = LEVELS.get(str(report["type"]), Level.NOTE)
    if report["symbol"] in NOT_FATAL:
        level = Level.WARNING
    return Result(NAME, str(report["symbol"]), level, str(report["message"]), place, scope=str(report["obj"]))


def _count(value: object, base: int = 0) -> int | None:
    if value is not None and not isinstance(value, int):
        raise ValueError("not a position")
    return None if value is None or value + base < 1 else value + base


def _rc(batch: Batch) -> str:
    options = {"max-line-length": "100"}
    options |= {"ignore": "", "ignore-patterns": ""}  # by default it passes over files called CVS or .#a.py
    if batch.group:
        try:
            options |= inert_options(batch.group.rpartition("/")[2], batch.workspace.setting(batch.group))
        except ValueError:
            pass  # an unreadable configuration: as if there were none
    options["disable"] = ",".join(filter(None, (options.get("disable", "").strip().strip(","), DISABLED)))
    options["enable"] = ",".join(filter(None, (options.get("enable", "").strip().strip(","), SILENCED)))
    lines = (f"{key}={continued(value)}" for key, value in sorted(options.items()))
    return "[MAIN]\n" + "\n".join(lines) + "\n"
