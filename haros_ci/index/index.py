# SPDX-License-Identifier: Apache-2.0
"""The cross-file index: which class, function, alias, constant or macro a name means, seen from a file and a scope.

A workspace has many programs, and one name may be defined in several. What is nearer wins: the same file, then the
headers that it includes, the files of the executable under analysis, the same package, and at last the rest of the
workspace: of that, only classes and their methods, and what some file of the executable includes a header for.
"""

from __future__ import annotations

import posixpath
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from haros_ci.index.trace import Trace, Traced
from haros_ci.index.tree_includes import brings_trees
from haros_ci.records import dataclass, field
from haros_ci.syntax import Alias, Class, Field, Function
from haros_ci.syntax.source import Source as Source

if TYPE_CHECKING:
    from haros_ci.index.compiled import CompiledAs

Entity = TypeVar("Entity")
#: Typedefs of typedefs that are looked through.
ALIASES = 8
#: The reason where one of several definitions cannot be chosen.
EITHER = "it is defined more than once"
#: What macros that declare smart pointers to a class put after its name, the longest first.
POINTERS = ("ConstUniquePtr", "ConstWeakPtr", "UniquePtr", "WeakPtr", "ConstPtr", "Ptr")
#: What is loaded for behaviour trees is of this base.
BEHAVIOR_TREE_NODE = "TreeNode"
HEADERS = (".h", ".hh", ".hpp", ".hxx", ".H", ".inl", ".ipp", ".tpp")


