# SPDX-License-Identifier: Apache-2.0
"""Whether two revisions have the same model, without making both: where comments, empty lines and idle statements are all that a change touches."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import pairwise

from haros_ci.analysis.idle_lines import idle_lines
from haros_ci.analysis.kept_runs import state
from haros_ci.analysis.programs import facts_at, programs, read_facts
from haros_ci.coverage.blanked import uncommented
from haros_ci.index.idle import Idle, idle_in
from haros_ci.index.mentions import last
from haros_ci.keeping.moves import Lines, moves
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded
from haros_ci.workspace.base import Base
from haros_ci.workspace.build import builds

#: Languages whose files are programs: the model knows of their texts only what the programs have, and where it stands.
CODE = ("cpp", "python")
#: What tells a program on which line it stands.
LINE_NUMBERS = ("__LINE__", "source_location", "lineno")


#: What is idle in a workspace, and the last parts of the names of its functions and classes.
Known = tuple[Idle, frozenset[str]]
_WORD = regex(r"\w+")


@dataclass(frozen=True, slots=True)
class Moved:
    """The new line of each old one that has code, by the files in which any moved; *is_all*: nothing that is compiled is another.

    *changed* are the paths of all files that are not the same bytes.
    """

    lines: dict[str, Lines]
    is_all: bool
    changed: frozenset[str] = frozenset()


def moved_lines(base: Base, workspace: Workspace, store: Store) -> Moved | None:
    """The lines to which code has moved, where the model of *base* is that of *workspace* but for these; else None.

    So it is where all files are the same but for those of code whose programs only moved: the same text without comments and empty lines, in
    the same columns, lines in the same order; or the same without idle statements (``index.idle``), too. Where that is not certain there is None.
    """
    if base.renames:
        return None
    before = {file.path: file for file in base.workspace.files}
    changed = [file for file in workspace.files if file.path in before and before[file.path].digest != file.digest]
    if any(file.language not in CODE for file in changed):
        return None
    paths = {file.path for file in changed}
    if state(_without(base.workspace, paths)) != state(_without(workspace, paths)):
        return None

    @cache
    def known() -> Known:
        sources = programs(base.workspace, builds(base.workspace), store, [])
        functions = {last(item.name) for source in sources for item in source.program.functions}
        classes = {last(item.name) for source in sources for item in source.program.classes}
        return idle_in(sources), frozenset(functions | classes)

    found: dict[str, Lines] = {}
    is_all = True
    for file in changed:
        texts = base.workspace.text(file.path), workspace.text(file.path)
        language = file.language or ""
        if any(word in texts[1] for word in LINE_NUMBERS):
            return None
        old, new = _program_of(base.workspace, before[file.path], store), _program_of(workspace, file, store)
        lines = _same_text(_lines_of(texts[0], language), _lines_of(texts[1], language))
        if lines is None and old is not None and new is not None and language == "cpp":
            is_all = False
            lines, old, new = _same_but_idle(texts, old, new, known())
        if lines is None or not _only_moved(old, new):
            return None
        if any(was != now for was, now in lines.items()):
            found[file.path] = lines
    return Moved(found, is_all, frozenset(paths))


def _without(workspace: Workspace, paths: set[str]) -> Workspace:
    """*workspace* without what the files at *paths* hold."""
    files = tuple(replace(file, digest="") if file.path in paths else file for file in workspace.files)
    return replace(workspace, files=files)


Written = list[tuple[int, str]]


def _same_text(old: Written, new: Written) -> Lines | None:
    """The new line of each old one; None if these are not the same, each at its columns."""
    if [text for _, text in old] != [text for _, text in new]:
        return None
    return {was: now for (was, _), (now, _) in zip(old, new, strict=True)}


def _same_but_idle(
    texts: tuple[str, str], old: Program, new: Program, known: Known
) -> tuple[Lines | None, Program, Program]:
    """The new line of each old one that has more than idle statements; None if these are not the same. And the programs without them.

    Nor are they if what is added or gone has the name of a function or class: texts are asked who is named in them.
    """
    idle, names = known
    sides: list[Written] = []
    idle_ones: list[Counter[str]] = []
    bare = idle.program(old), idle.program(new)
    for text, program, rest in zip(texts, (old, new), bare, strict=True):
        gone = idle_lines(text, program, rest)
        sides.append([(number, line) for number, line in _lines_of(text, "cpp") if number not in gone])
        idle_ones.append(Counter(gone.values()))
    others = (idle_ones[0] - idle_ones[1]) + (idle_ones[1] - idle_ones[0])
    is_named = any(not names.isdisjoint(_WORD.findall(line)) for line in others)
    return None if is_named else _same_text(sides[0], sides[1]), *bare


def _lines_of(text: str, language: str) -> list[tuple[int, str]]:
    """The lines of *text* that have more than comments, with their numbers."""
    lines = enumerate((line.rstrip() for line in uncommented(text, language).split("\n")), 1)
    return [(number, line) for number, line in lines if line]


def _program_of(workspace: Workspace, file: SourceFile, store: Store) -> Program | None:
    """The program of a file, from *store*, which has it then."""
    text = store.get_text(*facts_at(file))
    if text is None and (text := read_facts(workspace, file.path, file.language or "")):
        store.put_text(*facts_at(file), text)
    return decoded(text)


def _only_moved(before: Program | None, now: Program | None) -> bool:
    if before is None or now is None:
        return False
    try:
        found = moves(before, now)
    except RecursionError:
        return False
    return found is not None and not found.functions and _keeps_order(found.lines)


def _keeps_order(lines: Lines) -> bool:
    """Whether what stood on two lines still does, in the same order."""
    return all(one < other for one, other in pairwise(lines[line] for line in sorted(lines)))
