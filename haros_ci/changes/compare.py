# SPDX-License-Identifier: Apache-2.0
"""Two architectures compared: base and head of a change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.changes import configurations
from haros_ci.changes.calls import ChangedCall
from haros_ci.changes.change import Difference, told_once
from haros_ci.changes.code import compare_calls
from haros_ci.changes.definitions import with_nodes
from haros_ci.changes.endpoints import Compared, Moved, NodePair, compare_ends, with_users
from haros_ci.changes.evidence import RevisionCode, TextEvidence
from haros_ci.changes.instances import Calls, by_instance
from haros_ci.changes.nodes import pair
from haros_ci.changes.picture import edges
from haros_ci.changes.rates import compare_rates
from haros_ci.changes.settings import ParameterValue, compare_arguments, compare_files, compare_remaps, compare_values
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.changes import ADDED, REMOVED, Change, Changes
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

_OPPOSITE = {
    "publisher": "subscribers",
    "subscriber": "publishers",
    "service server": "clients",
    "service client": "servers",
    "action server": "action_clients",
    "action client": "action_servers",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedRevision:
    """One revision: its *architecture*, the *files* that there are, and by path what those parameter files and
    that code say which are not the same on both sides.
    """

    architecture: Architecture
    files: frozenset[str] = frozenset()
    values: Mapping[str, tuple[ParameterValue, ...]] = field(default_factory=dict)
    calls: Mapping[str, tuple[ChangedCall, ...]] = field(default_factory=dict)
    source: RevisionCode | None = None


def compare(
    base: ComparedRevision,
    head: ComparedRevision,
    renames: Mapping[str, str] | None = None,
    interfaces: Iterable[Change] = (),
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

    names = {
        path_of(configuration.name): configuration.name
        for configuration in head.architecture.configurations
        if configuration.launch
    }
    matched = configurations.match(
        base.architecture,
        head.architecture,
        lambda name: names.get(moved(path_of(name)), name),
        lambda name, side: path_of(name) in (base if side == "base" else head).files,
    )
    outcome = Compared()
    outcome.differences += matched.differences
    for old, new in matched.both:
        if old != new or old.rates != new.rates:
            _compare_systems(old, new, moved, outcome)
    for node, other, name in matched.elsewhere:
        compare_ends(NodePair(node, other, name, moved), outcome)
    seen = outcome.differences
    if base.source is not None and head.source is not None:
        evidence = TextEvidence(base.source, head.source, moved)
        seen = [difference for difference in seen if evidence.bears_out(difference)]
        outcome.not_known += len(outcome.differences) - len(seen)
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
        not_known=outcome.not_known,
    )


def _compare_systems(base: Configuration, head: Configuration, moved: Moved, outcome: Compared) -> None:
    pairs = pair(base.nodes, head.nodes)
    takers = _Ends(base), _Ends(head)
    renamed = {}
    for old, new in pairs.both:
        if old == new:
            continue
        if old.name != new.name:
            renamed[old.name] = new.name
        sides = NodePair(old, new, head.name, moved)
        here = Compared()
        compare_ends(sides, here)
        outcome.not_known += here.not_known
        outcome.pairs += here.pairs
        here.differences += configurations.compare_nodes(old, new, head.name)
        here.differences += compare_remaps(sides)
        outcome.differences += (with_users(difference, _users(difference, takers)) for difference in here.differences)
    outcome.differences += (
        configurations.one_sided(REMOVED, node, head.name) for node in pairs.removed if "?" not in node.name
    )
    outcome.differences += (
        configurations.one_sided(ADDED, node, head.name) for node in pairs.added if "?" not in node.name
    )
    removed, new_ones = (frozenset(node.name for node in nodes) for nodes in (pairs.removed, pairs.added))
    outcome.differences += compare_values(base, head, renamed, removed, new_ones, moved)
    rates = compare_rates(base, head, renamed)
    outcome.differences += rates.differences
    outcome.not_known += rates.not_known


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


def _not_of_files(
    found: list[Difference], in_files: list[Difference], base: ComparedRevision, head: ComparedRevision
) -> Iterator[Difference]:
    """*found* without the values that the parameter files themselves tell."""
    reported = {
        (side, place)
        for difference in in_files
        for side, place in (("base", difference.base), ("head", difference.head))
        if place
    }
    whole = {(side, place.path) for side, place in reported if place.line is None}
    of_files = set(base.values), set(head.values)
    for difference in found:
        if difference.what == "value" and difference.aspect != "file":
            places = [
                (side, place)
                for side, place in (("base", difference.base), ("head", difference.head))
                if place is not None
            ]
            if places and all(
                (side, _line(place)) in reported or (side, place.path) in whole for side, place in places
            ):
                continue
            if (
                difference.base
                and difference.head
                and difference.base.path in of_files[0]
                and difference.head.path in of_files[1]
            ):
                if any((side, _line(place)) in reported for side, place in places):
                    continue
        yield difference


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
