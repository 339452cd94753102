# SPDX-License-Identifier: Apache-2.0
"""Nodes that were followed before: what they gave holds as long as nothing that they consulted has changed.

A node's result depends on what it looked up (``trace``), on what it is given (parameters, rules, arguments), and on whether
functions may make something, which is known by name. A record keeps all three beside the digests of all files. From the
facts of a changed file before and after follows which names mean something else now (docs/decisions/0009).
"""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from struct import error, pack, unpack
from typing import Any

from haros_ci.follow.made import MadeEntity
from haros_ci.follow.twins import Twin
from haros_ci.graph.ros2_process import RosNode
from haros_ci.keeping.consulted import Consulted, Effect
from haros_ci.keeping.kept_json import PlaceLost, Unfit, entity_from_json, from_json, moved, to_json
from haros_ci.keeping.moves import Lines
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import Value
from haros_ci.values.given import Unseen
from haros_ci.values.questions import Answer


@dataclass(frozen=True, slots=True)
class Followed:
    """What one node has made, what went wrong, the names it gives itself; and each parameter that it asked for."""

    made: tuple[MadeEntity, ...]
    problems: tuple[Problem, ...]
    names: tuple[tuple[Value, bool | None], ...]
    gaps: Mapping[str, Location]
    asked: Mapping[str, Value | Unseen | None]
    nodes: tuple[RosNode, ...] = ()
    twins: tuple[Twin, ...] = ()
    consulted: Consulted | None = None
    #: The statements and calls that it took.
    steps: int = 0
    #: What it asked of parameters and names, besides what it looked at.
    answers: tuple[Answer, ...] = ()


def digest_of(*parts: Any) -> str:
    """A key for what every result depends on."""
    found = sha256()
    for part in parts:
        found.update(repr(part).encode("utf-8", "surrogatepass"))
    return found.hexdigest()


def written(files: Mapping[str, str], followed: Iterable[tuple[Any, Followed]]) -> Any:
    """A record as JSON: paths and names once, what nodes of one library consulted once."""
    traces: dict[Consulted, int] = {}
    items = []
    for key, one in followed:
        if one.consulted is None:
            continue
        try:
            item = [to_json(key), *_written(one)]
        except Unfit:
            continue
        items.append([traces.setdefault(one.consulted, len(traces)), *item])
    paths = {path: number for number, path in enumerate(sorted(files))}
    names: dict[str, int] = {}

    def numbered(words: Iterable[str]) -> str:
        return _packed([names.setdefault(word, len(names)) for word in words])

    def known(found: Iterable[str]) -> str:
        return _packed([paths[path] for path in found if path in paths])

    def numbers_of(effects: Iterable[Effect]) -> str:
        """Those in files; the code that is made from descriptions of parameters changes with these, which void the record."""
        in_files = (effect for effect in effects if effect[0] in paths)
        return _packed([n for path, name, *rest in in_files for n in (paths[path], _at(names, name), *rest)])

    kept_traces = [
        [
            known(trace.paths),
            b64encode(trace.names).decode(),
            trace.has_scanned,
            known(trace.roots),
            b64encode(trace.bodies).decode(),
            [*trace.view[:2], known(trace.view[2])],
            None if trace.answers is None else [numbered(group) for group in trace.answers],
            None if trace.effects is None else numbers_of(trace.effects),
            [list(pair) for pair in trace.read],
        ]
        for trace in traces
    ]
    return [list(files.items()), list(names), kept_traces, items]


def _at(names: dict[str, int], name: str) -> int:
    return names.setdefault(name, len(names))


def _packed(numbers: Sequence[int]) -> str:
    return b64encode(pack(f"<{len(numbers)}I", *numbers)).decode()


def _unpacked(data: Any) -> tuple[int, ...]:
    held = b64decode(_text(data))
    return unpack(f"<{len(held) // 4}I", held)


def _written(followed: Followed) -> list[Any]:
    nodes: dict[int, int] = {}
    table: list[RosNode] = []
    for node in (*followed.nodes, *(made.node for made in followed.made if made.node is not None)):
        if id(node) not in nodes:
            nodes[id(node)] = len(table)
            table.append(node)
    made = [[nodes[id(m.node)] if m.node is not None else -1, to_json(replace(m, node=None))] for m in followed.made]
    requested = [[name, to_json(value)] for name, value in followed.asked.items()]
    gaps = [[message, to_json(where)] for message, where in followed.gaps.items()]
    problems = [[problem.message, to_json(Location(problem.path, problem.line))] for problem in followed.problems]
    twins = [[twin.name, to_json(twin.first), to_json(twin.second)] for twin in followed.twins]
    return [
        to_json(tuple(table)),
        len(followed.nodes),
        made,
        requested,
        gaps,
        to_json(followed.names),
        problems,
        twins,
        followed.steps,
        to_json(followed.answers),
    ]


@dataclass(frozen=True, slots=True)
class Earlier:
    """A record as it was found: the digests of the files that it is of, and the rest as JSON.

    *made* has, by their numbers, the results that have been made of it as they are, for the other revision of a change.
    """

    files: Mapping[str, str]
    names: tuple[str, ...]
    traces: Any
    followed: Any
    made: dict[int, tuple[Any, Followed]] = field(default_factory=dict)


