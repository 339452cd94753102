# SPDX-License-Identifier: Apache-2.0
"""Nodes and node handles that a library which is not here is given: it may make more on them than is seen."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

from haros_ci.follow.libraries import given_away
from haros_ci.follow.ros import api_rows, ros2_nodes
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.values.abstract import Object, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk

#: Macros, which log before all, Qt's classes, and functions that keep what they are given for a function of the workspace.
_OTHERS = regex(r"[A-Z][A-Z0-9_]+$|Q[A-Z]\w+|Qt\w*::|(?:QObject::)?connect$")
#: Why a node may have more than is seen.
GIVEN = "{} is not in the workspace, which is given the node and may make more on it"


def note(walk: Walk, name: str, values: Iterable[Value], location: Location) -> None:
    """Nodes or node handles among *values* are given to the function or class *name*, which is not seen."""
    is_other = name.startswith(ros2_nodes.DECLARING_NOTHING) or given_away.is_known(name) or _is_of_python(name)
    if walk.quiet or walk.is_raised or is_other or _OTHERS.match(name):
        return
    is_of_library = "::" in name or "." in name  # else it may be a variable's
    is_here = name in walk.index.functions or name in walk.index.classes
    if is_of_library and not is_here and any(_is_node(walk, value) for value in values):
        walk.gaps.setdefault(GIVEN.format(name), location)


def _is_of_python(name: str) -> bool:
    first, dot, _ = name.partition(".")
    return first in given_away.KNOWN_PYTHON or first in sys.stdlib_module_names or (not dot and hasattr(builtins, name))


def _is_node(walk: Walk, value: Value) -> bool:
    if walk.context.process is not None:
        return ros2_nodes.of_value(walk, value) is not None
    value = value.cell.value if isinstance(value, Pointer) else value
    return isinstance(value, Object) and value.name in api_rows.HANDLES