@dataclass(slots=True)
class Index:
    """All names of a language's programs; built once, read only afterwards."""

    classes: dict[str, list[tuple[Source, Class]]] = field(default_factory=lambda: defaultdict(list))
    functions: dict[str, list[tuple[Source, Function]]] = field(default_factory=lambda: defaultdict(list))
    variables: dict[str, list[tuple[Source, Field]]] = field(default_factory=lambda: defaultdict(list))
    aliases: dict[str, list[tuple[Source, Alias]]] = field(default_factory=lambda: defaultdict(list))
    macros: dict[str, list[tuple[Source, str]]] = field(default_factory=lambda: defaultdict(list))
    modules: dict[str, list[Source]] = field(default_factory=lambda: defaultdict(list))
    #: Python files by path without ``.py``, packages by their directory.
    by_place: dict[str, Source] = field(default_factory=dict)
    #: Methods by the last two parts of their name, for those defined under a using-directive.
    by_tail: dict[str, list[tuple[Source, Function]]] = field(default_factory=lambda: defaultdict(list))
    #: The workspace's message, service and action types (``pkg/T``), and its packages.
    interfaces: frozenset[str] = frozenset()
    packages: frozenset[str] = frozenset()
    #: The classes and functions that API rows tell of, for using-directives of their namespaces.
    library: frozenset[str] = frozenset()
    #: The macros that the build of each package defines.
    defined: Mapping[str | None, tuple[str, ...]] = field(default_factory=dict)
    #: Those that a target has in some builds only.
    conditional: frozenset[str] = frozenset()
    #: The source files as targets compile them (``compiled.CompiledAs``), by path.
    compiled: Mapping[str, tuple[CompiledAs, ...]] = field(default_factory=dict)
    #: What look-ups have found, by the files of the node type that asked and whether every plug-in is followed.
    caches: dict[object, dict[object, Any]] = field(default_factory=dict)
    #: ``pkg::Type`` for every ``#include "pkg/Type.h"``, by file.
    included: dict[str, dict[str, str]] = field(default_factory=dict)
    #: Aliases inside functions, by file and by their own name; None where two functions have one of that name.
    local: dict[str, dict[str, Alias | None]] = field(default_factory=dict)
    #: The names of the C++ functions that define classes, or aliases of namespaces.
    inner: set[str] = field(default_factory=set)
    #: All C++ files, those of each file name, and the files that each includes: by itself, and with what these include.
    sources: dict[str, Source] = field(default_factory=dict)
    file_names: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))
    links: dict[str, tuple[str, ...]] = field(default_factory=dict)
    reached: dict[str, frozenset[str]] = field(default_factory=dict)
    #: The namespaces that are open in each file, and the messages that it includes.
    open: dict[str, tuple[str, ...]] = field(default_factory=dict)
    inside: dict[tuple[str, str], tuple[str, ...]] = field(default_factory=dict)
    headers: dict[str, Mapping[str, str]] = field(default_factory=dict)
    trace: Trace | None = None
    #: Types that have been resolved so far for the one that is asked for (``types.resolve_type``).
    resolving: int = 0
    by_package: dict[str | None, list[str]] = field(default_factory=dict)
    visible: dict[tuple[str, frozenset[str]], tuple[frozenset[str], frozenset[str | None]]] = field(
        default_factory=dict
    )

    def near(
        self, table: Mapping[str, list[tuple[Source, Entity]]], name: str, source: Source, files: frozenset[str]
    ) -> list[tuple[Source, Entity]]:
        """The entities of that name nearest to *source*; several are equally near, and any may be the one."""
        trace = self.trace
        if trace is None:
            return self._near(table, name, source, files)
        key = (id(table), name, source.path, files)
        known = trace.near.get(key)
        if known is None:
            trace.names.add(name)
            trace.paths.add(source.path)
            known = trace.near[key] = self._near(table, name, source, files)
            trace.found(known)
        return known

    def _near(
        self, table: Mapping[str, list[tuple[Source, Entity]]], name: str, source: Source, files: frozenset[str]
    ) -> list[tuple[Source, Entity]]:
        found: list[tuple[Source, Entity]] | None = dict.get(table, name)  # type: ignore[call-overload]  # past the trace
        if found and (name in self.library or name.rpartition("::")[0] in self.library):
            found = [item for item in found if self._may_be_here(item[0], source, files)]
        if not found:
            return []
        nearest = self._nearest(found, source, files) if len(found) > 1 else []
        if nearest:
            return nearest
        if table is self.variables or table is self.macros or table is self.functions:
            return [item for item in found if self._of_a_class(item[1]) or self.sees(source, item[0], files)]
        return found

    def _nearest(
        self, found: list[tuple[Source, Entity]], source: Source, files: frozenset[str]
    ) -> list[tuple[Source, Entity]]:
        """Those of the file itself, else of what it includes, else of the executable, else of the package; empty if there are none of these."""
        for fits in (
            lambda other: other.path == source.path,
            lambda other: other.path in self.reach(source.path),
            lambda other: other.path in files,
            lambda other: other.package == source.package,
        ):
            nearest = [item for item in found if fits(item[0])]
            if nearest:
                return nearest
        return []

    def _may_be_here(self, other: Source, source: Source, files: frozenset[str]) -> bool:
        """Whether a name of a library can be what *other* defines.

        A mock in a source file is that of its own program only, and a header that nothing of the program includes is of another
        one: rosserial's ``ros_lib`` for a microcontroller has classes of the names that roscpp's have.
        """
        if other.path == source.path or other.path in files:
            return True
        return other.path.endswith(HEADERS) and any(other.path in self.reach(path) for path in (source.path, *files))

    def _of_a_class(self, entity: object) -> bool:
        return isinstance(entity, Function) and entity.owner in self.classes

    def traced(self, trace: Trace | None) -> None:
        """Tell *trace* from now on what is looked up; None to stop."""
        self.trace = trace
        for table in (self.classes, self.functions, self.variables, self.aliases, self.macros, self.by_tail):
            if isinstance(table, Traced):
                table.follow(trace)

    def sees(self, source: Source, other: Source, files: frozenset[str]) -> bool:
        """Whether code of *source*, in an executable of *files*, can use the definitions of *other*, as far as the build files show."""
        if other.path == source.path or other.path in files or other.package == source.package:
            return True
        key = (source.path, files)
        if key not in self.visible:
            paths = self.reach(source.path).union(*(self.reach(path) for path in files))
            self.visible[key] = paths, frozenset(self.sources[path].package for path in paths)
        paths, packages = self.visible[key]
        return other.path in paths or (other.package in packages and not other.path.endswith(HEADERS))

    def visible_from(self, files: frozenset[str], plugins: Iterable[tuple[str, frozenset[str]]]) -> frozenset[str]:
        """The C++ files whose code an executable of *files* may run: what its own can use, and plug-ins if it loads any.

        *plugins* are their bases' names and libraries' files; one counts if its base is visible. Code for tests counts only
        where it is the executable's own or included.
        """
        found = set(files)
        waiting = list(files)
        is_loading = False
        #: A package of which something is linked has nothing else that is used.
        packages: set[str | None] = {self.sources[path].package for path in files if path in self.sources}
        while waiting:
            path = waiting.pop()
            source = self.sources.get(path)
            if source is None:
                continue
            reached = {path, *self.reach(path)}
            is_loading = is_loading or any(self._loads(item) for item in reached)
            found |= reached
            new = {self.sources[item].package for item in reached if item in self.sources} - packages
            packages |= new
            for package in new:
                more = {source for source in self._sources_of(package) if source not in found}
                found |= more
                waiting += sorted(more)
            if not waiting and is_loading:
                bases = {BEHAVIOR_TREE_NODE} if any(self._ticks(item) for item in found) else set()
                bases |= {
                    class_.name.rpartition("::")[2]
                    for p in found
                    if p in self.sources
                    for class_ in self.sources[p].program.classes
                }
                more = {path for base, paths in plugins if base in bases for path in paths} - found
                packages |= {self.sources[path].package for path in more if path in self.sources}
                found |= more
                waiting += sorted(more)
        return frozenset(found)

    def _sources_of(self, package: str | None) -> list[str]:
        """The files of a package that are no headers, and not for tests."""
        if not self.by_package:
            for source in self.sources.values():
                if not source.path.endswith(HEADERS) and not is_test(source.path):
                    self.by_package.setdefault(source.package, []).append(source.path)
        return self.by_package.get(package, [])

    def _loads(self, path: str) -> bool:
        source = self.sources.get(path)
        return source is not None and any(
            "class_loader" in include or brings_trees(include) for include in source.program.includes
        )

    def _ticks(self, path: str) -> bool:
        return path in self.sources and any(map(brings_trees, self.sources[path].program.includes))

    def reach(self, path: str) -> frozenset[str]:
        """The workspace's files that a C++ file includes, and those that they include."""
        found = self.reached.get(path)
        if found is None:
            seen: set[str] = set()
            waiting = [path]
            while waiting:
                for target in self._links(waiting.pop()):
                    if target not in seen:
                        seen.add(target)
                        waiting.append(target)
            found = self.reached[path] = frozenset(seen - {path})
        return found

    def _links(self, path: str) -> tuple[str, ...]:
        known = self.links.get(path)
        if known is None:
            source = self.sources.get(path)
            found: dict[str, None] = {}
            for include in source.program.includes if source is not None else ():
                found.update(dict.fromkeys(self.included_files(include.strip('<>" '), path)))
            known = self.links[path] = tuple(found)
        return known

    def included_files(self, include: str, path: str) -> list[str]:
        """The files that an include may mean: beside the file that includes it, else by the end of their paths."""
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), include))
        if beside in self.sources:
            return [beside]
        tail = posixpath.normpath(include).lstrip("./")
        found = [
            other
            for other in self.file_names.get(posixpath.basename(tail), ())
            if other == tail or other.endswith(f"/{tail}")
        ]
        package = self.sources[path].package
        for package_name in (tail.partition("/")[0], package):
            own = [other for other in found if self.sources[other].package == package_name]
            if own:
                return own
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
        for namespace in self.opened(source):
            yield f"{namespace}::{name}"

    def opened(self, source: Source) -> tuple[str, ...]:
        """The namespaces that using-directives open in a file: its own, then those of the headers that it includes."""
        found = self.open.get(source.path)
        if found is None:
            spaces = [namespace for _, namespace in source.program.scopes]
            for path in sorted(self.reach(source.path)):
                spaces += [space for around, space in self.sources[path].program.scopes if not around]
            found = self.open[source.path] = tuple(dict.fromkeys(spaces))
        return found

    def opened_in(self, source: Source, around: str) -> tuple[str, ...]:
        """The namespaces that using-directives open in the namespace *around*, as far as a file and what it includes tell."""
        key = (source.path, around)
        found = self.inside.get(key)
        if found is None:
            own = (source, *(self.sources[path] for path in sorted(self.reach(source.path))))
            spaces = [space for unit in own for at, space in unit.program.scopes if at == around and around]
            inner = [f"{around}::{space}" for space in spaces if not space.startswith("::")]
            found = self.inside[key] = tuple(dict.fromkeys((*inner, *(space.removeprefix("::") for space in spaces))))
        return found

    def messages(self, source: Source) -> Mapping[str, str]:
        """``pkg::Type`` for every ``#include "pkg/Type.h"`` of a file and of the headers that it includes, by ``Type``.

        ``pkg::msg`` for ``pkg/msg/some_type.hpp``, by ``msg/some_type``.

        Of two packages' types of one name the file's own inclusion counts; else it is left out.
        """
        found = self.headers.get(source.path)
        if found is None:
            every: dict[str, set[str]] = defaultdict(set)
            for path in self.reach(source.path):
                for name, whole in self.included.get(path, {}).items():
                    every[name].add(whole)
            single = {name: next(iter(wholes)) for name, wholes in every.items() if len(wholes) == 1}
            found = self.headers[source.path] = {**single, **self.included.get(source.path, {})}
        return found

    def includes(self, source: Source, entities: Iterable[tuple[Source, object]]) -> bool:
        """Whether one of *entities* stands in a file or in what it includes."""
        if source.separator == ".":
            return True
        return any(where.path == source.path or where.path in self.reach(source.path) for where, _ in entities)


