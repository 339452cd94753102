# SPDX-License-Identifier: Apache-2.0
"""Predicates as alternatives of conditions on single fields, which can be decided: intervals, sets of values, NaN.

A comparison of a field with a value that does not depend on messages is an ``Atom``; anything else is ``Opaque``, and stands for
itself or its opposite. A comparison with NaN is false, so what says the opposite of one allows NaN.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import product
from typing import Union

from haros_ci.behaviour.folding import Scalar, folded
from haros_ci.behaviour.messages import FLOATS, INTEGERS, Scene
from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import (
    Binary,
    Call,
    Expression,
    Field,
    Item,
    Literal,
    Range,
    SetOf,
    Unary,
    Variable,
)
from haros_ci.interfaces.definitions import FieldType
from haros_ci.records import dataclass

#: Alternatives and conditions of one predicate; what has more is not decided.
MOST_CLAUSES, MOST_CONDITIONS = 256, 64

_LOGIC = frozenset(("and", "or", "implies", "iff"))
COMPARISONS = ("=", "!=", "<", "<=", ">", ">=")
_OPPOSITE = {"=": "!=", "!=": "=", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_MIRRORED = {"=": "=", "!=": "!=", "<": ">", ">": "<", "<=": ">=", ">=": "<="}


@dataclass(frozen=True, slots=True)
class Domain:
    """The values that a field can have: *low* to *high*, integers alone or not, perhaps NaN."""

    low: float = -math.inf
    high: float = math.inf
    is_integer: bool = False
    has_nan: bool = True


ANYTHING = Domain()


@dataclass(frozen=True, slots=True)
class Atom:
    """*term* (the text of a field) compared with *value*; *takes_nan* if it holds for NaN, too."""

    term: str
    domain: Domain
    operator: str
    value: Scalar
    takes_nan: bool = False


@dataclass(frozen=True, slots=True)
class Opaque:
    """A condition that is not looked into, or (*is_positive* False) its opposite."""

    text: str
    is_positive: bool


Condition = Union[Atom, Opaque]
Clause = tuple[Condition, ...]
#: One of these holds; () is never, ((),) always.
Clauses = tuple[Clause, ...]


class TooMany(Exception):
    """A predicate has more alternatives than are looked at."""


@dataclass(frozen=True, slots=True)
class Reader:
    """Makes clauses of the predicates of one event; *alias* is the event's own."""

    scene: Scene | None = None
    alias: str | None = None

    def clauses(self, expression: Expression | None, positive: bool = True) -> Clauses:
        """Those of *expression*, or of its opposite; TooMany if there are too many."""
        if expression is None:
            return ((),) if positive else ()
        match expression:
            case Literal(value=bool(value)):
                return ((),) if value is positive else ()
            case Unary(operator="not", operand=operand):
                return self.clauses(operand, not positive)
            case Binary(operator=word) if word in _LOGIC:
                return self._logic(expression, positive)
            case Binary(operator="in"):
                return self._membership(expression, positive)
            case Binary(operator=sign) if sign in _OPPOSITE:
                return self._comparison(expression, positive)
            case Field() | Item() | Variable():
                return ((Atom(self.term(expression), Domain(has_nan=False), "=", positive),),)
            case _:
                return ((Opaque(self.term(expression), positive),),)

    def _logic(self, binary: Binary, positive: bool) -> Clauses:
        left, right = binary.left, binary.right
        if binary.operator == "iff":
            same = _all(self.clauses(left, True), self.clauses(right, positive))
            return _any(same, _all(self.clauses(left, False), self.clauses(right, not positive)))
        if binary.operator == "implies":
            join = _any if positive else _all
            return join(self.clauses(left, not positive), self.clauses(right, positive))
        join = _all if (binary.operator == "and") is positive else _any
        return join(self.clauses(left, positive), self.clauses(right, positive))

    def term(self, expression: Expression) -> str:
        """The text of *expression*; the event's own alias is left out."""
        text = expression_text(expression)
        return text.removeprefix(f"@{self.alias}.") if self.alias is not None else text

    def _comparison(self, comparison: Binary, positive: bool) -> Clauses:
        left, right, sign = comparison.left, comparison.right, comparison.operator
        value = folded(right, self.scene)
        if value is None:
            left, right, sign, value = right, left, _MIRRORED[sign], folded(left, self.scene)
        if value is None or not _is_term(left, self.scene):
            first = folded(left, self.scene)
            if value is not None and first is not None:
                return ((),) if _holds(first, sign, value) is positive else ()
            return ((Opaque(expression_text(comparison), positive),),)
        return ((self._atom(left, sign, value, positive),),)

    def _atom(self, term: Expression, sign: str, value: Scalar, positive: bool) -> Atom:
        sign, takes_nan = (sign, sign == "!=") if positive else (_OPPOSITE[sign], sign != "!=")
        return Atom(self.term(term), self.domain(term), sign, value, takes_nan)

    def _membership(self, binary: Binary, positive: bool) -> Clauses:
        left, members = binary.left, binary.right
        if isinstance(members, (Range, SetOf)) and _is_term(left, self.scene):
            ends = (members.low, members.high) if isinstance(members, Range) else members.values
            values = [value for end in ends if (value := folded(end, self.scene)) is not None]
            if len(values) == len(ends) <= MOST_CONDITIONS:
                inside = self._in_range if isinstance(members, Range) else self._in_set
                return inside(left, members, values, positive)
        return ((Opaque(expression_text(binary), positive),),)

    def _in_range(self, term: Expression, members: Range | SetOf, values: list[Scalar], positive: bool) -> Clauses:
        assert isinstance(members, Range)
        above = self._atom(term, ">" if members.open_low else ">=", values[0], positive)
        below = self._atom(term, "<" if members.open_high else "<=", values[1], positive)
        return ((above, below),) if positive else ((above,), (below,))

    def _in_set(self, term: Expression, members: Range | SetOf, values: list[Scalar], positive: bool) -> Clauses:
        atoms = [self._atom(term, "=", value, positive) for value in values]
        return tuple((atom,) for atom in atoms) if positive else (tuple(atoms),)

    def domain(self, term: Expression) -> Domain:
        """The values that a field, or the length of one, can have."""
        if isinstance(term, Call):
            return Domain(0, math.inf, True, False)
        typed = None if self.scene is None else self.scene.typed(term)
        if not isinstance(typed, FieldType) or typed.form:
            return ANYTHING
        if typed.base in INTEGERS:
            return Domain(*INTEGERS[typed.base], True, False)
        return ANYTHING if typed.base in FLOATS else Domain(has_nan=False)


