# SPDX-License-Identifier: Apache-2.0
"""What classes of interpreted files have from their bases."""

from __future__ import annotations

from haros_ci.launch.python.values import ScriptClass, Value
from haros_ci.model.reached import reached


def lineage(first: ScriptClass) -> tuple[ScriptClass, ...]:
    """A class and all above it, depth first; what is reached by several ways stands there once."""
    return tuple(reached(first, lambda one: one.bases))


def find(owner: ScriptClass, name: str) -> Value | None:
    """The variable or method *name* of a class or of what is above it; None if there is none."""
    return next((one.variables[name] for one in lineage(owner) if name in one.variables), None)
