# SPDX-License-Identifier: Apache-2.0
"""What the history of HEAD says of directories: which of their files have been changed since they came, and who has written commits.

Somebody's package that was put into a workspace has come in one commit, and has stayed as it came but for a few files. History tells that
only where all of it is there: nothing is said of a shallow clone, nor of a history that is longer than what is read.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from haros_ci.records import dataclass
from haros_ci.workspace.git import GitError, Repository, repository_of, run_git
from haros_ci.workspace.selection import parents

#: Commits of the longest history that is read, and bytes of what git prints of it.
MOST_COMMITS = 3_000
MAX_LOG = 40_000_000
#: Of so many files of a directory one may have been changed.
FEW = 8
_MANIFEST = "package.xml"

_FORMAT = "--format=%x01%H%x02%an%x02%ae"


@dataclass(frozen=True, slots=True)
class Imports:
    """The directories that have come in one commit and are nearly *unchanged*, with the files that are not as they came.

    *changes* is in how many commits files of the others were changed, *authors* are those of all commits (names and addresses).
    """

    unchanged: Mapping[str, frozenset[str]]
    changes: Mapping[str, int]
    authors: frozenset[str]


NOTHING = Imports({}, {}, frozenset())


@dataclass(frozen=True, slots=True)
class _Commit:
    name: str
    authors: tuple[str, ...]
    #: The letter of each entry with the path, and the one that it was moved from.
    entries: tuple[tuple[str, str, str], ...]


def imports(root: Path, directories: Iterable[str]) -> Imports:
    """What the history of the repository that *root* (absolute) lies in says of *directories* below it; NOTHING where it cannot be had as a whole."""
    top = repository_of(root)
    if top is None or not root.is_relative_to(top):
        return NOTHING
    repository = Repository(top)
    prefix = "" if root == top else f"{root.relative_to(top).as_posix()}/"
    try:
        most = f"--max-count={MOST_COMMITS + 1}"
        if repository.is_shallow or int(run_git(repository, "rev-list", "--count", most, "HEAD")) > MOST_COMMITS:
            return NOTHING
        listed = run_git(repository, "ls-tree", "-r", "-z", "--name-only", "--full-tree", "HEAD", limit=MAX_LOG)
        log = run_git(
            repository,
            *("log", "-z", "--topo-order", "--no-ext-diff", "--no-textconv", "--ignore-submodules", "--no-show-signature"),
            *("--name-status", "-M100%", "-l0", _FORMAT, "HEAD"),
            limit=MAX_LOG,
        )  # fmt: skip
    except GitError:
        return NOTHING
    paths = (os.fsdecode(name) for name in listed.split(b"\0") if name)
    below = [path for path in paths if path.startswith(prefix)]
    return _judged(_commits(log), below, prefix, frozenset(directories))


def _commits(log: bytes) -> Iterator[_Commit]:
    """The commits that git prints with ``-z``: a header, and for each entry its letter, the path, and behind a move two of them."""
    tokens = iter(log.split(b"\0"))
    header = b""
    entries: list[tuple[str, str, str]] = []
    for token in tokens:
        word = token.lstrip(b"\n")
        if word.startswith(b"\1"):
            if header:
                yield _commit(header, entries)
            header, entries = word, []
        elif word:
            old = os.fsdecode(next(tokens, b"")) if word[:1] in b"RC" else ""
            entries.append((os.fsdecode(word[:1]), os.fsdecode(next(tokens, b"")), old))
    if header:
        yield _commit(header, entries)


def _commit(header: bytes, entries: Iterable[tuple[str, str, str]]) -> _Commit:
    name, *authors = header[1:].decode("utf-8", "replace").split("\2")
    return _Commit(name, tuple(authors), tuple(entries))


def _judged(commits: Iterable[_Commit], paths: Iterable[str], prefix: str, directories: frozenset[str]) -> Imports:
    """The files at *paths* of HEAD followed backwards through *commits*, newest first."""
    by_home: dict[str, list[str]] = defaultdict(list)
    for path in paths:
        above = parents(path.removeprefix(prefix))
        by_home[next((directory for directory in above if directory in directories), "")].append(path)
    files = _Files({path: [path] for every in by_home.values() for path in every}, {}, defaultdict(set))
    authors: set[str] = set()
    for commit in commits:
        authors.update(commit.authors)
        files.go_back(commit)
    unchanged: dict[str, frozenset[str]] = {}
    changes: dict[str, int] = {}
    for home, every in by_home.items():
        touched = files.touched(every)
        manifest = f"{prefix}{home}/{_MANIFEST}"
        if home and touched is not None and manifest not in touched and FEW * len(touched) <= len(every):
            unchanged[home] = frozenset(path.removeprefix(prefix) for path in touched)
        else:
            changes[home] = len(frozenset[str]().union(*(files.changed.get(path, ()) for path in every)))
    return Imports(unchanged, changes, frozenset(authors))


@dataclass(frozen=True, slots=True)
class _Files:
    """Files of HEAD by the names that they had *at* some commit, the commit that each *came* in, and those in which it was *changed*."""

    at: dict[str, list[str]]
    came: dict[str, str]
    changed: defaultdict[str, set[str]]

    def go_back(self, commit: _Commit) -> None:
        """To the names before *commit*."""
        moved: list[tuple[str, list[str]]] = []
        for letter, path, old in commit.entries:
            here = self.at.get(path)
            if here is None or letter not in "AMTRC":
                continue
            for final in here:
                if letter in "MT":
                    self.changed[final].add(commit.name)
                elif letter in "AC":
                    self.came[final] = commit.name
            if letter not in "MT":
                del self.at[path]
            if letter == "R":
                moved.append((old, here))
        for old, here in moved:
            self.at.setdefault(old, []).extend(here)

    def touched(self, paths: Iterable[str]) -> frozenset[str] | None:
        """Those of *paths* that were changed; None if not all came in one commit that is seen: who adds files to a package works on it."""
        paths = tuple(paths)
        came = {self.came.get(path) for path in paths}
        return None if len(came) != 1 or None in came else frozenset(path for path in paths if path in self.changed)
