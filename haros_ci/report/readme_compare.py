# SPDX-License-Identifier: Apache-2.0
"""The documented rows of one package against its interfaces: what is missing, of another type, or with another default.

Nothing is said where an unknown of the model could explain a row.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache

from haros_ci.model.architecture import LIBRARY, Architecture, Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.report.channels import is_known
from haros_ci.report.model_json import Places
from haros_ci.report.node_interface import Entry, Interface, own_name
from haros_ci.report.readme_names import fits, is_group, may_be, same_tail, spelt
from haros_ci.report.readme_tables import TableRow
from haros_ci.report.readme_values import default_differs, is_value, type_differs

RULES = {kind: f"readme-{kind}" for kind in ("missing", "type", "default", "undocumented")}
NOUNS = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "servers": "service",
    "clients": "service client",
    "action_servers": "action server",
    "action_clients": "action client",
    "parameters": "parameter",
}
#: Kinds in which a row that speaks of a kind may be found, too: "Services" above a table may mean clients.
_ALSO = {"servers": ("clients",)}
#: The values that the parameter files of a package have for a key.
Settings = Callable[[str], Iterable[object]]
#: So many names that are not documented stand in one message.
LISTED = 12
_PARAMETER_KINDS = ("parameters", "getters", "setters")


@dataclass(frozen=True, slots=True)
class Disagreement:
    """One disagreement at a line of a README; *level* is warning, or note for what is only not documented."""

    path: str
    line: int
    level: str
    rule: str
    message: str


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """An endpoint with all the names that a document may give it; *forms* are those known in full, to be compared."""

    kind: str
    names: frozenset[str]
    forms: tuple[str, ...]
    end: Endpoint


@dataclass(frozen=True, slots=True)
class KnownPackage:
    """What the model knows of one package.

    *ends* are the endpoints of its nodes and those made in its files, *interfaces* its node types. *complete* says that
    all that its nodes have was seen. *outside* are the names of parameters and arguments that launch files set. *hosts*
    are the endpoints of each node that some of its files make an endpoint for, *home* tells which package a place is in.
    """

    ends: tuple[_End, ...]
    interfaces: tuple[Interface, ...]
    complete: bool
    outside: frozenset[str]
    hosts: tuple[tuple[_End, ...], ...]
    home: Callable[[Location | None], str | None]
    name: str


def known(every: Iterable[Interface], architecture: Architecture) -> dict[str, KnownPackage]:
    """What *architecture*, whose interfaces are *every*, knows of each package that it knows of at all."""
    home = _homes(architecture)
    ends: dict[str, dict[tuple[object, ...], _End]] = {}
    every_end: dict[tuple[object, ...], _End] = {}
    unseen: set[str] = set()
    own: dict[str, list[Interface]] = {}
    outside: set[str] = set()
    hosts: dict[str, list[tuple[_End, ...]]] = {}
    for configuration in architecture.configurations:
        outside.update(name for name, _ in configuration.arguments)
        outside.update(item.name.rpartition(":")[2] for item in configuration.parameters)
        for node in configuration.nodes:
            if node.kind != LIBRARY and not _is_complete(node):
                unseen.add(node.package)
            here: dict[_End, None] = {}
            for end in node.endpoints:
                kind = "parameters" if end.kind in _PARAMETER_KINDS else end.kind
                names = _names(node, end)
                key = (kind, names, end.type, repr(end.value), repr(end.effective), end.location, end.unknowns)
                item = every_end.get(key)
                if item is None:
                    forms = {spelt(name, kind == "parameters") for name in names if is_known(name)}
                    item = every_end[key] = _End(kind, names, tuple(sorted(forms)), end)
                here[item] = None
                for package in {node.package, home(end.location)} - {None}:
                    ends.setdefault(str(package), {})[key] = item
            for package in {home(end.location) for end in node.endpoints if not end.implicit} - {None, node.package}:
                hosts.setdefault(str(package), []).append(tuple(here))
    for interface in every:
        if interface.is_library:
            continue  # its documentation is not that of a node
        own.setdefault(interface.package, []).append(interface)
    return {
        package: KnownPackage(
            tuple(found.values()),
            tuple(own.get(package, ())),
            package in own and package not in unseen,
            frozenset(outside),
            tuple(hosts.get(package, ())),
            home,
            package,
        )
        for package, found in ends.items()
    }


def _is_complete(node: Node) -> bool:
    return bool(node.endpoints) and not any(why.field in ("endpoints", "package", "type") for why in node.unknowns)


def _homes(architecture: Architecture) -> Callable[[Location | None], str | None]:
    """The package that a location is in; asked once for each file."""
    place = Places(architecture.packages)
    split = cache(lambda path: place.split(path)[0])
    return lambda location: None if location is None else split(location.path)


def compare(
    path: str, documented: Sequence[TableRow], facts: KnownPackage, files: Settings = lambda key: ()
) -> Iterator[Disagreement]:
    """The differences between *documented*, the rows of the README at *path*, and *facts*.

    *files* gives the values that the package's own parameter files have for a key: a default in the document may be one.

    A table of parameters none of which is in the code is taken to be about something else. An absolute name may be what
    a launch file outside the workspace makes of one that no row has.
    """
    matches = [_found(row, facts) for row in documented]
    about_code = {row.table for row, (found, _) in zip(documented, matches, strict=True) if found}
    taken = {id(item) for found, _ in matches for item in found}
    left = [item for item in facts.ends if id(item) not in taken and not item.end.implicit]
    reported: set[tuple[int, str]] = set()
    for row, (found, way) in zip(documented, matches, strict=True):
        if found:
            agrees = way is not None and _is_said_elsewhere(row, found, documented)
            messages = (
                [] if agrees or way is is_group else list(_details(row, found, files, exact=way is not same_tail))
            )
        else:
            messages = (
                list(_missing(row, facts, left)) if row.table in about_code or row.kinds != ("parameters",) else []
            )
        for level, rule, message in messages:
            if (row.line, message) not in reported:
                reported.add((row.line, message))
                yield Disagreement(path, row.line, level, RULES[rule], message)
    yield from _undocumented(path, documented, facts)


def _names(node: Node, end: Endpoint) -> frozenset[str]:
    names: set[str] = set()
    for name in (end.name, end.original_name):
        own = own_name(node.name, name)
        if end.kind in _PARAMETER_KINDS:
            names |= {own, own.removeprefix("~/")}
            continue
        names |= {name, own, own_name(node.name.rpartition("/")[0] + "/?", name)}
        if not own.startswith("~"):
            names.add(name.removeprefix("/"))
    return frozenset(names)


def _found(row: TableRow, facts: KnownPackage) -> tuple[list[_End], Callable[[str, str], bool] | None]:
    """The endpoints that a row means, and in which way its name is theirs: in full, at the end, as that of a group."""
    kinds = _kinds(row)
    candidates = [item for item in facts.ends if item.kind in kinds]
    ways: tuple[Callable[[str, str], bool], ...] = (lambda a, b: a == b, fits, same_tail)
    for way in (*ways, is_group) if kinds == {"parameters"} else ways:
        found = [item for item in candidates if _named(row, item, way)]
        if found:
            return found, way
    return [], None


def _is_said_elsewhere(row: TableRow, found: Sequence[_End], documented: Sequence[TableRow]) -> bool:
    """Whether another row of that name has the default that the code or a launch file gives: this one is of another mode."""
    same = (other for other in documented if other is not row and other.names == row.names and other.kinds == row.kinds)
    values = [value for item in found for value in (item.end.value, item.end.effective) if value is not None]
    return row.default is not None and any(
        other.default is not None and other.default != row.default and default_differs(other.default, value) is False
        for other in same
        for value in values
    )


def _kinds(row: TableRow) -> set[str]:
    return {*row.kinds, *(also for kind in row.kinds for also in _ALSO.get(kind, ()))}


def _missing(row: TableRow, facts: KnownPackage, left: Sequence[_End]) -> Iterator[tuple[str, str, str]]:
    """Level, rule and message for a row that means nothing in the code, unless something unknown could be it."""
    name, kinds = row.names[0], _kinds(row)
    if not facts.complete or any(_may_explain(row, item) for item in facts.ends if item.kind in kinds):
        return
    if row.kinds == ("parameters",) and any(_tail_of(name, other) for other in facts.outside):
        return
    hosted = [item for ends in facts.hosts for item in ends if item.kind in kinds]
    if any(_named(row, item, way) for way in (fits, same_tail) for item in hosted):
        return  # made for its plug-in, or with its functions, by the code of another package
    remapped = (item for item in left if item.kind in kinds and _type_fits(row, item))
    if any(value.startswith("/") for value in row.names) and any(remapped):
        return
    what = " or ".join(NOUNS[kind] for kind in row.kinds)
    other = [item for item in facts.ends if item.kind not in kinds and _named(row, item, fits)]
    hint = f"; it is a {NOUNS[other[0].kind]} there{_at(other[0].end.location)}" if other else ""
    yield "warning", "missing", f"{what} {name} is documented, but is not in the code{hint}"


def _details(row: TableRow, found: Sequence[_End], files: Settings, *, exact: bool) -> Iterator[tuple[str, str, str]]:
    """Another type or default of a row that was found; of several candidates one that agrees is enough."""
    if not exact and len({(item.end.type, _text(item.end.value)) for item in found}) > 1:
        return
    what = f"{NOUNS[found[0].kind]} {row.names[0]}"
    at = _at(found[0].end.location)
    if row.type is not None and (exact or found[0].kind == "parameters"):
        fitting = [item for item in found if type_differs(row.type, item.kind, item.end.type) is not True]
        if not fitting:
            types = " and ".join(sorted({item.end.type or "?" for item in found}))
            yield "warning", "type", f"{what} has type {row.type} in the document, but {types} in the code{at}"
            return
        found = fitting
    if row.default is None or found[0].kind != "parameters" or any(_vague(item.end) for item in found):
        return
    coded = [item.end.value for item in found if item.end.value is not None]
    effective = [item.end.effective for item in found if item.end.effective is not None]
    if not _is_other_default(row.default, [*coded, *effective], files(_last(row.names[0]))):
        return
    texts = " and ".join(sorted({_text(value) for value in coded or effective}))
    says = f"{what} has default {row.default} in the document"
    if coded:
        yield "warning", "default", f"{says}, but {texts} in the code{at}"
    else:
        yield "note", "default", f"{says}; the code has none, launch files set {texts}{at}"


def _is_other_default(default: str, values: Sequence[object], set_in_files: Iterable[object]) -> bool:
    """Whether the documented *default* is a value that neither one of *values* nor a parameter file has."""
    if not values or not is_value(default):
        return False
    differs = [default_differs(default, value) for value in values]
    return all(verdict is True for verdict in differs) and not any(
        default_differs(default, value) is False for value in set_in_files
    )


def _undocumented(path: str, documented: Sequence[TableRow], facts: KnownPackage) -> Iterator[Disagreement]:
    """What the package's own nodes have beside what a README with a table of that kind says."""
    for kind in NOUNS:
        of_kind = [row for row in documented if kind in row.kinds or any(kind in _ALSO.get(k, ()) for k in row.kinds)]
        table = min((row.table for row in of_kind if kind in row.kinds), default=None)
        if table is None:
            continue
        by_name: dict[str, list[_End]] = {}
        for end in facts.ends:
            for name in end.names if end.kind == kind else ():
                by_name.setdefault(name, []).append(end)
        for item in facts.interfaces:
            own = [entry for entry in item.entries if entry.kind == kind and _is_made_here(entry, facts)]
            left = [
                entry
                for entry in own
                if is_known(entry.name) and not _is_documented(of_kind, by_name.get(entry.name, []))
            ]
            if left:
                yield Disagreement(path, table, "note", RULES["undocumented"], _lacks(left, kind, item.type))


