# SPDX-License-Identifier: Apache-2.0
"""Calls in files that have changed, where the architecture has nothing of them on either side."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from haros_ci.changes.calls import ChangedCall
from haros_ci.changes.change import ADDED, CHANGED, REMOVED, RENAMED, Difference, tail
from haros_ci.changes.endpoints import RENAMED_FROM, Moved
from haros_ci.changes.names import UNKNOWN, likeness, too_many
from haros_ci.changes.nodes import said_ends
from haros_ci.model.architecture import Architecture

#: What is said of such a change.
UNRUN = "in code that no node of this workspace is known to run"
HIDDEN = "another one of this name is made elsewhere"
Calls = Mapping[str, tuple[ChangedCall, ...]]


def compare_calls(
    base: Calls,
    head: Calls,
    architectures: tuple[Architecture, Architecture],
    differences: Iterable[Difference],
    moved: Moved,
) -> Iterator[Difference]:
    """What the calls of *base* and *head* make, by file, that neither architecture knows; *differences* are those between the architectures.

    A call that one architecture knows and the other does not is not reported: the other side may just not be understood. Of what both
    know, a parameter that is new or removed in the text is reported, too, where others of its name hide it: those of other plug-ins that may be
    loaded under the same name.
    """
    seen = tuple(_places(architecture) for architecture in architectures)
    reported = {
        (difference.what, tail(name)) for difference in differences for name in (difference.name, difference.old_name)
    }
    left = {moved(path): calls for path, calls in base.items()}
    pairs, removed, new = _paired(left, head)
    for old, now in pairs:
        if _key(old) not in seen[0] and _key(now) not in seen[1]:
            yield from _changed(old, now)
    for before, after in _renamed(removed, new):
        if _key(before[1]) not in seen[0] and _key(after[1]) not in seen[1]:
            removed.remove(before)
            new.remove(after)
            yield _difference(after[1], RENAMED, UNRUN, old=before[1])
    vague = tuple(
        {(call.what, path) for path, calls in side.items() for call in calls if _is_vague(call)}
        for side in (left, head)
    )
    tails = tuple({(call.what, path, tail(call.name)) for path, call in side} for side in (removed, new))
    for side, (calls, action) in enumerate(((removed, REMOVED), (new, ADDED))):
        for path, call in calls:
            if (call.what, tail(call.name)) in reported or (call.what, path) in vague[1 - side]:
                continue
            hidden = _key(call) in seen[side]
            if not hidden or (call.what == "parameter" and (call.what, path, tail(call.name)) not in tails[1 - side]):
                yield _difference(call, action, HIDDEN if hidden else UNRUN)


def _difference(call: ChangedCall, action: str, why: str, old: ChangedCall | None = None) -> Difference:
    is_gone = action == REMOVED
    text = _described(call)
    return Difference(
        what=call.what,
        action=action,
        name=call.name,
        aspect="name" if old is not None else "",
        before=old.name if old is not None else text if is_gone else None,
        after=call.name if old is not None else None if is_gone else text,
        base=old.location if old is not None else call.location if is_gone else None,
        head=None if is_gone else call.location,
        old_name=old.name if old is not None else "",
        details=(why,),
    )


Key = tuple[str, int | None, int | None]
Found = list[tuple[str, ChangedCall]]


def _key(call: ChangedCall) -> Key:
    return (call.location.path, call.location.line, call.location.column)


def _is_vague(call: ChangedCall) -> bool:
    """Whether nothing of its name is known: it may be any."""
    return not call.name.strip(UNKNOWN + "./~")


def _places(architecture: Architecture) -> set[Key]:
    """Where the ends of all nodes are made."""
    return {
        (end.location.path, end.location.line, end.location.column)
        for configuration in architecture.configurations
        for node in configuration.nodes
        for end in said_ends(node)
        if end.location is not None
    }


def _paired(base: Calls, head: Calls) -> tuple[list[tuple[ChangedCall, ChangedCall]], Found, Found]:
    """Calls that are on both sides, in one file or moved to another; and what is left on either."""
    removed, new = (
        [(path, c) for path, calls in sorted(side.items()) for c in calls if not _is_vague(c)] for side in (base, head)
    )
    pairs: list[tuple[ChangedCall, ChangedCall]] = []
    rules: tuple[Callable[[str, ChangedCall], tuple[object, ...]], ...] = (
        lambda path, call: (path, call.what, call.name, call.type, call.default),
        lambda path, call: (path, call.what, call.name),
        lambda path, call: (call.what, call.name, call.type, call.default),
        lambda path, call: (call.what, call.name),
    )
    for rule in rules:
        waiting: dict[tuple[object, ...], list[int]] = {}
        for number, (path, call) in enumerate(new):
            waiting.setdefault(rule(path, call), []).append(number)
        taken: set[int] = set()
        rest: Found = []
        for path, call in removed:
            numbers = waiting.get(rule(path, call))
            if numbers:
                taken.add(numbers[0])
                pairs.append((call, new[numbers.pop(0)][1]))
            else:
                rest.append((path, call))
        removed, new = rest, [item for number, item in enumerate(new) if number not in taken]
    return pairs, removed, new


def _renamed(removed: Found, new: Found) -> list[tuple[tuple[str, ChangedCall], tuple[str, ChangedCall]]]:
    """Calls of one file under a new name, of the same type and default, the likest first."""
    if too_many(removed, new):
        return []
    ranked = sorted(
        (-likeness(old[1].name, now[1].name), place, number)
        for place, old in enumerate(removed)
        for number, now in enumerate(new)
        if old[0] == now[0]
        and (old[1].what, old[1].type, old[1].default) == (now[1].what, now[1].type, now[1].default)
        and likeness(old[1].name, now[1].name) >= RENAMED_FROM
    )
    found: dict[int, int] = {}
    for _, place, number in ranked:
        if place not in found and number not in found.values():
            found[place] = number
    return [(removed[place], new[number]) for place, number in found.items()]


def _described(call: ChangedCall) -> str:
    if call.what == "parameter":
        return (
            f"default {call.default}" if call.default is not None else "a default" if call.has_default else "no default"
        )
    return call.type or "?"


def _changed(old: ChangedCall, new: ChangedCall) -> Iterator[Difference]:
    for aspect, before, after in (("default", old.default, new.default), ("type", old.type, new.type)):
        if None not in (before, after) and before != after:
            yield Difference(
                what=new.what,
                action=CHANGED,
                name=new.name,
                aspect=aspect,
                before=before,
                after=after,
                base=old.location,
                head=new.location,
                details=(UNRUN,),
            )
