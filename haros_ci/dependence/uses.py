# SPDX-License-Identifier: Apache-2.0
"""Every mention of what holds data in a routine, with what happens to it there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from haros_ci import syntax
from haros_ci.code import kinds
from haros_ci.code.body import Call, parts
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import Step, steps
from haros_ci.dependence.targets import is_of_workspace
from haros_ci.dependence.variables import Held, chain, held
from haros_ci.index.types import SMART_POINTERS
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Expression

#: Types of numbers.
NUMBER = regex(r"(std::)?(u?int\d{0,2}(_t)?|size_t|unsigned|unsigned \w{1,8}|long|short|char|bool|float|double)")
#: Functions that write to a log, or only look whether something holds.
LOG = regex(
    r"(RCLCPP|RCUTILS|ROS|NODELET)_(DEBUG|INFO|WARN|WARNING|ERROR|FATAL|ASSERT)\w{0,40}|log(debug|info|warn|err|fatal)\w{0,20}"
    r"|debug|info|warn|warning|error|fatal|critical|print|f?printf|puts|assert|ASSERT\w{0,20}"
)


@dataclass(frozen=True, slots=True, eq=False)
class Use:
    """A mention of *what* in a *step*.

    *role* is read, whole (it is assigned to), set (a part of it is), called (a method that is not of the workspace is called on it),
    through (one of the workspace is), given (it is an argument of *call*), returned, kept (another object keeps it), or logged.
    *is_direct* says that it is mentioned itself, not a part of it.
    """

    what: Held
    role: str
    step: Step
    call: Call | None = None
    is_direct: bool = True
    #: The position among the arguments of *call*, or the keyword.
    argument: int | str = -1


def uses(code: Codebase, routine: Routine) -> tuple[Use, ...]:
    """All mentions in *routine*, in the order of the text; what happens to a local that stands for another thing happens to that."""
    key = ("uses", id(routine))
    if key not in code.kept:
        visitor = _Visitor(code, routine)
        for step in steps(code, routine):
            visitor.step(step)
        code.kept[key] = (*visitor.found, *visitor.through_aliases())
        code.kept["keep", id(routine)] = routine
    found: tuple[Use, ...] = code.kept[key]
    return found


def is_log(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether a call writes to a log."""
    return LOG.fullmatch(call.name) is not None and not is_of_workspace(code, routine, call)


def calls_by_node(code: Codebase, routine: Routine) -> dict[int, Call]:
    """The calls of a routine by the identity of their expressions."""
    key = ("calls by node", id(routine))
    if key not in code.kept:
        code.kept[key] = {id(call.whole): call for call in code.body(routine).calls}
        code.kept["keep", id(routine)] = routine
    found: dict[int, Call] = code.kept[key]
    return found


def uses_in(code: Codebase, routine: Routine, step: Step, values: tuple[Expression, ...]) -> tuple[Use, ...]:
    """The mentions in expressions that are a part of a *step*."""
    calls = calls_by_node(code, routine)
    inner = _Expressions(code, routine, step, calls, [], {})
    for value in values:
        inner.visit(value, "read")
    return tuple(inner.found)


def uses_of(code: Codebase, what: Held, is_python: bool) -> Iterator[tuple[Routine, Use]]:
    """All uses of *what* in the workspace, tests left out."""
    last = what.name.rpartition("::")[2]
    for path in sorted(code.naming(last)):
        if (path.rpartition(".")[2] == "py") == is_python:
            yield from _in_file(code, path).get(what, ())


def _in_file(code: Codebase, path: str) -> dict[Held, list[tuple[Routine, Use]]]:
    key = ("uses in", path)
    if key not in code.kept:
        found: dict[Held, list[tuple[Routine, Use]]] = {}
        for routine in code.routines(path):
            if not routine.is_test:
                for use in uses(code, routine):
                    found.setdefault(use.what, []).append((routine, use))
        code.kept[key] = found
    known: dict[Held, list[tuple[Routine, Use]]] = code.kept[key]
    return known


@dataclass(slots=True)
class _Visitor:
    code: Codebase
    routine: Routine
    found: list[Use] = field(default_factory=list)
    #: What a local variable stands for, or refers to a part of.
    aliases: dict[Held, dict[Held, None]] = field(default_factory=dict)

    def step(self, step: Step) -> None:
        calls = calls_by_node(self.code, self.routine)
        inner = _Expressions(self.code, self.routine, step, calls, self.found, self.aliases)
        if step.name:
            inner.declared()
        for value in step.values:
            inner.visit(value, "returned" if step.leaves == "return" else "read")

    def through_aliases(self) -> Iterator[Use]:
        for use in tuple(self.found):
            if use.what in self.aliases and (use.role in ("set", "called", "given", "kept") or not use.is_direct):
                waiting, seen = [use.what], {use.what}
                while waiting:
                    for other in self.aliases.get(waiting.pop(), ()):
                        if other not in seen:
                            seen.add(other)
                            waiting.append(other)
                            yield replace(use, what=other, is_direct=False)


