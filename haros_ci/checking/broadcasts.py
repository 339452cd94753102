# SPDX-License-Identifier: Apache-2.0
"""Which transforms a file's functions broadcast: ``sendTransform`` of a message whose frames are set beside it.

Only what is sent whatever happens counts: a call under an ``if``, or of a function that is called under one about publishing, is left
out, as is a frame that is set to several things.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from haros_ci.model.program import Function, Program

_SWITCH = re.compile(r"publish|broadcast|tf|transform|enable|use_|static", re.IGNORECASE)
_READS = ("get_parameter", "get_parameter_or", "declare_parameter", "param", "getParam", "get_param", "getParamCached")
_UNWRAPS = ("as_string", "get", "get_value", "get_parameter_value", "string_value", "value", "c_str")


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame by its *text*, or by the *parameter* that says it."""

    text: str = ""
    parameter: str = ""


@dataclass(frozen=True, slots=True)
class Sent:
    """A transform that the function *owner* (a class) or a free one sends; None for a frame that is not known."""

    owner: str
    child: Frame | None
    parent: Frame | None
    receiver: str
    line: int
    column: int


@dataclass(slots=True)
class _Facts:
    #: What is assigned to a variable or field, by its path as text, with the function where it is a local one.
    assigned: dict[tuple[str, str], list[Any]] = field(default_factory=dict)
    #: The texts of conditions around calls of a function, by its last name.
    guards: dict[str, list[str]] = field(default_factory=dict)
    sends: list[tuple[Function, Any, tuple[str, ...]]] = field(default_factory=list)
    locals: dict[str, set[str]] = field(default_factory=dict)


def sent(program: Program) -> tuple[Sent, ...]:
    """The transforms that the functions of one file send."""
    facts = _Facts()
    for index, function in enumerate(program.functions):
        if function.body is not None:
            key = f"{index}"
            names = {each.name for each in function.parameters}
            facts.locals[key] = names
            for statement, around in _statements(function.body, ()):
                _note(facts, function, key, statement, around)
    found = []
    for function, call, around in facts.sends:
        name = function.name.replace("::", ".").rpartition(".")[2]
        if any(each for each in around) or any(_SWITCH.search(text) for text in facts.guards.get(name, ())):
            continue
        key = str(program.functions.index(function))
        child, parent = _frames(facts, program, key, call[2])
        found.append(Sent(function.owner, child, parent, _path(call[1][1]), call[4], call[5]))
    return tuple(found)


def _statements(block: Any, around: tuple[str, ...]) -> Iterator[tuple[Any, tuple[str, ...]]]:
    """All statements, with the conditions around each; what follows a conditional return about publishing is under it."""
    for statement in block or ():
        kind = statement[0]
        yield statement, around
        if kind == "if":
            text = str(statement[3])
            yield from _statements(statement[5], (*around, text))
            yield from _statements(statement[8], (*around, text))
            if _SWITCH.search(text) and any(each[0] == "return" for each in statement[5]):
                around = (*around, text)
        elif kind == "loop":
            yield from _statements(statement[5], around)
            yield from _statements(statement[7], around)
        elif kind == "each":
            yield from _statements(statement[7], (*around, "each"))
        elif kind == "switch":
            for _, inner in statement[5]:
                yield from _statements(inner, (*around, str(statement[3])))
        elif kind == "try":
            yield from _statements(statement[1], around)
            for handler in statement[2]:
                yield from _statements(handler[5], (*around, "catch"))
        elif kind == "pre":
            for branch in statement[1]:
                yield from _statements(branch[3], (*around, str(branch[2])))
        elif kind == "block":
            yield from _statements(statement[1], around)
        elif kind == "static":
            yield from _statements((statement[1],), around)


def _note(facts: _Facts, function: Function, key: str, statement: Any, around: tuple[str, ...]) -> None:
    kind = statement[0]
    if kind == "var":
        facts.locals[key].add(statement[1])
        if statement[3] is not None:
            value = (
                statement[3][1]
                if statement[3][0] == "="
                else ("call", ("type", statement[2]), statement[3][1], (), 0, 0)
            )
            facts.assigned.setdefault((key, statement[1]), []).append(value)
    for expression in _expressions(statement):
        for each in _within(expression):
            if each[0] == "set" and each[1] == "=":
                _assign(facts, function, key, each[2], each[3])
            elif each[0] == "call":
                _called(facts, function, key, each, around)


def _assign(facts: _Facts, function: Function, key: str, target: Any, value: Any) -> None:
    path = _path(target)
    if path:
        if function.kind == "module" or path.partition(".")[0] not in facts.locals[key]:
            is_python_local = target[0] == "name" and value and function.kind != "module" and "." not in path
            if is_python_local and not path.endswith("_"):
                facts.locals[key].add(path)
        scope = key if path.partition(".")[0] in facts.locals[key] else ""
        facts.assigned.setdefault((scope, path), []).append(value)


def _called(facts: _Facts, function: Function, key: str, call: Any, around: tuple[str, ...]) -> None:
    callee = call[1]
    name = callee[2] if callee[0] == "field" else callee[1].rpartition("::")[2] if callee[0] == "name" else ""
    if name == "sendTransform" and callee[0] == "field":
        facts.sends.append((function, call, around))
    elif name:
        facts.guards.setdefault(name, []).extend(around)
    if name in _READS and len(call[2]) > 1 and call[2][1][0] in ("name", "field"):
        path = _path(call[2][1])
        scope = key if path.partition(".")[0] in facts.locals[key] else ""
        facts.assigned.setdefault((scope, path), []).append(call)


