# SPDX-License-Identifier: Apache-2.0
"""Which transforms a file's functions broadcast: ``sendTransform`` of a message whose frames are set beside it.

Only what is sent whatever happens counts: a call under an ``if``, or of a function that is called under one about publishing, is left
out, as is a frame that is set to several things.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci import syntax
from haros_ci.code.body import last_part
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Block, Expression, Function, Program, Statement
from haros_ci.syntax.walk import everything

_SWITCH = regex(r"publish|broadcast|tf|transform|enable|use_|static", re.IGNORECASE)
_READS = ("get_parameter", "get_parameter_or", "declare_parameter", "param", "getParam", "get_param", "getParamCached")
_UNWRAPS = ("as_string", "get", "get_value", "get_parameter_value", "string_value", "value", "c_str")


@dataclass(frozen=True, slots=True)
class BroadcastFrame:
    """A frame by its *text*, or by the *parameter* that says it."""

    text: str = ""
    parameter: str = ""


@dataclass(frozen=True, slots=True)
class Sent:
    """A transform that the function *owner* (a class) or a free one sends; None for a frame that is not known."""

    owner: str
    child: BroadcastFrame | None
    parent: BroadcastFrame | None
    receiver: str
    line: int
    column: int


@dataclass(slots=True)
class _Facts:
    #: What is assigned to a variable or field, by its path as text, with the function where it is a local one.
    assigned: dict[tuple[str, str], list[Expression]] = field(default_factory=dict)
    #: The texts of conditions around calls of a function, by its last name.
    guards: dict[str, list[str]] = field(default_factory=dict)
    sends: list[tuple[Function, syntax.Call, tuple[str, ...]]] = field(default_factory=list)
    locals: dict[str, set[str]] = field(default_factory=dict)


def sent(program: Program) -> tuple[Sent, ...]:
    """The transforms that the functions of one file send."""
    facts = _Facts()
    for index, function in enumerate(program.functions):
        if function.body is not None:
            key = f"{index}"
            names = {parameter.name for parameter in function.parameters}
            facts.locals[key] = names
            for statement, around in _statements(function.body, ()):
                _note(facts, function, key, statement, around)
    found = []
    for function, call, around in facts.sends:
        name = function.name.replace("::", ".").rpartition(".")[2]
        if any(item for item in around) or any(_SWITCH.search(text) for text in facts.guards.get(name, ())):
            continue
        key = str(program.functions.index(function))
        child, parent = _frames(facts, program, key, call.arguments)
        receiver = _path(call.callee.object) if isinstance(call.callee, syntax.Member) else ""
        found.append(Sent(function.owner, child, parent, receiver, call.line, call.column))
    return tuple(found)


def _statements(block: Block, around: tuple[str, ...]) -> Iterator[tuple[Statement, tuple[str, ...]]]:
    """All statements, with the conditions around each; what follows a conditional return about publishing is under it."""
    for statement in block:
        yield statement, around
        if isinstance(statement, syntax.If):
            text = str(statement.text)
            yield from _statements(statement.then, (*around, text))
            yield from _statements(statement.other, (*around, text))
            if _SWITCH.search(text) and any(
                isinstance(other_statement, syntax.Return) for other_statement in statement.then
            ):
                around = (*around, text)
        elif isinstance(statement, syntax.Loop):
            yield from _statements(statement.before, around)
            yield from _statements(statement.body, around)
        elif isinstance(statement, syntax.Each):
            yield from _statements(statement.body, (*around, "each"))
        elif isinstance(statement, syntax.Switch):
            for case in statement.cases:
                yield from _statements(case.body, (*around, statement.text))
        elif isinstance(statement, syntax.Try):
            yield from _statements(statement.body, around)
            for handler in statement.handlers:
                yield from _statements(handler.body, (*around, "catch"))
        elif isinstance(statement, syntax.Preprocessor):
            for branch in statement.branches:
                yield from _statements(branch.body, (*around, branch.text))
        elif isinstance(statement, syntax.Nested):
            yield from _statements(statement.body, around)
        elif isinstance(statement, syntax.Static):
            yield from _statements((statement.statement,), around)


def _note(facts: _Facts, function: Function, key: str, statement: Statement, around: tuple[str, ...]) -> None:
    if isinstance(statement, syntax.Variable):
        facts.locals[key].add(statement.name)
        init = statement.init
        if init is not None:
            value = (
                init.value
                if isinstance(init, syntax.Equals)
                else syntax.Call(syntax.TypeName(statement.type), init.arguments, (), 0, 0)
            )
            facts.assigned.setdefault((key, statement.name), []).append(value)
    for expression in _expressions(statement):
        for record in everything(expression):
            if isinstance(record, syntax.Assignment) and record.operator == "=":
                _assign(facts, function, key, record.target, record.value)
            elif isinstance(record, syntax.Call):
                _called(facts, function, key, record, around)


def _assign(facts: _Facts, function: Function, key: str, target: Expression, value: Expression) -> None:
    path = _path(target)
    if path:
        if function.kind == "module" or path.partition(".")[0] not in facts.locals[key]:
            is_python_local = isinstance(target, syntax.Name) and function.kind != "module" and "." not in path
            if is_python_local and not path.endswith("_"):
                facts.locals[key].add(path)
        scope = key if path.partition(".")[0] in facts.locals[key] else ""
        facts.assigned.setdefault((scope, path), []).append(value)


def _called(facts: _Facts, function: Function, key: str, call: syntax.Call, around: tuple[str, ...]) -> None:
    callee = call.callee
    name = last_part(callee)
    if name == "sendTransform" and isinstance(callee, syntax.Member):
        facts.sends.append((function, call, around))
    elif name:
        facts.guards.setdefault(name, []).extend(around)
    if name in _READS and len(call.arguments) > 1 and isinstance(call.arguments[1], (syntax.Name, syntax.Member)):
        path = _path(call.arguments[1])
        scope = key if path.partition(".")[0] in facts.locals[key] else ""
        facts.assigned.setdefault((scope, path), []).append(call)


def _frames(
    facts: _Facts, program: Program, key: str, arguments: tuple[Expression, ...]
) -> tuple[BroadcastFrame | None, BroadcastFrame | None]:
    """Child and parent of what sendTransform is *arguments*."""
    if len(arguments) == 5:  # tf of ROS 1 in Python: translation, rotation, time, child, parent
        return _frame(facts, program, key, arguments[3]), _frame(facts, program, key, arguments[4])
    if len(arguments) != 1:
        return None, None
    made = arguments[0]
    path = _path(made)
    values = facts.assigned.get((key, path)) or facts.assigned.get(("", path)) or []
    if not isinstance(made, syntax.Call) and len(values) == 1 and isinstance(values[0], syntax.Call):
        made = values[0]
    if isinstance(made, syntax.Call) and _type_name(made.callee).endswith("StampedTransform"):
        if len(made.arguments) == 4:
            return _frame(facts, program, key, made.arguments[3]), _frame(facts, program, key, made.arguments[2])
    if not path:
        return None, None
    child = _set(facts, program, key, f"{path}.child_frame_id")
    if (key, f"{path}.header") in facts.assigned or ("", f"{path}.header") in facts.assigned:
        return child, None
    return child, _set(facts, program, key, f"{path}.header.frame_id")


def _set(facts: _Facts, program: Program, key: str, path: str) -> BroadcastFrame | None:
    values = [*facts.assigned.get((key, path), ()), *facts.assigned.get(("", path), ())]
    frames = {_frame(facts, program, key, value) for value in values}
    return frames.pop() if len(frames) == 1 else None


def _frame(facts: _Facts, program: Program, key: str, value: Expression, depth: int = 0) -> BroadcastFrame | None:
    """The frame that an expression says: a literal, a constant, or what is read from a parameter."""
    if depth > 5:
        return None
    if isinstance(value, syntax.String):
        return BroadcastFrame(value.value) if value.value else None
    if isinstance(value, syntax.Call):
        return _read(facts, program, key, value, depth)
    if isinstance(value, syntax.Member) and value.name in _UNWRAPS:
        return _frame(facts, program, key, value.object, depth + 1)
    path = _path(value)
    if not path:
        return None
    values = [*facts.assigned.get((key, path), ()), *facts.assigned.get(("", path), ())]
    if not values:
        values = [init for name, init in _constants(program) if _last(name) == _last(path)]
    frames = {_frame(facts, program, key, item, depth + 1) for item in values}
    named = {frame for frame in frames if frame is not None and frame.parameter}
    if len(named) == 1 and None not in frames:
        return named.pop()
    return frames.pop() if len(frames) == 1 else None


def _read(facts: _Facts, program: Program, key: str, call: syntax.Call, depth: int) -> BroadcastFrame | None:
    callee = call.callee
    if isinstance(callee, syntax.Member) and callee.name in _UNWRAPS:
        return _frame(facts, program, key, callee.object, depth + 1)
    name = last_part(callee)
    if name in _READS and call.arguments and isinstance(call.arguments[0], syntax.String):
        return BroadcastFrame(parameter=call.arguments[0].value)
    return None


def _constants(program: Program) -> Iterator[tuple[str, Expression]]:
    """The variables and members that are assigned where they are declared, and to what."""
    for variable in (*program.variables, *(other_field for one in program.classes for other_field in one.fields)):
        if isinstance(variable.init, syntax.Equals):
            yield variable.name, variable.init.value


def _last(path: str) -> str:
    return path.replace("::", ".").rpartition(".")[2]


def _type_name(callee: Expression) -> str:
    return callee.type.name if isinstance(callee, syntax.TypeName) else syntax.name_of(callee)


def _path(value: Expression) -> str:
    """``a.b.c`` of names and fields; "" of anything else. ``this`` and ``self`` are left out."""
    parts: list[str] = []
    while isinstance(value, (syntax.Member, syntax.Dereference, syntax.Address)):
        if isinstance(value, syntax.Member):
            parts.append(value.name)
        value = value.object if isinstance(value, syntax.Member) else value.value
    if isinstance(value, syntax.Name):
        parts.append(value.name)
    elif not isinstance(value, syntax.This):
        return ""
    return ".".join(reversed(parts))


def _expressions(statement: Statement) -> Iterator[Expression]:
    """The expressions of one statement, without those of the statements inside it."""
    if isinstance(statement, (syntax.Do, syntax.Step, syntax.Return, syntax.Throw)):
        yield from (statement.value,) if statement.value is not None else ()
    elif isinstance(statement, syntax.Variable):
        yield from syntax.started(statement.init)
    elif isinstance(statement, syntax.If):
        yield statement.test
    elif isinstance(statement, syntax.Switch):
        yield statement.value
    elif isinstance(statement, syntax.Loop) and statement.test is not None:
        yield statement.test


def resolved(frame: BroadcastFrame | None, parameters: Mapping[str, str]) -> str | None:
    """The frame's name, with the *parameters* of a node; None if it is not known."""
    if frame is None:
        return None
    name = parameters.get(frame.parameter.lstrip("~/")) if frame.parameter else frame.text
    return name.lstrip("/") or None if name else None
