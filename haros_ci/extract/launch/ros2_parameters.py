# SPDX-License-Identifier: Apache-2.0
"""``<param>`` of ROS 2 launch files: values with their types, nested names, and parameter files."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from haros_ci.extract.launch.ros2_entity import Entity, loaded
from haros_ci.model.launch_actions import ParameterSource, Phrase

_TYPES = {
    "str": "str",
    "bool": "bool",
    "int": "int",
    "float": "float",
    "list_of_str": "str_array",
    "list_of_bool": "bool_array",
    "list_of_int": "int_array",
    "list_of_float": "float_array",
    "yaml": None,
}
_Text = Callable[[Entity, Any], Phrase]
_Wrong = Callable[[Entity, str], None]
_Values = list[tuple[Phrase, Any]]
_Types = list[tuple[str, str]]


def parameter_sources(entity: Entity, text: _Text, wrong: _Wrong) -> tuple[ParameterSource, ...]:
    """The sources of parameters among the children of *entity*, in order (launch_ros ``parse_nested_parameters``).

    *text* reads an attribute into a phrase, *wrong* reports a tag that launch refuses; that tag is left out.
    """
    found = []
    for child in entity.all("param"):
        file = child.get("from")
        if file is not None and child.get("name") is not None:
            wrong(child, "<param> has both 'name' and 'from'; keep one")
        elif file is not None:
            allowed = child.get("allow_substs")
            substitutes = allowed is True or str(allowed).strip().lower() in ("true", "1", "yes", "on")
            path = text(child, file)
            found.append(ParameterSource(kind="file", location=child.location, path=path, substitutes=substitutes))
        elif child.get("name") is not None:
            values: _Values = []
            types: _Types = []
            _nested(child, (), text, wrong, values, types)
            found.append(
                ParameterSource(kind="values", location=child.location, values=tuple(values), types=tuple(types))
            )
        else:
            wrong(child, "<param> needs 'name' or 'from'; add one")
    return tuple(found)


def _nested(entity: Entity, prefix: Phrase, text: _Text, wrong: _Wrong, values: _Values, types: _Types) -> None:
    name = (*prefix, *text(entity, entity.get("name")))
    inner = entity.all("param")
    value = entity.get("value")
    identifier = entity.get("type")
    if inner and (value is not None or identifier is not None):
        wrong(entity, "<param> has both a value or type and <param>s in it; keep one")
    elif inner:
        for child in inner:
            if child.get("name") is None:
                wrong(child, "<param> in a <param> needs 'name'; add it")
            else:
                _nested(child, (*name, "."), text, wrong, values, types)
    elif value is None:
        wrong(entity, "<param> needs 'value' or <param>s in it; add one")
    elif identifier is not None and identifier not in _TYPES:
        wrong(entity, f"<param type='{identifier}'>: write one of {', '.join(_TYPES)}")
    else:
        kind = None if identifier is None else _TYPES[identifier]
        separator = entity.get("value-sep")
        if separator and isinstance(value, str) and not entity.is_typed:
            items = [_value(entity, _read(item, None), text) for item in value.split(separator)]
            values.append((name, items if all(not isinstance(item, tuple) for item in items) else tuple(items)))
        else:
            values.append((name, _value(entity, value if entity.is_typed else _read(value, kind), text)))
        if kind is not None:
            types.append(("".join(part if isinstance(part, str) else "?" for part in name), kind))


def _read(value: str, kind: str | None) -> Any:
    """The text of an XML attribute as launch coerces it: by YAML, but for what is said to be text."""
    if kind == "str":
        return value
    made = loaded(value)
    return value if made is None else made


def _value(entity: Entity, value: Any, text: _Text) -> Any:
    """Plain data, or a phrase where substitutions stand in it; of a list with such a tuple."""
    if isinstance(value, list):
        items = [_value(entity, item, text) for item in value]
        return tuple(items) if any(isinstance(item, tuple) for item in items) else items
    if not isinstance(value, str):
        return value
    phrase = text(entity, value)
    if all(isinstance(part, str) for part in phrase):
        return "".join(part for part in phrase if isinstance(part, str))
    return phrase