def is_test(path: str) -> bool:
    """Whether a file is in a folder for tests."""
    return any(part in ("test", "tests") for part in path.split("/"))


def aliased(index: Index, name: str, source: Source | None = None, depth: int = 0) -> str | None:
    """The class that a typedef's name stands for, seen from *source* or else from anywhere; None if it is certainly no alias."""
    found = index.aliases.get(name, [])
    if source is not None:
        found = [item for item in found if index.includes(source, (item,))]
    targets: set[str | None] = set()
    for where, alias in found:
        around = name.rpartition("::")[0]
        names = [scope for scope in index.scopes(alias.type.name, around, where) if scope != name]
        target = next((item for item in names if index.classes.get(item)), None)
        if target is None and depth < ALIASES:
            deeper = (aliased(index, item, where, depth + 1) for item in names if item in index.aliases)
            target = next((item for item in deeper if item is not None), None)
        targets.add(None if alias.type.marks else target)
    return targets.pop() if len(targets) == 1 else None


def pointed_class(index: Index, name: str, scope: str, source: Source) -> str | None:
    """The class of the workspace that a name of no type ends in ``Ptr`` after: a macro has declared a pointer to it."""
    for suffix in POINTERS:
        bare = name.removesuffix(suffix)
        if bare != name:
            names = (item for item in index.scopes(bare, scope, source) if index.classes.get(item))
            return next((item for item in names if index.includes(source, index.classes[item])), None)
    return None
