# SPDX-License-Identifier: Apache-2.0
"""Calls of ROS libraries in one file, read without the rest of the program: code that no node is known to run.

A plug-in that is loaded by the name that some parameter has, a library for others, a class template: the architecture has nothing of
them, and still a change of theirs is one of the interface. Names have ``?`` for what only a run knows: ``?.max_speed``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import TypeAlias, TypeGuard

from haros_ci import syntax
from haros_ci.changes.change import shown
from haros_ci.changes.endpoints import WORDS
from haros_ci.changes.names import UNKNOWN
from haros_ci.model.api import Row, Template
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Expression, Program
from haros_ci.syntax.walk import preorder

#: Rows by the last part of the call's name.
Arguments: TypeAlias = tuple[Expression, ...]
Rows = Mapping[str, tuple[Row, ...]]
_INDEX = regex(r"\d+$")
_OF_TYPE = regex(r"type(?:name|of)\((.*)\)$")
#: Conversions that leave a text or number as it is.
_CONVERSIONS = frozenset(("string", "str", "String", "ParameterValue", "float", "double", "to_string", "move", "Value"))
#: Code for tests takes no part in a system.
_TEST = regex(r"(^|/)tests?/|(^|/)(test_[^/]*|[^/]*_tests?)\.\w+$")
MAX_DEPTH = 200


@dataclass(frozen=True, slots=True)
class ChangedCall:
    """What a call in a file makes: *what* as changes call it, *name* with ``?`` in it, *type* or *default* None if not known.

    *has_default* is False where none is given.
    """

    what: str
    name: str
    type: str | None
    default: str | None
    has_default: bool
    location: Location


@dataclass(frozen=True, slots=True)
class EndpointCall:
    """What a call makes: the arguments, by number or keyword, that are its name and its default, and its type."""

    what: str
    name: int | str
    value: int | str | None = None
    type: str | None = None


def by_name(rows: Iterable[Row], kinds: frozenset[str]) -> Rows:
    """The rows that make ends of *kinds*, by the last part of the call's name."""
    found: dict[str, list[Row]] = {}
    for row in rows:
        if not row.is_class and any(entry.kind in kinds and not entry.implicit for entry in row.makes):
            found.setdefault(_last(row.call), []).append(row)
    return {name: tuple(item) for name, item in found.items()}


def is_test(path: str) -> bool:
    """Whether the file, by its path, is code for tests."""
    return _TEST.search(path) is not None


def calls_in(
    path: str, program: Program, rows: Rows, wrapper: Callable[[str], EndpointCall | None]
) -> tuple[ChangedCall, ...]:
    """What the calls of *program* make, in their order; the name is ``?`` where nothing tells it.

    *wrapper* says of a function of the workspace what it makes under a name that it is given.
    """
    found: dict[tuple[int, int, str], ChangedCall] = {}
    for function in program.functions:
        for part in (function.body, function.inits):
            for call in preorder(part):
                if not isinstance(call, syntax.Call):
                    continue
                made = made_by(call, rows)
                if made is None and any(isinstance(arg, syntax.String) for arg in call.arguments):
                    made = wrapper(_last(syntax.name_of(call.callee)))
                if made is not None:
                    at = Location(path, call.line, call.column)
                    found.setdefault((call.line, call.column, made.what), _call(made, call.arguments, at))
    return tuple(found[key] for key in sorted(found))


def made_by(call: syntax.Call, rows: Rows) -> EndpointCall | None:
    """What a call of a ROS library makes, if changes of it are reported; None for all other calls."""
    callee, args, types = call.callee, call.arguments, call.templates
    name = syntax.name_of(callee)
    fitting = [row for row in rows.get(_last(name), ()) if not row.args or len(args) in row.args] if name else []
    ranked = sorted((-_rank(row, callee, name), bool(row.when), number) for number, row in enumerate(fitting))
    if not ranked or not ranked[0][0]:
        return None
    for entry in fitting[ranked[0][2]].makes:
        if entry.kind in WORDS and not entry.implicit and entry.each is None:
            at = _selected(entry.values.get("name"), args)
            if at is not None:
                is_parameter = entry.kind in ("parameters", "getters")
                value = _selected(entry.values.get("value"), args) if is_parameter else None
                kind = None if is_parameter else _type(_selected(entry.values.get("type"), args), args, types)
                return EndpointCall(WORDS[entry.kind], at, value, kind)
    return None


