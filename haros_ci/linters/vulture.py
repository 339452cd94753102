# SPDX-License-Identifier: Apache-2.0
"""Vulture: code that nothing uses, a package at a time; what ROS calls is taken as used."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Iterator

from haros_ci.linters import columns, installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "vulture"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 6.0

MARKS = {"pyproject.toml": ("[tool.vulture",)}
#: Left out are paths, which we name, and what changes the output.
INERT = frozenset("exclude ignore-decorators ignore-names min-confidence".split())
#: Below 80 stand functions, classes, methods and attributes, which other packages, launch files and ROS itself may use.
CONFIDENCE = 80
#: What launch, launch_testing, rclpy's and lifecycle's base classes, pytest, catkin and setuptools call by its name, and
#: parameters that a function has because of who calls it.
CALLED = (
    "generate_launch_description generate_test_description on_configure on_activate on_deactivate on_cleanup"
    " on_shutdown on_error main setup test_* Test* setUp tearDown setUpClass tearDownClass pytest_* callback *_callback"
    " *_cb execute"
    " self cls args kwargs context request response goal_handle event"
).split()

_LINE = regex(r"(.+):(\d+): (.+) \(\d+% confidence(?:, \d+ lines?)?\)$")
_ENTRY = regex(r"=\s*[\w.]+:(\w+)")
_UNUSED = regex(r"unused (\w+) '(.*)'$")


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    import sys

    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    return json.dumps([sys.version_info[:2], CONFIDENCE, CALLED, own])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # the package's files come in as salt


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """One group per package, whose units all depend on all of its files."""
    packages: dict[str | None, list[SourceFile]] = {}
    for file in workspace.files:
        if file.language in ("python", "setup"):
            packages.setdefault(file.package, []).append(file)
    salts = {
        package: hashlib.sha256("\0".join(f"{f.path}\0{f.digest}" for f in files).encode()).hexdigest()
        for package, files in packages.items()
    }
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        package = unit.file.package
        group = json.dumps([package, unit.group])
        yield Unit(unit.file, group=group, settings=unit.settings, salt=salts[package])


def command(program: Program, batch: Batch) -> Command:
    package, config = json.loads(batch.group)
    files = [f for f in batch.workspace.files if f.package == package and f.language in LANGUAGES]
    settings = settings_files.inert(settings_files.read(batch.workspace, config).get(NAME, {}), INERT)
    settings = {key.replace("-", "_"): value for key, value in settings.items()}
    for key in ("exclude", "ignore_names", "ignore_decorators"):
        settings[key] = settings_files.words(settings.get(key, []))
    if not isinstance(settings.get("min_confidence"), int):
        settings["min_confidence"] = CONFIDENCE
    used = {*settings_files.words(settings["ignore_names"]), *CALLED, *_entry_points(batch.workspace, package)}
    settings |= {"ignore_names": sorted(used), "paths": ["./" + file.path for file in files]}
    own = batch.scratch / "vulture.toml"
    own.write_text(settings_files.toml_text(NAME, settings), encoding="utf-8")
    more = batch.options.arguments.get(NAME, ()) if batch.options.trust_config else ()
    return Command((*program.argv, f"--config={own}", *more))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """Lines of text for the whole package, of which those on the batch's files count; exit code 3 says that there are some."""
    if output.code not in (0, 1, 3):
        raise ValueError(f"exit code {output.code}")
    paths = {name: file.path for file in batch.files for name in (file.path, "./" + file.path)}
    known = paths.keys() | {f.path for f in batch.workspace.files}
    for line in output.stderr.decode("utf-8", "replace").split("\n"):
        for path in {paths[name] for name in _prefixes(line) if name in paths}:
            number = re.search(r":(\d+): ", line)
            text = batch.workspace.text(path)
            yield GaveUp(path, python2.why_unreadable(text), int(number[1]) if number else None)
    for line in output.stdout.decode("utf-8", "replace").removesuffix("\n").split("\n") if output.stdout else ():
        match = _LINE.match(line)
        if match is None or match[1].removeprefix("./") not in known:
            raise ValueError("not a line of vulture")
        if match[1] in paths:
            yield _finding(paths[match[1]], int(match[2]), match[3], batch.workspace)


def _finding(path: str, line: int, message: str, workspace: Workspace) -> Finding:
    """``unused function 'f'``; what does not begin so is code that is never reached or a condition that is always true."""
    unused = _UNUSED.match(message)
    if unused is None:
        return Finding(path, Result(NAME, "unreachable-code", Level.WARNING, message, Location(path, line)))
    place = columns.word_at(path, workspace.text(path), line, unused[2])
    return Finding(path, Result(NAME, f"unused-{unused[1]}", Level.WARNING, message, place))


def _prefixes(line: str) -> Iterator[str]:
    """What may be the file name at the head of a complaint."""
    line = line.removeprefix("Error: Could not read file ")
    for match in re.finditer(r":| - ", line):
        yield line[: match.start()]


def _entry_points(workspace: Workspace, package: str | None) -> set[str]:
    """The functions that setup.py and setup.cfg name as console scripts."""
    files = (f.path for f in workspace.files if f.package == package)
    return {n for p in files if p.endswith(("setup.py", "setup.cfg")) for n in _ENTRY.findall(workspace.text(p))}
