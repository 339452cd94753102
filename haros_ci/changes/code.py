# SPDX-License-Identifier: Apache-2.0
"""Calls in files that have changed, where the architecture has nothing of them on either side."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.changes.calls import Call
from haros_ci.changes.change import ADDED, CHANGED, REMOVED, RENAMED, Difference, tail
from haros_ci.changes.endpoints import RENAMED_FROM, Moved
from haros_ci.changes.names import likeness
from haros_ci.changes.nodes import said_ends
from haros_ci.model.architecture import Architecture
from haros_ci.model.location import Location

#: What is said of such a change.
UNRUN = "in code that no node of this workspace is known to run"
Calls = Mapping[str, tuple[Call, ...]]


def compare_calls(
    base: Calls, head: Calls, architectures: tuple[Architecture, Architecture], told: Iterable[Difference], moved: Moved
) -> Iterator[Difference]:
    """What the calls of *base* and *head* make, by file, that neither architecture knows; *told* are the differences of these.

    A call that one architecture knows and the other does not is not told: the other side may just not be understood.
    """
    seen = tuple(_places(each) for each in architectures)
    said = {(each.what, tail(each.old_name or each.name)) for each in told}
    left = {moved(path): calls for path, calls in base.items()}
    for path in sorted({*left, *head}):
        old = _unseen(left.get(path, ()), seen[0])
        new = _unseen(head.get(path, ()), seen[1])
        for each in _compared(old, new):
            if each.action == CHANGED or (each.what, tail(each.old_name or each.name)) not in said:
                yield each


def _places(architecture: Architecture) -> set[tuple[str, int | None, int | None]]:
    """Where the ends of all nodes are made."""
    return {
        (end.location.path, end.location.line, end.location.column)
        for configuration in architecture.configurations
        for node in configuration.nodes
        for end in said_ends(node)
        if end.location is not None
    }


def _unseen(calls: Iterable[Call], seen: set[tuple[str, int | None, int | None]]) -> list[Call]:
    return [call for call in calls if (call.location.path, call.location.line, call.location.column) not in seen]


def _compared(old: list[Call], new: list[Call]) -> Iterator[Difference]:
    """Calls of one file on both sides: by name, of several the equal ones first; then under a new name."""
    left, right = list(old), list(new)
    for is_same in (_is_equal, _is_named):
        for call in list(left):
            other = next((each for each in right if is_same(call, each)), None)
            if other is not None:
                left.remove(call)
                right.remove(other)
                yield from _changed(call, other)
    for call in list(left):
        fitting = [o for o in right if _fits(call, o) and likeness(call.name, o.name) >= RENAMED_FROM]
        if fitting:
            other = max(fitting, key=lambda each: likeness(call.name, each.name))
            left.remove(call)
            right.remove(other)
            yield _difference(
                other.what, RENAMED, other.name, "name", call.name, other.name, call.location, other.location, call.name
            )
            yield from _changed(call, other)
    for call in left:
        yield _difference(call.what, REMOVED, call.name, "", _described(call), None, call.location, None)
    for call in right:
        yield _difference(call.what, ADDED, call.name, "", None, _described(call), None, call.location)


def _is_equal(one: Call, other: Call) -> bool:
    return _is_named(one, other) and (one.type, one.default) == (other.type, other.default)


def _is_named(one: Call, other: Call) -> bool:
    return (one.what, one.name) == (other.what, other.name)


def _fits(one: Call, other: Call) -> bool:
    return one.what == other.what and (one.type, one.default) == (other.type, other.default)


def _described(call: Call) -> str:
    if call.what == "parameter":
        return (
            f"default {call.default}" if call.default is not None else "a default" if call.has_default else "no default"
        )
    return call.type or "?"


def _changed(old: Call, new: Call) -> Iterator[Difference]:
    if None not in (old.default, new.default) and old.default != new.default:
        yield _difference(new.what, CHANGED, new.name, "default", old.default, new.default, old.location, new.location)
    if None not in (old.type, new.type) and old.type != new.type:
        yield _difference(new.what, CHANGED, new.name, "type", old.type, new.type, old.location, new.location)


def _difference(
    what: str, action: str, name: str, aspect: str, before: str | None, after: str | None, base: Location | None,
    head: Location | None, old_name: str = "",
) -> Difference:  # fmt: skip
    return Difference(
        what=what,
        action=action,
        name=name,
        aspect=aspect,
        before=before,
        after=after,
        base=base,
        head=head,
        old_name=old_name,
        details=(UNRUN,),
    )
