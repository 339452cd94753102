# SPDX-License-Identifier: Apache-2.0
"""Functions of the workspace that declare a parameter, or make an end, under a name that they are given.

``void Handler::getParam(T & to, const std::string & name, T value) { node_->declare_parameter(name, value); }`` is one: a call of it with
a literal says as much as the call inside. The name has to be the argument, or to end with it: what a plug-in declares below its own name is no
such thing.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from haros_ci.changes.calls import Made, Rows, argument_of, calls_below, made_by
from haros_ci.model.program import Function, Program

#: Wrappers in wrappers are followed so far.
MAX_DEPTH = 3
#: More functions of one name say nothing.
MAX_ALIKE = 8


class Wrappers:
    """The wrappers of a workspace, found when their names are asked for."""

    def __init__(self, programs: Iterable[tuple[Program, Rows]]) -> None:
        self._functions: dict[str, list[tuple[Function, Rows]]] = {}
        for program, own in programs:
            for function in program.functions:
                if function.body and function.parameters and function.name:
                    last = function.name.rpartition("::")[2].rpartition(".")[2]
                    self._functions.setdefault(last, []).append((function, own))
        self._known: dict[str, Made | None] = {}

    def named(self, name: str, depth: int = 0) -> Made | None:
        """What a call of a function *name* makes, and of which of its arguments; None if it is no wrapper, or several differ."""
        if name not in self._known:
            self._known[name] = None  # a function that calls itself is none
            functions = self._functions.get(name, [])
            if functions and len(functions) <= MAX_ALIKE and depth < MAX_DEPTH:
                found = {made for each in functions if (made := self._made(*each, depth)) is not None}
                self._known[name] = found.pop() if len(found) == 1 else None
        return self._known[name]

    def _made(self, function: Function, rows: Rows, depth: int) -> Made | None:
        names = [parameter.name.lstrip("*") for parameter in function.parameters]
        for callee, args, types, _, _ in calls_below(function.body):
            made = made_by(callee, args, types, rows)
            if made is None:
                inner = (
                    callee[2]
                    if callee and callee[0] == "field"
                    else callee[1]
                    if callee and callee[0] == "name"
                    else ""
                )
                made = self.named(str(inner).rpartition("::")[2], depth + 1) if inner else None
            if made is None:
                continue
            at = _position(argument_of(made.name, args), names)
            if at is not None:
                value = argument_of(made.value, args) if made.value is not None else None
                return Made(made.what, at, _position(value, names))
        return None


def _position(value: Any, names: list[str]) -> int | None:
    """Which parameter *value* is, or ends with."""
    while isinstance(value, (tuple, list)) and value:
        if value[0] == "name":
            return names.index(value[1]) if value[1] in names else None
        if value[0] in ("op", "format"):
            parts = value[2] if value[0] == "op" and value[1] == "+" else value[1] if value[0] == "format" else ()
            value = parts[-1] if parts else None
        elif value[0] == "call":
            value = value[2][-1] if value[2] else None
        elif value[0] in ("cast", "kw"):
            value = value[2]
        else:
            return None
    return None
