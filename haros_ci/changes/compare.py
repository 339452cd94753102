# SPDX-License-Identifier: Apache-2.0
"""Two architectures compared: base and head of a change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from haros_ci.changes import configurations
from haros_ci.changes.calls import Call
from haros_ci.changes.change import Difference, told_once
from haros_ci.changes.code import compare_calls
from haros_ci.changes.definitions import with_nodes
from haros_ci.changes.endpoints import Compared, Moved, Sides, compare_ends, with_users
from haros_ci.changes.evidence import Evidence, Source
from haros_ci.changes.instances import Calls, by_instance
from haros_ci.changes.nodes import pair
from haros_ci.changes.picture import edges
from haros_ci.changes.settings import Value, compare_arguments, compare_files, compare_remaps, compare_values
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.changes import ADDED, REMOVED, Change, Changes
from haros_ci.model.location import Location

_OPPOSITE = {
    "publisher": "subscribers",
    "subscriber": "publishers",
    "service server": "clients",
    "service client": "servers",
    "action server": "action_clients",
    "action client": "action_servers",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Side:
    """One revision: its *architecture*, the *files* that there are, and by path what those parameter files and
    that code say which are not the same on both sides.
    """

    architecture: Architecture
    files: frozenset[str] = frozenset()
    values: Mapping[str, tuple[Value, ...]] = field(default_factory=dict)
    calls: Mapping[str, tuple[Call, ...]] = field(default_factory=dict)
    source: Source | None = None


def compare(
    base: Side, head: Side, renames: Mapping[str, str] | None = None, interfaces: Iterable[Change] = ()
) -> Changes:
    """What is otherwise at *head* than at *base*.

    *renames* maps paths of the base to those that the files have at head: a file that has moved is no change. *interfaces* are the changes
    of messages, services and actions.
    """
    moves = renames or {}

    def moved(path: str) -> str:
        return moves.get(path, path)

    packages = {package.name: package.path for side in (head, base) for package in side.architecture.packages}

    def path_of(launch: str) -> str:
        package, _, inner = launch.partition("/")
        home = packages.get(package, package)
        return inner if home == "." else f"{home}/{inner}"

    names = {path_of(each.name): each.name for each in head.architecture.configurations if each.launch}
    matched = configurations.match(
        base.architecture,
        head.architecture,
        lambda name: names.get(moved(path_of(name)), name),
        lambda name, side: path_of(name) in (base if side == "base" else head).files,
    )
    told = Compared()
    told.differences += matched.differences
    for old, new in matched.both:
        if old != new:
            _compare_systems(old, new, moved, told)
    for node, other, name in matched.elsewhere:
        compare_ends(Sides(node, other, name, moved), told)
    seen = told.differences
    if base.source is not None and head.source is not None:
        evidence = Evidence(base.source, head.source, moved)
        seen = [each for each in seen if evidence.bears_out(each)]
        told.not_known += len(told.differences) - len(seen)
    found = by_instance(seen, Calls(base.architecture, moved), Calls(head.architecture, lambda path: path))
    found += compare_arguments(base.architecture, head.architecture, moved)
    in_files = list(compare_files(base.values, head.values, moved, _readers(head.architecture)))
    found = [*_not_of_files(found, in_files, base, head), *in_files]
    found += compare_calls(base.calls, head.calls, (base.architecture, head.architecture), found, moved)
    defined = with_nodes(tuple(interfaces), base.architecture, head.architecture)
    changes = (*defined, *told_once(found))
    return Changes(
        changes=tuple(sorted(changes, key=lambda change: change.sort_key)),
        edges=tuple(edges(found, head.architecture, base.architecture)),
        not_known=told.not_known,
    )


def _compare_systems(base: Configuration, head: Configuration, moved: Moved, told: Compared) -> None:
    pairs = pair(base.nodes, head.nodes)
    takers = _Ends(base), _Ends(head)
    renamed = {}
    for old, new in pairs.both:
        if old == new:
            continue
        if old.name != new.name:
            renamed[old.name] = new.name
        sides = Sides(old, new, head.name, moved)
        here = Compared()
        compare_ends(sides, here)
        told.not_known += here.not_known
        told.pairs += here.pairs
        here.differences += configurations.compare_nodes(old, new, head.name)
        here.differences += compare_remaps(sides)
        told.differences += (with_users(each, _users(each, takers)) for each in here.differences)
    told.differences += (
        configurations.one_sided(REMOVED, node, head.name) for node in pairs.removed if "?" not in node.name
    )
    told.differences += (
        configurations.one_sided(ADDED, node, head.name) for node in pairs.added if "?" not in node.name
    )
    gone, new_ones = (frozenset(node.name for node in nodes) for nodes in (pairs.removed, pairs.added))
    told.differences += compare_values(base, head, renamed, gone, new_ones, moved)


class _Ends:
    """Who has which end, by kind and resolved name."""

    def __init__(self, configuration: Configuration) -> None:
        self._nodes = configuration.nodes
        self._found: dict[tuple[str, str], set[str]] | None = None

    def nodes(self, kind: str, name: str) -> set[str]:
        if self._found is None:
            self._found = {}
            for node in self._nodes:
                for end in node.endpoints:
                    if end.is_ruled_out:
                        continue
                    self._found.setdefault((end.kind, end.name), set()).add(node.name)
        return self._found.get((kind, name), set())


def _users(difference: Difference, sides: tuple[_Ends, _Ends]) -> set[str]:
    """Who is at the other end, of what was and of what is."""
    what = difference.aspect if difference.what == "QoS" else difference.what
    kind = _OPPOSITE.get(what)
    if kind is None:
        return set()
    old = difference.old_name or difference.name
    users = set() if difference.action == ADDED else sides[0].nodes(kind, old)
    return users | (set() if difference.action == REMOVED else sides[1].nodes(kind, difference.name))


def _not_of_files(found: list[Difference], in_files: list[Difference], base: Side, head: Side) -> Iterator[Difference]:
    """*found* without the values that the parameter files themselves tell."""
    told = {(side, place) for each in in_files for side, place in (("base", each.base), ("head", each.head)) if place}
    whole = {(side, place.path) for side, place in told if place.line is None}
    of_files = set(base.values), set(head.values)
    for each in found:
        if each.what == "value" and each.aspect != "file":
            places = [(side, place) for side, place in (("base", each.base), ("head", each.head)) if place is not None]
            if places and all((side, _line(place)) in told or (side, place.path) in whole for side, place in places):
                continue
            if each.base and each.head and each.base.path in of_files[0] and each.head.path in of_files[1]:
                if any((side, _line(place)) in told for side, place in places):
                    continue
        yield each


def _readers(architecture: Architecture) -> dict[str, int]:
    """In how many configurations nodes are given what a file says."""
    found: dict[str, set[str]] = {}
    for configuration in architecture.configurations:
        for parameter in configuration.parameters:
            if parameter.origin is not None:
                found.setdefault(parameter.origin.path, set()).add(configuration.name)
    return {path: len(names) for path, names in found.items()}


def _line(place: Location) -> Location:
    return Location(place.path, place.line)
