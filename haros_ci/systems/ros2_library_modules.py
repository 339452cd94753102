# SPDX-License-Identifier: Apache-2.0
"""Which Python classes are for the nodes of others: in an importable module, given a node or one themselves, made by no process here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.index.index import Source
from haros_ci.syntax import Class, Type
from haros_ci.systems.following import Types
from haros_ci.systems.ros2_library import Library, Seen
from haros_ci.systems.ros2_library_classes import ASIDE, DEEPEST

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
    for source, definition in every:
        if "." in definition.name or definition.name in seen.classes:
            continue
        name = f"{definition.name}.__init__"
        inits = [f for f in source.program.functions if f.name == name and f.body is not None]
        whole = f"{source.module}.{definition.name}"
        if not inits or not relevance.makes(inits[-1], source):
            continue
        later = (f.line for f in source.program.functions if f.kind != "lambda" and f.line > inits[-1].line)
        if seen.between(source.path, inits[-1].line, min(later, default=float("inf"))):
            continue
        nodes = {
            number: syntax.Type("rclpy.node.Node")
            for number, parameter in enumerate(inits[-1].parameters)
            if _takes_node(kinds, source, parameter.name, parameter.type)
        }
        if nodes or (_is_node(whole, kinds) and whole not in subclassed):
            yield Library(source.package or "", source, definition, frozenset((source.path,)), inits[-1], None, nodes)


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


def _is_node(name: str, kinds: Mapping[str, Iterable[str]], depth: int = 0) -> bool:
    return name in NODES or (depth < DEEPEST and any(_is_node(base, kinds, depth + 1) for base in kinds.get(name, ())))
