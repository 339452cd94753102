# SPDX-License-Identifier: Apache-2.0
"""From a known node type and how one is started to its endpoints: holes filled, names resolved and remapped."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

from haros_ci.link.known.entry import KnownEndpoint, KnownNode
from haros_ci.link.known.start import Start, called, filled
from haros_ci.link.known.text import Each, Test, literal
from haros_ci.link.names import UNKNOWN, clean, resolve
from haros_ci.model.architecture import Endpoint, Unknown

_NAME = re.compile(r"~|[~/]?[A-Za-z0-9_?][A-Za-z0-9_?/]*")
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
) -> tuple[Endpoint, ...]:
    """The endpoints of a node of that type: full *name*, in *namespace*, started with *arguments*.

    *parameter* gives the value of a parameter by its full name: data, None if it is not set, an ``Unknown`` or a value
    that is not wholly known. *remap* maps a resolved name to the final one. An endpoint that may be there or not has an
    unknown ``conditions``; without a *distribution* so has one that only some have.
    """
    if distribution is not None and node.distributions and distribution not in node.distributions:
        return ()
    start = Start(name, namespace, arguments, parameter, remap, distribution)
    return tuple(_once(end for known in node.endpoints for end in _ends(known, start)))


def _once(ends: Iterable[Endpoint]) -> Iterator[Endpoint]:
    seen = set()
    for end in ends:
        key = (end.kind, end.original_name, end.type)
        if key not in seen:
            seen.add(key)
            yield end


def _ends(known: KnownEndpoint, start: Start) -> Iterator[Endpoint]:
    unknowns: list[Unknown] = []
    if known.distributions and start.distribution not in known.distributions:
        if start.distribution is not None:
            return
        unknowns.append(Unknown("conditions", f"it is only in ROS {', '.join(known.distributions)}"))
    for tests, wanted in ((known.present, True), (known.absent, False)):
        for test in tests:
            held = _holds(test, start)
            if isinstance(held, Unknown):
                unknowns.append(held)
            elif held is not wanted:
                return
    for item, why in _items(known.each, start):
        end = _end(known, replace(start, item=item), [*unknowns, *([why] if why else [])])
        if end is not None:
            yield end


def _end(known: KnownEndpoint, start: Start, unknowns: list[Unknown]) -> Endpoint | None:
    text, said = filled(known.name, start)
    if not text:
        return None
    if text.startswith("~/"):
        text = text[1:]
    if not _NAME.fullmatch(text):
        said, text = [*said, Unknown("name", f"{text[:60]!r} is no ROS name")], UNKNOWN
    unknowns = list(dict.fromkeys([*unknowns, *said]))
    full = resolve(text, start.namespace, start.name)
    if known.type is None:
        unknowns.append(Unknown("type", known.type_reason))
    if known.value_reason:
        unknowns.append(Unknown("value", known.value_reason))
    queue = latched = None
    if known.kind in ("publishers", "subscribers"):
        queue = _setting(known.queue_size, start, "queue_size", int, unknowns)
    if known.kind == "publishers":
        latched = _setting(known.latched, start, "latched", bool, unknowns)
    return Endpoint(
        kind=known.kind,
        name=full if UNKNOWN in full else clean(start.remap(full)),
        original_name=full,
        type=known.type,
        location=None,
        queue_size=queue,
        latched=latched,
        value=known.value,
        implicit=known.implicit,
        source="known-node",
        unknowns=tuple(unknowns),
    )


def _setting(given: Any, start: Start, field: str, kind: type, unknowns: list[Unknown]) -> Any:
    if given is None:
        unknowns.append(Unknown(field, "the data on this node does not tell it"))
    if not isinstance(given, Test):
        return given
    value = start.value(given.about)
    if value is None and given.default is not None:
        value = literal(given.default)
    if type(value) is kind:
        return value
    shape = "true or false" if kind is bool else "a whole number"
    why = value if isinstance(value, Unknown) else Unknown(field, f"{given.about} is not {shape}")
    unknowns.append(replace(why, field=field))
    return None


def _items(each: Each | None, start: Start) -> Iterator[tuple[object, Unknown | None]]:
    if each is None:
        yield None, None
    elif each.kind == "args":
        words, why = start.words(int(each.about))
        yield from ((word, None) for word in words)
        if why is not None:
            yield UNKNOWN, why
    elif each.kind == "numbered":
        for n in range(_NUMBERED):
            value = start.value(f"{each.about}{n}")
            if value is None:
                return
            yield value, None
            if isinstance(value, Unknown) and value.field == "presence":
                return
    else:
        value = start.value(each.about)
        if isinstance(value, (list, tuple)):
            yield from ((item, None) for item in value[:_MOST])
        elif value is not None:
            why = value if isinstance(value, Unknown) else Unknown("name", f"{each.about} is no list")
            yield UNKNOWN, replace(why, field="name")


def _holds(test: Test, start: Start) -> bool | Unknown:
    if test.kind == "unknown":
        return Unknown("conditions", test.about)
    value = start.value(test.about) if test.kind == "param" else start.word(test.kind, test.about)
    about = called(test.kind, test.about)
    if isinstance(value, Unknown):
        return Unknown("conditions", f"it depends on {about}: {value.reason}", value.location)
    default = literal(test.default) if test.default is not None else None
    if value is None:
        value = default
    elif test.wanted is None and isinstance(default, bool) and not isinstance(value, bool):
        return Unknown("conditions", f"it depends on {about}, which is neither true nor false")
    if test.wanted is not None:
        return value in (literal(test.wanted), test.wanted)
    return value not in (None, False, "", 0)
