# SPDX-License-Identifier: Apache-2.0
"""The parameters that a ROS 2 node has, listed by prefix: those it has declared, and those it is given where it declares all."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.ros import ros2_nodes
from haros_ci.graph.given_parameters import EVERY
from haros_ci.values.abstract import Cell, Known, Opaque, Pointer, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied
    from haros_ci.graph.ros2_process import RosNode

_TEXTS = syntax.Type("std::vector", (syntax.Type("std::string"),))


def listed(applied: Applied, prefixes: Value | None, depth: Value | None, what: str) -> Value:
    """The names of the receiver's parameters below *prefixes* (*what* ``parameters``), or the prefixes of these names.

    With *depth* only names with fewer dots after the prefix count, 0 is all (rclcpp/src/rclcpp/node_interfaces/
    node_parameters.cpp: ``list_parameters``). The names are sorted.
    """
    node = ros2_nodes.of_value(applied.walk, applied.receiver)
    requested = _texts(prefixes)
    levels = depth.value if isinstance(depth, Known) else None
    if node is None or requested is None or not isinstance(levels, int):
        return applied.walk.opaque("which parameters are listed", applied.frame, applied.location.line, _TEXTS)
    names = _names(applied, node)
    if isinstance(names, Opaque):
        return Opaque(names.reason, names.location, _TEXTS)
    chosen = [name for name in sorted(names) if _is_below(name, requested, levels)]
    if what == "prefixes":
        chosen = list(dict.fromkeys(name.rpartition(".")[0] for name in chosen if "." in name))
    return Sequence(Cell(tuple(Cell(Known(name)) for name in chosen)), _TEXTS)


def _is_below(name: str, prefixes: list[str], depth: int) -> bool:
    if not prefixes:
        return depth == 0 or name.count(".") < depth
    return any(
        name == prefix or (name.startswith(f"{prefix}.") and (depth == 0 or name[len(prefix) + 1 :].count(".") < depth))
        for prefix in prefixes
    )


def _names(applied: Applied, node: RosNode) -> Iterable[str] | Opaque:
    walk = applied.walk
    own = walk.declared.value
    whole = node.whole
    if isinstance(own, Opaque):
        return own
    for made in walk.made.values():
        if made.kind == "parameters" and made.node is not None and made.node.name == whole.name and "?" in made.name:
            return Opaque("parameters are declared under names that are not known", made.location)
    head = f"{whole.name}:"
    found = {name.removeprefix(head) for name in own if name.startswith(head)}
    if whole.options.get("automatically_declare_parameters_from_overrides"):
        argument_value = walk.context.parameter(f"{head}{EVERY}")
        if isinstance(argument_value, Opaque):
            return argument_value
        outside = argument_value.value if isinstance(argument_value, Known) else ()
        found |= {*whole.given, *(str(name) for name in (outside if isinstance(outside, Iterable) else ()))}
    return found


def _texts(value: Value | None) -> list[str] | None:
    """The texts of a list; None if they are not known."""
    if isinstance(value, Pointer):
        value = value.cell.value
    content = value.content.value if isinstance(value, Sequence) else None
    if isinstance(value, Known) and issubclass(value.kind, list):
        content = tuple(Cell(Known(item)) for item in value.of(list))
    if not isinstance(content, tuple):
        return None
    texts = [cell.value.value if isinstance(cell.value, Known) else None for cell in content]
    return [text for text in texts if isinstance(text, str)] if all(isinstance(t, str) for t in texts) else None
