# SPDX-License-Identifier: Apache-2.0
"""Functions that make nothing and only compute with numbers: they are not followed, what they change is forgotten."""

from __future__ import annotations

from typing import Any

from haros_ci.link import call_arguments
from haros_ci.link.run import Frame, Run
from haros_ci.link.values import (
    NONE,
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
)
from haros_ci.model.program import Function, Type


def is_inert(
    run: Run, function: Callable, definition: Function, returns: Type, args: tuple[call_arguments.Argument, ...]
) -> bool:
    """Whether a function need not be followed: it makes nothing, and gives and changes numbers only."""
    changed = run.relevance.changes(definition, function.source)
    if changed is None or (returns[0] and not call_arguments.is_scalar(returns) and returns[0] != "bool"):
        return False
    if not returns[0] and function.source.program.language == "python" and _returns_value(definition.body):
        return False
    for argument in args:
        value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
        if isinstance(value, (Sequence, Mapped, Callable, ClassValue, Choice)) or (
            isinstance(value, Known) and isinstance(value.value, (str, list, dict)) and argument.cell is not None
        ):
            return False
        if isinstance(value, Object) and not _only_numbers(value, changed):
            return False
    return function.this is None or _only_numbers(function.this, changed)


def _only_numbers(this: Object, changed: frozenset[str]) -> bool:
    for name in changed:
        cell = this.fields.get(name)
        if cell is None:
            continue
        if isinstance(cell.value, Known) and isinstance(cell.value.value, (int, float)):
            continue
        if isinstance(cell.value, Opaque) and (
            cell.type is None or call_arguments.is_scalar(cell.type) or cell.value.type is None
        ):
            continue
        if isinstance(cell.value, Object) and cell.value.definition is None and cell.value.namespace is None:
            continue
        return False
    return True


def _returns_value(block: Any) -> bool:
    waiting = [block]
    while waiting:
        node = waiting.pop()
        if isinstance(node, (tuple, list)) and node:
            if node[0] == "return" and len(node) == 2 and node[1] is not None:
                return True
            waiting.extend(node)
    return False


def skipped(
    run: Run,
    inner: Frame,
    function: Callable,
    definition: Function,
    returns: Type,
    args: tuple[call_arguments.Argument, ...],
) -> Value:
    """What is known after a function that was not followed: the numbers that it may change are not."""
    changed = run.relevance.changes(definition, function.source) or frozenset[str]()
    reason = f"{definition.name} may change it"
    objects = [a.value.cell.value if isinstance(a.value, Pointer) else a.value for a in args] + [function.this]
    for this in objects:
        if isinstance(this, Object):
            for name in changed & this.fields.keys():
                _forget(run, this.fields[name], run.opaque(reason, inner, definition.line, this.fields[name].type))
    for parameter, argument in zip(definition.parameters, args, strict=False):
        marks = parameter.type[2]
        if parameter.name in changed and "c" not in marks and ("&" in marks or "*" in marks):
            target = argument.value.cell if isinstance(argument.value, Pointer) else argument.cell
            if target is not None:
                _forget(run, target, run.opaque(reason, inner, definition.line, target.type))
    if returns[0] == "void":
        return NONE
    return run.opaque(
        f"what {definition.name} returns is computed", inner, definition.line, returns if returns[0] else None
    )


def _forget(run: Run, cell: Cell, unknown: Opaque) -> None:
    value = cell.value
    if isinstance(value, (Sequence, Mapped)):
        run.state.write(value.content, unknown)
    elif isinstance(value, (Known, Choice)) or type(value).__name__ == "Text":
        run.state.write(cell, unknown)
