# SPDX-License-Identifier: Apache-2.0
"""Which interfaces a change adds, removes, renames or alters, and whether nodes of before and after still understand each other.

ROS 1 compares MD5 sums when a connection is made, ROS 2 type hashes (REP 2016) where the middleware knows them, and else reads the
bytes of one type as another. Fields are on the wire by order and type, so each change of them breaks it; constants are in the sum of ROS 1
only, but code of both reads them; default values and comments are in neither.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from haros_ci.changes.sections import SectionDifference, differences
from haros_ci.interfaces.definitions import Definitions, field_type, on_wire
from haros_ci.interfaces.hashes import wire_hash
from haros_ci.model.build import Interface
from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: An interface, and the ROS version of its package: 1, 2 or None.
Defined = tuple[Interface, int | None]
#: The parts of a service and of an action.
PARTS = {"msg": ("",), "srv": ("request", "response"), "action": ("goal", "result", "feedback")}


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceChange:
    """One change of one interface.

    *name* is ``pkg/T`` at the base (for one that is added, at the head), *kind* msg, srv or action. *what*: ``added``, ``removed``,
    ``renamed`` of the interface itself, with the name in *before* and *after*; else ``field-`` or ``constant-`` with ``added``,
    ``removed``, ``renamed``, ``retyped``, ``moved``, and ``bound``, ``default`` or ``constant-value``. *part* is the part of a service
    or action, *field* the field's or constant's name at the base (at the head, if it is added).

    *hash_before* and *hash_after* are the wire hashes of the whole interface, None where they are not known. *location* is at the head,
    or for what is gone with its whole file at the base, as *is_in_head* tells. *is_breaking*: nodes built before and after no longer
    understand each other, or code that used it no longer builds or means something else.
    """

    name: str
    kind: str
    what: str
    field: str = ""
    part: str = ""
    before: str = ""
    after: str = ""
    hash_before: str | None = None
    hash_after: str | None = None
    location: Location
    is_in_head: bool = True
    is_breaking: bool
    ros: int | None = None


class InterfacesOfRevision:
    """The interfaces of one revision."""

    def __init__(self, found: Iterable[Defined]) -> None:
        self.all: dict[tuple[str, str], Defined] = {}
        for interface, ros in found:
            self.all.setdefault((interface.kind, interface.name), (interface, ros))
        #: Those that are generated: the others no node can use.
        self.used = {key: item for key, item in self.all.items() if item[0].is_generated}
        self._known = {ros: Definitions((i for i, of in self.all.values() if of in (ros, None)), ros) for ros in (1, 2)}

    def hash(self, defined: Defined) -> str | None:
        """The wire hash of an interface of this revision; None if it is not known."""
        interface, ros = defined
        return None if ros is None else wire_hash(interface, self._known[ros])


def interface_changes(base: Iterable[Defined], head: Iterable[Defined]) -> tuple[InterfaceChange, ...]:
    """All changes from the interfaces of *base* to those of *head*, sorted by name, kind and place; [] for the same interfaces."""
    before, after = InterfacesOfRevision(base), InterfacesOfRevision(head)
    removed = [key for key in before.used if key not in after.all]
    new = [key for key in after.used if key not in before.all]
    moved = _renamed(before, after, removed, new)
    made: list[InterfaceChange] = []
    for key in removed:
        made.append(_whole(before, after, key, moved.get(key)))
    for key in new:
        if key not in moved.values():
            interface, ros = after.used[key]
            made.append(
                InterfaceChange(
                    name=interface.name,
                    kind=interface.kind,
                    what="added",
                    after=interface.name,
                    ros=ros,
                    hash_after=after.hash(after.used[key]),
                    location=Location(interface.path),
                    is_breaking=False,
                )  # fmt: skip
            )
    for key in before.used.keys() & after.used.keys():
        made += _altered(before, after, before.used[key], after.used[key])
    return tuple(
        sorted(
            made,
            key=lambda interface_change: (
                interface_change.name,
                interface_change.kind,
                interface_change.location.sort_key,
                interface_change.what,
                interface_change.field,
            ),
        )
    )


def containing(found: Iterable[Defined], name: str) -> tuple[Interface, ...]:
    """The interfaces that have the message *name* in them, directly or through others, by name."""
    users: dict[str, list[Interface]] = {}
    for interface, _ in found:
        for used in {kind.base for section in interface.sections for f in section if (kind := field_type(f.type))}:
            users.setdefault(used, []).append(interface)
    seen: dict[tuple[str, str], Interface] = {}
    waiting = [name]
    while waiting:
        for interface in users.get(waiting.pop(), ()):
            if (interface.kind, interface.name) not in seen:
                seen[interface.kind, interface.name] = interface
                waiting += [interface.name] if interface.kind == "msg" else []
    return tuple(interface for key, interface in sorted(seen.items()) if key != ("msg", name))


def in_words(change: InterfaceChange) -> str:
    """What changed, as a part of a sentence: ``field x removed from the request``."""
    noun, _, verb = change.what.partition("-")
    of = f" of the {change.part}" if change.part else ""
    if not verb:
        noun, verb = ("constant" if change.what == "value" else "field"), change.what
    if change.what in ("added", "removed"):
        return change.what
    if change.what == "renamed":
        return f"renamed to {change.after}"
    named = f"{noun} {change.field}{of}"
    if verb in ("removed", "added", "moved"):
        return f"{named} {verb}" + (f" ({change.before or change.after})" if verb != "moved" else "")
    if verb == "renamed":
        return f"{named} renamed to {change.after}"
    if verb == "default":
        return f"default of {named}: {change.before or 'none'} → {change.after or 'none'}"
    return f"{named}: {change.before} → {change.after}"


def _renamed(
    before: InterfacesOfRevision,
    after: InterfacesOfRevision,
    removed: Sequence[tuple[str, str]],
    new: Sequence[tuple[str, str]],
) -> Mapping[tuple[str, str], tuple[str, str]]:
    """Which of the new interfaces is which of the old ones: alike in all but the name, and no other is."""
    by_content: dict[object, tuple[list[tuple[str, str]], list[tuple[str, str]]]] = {}
    for keys, side, at in ((removed, before, 0), (new, after, 1)):
        for key in keys:
            interface = side.used[key][0]
            if interface.is_whole and any(interface.sections):
                content = (interface.kind, on_wire(interface, True))
                by_content.setdefault(content, ([], []))[at].append(key)
    return {old[0]: now[0] for old, now in by_content.values() if len(old) == len(now) == 1}


def _whole(
    before: InterfacesOfRevision, after: InterfacesOfRevision, key: tuple[str, str], to: tuple[str, str] | None
) -> InterfaceChange:
    interface, ros = before.used[key]
    now = after.used[to] if to is not None else None
    return InterfaceChange(
        name=interface.name,
        kind=interface.kind,
        what="removed" if now is None else "renamed",
        before=interface.name,
        after="" if now is None else now[0].name,
        hash_before=before.hash(before.used[key]),
        hash_after=None if now is None else after.hash(now),
        location=Location(interface.path if now is None else now[0].path),
        is_in_head=now is not None,
        is_breaking=True,
        ros=ros,
    )


def _altered(
    before: InterfacesOfRevision, after: InterfacesOfRevision, old: Defined, new: Defined
) -> Iterable[InterfaceChange]:
    was, now, ros = old[0], new[0], new[1]
    if not was.is_whole or not now.is_whole or was.sections == now.sections:
        return
    parts = zip(PARTS.get(now.kind, ("",)), was.sections, now.sections)
    found = [(part, difference) for part, one, other in parts for difference in differences(one, other, ros)]
    if not found:
        return
    hash_before, hash_after = before.hash(old), after.hash(new)
    for part, difference in found:
        yield InterfaceChange(
            name=now.name, kind=now.kind, what=difference.what, field=difference.name, part=part, before=difference.before, after=difference.after,
            hash_before=hash_before, hash_after=hash_after, location=Location(now.path, difference.line or None),
            is_breaking=_is_breaking(difference, ros), ros=ros,
        )  # fmt: skip


def _is_breaking(difference: SectionDifference, ros: int | None) -> bool:
    if difference.what == "default":
        return False
    if difference.what in ("constant-removed", "constant-renamed"):
        return True
    if difference.what == "constant-value":
        return ros == 1 or difference.is_other_value
    return ros == 1 or not difference.what.startswith("constant-")
