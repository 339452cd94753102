# SPDX-License-Identifier: Apache-2.0
"""Extraction hints of HAROS project files: what people know and the source does not say.

As HAROS 3.10 reads them (``config_builder.py:ConfigurationBuilder``, ``extractor.py:NodeHints2``), in its order; what
it drops in silence is said.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from haros_ci.declared.declared import (
    LINKS,
    Reading,
    end_keys,
    is_name,
    listed,
    misfit_of,
    named_entries,
    unfolded,
    value_type,
)
from haros_ci.declared.variables import CALLS, edited, fill, named, resolved, surroundings
from haros_ci.model.architecture import Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem

HINT_KEYS = ("nodes", "parameters", "fix")
NODE_KEYS = ("rosname", "args", "remaps", "traceability", "conditional", "node_type")
PARAMETER_KEYS = ("rosname", "param_type", "default_value", "traceability", "conditional")
SPEC_KEYS = ("fix", "rosname", "nodelet", "hpl", "user_data")


def applied(
    configuration: Configuration, packages: Sequence[Package], project: Mapping[str, Any], where: str
) -> tuple[Configuration, list[Problem]]:
    """*configuration* with all that the project file *where* says of its nodes, and what is wrong with that."""
    problems: list[Problem] = []
    if project.get("nodes"):
        configuration, found = apply_specifications(configuration, project["nodes"], where, packages)
        problems += found
    declared = project.get("configurations")
    entry = declared.get(configuration.name) if isinstance(declared, Mapping) else None
    hints = entry.get("hints") if isinstance(entry, Mapping) else None
    if isinstance(hints, Mapping):
        configuration, found = apply(configuration, hints, where, packages)
        problems += found
    return configuration, problems


def apply(
    configuration: Configuration, hints: Mapping[str, Any], where: str, packages: Sequence[Package] = ()
) -> tuple[Configuration, tuple[Problem, ...]]:
    """*configuration* with the ``hints`` of its entry in the project file *where*; their work has the source ``hint``.

    In order: ``fix``; parameters fixed, then created; nodes fixed, then created, each with its links. A hint without
    ``create`` is for the one entity that has its name now, ``?`` taken literally; a link that nothing fits is made
    anyway, with a notice, if the hint gives its type. *packages* place ``traceability``.
    """
    reading = Reading(where, [])
    sections = reading.map(hints, "hints", HINT_KEYS)
    result = fill(configuration, sections.get("fix"), reading, packages)
    parameters = list(result.parameters)
    for name, entry, at in named_entries(
        sections.get("parameters"), "hints.parameters", (*PARAMETER_KEYS, "create"), reading
    ):
        parameters = _parameter(parameters, name, entry, at, reading, packages)
    nodes = list(result.nodes)
    for name, entry, at in named_entries(sections.get("nodes"), "hints.nodes", (*NODE_KEYS, "create", *LINKS), reading):
        nodes = _node(nodes, name, entry, at, reading, packages)
    result = replace(result, parameters=tuple(parameters), nodes=tuple(nodes))
    return result, tuple(reading.problems)


def apply_specifications(
    configuration: Configuration, specifications: object, where: str, packages: Sequence[Package] = ()
) -> tuple[Configuration, tuple[Problem, ...]]:
    """*configuration* with the top-level ``nodes`` of a project file, ``{package/executable: {...}}``.

    Each node of that type gets the ``fix`` map and one endpoint for each entry of ``advertise``, ``subscribe``, ...
    """
    reading = Reading(where, [])
    kinds = {call: kind for kind, call in CALLS.items()}
    nodes = list(configuration.nodes)
    for type_name, item in reading.map(specifications, "nodes").items():
        at = f"nodes.{type_name}"
        entry = reading.map(item, at, (*SPEC_KEYS, *kinds))
        for n, node in enumerate(nodes):
            if f"{node.package}/{node.type}" != type_name:
                continue
            if "fix" in entry:
                alone = replace(configuration, nodes=(node,))
                node = fill(alone, entry["fix"], reading, packages).nodes[0]
            for call, kind in kinds.items():
                made = [
                    _call(node, kind, one, here, reading, packages) for one, here in listed(entry, call, at, reading)
                ]
                node = replace(node, endpoints=(*node.endpoints, *(end for end in made if end)))
            nodes[n] = node
    problems = tuple(dict.fromkeys(reading.problems))
    return replace(configuration, nodes=tuple(nodes)), problems


def _parameter(
    parameters: list[Parameter],
    name: str,
    entry: Mapping[str, Any],
    at: str,
    reading: Reading,
    packages: Sequence[Package],
) -> list[Parameter]:
    full = resolved(name, "/")
    fields = reading.fields(entry, PARAMETER_KEYS, at)
    fits = [n for n, item in enumerate(parameters) if item.name == full]
    if entry.get("create"):
        if fits:
            reading.say(f"{at}: {full} is there already; remove 'create' to change it")
        elif "param_type" not in fields:
            reading.say(f"{at}: a parameter to create needs a 'param_type'")
        else:
            blank = Parameter(name=full, type=None, value=None, source="hint")
            return [*parameters, *_leaves(blank, fields, at, reading, packages)]
        return parameters
    if len(fits) != 1:
        reading.say(f"{at}: {misfit_of('parameter', full, len(fits), [item.name for item in parameters])}")
        return parameters
    n = fits[0]
    return [*parameters[:n], *_leaves(parameters[n], fields, at, reading, packages), *parameters[n + 1 :]]


def _leaves(
    old: Parameter, fields: Mapping[str, Any], at: str, reading: Reading, packages: Sequence[Package]
) -> Iterator[Parameter]:
    """*old* as hinted; more than one parameter where its value is a map."""
    new = surroundings(old.location, old.conditions, fields, reading, packages, at)
    name = resolved(fields["rosname"] or "?", "/") if "rosname" in fields else old.name
    done = {*new, *(("name",) if "?" not in name else ())}
    if "param_type" in fields:
        new["type"] = fields["param_type"]
        done.add("type")
    if "default_value" not in fields:
        leaves = [(name, old.value)]
    else:
        leaves = list(unfolded(name, fields["default_value"], reading, at))
        done |= {"value", "default_value"}
    unknowns = tuple(why for why in old.unknowns if why.field not in done)
    for full, value in leaves:
        kind = new.get("type", old.type) if full == name else None
        about = {**new, "name": full, "value": value, "type": kind or value_type(value), "unknowns": unknowns}
        result = replace(old, **about)
        yield result if result == old else replace(result, source="hint")


def _node(
    nodes: list[Node],
    name: str,
    entry: Mapping[str, Any],
    at: str,
    reading: Reading,
    packages: Sequence[Package],
) -> list[Node]:
    full = resolved(name, "/")
    fields = reading.fields(entry, NODE_KEYS, at)
    fits = [n for n, node in enumerate(nodes) if node.name == full]
    if entry.get("create") and not fits:
        if "node_type" not in fields:
            if "node_type" not in entry:
                reading.say(f"{at}: a node to create needs a 'node_type', as package/executable")
            return nodes
        return [*nodes, _links(_created(full, fields, at, reading, packages), True, entry, at, reading, packages)]
    if len(fits) != 1:
        reading.say(f"{at}: {misfit_of('node', full, len(fits), [node.name for node in nodes])}")
        return nodes
    if entry.get("create"):
        reading.say(f"{at}: the node is there already, so it is changed, not created; remove 'create'")
    old = nodes[fits[0]]
    if "node_type" in fields and fields["node_type"] != f"{old.package}/{old.type}":
        reading.say(f"{at}: the type of a node that was found cannot be changed; it stays {old.package}/{old.type}")
    new = _links(_fixed(old, fields, at, reading, packages), False, entry, at, reading, packages)
    return [*nodes[: fits[0]], new, *nodes[fits[0] + 1 :]]


def _created(name: str, fields: Mapping[str, Any], at: str, reading: Reading, packages: Sequence[Package]) -> Node:
    package, _, kind = fields["node_type"].partition("/")
    arguments = fields.get("args", "")
    verb, *words = arguments.split() or [""]
    is_nodelet = verb in ("load", "standalone") and words[:1] == [fields["node_type"]]
    return Node(
        name=name,
        kind="nodelet" if is_nodelet else "node",
        package=package,
        type=kind,
        arguments=arguments,
        remaps=_remaps(fields, name),
        container=resolved(words[1], name) if is_nodelet and verb == "load" and len(words) > 1 else None,
        source="hint",
        **surroundings(None, (), fields, reading, packages, at),
    )


def _fixed(node: Node, fields: Mapping[str, Any], at: str, reading: Reading, packages: Sequence[Package]) -> Node:
    """*node* as hinted; its endpoints follow new remaps, and its private ones a new name."""
    name = resolved(fields["rosname"] or "?", "/") if "rosname" in fields else node.name
    moved = [(_moved(a, node.name, name), _moved(b, node.name, name)) for a, b in node.remaps]
    remaps = _remaps(fields, name) if "remaps" in fields else tuple(moved)
    before, after = dict(node.remaps), dict(remaps)
    ends = []
    for end in node.endpoints:
        original = _moved(end.original_name, node.name, name)
        follows = end.name == before.get(end.original_name, end.original_name)
        ends.append(named(end, original, after.get(original, original)) if follows else end)
    new = surroundings(node.location, node.conditions, fields, reading, packages, at)
    new |= {"arguments": fields["args"]} if "args" in fields else {}
    done = {*new, *(("args",) if "args" in fields else ()), *(("name",) if "?" not in name else ())}
    own = replace(
        node, **new, name=name, remaps=remaps, unknowns=tuple(u for u in node.unknowns if u.field not in done)
    )
    return replace(own, endpoints=tuple(ends), source=node.source if own == node else "hint")


def _moved(name: str, old: str, new: str) -> str:
    """*name*, if it is private to the node called *old*, as private to *new*; unknown names stay as they are."""
    return f"{new}{name[len(old) :]}" if "?" not in old and name.startswith(f"{old}/") else name


def _remaps(fields: Mapping[str, Any], node: str) -> tuple[tuple[str, str], ...]:
    return tuple((resolved(a, node), resolved(b, node)) for a, b in fields.get("remaps", {}).items())


def _links(
    node: Node, is_new: bool, entry: Mapping[str, Any], at: str, reading: Reading, packages: Sequence[Package]
) -> Node:
    """*node* with its endpoints fixed and created; hints are matched with the names from before all of them."""
    ends, names = list(node.endpoints), [(end.kind, end.name) for end in node.endpoints]
    for kind, (name_key, type_key, _, noun) in LINKS.items():
        keys = (type_key, "original_name", "traceability", "conditional", *end_keys(kind))
        for item, here in listed(entry, kind, at, reading):
            link = reading.map(item, here, (name_key, "create", *keys))
            fields = reading.fields(link, keys, here)
            name = link.get(name_key)
            if not (isinstance(name, str) and is_name(name)):
                if isinstance(item, Mapping):
                    reading.say(f"{here} needs a {name_key!r}: a ROS name as text")
                continue
            full = _full(name, node)
            fits = [n for n, pair in enumerate(names) if pair == (kind, full)] or _known_now(
                ends, kind, full, fields, node
            )
            misfit = misfit_of(noun, full, len(fits), [other for own, other in names if own == kind])
            is_wanted = bool(link.get("create")) or is_new
            there = [n for n in fits if ends[n].type in (None, fields.get(type_key, ends[n].type))] if is_wanted else []
            if there and not is_new:
                reading.say(f"{here}: {node.name} has {full} without this hint; it adds only what was not known")
                ends[there[0]] = _completed(ends[there[0]], kind, fields, reading, packages, here)
            elif not is_wanted and len(fits) == 1:
                end = edited(ends[fits[0]], fields, reading, packages, here)
                if "original_name" in fields:
                    original = _full(fields["original_name"] or "?", node)
                    end = named(end, original, dict(node.remaps).get(original, original))
                    if end.written is None or "?" in end.written:
                        end = replace(end, written=fields["original_name"])
                ends[fits[0]] = end
            elif not is_wanted and fits:
                reading.say(f"{here}: {misfit}")
            elif type_key not in fields:
                why = "a link to create" if is_wanted else f"{misfit}; to make one, it"
                reading.say(f"{here}: {why} needs a {type_key!r}")
            else:
                if not is_wanted:
                    reading.say(f"{here}: {misfit}; it was created; write 'create: true' if that is meant")
                ends.append(_made(node, kind, full, fields, here, reading, packages))
    return replace(node, endpoints=tuple(ends))


def _known_now(ends: Sequence[Endpoint], kind: str, name: str, fields: Mapping[str, Any], node: Node) -> list[int]:
    """The one link that a hint for a *name* with ``?`` means, where the name is known now and is the hint's ``original_name``."""
    if "?" not in name or not fields.get("original_name"):
        return []
    original = _full(fields["original_name"], node)
    found = [n for n, end in enumerate(ends) if end.kind == kind and end.original_name == original]
    return found if len(found) == 1 else []


