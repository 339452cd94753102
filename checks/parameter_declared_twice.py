# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node declares twice: the second time throws."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from haros_ci.api import NO_SYSTEMS, Check, End, Finding, Level, System, line_of, regex

_CLASS = regex(r"class[ \t]+(\w+)[ \t]*\(([^)\n]*)\)")
_NODE = regex(r"\b(?:Lifecycle)?Node\b")


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        if node.ros != 2 or not node.known or system.name.endswith(NO_SYSTEMS):
            continue
        for key, ends in node.names.declared.items():
            if "?" in key or key in node.names.set or len(ends) < 2:
                continue
            certain = [end for end in ends if not (end.implicit or end.conditions or is_doubtful(end))]
            for first, second in combinations(certain, 2):
                if first.raw.location is not None and second.raw.location not in (None, first.raw.location):
                    if _are_of_two_nodes(first, second, system):
                        continue
                    yield Finding(
                        at=second.location,
                        message=f"{node.type} declares the parameter {key} twice: the second call throws "
                        f"ParameterAlreadyDeclaredException; the first declaration is at {line_of(first.location)}; remove one",
                        about=(first, second, key),
                        related=((first.location, "first declaration"),),
                    )


def is_doubtful(end: End) -> bool:
    """Whether it is not known that this very parameter is declared; what its default is does not matter."""
    return any(unknown.field in ("name", "presence", "conditions") for unknown in end.raw.unknowns)


def _are_of_two_nodes(first: End, second: End, system: System) -> bool:
    """Whether two classes of nodes declare it, of which a launch file gives both the name of their program: each node has parameters of its own."""
    one, other = _class_of(first, system), _class_of(second, system)
    return one is not None and other is not None and one != other


def _class_of(end: End, system: System) -> tuple[str, str] | None:
    """The Python class, a direct subclass of Node, that declares a parameter of its object there."""
    place = end.location
    lines = system.workspace.text(place.path).split("\n") if system.workspace is not None else []
    if (
        not place.path.endswith(".py")
        or not place.line
        or place.line > len(lines)
        or "self." not in lines[place.line - 1]
    ):
        return None
    heads = (found for line in reversed(lines[: place.line]) if (found := _CLASS.match(line)) is not None)
    head = next(heads, None)
    return (place.path, head[1]) if head is not None and _NODE.search(head[2]) else None


CHECK = Check(
    id="parameter-declared-twice",
    summary="Parameter declared twice by one node.",
    level=Level.ERROR,
    tags=("parameters",),
    run=check,
)
