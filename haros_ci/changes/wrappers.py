# SPDX-License-Identifier: Apache-2.0
"""Functions of the workspace that declare a parameter, or make an end, under a name that they are given.

``void Handler::getParam(T & to, const std::string & name, T value) { node_->declare_parameter(name, value); }`` is one: a call of it with
a literal says as much as the call inside. The name has to be the argument, or to end with it: what a plug-in declares below its own name is no
such thing.
"""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.changes.calls import EndpointCall, Rows, argument_of, made_by
from haros_ci.syntax import Expression, Function, Program
from haros_ci.syntax.walk import preorder

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
        self._known: dict[str, EndpointCall | None] = {}

    def named(self, name: str, depth: int = 0) -> EndpointCall | None:
        """What a call of a function *name* makes, and of which of its arguments; None if it is no wrapper, or several differ."""
        if name not in self._known:
            self._known[name] = None  # a function that calls itself is no wrapper
            functions = self._functions.get(name, [])
            if functions and len(functions) <= MAX_ALIKE and depth < MAX_DEPTH:
                found = {made for function in functions if (made := self._made(*function, depth)) is not None}
                self._known[name] = found.pop() if len(found) == 1 else None
        return self._known[name]

    def _made(self, function: Function, rows: Rows, depth: int) -> EndpointCall | None:
        names = [parameter.name.lstrip("*") for parameter in function.parameters]
        for call in preorder(function.body):
            if not isinstance(call, syntax.Call):
                continue
            made = made_by(call, rows)
            if made is None:
                inner = syntax.name_of(call.callee)
                made = self.named(inner.rpartition("::")[2], depth + 1) if inner else None
            if made is None:
                continue
            at = _position(argument_of(made.name, call.arguments), names)
            if at is not None:
                value = argument_of(made.value, call.arguments) if made.value is not None else None
                return EndpointCall(made.what, at, _position(value, names))
        return None


def _position(value: Expression | None, names: list[str]) -> int | None:
    """Which parameter *value* is, or ends with."""
    while value is not None:
        if isinstance(value, syntax.Name):
            return names.index(value.name) if value.name in names else None
        if isinstance(value, (syntax.Operation, syntax.Format)):
            parts = value.parts if isinstance(value, syntax.Format) else value.operands if value.operator == "+" else ()
            value = parts[-1] if parts else None
        elif isinstance(value, syntax.Call):
            value = value.arguments[-1] if value.arguments else None
        elif isinstance(value, (syntax.Cast, syntax.Keyword)):
            value = value.value
        else:
            return None
    return None
