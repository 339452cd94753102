# SPDX-License-Identifier: Apache-2.0
"""Sources of a node's parameters (launch_ros ``normalize_parameters``), and remappings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from haros_ci.launch.python.phrases import pair_of
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    LaunchObject,
    Library,
    LibraryCall,
    Maybe,
    PartialText,
    PathValue,
    Rest,
    Sub,
    Unknown,
    Value,
    holes,
    merged,
    mystery,
    phrase,
    why,
)
from haros_ci.model.launch_actions import ParameterSource, Phrase
from haros_ci.model.location import Location

DEPTH = 12
SCALARS = (bool, int, float, str)
TYPE_NAMES = {"str": "str", "int": "int", "float": "float", "bool": "bool"}
#: A pair of a dotted name and a value, and the name of its type or "".
Entry = tuple[Phrase, Any, str]


def sources(run: ScriptEvaluation, value: Value, place: Location) -> tuple[ParameterSource, ...]:
    """``parameters=value``: a source for each item."""
    if value is None:
        return ()
    if isinstance(value, dict) or (isinstance(value, LaunchObject) and value.name.endswith("ParameterFile")):
        return (source(run, value, place),)
    items = items_of(run, value, place)
    if isinstance(items, Unknown):
        return (lost(items.reason, items.location or place),)
    return tuple(source(run, item, place) for item in items)


def lost(reason: str, place: Location) -> ParameterSource:
    return ParameterSource(kind="?", location=place, reason=reason or "it is not known")


def source(run: ScriptEvaluation, value: Value, place: Location) -> ParameterSource:
    """One item: a dictionary, a Parameter, or the path of a file."""
    run.budget.step()
    if isinstance(value, (Unknown, Maybe)):
        return lost(why(value), getattr(value, "location", None) or place)
    if isinstance(value, dict):
        return of_values(entries(run, value, (), place, 0), run.place(value, place))
    if isinstance(value, LaunchObject):
        last = value.name.rpartition(".")[2]
        if last == "ParameterFile":
            return ParameterSource(
                kind="file",
                location=value.location,
                path=phrase(value.fields.get("param_file")),
                substitutes=value.fields.get("allow_substs", False) is not False,
            )
        if last == "Parameter":
            made = of_values((entry(run, phrase(value.fields.get("name")), value, place),), value.location)
            return replace(made, argument=True)
        if "items" in value.fields and isinstance(value.fields["items"], dict):
            return source(run, value.fields["items"], place)
        return lost(f"{value.name} is no source of parameters that is known", place)
    if isinstance(value, (str, PartialText, Sub, PathValue)):
        return ParameterSource(kind="file", location=place, path=phrase(value))
    if isinstance(value, (list, tuple)) and all(isinstance(item, (str, PartialText, Sub, Unknown)) for item in value):
        return ParameterSource(kind="file", location=run.place(value, place), path=phrase(value))
    return lost(why(value), place)


def of_values(found: tuple[Entry, ...], place: Location) -> ParameterSource:
    types = tuple((name[0], kind) for name, _, kind in found if kind and len(name) == 1 and isinstance(name[0], str))
    return ParameterSource(
        kind="values", location=place, values=tuple((name, value) for name, value, _ in found), types=types
    )


def entries(
    run: ScriptEvaluation, value: dict[Any, Value], prefix: Phrase, place: Location, depth: int
) -> tuple[Entry, ...]:
    """The items of a dictionary, nested ones by dotted names."""
    result: list[Entry] = []
    for key, item in value.items():
        run.budget.step()
        if isinstance(key, Rest):
            result.append(
                (merged((*prefix, *((".",) if prefix else ()), mystery(key.reason, key.location))), phrase(key), "")
            )
            continue
        name = merged((*prefix, *((".",) if prefix else ()), *phrase(key)))
        if isinstance(item, dict):
            if depth < DEPTH:
                result.extend(entries(run, item, name, place, depth + 1))
            else:
                result.append((name, (mystery("it is nested too deep", place),), ""))
        else:
            result.append(entry(run, name, item, place))
    return tuple(result)


def entry(run: ScriptEvaluation, name: Phrase, value: Value, place: Location) -> Entry:
    """A parameter's value, and its type where the code says it."""
    if isinstance(value, LaunchObject) and value.name.rpartition(".")[2] in ("ParameterValue", "Parameter"):
        inner = entry(run, name, value.fields.get("value"), place)
        return name, inner[1], type_name(value.fields.get("value_type")) or inner[2]
    if value is None or isinstance(value, SCALARS):
        return name, value, ""
    if isinstance(value, Sub):
        return name, phrase(value), ""
    if isinstance(value, (PartialText, PathValue)):
        text = phrase(value)
        known = len(text) == 1 and isinstance(text[0], str)
        return name, text[0] if known else text, "" if known else "str"
    if isinstance(value, (list, tuple)):
        return array(name, value, place)
    if isinstance(value, Unknown):
        return name, (mystery(value.reason, value.location or place),), ""
    return name, (mystery(why(value), place),), ""


def array(name: Phrase, value: Any, place: Location) -> Entry:
    """A list: of plain data, one text in parts (if a substitution is among them), or texts."""
    if (doubt := holes(value)) is not None:
        return name, (mystery(doubt.reason, doubt.location or place),), ""
    if all(isinstance(item, SCALARS) for item in value):
        return name, list(value), ""
    if any(isinstance(item, Sub) for item in value) and all(isinstance(item, (Sub, str)) for item in value):
        return name, phrase(value), ""
    if any(isinstance(item, dict) for item in value):
        return name, (mystery("a dictionary in a list is no parameter", place),), ""
    kind = "str_array" if any(isinstance(item, PartialText) for item in value) else ""
    return name, tuple(phrase(item) for item in value), kind


def type_name(value: Value) -> str:
    """``value_type=``: str, int, float, bool, or a list of such."""
    if not isinstance(value, Library):
        return ""
    outer, _, inner = value.dotted.partition("[")
    if inner and outer.rpartition(".")[2].lower() == "list":
        last = TYPE_NAMES.get(inner.rstrip("]").rpartition(".")[2], "")
        return f"{last}_array" if last else ""
    return TYPE_NAMES.get(outer.rpartition(".")[2], "")


def remaps(run: ScriptEvaluation, value: Value, call: LibraryCall) -> tuple[tuple[Phrase, Phrase, Location], ...]:
    """``remappings=value``: pairs in order, each where its tuple stands."""
    if value is None:
        return ()
    items = items_of(run, value, call.location)
    if isinstance(items, Unknown):
        unknown: Phrase = (mystery(items.reason, items.location or call.location),)
        return ((unknown, unknown, call.location),)
    result = []
    for item in items:
        inner = item.value if isinstance(item, Maybe) else item
        result.append((*pair_of(item, call), run.place(inner, call.location)))
    return tuple(result)
