# SPDX-License-Identifier: Apache-2.0
"""From a known node type and how one is started to its endpoints: holes filled, names resolved and remapped."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from haros_ci.link.known.entry import KnownEndpoint, KnownNode
from haros_ci.link.known.text import Each, Hole, Template, Test, literal
from haros_ci.link.names import UNKNOWN, clean, resolve
from haros_ci.link.values import Choice, Known, Mapped, Opaque, Sequence, Text, data_of, opaque_of
from haros_ci.model.architecture import Endpoint, Unknown

_NAME = re.compile(r"~|[~/]?[A-Za-z0-9_?][A-Za-z0-9_?/]*")
_MOST = 1000
_NUMBERED = 100
_NO_ITEM = object()
_VALUES = (Choice, Known, Mapped, Opaque, Sequence, Text)
Names = Callable[[str], str]


@dataclass(frozen=True, slots=True)
class _Start:
    name: str
    namespace: str
    arguments: tuple[str, ...]
    parameter: Callable[[str], object | None]
    remap: Names
    distribution: str | None
    item: object = _NO_ITEM

    def value(self, name: str) -> object | None:
        """A parameter: None if it is not set, an Unknown if its value is no data."""
        found = self.parameter(resolve(name, self.namespace, self.name))
        if isinstance(found, _VALUES):
            known, data = data_of(found)
            if known:
                return data
            why = opaque_of(found)
            return Unknown("value", why.reason if why else "it is not plain data", why.location if why else None)
        return found

    def words(self, first: int) -> tuple[tuple[str, ...], Unknown | None]:
        """The arguments from *first* on up to one that is not known; remappings do not count (wiki.ros.org/Remapping)."""
        words = [word for word in self.arguments if ":=" not in word]
        for n, word in enumerate(words):
            if UNKNOWN in word:
                return tuple(words[first:n]), Unknown("name", "an argument on the command line is not known")
        return tuple(words[first:]), None


def instantiate(
    node: KnownNode,
    *,
    name: str,
    namespace: str,
    arguments: tuple[str, ...],
    parameter: Callable[[str], object | None],
    remap: Names,
    distribution: str | None = None,
) -> tuple[Endpoint, ...]:
    """The endpoints of a node of that type: full *name*, in *namespace*, started with *arguments*.

    *parameter* gives the value of a parameter by its full name: data, None if it is not set, an ``Unknown`` or a value
    that is not wholly known. *remap* maps a resolved name to the final one. An endpoint that may be there or not has an
    unknown ``conditions``. Without a *distribution* one that is not of all of them has so, too.
    """
    start = _Start(name, namespace, arguments, parameter, remap, distribution)
    if distribution is not None and node.distributions and distribution not in node.distributions:
        return ()
    made = [end for known in node.endpoints for end in _ends(known, start)]
    return tuple(_unique(made))


def _unique(ends: list[Endpoint]) -> Iterator[Endpoint]:
    seen = set()
    for end in ends:
        key = (end.kind, end.original_name, end.type)
        if key not in seen:
            seen.add(key)
            yield end


def _ends(known: KnownEndpoint, start: _Start) -> Iterator[Endpoint]:
    unknowns: list[Unknown] = []
    if known.distributions and start.distribution not in known.distributions:
        if start.distribution is not None:
            return
        unknowns.append(Unknown("conditions", f"it is only in ROS {', '.join(known.distributions)}"))
    for tests, wanted in ((known.present, True), (known.absent, False)):
        for test in tests:
            held = _holds(test, start)
            if isinstance(held, Unknown):
                unknowns.append(replace(held, field="conditions"))
            elif held is not wanted:
                return
    for item, why in _items(known.each, start):
        end = _end(known, replace(start, item=item), [*unknowns, *([why] if why else [])])
        if end is not None:
            yield end


def _end(known: KnownEndpoint, start: _Start, unknowns: list[Unknown]) -> Endpoint | None:
    text, said = _filled(known.name, start)
    if not text:
        return None
    if text.startswith("~/"):
        text = text[1:]
    if not _NAME.fullmatch(text):
        said, text = [*said, Unknown("name", f"{text[:60]!r} is no ROS name")], UNKNOWN
    unknowns = list(dict.fromkeys([*unknowns, *said]))
    full = resolve(text, start.namespace, start.name)
    final = full if UNKNOWN in full else clean(start.remap(full))
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
        name=final,
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


def _setting(given: Any, start: _Start, field: str, kind: type, unknowns: list[Unknown]) -> Any:
    if given is None:
        unknowns.append(Unknown(field, "the data on this node does not tell it"))
    if not isinstance(given, Test):
        return given
    value = start.value(given.about)
    if value is None and given.default is not None:
        value = literal(given.default)
    if type(value) is kind:
        return value
    why = value if isinstance(value, Unknown) else Unknown(field, f"{given.about} is no {kind.__name__}")
    unknowns.append(replace(why, field=field))
    return None


def _items(each: Each | None, start: _Start) -> Iterator[tuple[object, Unknown | None]]:
    if each is None:
        yield _NO_ITEM, None
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
    else:
        value = start.value(each.about)
        if isinstance(value, (list, tuple)):
            yield from ((item, None) for item in value[:_MOST])
        elif value is not None:
            why = value if isinstance(value, Unknown) else Unknown("name", f"{each.about} is no list")
            yield UNKNOWN, replace(why, field="name")


def _holds(test: Test, start: _Start) -> bool | Unknown:
    if test.kind == "unknown":
        return Unknown("conditions", test.about)
    value = start.value(test.about) if test.kind == "param" else _word(test.kind, test.about, start)
    if isinstance(value, Unknown):
        return Unknown("conditions", f"it depends on {test.about}: {value.reason}", value.location)
    default = literal(test.default) if test.default is not None else None
    if value is None:
        value = default
    elif test.wanted is None and isinstance(default, bool) and not isinstance(value, bool):
        return Unknown("conditions", f"it depends on {test.about}, which is neither true nor false")
    if test.wanted is not None:
        return value == literal(test.wanted) or value == test.wanted
    return value not in (None, False, "", 0)


def _word(kind: str, about: str, start: _Start) -> str | Unknown | None:
    """An argument by its place, or what stands after an option (its own name if nothing does); None if not there."""
    words, why = start.words(0)
    if kind == "arg":
        return words[int(about)] if int(about) < len(words) else why
    for n, word in enumerate(words):
        option, equals, value = word.partition("=")
        if option.startswith("-") and option.lstrip("-") == about.lstrip("-"):
            if equals:
                return value
            return words[n + 1] if n + 1 < len(words) else why or about
    return why


def _filled(template: Template, start: _Start) -> tuple[str, list[Unknown]]:
    text, unknowns = "", []
    for part in template:
        if isinstance(part, str):
            text += part
            continue
        value = _hole(part, start)
        if value is None and part.default is not None:
            inner, said = _filled(part.default, start)
            text += inner
            unknowns += said
        elif isinstance(value, str):
            text += value
        else:
            why = value if isinstance(value, Unknown) else Unknown("name", f"{part.about or 'an item'} is not given")
            unknowns.append(replace(why, field="name"))
            text += UNKNOWN
    return text, unknowns


def _hole(hole: Hole, start: _Start) -> str | Unknown | None:
    value: object | None
    if hole.kind == "unknown":
        return Unknown("name", hole.about)
    if hole.kind in ("arg", "option"):
        return _word(hole.kind, hole.about, start)
    if hole.kind == "search":
        return _searched(hole.about, start)
    if hole.kind in ("beside", "resolved"):
        full = clean(start.remap(resolve(hole.about, start.namespace, start.name)))
        return full if hole.kind == "resolved" else full.rpartition("/")[0]
    if hole.kind == "item":
        value = start.item
        if hole.about:
            value = value.get(hole.about) if isinstance(value, Mapping) else value
    else:
        value = start.value(hole.about)
    if value is None or isinstance(value, (str, Unknown)):
        return value
    return Unknown("name", f"{hole.about or 'an item of the list'} is no text")


def _searched(name: str, start: _Start) -> str | Unknown:
    """The parameter *name* as ``searchParam`` finds it from the node's namespace upwards (wiki.ros.org/Parameter Server)."""
    parts = [part for part in start.namespace.split("/") if part]
    places = [clean("/".join([*parts[:n], name])) for n in range(len(parts), -1, -1)]
    for place in places:
        if start.parameter(place) is not None:
            return place
    return places[0] if len(places) == 1 else Unknown("name", f"{name} is searched for, and set nowhere")
