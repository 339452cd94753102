# SPDX-License-Identifier: Apache-2.0
"""Ruff, where it is installed: with the workspace's ruff settings as far as they lead to no other file, else with its defaults."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from haros_ci.linters import installed, pylint_doubts, python2, ruff_config, settings_files
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When, refuted
from haros_ci.linters.python_defaults import is_only_read
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "ruff"
LANGUAGES = frozenset({"python"})
WHEN = When.INSTALLED
COST = 0.1

MARKS = {".ruff.toml": (), "ruff.toml": (), "pyproject.toml": ("[tool.ruff",)}
SYNTAX = "invalid-syntax"
_REDEFINED = regex(r"Redefinition of unused `(\w+)`")
#: What a package of interfaces holds; to import it is to load it.
_SUBMODULES = ("msg", "srv", "action")


def locate(options: LintOptions) -> Program | None:
    return installed.binary("ruff", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return json.dumps([sorted(ruff_config.LEFT_OUT)])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """One group per settings file; a file depends on it and on all that it extends.

    Rules also ask which modules there are (I001, INP001), and whether a file is executable (EXE001).
    """
    chains: dict[str, tuple[str, ...]] = {"": ()}
    modules = "\0".join(file.path for file in workspace.files if file.language in LANGUAGES)
    present = hashlib.sha256(modules.encode("utf-8", "surrogatepass")).hexdigest()
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        config, path = unit.group, unit.file.path
        if config not in chains:
            chains[config] = tuple(link.path for link in ruff_config.chain(workspace, config))
        mode = workspace.executables is not None and path in workspace.executables
        yield Unit(unit.file, group=config, salt=f"{present} {mode}", settings=chains[config])


def remarks(workspace: Workspace, groups: Iterable[str]) -> Iterator[Problem]:
    """What of the settings files does not count, and why."""
    problems: list[Problem] = []
    for path in groups:
        ruff_config.chain(workspace, path, problems)
    yield from dict.fromkeys(problems)


def command(program: Program, batch: Batch) -> Command:
    config = "--isolated"
    if batch.group:
        links = ruff_config.chain(batch.workspace, batch.group)
        config = f"--config={ruff_config.write(links, batch.scratch / 'settings')}"
    ours = ("--no-cache", "--no-fix", "--no-fix-only", "--no-respect-gitignore", "--exit-zero", "--quiet")
    options = ("check", "--output-format=json", *ours, config)
    return Command((*program.argv, *options, "--", *("./" + file.path for file in batch.files)))


#: What ruff makes of ``except A, e:``, which Python 3.14 has again for two exceptions.
OF_EXCEPT = ("B025", "B029", "B030")
_BOUND = regex(r"[ \t]*except[ \t]+(?:\([^()]*\)|[\w.]+)[ \t]*,[ \t]*[a-z_]\w*[ \t]*:")
_LONGEST = 400


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The JSON report: absolute names, code points from 1, ends exclusive; a syntax error may lack its code."""
    roots = {os.path.abspath(batch.workspace.root), os.path.realpath(batch.workspace.root)}
    paths = {os.path.join(root, file.path): file.path for root in roots for file in batch.files}
    answers = json.loads(output.stdout)
    broken = {
        paths.get(report["filename"]): report["location"]["row"] for report in reversed(answers) if _is_syntax(report)
    }
    old = {path for path in broken if path is not None and python2.is_python2(batch.workspace.text(path))}
    for suspect in {paths.get(report["filename"], "") for report in answers if report["code"] in OF_EXCEPT} - {
        "",
        *old,
    }:
        bound = _binds_with_comma(batch.workspace.text(suspect))
        if bound is not None:
            old.add(suspect)
            broken.setdefault(suspect, bound)
    for item in sorted(old):
        yield GaveUp(item, "it is Python 2", broken[item])
    doubting = Doubting()
    for report in answers:
        path, rule = paths.get(report["filename"]), report["code"] or SYNTAX
        if path is None or path in old or (path in broken and rule != SYNTAX):
            continue  # what ruff makes of the rest of a file that it cannot parse is a guess
        start, end = report["location"], report["end_location"]
        text = batch.workspace.text(path)
        is_doubted = doubting.may(path, rule, text)
        place = Location(path, start["row"], start["column"], end["row"], end["column"])
        level = Level.ERROR if rule == SYNTAX else Level.WARNING
        result = Result(NAME, rule, level, report["message"], place)
        is_submodule = is_doubted and rule == "F811" and _loads_submodules(report["message"], text)
        is_wrong = is_submodule or (is_doubted and _is_refuted(rule, start["row"], start["column"] - 1, text))
        yield Finding(path, refuted(result) if is_wrong else result)


def _binds_with_comma(text: str) -> int | None:
    """The first line of *text* with ``except X, e:``, from 1; None without one."""
    return next((number for number, line in enumerate(text.split("\n"), 1) if _BOUND.match(line[:_LONGEST])), None)


def _is_syntax(report: Mapping[str, Any]) -> bool:
    return (report["code"] or SYNTAX) == SYNTAX


def _loads_submodules(message: str, text: str) -> bool:
    """Whether imports of one name from several packages are there to load ``msg`` and ``srv`` of each, which code uses by its package."""
    name = _REDEFINED.match(message)
    if name is None or name[1] not in _SUBMODULES:
        return False
    packages = set(re.findall(rf"^[ \t]*from[ \t]+(\w+)[ \t]+import[ \t][^\n#]*\b{name[1]}\b", text, re.MULTILINE))
    imported = dict(re.findall(r"^[ \t]*import[ \t]+(\w+)(?:[ \t]+as[ \t]+(\w+))?[ \t]*(?:#.*)?$", text, re.MULTILINE))
    by_package = {imported.get(package) or package for package in packages}
    return len(packages) > 1 and any(re.search(rf"(?<![\w.]){item}\.{name[1]}\b", text) for item in by_package)


def _is_refuted(rule: str, line: int, column: int, text: str) -> bool:
    """As of pylint's messages on the same defects; a default is reported where it stands, not at its function."""
    if rule == "B006":
        return is_only_read(text, line, column)
    if rule == "F523":
        return pylint_doubts.is_refuted("too-many-format-args", line, column, text)
    return rule == "B018" and pylint_doubts.is_refuted("pointless-statement", line, column, text)
