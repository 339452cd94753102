# SPDX-License-Identifier: Apache-2.0
"""An architecture as bytes and back: what several nodes have in common is written once, and is one object again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from types import GenericAlias
from typing import Any

import msgspec

from haros_ci.model import launch_facts
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node, Parameter
from haros_ci.model.launch_facts import LaunchFact
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex

#: The new line of each old one that has code, by file.
Lines = Mapping[str, Mapping[int, int]]
FACTS: tuple[type[LaunchFact], ...] = tuple(
    kind for _, kind in sorted(vars(launch_facts).items()) if isinstance(kind, type) and issubclass(kind, LaunchFact)
)
#: What tells in a sentence on which line something stands.
_PLACE = regex(r":\d|\blines? \d")
_SENTENCES = frozenset(("reason", "message"))


class LineLost(Exception):
    """It is not known on which line something stands now."""


class _Shape(msgspec.Struct, array_like=True, frozen=True):
    """What a configuration has: of each node the numbers of its ends, how many parameters of both kinds, of each fact its class."""

    nodes: list[list[int]]
    alternatives: list[list[int]]
    parameters: int
    alternative_parameters: int
    facts: list[int]


class _Parts(msgspec.Struct, array_like=True, frozen=True):
    """The parts of all configurations in their order, each kind encoded for itself."""

    ends: bytes
    nodes: bytes
    parameters: bytes
    facts: list[bytes]
    configurations: bytes
    problems: bytes
    shapes: list[_Shape]


def encoded(found: Architecture) -> bytes | None:
    """*found* as bytes; None where it would not come back as it is. Its packages are left to who decodes it."""
    try:
        data = msgspec.msgpack.encode(_parts(found))
        back = decoded(data, found.packages)
        # what is equal may still be of another type (1 and 1.0): that has other bytes
        is_same = back == found and msgspec.msgpack.encode(_parts(back)) == data
    except (msgspec.MsgspecError, TypeError, OverflowError, UnicodeEncodeError, RecursionError, LineLost):
        return None
    return data if is_same else None


def decoded(data: bytes, packages: tuple[Package, ...], lines: Lines | None = None) -> Architecture:
    """The architecture of *packages* that *data* is, things that stand in files of *lines* on their new ones.

    Raises msgspec.MsgspecError, ValueError or IndexError for other data, LineLost where a new line is not known.
    """
    parts = msgspec.msgpack.decode(data, type=_Parts)
    ends: Sequence[Endpoint] = _read(parts.ends, Endpoint, lines)
    nodes = iter(_read(parts.nodes, Node, lines))
    parameters = iter(_read(parts.parameters, Parameter, lines))
    facts = [iter(_read(part, kind, lines)) for kind, part in zip(FACTS, parts.facts, strict=True)]

    def with_ends(numbers: Iterable[Sequence[int]]) -> tuple[Node, ...]:
        return tuple(replace(next(nodes), endpoints=tuple([ends[n] for n in own])) for own in numbers)

    configurations = _read(parts.configurations, Configuration, lines)
    try:
        return Architecture(
            configurations=tuple(
                replace(
                    one,
                    nodes=with_ends(shape.nodes),
                    alternatives=with_ends(shape.alternatives),
                    parameters=tuple([next(parameters) for _ in range(shape.parameters)]),
                    alternative_parameters=tuple([next(parameters) for _ in range(shape.alternative_parameters)]),
                    launch_facts=tuple([next(facts[number]) for number in shape.facts]),
                )
                for one, shape in zip(configurations, parts.shapes, strict=True)
            ),
            packages=packages,
            problems=tuple(_read(parts.problems, Problem, lines)),
        )
    except (StopIteration, RuntimeError) as err:  # fewer parts than the shapes tell of
        raise ValueError("an architecture without all of its parts") from err


def _parts(found: Architecture) -> _Parts:
    numbers: dict[int, int] = {}
    ends: list[Endpoint] = []
    nodes: list[Node] = []
    parameters: list[Parameter] = []
    facts: list[list[LaunchFact]] = [[] for _ in FACTS]

    def number_of(end: Endpoint) -> int:
        if id(end) not in numbers:
            numbers[id(end)] = len(ends)
            ends.append(end)
        return numbers[id(end)]

    def of_nodes(every: Iterable[Node]) -> list[list[int]]:
        made = []
        for node in every:
            nodes.append(replace(node, endpoints=()))
            made.append([number_of(end) for end in node.endpoints])
        return made

    def class_of(fact: LaunchFact) -> int:
        number = FACTS.index(type(fact))
        facts[number].append(fact)
        return number

    shapes, bare = [], []
    for one in found.configurations:
        parameters += (*one.parameters, *one.alternative_parameters)
        shapes.append(
            _Shape(
                of_nodes(one.nodes),
                of_nodes(one.alternatives),
                len(one.parameters),
                len(one.alternative_parameters),
                [class_of(fact) for fact in one.launch_facts],
            )
        )
        nothing: dict[str, Any] = dict.fromkeys(("nodes", "alternatives", "launch_facts"), ())
        bare.append(replace(one, parameters=(), alternative_parameters=(), **nothing))
    encode = msgspec.msgpack.encode
    return _Parts(
        encode(ends), encode(nodes), encode(parameters), list(map(encode, facts)), encode(bare), encode(found.problems), shapes
    )  # fmt: skip


def _read(data: bytes, kind: type[Any], lines: Lines | None) -> list[Any]:
    """The things of one *kind* that *data* is."""
    found: list[Any] = msgspec.msgpack.decode(data, type=GenericAlias(list, (kind,)))
    if lines:
        texts = [path.encode() for path in lines]
        raw = msgspec.msgpack.decode(data, type=list[msgspec.Raw])
        for number, item in enumerate(map(bytes, raw)):
            if any(text in item for text in texts):
                found[number] = _moved(found[number], lines)
    return found


def _moved(value: Any, lines: Lines) -> Any:
    """*value* with the new lines of all places in it."""
    if isinstance(value, str):
        return _named(value, lines)
    if isinstance(value, tuple):
        return tuple([_moved(part, lines) for part in value])
    if isinstance(value, Problem):
        message = _named(value.message, lines)
        if value.path not in lines:
            return value
        return replace(value, line=_line(value.line, lines[value.path]), message=_sentence(message))
    if isinstance(value, Location):
        if value.path not in lines:
            return value
        there = lines[value.path]
        return replace(value, line=_line(value.line, there), end_line=_line(value.end_line, there))
    if not is_dataclass(value) or isinstance(value, type):
        return value
    new = {}
    for field in fields(value):
        part = getattr(value, field.name)
        now = _moved(_sentence(part) if field.name in _SENTENCES else part, lines)
        if now is not part:
            new[field.name] = now
    return replace(value, **new) if new else value


def _line(line: int | None, there: Mapping[int, int]) -> int | None:
    """The new line; the first one stands for a whole file, too, and for nothing else where there is no code on it."""
    if line is None or (line == 1 and there.get(1, 1) == 1):
        return line
    now = there.get(line)
    if now is None or line == 1:
        raise LineLost
    return now


def _named(text: str, lines: Lines) -> str:
    """*text*, in which no place of these files stands (``src/go.cpp:7``)."""
    if any(f"{path}:" in text for path in lines):
        raise LineLost
    return text


def _sentence(text: Any) -> Any:
    if isinstance(text, str) and _PLACE.search(text):
        raise LineLost
    return text
