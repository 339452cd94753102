# SPDX-License-Identifier: Apache-2.0
"""Architecture conformance: what a file in the words of HAROS's ground truths declares, against what was found."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isclose
from typing import Any, TypeVar

from haros_ci.declared.declared import (
    LINKS,
    PLACE,
    TYPE_ALIASES,
    DeclaredEntity,
    Reading,
    near,
    place,
    read_nodes,
    read_parameters,
    shown,
)
from haros_ci.model.architecture import Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass

_RULES = {kind: f"architecture-{kind}" for kind in ("missing", "unexpected", "different", "unknown")}
_DEEPEST = 50
_UNSEEN = Unknown("endpoints", "no endpoint of the node was found; its code may not be in the workspace")
T = TypeVar("T", Node, Endpoint, Parameter)


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviation:
    """One deviation; *kind* is missing, unexpected, different or unknown, the last at level note.

    *entity* is node, parameter, configuration or the last word of a row of ``LINKS``; *node* its node's name or "";
    *attribute* the key of the file that differs, "" for the whole entity; *location* is the found entity's.
    """

    kind: str
    rule: str
    level: str
    entity: str
    node: str
    name: str
    message: str
    attribute: str = ""
    expected: Any = None
    found: Any = None
    location: Location | None = None


@dataclass(frozen=True, slots=True)
class _About:
    """What a found entity is, to say differences of it."""

    entity: str
    node: str
    name: str
    location: Location | None = None
    unknowns: tuple[Unknown, ...] = ()


def compare(configuration: Configuration, expected: object, packages: Sequence[Package]) -> tuple[Deviation, ...]:
    """How *configuration* deviates from its entry in *expected*, a file's parsed YAML ``{configuration: {...}}``.

    Only keys that are given are compared; a list or map that is given is complete, but for implicit endpoints. Within a
    node endpoints match one to one by name, then type. Unknown values never deviate, they are reported at level note; so is
    what is missing where a name with ``?`` may stand for it as well, as one call in a loop can make many. Parts of a
    wrong shape are passed over: ``problems`` tells them. Nothing is compared if *expected* has no such entry.
    """
    declared = expected.get(configuration.name) if isinstance(expected, Mapping) else None
    if not isinstance(declared, Mapping):
        return ()
    quiet: list[Problem] = []
    found: list[Deviation] = []
    launch = declared.get("launch")
    if isinstance(launch, list) and tuple(launch) != configuration.launch:
        about = _About("configuration", "", configuration.name)
        found.append(_described("different", about, "launch", launch, list(configuration.launch)))
    if (nodes := read_nodes(declared, Reading("", quiet), configuration.name)) is not None:
        found += _nodes(configuration.nodes, nodes, packages)
    if (parameters := read_parameters(declared, Reading("", quiet), configuration.name)) is not None:
        found += _all("parameter", "", configuration.parameters, parameters, (), packages)
    return tuple(sorted(found, key=lambda d: (d.node, d.entity != "node", d.entity, d.name, d.attribute, d.message)))


def problems(expected: object, where: str, configurations: Iterable[str] = ()) -> tuple[Problem, ...]:
    """What in *expected*, the parsed YAML of the file *where*, cannot be compared, and what to do about it.

    *configurations* are the names that the model has.
    """
    reading, names = Reading(where, []), tuple(configurations)
    for name, declared in reading.map(expected, "the file").items():
        if name not in names:
            reading.say(f"the model has no configuration {name!r}{near(name, names)}")
        entry = reading.map(declared, name, ("launch", "nodes", "parameters", "user_data"))
        if not isinstance(entry.get("launch", []), list):
            reading.say(f"{name}.launch must be a list of package/path")
        read_nodes(entry, reading, name)
        read_parameters(entry, reading, name)
    return tuple(reading.problems)


def may_be(unknown: str, name: str) -> bool:
    """Whether *unknown*, a name with ``?``, can stand for *name*; ``/?/`` may stand for ``/`` (as in HAROS)."""
    return _glob(unknown, name) or _glob(unknown.replace("/?/", "/"), name)


def _glob(pattern: str, name: str) -> bool:
    first, *rest = pattern.split("?")
    if not rest:
        return pattern == name
    if not (name.startswith(first) and len(name) >= len(first) + len(rest[-1]) and name.endswith(rest[-1])):
        return False
    at, end = len(first), len(name) - len(rest[-1])
    for part in rest[:-1]:
        at = name.find(part, at, end)
        if at < 0:
            return False
        at += len(part)
    return True


def _nodes(
    nodes: Sequence[Node], declared: Sequence[DeclaredEntity], packages: Sequence[Package]
) -> Iterator[Deviation]:
    yield from _all("node", "", nodes, declared, (), packages)
    for expected, node in _pairs(nodes, declared, packages)[0]:
        for kind, ends in expected.ends.items():
            declared_names = {end.name for end in ends}
            every = [end for end in node.endpoints if end.kind == kind]
            found = [end for end in every if not end.is_ruled_out or end.name in declared_names]
            opaque = [why for why in node.unknowns if why.field in (kind, "endpoints", "package", "type")]
            if not node.endpoints:
                opaque.append(_UNSEEN)
            yield from _all(LINKS[kind][3], node.name, found, ends, opaque, packages)


def _all(
    entity: str,
    node: str,
    found: Sequence[T],
    declared: Sequence[DeclaredEntity],
    opaque: Sequence[Unknown],
    packages: Sequence[Package],
) -> Iterator[Deviation]:
    """The differences of all of one kind; *opaque* says why there may be more than *found*."""
    pairs, missing, left = _pairs(found, declared, packages)
    for expected, item in pairs:
        about = _About(entity, node, item.name, item.location, item.unknowns)
        if item.name != expected.name:
            yield _described("unknown", about, "name", expected.name, item.name)
        yield from _attributes(about, expected, item, packages)
    for expected in missing:
        vague = next((item for item in found if "?" in item.name and _can_be(expected, item)), None)
        why = [Unknown("endpoints", f"{vague.name} may stand for more than one")] if vague else list(opaque)
        about = _About(entity, node, expected.name, vague.location if vague else None, tuple(why))
        yield _described("unknown" if why else "missing", about)
    for item in left:
        if not (isinstance(item, Endpoint) and item.implicit):
            about = _About(entity, node, item.name, item.location, item.unknowns)
            yield _described("unknown" if "?" in item.name else "unexpected", about)


def _attributes(
    about: _About, declared: DeclaredEntity, item: Node | Endpoint | Parameter, packages: Sequence[Package]
) -> Iterator[Deviation]:
    there = place(item.location, packages)
    unsure = any(why.field == "conditions" for why in item.unknowns)
    for key, expected in declared.fields.items():
        found = _found(key, item)
        if key == "traceability":
            found = {part: there.get(part) for part in PLACE if part in expected}
        elif key == "conditions":
            found = [{"statement": c.statement, "condition": c.condition, **place(c.location, packages)} for c in found]
        agree = _AGREE.get(key)
        if found == expected if agree is None else agree(found, expected):
            continue
        if key == "traceability":
            is_known = item.location is not None
        elif key in ("conditions", "conditional"):
            is_known = not unsure
        else:
            is_known = _is_known(key, found, item)
        yield _described("different" if is_known else "unknown", about, key, expected, found)


def _is_known(key: str, found: Any, item: Node | Endpoint | Parameter) -> bool:
    """Whether *found*, the value of an attribute, is all that it can be."""
    if key == "remaps":
        return not any("?" in text for pair in found.items() for text in pair)
    if key in ("value", "default_value"):
        return not any(why.field in ("value", "default_value") for why in item.unknowns)
    return found is not None and not (isinstance(found, str) and "?" in found)


def _found(key: str, item: Node | Endpoint | Parameter) -> Any:
    """The value of *item* that the file calls *key*."""
    if isinstance(item, Node) and key in ("node_type", "args", "remaps"):
        words = " ".join(item.arguments.split())
        return {"node_type": _type(item), "args": words, "remaps": dict(item.remaps)}[key]
    if key.endswith("_type"):
        return _type(item)
    if key == "conditional":
        return bool(item.conditions)
    return getattr(item, "value" if key == "default_value" else key, None)


def _type(item: Node | Endpoint | Parameter) -> str | None:
    if isinstance(item, Node):
        return f"{item.package}/{item.type}"
    return TYPE_ALIASES.get(item.type, item.type) if item.type else None


def _described(kind: str, about: _About, attribute: str = "", expected: Any = None, found: Any = None) -> Deviation:
    what = f"{about.entity} {about.name}" + (f" of node {about.node}" if about.node else "")
    label = {"launch": "launch", "traceability": "place"}.get(attribute, attribute)
    reason = next((f" ({w.reason})" for w in about.unknowns if w.field in (attribute, "type", "name", "endpoints")), "")
    match kind:
        case "missing":
            message = f"{what} is declared, but was not found."
        case "unexpected":
            message = f"{what} was found, but is not declared."
        case "different":
            message = f"{what}: {label} is {shown(found)}, but {shown(expected)} is declared."
        case _ if attribute:
            message = f"{what}: {label} is not known{reason}, {shown(expected)} is declared."
        case _:
            message = f"{what}: whether it is as declared is not known{reason}."
    return Deviation(
        kind=kind,
        rule=_RULES[kind],
        level="note" if kind == "unknown" else "warning",
        entity=about.entity,
        node=about.node,
        name=about.name,
        message=message,
        attribute=attribute,
        expected=expected,
        found=found,
        location=about.location,
    )


def _pairs(
    found: Sequence[T], declared: Sequence[DeclaredEntity], packages: Sequence[Package]
) -> tuple[list[tuple[DeclaredEntity, T]], list[DeclaredEntity], list[T]]:
    """One to one by name, the same type and place first; then by what an unknown name may be, as many as possible."""
    pairs: list[tuple[DeclaredEntity, T]] = []
    left, missing = list(found), list(declared)
    passes: tuple[Callable[[DeclaredEntity, T], bool], ...] = (
        lambda w, f: (
            w.type == _type(f) and w.fields.get("traceability", {}).items() <= place(f.location, packages).items()
        ),
        lambda w, f: w.type == _type(f),
        lambda w, f: w.type is None or _type(f) is None,
        lambda w, f: True,
    )
    for fits in passes:
        by_name: dict[str, list[T]] = {}
        for item in left:
            by_name.setdefault(item.name, []).append(item)
        taken, still = set(), []
        for expected in missing:
            match = next(
                (item for item in by_name.get(expected.name, ()) if id(item) not in taken and fits(expected, item)),
                None,
            )
            if match is None:
                still.append(expected)
            else:
                taken.add(id(match))
                pairs.append((expected, match))
        missing, left = still, [item for item in left if id(item) not in taken]
    vague = [item for item in left if "?" in item.name]
    chosen = _assigned([[n for n, item in enumerate(vague) if _can_be(expected, item)] for expected in missing])
    pairs += [(missing[n], vague[m]) for n, m in sorted(chosen.items())]
    used = {id(vague[m]) for m in chosen.values()}
    return pairs, [w for n, w in enumerate(missing) if n not in chosen], [i for i in left if id(i) not in used]


def _can_be(expected: DeclaredEntity, item: Node | Endpoint | Parameter) -> bool:
    kind = _type(item)
    return may_be(item.name, expected.name) and (kind is None or "?" in kind or expected.type in (None, kind))


def _assigned(options: Sequence[Sequence[int]]) -> dict[int, int]:
    """The largest one-to-one choice of an option for each (augmenting paths, breadth first)."""
    chosen: dict[int, int] = {}
    owner: dict[int, int] = {}
    for start in range(len(options)):
        parent: dict[int, int] = {}
        queue = deque([start])
        while queue:
            one = queue.popleft()
            new = [option for option in options[one] if option not in parent]
            parent.update(dict.fromkeys(new, one))
            free = next((option for option in new if option not in owner), None)
            if free is None:
                queue.extend(owner[option] for option in new)
                continue
            option: int | None = free
            while option is not None:
                taker = parent[option]
                owner[option] = taker
                previous = chosen.get(taker)
                chosen[taker], option = option, previous
            break
    return chosen


def _same(found: object, expected: object, depth: int = 0) -> bool:
    """Equal values; numbers as numbers, and ``$(find pkg)/x`` as any path that ends in ``pkg/x``."""
    if isinstance(found, bool) or isinstance(expected, bool) or depth > _DEEPEST:
        return found is expected or depth > _DEEPEST
    if isinstance(found, (int, float)) and isinstance(expected, (int, float)):
        return found == expected or (max(abs(found), abs(expected)) < 1e300 and isclose(found, expected, rel_tol=1e-9))
    if isinstance(found, str) and isinstance(expected, str) and expected.startswith("$(find "):
        package, _, rest = expected.removeprefix("$(find ").partition(")")
        return found == expected or f"/{found}".endswith(f"/{package.strip()}{rest}")
    if isinstance(found, (list, tuple)) and isinstance(expected, (list, tuple)):
        return len(found) == len(expected) and all(_same(a, b, depth + 1) for a, b in zip(found, expected, strict=True))
    return type(found) is type(expected) and found == expected


def _same_conditions(found: Sequence[Mapping[str, Any]], expected: Sequence[Mapping[str, Any]]) -> bool:
    return len(found) == len(expected) and all(
        want.items() <= have.items() for have, want in zip(found, expected, strict=True)
    )


#: When an attribute is as declared, where equality is not the question.
_AGREE: dict[str, Callable[[Any, Any], bool]] = {
    "args": _same,
    "conditions": _same_conditions,
    "default_value": _same,
    "value": _same,
}
