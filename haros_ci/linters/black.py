# SPDX-License-Identifier: Apache-2.0
"""Black, dry: which files it would reformat, with the workspace's settings of the style."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from posixpath import dirname, normpath, relpath

from haros_ci.linters import copies, diffs, installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "black"
LANGUAGES = frozenset({"python"})
WHEN = When.ASKED
COST = 25.0

RULE = "would-reformat"
MESSAGE = "Black would reformat this file, from here on: run `black` on it."
OWN = "pyproject.toml"
MARKS = {OWN: ("[tool.black",)}
#: Left out are what runs, reads and writes (workers, cache-dir, code, line-ranges), required-version, which would stop
#: every other version, and verbose and quiet.
INERT = frozenset(
    """
    line-length target-version skip-source-first-line skip-string-normalization skip-magic-trailing-comma preview
    unstable enable-unstable-feature pyi exclude extend-exclude force-exclude
    """.split()
)
#: Black applies ``exclude`` only to files that it finds itself; ``force-exclude`` also covers files on the command line.
EXCLUDES = ("exclude", "extend-exclude", "force-exclude")

_ERROR = regex(r"error: cannot (?:parse: (.+?):(\d+):\d+|format (.+?): (?:Cannot parse.*?: (\d+):\d+)?.*)$")


def locate(options: LintOptions) -> Program | None:
    return installed.python_module(NAME, options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    import sys

    own = options.arguments.get(NAME, ()) if options.trust_config else ()
    return json.dumps([sys.version_info[:2], own])  # why a file is unreadable is said in terms of this Python


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    return settings_files.units(workspace, LANGUAGES, MARKS)


def command(program: Program, batch: Batch) -> Command:
    """Copies below a settings file of ours: on its way to the root Black reads every pyproject.toml, whatever its options are."""
    settings = settings_files.inert(settings_files.read(batch.workspace, batch.group).get(NAME, {}), INERT)
    excludes = [str(settings.pop(key)) for key in EXCLUDES if settings.get(key)]
    if excludes:
        settings["force-exclude"] = excludes[0] if len(excludes) == 1 else "|".join(f"(?:{e})" for e in excludes)
    copied = _copied(batch)
    copies.lay(batch, copied)
    copies.put(batch, OWN, settings_files.toml_text(NAME, settings))
    more = batch.options.arguments.get(NAME, ()) if batch.options.trust_config else ()
    options = (f"--config={OWN}", "--diff", "--fast", "--no-color", "--quiet", "--workers=1", *more)
    # For a lock on its output, Black starts a process of its own and talks to it.
    return Command((*program.argv, *options, "--", *copied), cwd=copies.tree(batch), talks=True)


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """A diff of each file on stdout, on stderr what it cannot parse; then the exit code is 123."""
    if output.code not in (0, 123):
        raise ValueError(f"exit code {output.code}")
    copied = _copied(batch)
    names = {name: path for copy, path in copied.items() for name in (copy, normpath(copy))}
    failed = False
    for too_long in sorted({file.path for file in batch.files}.difference(copied.values())):
        yield GaveUp(too_long, "its name is too long")
    for line in output.stderr.decode("utf-8", "replace").split("\n"):
        match = _ERROR.match(line)
        if match and (path := names.get(match[1] or match[3])):
            failed = True
            yield GaveUp(
                path, python2.why_unreadable(batch.workspace.text(path)), int(match[2] or match[4] or 0) or None
            )
    if output.code and not failed:
        raise ValueError("it failed")
    for path, line_number in diffs.first_changes(output.stdout.decode("utf-8", "replace"), names):
        yield Finding(path, Result(NAME, RULE, Level.NOTE, MESSAGE, Location(path, line_number)))


def _copied(batch: Batch) -> dict[str, str]:
    """The path for each name below the tree, where the settings' directory is the root."""
    home = dirname(batch.group) or "."
    return {f"./{relpath(f.path, home)}": f.path for f in batch.files if len(f.path.encode()) <= copies.LONGEST}
