# SPDX-License-Identifier: Apache-2.0
"""xmllint: whether launch files, manifests, robot descriptions and plug-in descriptions are well-formed XML."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator

from haros_ci.linters import installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "xmllint"
LANGUAGES = frozenset({"launch", "package", "xml"})
WHEN = When.ASKED
COST = 1.0

_LINK = "workspace"
_SAID = regex(r"(/.+?):(\d+): (\w+) (error|warning) : (.*)")
_UNREAD = regex(r'(?:warning: |I/O warning : )failed to load external entity "(/.+)"')


def locate(options: LintOptions) -> Program | None:
    return installed.binary("xmllint", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Launch files may also be YAML."""
    for file in workspace.files:
        if file.language in LANGUAGES and not file.path.endswith((".yaml", ".yml")):
            yield Unit(file)


def command(program: Program, batch: Batch) -> Command:
    """No document type definition is loaded, no entity replaced, nothing included, no address asked.

    The files go by a link in a directory whose name nobody can know beforehand: xmllint quotes what it reads, and a quoted
    line must not pass for a finding in another file.
    """
    batch.scratch.mkdir(parents=True, exist_ok=True)
    (batch.scratch / _LINK).symlink_to(os.path.abspath(batch.workspace.root), target_is_directory=True)
    return Command((*program.argv, "--noout", "--nonet", "--nocatalogs", *_names(batch)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """``path:line: parser error : message``; what the parser says after its first error follows from that."""
    if output.code not in (0, 1):
        raise ValueError(f"exit code {output.code}")
    paths = _names(batch)
    reported: set[tuple[str, str, str]] = set()
    for text in output.stderr.decode("utf-8", "replace").split("\n"):
        if (unread := _UNREAD.match(text)) and unread[1] in paths:
            yield GaveUp(paths[unread[1]], "it cannot be read")
        match = _SAID.fullmatch(text)
        if match is None or match[1] not in paths:
            continue
        name, line, kind, severity, message = match.groups()
        path = paths[name]
        rule = f"{kind}-{severity}"
        once = (path, rule, "" if rule == "parser-error" else message)
        if once not in reported:
            reported.add(once)
            level = Level.ERROR if severity == "error" else Level.WARNING
            yield Finding(path, Result(NAME, rule, level, message.strip(), Location(path, int(line))))


def _names(batch: Batch) -> dict[str, str]:
    """The path for each name that xmllint gets."""
    return {f"{os.path.abspath(batch.scratch)}/{_LINK}/{file.path}": file.path for file in batch.files}
