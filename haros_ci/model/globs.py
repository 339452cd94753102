# SPDX-License-Identifier: Apache-2.0
"""Globs on workspace paths: ``*`` and ``?`` stay within one name, ``**`` crosses directories."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Callable
from functools import lru_cache


@lru_cache(maxsize=4096)
def compiled(pattern: str) -> Callable[[str], object]:
    """A matcher of whole words for one fnmatch pattern, case-sensitive on every platform."""
    return re.compile(fnmatch.translate(pattern)).match


def matches(glob: str, path: str) -> bool:
    """Whether *glob* names *path* or a directory above it.

    Both are POSIX-style and relative to the workspace root. A glob without a slash (but for a last one) matches at
    any depth, as in .gitignore; one with a slash starts at the root.
    """
    parts = tuple(part for part in glob.replace("[^", "[!").split("/") if part not in ("", "."))
    if "/" not in glob.rstrip("/"):
        parts = ("**", *parts)
    return _matches(parts, tuple(path.split("/")))


def fault(glob: str) -> str | None:
    """What is wrong with a glob of a user, or None."""
    parts = glob.strip().split("/")
    if all(part in ("", ".") for part in parts):
        return "an empty glob matches nothing"
    if ".." in parts:
        return "globs are relative to the workspace root and stay inside it"
    if len(glob) > 1000:
        return "a glob of more than 1000 characters"
    return None


def _matches(parts: tuple[str, ...], names: tuple[str, ...]) -> bool:
    """Step through the names once, keeping every place in the glob that can be reached: no backtracking."""
    here = _skip({0}, parts)
    for name in names:
        there: set[int] = set()
        for place in here:
            if parts[place] == "**":
                there.update((place, place + 1))
            elif compiled(parts[place])(name):
                there.add(place + 1)
        if len(parts) in there:
            return True  # the path itself, or a directory above it
        here = _skip(there, parts)
    return False


def _skip(places: set[int], parts: tuple[str, ...]) -> set[int]:
    """*places*, and those behind a ``**`` that stands for no directory; a last ``**`` stands for at least one name."""
    reached = set(places)
    for place in places:
        while place < len(parts) - 1 and parts[place] == "**":
            place += 1
            reached.add(place)
    return reached
