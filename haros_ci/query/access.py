# SPDX-License-Identifier: Apache-2.0
"""Attributes, methods, calls and indexes: the only ways from one value to another, each by a list of what is allowed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from haros_ci.query.fault import QueryError, suggestion
from haros_ci.query.functions import METHODS, Builtin
from haros_ci.query.machine import Machine, Scope
from haros_ci.query.values import QueryEntity, QueryList, QueryPair, QueryRecord, UnknownText, Value, kind_of, weight_of


class Own:
    """A function that a query defines: its *body* sees the variables of where it is defined."""

    __slots__ = ("body", "parameters", "scope")

    def __init__(self, parameters: tuple[str, ...], body: Callable[[Scope], Value], scope: Scope) -> None:
        self.parameters = parameters
        self.body = body
        self.scope = scope


def attribute(value: Value, name: str, at: int) -> Value:
    """``value.name``; None has only attributes that are None, as what is not known."""
    if isinstance(value, QueryEntity):
        getter = value.ATTRIBUTES.get(name)
        if getter is not None:
            return getter(value)
    elif value is None:
        return None
    elif value.__class__ is QueryPair and name in ("key", "value"):
        return value.key if name == "key" else value.value
    if name in methods(value):
        raise QueryError(f"{name} of a {kind_of(value)} is a method", at, f"call it: {name}()")
    known = attributes(value)
    raise QueryError(f"a {kind_of(value)} has no attribute {name!r}", at, suggestion(name, known))


def attributes(value: Value) -> tuple[str, ...]:
    """The names of the attributes and methods that *value* has."""
    if isinstance(value, QueryEntity):
        return (*value.ATTRIBUTES, *value.METHODS)
    return ("key", "value") if value.__class__ is QueryPair else tuple(methods(value))


def methods(value: Value) -> Mapping[str, tuple[int, int, Callable[..., Value]]]:
    if isinstance(value, QueryEntity):
        return value.METHODS
    return METHODS.get(str if value.__class__ is UnknownText else value.__class__, {})


def call_method(machine: Machine, value: Value, name: str, arguments: Sequence[Value], at: int) -> Value:
    """``value.name(arguments)``; a method of None gives None."""
    if value is None:
        return None
    found = methods(value).get(name)
    if found is None:
        return call(machine, attribute(value, name, at), arguments)
    least, most, function = found
    if not least <= len(arguments) <= most:
        expected = str(least) if least == most else f"{least} to {most}"
        raise QueryError(f"{name} takes {expected} arguments, not {len(arguments)}")
    machine.tick(1 + weight_of(value) + sum(map(weight_of, arguments)))
    return function(value, *arguments)


def call(machine: Machine, function: Value, arguments: Sequence[Value]) -> Value:
    """``function(arguments)``, one of the language or one of the query's own."""
    if function.__class__ is Builtin:
        machine.tick(1 + sum(map(weight_of, arguments)))
        return function.apply(arguments)
    if function.__class__ is not Own:
        raise QueryError(f"a {kind_of(function)} cannot be called")
    if len(arguments) != len(function.parameters):
        raise QueryError(f"the function takes {len(function.parameters)} arguments, not {len(arguments)}")
    machine.enter()
    try:
        return function.body({**function.scope, **dict(zip(function.parameters, arguments, strict=True))})
    finally:
        machine.leave()


def indexed(value: Value, key: Value) -> Value:
    """``value[key]``."""
    if value is None:
        return None
    if value.__class__ is QueryRecord:
        if key not in value:
            raise QueryError(f"the map has no key {str(key)[:40]!r}")
        return value[key]
    row = value.items if isinstance(value, QueryEntity) else value
    if not (row.__class__ is QueryList or isinstance(row, str)):
        raise QueryError(f"a {kind_of(value)} has no elements")
    if not isinstance(key, int):
        raise QueryError(f"elements are counted by whole numbers, not by a {kind_of(key)}")
    if not -len(row) <= key < len(row):
        raise QueryError(f"there is no element {key} among {len(row)}")
    return row[key]