def _completed(
    end: Endpoint, kind: str, fields: Mapping[str, Any], reading: Reading, packages: Sequence[Package], at: str
) -> Endpoint:
    """*end* with those values of a hint that were not known."""
    have = {
        LINKS[kind][1]: end.type,
        "queue_size": end.queue_size,
        "latched": end.latched,
        "traceability": end.location,
    }
    new = {key: value for key, value in fields.items() if key in have and have[key] is None}
    return edited(end, new, reading, packages, at)


def _made(
    node: Node,
    kind: str,
    name: str,
    fields: Mapping[str, Any],
    at: str,
    reading: Reading,
    packages: Sequence[Package],
) -> Endpoint:
    original = _full(fields["original_name"] or "?", node) if "original_name" in fields else name
    final = name if "original_name" in fields else dict(node.remaps).get(name, name)
    blank = Endpoint(
        kind=kind,
        name=final,
        original_name=original,
        type=None,
        location=None,
        latched=False if kind == "publishers" else None,
        source="hint",
        written=fields.get("original_name") or name,
        unknowns=(Unknown("queue_size", "the hint gives no queue_size"),) if "queue_size" in end_keys(kind) else (),
    )
    return edited(blank, fields, reading, packages, at)


def _call(
    node: Node, kind: str, item: object, at: str, reading: Reading, packages: Sequence[Package]
) -> Endpoint | None:
    """The endpoint of one entry of ``advertise``, ``subscribe``, ...; its name is resolved in its namespace."""
    type_key = LINKS[kind][1]
    keys = (type_key, "location", *end_keys(kind))
    entry = reading.map(item, at, ("name", "namespace", *keys))
    fields = reading.fields(entry, keys, at)
    name, space = entry.get("name"), entry.get("namespace") or ""
    if not (isinstance(name, str) and is_name(name) and isinstance(space, str) and (not space or is_name(space))):
        reading.say(f"{at} needs a 'name', and takes a 'namespace', both ROS names as text")
    elif type_key not in fields:
        reading.say(f"{at} needs a {type_key!r}")
    else:
        full = resolved(name if name[0] in "/~" or not space else f"{space.rstrip('/')}/{name}", node.name)
        fields = {**fields, "traceability": fields["location"]} if "location" in fields else fields
        return replace(_made(node, kind, full, fields, at, reading, packages), written=name)
    return None


def _full(name: str, node: Node) -> str:
    """A link's name in full: private to its node, else below ``/`` (as in HAROS)."""
    return resolved(name, node.name if name.startswith("~") else "/")
