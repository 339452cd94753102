# SPDX-License-Identifier: Apache-2.0
"""Which Python classes are for the nodes of others: in an importable module, given a node or one themselves, made by no process here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.index.index import Source
from haros_ci.index.relevance import Relevance
from haros_ci.model.reached import reached
from haros_ci.syntax import Class, Function, Type
from haros_ci.systems.following import Types
from haros_ci.systems.ros2_library import Library, Seen
from haros_ci.systems.ros2_library_classes import ASIDE

#: What is a node in rclpy.
NODES = frozenset(
    (
        "rclpy.node.Node",
        "rclpy.Node",
        "rclpy.lifecycle.Node",
        "rclpy.lifecycle.node.Node",
        "rclpy.lifecycle.LifecycleNode",
    )
)


def libraries(types: Types, seen: Seen) -> Iterator[Library]:
    """The Python classes of ROS 2 packages that are for the nodes of others, by module."""
    relevance = types.relevance.get(("python", 2))
    if relevance is None or 2 not in types.versions.values():
        return
    every = [
        (source, definition)
        for _, source in sorted(types.programs.sources.items())
        if source.program.language == "python" and source.module and types.versions.get(source.package or "") == 2
        if f"{source.path.rpartition('/')[0]}/__init__.py" in types.programs.sources and not _is_aside(source.path)
        for definition in source.program.classes
    ]
    kinds = {f"{source.module}.{definition.name}": _bases(source, definition) for source, definition in every}
    subclassed = {base for bases in kinds.values() for base in bases}
    owners = {f"{source.module}.{definition.name}": (source, definition) for source, definition in every}
    for source, definition in every:
        whole = f"{source.module}.{definition.name}"
        if "." in definition.name or definition.name in seen.classes:
            continue
        begins = _constructor(owners, kinds, whole)
        if begins is None:
            continue
        where, init = begins
        nodes = {
            number: syntax.Type("rclpy.node.Node")
            for number, parameter in enumerate(init.parameters)
            if _takes_node(kinds, where, parameter.name, parameter.type)
        }
        is_new = where is source and relevance.makes(init, source) and not _is_seen(source, init, seen)
        called = _called(source, definition, relevance, seen) if nodes and whole not in subclassed else ()
        if (is_new or called) and (nodes or (_is_node(whole, kinds) and whole not in subclassed)):
            files = frozenset((source.path, where.path))
            yield Library(source.package or "", source, definition, files, init, None, nodes, called=called)


def _constructor(
    owners: Mapping[str, tuple[Source, Class]], kinds: Mapping[str, Iterable[str]], name: str
) -> tuple[Source, Function] | None:
    """``__init__`` of a class, or of the first of its bases in modules like its own that has one."""
    for source, definition in (owners[one] for one in _lineage(name, kinds) if one in owners):
        own = [f for f in source.program.functions if f.name == f"{definition.name}.__init__" and f.body is not None]
        if own:
            return source, own[-1]
    return None


def _lineage(name: str, kinds: Mapping[str, Iterable[str]]) -> Iterator[str]:
    """The name of a class and those of all above it, depth first, without repetition."""
    return reached(name, lambda one: kinds.get(one, ()))


def _called(source: Source, definition: Class, relevance: Relevance, seen: Seen) -> tuple[Function, ...]:
    """The public methods and properties of a class that may make something of which nothing in the workspace is seen to make any."""
    return tuple(
        function
        for function in source.program.functions
        if function.owner == definition.name
        and function.kind == "function"
        and not function.name.rpartition(".")[2].startswith("_")
        and relevance.makes(function, source)
        and not _is_seen(source, function, seen)
    )


def _is_seen(source: Source, function: Function, seen: Seen) -> bool:
    """Whether the workspace's processes make anything in a function."""
    later = (f.line for f in source.program.functions if f.kind != "lambda" and f.line > function.line)
    return seen.between(source.path, function.line, min(later, default=float("inf")))


def _is_aside(path: str) -> bool:
    *parts, name = path.split("/")
    return name.startswith("test_") or name == "conftest.py" or any(map(ASIDE.search, parts))


def _bases(source: Source, definition: Class) -> tuple[str, ...]:
    return tuple(_whole(source, base.name) for base in definition.bases)


def _whole(source: Source, name: str) -> str:
    """A dotted name of a module with what its head was imported as, else as one of the module itself."""
    head, dot, rest = name.partition(".")
    for alias in source.program.aliases:
        if alias.name == head:
            target = alias.type.name
            if target.startswith("."):
                above = len(target) - len(target.lstrip("."))
                package = source.module.split(".")
                package = package if source.path.endswith("__init__.py") else package[:-1]
                target = ".".join((*package[: len(package) - above + 1], target.lstrip(".")))
            return f"{target}{dot}{rest}"
    return f"{source.module}.{name}"


def _takes_node(kinds: Mapping[str, Iterable[str]], source: Source, name: str, kind: Type) -> bool:
    if not kind.name:
        return name == "node" or name.endswith("_node")
    return _is_node(_whole(source, kind.name), kinds)


def _is_node(name: str, kinds: Mapping[str, Iterable[str]]) -> bool:
    return not NODES.isdisjoint(_lineage(name, kinds))
