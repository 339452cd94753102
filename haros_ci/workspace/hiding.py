# SPDX-License-Identifier: Apache-2.0
"""What a change does that would keep its files from being analysed, as warnings, notes and findings."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path

from haros_ci.model.package import OTHER, Package
from haros_ci.model.workspace import FirstUse, Hiding, Problem, Workspace
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.files import FileTree
from haros_ci.workspace.language import language_of, suffix_of
from haros_ci.workspace.listing import PathListing
from haros_ci.workspace.noted_files import MAX_NAMED, named, noted
from haros_ci.workspace.object_name import object_name
from haros_ci.workspace.past import Past
from haros_ci.workspace.selection import (
    IGNORED_WITHOUT,
    MARKERS,
    AnalysedPaths,
    CandidatePath,
    is_never_source,
    output_directories,
    parents,
)
from haros_ci.workspace.used_code import UsedCode, is_opaque
from haros_ci.workspace.used_names import CODE
from haros_ci.workspace.views import doubles

#: Kinds of files that tools' own directories hold (``.github``): there they are named only if the directory is new.
_DATA = frozenset(("yaml", "xml", "dockerfile", "shell", "setup"))
_UNTOLD = frozenset(("markdown", OTHER))
_MANIFEST = "package.xml"


class TrackedChange:
    """The difference between the base revision and the files that git tracks now.

    It is what selection asks whether a marker counts (``selection.Standing``).
    """

    def __init__(self, root: Path, past: Past, listing: PathListing) -> None:
        self.root = root
        self._tree = FileTree(root)
        self.base = past.entries
        self.tracked = listing.tracked
        self.executables = listing.executables
        self.is_known = past.is_known
        self.listed = listing.paths
        self.submodules = listing.submodules

    def counts(self, path: str) -> bool:
        """Whether what the marker at *path* does counts: it was there before, or it was made on this machine."""
        return path in self.base or path not in self.tracked

    def has_changed(self, path: str) -> bool:
        """Whether the tracked file at *path* has other contents on disk than in the base, or was not there.

        A file that has moved as it was has not changed. What git made of it by the attributes of the base has not, either.
        """
        if path not in self.tracked:
            return False
        before = self.base.get(path)
        name = self._object_name(path)
        if name is None or name == before:
            return False
        if before is not None and before == self.tracked[path] and self._has_same_attributes:
            return False
        is_as_it_moved = path.isprintable() and not os.path.islink(
            f"{self.root}/{path}"
        )  # else the path is what is wrong
        return not is_as_it_moved or (language_of(path.rpartition("/")[2]), name) not in self._contents

    @cached_property
    def _contents(self) -> frozenset[tuple[str | None, str]]:
        return frozenset((language_of(path.rpartition("/")[2]), name) for path, name in self.base.items())

    @cached_property
    def _has_same_attributes(self) -> bool:
        """Whether there are .gitattributes, none of which has changed: they can convert what is checked out."""

        def of(entries: Iterable[tuple[str, str]]) -> set[tuple[str, str]]:
            return {(path, name) for path, name in entries if path.rpartition("/")[2] == ".gitattributes"}

        before = of(self.base.items())
        return bool(before) and before == of(self.tracked.items())

    def _object_name(self, path: str) -> str | None:
        try:
            return object_name(self._tree.place(path), len(self.tracked[path]))
        except (OSError, ValueError):
            return ""  # it is there, and nobody can say that it is as it was

    def applied_to(
        self, workspace: Workspace, candidates: Collection[CandidatePath], scope: AnalysedPaths, excludes: Excludes
    ) -> Workspace:
        """*workspace*, which was made of *candidates*, with all that is to be said of the change."""
        analysed = {file.path: file.language for file in workspace.files}
        used = UsedCode(workspace)
        aside = self._aside(candidates, scope, excludes)
        reached = [path for path, directory in aside.items() if used.reaches(path, directory)]
        others = self._changed_without_code(analysed, scope, excludes) if self.is_known else []
        code = {path: why for path in others if (why := used.why(path)) and self.has_changed(path)}
        unread = (
            *self._led_away(workspace.links, analysed, excludes),
            *(Problem(path, f"skipped: {why}") for path, why in code.items()),
            *(self._stray_launch_files(used, analysed) if self.is_known else ()),
            *(Problem(path, f"skipped: it lies in {aside[path]}, which is never analysed") for path in reached),
            *self._new_submodules(scope),
        )
        databases = sorted(
            path for path in self.tracked if _is_database(path) and self.is_known and self.has_changed(path)
        )
        hiding = Hiding(
            warnings=tuple(self._warnings(candidates, scope)),
            notes=(
                *self._notes(sorted(aside.keys() - {*reached}), scope),
                *noted(others, code, used, self.has_changed, self._tree),
                *(Problem(path, "a compile database that the change brings is not read") for path in databases),
            ),
            unread=(*workspace.hiding.unread, *unread),
            used=tuple(self._first_used(used, analysed, scope, excludes)),
            later=tuple(sorted(package.path for package in workspace.packages if self._is_new(package))),
            databases=tuple(databases),
        )
        return replace(workspace, hiding=hiding, problems=tuple(self._problems(workspace, hiding.later)))

    def _first_used(
        self, used: UsedCode, analysed: Mapping[str, str], scope: AnalysedPaths, excludes: Excludes
    ) -> Iterator[FirstUse]:
        """The files that are as they were, here or elsewhere, and that are code by what changed files say of them."""
        names = used.names_in(path for path in analysed if self.is_known and self.has_changed(path))
        words = names | {word for name in names for word in name.split(".")}
        outputs = output_directories(self.listed, self) if names else frozenset()
        for path, name in sorted(self.tracked.items()) if names else ():
            file = path.rpartition("/")[2]
            directory = self._never_analysed(path, outputs)
            stem = file.partition(".")[0]
            is_named = file in names or ((directory or is_opaque(path)) and stem in words)
            is_named |= bool(directory) and directory.rpartition("/")[2] in words
            if not is_named or analysed.get(path) in CODE or scope.given(path) is None or _excluded(path, excludes):
                continue
            if self.base.get(path) == name:
                origins: tuple[str, ...] = (path,)
            elif path not in self.base and not self.has_changed(path):
                origins = tuple(old for old, it in self.base.items() if it == name)[:MAX_NAMED]
            else:
                continue
            if directory and self._is_code(path, is_old=True) and used.reaches(path, directory):
                why = f"it lies in {directory}, which is never analysed"
                yield FirstUse(Problem(path, f"skipped: {why}"), origins, directory)
            elif not directory and (why := used.why(path)):
                yield FirstUse(Problem(path, f"skipped: {why}"), origins)

    def _is_new(self, package: Package) -> bool:
        """Whether the change brings the package: a manifest that is not in the base revision, or differs there."""
        manifest = _manifest(package.path)
        if manifest not in self.tracked:
            return False
        before = self.base.get(manifest)
        return before is None or before not in (self.tracked[manifest], self._object_name(manifest))

    def _problems(self, workspace: Workspace, later: Collection[str]) -> Iterable[Problem]:
        """The problems of *workspace*, with those packages left out of several of one name that the change brings."""
        before = frozenset(doubles(workspace.packages, workspace.files))
        if not before:
            return workspace.problems
        kept = (problem for problem in workspace.problems if problem not in before)
        every = (*kept, *doubles(workspace.packages, workspace.files, later))
        return sorted(every, key=lambda problem: (problem.path, problem.line or 0, problem.message))

    def _warnings(self, chosen: Iterable[CandidatePath], scope: AnalysedPaths) -> Iterator[Problem]:
        """One for each directory that would be left out but for the base revision."""
        without, counted = output_directories(self.listed), output_directories(self.listed, self)
        kept = sorted(without - counted)
        paths = [c.path for c in chosen if c.path in self.tracked and c.language not in (None, *_UNTOLD)]
        paths = [path for path in paths if path.rpartition("/")[2] not in MARKERS - IGNORED_WITHOUT]
        for directory in kept:
            above = {*parents(directory)}
            if directory in (".", *scope.directories) or above & set(kept) or above & counted:
                continue
            if files := [path for path in paths if path.startswith(f"{directory}/")]:
                verb = "is" if len(files) == 1 else "are"
                yield Problem(directory, f"{self._cause(directory)}; {_files(files)} below it {verb} analysed")

    def _cause(self, directory: str) -> str:
        """Why *directory* would be left out."""
        parent = directory.rpartition("/")[0] or "."
        for place in (directory, parent):
            prefix = "" if place == "." else f"{place}/"
            names = sorted(MARKERS - IGNORED_WITHOUT)
            if added := [name for name in names if prefix + name in self.tracked and prefix + name not in self.base]:
                return f"{prefix}{added[0]} does not count, as the base revision does not have it"
            listed = set(self.listed)
            if removed := [n for n in sorted(IGNORED_WITHOUT) if prefix + n in self.base and prefix + n not in listed]:
                return f"it stays a directory of sources, though {prefix}{removed[0]} is gone"
        return "it stays a directory of sources, though it looks like the output of a build now"

    def _notes(self, aside: list[str], scope: AnalysedPaths) -> Iterator[Problem]:
        """One for each submodule that is at another commit and not there, one for all changed files *aside*, which nothing analysed refers to."""
        if not self.is_known:
            return
        for path in self._away(scope):
            if path in self.base:
                text = "the change sets this submodule to another commit, which is not checked out: nothing of it is analysed"
                yield Problem(path, f"{text}; check it out (git submodule update --init)")
        if aside:
            verb = "lies" if len(aside) == 1 else "lie"
            yield Problem(
                ".",
                f"{_plural(len(aside), 'changed file')} {verb} in directories that are never analysed: {named(aside)}",
            )

    def _new_submodules(self, scope: AnalysedPaths) -> Iterator[Problem]:
        """One for each submodule that was none: what it brings, perhaps in the place of files that were here, is not there to be analysed."""
        if self.is_known:
            text = (
                "skipped: a submodule that is not checked out; check it out (git submodule update --init), or add it to .gitmodules first "
                "if that does not name it"
            )
            yield from (Problem(path, text) for path in self._away(scope) if path not in self.base)

    def _away(self, scope: AnalysedPaths) -> list[str]:
        """The submodules in *scope* that are not at the base's commit, and not checked out."""
        return sorted(
            path
            for path in self.submodules
            if self.base.get(path) != self.tracked.get(path) and scope.given(path) is not None
            if not os.path.lexists(f"{self.root}/{path}/.git")
        )

    def _aside(self, chosen: Iterable[CandidatePath], scope: AnalysedPaths, excludes: Excludes) -> dict[str, str]:
        """The changed files of code that lie in directories that are never analysed, by path, each with the outermost of these."""
        if not self.is_known:
            return {}
        read = {candidate.path for candidate in chosen}
        outputs = output_directories(self.listed, self)
        known = {parent for path in self.base for parent in parents(path)}
        aside: dict[str, str] = {}
        for path, name in sorted(self.tracked.items()):
            if path in read or self.base.get(path) == name or scope.given(path) is None or path in self.submodules:
                continue
            hidden = self._never_analysed(path, outputs)
            if hidden and self._is_code(path, hidden in known) and not _excluded(path, excludes):
                aside[path] = hidden
        return aside

    def _stray_launch_files(self, used: UsedCode, analysed: Collection[str]) -> Iterator[Problem]:
        for path in sorted(analysed):
            if path in self.tracked and path not in self.base and (kind := used.kind_of_stray_launch(path)):
                text = "skipped: a launch file by its text, not by its name, which nothing includes"
                yield Problem(path, f"{text}; call it .launch.{kind}")

    def _changed_without_code(self, analysed: Mapping[str, str], scope: AnalysedPaths, excludes: Excludes) -> list[str]:
        """The changed files in *scope* that are not analysed as C++ or Python, nor called so."""
        return [
            path
            for path, name in sorted(self.tracked.items())
            if self.base.get(path) != name and path not in self.submodules and scope.given(path) is not None
            if language_of(path.rpartition("/")[2]) not in CODE and analysed.get(path) not in CODE
            if not _excluded(path, excludes)
        ]

    def _never_analysed(self, path: str, outputs: frozenset[str]) -> str:
        """The outermost directory around *path* that is never entered, "" without one."""
        found = ""
        for directory in parents(path):
            if is_never_source(directory.rpartition("/")[2]) or directory in outputs:
                found = directory
        return found

    def _is_code(self, path: str, is_old: bool) -> bool:
        """Whether it would be analysed elsewhere; *is_old* for a directory that the base has, too."""
        name = path.rpartition("/")[2]
        language = language_of(name)
        if language is None:
            return path in self.executables and not suffix_of(name)
        return language not in _UNTOLD and not (is_old and language in _DATA)

    def _led_away(
        self, links: Iterable[tuple[str, str]], analysed: dict[str, str], excludes: Excludes
    ) -> Iterator[Problem]:
        """A problem for each changed link, named as source, that leads to a file that is not analysed as such."""
        for path, target in links:
            language = language_of(path.rpartition("/")[2])
            if language is None or language in _UNTOLD or not self.has_changed(path):
                continue
            found = analysed.get(target)
            if found is not None and (found == language or language not in ("cpp", "python")):
                continue
            if not _excluded(target, excludes) and os.path.isfile(f"{self.root}/{target}"):
                yield Problem(path, f"skipped: a symbolic link to {target}, which is not analysed as {language}")


def _excluded(path: str, excludes: Excludes) -> bool:
    return excludes.match(path, is_directory=False) or any(
        excludes.match(directory, is_directory=True) for directory in parents(path)
    )


def _is_database(path: str) -> bool:
    """Whether the file at *path* is a compile database by its name: what it says steers what linters are given."""
    return path.rpartition("/")[2].startswith("compile_commands") and path.endswith(".json")


def _files(paths: list[str]) -> str:
    return f"{_plural(len(paths), 'file')} ({named(paths)})"


def _plural(number: int, noun: str) -> str:
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def _manifest(directory: str) -> str:
    return _MANIFEST if directory == "." else f"{directory}/{_MANIFEST}"
