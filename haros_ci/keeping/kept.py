# SPDX-License-Identifier: Apache-2.0
"""Nodes that were followed before: what they gave holds as long as nothing that they consulted has changed.

A node's result depends on what it looked up (``trace``), on what it is given (parameters, rules, arguments), and on whether
functions may make something, which is known by name. A record keeps all three beside the digests of all files. From the
facts of a changed file before and after follows which names mean something else now (docs/decisions/0009).
"""

from __future__ import annotations

from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from hashlib import sha256
from struct import pack, unpack
from typing import Any
from zlib import crc32

from haros_ci import syntax
from haros_ci.follow.run import Made
from haros_ci.follow.twins import Twin
from haros_ci.graph.ros2_process import RosNode
from haros_ci.index.index import Index, Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.trace import XML_FILES, YAML_FILES, Trace
from haros_ci.keeping.kept_json import Unfit, from_json, to_json
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.syntax import Alias, Class, Field, Function, Program
from haros_ci.syntax.codec import plain
from haros_ci.values.abstract import Value


@dataclass(frozen=True, slots=True)
class Followed:
    """What one node has made, what went wrong, the names it gives itself; and each parameter that it asked for."""

    made: tuple[Made, ...]
    problems: tuple[Problem, ...]
    names: tuple[tuple[Value, bool], ...]
    gaps: Mapping[str, Location]
    asked: Mapping[str, Value | None]
    nodes: tuple[RosNode, ...] = ()
    twins: tuple[Twin, ...] = ()
    consulted: Consulted | None = None


@dataclass(frozen=True, slots=True)
class Consulted:
    """A ``Trace`` made small: paths, the names' last parts as numbers."""

    paths: tuple[str, ...]
    names: bytes
    has_scanned: bool
    roots: tuple[str, ...] = ()


@dataclass(slots=True)
class Change:
    """What of the C++ and Python files is not as it was: *paths*, *names*, and those whose includes are others."""

    paths: set[str] = field(default_factory=set)
    names: set[int] = field(default_factory=set)
    includes: set[str] = field(default_factory=set)
    is_shape: bool = False
    #: Whether all that was known is void.
    is_all: bool = False


def small(trace: Trace) -> Consulted | None:
    """*trace* as it is kept; None if it is not all that was consulted."""
    if not trace.is_whole:
        return None
    numbers = sorted({number_of(name) for name in trace.names})
    paths, roots = tuple(sorted(trace.paths)), tuple(sorted(trace.roots))
    return Consulted(paths, pack(f"<{len(numbers)}I", *numbers), trace.has_scanned, roots)


def number_of(name: str) -> int:
    """A number for the last part of a name."""
    return crc32(last(name).encode())


def last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2] or name


def holds(
    consulted: Consulted,
    change: Change,
    indexes: Sequence[Index],
    visible: Callable[[frozenset[str]], frozenset[str]],
) -> bool:
    """Whether what was consulted is as it was; *visible* gives all files whose code some files can run."""
    if change.is_all or not change.paths.isdisjoint(consulted.paths):
        return False
    if change.names:
        if consulted.has_scanned and change.is_shape:
            return False
        numbers = unpack(f"<{len(consulted.names) // 4}I", consulted.names)
        if not change.names.isdisjoint(numbers):
            return False
    if change.includes:
        for index in indexes:
            if any(not change.includes.isdisjoint(index.reach(path)) for path in consulted.paths):
                return False
        return not consulted.roots or change.includes.isdisjoint(visible(frozenset(consulted.roots)))
    return True


def change_of(
    before: Mapping[str, str],
    now: Mapping[str, str],
    source_before: Callable[[str, str], Source | None],
    source_now: Callable[[str], Source | None],
    relevance: Callable[[str], Sequence[Relevance]],
) -> Change:
    """What has changed from the files *before* to those of *now* (digests by path)."""
    change = Change()
    if before.keys() != now.keys():
        change.is_all = True
        return change
    for path in sorted(now):
        if before[path] == now[path]:
            continue
        if path in (YAML_FILES, XML_FILES):
            change.paths.add(path)
            continue
        old, new = source_before(path, before[path]), source_now(path)
        if old is None or new is None:
            change.is_all = True
            return change
        change.paths.add(path)
        _compare(change, path, old, new, relevance(path))
    return change


def _compare(change: Change, path: str, before: Source, now: Source, relevance: Sequence[Relevance]) -> None:
    old, new = before.program, now.program
    if (old.includes, old.scopes, old.registered) != (new.includes, new.scopes, new.registered):
        change.includes.add(path)
    for which in ("classes", "variables", "aliases", "macros"):
        gone, come = _entities(getattr(old, which)), _entities(getattr(new, which))
        for name in gone.keys() | come.keys():
            if gone.get(name) != come.get(name):
                change.names.add(number_of(name))
                change.is_shape = True
    earlier, later = _functions(old), _functions(new)
    for name in earlier.keys() | later.keys():
        gone_ones, come_ones = earlier.get(name, []), later.get(name, [])
        if [_head(each) for each in gone_ones] != [_head(each) for each in come_ones]:
            change.names.add(number_of(name))
            change.is_shape = change.is_shape or "operator" in name
        if gone_ones != come_ones and _does_other(before, now, gone_ones, come_ones, relevance):
            change.names.add(number_of(name))


def _entities(
    items: Iterable[Class | Field | Alias | tuple[str, tuple[str, ...] | None, str]],
) -> dict[str, list[object]]:
    """What is defined, macros too, by name; but for where."""
    found: dict[str, list[object]] = {}
    for item in items:
        if isinstance(item, tuple):
            found.setdefault(item[0], []).append(item)
        else:
            bare = item if isinstance(item, Alias) else syntax.replace(item, line=0, column=0)
            found.setdefault(item.name, []).append(plain(bare))
    return found


