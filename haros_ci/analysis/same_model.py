# SPDX-License-Identifier: Apache-2.0
"""Whether two revisions have the same model, without making both: where comments and empty lines are all that a change touches."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

from haros_ci.analysis.architecture import facts_at, read_facts
from haros_ci.analysis.kept_runs import state
from haros_ci.coverage.blanked import uncommented
from haros_ci.index.index import Source
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


def has_same_model(base: Base, workspace: Workspace, sources: Iterable[Source], store: Store) -> bool:
    """Whether the model of *base* is that of *workspace*, whose programs are *sources*, but for the lines that things stand on.

    So it is where all files are the same but for those of code whose programs only moved: the same text without comments and empty lines, in
    the same columns, lines in the same order. Where that is not certain the answer is no.
    """
    if base.renames:
        return False
    before = {file.path: file for file in base.workspace.files}
    changed = [file for file in workspace.files if file.path in before and before[file.path].digest != file.digest]
    if any(file.language not in CODE for file in changed):
        return False
    paths = {file.path for file in changed}
    if state(_without(base.workspace, paths)) != state(_without(workspace, paths)):
        return False
    programs = {source.path: source.program for source in sources}
    return all(
        _same_text(base.workspace.text(file.path), workspace.text(file.path), file.language)
        and _only_moved(_program_of(base.workspace, before[file.path], store), programs.get(file.path))
        for file in changed
    )


def _without(workspace: Workspace, paths: set[str]) -> Workspace:
    """*workspace* without what the files at *paths* hold."""
    files = tuple(replace(file, digest="") if file.path in paths else file for file in workspace.files)
    return replace(workspace, files=files)


def _same_text(before: str, now: str, language: str) -> bool:
    if any(word in now for word in LINE_NUMBERS):
        return False
    return _lines_of(before, language) == _lines_of(now, language)


def _lines_of(text: str, language: str) -> list[str]:
    """The lines of *text* that have more than comments, each at its columns."""
    lines = (line.rstrip() for line in uncommented(text, language).split("\n"))
    return [line for line in lines if line]


def _program_of(workspace: Workspace, file: SourceFile, store: Store) -> Program | None:
    """The program of a file, from *store* if it is there."""
    return decoded(store.get_text(*facts_at(file)) or read_facts(workspace, file.path, file.language))


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
