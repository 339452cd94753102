# SPDX-License-Identifier: Apache-2.0
"""flake8 and the plug-ins installed beside it, with the workspace's settings as far as they cannot run code."""

from __future__ import annotations

import json
import sys
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from posixpath import dirname, join, relpath

from haros_ci.linters import columns, installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "flake8"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 12.0

#: In the order of flake8's documentation, "Configuration"; it takes the first with a section of its own.
MARKS = {"setup.cfg": ("[flake8",), "tox.ini": ("[flake8",), ".flake8": ("[flake8",)}

#: Options that name files that flake8 would not look at, were it to look for them.
EXCLUDES = ("exclude", "extend-exclude")
#: The option that names paths: relative to the file that has it, and on the command line to where flake8 runs.
PER_FILE = "per-file-ignores"
#: Options that only count, switch or name things: flake8's own, then those of plug-ins that ROS projects use. Left out are
#: plug-ins in the workspace ([flake8:local-plugins]), files to write, processes, and the layout of the output.
INERT = frozenset(
    """
    per-file-ignores
    max-line-length max-doc-length max-complexity indent-size hang-closing ignore extend-ignore select extend-select
    disable-noqa builtins doctests include-in-doctest exclude-from-doctest enable-extensions
    import-order-style application-import-names application-package-names inline-quotes multiline-quotes
    docstring-quotes avoid-escape docstring-convention classmethod-decorators ignore-decorators property-decorators
    extend-immutable-calls max-cognitive-complexity ban-relative-imports suppress-none-returning
    suppress-dummy-args allow-untyped-defs allow-untyped-nested mypy-init-return
    """.split()
)
#: What ament_flake8 sets, where the workspace sets nothing.
DEFAULTS = {"max-line-length": "99"}

SYNTAX = ("E999", "E902")


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    """What checks: the plug-ins, and the two libraries that flake8 brings."""
    found = [installed.distribution(name) for name in ("pycodestyle", "pyflakes")]
    libraries = [distribution.version if distribution else None for distribution in found]
    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    plugins = installed.providers("flake8.extension")
    return json.dumps([sys.version_info[:2], libraries, plugins, options.trust_config, own])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    settings: dict[str, dict[str, object]] = {"": {}}
    paths = {file.path for file in workspace.files}
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        if unit.group not in settings:
            settings[unit.group] = settings_files.read(workspace, unit.group).get(NAME, {})
        globs = [word for key in EXCLUDES for word in settings_files.words(settings[unit.group].get(key, ""))]
        if not settings_files.excludes(globs, unit.group, unit.file.path):
            yield replace(unit, salt=_around(workspace, paths, unit.file.path))


def command(program: Program, batch: Batch) -> Command:
    """It runs beside the settings, for the paths that they name."""
    home = dirname(batch.group)
    root = batch.workspace.root
    options: tuple[str, ...]
    if batch.options.trust_config and batch.group:
        options = (f"--config={root / batch.group}", *batch.options.arguments.get(NAME, ()))
    else:
        settings = settings_files.read(batch.workspace, batch.group).get("flake8", {}) if batch.group else DEFAULTS
        chosen = settings_files.inert(settings, INERT)
        own = batch.scratch / "flake8.cfg"
        per_file = (f"--{PER_FILE}={chosen.pop(PER_FILE)}",) if PER_FILE in chosen else ()
        own.write_text(settings_files.ini_text(NAME, chosen), encoding="utf-8")
        options = (f"--config={own}", *per_file)
        if batch.options.trust_config:
            options += batch.options.arguments.get(NAME, ())
    layout = "--format=%(path)s\t%(row)d\t%(col)d\t%(code)s\t%(text)s"
    ours = ("--jobs=1", "--exit-zero", "--color=never", "--no-show-source", layout)
    names = ("./" + relpath(file.path, home or ".") for file in batch.files)
    return Command((*program.argv, *options, *ours, "--", *names), cwd=root / home)


def _around(workspace: Workspace, paths: Collection[str], path: str) -> str:
    """What plug-ins ask of a file besides: whether it is in a package and whether it is executable."""
    package = join(dirname(path), "__init__.py") in paths
    mode = workspace.executables is not None and path in workspace.executables
    return f"{package} {mode}"


def _is_unreadable(row: list[str], text: str) -> bool:
    """Whether the finding says that the file is not of this Python, rather than that it is wrong."""
    _, line, _, code, message = row
    newer = python2.is_newer(columns.line_of(text, int(line)), message)
    return code == "E902" or (code == "E999" and (newer or python2.is_python2(text)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """A line for each finding; pycodestyle counts code points and pyflakes, as everything on syntax trees, bytes."""
    if output.code != 0:
        raise ValueError(f"exit code {output.code}")
    home = dirname(batch.group)
    paths = {"./" + relpath(file.path, home or "."): file.path for file in batch.files}
    rows = [line.split("\t", 4) for line in output.stdout.decode("utf-8", "replace").split("\n") if line]
    texts = {path: batch.workspace.text(path) for path in {paths[row[0]] for row in rows}}
    broken = {paths[row[0]] for row in rows if _is_unreadable(row, texts[paths[row[0]]])}
    for name, row, column, code, message in rows:
        path, number = paths[name], int(row)
        if path in broken:
            if code in SYNTAX:
                yield GaveUp(path, python2.why_unreadable(texts[path]), number or None)
            continue
        line = columns.line_of(texts[path], number)
        at = int(column) if code.startswith(("E", "W")) else columns.from_bytes(line, int(column) - 1)
        place = Location(path, number or 1, at if at and at <= len(line) + 1 else None)
        yield Finding(path, Result(NAME, code, Level.ERROR if code == "E999" else Level.WARNING, message, place))