def begun(data: Any) -> Earlier | None:
    """The record that *data* is the JSON of, as far as it is read before anything is looked up in it; None for any other data."""
    try:
        files, names, traces, followed = data
        return Earlier(
            {_text(path): _text(digest) for path, digest in files}, tuple(map(_text, names)), traces, followed
        )
    except (Unfit, ValueError, TypeError):
        return None


def read(
    earlier: Earlier, holds: Callable[[Consulted], bool], lines: Mapping[str, Lines]
) -> list[tuple[Any, Followed]]:
    """What of a record *holds*, by what was consulted, with the new *lines* of places in files that were edited.

    What has a place of which the new line is not known does not hold. Nothing holds of data that is no record.
    """
    try:
        paths = sorted(earlier.files)
        traces = [_consulted(trace, paths, earlier.names) for trace in earlier.traces]
    except (Unfit, ValueError, TypeError, error):
        return []
    holding = [consulted if holds(consulted) else None for consulted in traces]
    try:
        found = []
        for number, (trace, key, *item) in enumerate(earlier.followed):
            what = holding[_index(trace, holding)]
            if what is None:
                continue
            try:
                now = moved(item, lines) if lines else item
            except PlaceLost:
                continue
            is_as_it_was = now == item
            if is_as_it_was and number in earlier.made:
                found.append(earlier.made[number])
                continue
            table, count, made, requested, gaps, names, problems, twins, steps, answers = now
            nodes = from_json(table)
            if not isinstance(nodes, tuple) or not all(node.__class__ is RosNode for node in nodes):
                return []
            followed = Followed(
                made=tuple(_made(entry, nodes) for entry in made),
                problems=tuple(_problem(problem) for problem in problems),
                names=_names(from_json(names)),
                gaps={_text(message): _location(from_json(where)) for message, where in gaps},
                asked={_text(name): from_json(value) for name, value in requested},
                nodes=nodes[: _count(count)],
                twins=tuple(_twin(twin) for twin in twins),
                consulted=what,
                steps=_count(steps),
                answers=_answers_of(from_json(answers)),
            )
            found.append((from_json(key), followed))
            if is_as_it_was:
                earlier.made[number] = found[-1]
        return found
    except (Unfit, ValueError, TypeError, error):
        return []


def _consulted(data: Any, paths: Sequence[str], every: Sequence[str]) -> Consulted:
    known, names, scanned, roots, bodies, view, answers, effects, texts = data
    language, version, files = view
    numbers = () if effects is None else _unpacked(effects)
    if len(numbers) % 4:
        raise Unfit
    groups = zip(*[iter(numbers)] * 4, strict=True)
    return Consulted(
        _named(known, paths),
        _whole_numbers(names),
        bool(scanned),
        _named(roots, paths),
        _whole_numbers(bodies),
        (_text(language), _count(version), _named(files, paths)),
        None if answers is None else _answers(answers, every),
        None
        if effects is None
        else tuple((paths[_index(p, paths)], every[_index(n, every)], at, number) for p, n, at, number in groups),
        tuple((_text(path), _text(digest)) for path, digest in texts),
    )


def _whole_numbers(data: Any) -> bytes:
    """Packed numbers as they are compared."""
    held = b64decode(_text(data))
    if len(held) % 4:
        raise Unfit
    return held


def _answers(data: Any, every: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    found = tuple(_named(group, every) for group in data)
    if len(found) != 4:
        raise Unfit
    return found


def _problem(data: Any) -> Problem:
    message, where = data
    place = _location(from_json(where))
    return Problem(place.path, _text(message), place.line)


def _twin(data: Any) -> Twin:
    name, first, second = data
    return Twin(_text(name), _location(from_json(first)), _location(from_json(second)))


def _made(data: Any, nodes: tuple[RosNode, ...]) -> MadeEntity:
    number, held = data
    return entity_from_json(held, None if number == -1 else nodes[_index(number, nodes)])


def _answers_of(value: Any) -> tuple[Answer, ...]:
    if not isinstance(value, tuple) or not all(item.__class__ is Answer for item in value):
        raise Unfit
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise Unfit
    return value


def _named(numbers: Any, words: Sequence[str]) -> tuple[str, ...]:
    return tuple(words[_index(number, words)] for number in _unpacked(numbers))


def _count(value: Any) -> int:
    if value.__class__ is not int or value < 0:
        raise Unfit
    return int(value)


def _index(value: Any, items: Sequence[Any]) -> int:
    if _count(value) >= len(items):
        raise Unfit
    return int(value)


def _location(value: Any) -> Location:
    if value.__class__ is not Location:
        raise Unfit
    return value


def _names(value: Any) -> tuple[tuple[Value, bool | None], ...]:
    if not isinstance(value, tuple) or not all(isinstance(pair, tuple) and len(pair) == 2 for pair in value):
        raise Unfit
    return value
