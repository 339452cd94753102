# SPDX-License-Identifier: Apache-2.0
"""Whether two revisions have the same model, without making both: where comments and empty lines are all that a change touches."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from haros_ci.analysis.kept_runs import state
from haros_ci.analysis.programs import facts_at, read_facts
from haros_ci.coverage.blanked import uncommented
from haros_ci.keeping.moves import Lines, moves
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded
from haros_ci.workspace.base import Base

#: Languages whose files are programs: the model knows of their texts only what the programs have, and where it stands.
CODE = ("cpp", "python")
#: What tells a program on which line it stands.
LINE_NUMBERS = ("__LINE__", "source_location", "lineno")


def moved_lines(base: Base, workspace: Workspace, store: Store) -> dict[str, Lines] | None:
    """The new line of each old one that has code, by the files in which any moved, where the model of *base* is that of *workspace* but for these; else None.

    So it is where all files are the same but for those of code whose programs only moved: the same text without comments and empty lines, in
    the same columns, lines in the same order. Where that is not certain there is None.
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
    found: dict[str, Lines] = {}
    for file in changed:
        lines = _same_text(base.workspace.text(file.path), workspace.text(file.path), file.language)
        programs = _program_of(base.workspace, before[file.path], store), _program_of(workspace, file, store)
        if lines is None or not _only_moved(*programs):
            return None
        if any(old != new for old, new in lines.items()):
            found[file.path] = lines
    return found


def _without(workspace: Workspace, paths: set[str]) -> Workspace:
    """*workspace* without what the files at *paths* hold."""
    files = tuple(replace(file, digest="") if file.path in paths else file for file in workspace.files)
    return replace(workspace, files=files)


def _same_text(before: str, now: str, language: str | None) -> Lines | None:
    """The new line of each old one that has more than comments; None if these are not the same, each at its columns."""
    if any(word in now for word in LINE_NUMBERS):
        return None
    old, new = _lines_of(before, language or ""), _lines_of(now, language or "")
    if [text for _, text in old] != [text for _, text in new]:
        return None
    return {was: now for (was, _), (now, _) in zip(old, new, strict=True)}


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
