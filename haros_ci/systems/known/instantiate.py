# SPDX-License-Identifier: Apache-2.0
"""From a known node type and how one is started to its endpoints: holes filled, names resolved and remapped."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

from haros_ci.graph.names import UNKNOWN, clean, resolve
from haros_ci.index.ros_types import SERIALISED
from haros_ci.model.architecture import Endpoint, Unknown
from haros_ci.regex import regex
from haros_ci.systems.known.entry import KnownEndpoint, KnownNode
from haros_ci.systems.known.parameter import declared
from haros_ci.systems.known.quality import quality
from haros_ci.systems.known.shape import SUBFOLDERS
from haros_ci.systems.known.start import Start, called, filled
from haros_ci.systems.known.text import Repetition, Test, fields, literal

_NAME = regex(r"~|[~/]?[A-Za-z0-9_?][A-Za-z0-9_?/]*")
_MOST = 1000
_NUMBERED = 100


def instantiate(
    node: KnownNode,
    *,
    name: str,
    namespace: str,
    arguments: tuple[str, ...],
    parameter: Callable[[str], object | None],
    remap: Callable[[str], str],
    distribution: str | None = None,
    ros: int = 1,
    below: Callable[[str], Iterable[str] | Unknown] | None = None,
    file: Callable[[str], object | None] | None = None,
) -> tuple[Endpoint, ...]:
    """The endpoints of a node of that type: full *name*, in *namespace*, started with *arguments*.

    *parameter* gives the value of a parameter by its full name: data, None if it is not set, an ``Unknown`` or a value
    that is not wholly known. *remap* maps a resolved name to the final one. An endpoint that may be there or not has an
    unknown ``conditions``; without a *distribution* so has one that only some have.

    With *ros* 2 the full name of a parameter is ``/ns/node:dotted.name``. *below* gives those names of parameters, dotted
    and without the node's, that are set for the node and begin with a text, or why that is not known. *file* reads a YAML file
    by the path that a parameter has (data, an ``Unknown``, None if there is none).
    """
    if distribution is not None and node.distributions and distribution not in node.distributions:
        return ()
    start = Start(name, namespace, arguments, parameter, remap, distribution, None, ros, below, file)
    return tuple(_once(end for known in node.endpoints for end in _ends(known, start)))


def _once(ends: Iterable[Endpoint]) -> Iterator[Endpoint]:
    seen = set()
    for end in ends:
        key = (end.kind, end.original_name, end.type)
        if key not in seen:
            seen.add(key)
            yield end


def _ends(known: KnownEndpoint, start: Start) -> Iterator[Endpoint]:
    if known.kind in (("getters", "setters") if start.ros == 2 else ("parameters",)):
        return
    unknowns: list[Unknown] = []
    if known.distributions and start.distribution not in known.distributions:
        if start.distribution is not None:
            return
        unknowns.append(Unknown("conditions", f"it is only in ROS {', '.join(known.distributions)}"))
    for item, why in _items(known.each, start):
        here = replace(start, item=item)
        undecided = _undecided(known, here)
        end = None
        if undecided is not None:
            end = _end(known, here, [*unknowns, *undecided, *([why] if why else [])])
        if end is not None:
            yield end


def _undecided(known: KnownEndpoint, start: Start) -> list[Unknown] | None:
    """Why it is not known that the endpoint is there; None if it is not."""
    unknowns = []
    for tests, expected in ((known.present, True), (known.absent, False)):
        for test in tests:
            held = _holds(test, start)
            if isinstance(held, Unknown):
                unknowns.append(held)
            elif held is not expected:
                return None
    return unknowns


def _end(known: KnownEndpoint, start: Start, unknowns: list[Unknown]) -> Endpoint | None:
    if known.kind == "parameters":
        return declared(known, start, unknowns)
    text, messages = filled(known.name, start)
    if not text:
        return None
    if text.startswith("~/"):
        text = text[1:] if start.ros == 1 else f"~{text[2:]}"
    if not _NAME.fullmatch(text):
        messages, text = [*messages, Unknown("name", f"{text[:60]!r} is no ROS name")], UNKNOWN
    unknowns = list(dict.fromkeys([*unknowns, *messages]))
    full = resolve(text, start.namespace, start.name)
    type_name, untyped = _type(known, start)
    if untyped is not None:
        unknowns.append(untyped)
    if known.value_reason:
        unknowns.append(Unknown("value", known.value_reason))
    queue = latched = qos = None
    topic = known.kind in ("publishers", "subscribers")
    if topic and start.ros == 2:
        number = known.queue_size if isinstance(known.queue_size, int) else None
        qos, messages = quality(known, start, number, known.latched is True)
        unknowns += messages
    elif topic:
        queue = _setting(known.queue_size, start, "queue_size", int, unknowns)
    elif start.ros == 2 and known.qos is not None:
        qos, messages = quality(known, start, None, None)
        unknowns += messages
    if known.kind == "publishers" and start.ros == 1:
        latched = _setting(known.latched, start, "latched", bool, unknowns)
    return Endpoint(
        kind=known.kind,
        name=full if UNKNOWN in full else clean(start.remap(full)),
        original_name=full,
        type=type_name,
        location=None,
        queue_size=queue,
        latched=latched,
        value=known.value,
        implicit=known.implicit,
        source="known-node",
        qos=qos,
        unknowns=tuple(unknowns),
        written=text,
    )


def _type(known: KnownEndpoint, start: Start) -> tuple[str | None, Unknown | None]:
    """The type, as this version of ROS writes it."""
    name = known.type
    if known.type_text is not None:
        name, messages = filled(known.type_text, start)
        if messages:
            return None, replace(messages[0], field="type")
        if not re.fullmatch(r"\w+(/\w+){1,2}", name):
            return None, Unknown("type", f"{name[:60]!r} is no type")
    if name is None:
        return None, Unknown("type", known.type_reason)
    parts = name.split("/")
    if known.kind in SUBFOLDERS and start.ros == 2 and len(parts) == 2:
        parts.insert(1, SUBFOLDERS[known.kind])
    elif known.kind in SUBFOLDERS and start.ros == 1 and len(parts) == 3:
        del parts[1]
    written = "/".join(parts)
    return SERIALISED.get(written, written), None


def _setting(provided: Any, start: Start, field: str, kind: type, unknowns: list[Unknown]) -> Any:
    if provided is None:
        unknowns.append(Unknown(field, "the data on this node does not tell it"))
    if not isinstance(provided, Test):
        return provided
    value = start.value(provided.about)
    if value is None and provided.default is not None:
        value = literal(provided.default)
    if type(value) is kind:
        return value
    shape = "true or false" if kind is bool else "a whole number"
    why = value if isinstance(value, Unknown) else Unknown(field, f"{provided.about} is not {shape}")
    unknowns.append(replace(why, field=field))
    return None


def _items(entry: Repetition | None, start: Start) -> Iterator[tuple[object, Unknown | None]]:
    if entry is None:
        yield None, None
    elif entry.kind == "args":
        words, why = start.words(int(entry.about))
        shaped = ((fields(entry.shape, word) if entry.shape else word) for word in words)
        yield from ((item, None) for item in shaped if item is not None)
        if why is not None:
            yield UNKNOWN, why
    elif entry.kind == "children":
        yield from _children(entry.about, start)
    elif entry.kind == "file":
        yield from _content(entry.about, start)
    elif entry.kind == "numbered":
        for n in range(_NUMBERED):
            value = start.value(f"{entry.about}{n}")
            if value is None:
                return
            yield value, None
            if isinstance(value, Unknown) and value.field == "presence":
                return
    else:
        value = start.value(entry.about)
        if isinstance(value, (list, tuple)):
            yield from ((item, None) for item in value[:_MOST])
        elif value is not None:
            why = value if isinstance(value, Unknown) else Unknown("name", f"{entry.about} is no list")
            yield UNKNOWN, replace(why, field="name")


def _children(about: str, start: Start) -> Iterator[tuple[object, Unknown | None]]:
    prefix = f"{about.lstrip('~')}."
    names = start.below(prefix) if start.below else Unknown("name", f"what is set below {about} is not known")
    if isinstance(names, Unknown):
        yield UNKNOWN, replace(names, field="name")
        return
    children = {name[len(prefix) :].partition(".")[0] for name in names if name.startswith(prefix)}
    for child in sorted(children - {""})[:_MOST]:
        sure = UNKNOWN not in child
        yield (child if sure else UNKNOWN), None if sure else Unknown("name", f"what is set below {about} is not known")


def _content(about: str, start: Start) -> Iterator[tuple[object, Unknown | None]]:
    path = start.value(about)
    if path in (None, ""):
        return
    found: object = path
    if isinstance(path, str):
        found = start.file(path) if start.file else None
    if isinstance(found, (list, tuple)):
        yield from ((item, None) for item in found[:_MOST])
        return
    why = found if isinstance(found, Unknown) else Unknown("name", f"the file that {about} names could not be read")
    yield UNKNOWN, replace(why, field="name")


def _holds(test: Test, start: Start) -> bool | Unknown:
    if test.kind == "unknown":
        return Unknown("conditions", test.about)
    value: object | None
    if test.kind == "item":
        value = start.member(test.about)
        if value == UNKNOWN:
            return Unknown("conditions", "which item of the list it is, is not known")
        value = None if isinstance(start.item, str) else value
    else:
        value = start.value(test.about) if test.kind == "param" else start.word(test.kind, test.about)
    about = called(test.kind, test.about)
    if isinstance(value, Unknown):
        return Unknown("conditions", f"it depends on {about}: {value.reason}", value.location)
    default = literal(test.default) if test.default is not None else None
    if value is None:
        value = default
    elif test.expected is None and isinstance(default, bool) and not isinstance(value, bool):
        return Unknown("conditions", f"it depends on {about}, which is neither true nor false")
    if test.expected is not None:
        return value in (literal(test.expected), test.expected)
    return value not in (None, False, "", 0)
