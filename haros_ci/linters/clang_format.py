# SPDX-License-Identifier: Apache-2.0
"""clang-format as a check, where a .clang-format tells what the workspace wants: nothing is rewritten."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from posixpath import dirname, join

from haros_ci.linters import copies, installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.linters.tool_xml import elements
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "clang-format"
LANGUAGES = frozenset({"cpp"})
WHEN = When.ASKED
COST = 15.0

STYLES = (".clang-format", "_clang-format")
IGNORED = ".clang-format-ignore"
RULE = "formatting"
#: The most places reported of one file; a file that was never formatted has hundreds.
MOST = 25
#: Asks for the style of a directory anywhere (clang-format 21), or may do so in disguise.
_ELSEWHERE = regex(r"InheritParentConfig\s*=|\\(?:[xuU]|\r?\n)")
_NAME = regex(r"^Formatting \[\d+/\d+\] (.+)$", re.MULTILINE)
_DOCUMENT = b"<?xml version='1.0'?>"


def locate(options: LintOptions) -> Program | None:
    return installed.binary("clang-format", options, beside="clang_format/data/bin/clang-format")


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return f"{MOST}"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # its settings are all


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Only files that a style is written for: any other style would be one that nobody chose."""
    for file in workspace.files:
        if file.language not in LANGUAGES:
            continue
        own = tuple(_settings(workspace, file.path))
        styles = [path for path in own if path.endswith(STYLES)]
        if styles:
            yield Unit(file, group=styles[0], settings=own)


def command(program: Program, batch: Batch) -> Command:
    """Copies with their style files beside and above them; the search for these ends where the copies begin.

    ValueError for a style that is taken from elsewhere.
    """
    copied = _copied(batch)
    copies.lay(batch, copied)
    for file in batch.files:
        for path in _settings(batch.workspace, file.path):
            text = batch.workspace.setting(path)
            if path.endswith(STYLES) and _ELSEWHERE.search(text):
                if path == batch.group:
                    raise ValueError(
                        f"{path}: takes its style from a directory that it names, or has escapes (\\x, \\u)"
                    )
                text = "{\n"  # an error for what inherits from it
            copies.put(batch, path, text)
    (batch.scratch / STYLES[0]).write_text("BasedOnStyle: LLVM\n", encoding="ascii")  # what inherits from nothing
    (batch.scratch / IGNORED).write_text("", encoding="ascii")
    options = ("--output-replacements-xml", "--verbose", "--style=file", "--fallback-style=none", "-Wno-error=unknown")
    return Command((*program.argv, *options, "--", *copied), cwd=copies.tree(batch))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """A document of replacements (byte offsets) for each file in the order that stderr tells, without those to ignore.

    ValueError if one is missing.
    """
    copied, documents = _copied(batch), output.stdout.split(_DOCUMENT)[1:]
    paths = [copied[name] for name in _NAME.findall(output.stderr.decode("utf-8", "replace")) if name in copied]
    if len(documents) != len(paths) or output.code:
        raise ValueError(f"{len(documents)} answers for {len(paths)} files")
    for path in {file.path for file in batch.files}.difference(paths):
        if path not in copied.values():
            yield GaveUp(path, "its name is too long")
        elif not any(needed.endswith(IGNORED) for needed in _settings(batch.workspace, path)):
            raise ValueError(f"no answer for {path}")
    for path, document in zip(paths, documents):
        found = elements(_DOCUMENT + document, "replacement", "")
        spans = [(int(e.attributes["offset"]), int(e.attributes["length"])) for e in found]
        regions = _regions(batch.workspace.text(path).encode("utf-8", "replace"), spans)
        more = f", as are {len(regions) - MOST} more places below" if len(regions) > MOST else ""
        for number, (first, last, column) in enumerate(regions[:MOST], start=1):
            until = f" to line {last}" if last > first else ""
            message = (
                f"Not formatted{until} as {batch.group} asks{more if number == MOST else ''}; clang-format -i mends it"
            )
            yield Finding(path, Result(NAME, RULE, Level.NOTE, message, Location(path, first, column)))


def _settings(workspace: Workspace, path: str) -> Iterator[str]:
    """Every style file from the file's directory up to the root, for one may inherit from the next."""
    while path:
        path = dirname(path)
        yield from (found for name in (*STYLES, IGNORED) if workspace.setting(found := join(path, name)))


def _copied(batch: Batch) -> dict[str, str]:
    return {f"./{f.path}": f.path for f in batch.files if len(f.path.encode()) <= copies.LONGEST}


def _regions(text: bytes, spans: Iterable[tuple[int, int]]) -> list[tuple[int, int, int]]:
    """First line, last line and first column of the places that *spans* (offset and length) touch.

    Lines that follow each other without one between them are one place.
    """
    regions: list[tuple[int, int, int]] = []
    line, begin, at = 1, 0, 0  # the line that holds the byte *at*, and where it begins
    for offset, length in sorted(spans):
        while 0 <= (end := text.find(b"\n", at, offset)):
            line, begin, at = line + 1, end + 1, end + 1
        last = line + text.count(b"\n", offset, offset + length)
        if regions and line <= regions[-1][1] + 1:
            regions[-1] = (regions[-1][0], max(last, regions[-1][1]), regions[-1][2])
        else:
            regions.append((line, last, len(text[begin:offset].decode("utf-8", "replace")) + 1))
    return regions
