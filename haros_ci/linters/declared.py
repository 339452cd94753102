# SPDX-License-Identifier: Apache-2.0
"""Tools that a trusted project file declares, as linters like any other (docs/declared-tools.md)."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from posixpath import normpath

from haros_ci.linters import installed
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, Unread, When
from haros_ci.linters.tool_text import MAX_RULE, ToolFinding, clean, read
from haros_ci.model.declared_tool import FILE, FILES, ROOT, DeclaredTool
from haros_ci.model.location import Location
from haros_ci.model.package import LANGUAGES, OTHER, SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

#: Bytes of a program file that count for the cache: scripts often tell no version, large programs do.
MAX_SCRIPT = 1_000_000
#: Beginnings of words for levels that need no ``levels``.
WORDS = (
    ("err", "error"),
    ("fatal", "error"),
    ("critical", "error"),
    ("warn", "warning"),
    ("info", "note"),
    ("note", "note"),
)
#: Keeps ``python -m tool`` from taking modules out of the workspace, in which it is started (Python 3.11).
ENVIRONMENT = {"PYTHONSAFEPATH": "1", "NO_COLOR": "1"}


def declared(tools: Iterable[DeclaredTool]) -> tuple[DeclaredLinter, ...]:
    """A linter for each of *tools*. The caller answers for it that the user trusts the file that declares them."""
    return tuple(DeclaredLinter(tool) for tool in tools)


class DeclaredLinter:
    """An adapter as linter.py describes it. The user trusts the tool, so it gets the workspace itself and no sandbox."""

    TRUSTED = True

    def __init__(self, tool: DeclaredTool) -> None:
        self.tool = tool
        self.NAME = tool.name
        #: By glob a tool may be for files of any kind.
        self.LANGUAGES = frozenset((*LANGUAGES, OTHER)) if tool.files else frozenset(tool.languages)
        self.WHEN = When.ALWAYS
        self.COST = 5.0

    def locate(self, options: LintOptions) -> Program | None:
        """On PATH, and outside the workspace; a program given with a path is taken from there, below the root if relative."""
        place = _place(self.tool, options)
        return None if place is None else Program((place, *self.tool.argv[1:]), installed.version_of(place) or "")

    def fingerprint(self, workspace: Workspace, options: LintOptions) -> str:
        tool = self.tool
        script = _digest(_place(tool, options))
        reading = [tool.output, tool.pattern, tool.fields, tool.levels, tool.stream, tool.exits, tool.reads]
        return json.dumps([tool.argv, reading, script])

    def dependencies(self, workspace: Workspace, file: SourceFile) -> Iterable[str]:
        return ()  # plan() knows them all

    def plan(self, workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
        """A unit for each file; where the tool is not given files, one unit for all of them together."""
        files = [file for file in workspace.files if self.tool.claims(file.path, file.language)]
        needs = self._needs(workspace)
        if FILES in self.tool.argv:
            yield from (Unit(file, dependencies=needs) for file in files)
        elif any(FILE in argument for argument in self.tool.argv):
            yield from (Unit(file, group=file.path, dependencies=needs) for file in files)
        elif files:
            others = tuple(file.path for file in files[1:])
            yield Unit(files[0], dependencies=tuple(sorted({*others, *needs})), covers=others)

    def command(self, program: Program, batch: Batch) -> Command:
        root = os.path.realpath(batch.options.root or batch.workspace.root)
        paths = [f"./{file.path}" for file in batch.files]
        argv: list[str] = []
        for argument in program.argv:
            if argument == FILES:
                argv += paths
            else:
                argv.append(argument.replace(ROOT, root).replace(FILE, paths[0]))
        return Command(tuple(argv), environment=ENVIRONMENT)

    def parse(self, output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
        if self.tool.exits and output.code not in self.tool.exits:
            raise ValueError(f"exit code {output.code}")
        data = self._written(output)
        if output.code and not data.strip():
            raise Unread(f"exit code {output.code}, and nothing was written")
        found = self._sarif if self.tool.output == "sarif" else self._text
        yield from found(data, output.code, batch)

    def _written(self, output: Output) -> bytes:
        streams = {"stdout": output.stdout, "stderr": output.stderr, "both": output.stdout + b"\n" + output.stderr}
        return streams[self.tool.stream]

    def _text(self, data: bytes, code: int, batch: Batch) -> Iterator[Finding]:
        places = _OutputPlaces(batch, self.tool)
        count = 0
        for entry in read(self.tool, data):
            count += 1
            place = _location(entry, places)
            level = self.level_of(entry.level)
            message = clean(entry.message)
            if place is None or level is None or not message:
                continue
            rule = clean(entry.rule, MAX_RULE) or clean(entry.level, MAX_RULE).lower().replace(" ", "-") or "finding"
            notes = ((_location(note, places), clean(note.message)) for note in entry.notes[:100])
            related = tuple(Related(where, text) for where, text in notes if where is not None and text)
            yield Finding(places.unit(place.path), Result(self.NAME, rule, level, message, place, related=related))
        if code and not count and self.tool.output in ("gcc", "regex"):
            raise Unread(f"exit code {code}, and no line of its output is a finding")

    def _sarif(self, data: bytes, code: int, batch: Batch) -> Iterator[Finding]:
        from haros_ci.results.sarif_reader import read_sarif

        places = _OutputPlaces(batch, self.tool)
        for run in read_sarif(data, "its output", root=os.path.realpath(batch.workspace.root)):
            if not run.successful:
                raise Unread("its log says that it did not succeed")
            for result in run.results:
                path = places.known(result.location.path)
                level = self.level_of(result.level.value) if self.tool.levels else result.level
                if path is not None and level is not None:
                    rule, message = clean(result.rule, MAX_RULE), clean(result.message)
                    again = Result(self.NAME, rule, level, message, result.location, related=result.related)
                    yield Finding(places.unit(path), again)

    def level_of(self, word: str) -> Level | None:
        """What the tool's *word* for a level stands for; None for ``off``."""
        levels = dict(self.tool.levels)
        known = levels.get(word) or levels.get(word.lower()) or levels.get("*")
        if known is None:
            lower = word.strip().lower()
            known = next((level for start, level in WORDS if lower.startswith(start)), "warning")
        return None if known == "off" else Level(known)

    def _needs(self, workspace: Workspace) -> tuple[str, ...]:
        """The files that results depend on besides: those under ``reads``, and those that the command line names."""
        arguments = {a.removeprefix(f"{ROOT}/") for arg in self.tool.argv for a in (arg, arg.partition("=")[2])}
        named = {a.removeprefix("./") for a in arguments if a and not a.startswith(("/", "-", "{"))}
        named = {a for a in named if ".." not in a.split("/") and workspace.text(a)}
        files = {*workspace.names, *(file.path for file in workspace.files)} if self.tool.reads else ()
        return tuple(sorted({*named, *(path for path in files if self.tool.depends_on(path))}))


