# SPDX-License-Identifier: Apache-2.0
"""What the rules under ``access`` of a project file let a node do (docs/configuration.md).

As in ROSRV's policies an entry names who may use a topic, and where several fit, being in one of their lists is enough. Other than there, where no entry
fits a name, everybody may: ``/**: []`` closes what nothing else opens.
"""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

from haros_ci.model.access import VERBS, AccessRule


class Access:
    """The *rules* of a project file."""

    def __init__(self, rules: Iterable[AccessRule]) -> None:
        self.rules = tuple(rules)
        self._found: dict[tuple[str, str], tuple[AccessRule, ...]] = {}

    def about(self, kind: str, name: str) -> tuple[AccessRule, ...]:
        """The rules about ends of this *kind* (as in the model) of the full *name*."""
        key = (kind, name)
        if key not in self._found:
            self._found[key] = tuple(rule for rule in self.rules if kind in VERBS[rule.verb] and fits(rule.name, name))
        return self._found[key]

    def refusing(self, kind: str, name: str, node: str, type_: str) -> tuple[AccessRule, ...]:
        """The rules by which the *node* (full name, ``?`` in it is not known) of *type_* (``package/executable``) may not have this end; () if it may, or if that is not known."""
        rules = self.about(kind, name)
        patterns = [pattern for rule in rules for pattern in rule.nodes]
        if any(is_meant(pattern, node, type_) for pattern in patterns):
            return ()
        if "?" in node and any(pattern.startswith("/") for pattern in patterns):
            return ()
        return rules


def is_meant(pattern: str, node: str, type_: str) -> bool:
    """Whether *pattern* means the node of this full name and type."""
    return fits(pattern, node if pattern.startswith("/") else type_)


def fits(pattern: str, name: str) -> bool:
    """Whether *name* is one that *pattern* means: ``*`` stays between slashes, ``**`` is any number of parts, none, too."""
    parts = pattern.strip("/").split("/")
    here = _beyond({0}, parts)
    for word in name.strip("/").split("/"):
        there: set[int] = set()
        for place in here:
            if place < len(parts) and parts[place] == "**":
                there.add(place)
            elif place < len(parts) and fnmatchcase(word, parts[place]):
                there.add(place + 1)
        here = _beyond(there, parts)
    return len(parts) in here


def _beyond(places: set[int], parts: list[str]) -> set[int]:
    """*places*, and those behind each ``**`` there."""
    found = set(places)
    for place in places:
        while place < len(parts) and parts[place] == "**":
            place += 1
            found.add(place)
    return found
