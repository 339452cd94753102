# SPDX-License-Identifier: Apache-2.0
"""A ``Difference`` is seen in one node of one configuration; equal ones are joined to a ``Change``, reported once."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from haros_ci.model.changes import ADDED, CHANGED, REMOVED, RENAMED, Change
from haros_ci.model.location import Location
from haros_ci.records import dataclass

__all__ = ["ADDED", "CHANGED", "REMOVED", "RENAMED", "Change", "Difference", "shown", "tail", "told_once"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """Something that is otherwise at head than at the base, in one *configuration*.

    *what* is one of ``WHATS``, *action* added, removed, renamed or changed, *aspect* which property has changed (``type``). *name* is the
    name at head, of what is removed the one at the base; *before* and *after* are texts, None for what is not there. *node* and
    *program* (``package/executable``) have it. *base* and *head* are the places on either side. *users* are who else uses it.
    *details* are further words.
    """

    what: str
    action: str
    name: str
    aspect: str = ""
    before: str | None = None
    after: str | None = None
    node: str = ""
    program: str = ""
    configuration: str = ""
    base: Location | None = None
    head: Location | None = None
    users: tuple[str, ...] = ()
    details: tuple[str, ...] = ()
    #: The name that it had at the base, where it is another.
    old_name: str = ""

    @property
    def key(self) -> tuple[object, ...]:
        """By this it is the same change, whatever node and configuration it is seen in."""
        names = (tail(self.name), tail(self.old_name))
        before, after = (tail(text or "") for text in (self.before, self.after))
        if self.action != RENAMED:
            before, after = self.before or "", self.after or ""
        places = tuple(place.sort_key if place is not None else None for place in (self.base, self.head))
        owner = (self.program,) if places == (None, None) else ()
        return (self.what, self.action, self.aspect, *names, before, after, places, owner)


def tail(name: str) -> str:
    """The last part of a name: what stays the same when node and plug-in have other names."""
    return name.rpartition("/")[2].rpartition(":")[2].rpartition(".")[2]


def told_once(found: Iterable[Difference]) -> tuple[Change, ...]:
    """The differences, each change once, sorted."""
    alike: dict[tuple[object, ...], list[Difference]] = {}
    for difference in found:
        alike.setdefault(difference.key, []).append(difference)
    return tuple(sorted((_change(group) for group in alike.values()), key=lambda change: change.sort_key))


def _change(group: list[Difference]) -> Change:
    first = min(group, key=lambda difference: (len(difference.name), difference.name, difference.configuration))

    def every(values: Iterable[str]) -> tuple[str, ...]:
        return tuple(sorted({value for value in values if value}, key=lambda text: (len(text), text)))

    renames = sorted(
        {(difference.old_name, difference.name) for difference in group}, key=lambda pair: (len(pair[1]), pair)
    )
    return Change(
        what=first.what,
        action=first.action,
        names=tuple(new for _, new in renames) if first.old_name else every(difference.name for difference in group),
        aspect=first.aspect,
        before=first.before,
        after=first.after,
        nodes=every(difference.node for difference in group),
        programs=every(difference.program for difference in group),
        configurations=tuple(sorted({difference.configuration for difference in group if difference.configuration})),
        base=first.base,
        head=first.head,
        users=every(user for difference in group for user in difference.users),
        details=tuple(dict.fromkeys(word for difference in group for word in difference.details)),
        old_names=tuple(old for old, _ in renames) if first.old_name else (),
    )


def shown(value: Any) -> str:
    """A value as JSON has it; lists and maps in full."""
    import json

    if isinstance(value, bytes):
        return value.hex()
    try:
        return json.dumps(value, ensure_ascii=False, sort_keys=True, default=str)
    except (ValueError, RecursionError):
        return "?"
