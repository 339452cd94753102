# SPDX-License-Identifier: Apache-2.0
"""mypy, a package at a time, without what is installed: only types of the package and of the standard library count."""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from posixpath import join, normpath, relpath

from haros_ci.linters import columns, imports, installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "mypy"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 20.0
#: Long batches: every process reads the types of the standard library anew, packages in one only once.
BATCH_SECONDS = 10.0

MARKS = {
    "mypy.ini": ("[mypy]",),
    ".mypy.ini": ("[mypy]",),
    "pyproject.toml": ("[tool.mypy",),
    "setup.cfg": ("[mypy]",),
}
#: Options that switch or name things. Left out is what runs code (plugins, python_executable), reads elsewhere (mypy_path,
#: files, custom_typeshed_dir, custom_typing_module, site packages), writes (reports, caches), or changes the output.
INERT = frozenset(
    """
    python-version platform always-true always-false ignore-missing-imports follow-imports follow-imports-for-stubs
    disallow-any-unimported disallow-any-expr disallow-any-decorated disallow-any-explicit disallow-any-generics
    disallow-subclassing-any disallow-untyped-calls untyped-calls-exclude disallow-untyped-defs
    disallow-incomplete-defs check-untyped-defs disallow-untyped-decorators implicit-optional strict-optional
    warn-redundant-casts warn-unused-ignores warn-no-return warn-return-any warn-unreachable ignore-errors
    allow-untyped-globals allow-redefinition local-partial-types disable-error-code enable-error-code extra-checks
    implicit-reexport strict-concatenate strict-equality strict-bytes strict deprecated-calls-exclude
    disable-bytearray-promotion disable-memoryview-promotion
    """.split()
)

_NO_TYPE = regex(r"\w\?")
_NO_MEMBER = regex(r'Module "([\w.]+)" has no attribute ')


def locate(options: LintOptions) -> Program | None:
    return installed.python_tool(NAME, "mypy_worker.py")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    return json.dumps([sys.version_info[:2], options.trust_config, own])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return imports.closures(workspace).get(file.path, ())


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """One group per settings file; a file depends on the modules of its package that it imports.

    The names of modules depend on where the package is, and the report on them on which packages there are.
    """
    closures = imports.closures(workspace)
    homes = {package.name: package.path for package in workspace.packages}
    inits = "\0".join(file.path for file in workspace.files if file.path.endswith("/__init__.py"))
    packages = hashlib.sha256(inits.encode("utf-8", "surrogatepass")).hexdigest()
    for unit in settings_files.units(workspace, LANGUAGES, MARKS, lambda path, config: closures[path]):
        yield replace(unit, salt=f"{homes.get(unit.file.package or '', '.')} {packages}")


def command(program: Program, batch: Batch) -> Command:
    """The worker checks one package after another, each from the package's directory."""
    own: tuple[str, ...] = batch.options.arguments.get(NAME, ()) if batch.options.trust_config else ()
    if batch.options.trust_config and batch.group:
        rc, place = batch.workspace.root / batch.group, ""
    else:
        rc, place = batch.scratch / "given.ini", str(batch.scratch / "mypy.ini")
        rc.write_text(_rc(settings_files.read(batch.workspace, batch.group), batch.group), encoding="utf-8")
        own = ("--no-site-packages", *own)
    request = {
        "config": os.path.abspath(rc),
        "own": place,
        "cache": str(batch.scratch / "cache"),
        "options": own,
        "parts": [{"home": home, "files": files} for home, files in _parts(batch).items()],
    }
    return Command(program.argv, stdin=json.dumps(request).encode())


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """Lines of JSON, the last of which says ``done``. Columns count from 0, in units that differ by version if not ASCII."""
    paths = {join(home, name).removeprefix("./") for home, names in _parts(batch).items() for name in names}
    *lines, last = output.stdout.decode("utf-8", "replace").rstrip("\n").split("\n")
    if json.loads(last) != {"done": True}:
        raise ValueError("it did not finish")
    home = "."
    for line in lines:
        report = json.loads(line)
        if "home" in report:
            home = report["home"]
            continue
        path = normpath(join(home, report["file"]))
        if path not in paths:
            continue
        text, number = batch.workspace.text(path), report["line"]
        if "gave_up" in report:
            why = python2.why_unreadable(text) if report["gave_up"] == "syntax" else report["gave_up"]
            yield GaveUp(path, why, number if number and number > 0 else None)
        elif report["severity"] == "error" and not _unfounded(report["code"], report["message"], batch.workspace):
            rule = report["code"] or "misc"
            yield Finding(path, Result(NAME, rule, Level.ERROR, report["message"], _place(path, text, report)))


def _parts(batch: Batch) -> dict[str, list[str]]:
    """The files of each package by its directory, relative to that; those of no package are the root's."""
    homes = {package.name: package.path for package in batch.workspace.packages}
    parts: dict[str, list[str]] = {}
    for file in batch.files:
        home = homes.get(file.package or "", ".")
        parts.setdefault(home, []).append(relpath(file.path, home))
    return parts


def _unfounded(code: str | None, message: str, workspace: Workspace) -> bool:
    """Whether this only follows from a module that is not there: generated, compiled, or not installed.

    Such a name is a variable to mypy and no type (``name?`` in later messages); and a package may get modules when it is
    built, as interfaces and pybind11 modules are.
    """
    if (code == "valid-type" and message.startswith("Variable ")) or _NO_TYPE.search(message):
        return True
    match = _NO_MEMBER.match(message)
    if match is None or code != "attr-defined":
        return False
    init = match[1].replace(".", "/") + "/__init__.py"
    return any(file.path == init or file.path.endswith("/" + init) for file in workspace.files)


def _place(path: str, text: str, report: dict[str, int | None]) -> Location:
    line, end_line = report["line"] or 0, report.get("end_line")
    if line < 1:
        return Location(path)
    column = _column(columns.line_of(text, line), report["column"])
    end = _column(columns.line_of(text, end_line), report.get("end_column")) if end_line and end_line >= line else None
    if column is None or end is None or (end_line == line and end <= column):
        return Location(path, line, column)
    return Location(path, line, column, end_line, end)


def _column(line: str, offset: int | None) -> int | None:
    return offset + 1 if offset is not None and 0 <= offset <= len(line) and line.isascii() else None


def _rc(sections: dict[str, dict[str, object]], config: str) -> str:
    """Our own INI of the inert keys: global ones, and those for modules."""
    parts = [("mypy", sections.get("mypy", {}))]
    if config.endswith(".toml"):
        overrides = parts[0][1].get("overrides")
        for entry in overrides if isinstance(overrides, list) else ():
            if isinstance(entry, dict):
                parts += ((f"mypy-{module}", entry) for module in settings_files.words(entry.get("module", [])))
    else:
        parts += ((name, options) for name, options in sections.items() if name.startswith("mypy-"))
    chosen: dict[str, dict[str, object]] = {}
    for name, options in parts:
        inert = {key.replace("-", "_"): value for key, value in settings_files.inert(options, INERT).items()}
        chosen[name] = chosen.get(name, {}) | inert
    return "\n".join(settings_files.ini_text(name, options) for name, options in chosen.items())