def _is_made_here(entry: Entry, facts: KnownPackage) -> bool:
    """Whether code of the package makes it; that of another package has a README of its own."""
    return any(facts.home(end.location) in (facts.name, None) for end in entry.ends)


def _lacks(left: Sequence[Entry], kind: str, type: str) -> str:
    """The message on entries of a node type that no document names."""
    if len(left) == 1:
        typed = f" ({left[0].type})" if left[0].type else ""
        what = f"{NOUNS[kind]} {left[0].name}{typed} of {type}"
        return f"{what} is in the code, but not documented{_at(left[0].ends[0].location)}"
    names = list(dict.fromkeys(entry.name for entry in left))
    more = f" and {len(names) - LISTED} more" if len(names) > LISTED else ""
    what = f"{len(left)} {NOUNS[kind]}s of {type}"
    return f"{what} are in the code, but not documented: {', '.join(names[:LISTED])}{more}"


def _is_documented(documented: Sequence[TableRow], ends: Sequence[_End]) -> bool:
    ways = (fits, same_tail, is_group) if any(item.kind == "parameters" for item in ends) else (fits, same_tail)
    return any(_named(row, item, way) for way in ways for row in documented for item in ends)


def _named(row: TableRow, item: _End, same: Callable[[str, str], bool]) -> bool:
    dotted = item.kind == "parameters"
    return any(same(spelt(name, dotted), other) for name in row.names for other in item.forms)


def _may_explain(row: TableRow, item: _End) -> bool:
    """Whether *item*, whose name is not known in full, can be what the row means."""
    return _type_fits(row, item) and any(
        "?" in other and may_be(other, name) for other in item.names for name in row.names
    )


def _type_fits(row: TableRow, item: _End) -> bool:
    return row.type is None or type_differs(row.type, item.kind, item.end.type) is not True


def _tail_of(name: str, other: str) -> bool:
    return same_tail(spelt(name, True), spelt(other, True))


def _last(name: str) -> str:
    """The key that a parameter's name ends in."""
    return re.split(r"[./]", name.rstrip("./"))[-1]


def _vague(end: Endpoint) -> bool:
    return any(why.field in ("value", "default", "effective") for why in end.unknowns) and end.value is None


def _text(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return json.dumps(list(value), ensure_ascii=False, default=str)
    return str(value).lower() if isinstance(value, bool) else str(value) or '""'


def _at(location: Location | None) -> str:
    return f" ({location})" if location is not None else ""
