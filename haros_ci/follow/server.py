# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node sets on the parameter server by itself."""

from __future__ import annotations

from haros_ci.values.abstract import Known, Opaque, Value


def inside(value: Value, path: str) -> Value | None:
    """What is at *path* in a parameter that is a map; None if it is no map, or has nothing there."""
    if not isinstance(value, Known):
        return Opaque("it is inside a parameter that the node sets")
    data = value.value
    for part in path.split("/"):
        if not isinstance(data, dict) or part not in data:
            return None
        data = data[part]
    return Known(data)
