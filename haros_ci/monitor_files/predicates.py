# SPDX-License-Identifier: Apache-2.0
"""Predicates as text of Python, from their trees: what ``monitoring/predicates.py`` makes of them as closures, part by part.

The text is one expression of a message ``m`` and of ``known``, the values that were kept of other messages by their alias. It calls the functions of
``parts/values.py`` and ``parts/functions.py`` alone. Names and texts of the workspace stand in it as literals; variables of quantifiers get names of ours.
"""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Event,
    Expression,
    Field,
    Item,
    Literal,
    Quantifier,
    Range,
    SetOf,
    Unary,
    Variable,
    children,
)
from haros_ci.monitor_files.literals import literal
from haros_ci.monitoring.predicates import Constants, key_of, rooted

#: Operators within each other: so much Python's parser, and a reader, can follow.
DEEPEST = 30
_ARITHMETIC = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "**": "power"}
_COMPARISONS = {"=": "==", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_JOINED = ("and", "or")


class TooDeep(Exception):
    """The expression has more parts within each other than can be written."""


def predicate_text(event: Event, constants: Constants, *, of_slots: bool = False) -> str:
    """The predicate of *event*, which must have one. With *of_slots* ``m`` are the kept values of a message. TooDeep where it is too deep."""
    operator, operands = predicate_parts(event, constants, of_slots=of_slots)
    return f" {operator} ".join(operands)


def predicate_parts(event: Event, constants: Constants, *, of_slots: bool = False) -> tuple[str, list[str]]:
    """The same, taken apart: ``and`` or ``or`` and its operands; one operand, and "", where it is no such row."""
    assert event.predicate is not None
    operands = [expression_text(event, part, constants, of_slots=of_slots) for part in row(event.predicate)]
    if len(operands) == 1 and isinstance(event.predicate, (Binary, Unary)) and operands[0].startswith("("):
        operands[0] = operands[0][1:-1]  # what is written of these has brackets of its own
    return _row_of(event.predicate), operands


def expression_text(event: Event, expression: Expression, constants: Constants, *, of_slots: bool = False) -> str:
    """An expression that belongs to *event* as text of Python; TooDeep where it is too deep."""
    if depth(expression) > DEEPEST:
        raise TooDeep
    return _Writer(event, constants, of_slots).of(expression)


def depth(expression: Expression) -> int:
    """How many operators stand within each other; a row of ``and``, or of ``or``, is one."""
    deepest = 0
    stack = [(expression, 1)]
    while stack:
        item, level = stack.pop()
        deepest = max(deepest, level)
        for child in children(item):
            is_same_row = isinstance(item, Binary) and item.operator in _JOINED and _row_of(child) == item.operator
            stack.append((child, level + (not is_same_row)))
    return deepest


def _row_of(expression: Expression) -> str:
    return expression.operator if isinstance(expression, Binary) and expression.operator in _JOINED else ""


def row(expression: Expression) -> list[Expression]:
    """The operands of a row of ``and`` or ``or`` from left to right; any other expression alone."""
    operator = _row_of(expression)
    found: list[Expression] = []
    stack = [expression]
    while stack:
        item = stack.pop()
        if operator and isinstance(item, Binary) and item.operator == operator:
            stack += (item.right, item.left)
        else:
            found.append(item)
    return found


class _Writer:
    def __init__(self, event: Event, constants: Constants, of_slots: bool) -> None:
        self.event = event
        self.constants = constants
        self.of_slots = of_slots
        #: The variables of the quantifiers around, and what they are called here.
        self.variables: list[tuple[str, str]] = []

    def of(self, expression: Expression) -> str:
        match expression:
            case Literal(value=value):
                return literal(value)
            case Field() | Item() | Variable():
                return self.chain(expression)
            case SetOf(values=values):
                return f"[{self.listed(values)}]"
            case Range(low=low, high=high):
                ends = f"{self.of(low)}, {self.of(high)}"
                opened = (expression.open_low, expression.open_high)
                return f"Interval({ends}{f', {opened[0]}, {opened[1]}' if any(opened) else ''})"
            case Call(name=name, arguments=arguments):
                return f"hpl_{name}({self.listed(arguments)})"
            case Unary(operator="not", operand=operand):
                return f"(not {self.of(operand)})"
            case Unary(operand=Literal(value=bool() | str() as value)):
                return f"(-num({literal(value)}))"
            case Unary(operand=Literal(value=value)):
                return f"(-{literal(value)})"
            case Unary(operand=operand):
                return f"(-num({self.of(operand)}))"
            case Quantifier():
                return self.quantifier(expression)
            case Binary():
                return self.binary(expression)

    def listed(self, expressions: Iterable[Expression]) -> str:
        return ", ".join(map(self.of, expressions))

    def chain(self, expression: Field | Item | Variable) -> str:
        constant = self.constants(self.event, expression)
        if constant is not None:
            return literal(constant)
        named = dict(self.variables)
        root = rooted(expression)
        if root is not None and (root[0] is None or root[0] not in named):
            if root[0] is not None and root[0] != self.event.alias:
                return f"of(known, {literal(root[0])}, {literal(key_of(expression))})"
            if self.of_slots:
                return f"there(m, {literal(key_of(expression))})"
        match expression:
            case Variable(name=name):
                return named.get(name, "m")
            case Item(base=base, index=index):
                return f"item({self.of(base)}, {self.of(index)})"
            case Field():
                return self.fields(expression)

    def fields(self, expression: Field) -> str:
        """A field, with those that it is in: ``get(m, 'pose', 'x')``."""
        names: list[str] = []
        base: Expression | None = expression
        while isinstance(base, Field) and (not names or self.constants(self.event, base) is None):
            names.insert(0, base.name)
            base = base.base
        start = "m" if base is None else self.of(base)
        return f"get({start}, {', '.join(map(literal, names))})"

    def quantifier(self, quantifier: Quantifier) -> str:
        is_listed = isinstance(quantifier.domain, (SetOf, Range))
        domain = self.of(quantifier.domain)
        name = f"i{len(self.variables) + 1}"
        self.variables.append((quantifier.variable, name))
        condition = self.of(quantifier.condition)
        self.variables.pop()
        decide = "all" if quantifier.word == "forall" else "any"
        return f"{decide}({condition} for {name} in {'members' if is_listed else 'indices'}({domain}))"

    def binary(self, binary: Binary) -> str:
        if binary.operator in _JOINED:
            return f"({f' {binary.operator} '.join(map(self.of, row(binary)))})"
        if binary.operator == "in" and isinstance(binary.right, Range):
            return self.within(binary.left, binary.right)
        left, right = self.of(binary.left), self.of(binary.right)
        match binary.operator:
            case "implies":
                return f"(not {left} or {right})"
            case "iff":
                return f"(bool({left}) == bool({right}))"
            case "in":
                return f"is_in({left}, {right})"
            case sign if sign in _ARITHMETIC:
                return f"{_ARITHMETIC[sign]}({left}, {right})"
            case sign:
                return f"({left} {_COMPARISONS[sign]} {right})"

    def within(self, value: Expression, range: Range) -> str:
        """``value in [low to high]``, as Python's comparison where both ends are fixed."""
        if not isinstance(range.low, Literal) or not isinstance(range.high, Literal):
            return f"is_in({self.of(value)}, {self.of(range)})"
        above, below = "<" if range.open_low else "<=", "<" if range.open_high else "<="
        return f"({literal(range.low.value)} {above} {self.of(value)} {below} {literal(range.high.value)})"
