# SPDX-License-Identifier: Apache-2.0
"""How messages name places."""

from __future__ import annotations

from haros_ci.model.location import Location


def line_of(location: Location) -> str:
    """``path:line`` of *location*, for messages that name a place in another file (a column would be noise there)."""
    return location.path if location.line is None else f"{location.path}:{location.line}"