def _is_term(expression: Expression, scene: Scene | None) -> bool:
    """Whether *expression* is a field, or the length of one."""
    if isinstance(expression, Call):
        return expression.name == "len" and len(expression.arguments) == 1 and _is_term(expression.arguments[0], scene)
    return isinstance(expression, (Field, Item, Variable)) and folded(expression, scene) is None


def _all(one: Clauses, other: Clauses) -> Clauses:
    if len(one) * len(other) > MOST_CLAUSES:
        raise TooMany
    found = tuple(dict.fromkeys(tuple(dict.fromkeys((*a, *b))) for a, b in product(one, other)))
    if any(len(item) > MOST_CONDITIONS for item in found):
        raise TooMany
    return found


def _any(one: Clauses, other: Clauses) -> Clauses:
    if len(one) + len(other) > MOST_CLAUSES:
        raise TooMany
    return tuple(dict.fromkeys((*one, *other)))


joined = _all


def is_possible(clause: Clause) -> bool:
    """Whether the conditions of *clause* can hold together; True where that is not known."""
    opaque = {value.text: value.is_positive for value in clause if isinstance(value, Opaque)}
    if any(isinstance(value, Opaque) and opaque[value.text] is not value.is_positive for value in clause):
        return False
    terms: dict[str, list[Atom]] = {}
    for atom in clause:
        if isinstance(atom, Atom):
            terms.setdefault(atom.term, []).append(atom)
    return all(_has_value(atoms) for atoms in terms.values())


def is_decided(clause: Clause) -> bool:
    """Whether ``is_possible`` looks into all of *clause*."""
    return not any(isinstance(item, Opaque) for item in clause)


def _has_value(atoms: list[Atom]) -> bool:
    domain = atoms[0].domain
    if domain.has_nan and all(atom.takes_nan for atom in atoms):
        return True
    fixed = [atom.value for atom in atoms if atom.operator == "="]
    if fixed:
        return _fits(fixed[0], domain) and all(_holds(fixed[0], atom.operator, atom.value) for atom in atoms)
    if any(isinstance(atom.value, str) for atom in atoms):
        return True  # a text differs from so many others
    excluded = {atom.value for atom in atoms if atom.operator == "!="}
    if any(isinstance(item, bool) for item in excluded):
        return len(excluded) < 2
    return _interval(atoms, domain, excluded)


def _interval(atoms: Iterable[Atom], domain: Domain, excluded: set[Scalar]) -> bool:
    """Whether a number is left between all bounds that is not *excluded*."""
    low, open_low = max([(domain.low, False), *_bounds(atoms, ">")])
    high, is_closed = min([(domain.high, True), *((value, not is_open) for value, is_open in _bounds(atoms, "<"))])
    open_high = not is_closed
    if domain.is_integer:
        low, open_low = _first_integer(low, open_low), False
        high, open_high = -_first_integer(-high, open_high), False
    if low > high or (low == high and (open_low or open_high or low in excluded)):
        return False
    if domain.is_integer and high - low < len(excluded):
        return any(number not in excluded for number in range(int(low), int(high) + 1))
    return True


def _first_integer(low: float, is_open: bool) -> float:
    """The least integer from *low* on, or above it; infinity is its own."""
    if not math.isfinite(low):
        return low
    return math.floor(low) + 1 if is_open else math.ceil(low)


def _bounds(atoms: Iterable[Atom], sign: str) -> Iterator[tuple[float, bool]]:
    """The bounds below (*sign* ``>``) or above (``<``), each with whether it is itself left out."""
    for atom in atoms:
        if atom.operator in (sign, f"{sign}=") and not isinstance(atom.value, str):
            yield atom.value, atom.operator == sign


def _fits(value: Scalar, domain: Domain) -> bool:
    """Whether a field of this domain can have the value."""
    if isinstance(value, (str, bool)):
        return True
    if not domain.low <= value <= domain.high:
        return False
    return not domain.is_integer or (math.isfinite(value) and value == math.floor(value))


def _holds(left: Scalar, sign: str, right: Scalar) -> bool:
    if isinstance(left, str) is not isinstance(right, str):
        return sign == "!="
    match sign:
        case "=":
            return left == right
        case "!=":
            return left != right
        case "<":
            return left < right  # type: ignore[operator]  # two numbers or two texts
        case "<=":
            return left <= right  # type: ignore[operator]  # the same
        case ">":
            return left > right  # type: ignore[operator]  # the same
        case _:
            return left >= right  # type: ignore[operator]  # the same
