# SPDX-License-Identifier: Apache-2.0
"""What checks said of parts of a revision (``checking.unseen``), kept for a change that moves lines of C++ alone: the rest of the model is the same there (``same_model``)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import partial
from hashlib import blake2b

import msgspec

from haros_ci.analysis.architectures import project_of
from haros_ci.analysis.kept_runs import GROUP, key_of
from haros_ci.analysis.same_model import Moved
from haros_ci.checking.checked import Checked
from haros_ci.checking.cpp_texts import CppTexts
from haros_ci.checking.includes import includes, is_for_moc
from haros_ci.checking.project import Project
from haros_ci.checking.system import systems
from haros_ci.checking.unseen import Held, Part, hidden_in, refuse, without_text
from haros_ci.code.codebase import codebase
from haros_ci.keeping.moves import Lines
from haros_ci.model.access import AccessRule
from haros_ci.model.build import Build
from haros_ci.model.workspace import Store, Workspace
from haros_ci.records import dataclass
from haros_ci.results import own
from haros_ci.results.values import NotThat, plain, read
from haros_ci.systems.link import Linked

NAME = "unseen"


@dataclass(frozen=True, slots=True)
class Kept:
    """What is kept of a revision: a digest of what its packages build, what was found without C++, and with its programs, for which *words* were looked up and files *read*."""

    built: str
    without: Held
    with_programs: Held
    words: frozenset[str]
    read: frozenset[str]


@dataclass(frozen=True, slots=True)
class KeptFindings:
    """Findings in *store*, under *settings*, a digest of all that they depend on besides the files."""

    settings: str
    store: Store

    def get(self, base: Workspace, workspace: Workspace, built: Mapping[str, Build], moved: Moved) -> Held | None:
        """What is kept of *base* and holds in *workspace*, where code has *moved*; None if nothing is kept, or more than C++ files is another.

        What was said of a place in a changed file, or names one, is said anew.
        """
        if not moved.changed <= hidden_in(base):
            return None
        key = self._key(base)
        try:
            kept: Kept = read(Kept, self.store.get(GROUP, f"{NAME} {key}", key))
        except (NotThat, RecursionError):
            return None
        found = (kept.without, kept.with_programs)
        if kept.built != _digest(built) or any(one.tool != own.TOOL for held in found for one in held.results):
            return None
        texts = ((path, base.text(path), workspace.text(path), moved.lines.get(path)) for path in moved.changed)
        is_alike = (
            moved.is_all and moved.changed.isdisjoint(kept.read) and all(_is_alike(*text, kept.words) for text in texts)
        )
        return _elsewhere(found if is_alike else found[:1], moved.changed)

    def put(self, workspace: Workspace, built: Mapping[str, Build], *checked: Checked) -> None:
        """Keep what was found on parts of *workspace*."""
        sets = zip(*(one.unseen for one in checked), strict=True)
        programs, texts, words, files = (frozenset[str]().union(*ids) for ids in sets)
        kept = Kept(_digest(built), Held.found(programs, checked), Held.found(texts, checked), words, files)
        key = self._key(workspace)
        self.store.put(GROUP, f"{NAME} {key}", key, plain(kept))

    def _key(self, workspace: Workspace) -> str:
        return key_of(NAME, f"{self.settings} {sorted(workspace.unfetched)}", workspace)


def parts_of(made: Linked, workspace: Workspace, project_file: str, access: tuple[AccessRule, ...]) -> tuple[Part, ...]:
    """What checks are asked on first, of what was *made* of *workspace*; nothing where there is no C++."""
    hidden = hidden_in(workspace)
    if not hidden:
        return ()
    rest = without_text(workspace)
    every = tuple(systems(made.architecture, rest))
    words, files = set[str](), set[str]()
    ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}

    def noted(path: str) -> str:
        if path in hidden:
            files.add(path)
        return workspace.text(path)

    code = partial(codebase, made.sources, noted, ros, workspace.text, words)
    seen = partial(project_of, made, rest, every, _no_base, project_file=project_file, access=access)
    cpp_texts = CppTexts(workspace.text, noted, words)
    without = Part(seen(hidden=hidden, code=refuse), every)
    return without, Part(seen(code=code, cpp_texts=cpp_texts), every, True, words, files)


def _no_base() -> Project | None:
    refuse()


def _is_alike(path: str, before: str, now: str, lines: Lines | None, words: Iterable[str]) -> bool:
    """Whether two texts of the file at *path* are the same for what parts look up in them: words, and includes on their new *lines*."""
    whole = set(re.findall(r"\w+", before)), set(re.findall(r"\w+", now))
    if any((word in before) != (word in now) or (word in whole[0]) != (word in whole[1]) for word in words):
        return False
    moved = [
        (one.header, one.is_quoted, (lines or {}).get(one.location.line or 0, one.location.line), one.location.column)
        for one in includes(path, before)
    ]
    after = [(one.header, one.is_quoted, one.location.line, one.location.column) for one in includes(path, now)]
    return moved == after and is_for_moc(before) == is_for_moc(now)


def _elsewhere(found: Iterable[Held], changed: Iterable[str]) -> Held:
    """What was *found*, without the checks that name a *changed* file in what they found, or in a graph of it."""
    every = tuple(found)
    names = tuple(path.rpartition("/")[2] for path in changed)
    drawn = {one.name for held in every for one in held.graphs if any(name in repr(one) for name in names)}
    results = [one for held in every for one in held.results]
    there = {one.rule for one in results if one.graph in drawn or any(name in repr(one) for name in names)}
    ids = frozenset(id for held in every for id in held.checks) - there
    graphs = {graph.name: graph for held in every for graph in held.graphs}
    return Held(ids, tuple(one for one in results if one.rule in ids), tuple(graphs[name] for name in sorted(graphs)))


def _digest(built: Mapping[str, Build]) -> str:
    """A digest of what the packages build."""
    return blake2b(msgspec.msgpack.encode(dict(built)), digest_size=16).hexdigest()
