# SPDX-License-Identifier: Apache-2.0
"""Programs as JSON values, for the cache."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from operator import attrgetter
from typing import Any

from haros_ci.model.program import Alias, Class, Field, Function, Parameter, Program

_PARTS = ("functions", "classes", "variables", "aliases", "scopes", "includes", "macros", "registered", "problems")

_parameter = attrgetter(*(each.name for each in fields(Parameter)))
_field = attrgetter(*(each.name for each in fields(Field)))
_alias = attrgetter(*(each.name for each in fields(Alias)))
_function = attrgetter(*(each.name for each in fields(Function)))
_class = attrgetter(*(each.name for each in fields(Class)))


class _Shape(Exception):
    """The value is not a Program's."""


def to_json(program: Program) -> Any:
    """*program* as nested tuples of JSON scalars, in the order of its fields: ``json.dumps`` takes it as it is."""
    functions = []
    for function in program.functions:
        values = list(_function(function))
        values[3] = [_parameter(each) for each in function.parameters]
        functions.append(values)
    classes = []
    for each_class in program.classes:
        values = list(_class(each_class))
        values[2] = [_field(each) for each in each_class.fields]
        classes.append(values)
    return [
        program.language,
        functions,
        classes,
        [_field(each) for each in program.variables],
        [_alias(each) for each in program.aliases],
        *(getattr(program, name) for name in _PARTS[4:]),
    ]


def from_json(value: Any) -> Program | None:
    """The Program that *value* is the JSON of; None where its shape is another's.

    Types, names, positions and the presence of bodies are checked; statements and expressions stay lists as they are.
    """
    try:
        language, functions, classes, variables, aliases, *rest = _list(value, len(_PARTS) + 1)
        scopes, includes, macros, registered, problems = rest
        return Program(
            _text(language),
            _each(functions, _as_function),
            _each(classes, _as_class),
            _each(variables, _as_field),
            _each(aliases, _as_alias),
            _each(scopes, lambda each: tuple(map(_text, _list(each, 2)))),
            _each(includes, _text),
            _each(macros, _as_macro),
            _each(registered, _as_registered),
            _each(problems, _as_problem),
        )
    except (_Shape, RecursionError):
        return None


def _list(value: Any, length: int | None = None) -> Any:
    if not isinstance(value, list | tuple) or (length is not None and len(value) != length):
        raise _Shape
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise _Shape
    return value


def _number(value: Any) -> int:
    if type(value) is not int:
        raise _Shape
    return value


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise _Shape
    return value


def _type(value: Any) -> Any:
    name, arguments, marks = _list(value, 3)
    if not (isinstance(name, str) and isinstance(arguments, list | tuple) and isinstance(marks, str)):
        raise _Shape
    return value


def _node(value: Any) -> Any:
    """A statement or expression: a list with its kind first."""
    if not isinstance(value, list | tuple) or not value or not isinstance(value[0], str):
        raise _Shape
    return value


def _optional(value: Any, check: Callable[[Any], Any]) -> Any:
    return None if value is None else check(value)


def _each(value: Any, check: Callable[[Any], Any]) -> tuple[Any, ...]:
    return tuple([check(each) for each in _list(value)])


def _nodes(value: Any) -> Any:
    for each in _list(value):
        _node(each)
    return value


def _as_parameter(value: Any) -> Parameter:
    name, type_, default = _list(value, 3)
    return Parameter(_text(name), _type(type_), _optional(default, _node))


def _as_field(value: Any) -> Field:
    name, type_, init, line, column, is_static = _list(value, 6)
    if init is not None:
        _list(_node(init), 2)
    return Field(_text(name), _type(type_), init, _number(line), _number(column), _flag(is_static))


def _as_class(value: Any) -> Class:
    name, bases, members, line, column, templates = _list(value, 6)
    return Class(
        _text(name),
        _each(bases, _type),
        _each(members, _as_field),
        _number(line),
        _number(column),
        _each(templates, _text),
    )


def _as_alias(value: Any) -> Alias:
    name, type_, templates = _list(value, 3)
    return Alias(_text(name), _type(type_), _each(templates, _text))


def _as_init(value: Any) -> Any:
    name, type_, arguments, line, column = _list(value, 5)
    return (_text(name), _type(type_), _nodes(arguments), _number(line), _number(column))


def _as_guard(value: Any) -> tuple[int, int, str]:
    line, column, text = _list(value, 3)
    return _number(line), _number(column), _text(text)


def _as_function(value: Any) -> Function:
    (name, owner, kind, parameters, returns, line, column, body, body_line, body_column) = _list(value, 16)[:10]
    templates, inits, guards, is_static, is_virtual, decorators = value[10:16]
    return Function(
        _text(name),
        _text(owner),
        _text(kind),
        _each(parameters, _as_parameter),
        _type(returns),
        _number(line),
        _number(column),
        _optional(body, _nodes),
        _number(body_line),
        _number(body_column),
        _each(templates, _text),
        _each(inits, _as_init),
        _each(guards, _as_guard),
        _flag(is_static),
        _flag(is_virtual),
        _each(decorators, _node),
    )


def _as_macro(value: Any) -> tuple[str, tuple[str, ...] | None, str]:
    name, parameters, body = _list(value, 3)
    return _text(name), None if parameters is None else _each(parameters, _text), _text(body)


def _as_registered(value: Any) -> tuple[str, tuple[str, ...], int, int]:
    macro, arguments, line, column = _list(value, 4)
    return _text(macro), _each(arguments, _text), _number(line), _number(column)


def _as_problem(value: Any) -> tuple[int, str]:
    line, message = _list(value, 2)
    return _number(line), _text(message)
