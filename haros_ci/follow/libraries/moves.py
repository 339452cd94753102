# SPDX-License-Identifier: Apache-2.0
"""``std::move`` of what is another thing afterwards: who is given a text or a ``unique_ptr`` may have taken it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import STRINGS
from haros_ci.values.abstract import Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Types of which a moved one is empty, or is not known to be what it was (en.cppreference.com/w/cpp/utility/move).
EMPTIED = frozenset(("std::unique_ptr", *(name for name in STRINGS if not name.endswith("_view"))))
AWAY = "it may be moved away before"


def away(walk: Walk, frame: Frame, argument: PassedArgument) -> Value:
    """What is moved; the variable that it comes from is not known any more."""
    value, cell = argument.value, argument.cell
    if cell is not None and cell.type is not None and cell.type.name in EMPTIED and "c" not in cell.type.marks:
        walk.state.write(cell, walk.opaque(AWAY, frame, None, cell.type))
    return value