def _frames(facts: _Facts, program: Program, key: str, given: Any) -> tuple[Frame | None, Frame | None]:
    """Child and parent of what sendTransform is *given*."""
    if len(given) == 5:  # tf of ROS 1 in Python: translation, rotation, time, child, parent
        return _frame(facts, program, key, given[3]), _frame(facts, program, key, given[4])
    if len(given) != 1:
        return None, None
    made = given[0]
    path = _path(made)
    values = facts.assigned.get((key, path)) or facts.assigned.get(("", path)) or []
    if made[0] != "call" and len(values) == 1 and values[0][0] == "call":
        made = values[0]
    if made[0] == "call" and _type_name(made[1]).endswith("StampedTransform") and len(made[2]) == 4:
        return _frame(facts, program, key, made[2][3]), _frame(facts, program, key, made[2][2])
    if not path:
        return None, None
    child = _set(facts, program, key, f"{path}.child_frame_id")
    if (key, f"{path}.header") in facts.assigned or ("", f"{path}.header") in facts.assigned:
        return child, None
    return child, _set(facts, program, key, f"{path}.header.frame_id")


def _set(facts: _Facts, program: Program, key: str, path: str) -> Frame | None:
    values = [*facts.assigned.get((key, path), ()), *facts.assigned.get(("", path), ())]
    frames = {_frame(facts, program, key, value) for value in values}
    return frames.pop() if len(frames) == 1 else None


def _frame(facts: _Facts, program: Program, key: str, value: Any, depth: int = 0) -> Frame | None:
    """The frame that an expression says: a literal, a constant, or what is read from a parameter."""
    if depth > 5:
        return None
    if value[0] == "str":
        return Frame(value[1]) if value[1] else None
    if value[0] == "call":
        return _read(facts, program, key, value, depth)
    if value[0] == "field" and value[2] in _UNWRAPS:
        return _frame(facts, program, key, value[1], depth + 1)
    path = _path(value)
    if not path:
        return None
    values = [*facts.assigned.get((key, path), ()), *facts.assigned.get(("", path), ())]
    if not values:
        values = [
            each.init[1] for each in _constants(program) if _last(each.name) == _last(path) and each.init[0] == "="
        ]
    frames = {_frame(facts, program, key, each, depth + 1) for each in values}
    named = {frame for frame in frames if frame is not None and frame.parameter}
    if len(named) == 1 and None not in frames:
        return named.pop()
    return frames.pop() if len(frames) == 1 else None


def _read(facts: _Facts, program: Program, key: str, call: Any, depth: int) -> Frame | None:
    callee = call[1]
    if callee[0] == "field" and callee[2] in _UNWRAPS:
        return _frame(facts, program, key, callee[1], depth + 1)
    name = callee[2] if callee[0] == "field" else callee[1].rpartition("::")[2] if callee[0] == "name" else ""
    if name in _READS and call[2] and call[2][0][0] == "str":
        return Frame(parameter=call[2][0][1])
    return None


def _constants(program: Program) -> Iterator[Any]:
    for each in (*program.variables, *(each for one in program.classes for each in one.fields)):
        if each.init and each.init[0] == "=":
            yield each


def _last(path: str) -> str:
    return path.replace("::", ".").rpartition(".")[2]


def _type_name(callee: Any) -> str:
    if callee[0] == "type":
        return str(callee[1][0])
    return str(callee[1]) if callee[0] == "name" else str(callee[2]) if callee[0] == "field" else ""


def _path(value: Any) -> str:
    """``a.b.c`` of names and fields; "" of anything else. ``this`` and ``self`` are left out."""
    parts: list[str] = []
    while value[0] in ("field", "*", "&"):
        if value[0] == "field":
            parts.append(value[2])
        value = value[1]
    if value[0] == "name":
        parts.append(value[1])
    elif value[0] != "this":
        return ""
    return ".".join(reversed(parts))


def _expressions(statement: Any) -> Iterator[Any]:
    """The expressions of one statement, without those of the statements inside it."""
    kind = statement[0]
    if kind in ("do", "step", "return", "throw") and statement[1] is not None:
        yield statement[1]
    elif kind == "var" and statement[3] is not None:
        yield from statement[3][1] if statement[3][0] != "=" else (statement[3][1],)
    elif kind in ("if", "switch"):
        yield statement[4]
    elif kind == "loop" and statement[6] is not None:
        yield statement[6]


def _within(expression: Any) -> Iterator[Any]:
    """*expression* and all expressions in it."""
    pending = [expression]
    while pending:
        each = pending.pop()
        if not isinstance(each, (tuple, list)) or not each:
            continue
        if isinstance(each[0], str):
            yield each
        pending.extend(part for part in each if isinstance(part, (tuple, list)))


def resolved(frame: Frame | None, parameters: Mapping[str, str]) -> str | None:
    """The frame's name, with the *parameters* of a node; None if it is not known."""
    if frame is None:
        return None
    name = parameters.get(frame.parameter.lstrip("~/")) if frame.parameter else frame.text
    return name.lstrip("/") or None if name else None
