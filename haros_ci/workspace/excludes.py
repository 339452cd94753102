# SPDX-License-Identifier: Apache-2.0
"""Patterns that leave files out, with the meaning they have in .gitignore (gitignore(5), "Pattern format")."""

from __future__ import annotations

import re
from collections.abc import Iterable
from fnmatch import translate

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class _Rule:
    """One pattern: a regular expression per path component, None where any number of components fits (``**``)."""

    components: tuple[re.Pattern[str] | None, ...]
    directories_only: bool
    negated: bool

    def matches(self, parts: tuple[str, ...]) -> bool:
        """Component by component, so that the time is bounded by their product whatever the pattern is."""
        reached = {0}  # how many of *parts* the components so far can have used up
        for component in self.components:
            if component is None:
                reached = set(range(min(reached), len(parts) + 1))
            else:
                reached = {n + 1 for n in reached if n < len(parts) and component.match(parts[n])}
            if not reached:
                return False
        return len(parts) in reached


class Excludes:
    """A list of patterns; the last that matches decides, and ``!`` takes back in."""

    def __init__(self, patterns: tuple[str, ...]) -> None:
        rules = (_rule(pattern.strip()) for pattern in patterns)
        self._rules = tuple(rule for rule in rules if rule is not None)[::-1]

    def match(self, path: str, *, is_directory: bool) -> bool:
        """Whether *path* itself is left out. What lies in a directory that is left out is not asked for."""
        if not self._rules:
            return False
        parts = tuple(path.split("/"))
        for rule in self._rules:
            if (is_directory or not rule.directories_only) and rule.matches(parts):
                return not rule.negated
        return False


def idle(patterns: tuple[str, ...], names: Iterable[str]) -> tuple[str, ...]:
    """Those of *patterns* that name no file of *names*, a whole listing, and no directory above one."""
    files = {tuple(name.split("/")) for name in names}
    directories = {file[:length] for file in files for length in range(1, len(file))}
    return tuple(pattern for pattern in patterns if not _fits_any(_rule(pattern.strip()), files, directories))


def _fits_any(rule: _Rule | None, files: set[tuple[str, ...]], directories: set[tuple[str, ...]]) -> bool:
    if rule is None:
        return True
    places = directories if rule.directories_only else files | directories
    first = rule.components[0]
    if first is not None:
        places = {place for place in places if first.match(place[0])}
    elif len(rule.components) == 2:  # a single name, at any depth
        places = {place[-1:] for place in places}
    return any(rule.matches(place) for place in places)


def _rule(pattern: str) -> _Rule | None:
    if not pattern or pattern.startswith("#"):
        return None
    negated = pattern.startswith("!")
    body = pattern[negated:].removeprefix("./")
    everything_in = body.endswith("/**")  # the same as the directory, for files
    body = body.removesuffix("/**")
    directories_only = everything_in or body.endswith("/")
    anchored = everything_in or "/" in body.rstrip("/")
    names = [name for name in body.split("/") if name not in ("", ".")]
    if not names:
        return None
    if not anchored:
        names.insert(0, "**")
    components = tuple(None if name == "**" else re.compile(translate(name.replace("[^", "[!"))) for name in names)
    return _Rule(components, directories_only, negated)
