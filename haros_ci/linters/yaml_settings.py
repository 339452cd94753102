# SPDX-License-Identifier: Apache-2.0
"""Settings that are written in YAML as plain values, within fixed limits."""

from __future__ import annotations

import json
from typing import Any

from haros_ci.bounded_yaml import YamlFault, YamlLimits, data

LIMITS = YamlLimits(characters=50_000, depth=20, aliases=20)


def read(text: str) -> dict[str, Any]:
    """The map that *text* is in YAML, as JSON could write it. Raises ValueError, with the line where one is known."""
    try:
        value = json.loads(json.dumps(data(text, LIMITS), default=str))
    except YamlFault as err:
        raise ValueError(f"line {err.line}: {err.problem}" if err.is_placed else err.problem) from err
    except (RecursionError, TypeError) as err:
        raise ValueError(str(err).partition("\n")[0]) from err
    if value is not None and not isinstance(value, dict):
        raise ValueError("not a map")
    return value or {}
