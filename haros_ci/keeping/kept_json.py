# SPDX-License-Identifier: Apache-2.0
"""What following a node gave, as JSON for the cache; what comes back is checked, as anybody may have written it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Any

from haros_ci.follow.made import MadeEntity
from haros_ci.follow.ros.paces import KINDS as PACES
from haros_ci.graph.parameters import Perhaps, SetByNode
from haros_ci.graph.ros2_process import RemappingRule, RosNode
from haros_ci.model.architecture import KINDS, Condition, Qos
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known, Opaque
from haros_ci.values.given import AsGiven, Unseen
from haros_ci.values.questions import PLAIN, QUESTIONS, Answer

#: Containers in containers that are kept.
DEEPEST = 40


class Unfit(Exception):
    """The value cannot be kept, or is not what was written."""


class PlaceLost(Exception):
    """Nobody knows where a place of an edited file is now."""


Check = Callable[[Any], bool]


def _is(*kinds: type) -> Check:
    return lambda value: value.__class__ in kinds


def _optional(check: Check) -> Check:
    return lambda value: value is None or check(value)


def _every(check: Check) -> Check:
    return lambda value: value.__class__ is tuple and all(check(item) for item in value)


def _plain(value: Any, depth: int = 0) -> bool:
    if value is None or value.__class__ in (bool, int, float, str):
        return True
    if depth > DEEPEST:
        return False
    if isinstance(value, (list, tuple)):
        return all(_plain(item, depth + 1) for item in value)
    return isinstance(value, dict) and all(isinstance(k, str) and _plain(v, depth + 1) for k, v in value.items())


def _is_unknown(value: Any) -> bool:
    return (
        value.__class__ is tuple
        and len(value) == 3
        and isinstance(value[0], str)
        and isinstance(value[1], str)
        and (value[2] is None or value[2].__class__ is Location)
    )


_text, _flag, _line = _is(str), _is(bool), _optional(_is(int))
_place = _optional(_is(Location))
_measure = _optional(_is(int, float, str))
_conditions, _rules = _every(_is(Condition)), _every(_is(RemappingRule))
#: The classes that are kept: the attributes in order, each with what it may be.
CLASSES: dict[type, dict[str, Check]] = {
    Location: {"path": _text, "line": _line, "column": _line, "end_line": _line, "end_column": _line},
    Condition: {"statement": _text, "condition": _text, "location": _is(Location), "is_early": _flag},
    Qos: {
        "history": _optional(_text),
        "depth": _measure,
        "reliability": _optional(_text),
        "durability": _optional(_text),
        "deadline": _measure,
        "lifespan": _measure,
        "liveliness": _optional(_text),
        "lease": _measure,
    },
    RemappingRule: {"node": _text, "source": _text, "target": _text},
    RosNode: {
        "name": _text,
        "own": _text,
        "space": _text,
        "kind": _text,
        "class_name": _text,
        "location": _is(Location),
        "conditions": _conditions,
        "rules": _rules,
        "given": lambda value: value == {},
        "why": lambda value: value is None or _is_unknown(("", *value)),
        "main": lambda value: value is None,
        "options": lambda value: isinstance(value, dict) and all(map(_flag, value.values())),
    },
    MadeEntity: {
        "kind": lambda value: value in KINDS or value in PACES,
        "name": _text,
        "type": _optional(_text),
        "location": _is(Location),
        "conditions": _conditions,
        "queue_size": _optional(_is(int)),
        "latched": _optional(_flag),
        "value": _plain,
        "implicit": _flag,
        "qos": _optional(_is(Qos)),
        "effective": lambda value: value.__class__ is AsGiven or _plain(value),
        "read_only": _optional(_flag),
        "range": _optional(_every(_optional(_is(int, float)))),
        "is_dynamic": _flag,
        "is_strict": _flag,
        "node": _optional(_is(RosNode)),
        "is_exact": _flag,
        "dead": _is(int),
        "is_behind": _flag,
        "unknowns": _every(_is_unknown),
        "written": _optional(_text),
    },
    Opaque: {"reason": _text, "location": _place, "type": lambda value: value is None},
    Perhaps: {"reason": _text, "location": _place, "type": lambda value: value is None},
    SetByNode: {
        "reason": _text,
        "location": _place,
        "type": lambda value: value is None,
        "held": _is(Known, Opaque),
        "is_default_first": _flag,
    },
    Known: {"value": _plain},
    Unseen: {"shape": _text},
    AsGiven: {"key": _text},
    Answer: {
        "of": _text,
        "is_text": _flag,
        "question": lambda value: value in QUESTIONS,
        "operand": _optional(_is(*PLAIN)),
        "answer": _is(*PLAIN),
        "place": _optional(_is(int)),
    },
}
_NAMES = {kind.__name__: (kind, tuple(checks.values())) for kind, checks in CLASSES.items()}
#: Where a MadeEntity has its node.
_NODE = list(CLASSES[MadeEntity]).index("node") + 1
#: The classes of what JSON has as it is.
_SIMPLE = frozenset((type(None), bool, int, float, str))


def to_json(value: Any, depth: int = 0) -> Any:
    """*value* as JSON; Unfit where it holds what is not kept."""
    kind = value.__class__
    if value is None or kind in (bool, int, float, str):
        return value
    if depth > DEEPEST:
        raise Unfit
    if kind is tuple or kind is list:
        return ["t" if kind is tuple else "l", *(to_json(item, depth + 1) for item in value)]
    if kind is dict:
        if not all(isinstance(key, str) for key in value):
            raise Unfit
        return ["d", *([key, to_json(item, depth + 1)] for key, item in value.items())]
    if kind in CLASSES:
        held = [getattr(value, name) for name in CLASSES[kind]]
        if kind is RosNode:
            held[list(CLASSES[kind]).index("given")] = {}
        if kind in (Opaque, Perhaps, SetByNode) and value.type is not None:
            raise Unfit
        return [kind.__name__, *(to_json(item, depth + 1) for item in held)]
    raise Unfit


def from_json(data: Any, depth: int = 0) -> Any:
    """What ``to_json`` has written; Unfit for anything else."""
    if data.__class__ in _SIMPLE:
        return data
    if data.__class__ is not list or not data or depth > DEEPEST:
        raise Unfit
    head = data[0]
    if head.__class__ is not str:
        raise Unfit
    if head == "d":
        rest = data[1:]
        if not all(item.__class__ is list and len(item) == 2 and isinstance(item[0], str) for item in rest):
            raise Unfit
        return {key: from_json(item, depth + 1) for key, item in rest}
    held: list[Any] = [item if item.__class__ in _SIMPLE else from_json(item, depth + 1) for item in data[1:]]
    if head == "t":
        return tuple(held)
    if head == "l":
        return held
    kind, checks = _NAMES.get(head, (None, ()))
    if kind is None or len(held) != len(checks):
        raise Unfit
    for check, item in zip(checks, held, strict=True):
        if not check(item):
            raise Unfit
    return kind(**dict(zip(CLASSES[kind], held, strict=True))) if kind is Qos else kind(*held)  # Qos has names alone


def entity_from_json(data: Any, node: RosNode | None) -> MadeEntity:
    """The MadeEntity that ``to_json`` has written without a node, of *node*; Unfit for anything else."""
    kind, checks = _NAMES[MadeEntity.__name__]
    if (
        data.__class__ is not list
        or len(data) != len(checks) + 1
        or data[0] != kind.__name__
        or data[_NODE] is not None
    ):
        raise Unfit
    held: list[Any] = [item if item.__class__ in _SIMPLE else from_json(item, 1) for item in data[1:]]
    held[_NODE - 1] = node
    for check, item in zip(checks, held, strict=True):
        if not check(item):
            raise Unfit
    return MadeEntity(*held)


def moved(data: Any, lines: Mapping[str, Mapping[int, int]], depth: int = 0) -> Any:
    """*data*, as ``to_json`` has written it, with the new *lines* of places in edited files; Lost where one is not known."""
    if data.__class__ is not list:
        return data
    if depth > 2 * DEEPEST:
        raise Unfit
    if len(data) == len(CLASSES[Location]) + 1 and data[0] == Location.__name__:
        known = lines.get(data[1]) if isinstance(data[1], str) else None
        if known is None:
            return data
        name, path, line, column, end_line, end_column = data
        return [name, path, _now(line, known), column, _now(end_line, known), end_column]
    return [moved(item, lines, depth + 1) if item.__class__ is list else item for item in data]


def _now(line: Any, known: Mapping[int, int]) -> int | None:
    if line is None:
        return None
    if line.__class__ is not int or line not in known:
        raise PlaceLost
    return known[line]


assert all(list(CLASSES[kind]) == [field.name for field in fields(kind)] for kind in CLASSES)