def _functions(program: Program) -> dict[str, list[Function]]:
    found: dict[str, list[Function]] = {}
    for function in program.functions:
        found.setdefault(function.name, []).append(function)
    return found


def _head(function: Function) -> tuple[bool, bytes]:
    """A function but for what it does and where."""
    has_body = function.body is not None
    bare = syntax.replace(function, body=None, inits=(), line=0, column=0, body_line=0, body_column=0, guards=())
    return has_body, plain(bare)


def _does_other(
    old: Source, new: Source, gone: list[Function], come: list[Function], relevance: Sequence[Relevance]
) -> bool:
    """Whether the functions of one name call or assign to other names than before: who relies on it has it in its trace."""
    for each in relevance:
        before = frozenset(called for function in gone for called in each.calls_of(function, old))
        after = frozenset(called for function in come for called in each.calls_of(function, new))
        assigned = [frozenset(a for f in group for a in each.assigned_in(f)) for group in (gone, come)]
        if before != after or assigned[0] != assigned[1]:
            return True
    return False


@dataclass(slots=True)
class Record:
    """What earlier runs have followed: by key the results, and what each consulted."""

    files: Mapping[str, str]
    followed: list[tuple[Any, Followed]]


def digest_of(*parts: Any) -> str:
    """A key for what every result depends on."""
    found = sha256()
    for part in parts:
        found.update(repr(part).encode("utf-8", "surrogatepass"))
    return found.hexdigest()


def written(files: Mapping[str, str], followed: Iterable[tuple[Any, Followed]]) -> Any:
    """A record as JSON: paths once, what nodes of one library consulted once."""
    paths = {path: number for number, path in enumerate(sorted(files))}
    traces: dict[Consulted, int] = {}
    items = []
    for key, each in followed:
        if each.consulted is None:
            continue
        try:
            item = [to_json(key), *_written(each)]
        except Unfit:
            continue
        items.append([traces.setdefault(each.consulted, len(traces)), *item])
    kept_traces = [
        [
            [paths[p] for p in each.paths if p in paths],
            b64encode(each.names).decode(),
            each.has_scanned,
            [paths[p] for p in each.roots if p in paths],
        ]
        for each in traces
    ]
    return [list(files.items()), kept_traces, items]


def _written(each: Followed) -> list[Any]:
    nodes: dict[int, int] = {}
    table: list[RosNode] = []
    for node in (*each.nodes, *(made.node for made in each.made if made.node is not None)):
        if id(node) not in nodes:
            nodes[id(node)] = len(table)
            table.append(node)
    made = [[nodes[id(m.node)] if m.node is not None else -1, to_json(replace(m, node=None))] for m in each.made]
    asked = [[name, to_json(value)] for name, value in each.asked.items()]
    gaps = [[said, to_json(where)] for said, where in each.gaps.items()]
    problems = [[problem.path, problem.message, problem.line] for problem in each.problems]
    twins = [[twin.name, to_json(twin.first), to_json(twin.second)] for twin in each.twins]
    return [to_json(tuple(table)), len(each.nodes), made, asked, gaps, to_json(each.names), problems, twins]


def read(data: Any) -> Record | None:
    """The record that *data* is the JSON of; None if it is none."""
    try:
        files, traces, items = data
        known = {_text(path): _text(digest) for path, digest in files}
        paths = sorted(known)
        consulted = [
            Consulted(_paths(numbers, paths), b64decode(_text(names)), bool(scanned), _paths(roots, paths))
            for numbers, names, scanned, roots in traces
        ]
        followed = []
        for trace, key, table, count, made, asked, gaps, names, problems, twins in items:
            nodes = from_json(table)
            if not isinstance(nodes, tuple) or not all(node.__class__ is RosNode for node in nodes):
                return None
            followed.append(
                (
                    from_json(key),
                    Followed(
                        made=tuple(_made(each, nodes) for each in made),
                        problems=tuple(_problem(each) for each in problems),
                        names=_names(from_json(names)),
                        gaps={_text(said): _location(from_json(where)) for said, where in gaps},
                        asked={_text(name): from_json(value) for name, value in asked},
                        nodes=nodes[: _count(count)],
                        twins=tuple(_twin(each) for each in twins),
                        consulted=consulted[_index(trace, consulted)],
                    ),
                )
            )
        return Record(known, followed)
    except (Unfit, ValueError, TypeError):
        return None


def _problem(data: Any) -> Problem:
    path, message, line = data
    return Problem(_text(path), _text(message), _count(line) if line is not None else None)


def _twin(data: Any) -> Twin:
    name, first, second = data
    return Twin(_text(name), _location(from_json(first)), _location(from_json(second)))


def _made(data: Any, nodes: tuple[RosNode, ...]) -> Made:
    number, held = data
    made = from_json(held)
    if made.__class__ is not Made:
        raise Unfit
    return made if number == -1 else replace(made, node=nodes[_index(number, nodes)])


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise Unfit
    return value


def _paths(numbers: Any, paths: Sequence[str]) -> tuple[str, ...]:
    return tuple(paths[_index(number, paths)] for number in numbers)


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


def _names(value: Any) -> tuple[tuple[Value, bool], ...]:
    if not isinstance(value, tuple) or not all(isinstance(pair, tuple) and len(pair) == 2 for pair in value):
        raise Unfit
    return value
