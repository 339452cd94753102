# SPDX-License-Identifier: Apache-2.0
"""What a server of dynamic_reconfigure sets the parameters of its .cfg file to, as it begins (dynamic_reconfigure/server.h, server.py)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from haros_ci.model.build import ConfigParameter
from haros_ci.values.abstract import Known, Opaque, Value, data_of, opaque_of

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

DEFAULT = "its default in the .cfg is not known"
BOUNDS = "whether its bounds in the .cfg change it is not known"


def item(parameter: ConfigParameter) -> Mapping[str, Value]:
    """What an API row may ask of one parameter of a .cfg."""
    default = parameter.default
    if parameter.type == "double" and type(default) is int:
        default = float(default)
    return {
        "name": Known(parameter.name),
        "type": Known(parameter.type),
        "default": Known(default),
        "group": Known(parameter.group),
        "minimum": Known(parameter.minimum),
        "maximum": Known(parameter.maximum),
    }


def written(applied: Applied, name: str) -> tuple[object, Opaque | None]:
    """What the server writes under the full *name*: what it reads there, else its default, within its bounds; else why that is not known.

    It writes a number anew that lies outside of its bounds, and all parameters that nobody has set.
    """
    from haros_ci.follow.ros.api_rows import parameter_value

    assert applied.item is not None
    default = applied.item["default"]
    found = parameter_value(applied, name, default)
    known, data = data_of(found) if found is not None else (False, None)
    if not known:
        return None, (opaque_of(found) if found is not None else None) or Opaque(DEFAULT)
    if data is None:
        return None, Opaque(DEFAULT)
    if found is default or not isinstance(data, (int, float)) or isinstance(data, bool):
        return data, None
    least, most = (_number(applied.item[bound]) for bound in ("minimum", "maximum"))
    if least is None or most is None:
        return None, Opaque(BOUNDS)
    return min(max(data, least), most), None


def _number(value: Value) -> float | None:
    held = value.value if isinstance(value, Known) else None
    return held if isinstance(held, (int, float)) and not isinstance(held, bool) else None
