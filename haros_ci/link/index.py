# SPDX-License-Identifier: Apache-2.0
"""The cross-file index: which class, function, alias, constant or macro a name means, seen from a file and a scope.

A workspace has many programs, and one name may be defined in several. What is nearer wins: the same file, then the
files of the executable under analysis, the same package, and at last the rest of the workspace.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

from haros_ci.model.program import Alias, Class, Field, Function, Program

Entity = TypeVar("Entity")


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """A file as a program: *path* is relative to the root, *module* its dotted Python name."""

    path: str
    package: str | None
    program: Program
    module: str = ""

    @property
    def separator(self) -> str:
        return "." if self.program.language == "python" else "::"


@dataclass(slots=True)
class Index:
    """All names of a language's programs; built once, read only afterwards."""

    classes: dict[str, list[tuple[Source, Class]]] = field(default_factory=lambda: defaultdict(list))
    functions: dict[str, list[tuple[Source, Function]]] = field(default_factory=lambda: defaultdict(list))
    variables: dict[str, list[tuple[Source, Field]]] = field(default_factory=lambda: defaultdict(list))
    aliases: dict[str, list[tuple[Source, Alias]]] = field(default_factory=lambda: defaultdict(list))
    macros: dict[str, list[tuple[Source, str]]] = field(default_factory=lambda: defaultdict(list))
    modules: dict[str, list[Source]] = field(default_factory=lambda: defaultdict(list))
    #: Methods by the last two parts of their name, for those defined under a using-directive.
    by_tail: dict[str, list[tuple[Source, Function]]] = field(default_factory=lambda: defaultdict(list))
    #: The workspace's message, service and action types (``pkg/T``), and its packages.
    interfaces: frozenset[str] = frozenset()
    packages: frozenset[str] = frozenset()
    #: What look-ups have found, by the files of the node type that asked.
    caches: dict[frozenset[str], dict[Any, Any]] = field(default_factory=dict)
    #: ``pkg::Type`` for every ``#include "pkg/Type.h"``, by file.
    included: dict[str, dict[str, str]] = field(default_factory=dict)

    def near(
        self, table: Mapping[str, list[tuple[Source, Entity]]], name: str, source: Source, files: frozenset[str]
    ) -> list[tuple[Source, Entity]]:
        """The entities of that name nearest to *source*."""
        found = table.get(name)
        if not found:
            return []
        if len(found) == 1:
            return found
        for fits in (
            lambda other: other.path == source.path,
            lambda other: other.path in files,
            lambda other: other.package == source.package,
        ):
            nearest = [item for item in found if fits(item[0])]
            if nearest:
                return nearest
        return found

    def scopes(self, name: str, scope: str, source: Source) -> Iterator[str]:
        """The qualified names that *name* can have in *scope*: innermost first, then through using-directives."""
        if name.startswith("::"):
            yield name[2:]
            return
        separator = source.separator
        prefix = scope
        while prefix:
            yield f"{prefix}{separator}{name}"
            prefix = prefix.rpartition(separator)[0]
        yield name
        for _, namespace in source.program.scopes:
            yield f"{namespace}::{name}"


def build_index(sources: Iterable[Source]) -> Index:
    """Index *sources*, sorted by path."""
    index = Index()
    for source in sources:
        program = source.program
        for definition in program.classes:
            index.classes[definition.name].append((source, definition))
        for function in program.functions:
            if function.kind == "lambda" or not function.name:
                continue
            index.functions[function.name].append((source, function))
            if function.owner and program.language != "python":
                parts = function.name.split("::")
                index.by_tail["::".join(parts[-2:])].append((source, function))
        for variable in program.variables:
            index.variables[variable.name].append((source, variable))
        for alias in program.aliases:
            index.aliases[alias.name].append((source, alias))
        for name, parameters, body in program.macros:
            if parameters is None:
                index.macros[name].append((source, body))
        if source.module:
            index.modules[source.module].append(source)
        index.included[source.path] = _included(program)
    return index


def _included(program: Program) -> dict[str, str]:
    found: dict[str, str] = {}
    for include in program.includes:
        head, slash, tail = include.strip('<>"').rpartition("/")
        if slash and head and "/" not in head and tail.endswith((".h", ".hpp")):
            name = tail.rpartition(".")[0]
            found.setdefault(name, f"{head}::{name}")
    return found
