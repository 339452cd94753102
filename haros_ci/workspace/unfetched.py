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
        are = "a submodule that is" if len(there) == 1 else "submodules that are"
        yield Problem(
            there[0], f"{_others(there)}{are} not checked out: nothing in {_them(there)} is analysed; {_FETCH}"
        )
    if unknown:
        is_ = "is a commit" if len(unknown) == 1 else "are commits"
        yield Problem(
            unknown[0],
            f"{_others(unknown)}{is_} of another repository that .gitmodules does not name: no clone gets the files; add "
            f"{_them(unknown)} to .gitmodules (git submodule add URL DIRECTORY), or the files themselves (git rm --cached, git add)",
        )


def _others(paths: list[str]) -> str:
    """The directories after the first, which is the place of the problem."""
    shown = paths[1:_NAMED]
    more = [f"{len(paths) - _NAMED} more"] if len(paths) > _NAMED else []
    return f"with {', '.join((*shown, *more))} " if shown else ""


def _them(paths: list[str]) -> str:
    return "it" if len(paths) == 1 else "them"
