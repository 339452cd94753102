# SPDX-License-Identifier: Apache-2.0
"""Predicates of HPL, read by recursive descent within bounds (hpl-specs 1.4, ``grammars/predicates.lark``).

Weakest first: ``implies`` and ``iff``, ``or``, ``and``, ``not`` and quantifiers, one comparison, ``+ -``, ``* /``, ``**``, ``-``; all
of one rank group from the left. More than hpl-specs reads: functions of several arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from haros_ci.behaviour import dialect
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.scanner import Scanner
from haros_ci.behaviour.tree import (
    Binary,
    Call,
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

#: Brackets, ``not``, ``-`` and quantifiers within each other; levels of the tree; and parts of a predicate.
DEEPEST = 30
HIGHEST = 120
MOST_PARTS = 5_000

CONSTANTS = {"PI": math.pi, "INF": math.inf, "NAN": math.nan, "E": math.e}
COMPARISONS = ("<=", ">=", "!=", "=", "<", ">")

_Level = Callable[[], Expression]


class Expressions:
    """Reads expressions where *scanner* stands."""

    def __init__(self, scanner: Scanner) -> None:
        self.scanner = scanner
        self.depth = 0
        self.heights: dict[int, int] = {}
        self.kept: list[Expression] = []  # so that no identity is used twice

    def condition(self) -> Expression:
        return self._chain(self._disjunction, lambda: self.scanner.keyword("implies", "iff"))

    def _disjunction(self) -> Expression:
        return self._chain(self._conjunction, lambda: self.scanner.keyword("or"))

    def _conjunction(self) -> Expression:
        return self._chain(self._logic, lambda: self.scanner.keyword("and"))

    def _logic(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        if scanner.keyword("not"):
            operand = self._deeper(begin, self._logic)
            return self._made(Unary(scanner.place(begin), "not", operand))
        word = scanner.keyword("forall", "exists")
        return self._comparison() if word is None else self._deeper(begin, lambda: self._quantifier(word, begin))

    def _quantifier(self, word: str, begin: int) -> Expression:
        scanner = self.scanner
        at = scanner.at
        variable = scanner.word()
        if variable is None:
            help_ = "write it without @ here" if scanner.is_sign("@") else f"for example {word} i in values: @i > 0"
            raise scanner.fault("the name of a variable", help_)
        variable_at = scanner.place(at)
        if not scanner.keyword("in"):
            raise scanner.fault("'in'", f"for example {word} {variable} in values: @{variable} > 0")
        domain = self._atom()
        if not scanner.sign(":"):
            raise scanner.fault("':' after the members", dialect.in_predicate(scanner))
        condition = self._logic()
        return self._made(Quantifier(scanner.place(begin), word, variable, variable_at, domain, condition))

    def _comparison(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        left = self._sum()
        operator = scanner.sign(*COMPARISONS) if not scanner.is_sign("==") else None
        operator = operator or scanner.keyword("in")
        return left if operator is None else self._binary(operator, left, self._sum(), begin)

    def _sum(self) -> Expression:
        return self._chain(self._term, lambda: self.scanner.sign("+", "-"))

    def _term(self) -> Expression:
        return self._chain(self._factor, lambda: None if self.scanner.is_sign("**") else self.scanner.sign("*", "/"))

    def _factor(self) -> Expression:
        return self._chain(self._exponent, lambda: self.scanner.sign("**"))

    def _exponent(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        if scanner.sign("-"):
            operand = self._deeper(begin, self._exponent)
            return self._made(Unary(scanner.place(begin), "-", operand))
        if not scanner.sign("("):
            return self._atom()
        scanner.inside += 1
        found = self._deeper(begin, self.condition)
        self._close(")")
        return found

    def _atom(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        text = scanner.quoted()
        if text is not None:
            return self._made(Literal(scanner.place(begin), text, unquoted(text)))
        number = scanner.number()
        if number is not None:
            return self._made(Literal(scanner.place(begin), number, value_of(number)))
        if scanner.is_sign("{"):
            return self._deeper(begin, self._set)
        if scanner.is_sign("[") or scanner.is_sign("!["):
            return self._deeper(begin, self._range)
        word = scanner.peek()
        if word in ("True", "False"):
            scanner.word()
            return self._made(Literal(scanner.place(begin), word, word == "True"))
        if word in CONSTANTS:
            scanner.word()
            return self._made(Literal(scanner.place(begin), word, CONSTANTS[word]))
        return self._reference()

    def _reference(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        variable = scanner.variable()
        found: Expression
        if variable is not None:
            found = self._made(Variable(scanner.place(begin), variable))
        else:
            word = scanner.word()
            if word is None:
                raise self._no_value()
            at = scanner.place(begin)
            if scanner.is_sign("("):
                return self._deeper(begin, partial(self._call, word, begin))
            found = self._made(Field(at, None, word, at))
        while True:
            if scanner.sign("."):
                at_offset = scanner.at
                name = scanner.word()
                if name is None:
                    raise scanner.fault("the name of a field after '.'")
                found = self._made(Field(scanner.place(begin), found, name, scanner.place(at_offset)))
            elif scanner.sign("["):
                scanner.inside += 1
                index = self._deeper(begin, self._sum)
                self._close("]")
                found = self._made(Item(scanner.place(begin), found, index))
            else:
                return found

    def _call(self, name: str, begin: int) -> Expression:
        scanner = self.scanner
        at = scanner.place(begin)
        if name not in dialect.FUNCTIONS:
            raise HplFault(f"there is no function {name}", at, dialect.function(name))
        arguments = self._list("(", ")")
        return self._made(Call(scanner.place(begin), name, arguments))

    def _set(self) -> Expression:
        begin = self.scanner.at
        values = self._list("{", "}")
        return self._made(SetOf(self.scanner.place(begin), values))

    def _list(self, opening: str, closing: str) -> tuple[Expression, ...]:
        scanner = self.scanner
        scanner.sign(opening)
        scanner.inside += 1
        found = [self._sum()]
        while scanner.sign(","):
            found.append(self._sum())
        self._close(closing)
        return tuple(found)

    def _range(self) -> Expression:
        scanner, begin = self.scanner, self.scanner.at
        open_low = scanner.sign("![", "[") == "!["
        scanner.inside += 1
        low = self._sum()
        if not scanner.keyword("to"):
            raise scanner.fault("'to'", dialect.in_set(scanner))
        high = self._sum()
        open_high = scanner.is_sign("]!")
        if not scanner.is_sign("]"):
            raise scanner.fault("']'", dialect.in_set(scanner))
        scanner.inside -= 1
        scanner.sign("]!", "]")
        return self._made(Range(scanner.place(begin), low, high, open_low, open_high))

    def _close(self, sign: str) -> None:
        scanner = self.scanner
        if not scanner.is_sign(sign):
            raise scanner.fault(repr(sign), dialect.in_predicate(scanner))
        scanner.inside -= 1
        scanner.sign(sign)

    def _no_value(self) -> HplFault:
        scanner = self.scanner
        help_ = dialect.in_predicate(scanner)
        if scanner.is_sign('"'):
            return HplFault("the text that begins here has no end", scanner.here(), 'close it with " in the same line')
        if scanner.is_sign("@"):
            return scanner.fault("the name of an alias after '@'", "write it without a space: @A")
        return scanner.fault("a value, a field or a condition", help_)

    def _chain(self, level: _Level, operator: Callable[[], str | None]) -> Expression:
        begin, left = self.scanner.at, level()
        while (sign := operator()) is not None:
            left = self._binary(sign, left, level(), begin)
        return left

    def _binary(self, operator: str, left: Expression, right: Expression, begin: int) -> Expression:
        return self._made(Binary(self.scanner.place(begin), operator, left, right))

    def _deeper(self, begin: int, level: _Level) -> Expression:
        self.depth += 1
        if self.depth > DEEPEST:
            raise HplFault(
                f"nested deeper than {DEEPEST} levels", self.scanner.place(begin), "take the predicate apart"
            )
        found = level()
        self.depth -= 1
        return found

    def _made(self, made: Expression) -> Expression:
        height = 1 + max((self.heights[id(child)] for child in children(made)), default=0)
        if height > HIGHEST or len(self.kept) >= MOST_PARTS:
            most = f"{HIGHEST} operators in a row" if height > HIGHEST else f"{MOST_PARTS} parts"
            raise HplFault(f"a predicate of more than {most}", made.at, "take it apart")
        self.heights[id(made)] = height
        self.kept.append(made)
        return made


def unquoted(text: str) -> str:
    r"""The characters of a text in quotes; ``\"`` and ``\\`` stand for the second one."""
    return text[1:-1].replace('\\"', '"').replace("\\\\", "\\") if "\\" in text else text[1:-1]


def value_of(number: str) -> int | float:
    return int(number) if number.isdigit() else float(number)
