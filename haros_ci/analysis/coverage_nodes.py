# SPDX-License-Identifier: Apache-2.0
"""Which nodes of the model a call may belong to that the model does not have: those are incomplete."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Iterable, Iterator, Mapping

from haros_ci.coverage.pieces import last_name
from haros_ci.index.index import Source
from haros_ci.model.architecture import Architecture, Node
from haros_ci.records import dataclass
from haros_ci.syntax import Function

#: How the reason of an unknown ``endpoints`` ends that a call gives which the model does not account for.
NOT_IN = " is not in the model"


@dataclass(frozen=True, slots=True)
class _File:
    """The functions of a file in their order, and the node types that have an endpoint in each; "" is what is outside of any."""

    lines: tuple[int, ...]
    functions: tuple[Function, ...]
    users: Mapping[int, frozenset[str]]

    def around(self, line: int) -> int:
        """The number of the function that begins last before a line; -1 if none does."""
        return bisect_right(self.lines, line) - 1


def type_name(node: Node) -> str:
    """The type of a node as ``package/type``."""
    return f"{node.package}/{node.type.removeprefix(f'{node.package}/')}"


class Users:
    """The node types, ``package/type``, by the code that they run."""

    def __init__(self, found: Architecture, sources: Iterable[Source], *, within: bool = False) -> None:
        """With *within* those of one function or class alone."""
        self._within = within
        ends: dict[str, list[tuple[int, str]]] = {}
        for configuration in found.configurations:
            for node in (*configuration.nodes, *configuration.alternatives):
                name = type_name(node)
                for end in node.endpoints:
                    if end.location is not None and end.location.line is not None and not end.implicit:
                        ends.setdefault(end.location.path, []).append((end.location.line, name))
        self._ends = ends
        self._sources = {source.path: source for source in sources if source.path in ends}
        self._files: dict[str, _File] = {}
        self._classes: dict[tuple[str, str], frozenset[str]] = {}

    @property
    def paths(self) -> Collection[str]:
        """The files with an endpoint."""
        return self._ends.keys()

    def of(self, path: str, line: int) -> tuple[str, ...]:
        """The node types that a call in this line may belong to, sorted.

        They are those with an endpoint in the same function; without any, those with one in another method of its class in that
        file; without any, those with one anywhere in the file.
        """
        if path not in self._sources:
            return ()
        file = self._file(path)
        number = file.around(line)
        owner = file.functions[number].owner if number >= 0 else ""
        found = file.users.get(number) or (self._of_class(path, owner) if owner else frozenset())
        if not found and not self._within:
            found = self._of_class(path, "")
        return tuple(sorted(found))

    def _of_class(self, path: str, owner: str) -> frozenset[str]:
        """The node types with an endpoint in a method of the class *owner*; with "" those with one anywhere in the file."""
        if (path, owner) not in self._classes:
            users = self._file(path).users
            functions = self._file(path).functions
            own = (names for at, names in users.items() if not owner or (at >= 0 and functions[at].owner == owner))
            self._classes[path, owner] = frozenset[str]().union(*own)
        return self._classes[path, owner]

    def _file(self, path: str) -> _File:
        if path not in self._files:
            functions = sorted(
                (
                    function
                    for function in self._sources[path].program.functions
                    if function.kind not in ("lambda", "module")
                ),
                key=lambda function: function.line,
            )
            lines = tuple(function.line for function in functions)
            users: dict[int, set[str]] = {}
            for line, name in self._ends[path]:
                users.setdefault(bisect_right(lines, line) - 1, set()).add(name)
            frozen = {number: frozenset(names) for number, names in users.items()}
            self._files[path] = _File(lines, tuple(functions), frozen)
        return self._files[path]


def gaps(found: Architecture) -> Iterator[tuple[str, str]]:
    """The files in which something keeps a node from being known as a whole, with the node and what it is."""
    for configuration in found.configurations:
        for node in configuration.nodes:
            for unknown in node.unknowns:
                is_gap = unknown.field == "endpoints" and not unknown.reason.endswith(NOT_IN)
                if is_gap and unknown.location is not None:
                    yield unknown.location.path, f"{node.name}: {unknown.reason}"


def locations(found: Architecture) -> Iterator[tuple[str, int, int]]:
    """Where endpoints are made: path, line and column."""
    for configuration in found.configurations:
        for node in (*configuration.nodes, *configuration.alternatives):
            for endpoint in node.endpoints:
                at = endpoint.location
                if at is not None and at.line is not None:
                    yield at.path, at.line, at.column or 0


def roots(found: Architecture) -> Iterator[str]:
    """The last parts of the names of classes that nodes are made of."""
    nodes: Iterable[Node] = (
        node for configuration in found.configurations for node in (*configuration.nodes, *configuration.alternatives)
    )
    for node in nodes:
        yield last_name((node.class_name or node.type).replace("/", "::"))
