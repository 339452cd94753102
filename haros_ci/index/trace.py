# SPDX-License-Identifier: Apache-2.0
"""What following a node has consulted of the workspace: names that it looked up, files whose contents it saw."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

from haros_ci.records import dataclass, field
from haros_ci.syntax import Alias, Function
from haros_ci.syntax.source import Source

if TYPE_CHECKING:
    from _collections_abc import dict_values

Entity = TypeVar("Entity")
Default = TypeVar("Default")

#: Stands for all XML files, and for what directories have.
XML_FILES = "*.xml"


@dataclass(slots=True)
class Trace:
    """Consulted by the nodes of one set of files.

    *names* are the last parts of names, *paths* those of C++ and Python files, *has_scanned* whether all classes were
    gone through, *bodies* the functions that were found or followed, by path and qualified name, *effects* those of which it was asked what they
    change, by identity, *roots* the files from which it was looked for what their code can reach, *read* the digests of YAML files by their paths as values have them ("" for one
    that is not there), *is_whole* whether this is all: other inputs (plug-ins that load others) are not traced.
    """

    names: set[str] = field(default_factory=set)
    paths: set[str] = field(default_factory=set)
    has_scanned: bool = False
    is_whole: bool = True
    roots: set[str] = field(default_factory=set)
    read: dict[str, str] = field(default_factory=dict)
    bodies: set[tuple[str, str]] = field(default_factory=set)
    #: How many names and bodies of it have been kept, all together.
    kept: int = 0
    effects: dict[int, tuple[Source, Function, frozenset[str]]] = field(default_factory=dict)
    #: What ``Index.near`` has found, and the names that were looked up in each table.
    near: dict[tuple[object, ...], list[Any]] = field(default_factory=dict, repr=False, compare=False)
    seen: dict[int, set[str]] = field(default_factory=dict, repr=False, compare=False)

    def found(self, items: Iterable[tuple[Source, object]]) -> None:
        """Note what a look-up has found: entities, each with its source.

        Imports of Python have no place and mean the same whatever else is in their file: their names alone tell of them.
        """
        for source, entity in items:
            if isinstance(entity, Alias) and source.separator == ".":
                continue
            self.paths.add(source.path)
            if isinstance(entity, Function):
                self.bodies.add((source.path, entity.name))


class Traced(dict[str, list[tuple[Source, Entity]]], Generic[Entity]):
    """A table of the index that tells its ``trace`` what is looked up in it."""

    __slots__ = ("seen", "trace")

    def __init__(self, table: Mapping[str, list[tuple[Source, Entity]]]) -> None:
        super().__init__(table)
        self.trace: Trace | None = None
        self.seen: set[str] = set()

    def follow(self, trace: Trace | None) -> None:
        """Tell *trace* from now on."""
        self.trace = trace
        self.seen = trace.seen.setdefault(id(self), set()) if trace is not None else set()

    @overload
    def get(self, name: str, default: None = None, /) -> list[tuple[Source, Entity]] | None: ...

    @overload
    def get(self, name: str, default: list[tuple[Source, Entity]], /) -> list[tuple[Source, Entity]]: ...

    @overload
    def get(self, name: str, default: Default, /) -> list[tuple[Source, Entity]] | Default: ...

    def get(self, name: str, default: object = None, /) -> object:
        if self.trace is not None and name not in self.seen:
            self._tell(name)
        return super().get(name, default)

    def __getitem__(self, name: str) -> list[tuple[Source, Entity]]:
        if self.trace is not None and name not in self.seen:
            self._tell(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        if self.trace is not None and isinstance(name, str) and name not in self.seen:
            self._tell(name)
        return super().__contains__(name)

    def _tell(self, name: str) -> None:
        assert self.trace is not None
        self.seen.add(name)
        self.trace.names.add(name)
        self.trace.found(super().get(name, ()))

    def __iter__(self) -> Iterator[str]:
        if self.trace is not None:
            self.trace.has_scanned = True
        return super().__iter__()

    # haros: ignore[invalid-sequence-index] a type, not an index
    def values(self) -> dict_values[str, list[tuple[Source, Entity]]]:
        if self.trace is not None:
            self.trace.has_scanned = True
        return super().values()
