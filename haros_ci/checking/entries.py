# SPDX-License-Identifier: Apache-2.0
"""What each directory of the workspace holds, worked out once for all who ask."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from functools import lru_cache

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Entries:
    """The *names* in a directory, those of its *directories* among them; no paths."""

    names: frozenset[str] = frozenset()
    directories: frozenset[str] = frozenset()


NO_ENTRIES = Entries()
#: The character that follows the slash: all that begins with a directory and a slash sorts before it.
_AFTER_A_SLASH = chr(ord("/") + 1)


@lru_cache(maxsize=2)
def entries_of(names: frozenset[str]) -> Mapping[str, Entries]:
    """The entries of each directory above *names*, which are root-relative paths of files; ``""`` is the root."""
    inside: dict[str, set[str]] = {"": set()}
    directories: dict[str, set[str]] = {}
    for path in names:
        place = path
        while place:
            folder, _, name = place.rpartition("/")
            if place is not path:
                directories.setdefault(folder, set()).add(name)
            is_known = folder in inside
            inside.setdefault(folder, set()).add(name)
            if is_known:
                break
            place = folder
    return {folder: Entries(frozenset(held), frozenset(directories.get(folder, ()))) for folder, held in inside.items()}


def below(names: frozenset[str], folder: str) -> Sequence[str]:
    """Those of *names*, root-relative paths, that lie in the directory *folder* or deeper, in order; ``"."`` is the root."""
    every = _in_order(names)
    if folder in ("", "."):
        return every
    return every[bisect_left(every, f"{folder}/") : bisect_left(every, f"{folder}{_AFTER_A_SLASH}")]


@lru_cache(maxsize=2)
def _in_order(names: frozenset[str]) -> tuple[str, ...]:
    return tuple(sorted(names))


@lru_cache(maxsize=2)
def paths_by_name(names: frozenset[str]) -> Mapping[str, tuple[str, ...]]:
    """Of *names*, root-relative paths, those that end with each name, in order."""
    found: dict[str, list[str]] = {}
    for path in _in_order(names):
        found.setdefault(path.rpartition("/")[2], []).append(path)
    return {name: tuple(paths) for name, paths in found.items()}
