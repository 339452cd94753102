# SPDX-License-Identifier: Apache-2.0
"""What each directory of the workspace holds, worked out once for all who ask."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Entries:
    """The *names* in a directory, those of its *directories* among them; no paths."""

    names: frozenset[str] = frozenset()
    directories: frozenset[str] = frozenset()


NO_ENTRIES = Entries()


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


@lru_cache(maxsize=2)
def paths_by_name(names: frozenset[str]) -> Mapping[str, tuple[str, ...]]:
    """Of *names*, root-relative paths, those that end with each name, in order."""
    found: dict[str, list[str]] = {}
    for path in sorted(names):
        found.setdefault(path.rpartition("/")[2], []).append(path)
    return {name: tuple(paths) for name, paths in found.items()}