@dataclass(slots=True)
class _Expressions:
    """The mentions in the expressions of one step."""

    code: Codebase
    routine: Routine
    step: Step
    calls: dict[int, Call]
    found: list[Use]
    aliases: dict[Held, dict[Held, None]]

    def declared(self) -> None:
        name = syntax.Name(self.step.name)
        what = held(self.code, self.routine, name)
        if what is not None:
            self.found.append(Use(what, "whole", self.step))
            for value in self.step.values:
                self.alias(what, value, self.step.type)

    def alias(self, what: Held, value: Expression, kind: syntax.Type) -> None:
        every, _ = chain(value)
        if not every or not self._refers(value, every, kind):
            return
        for node in every:
            other = held(self.code, self.routine, node)
            if other is not None and other != what:
                self.aliases.setdefault(what, {})[other] = None

    def _refers(self, value: Expression, every: list[Expression], kind: syntax.Type) -> bool:
        """Whether a variable of a *kind* that begins as *value* is no copy of it."""
        if self.routine.is_python or isinstance(value, (syntax.Address, syntax.Call)):
            return True
        if "&" in kind.marks or "*" in kind.marks:
            return True
        types = (kinds.type_of(self.code, self.routine, node) for node in (value, every[0]))
        return any(one is not None and ("*" in one.marks or one.name in SMART_POINTERS) for one in types)

    def visit(self, node: Expression, role: str, call: Call | None = None, argument: int | str = -1) -> None:
        every, is_whole = chain(node)
        if every:
            self.mention(every, is_whole, role, call, argument)
            self.indexes(node)
        elif isinstance(node, syntax.Assignment):
            self.assigned(node)
        elif isinstance(node, syntax.Call):
            self.called(node)
        elif isinstance(node, syntax.Operation) and node.operator in ("<<", ">>") and not self.routine.is_python:
            self.shifted(node)
        elif isinstance(node, (syntax.Keyword, syntax.Cast, syntax.Star, syntax.DoubleStar)):
            self.visit(node.value, role, call, argument)
        elif isinstance(node, syntax.Conditional):
            self.visit(node.test, "read")
            self.visit(node.then, role, call, argument)
            self.visit(node.other, role, call, argument)
        elif isinstance(node, syntax.New):
            for value in node.arguments:
                self.visit(value, "kept")
        else:
            for part in parts(node):
                self.visit(part, "kept" if role == "kept" else "read")

    def shifted(self, node: syntax.Operation) -> None:
        """Numbers are shifted; of anything else what follows is put in, or taken out."""
        first, *rest = node.operands
        is_stream = not self.is_number(first)
        self.visit(first, "set" if is_stream and node.operator == "<<" else "read")
        for operand in rest:
            self.visit(operand, "set" if is_stream and node.operator == ">>" else "read")

    def is_number(self, node: Expression) -> bool:
        """Whether an expression is a number: ``n << 2`` shifts it, where a stream or a matrix is given what follows."""
        kind = kinds.type_of(self.code, self.routine, node)
        return isinstance(node, syntax.Number) or (kind is not None and NUMBER.fullmatch(kind.name) is not None)

    def mention(
        self, every: list[Expression], is_whole: bool, role: str, call: Call | None, argument: int | str
    ) -> None:
        for number, node in enumerate(every):
            what = held(self.code, self.routine, node)
            if what is None:
                continue
            is_last = number == len(every) - 1
            is_direct = is_whole if is_last else number == 0
            own = role
            if role == "whole" and not is_direct:
                own = "set"
            if role == "through" and number:
                own = "read"
            self.found.append(Use(what, own, self.step, call, is_direct, argument))

    def indexes(self, node: Expression) -> None:
        """What stands in brackets, and in the parentheses of calls, on the way to the variable."""
        for _ in range(100):
            if isinstance(node, syntax.Subscript):
                self.visit(node.index, "read")
                node = node.object
            elif isinstance(node, syntax.Call):
                for value in node.arguments if isinstance(node.callee, syntax.Member) else ():
                    self.visit(value, "read")
                node = node.callee.object if isinstance(node.callee, syntax.Member) else node.arguments[0]
            elif isinstance(node, syntax.Member):
                node = node.object
            elif isinstance(node, (syntax.Dereference, syntax.Address, syntax.Cast, syntax.Keyword, syntax.Star)):
                node = node.value
            else:
                return

    def assigned(self, node: syntax.Assignment) -> None:
        targets = node.target.items if isinstance(node.target, syntax.ListLiteral) else (node.target,)
        for target in targets:
            every, is_whole = chain(target)
            if not every:
                self.visit(target, "set")
                continue
            self.mention(every, is_whole, "whole" if node.operator == "=" else "set", None, -1)
            self.indexes(target)
            what = held(self.code, self.routine, every[-1]) if is_whole and len(every) == 1 else None
            if what is not None and node.operator == "=":
                self.alias(what, node.value, syntax.NOTHING)
        self.visit(node.value, "read")

    def called(self, node: syntax.Call) -> None:
        call = self.calls.get(id(node)) or Call(syntax.name_of(node.callee).rpartition("::")[2], node, ())
        callee = node.callee
        if isinstance(callee, syntax.Member) and not isinstance(callee.object, syntax.This):
            is_ours = is_of_workspace(self.code, self.routine, call)
            self.visit(callee.object, "through" if is_ours else "called", call)
        elif not isinstance(callee, syntax.Member) or held(self.code, self.routine, callee) is not None:
            self.visit(callee, "read")
        if is_log(self.code, self.routine, call):
            for value in node.arguments:
                self.logged(value)
            return
        for number, value in enumerate(node.arguments):
            name = value.name if isinstance(value, syntax.Keyword) else ""
            self.visit(value, "given", call, name or number)

    def logged(self, value: Expression) -> None:
        """What is written to a log decides nothing; what is called for that may change something."""
        before = len(self.found)
        self.visit(value, "read")
        self.found[before:] = [
            replace(use, role="logged") if use.role == "read" else use for use in self.found[before:]
        ]