class _OutputPlaces:
    """Which file of the workspace a path in a tool's output means, and whose analysis said it."""

    def __init__(self, batch: Batch, tool: DeclaredTool) -> None:
        self.tool = tool
        self.given = {file.path for file in batch.files}
        self.first = batch.files[0].path
        self.alone = len(batch.files) == 1
        self.whole = not any(FILE in argument or FILES in argument for argument in tool.argv)
        self.languages = {file.path: file.language for file in batch.workspace.files}
        root = batch.workspace.root
        self.roots = tuple(f"{r}/" for r in dict.fromkeys((os.path.realpath(root), os.path.abspath(root))))

    def known(self, path: str) -> str | None:
        """The workspace path, None for what lies elsewhere or is not analysed."""
        for root in self.roots:
            path = path.removeprefix(root)
        if "\0" in path or path.startswith("/"):
            return None
        path = normpath(path)
        return path if path in self.languages else None

    def unit(self, path: str) -> str:
        """The file whose analysis this belongs to. Raises Unread where nobody would notice that *path* has changed."""
        if path in self.given:
            return path
        watched = self.tool.depends_on(path) or (self.whole and self.tool.claims(path, self.languages[path]))
        if not watched:
            raise Unread(f"it reports on {path}, which it was not given: name such files under 'reads'")
        if not self.alone:
            raise Unread(f"of many files at once it reports on {path}: use {FILE} in place of {FILES}")
        return self.first


def _location(entry: ToolFinding, places: _OutputPlaces) -> Location | None:
    path = places.known(entry.path.strip())
    if path is None:
        return None
    if not entry.line:
        return Location(path)
    end = entry.end_line if entry.end_line >= entry.line else 0
    column = entry.column or None
    return Location(path, entry.line, column, end or None, (entry.end_column or None) if column and end else None)


def _place(tool: DeclaredTool, options: LintOptions) -> str | None:
    name = tool.argv[0].replace(ROOT, str(options.root or "."))
    if "/" not in name:
        return installed.on_path(name, options)
    path = os.path.join(options.root or ".", name)
    return path if os.path.isfile(path) and os.access(path, os.X_OK) else None


def _digest(path: str | None) -> str:
    try:
        if path is None or os.path.getsize(path) > MAX_SCRIPT:
            return ""
        with open(path, "rb") as stream:
            return hashlib.sha256(stream.read(MAX_SCRIPT)).hexdigest()
    except OSError:
        return ""