def _rank(row: Row, callee: Expression, name: str) -> int:
    """How well the call fits the row by who is called: methods are of classes, which begin with a capital."""
    owner = _last(re.sub(r"(::|\.)[^:.]+$", "", row.call))
    if isinstance(callee, syntax.Member):
        receiver = _last(syntax.name_of(callee.object))
        return 3 if receiver == owner else 2 if owner[:1].isupper() else 0
    above = _last(re.sub(r"(::|\.)?[^:.]+$", "", name))
    return 3 if above == owner else 2 if not above and owner[:1].isupper() else 0 if above else 1


def _call(made: EndpointCall, args: Arguments, at: Location) -> ChangedCall:
    argument = argument_of(made.name, args)
    name = UNKNOWN if argument is None else _text(argument)
    value = argument_of(made.value, args)
    return ChangedCall(
        what=made.what,
        name=name,
        type=made.type,
        default=None if value is None else _value(value),
        has_default=value is not None,
        location=at,
    )


def _type(position: int | str | None, args: Arguments, types: tuple[syntax.Argument, ...]) -> str | None:
    """The type as written: the template argument, else the argument that names a class."""
    if types and isinstance(types[0], syntax.Type):
        return types[0].name.replace("::", "/")
    argument = argument_of(position, args)
    return _last(syntax.name_of(argument)) or None if argument is not None else None


def _selected(template: Template | None, args: Arguments) -> int | str | None:
    """The argument that a template selects: its number, or a Python keyword."""
    if template is None or len(template.parts) != 1 or isinstance(template.parts[0], str):
        return None
    for alternative in (part for text in template.parts[0][0] for part in _OF_TYPE.sub(r"\1", text).split("|")):
        position = int(alternative) if _INDEX.match(alternative) else alternative
        if argument_of(position, args) is not None:
            return position
    return None


def argument_of(position: int | str | None, args: Arguments) -> Expression | None:
    """The argument at a number, or of a keyword; None if it is not given."""
    if isinstance(position, int):
        plain = [arg for arg in args if not isinstance(arg, (syntax.Keyword, syntax.Star, syntax.DoubleStar))]
        return plain[position] if position < len(plain) else None
    return next((arg.value for arg in args if isinstance(arg, syntax.Keyword) and arg.name == position), None)


def _last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2]


def _text(value: Expression, depth: int = 0) -> str:
    """The text that an expression has, ``?`` for unknown parts."""
    if depth < MAX_DEPTH:
        if isinstance(value, syntax.String):
            return value.value
        if isinstance(value, syntax.Operation) and value.operator == "+":
            return _joined(_text(part, depth + 1) for part in value.operands)
        if isinstance(value, syntax.Format):
            return _joined(_text(part, depth + 1) for part in value.parts)
        if isinstance(value, syntax.Cast):
            return _text(value.value, depth + 1)
        if _is_conversion(value):
            return _text(value.arguments[0], depth + 1)
    return UNKNOWN


def _joined(parts: Iterable[str]) -> str:
    return re.sub(r"\?+", "?", "".join(parts))


def _is_conversion(value: Expression) -> TypeGuard[syntax.Call]:
    """Whether *value* is the conversion of one argument."""
    if not isinstance(value, syntax.Call) or len(value.arguments) != 1:
        return False
    return _last(syntax.name_of(value.callee)) in _CONVERSIONS


def _value(value: Expression, depth: int = 0) -> str | None:
    """A literal as text; None for all else."""
    if depth > MAX_DEPTH:
        return None
    if isinstance(value, (syntax.String, syntax.Boolean, syntax.Number)):
        return shown(value.value)
    if isinstance(value, syntax.Operation) and value.operator == "-" and len(value.operands) == 1:
        inner = value.operands[0]
        return shown(-inner.value) if isinstance(inner, syntax.Number) else None
    if isinstance(value, syntax.Cast):
        return _value(value.value, depth + 1)
    if _is_conversion(value):
        return _value(value.arguments[0], depth + 1)
    if isinstance(value, syntax.ListLiteral):
        items = [_value(item, depth + 1) for item in value.items]
        return None if None in items else f"[{', '.join(map(str, items))}]"
    return None
