# SPDX-License-Identifier: Apache-2.0
"""Directories that git leaves empty until somebody fetches what belongs there: submodules that are not checked out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.model.submodules import submodules
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.excludes import Excludes

#: So many directories are named.
_NAMED = 20
_FETCH = "run git submodule update --init --recursive (in GitHub's actions/checkout: submodules: recursive)"


def unfetched(workspace: Workspace, empty: Iterable[str], excludes: Excludes) -> Iterator[Problem]:
    """At most two problems for the directories *empty* that git has as commits of other repositories, those excluded aside.

    One is for the submodules; one for what ``.gitmodules`` does not name, of which no clone can have the files (git-submodule(1): it fails
    with "no submodule mapping found").
    """
    paths = sorted(path for path in empty if not excludes.match(path, is_directory=True))
    known = frozenset(submodules(workspace)) if paths else frozenset()
    there = [path for path in paths if path in known]
    unknown = [path for path in paths if path not in known]
    if there:
        them = _them(there)
        yield Problem(
            there[0], f"a submodule that is not checked out{_so_are(there)}: nothing in {them} is analysed; {_FETCH}"
        )
    if unknown:
        yield Problem(
            unknown[0],
            f"a commit of another repository that .gitmodules does not name{_so_are(unknown)}: no clone gets the files; add "
            f"{_them(unknown)} to .gitmodules (git submodule add URL DIRECTORY), or the files themselves (git rm --cached, git add)",
        )


def _so_are(paths: list[str]) -> str:
    """The directories after the first, which is the place of the problem."""
    names = [*paths[1:_NAMED], *([f"{len(paths) - _NAMED} more"] if len(paths) > _NAMED else [])]
    return f", and so {'is' if len(paths) == 2 else 'are'} {', '.join(names)}" if names else ""


def _them(paths: list[str]) -> str:
    return "it" if len(paths) == 1 else "them"
