# SPDX-License-Identifier: Apache-2.0
"""What following a node has consulted, and whether an edit concerns it (docs/decisions/0009).

A result depends on the names that were looked up, on what the functions found do, and on whether functions may make or change
something, which is known by name. From the facts of a changed file before and after follows which of these are others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from struct import pack, unpack
from zlib import crc32

from haros_ci import syntax
from haros_ci.index.index import Index, Source
from haros_ci.index.relevance import Answers, Relevance
from haros_ci.index.trace import XML_FILES, Trace
from haros_ci.keeping.moves import Lines, moves
from haros_ci.records import dataclass, field
from haros_ci.syntax import Alias, Class, Directive, Field, Function, Program
from haros_ci.syntax.codec import plain

#: Names and bodies that are kept of one trace, all together: of 20 nodes that consult 5,000 each it is a twentieth.
MAX_KEPT = 2_000_000
#: A function by its file, its qualified name and its number among those of that name; and a number for what it changes.
Effect = tuple[str, str, int, int]


@dataclass(frozen=True, slots=True)
class Consulted:
    """A ``Trace`` made small: paths; the last parts of names, and functions whose bodies were seen, as numbers.

    *view* are the language and ROS version of the code that counts, and its files if not all do. *answers* are whether names of functions
    may make something, *effects* what functions change; None where they cannot be asked for again. *read* are the digests of YAML files, by their paths
    as values have them.
    """

    paths: tuple[str, ...]
    names: bytes
    has_scanned: bool
    roots: tuple[str, ...] = ()
    bodies: bytes = b""
    view: tuple[str, int, tuple[str, ...]] = ("", 0, ())
    answers: Answers | None = None
    effects: tuple[Effect, ...] | None = None
    read: tuple[tuple[str, str], ...] = ()


@dataclass(slots=True)
class SourceChange:
    """What of the C++ and Python files is not as it was.

    Of all files, *paths*; *names* that mean something else, *bodies* of functions that do something else, and the names of those of them
    that call or assign to something else (*effects*); files whose *includes* are others. *lines* has the new lines of what stands
    in files of which only bodies have changed.
    """

    paths: set[str] = field(default_factory=set)
    names: set[int] = field(default_factory=set)
    bodies: set[int] = field(default_factory=set)
    effects: set[int] = field(default_factory=set)
    includes: set[str] = field(default_factory=set)
    lines: dict[str, Lines] = field(default_factory=dict)
    is_shape: bool = False
    #: Whether all that was known is void.
    is_all: bool = False


def small(trace: Trace, relevance: Relevance, view: tuple[str, int, frozenset[str]]) -> Consulted | None:
    """*trace* as it is kept; None if it is not all that was consulted, or if too much of it has been kept before.

    A trace grows with each node of the same files: to keep it for each of a thousand would take time and room of their square.
    """
    trace.kept += len(trace.names) + len(trace.bodies)
    if not trace.is_whole or trace.kept > MAX_KEPT:
        return None
    effects = tuple(_effects(trace))
    known = [effect for effect in effects if effect is not None]
    return Consulted(
        tuple(sorted(trace.paths)),
        _packed(map(number_of, trace.names)),
        trace.has_scanned,
        tuple(sorted(trace.roots)),
        _packed(body_of(path, name) for path, name in trace.bodies),
        (*view[:2], tuple(sorted(view[2]))),
        relevance.answers(),
        tuple(sorted(known)) if len(known) == len(effects) else None,
        tuple(sorted(trace.read.items())),
    )


def _packed(numbers: Iterable[int]) -> bytes:
    every = sorted(set(numbers))
    return pack(f"<{len(every)}I", *every)


def _numbers(data: bytes) -> tuple[int, ...]:
    return unpack(f"<{len(data) // 4}I", data)


@lru_cache(maxsize=1 << 16)
def number_of(name: str) -> int:
    """A number for the last part of a name."""
    return crc32(last(name).encode())


@lru_cache(maxsize=1 << 16)
def body_of(path: str, name: str) -> int:
    """A number for the bodies of the functions of a file with that qualified name."""
    return crc32(f"{path}\n{name}".encode("utf-8", "surrogatepass"))


def last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2] or name


def _effects(trace: Trace) -> Iterator[Effect | None]:
    """What each function that was asked for changes, so that it can be compared; None for one that is not of its file as it stands."""
    places: dict[int, dict[tuple[str, int, int], int]] = {}
    for source, function, names in trace.effects.values():
        if id(source) not in places:
            places[id(source)] = _places(source)
        place = places[id(source)].get((function.name, function.line, function.column))
        yield None if place is None else (source.path, function.name, place, _sum_of(names))


def _places(source: Source) -> dict[tuple[str, int, int], int]:
    """Of each function of a file by its name and place, how many of that name stand before it."""
    count: dict[str, int] = {}
    found: dict[tuple[str, int, int], int] = {}
    for function in source.program.functions:
        number = count[function.name] = count.get(function.name, -1) + 1
        found.setdefault((function.name, function.line, function.column), number)
    return found


def _sum_of(names: frozenset[str]) -> int:
    return crc32("\n".join(sorted(names)).encode("utf-8", "surrogatepass"))


@dataclass(frozen=True, slots=True)
class Now:
    """The workspace as it is: *visible* gives all files whose code some files can run, *relevance* what counts in a view, *digest* that of a YAML file."""

    indexes: Sequence[Index]
    sources: Mapping[str, Source]
    visible: Callable[[frozenset[str]], frozenset[str]]
    relevance: Callable[[str, int, frozenset[str]], Relevance | None]
    digest: Callable[[str], str]


def holds(consulted: Consulted, change: SourceChange, now: Now) -> bool:
    """Whether what was consulted is as it was."""
    if change.is_all or not change.paths.isdisjoint(consulted.paths):
        return False
    if any(now.digest(path) != digest for path, digest in consulted.read):
        return False
    if change.names and consulted.has_scanned and change.is_shape:
        return False
    names = _numbers(consulted.names) if change.names or change.effects else ()
    if not change.names.isdisjoint(names):
        return False
    if change.bodies and not change.bodies.isdisjoint(_numbers(consulted.bodies)):
        return False
    if change.includes:
        for index in now.indexes:
            if any(not change.includes.isdisjoint(index.reach(path)) for path in consulted.paths):
                return False
        if consulted.roots and not change.includes.isdisjoint(now.visible(frozenset(consulted.roots))):
            return False
    return change.effects.isdisjoint(names) or _answers_hold(consulted, now)


def _answers_hold(consulted: Consulted, now: Now) -> bool:
    """Whether what counts is as it was, although functions of consulted names call or assign to something else."""
    language, version, files = consulted.view
    relevance = now.relevance(language, version, frozenset(files))
    if relevance is None or consulted.answers is None or consulted.effects is None:
        return False
    if not relevance.agrees(consulted.answers):
        return False
    for path, name, place, number in consulted.effects:
        source = now.sources.get(path)
        same = (
            [function for function in source.program.functions if function.name == name] if source is not None else []
        )
        if source is None or place >= len(same) or _sum_of(relevance.changes(same[place], source)) != number:
            return False
    return True


def change_of(
    before: Mapping[str, str],
    now: Mapping[str, str],
    source_before: Callable[[str, str], Source | None],
    source_now: Callable[[str], Source | None],
    relevance: Callable[[str], Sequence[Relevance]],
    aliases: Mapping[str, object],
) -> SourceChange:
    """What has changed from the files *before* to those of *now* (digests by path); *aliases* are those of C++ by name."""
    change = SourceChange()
    if before.keys() != now.keys():
        change.is_all = True
        return change
    for path in sorted(now):
        if before[path] == now[path]:
            continue
        if path == XML_FILES:
            change.paths.add(path)
            continue
        old, new = source_before(path, before[path]), source_now(path)
        if old is None or new is None:
            change.is_all = True
            return change
        if not _only_bodies(change, path, old, new, relevance(path), aliases):
            change.paths.add(path)
            _compare(change, path, old, new, relevance(path))
    return change


def _only_bodies(
    change: SourceChange,
    path: str,
    before: Source,
    now: Source,
    relevance: Sequence[Relevance],
    aliases: Mapping[str, object],
) -> bool:
    """Whether no more has changed than what some functions do; that is noted."""
    try:
        found = moves(before.program, now.program)
    except RecursionError:
        return False
    if found is None:
        return False
    earlier, later = _functions(before.program), _functions(now.program)
    if any(
        function.owner in aliases for name in found.around for function in later[name]
    ):  # known under another name, too
        return False
    change.lines[path] = found.lines
    change.bodies |= {body_of(path, name) for name in found.around}
    for name in found.functions:
        if _does_other(before, now, earlier[name], later[name], relevance):
            change.effects.add(number_of(name))
    return True


def _compare(change: SourceChange, path: str, before: Source, now: Source, relevance: Sequence[Relevance]) -> None:
    old, new = before.program, now.program
    if (old.includes, old.scopes, old.registered) != (new.includes, new.scopes, new.registered):
        change.includes.add(path)
    if _placeless(old.directives) != _placeless(new.directives):  # which lines of what includes it are compiled
        change.includes.add(path)
    for which in ("classes", "variables", "aliases", "macros"):
        removed, come = _entities(getattr(old, which)), _entities(getattr(new, which))
        for name in removed.keys() | come.keys():
            if removed.get(name) != come.get(name):
                change.names.add(number_of(name))
                change.is_shape = True
    earlier, later = _functions(old), _functions(new)
    for name in earlier.keys() | later.keys():
        gone_ones, come_ones = earlier.get(name, []), later.get(name, [])
        if [_head(function) for function in gone_ones] != [_head(function) for function in come_ones]:
            change.names.add(number_of(name))
            change.is_shape = change.is_shape or "operator" in name
        if gone_ones != come_ones and _does_other(before, now, gone_ones, come_ones, relevance):
            change.names.add(number_of(name))


def _placeless(directives: Sequence[Directive]) -> list[tuple[str, str]]:
    return [(directive.word, directive.text) for directive in directives]


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
    old: Source, new: Source, removed: list[Function], come: list[Function], relevance: Sequence[Relevance]
) -> bool:
    """Whether the functions of one name call or assign to other names than before: who relies on it has it in its trace."""
    for other_relevance in relevance:
        before = frozenset(called for function in removed for called in other_relevance.calls_of(function, old))
        after = frozenset(called for function in come for called in other_relevance.calls_of(function, new))
        assigned = [frozenset(a for f in group for a in other_relevance.assigned_in(f)) for group in (removed, come)]
        if before != after or assigned[0] != assigned[1]:
            return True
    return False
