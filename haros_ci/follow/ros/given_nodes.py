# SPDX-License-Identifier: Apache-2.0
"""Nodes and node handles that a library which is not here is given: it may make more on them than is seen."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from haros_ci.follow.libraries import given_away, harmless
from haros_ci.follow.ros import api_rows, ros2_nodes
from haros_ci.model.location import Location
from haros_ci.values.abstract import Object, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.follow.walk import Walk

#: Why a node may have more than is seen.
GIVEN = "the node is given to {}, which is not in the workspace and may make more on it"


def to_function(walk: Walk, name: str, args: tuple[PassedArgument, ...], location: Location) -> None:
    """The function or method *name* of a library is called; a name without a namespace or module may be a variable's or a macro's."""
    if "::" in name or "." in name:
        to_class(walk, name, args, location)


def to_class(walk: Walk, name: str, args: tuple[PassedArgument, ...], location: Location) -> None:
    """The class *name* of a library is constructed: what it makes of a node among *args* is not known."""
    if walk.quiet or walk.is_raised or not any(_is_node(walk, argument.value) for argument in args):
        return
    is_here = name in walk.index.functions or name in walk.index.classes
    if not is_here and not _leaves_alone(name):
        walk.gaps.setdefault(GIVEN.format(name), location)


def _leaves_alone(name: str) -> bool:
    """Whether the library of a function or class makes nothing on nodes: the client libraries' own, Python's, Qt, and what only reads."""
    first = name.partition(".")[0]
    is_of_python = first in given_away.KNOWN_PYTHON or first in sys.stdlib_module_names
    is_of_qt = given_away.is_known(name.partition("::")[0])
    is_harmless = harmless.is_harmless(name, "::" not in name)
    return is_of_python or is_of_qt or is_harmless or name.startswith(("super().", *ros2_nodes.DECLARING_NOTHING))


def _is_node(walk: Walk, value: Value) -> bool:
    if walk.context.process is not None:
        return ros2_nodes.of_value(walk, value) is not None
    value = value.cell.value if isinstance(value, Pointer) else value
    return isinstance(value, Object) and value.name in api_rows.HANDLES
