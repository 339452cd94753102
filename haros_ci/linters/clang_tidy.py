# SPDX-License-Identifier: Apache-2.0
"""clang-tidy, where it is installed and a compile database tells how files are built."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from posixpath import dirname, join, relpath

from haros_ci.linters import footing, growth, includes, installed
from haros_ci.linters.compile_db import directories, flags_by_file
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

NAME = "clang-tidy"
LANGUAGES = frozenset({"cpp"})
WHEN = When.INSTALLED
COST = 300.0
FOLLOWS_INCLUDES = True
#: One file in a process: it would name a header's finding for the first file only.
BATCH_SECONDS = 1e-6

SETTINGS = ".clang-tidy"
#: In place of a .clang-tidy, whose ExtraArgs can load code into the compiler, unless the user trusts the workspace.
CHECKS = "bugprone-*,-bugprone-easily-swappable-parameters,clang-analyzer-*,clang-diagnostic-*,performance-*"
LEVELS = {"error": Level.ERROR, "fatal error": Level.ERROR, "warning": Level.WARNING}

_LINE = regex(r"(.+?):(\d+):(\d+): (fatal error|error|warning|note): (.*?)(?: \[([\w.,+-]+)\])?$")


def locate(options: LintOptions) -> Program | None:
    return installed.binary("clang-tidy", options, beside="clang_tidy/data/bin/clang-tidy")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return json.dumps([CHECKS, options.trust_config])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    flags = flags_by_file(workspace, options)
    if not flags:
        return
    files = {file.path: file for file in workspace.files if file.language in LANGUAGES}
    root = os.path.realpath(workspace.root)
    search = {path: _inside(flags[path], root) for path in flags}
    everywhere = tuple(dict.fromkeys(directory for path in sorted(search) for directory in search[path]))
    directives = includes.written(workspace, files.values(), store)
    direct = includes.resolve(directives, {path: search.get(path, everywhere) for path in files})
    needs = includes.needs(directives, dict.fromkeys(files, everywhere))
    for path in sorted(flags):
        headers = tuple(sorted(includes.closure(path, direct)))
        salt = "\n".join(flag.replace(root, "") for flag in flags[path])
        own = tuple(_settings(workspace, path)) if options.trust_config else ()
        yield Unit(files[path], dependencies=needs(path), covers=headers, salt=salt, settings=own)


def declined(workspace: Workspace, units: Iterable[Unit]) -> dict[str, str]:
    """Files on which the tool would not end, with the reason: it is not asked about them."""
    return growth.why_not_cpp(workspace, units)


def command(program: Program, batch: Batch) -> Command:
    """The database that it gets is ours: the harmless flags only, and a compiler's name that nothing starts."""
    flags = flags_by_file(batch.workspace, batch.options)
    root = os.path.realpath(batch.workspace.root)
    entries = [
        {
            "directory": root,
            "file": os.path.join(root, file.path),
            "arguments": ["clang++", *flags.get(file.path, ()), "-c", os.path.join(root, file.path)],
        }
        for file in batch.files
    ]
    (batch.scratch / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
    config = () if batch.options.trust_config else (f"--config={{Checks: '{CHECKS}', InheritParentConfig: false}}",)
    options = ("-p", str(batch.scratch), "--quiet", "--header-filter=.*", *config)
    searched = (directory for file in batch.files for directory in directories(flags.get(file.path, ())))
    reads = (*footing.HEADERS, *dict.fromkeys(searched))
    return Command((*program.argv, *options, *(os.path.join(root, file.path) for file in batch.files)), reads=reads)


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """``path:line:column: severity: message [check]``, then its notes; a compiler's error means giving up."""
    root, unit = os.path.realpath(batch.workspace.root), batch.files[0].path
    pending: Result | None = None
    for line in output.stdout.decode("utf-8", "replace").splitlines():
        match = _LINE.match(line)
        if match is None:
            continue
        path, row, column, severity, message, check = match.groups()
        place = Location(relpath(path, root) if os.path.isabs(path) else path, int(row), int(column))
        if severity == "note" and pending is not None:
            pending = _with(pending, Related(place, message))
        elif check == "clang-diagnostic-error":
            yield GaveUp(unit, message, place.line if place.path == unit else None)
            return
        elif check:
            if pending is not None:
                yield Finding(unit, pending)
            pending = Result(NAME, check.split(",")[0], LEVELS[severity], message, place)
    if pending is not None:
        yield Finding(unit, pending)
    elif output.code not in (0, 1):
        raise ValueError(f"exit code {output.code}")


def _settings(workspace: Workspace, path: str) -> Iterator[str]:
    """Every .clang-tidy from the file's directory up to the root, for one may inherit from the next."""
    while path:
        path = dirname(path)
        if workspace.setting(found := join(path, SETTINGS)):
            yield found


def _inside(flags: Iterable[str], root: str) -> tuple[str, ...]:
    """The include directories among *flags* that lie in the workspace, relative to its root."""
    return tuple(relpath(path, root) for path in directories(flags) if path == root or path.startswith(root + "/"))


def _with(result: Result, related: Related) -> Result:
    from dataclasses import replace

    return replace(result, related=(*result.related, related))
