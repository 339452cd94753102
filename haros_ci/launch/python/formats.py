# SPDX-License-Identifier: Apache-2.0
"""Texts made of values: ``str(x)``, f-strings, ``format`` and ``%``."""

from __future__ import annotations

import string
from typing import Any

from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    Maybe,
    PartialText,
    PathValue,
    Unknown,
    Value,
    merged,
    mystery,
    phrase,
    text_of,
    why,
)
from haros_ci.model.location import Location
from haros_ci.regex import regex

SPEC = regex(r"[^0-9]?[<>=^]?[-+ ]?#?0?[0-9]{0,3}[,_]?(\.[0-9]{1,2})?[bcdeEfFgGnosxX%]?")
PERCENT = regex(r"%(?:\((?P<key>[^()]*)\))?(?P<spec>[-+ #0]?[0-9]{0,3}(?:\.[0-9]{1,2})?)(?P<kind>[a-zA-Z%])")


def as_text(run: ScriptEvaluation, value: Value, place: Location, depth: int = 0) -> Value:
    """``str(value)``: a str, a Text, or Unknown for what has no text of its own."""
    if isinstance(value, (str, PartialText)):
        return value
    if isinstance(value, PathValue):
        return value.text
    if value is None or isinstance(value, (bool, int, float)):
        return str(value)
    if isinstance(value, (list, tuple, dict)) and depth < 10 and plain(value):
        run.budget.step(len(value) + 1)
        return run.made(repr(value), place)
    if isinstance(value, (Unknown, Maybe)):
        return PartialText((mystery(why(value), getattr(value, "location", None)),))
    return PartialText((mystery(f"the text of {why(value)}", place),))


def plain(value: Value, depth: int = 0) -> bool:
    """Whether *value* is nothing but data, at most ten deep and small."""
    if isinstance(value, (list, tuple)):
        return depth < 10 and len(value) < 200 and all(plain(item, depth + 1) for item in value)
    if isinstance(value, dict):
        return depth < 10 and len(value) < 200 and all(plain(k) and plain(v, depth + 1) for k, v in value.items())
    return value is None or isinstance(value, (bool, int, float)) or (isinstance(value, str) and len(value) < 2000)


def formatted_value(run: ScriptEvaluation, value: Value, conversion: str, spec: Value, place: Location) -> Value:
    """``{value!conversion:spec}``."""
    if not isinstance(spec, str):
        return PartialText((mystery("the format is not known", place),))
    if conversion in ("r", "a"):
        return repr(value) if plain(value) else PartialText((mystery(f"the text of {why(value)}", place),))
    if not spec or conversion == "s":
        text = as_text(run, value, place)
        if not spec or not isinstance(text, str):
            return text
        value = text
    if not SPEC.fullmatch(spec):
        return PartialText((mystery("the format is not supported", place),))
    if isinstance(value, (bool, int, float, str)):
        try:
            return format(value, spec)
        except (ValueError, TypeError, OverflowError):
            return PartialText((mystery("the format does not fit", place),))
    return PartialText((mystery(why(value), place),))


def str_format(
    run: ScriptEvaluation, template: str, args: list[Value], keywords: dict[str, Value], place: Location
) -> Value:
    """``template.format(…)`` with names and indices; attributes and items are not supported."""
    parts: list[Any] = []
    turn = 0
    try:
        fields = list(string.Formatter().parse(template))
    except ValueError:
        return run.unknown("the format is wrong", place)
    for literal, name, spec, conversion in fields:
        run.budget.step()
        parts.append(literal)
        if name is None:
            continue
        if name == "":
            name, turn = str(turn), turn + 1
        if name.isascii() and name.isdigit() and len(name) < 4 and int(name) < len(args):
            value = args[int(name)]
        elif name in keywords:
            value = keywords[name]
        else:
            value = Unknown(f"`{name}` in a format is not known", place)
        parts.extend(phrase(formatted_value(run, value, conversion or "", spec or "", place)))
    return run.made(text_of(merged(parts)), place)


def percent(run: ScriptEvaluation, template: Value, values: Value, place: Location) -> Value:
    """``template % values``."""
    if not isinstance(template, str):
        return PartialText((mystery(why(template), place),))
    args = list(values) if isinstance(values, tuple) else [values]
    parts: list[Any] = []
    end = turn = 0
    for match in PERCENT.finditer(template):
        run.budget.step()
        if "%" in template[end : match.start()]:
            break
        parts.append(template[end : match.start()])
        end = match.end()
        kind = match["kind"]
        if kind == "%":
            parts.append("%")
            continue
        if match["key"] is not None:
            value = (
                values.get(match["key"], Unknown("there is no such key", place)) if isinstance(values, dict) else None
            )
        else:
            value = args[turn] if turn < len(args) else Unknown("there are too few values", place)
            turn += 1
        if kind == "s" and not match["spec"]:
            parts.extend(phrase(as_text(run, value, place)))
        elif isinstance(value, (bool, int, float, str)):
            parts.append(f"%{match['spec']}{kind}" % value)
        else:
            parts.append(mystery(why(value), place))
    if "%" in template[end:]:
        return run.unknown("the format is not supported", place)
    parts.append(template[end:])
    return run.made(text_of(merged(parts)), place)
