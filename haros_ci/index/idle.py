# SPDX-License-Identifier: Apache-2.0
"""Statements of C++ that make and change nothing: logs, and numbers and texts that nobody uses. Programs are followed without them.

Who adds or changes such a statement has the same programs but for their lines, so what was followed holds (docs/decisions/0037).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import cast

from haros_ci import syntax
from haros_ci.index.mentions import last
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Block, Function, Program, Statement
from haros_ci.syntax.codec import plain
from haros_ci.syntax.node import Record
from haros_ci.syntax.source import Source

#: Macros that log what they are given (rclcpp/logging.hpp, ros/console.h, nodelet/nodelet.h, rcutils/logging_macros.h), but for those that call a function.
_LOG = regex(
    r"(?:RCLCPP|ROS|NODELET|RCUTILS_LOG)_(?:DEBUG|INFO|WARN|ERROR|FATAL)"
    r"(?:_(?:STREAM|NAMED|ONCE|THROTTLE|SKIPFIRST|DELAYED|COND|EXPRESSION))*"
)
_WORD = regex(rb"\w+")
#: What the name of a lambda has behind that of the function around it.
_LAMBDA = "::(lambda)"
#: Functions of nodes, clocks and texts that only read, by the last parts of their names.
GETTERS = frozenset(
    "get_logger get_clock get_name get_namespace get_fully_qualified_name get_effective_namespace get_topic_name "
    "get_service_name getTopic getService now seconds nanoseconds toSec c_str str what size length empty to_string".split()
)
#: Where texts go that nobody of the program reads (iostream).
STREAMS = frozenset(("std::cout", "std::cerr", "std::clog"))
#: Operators that leave numbers as they are; of texts ``<<`` puts together what is logged.
OPERATORS = frozenset("+ - * / % < > <= >= == != && || ! ~ & | ^ << sizeof".split())
#: Types of which a value is made without anything being done, under the names that they have everywhere.
PLAIN = frozenset("bool char int short long unsigned signed float double auto size_t uint string".split()) | {
    f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)
}
_LITERALS = frozenset((syntax.Number, syntax.Boolean, syntax.String, syntax.Null))
_LEAVES = _LITERALS | {syntax.Name, syntax.This, syntax.TypeName}
#: The blocks of statements, and what has blocks in them.
_BLOCKS: dict[type, tuple[str, ...]] = {
    syntax.If: ("then", "other"),
    syntax.Loop: ("body",),
    syntax.Each: ("body",),
    syntax.Nested: ("body",),
    syntax.Try: ("body", "handlers"),
    syntax.Switch: ("cases",),
    syntax.Preprocessor: ("branches",),
    syntax.Case: ("body",),
    syntax.Handler: ("body",),
    syntax.Branch: ("body",),
}


@dataclass(frozen=True, slots=True)
class Idle:
    """What is idle in a workspace; *own* are the macros and functions that it defines itself under the names of those that are elsewhere."""

    own: frozenset[str]

    def without(self, sources: Iterable[Source]) -> tuple[Source, ...]:
        """*sources* without their idle statements."""
        return tuple(self._source(source) for source in sources)

    def _source(self, source: Source) -> Source:
        program = self.program(source.program)
        return source if program is source.program else replace(source, program=program)

    def program(self, program: Program) -> Program:
        """*program* without its idle statements; the same object where it has none."""
        if program.language == "python":
            return program
        try:
            uses = _Uses(program)
            functions = tuple([self._function(function, uses) for function in program.functions])
        except RecursionError:
            return program
        is_same = all(one is other for one, other in zip(functions, program.functions, strict=True))
        return program if is_same else syntax.replace(program, functions=functions)

    def _function(self, function: Function, uses: _Uses) -> Function:
        if not function.body:
            return function
        body = _filtered(function.body, self._is_idle)
        names = frozenset(variable.name for variable in _variables(body))
        if names:
            unused = names & uses.once(body, function)
            if unused:
                body = _filtered(body, lambda part: part.__class__ is syntax.Variable and part.name in unused)
        return function if body is function.body else syntax.replace(function, body=body)

    def _is_idle(self, part: Record) -> bool:
        """Whether a statement logs, or only asks for something."""
        if isinstance(part, syntax.Do):
            value = part.value
            if isinstance(value, syntax.Cast) and value.type == syntax.Type("void"):
                return self._reads(value.value)
            if isinstance(value, syntax.Call) and isinstance(value.callee, syntax.Name):
                name = value.callee.name
                is_log = _LOG.fullmatch(name) is not None and name not in self.own
                return is_log and all(map(self._reads, value.arguments))
            return isinstance(value, syntax.Operation) and _is_output(value) and self._reads(value)
        if isinstance(part, syntax.If):
            return not part.then and not part.other and self._reads(part.test)
        return False

    def _reads(self, part: Record) -> bool:
        """Whether an expression only reads."""
        kind = part.__class__
        if kind in _LEAVES:
            return True
        if isinstance(part, syntax.Member):
            return self._reads(part.object)
        if isinstance(part, syntax.Operation):
            return part.operator in OPERATORS and all(map(self._reads, part.operands))
        if isinstance(part, syntax.Call):
            callee = part.callee
            if not isinstance(callee, (syntax.Name, syntax.Member)) or part.templates:
                return False
            name = last(callee.name)
            is_getter = name in GETTERS and name not in self.own
            on = (callee.object,) if isinstance(callee, syntax.Member) else ()
            return is_getter and all(map(self._reads, (*on, *part.arguments)))
        if isinstance(part, (syntax.Dereference, syntax.Cast)):
            return self._reads(part.value)
        if isinstance(part, syntax.Conditional):
            return all(map(self._reads, (part.test, part.then, part.other)))
        return False


def idle_in(sources: Iterable[Source]) -> Idle:
    """What is idle in the workspace of *sources*."""
    own = set[str]()
    for source in sources:
        program = source.program
        if program.language != "python":
            own.update(name for name, _, _ in program.macros if name in GETTERS or _LOG.fullmatch(name))
            own.update(GETTERS.intersection([last(function.name) for function in program.functions]))
    return Idle(frozenset(own))


def _is_output(value: syntax.Operation) -> bool:
    """Whether an expression writes to the terminal: ``std::cout << a << b``."""
    first: Record = value
    while isinstance(first, syntax.Operation) and first.operator == "<<":
        first = first.operands[0]
    return isinstance(first, syntax.Name) and first.name in STREAMS


def _filtered(block: Block, is_idle: Callable[[Record], bool]) -> Block:
    """*block* without the statements of it, and of the blocks in it, that are idle; the same object where none is."""
    kept: list[Statement] = []
    for statement in block:
        now = _inside(statement, is_idle) if statement.__class__ in _BLOCKS else statement
        if not is_idle(now):
            kept.append(cast("Statement", now))
    is_same = len(kept) == len(block) and all(one is other for one, other in zip(kept, block, strict=True))
    return block if is_same else tuple(kept)


def _inside(part: Record, is_idle: Callable[[Record], bool]) -> Record:
    """*part*, which has blocks, with these filtered."""
    changed = {}
    for name in _BLOCKS[part.__class__]:
        before = getattr(part, name)
        if name in ("cases", "handlers", "branches"):
            now = tuple([_inside(item, is_idle) for item in before])
            now = before if all(one is other for one, other in zip(now, before, strict=True)) else now
        else:
            now = _filtered(before, is_idle)
        if now is not before:
            changed[name] = now
    return syntax.replace(part, **changed) if changed else part


def _variables(block: Block) -> Iterator[syntax.Variable]:
    """The variables that are made with nothing but literals."""
    for statement in block:
        if isinstance(statement, syntax.Variable):
            kind = statement.type
            is_text = kind.name == "char" and kind.marks == "c*"
            words = kind.name.removeprefix("std::").split()
            is_plain = not kind.arguments and (is_text or (kind.marks in ("", "c") and PLAIN.issuperset(words)))
            if is_plain and words and all(map(_is_literal, syntax.started(statement.init))):
                yield statement
        elif statement.__class__ in _BLOCKS:
            yield from _variables_in(statement)


def _variables_in(part: Record) -> Iterator[syntax.Variable]:
    for name in _BLOCKS[part.__class__]:
        for item in [getattr(part, name)] if name not in ("cases", "handlers", "branches") else getattr(part, name):
            yield from _variables_in(item) if isinstance(item, Record) else _variables(item)


def _is_literal(part: Record) -> bool:
    if isinstance(part, syntax.Operation):
        return part.operator in OPERATORS and all(map(_is_literal, part.operands))
    return part.__class__ in _LITERALS


class _Uses:
    """The words of a program that may mention a variable: of a function's body, of lambdas in it, and of all macros of the file, which are read once."""

    def __init__(self, program: Program) -> None:
        self._macros = {word for _, _, text in program.macros for word in _WORD.findall(text.encode())}
        self._lambdas: dict[str, list[Function]] = {}
        for function in program.functions:
            parts = function.name.split(_LAMBDA)
            for number in range(1, len(parts)):
                self._lambdas.setdefault(_LAMBDA.join(parts[:number]), []).append(function)

    def once(self, body: Block, function: Function) -> frozenset[str]:
        """The words that stand there once."""
        lambdas = tuple(self._lambdas.get(function.name, ()))
        counts = Counter(_WORD.findall(b"\n".join((plain(body), plain(lambdas)))))
        return frozenset(word.decode() for word, count in counts.items() if count == 1 and word not in self._macros)
