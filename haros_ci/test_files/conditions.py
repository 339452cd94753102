# SPDX-License-Identifier: Apache-2.0
"""Predicates as strategies: each alternative of a predicate becomes ranges of single values, and the predicate itself filters what is left.

The alternatives are those of ``behaviour/clauses.py``; what they do not look into is left to the filter.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from haros_ci.behaviour.clauses import Atom, Clause, Clauses, TooMany, is_possible, joined
from haros_ci.behaviour.messages import FLOATS, INTEGERS, TEXTS, Message
from haros_ci.interfaces.definitions import FieldType
from haros_ci.monitor_files.literals import literal
from haros_ci.records import dataclass
from haros_ci.test_files.types import LENGTH, Path, Types, bits_of, call, path_of

#: Alternatives of one strategy, and items by which an array is made longer than a condition asks.
MOST_ALTERNATIVES, MORE_ITEMS = 16, 4

Scalar = bool | int | float | str
Boundaries = Mapping[Path, tuple[Scalar, ...]]


def boundaries(clauses: Iterable[Clause]) -> dict[Path, tuple[Scalar, ...]]:
    """What values are compared with, by path."""
    found: dict[Path, dict[Scalar, None]] = {}
    for clause in clauses:
        for condition in clause:
            path = path_of(condition.term) if isinstance(condition, Atom) else None
            if path is not None and isinstance(condition, Atom):
                found.setdefault(path, {})[condition.value] = None
    return {path: tuple(values) for path, values in found.items()}


def both(*several: Clauses | None) -> Clauses | None:
    """Clauses that all hold; None if there are too many, or some are not known."""
    found: Clauses = ((),)
    for clauses in several:
        if clauses is None:
            return None
        try:
            found = joined(found, clauses)
        except TooMany:
            return None
    return found


@dataclass(frozen=True, slots=True)
class Strategies:
    """Expressions for messages of one topic. *near* is what any predicate compares its values with."""

    types: Types
    message: Message
    near: Boundaries

    def any(self) -> str:
        """Any message; often with the values that predicates compare with."""
        return self._having({path: text for path in self.near if (text := self._value(path, ())) is not None})

    def those(self, clauses: Clauses | None, filters: Sequence[str]) -> str | None:
        """Messages for which one of *clauses* and all *filters* hold; None if there are none. Without clauses the filters do it all."""
        if clauses is None:
            return _filtered(self.any(), filters)
        made = [text for clause in clauses if is_possible(clause) and (text := self._clause(clause)) is not None]
        made = list(dict.fromkeys(made))[:MOST_ALTERNATIVES]
        if not made:
            return None
        alternatives = "".join(f"\n            {text}," for text in made)
        return _filtered(made[0] if len(made) == 1 else f"st.one_of({alternatives}\n        )", filters)

    def _clause(self, clause: Clause) -> str | None:
        found: dict[Path, list[Atom]] = {}
        for condition in clause:
            path = path_of(condition.term) if isinstance(condition, Atom) else None
            if path is not None and isinstance(condition, Atom):
                found.setdefault(path, []).append(condition)
        values: dict[Path, str] = {}
        for path in sorted({*found, *self.near}, key=_order):
            text = self._value(path, found.get(path, ()))
            if text is not None:
                values[path] = text
        return self._having(values)

    def _having(self, values: Mapping[Path, str]) -> str:
        base = f"{self.types.function(self.message.name)}()"
        if not values:
            return base
        values = {**self._arrays(values), **values}
        inner = ", ".join(f"{literal(path)}: {values[path]}" for path in sorted(values, key=_order))
        return f"having({base}, {{{inner}}})"

    def _arrays(self, paths: Iterable[Path]) -> dict[Path, str]:
        """Arrays that have the items that *paths* name."""
        least: dict[Path, int] = {}
        for path in paths:
            for at, step in enumerate(path):
                if isinstance(step, int):
                    least[path[:at]] = max(least.get(path[:at], 0), step + 1)
        found: dict[Path, str] = {}
        for path, size in least.items():
            kind = self.types.at(self.message, path)
            if kind is not None and kind.form in ("sequence", "bounded"):
                most = size + MORE_ITEMS if kind.form == "sequence" else max(size, min(size + MORE_ITEMS, kind.size))
                found[path] = call(
                    "array", self.types.item(FieldType(kind.base, kind.length)), literal(size), literal(most)
                )
        return found

    def _value(self, path: Path, atoms: Sequence[Atom]) -> str | None:
        """The strategy of one value under these conditions; None where there is nothing to say of it."""
        near = self.near.get(path, ())
        if path[-1] == LENGTH:
            return self._length(path, atoms)
        kind = self.types.at(self.message, path)
        if kind is None or kind.form or kind.is_nested:
            return None
        if kind.base == "bool":
            return _of_bool(atoms) if atoms else None
        if kind.base in TEXTS:
            return _of_text(kind, atoms, near)
        if kind.base in INTEGERS or kind.base in FLOATS:
            return self._of_number(kind, atoms, near)
        return None

    def _length(self, path: Path, atoms: Sequence[Atom]) -> str | None:
        kind = self.types.at(self.message, path[:-1])
        if kind is None or kind.form in ("", "array"):
            return None
        low, high = _limits(atoms, 0, kind.size or math.inf)
        if not low <= high or low > 2_000:
            return None
        return call("whole", literal(int(low)), literal(int(min(high, low + MORE_ITEMS))))

    def _of_number(self, kind: FieldType, atoms: Sequence[Atom], near: Sequence[Scalar]) -> str | None:
        numbers = tuple(float(n) if isinstance(n, float) else int(n) for n in near if not isinstance(n, str))
        fixed = [atom.value for atom in atoms if atom.operator == "="]
        if fixed:
            return f"st.just({literal(_as(kind, fixed[0]))})" if not isinstance(fixed[0], str) else None
        if kind.base in INTEGERS:
            least, greatest = self.types.limits(kind.base)
            low, high = _limits(atoms, least, greatest)
            return call("whole", literal(int(low)), literal(int(high)), near=numbers) if low <= high else None
        (low, open_low), (high, open_high) = _ends(atoms)
        return self.types.floats(low, high, numbers, bits_of(kind), open_low, open_high)


def _ends(atoms: Sequence[Atom]) -> tuple[tuple[float, bool], tuple[float, bool]]:
    """The least and the greatest number that the bounds of *atoms* leave, each with whether it is itself left out."""
    bounds = [(atom.operator, float(atom.value)) for atom in atoms if not isinstance(atom.value, str)]
    low, open_low = max([(-math.inf, False), *((value, sign == ">") for sign, value in bounds if sign[0] == ">")])
    high, is_shut = min([(math.inf, True), *((value, sign == "<=") for sign, value in bounds if sign[0] == "<")])
    return (low, open_low), (high, not is_shut)


def _as(kind: FieldType, value: Scalar) -> Scalar:
    """A number as the field holds it."""
    if kind.base in INTEGERS and isinstance(value, float) and value == math.floor(value):
        return int(value)
    return float(value) if kind.base in FLOATS else value


def _limits(atoms: Sequence[Atom], least: float, greatest: float) -> tuple[float, float]:
    """The least and the greatest whole number that the bounds of *atoms* leave."""
    low, high = least, greatest
    for atom in atoms:
        if isinstance(atom.value, str) or not math.isfinite(atom.value):
            continue
        match atom.operator:
            case ">":
                low = max(low, math.floor(atom.value) + 1)
            case ">=":
                low = max(low, math.ceil(atom.value))
            case "<":
                high = min(high, math.ceil(atom.value) - 1)
            case "<=":
                high = min(high, math.floor(atom.value))
            case "=":
                low, high = max(low, math.ceil(atom.value)), min(high, math.floor(atom.value))
    return low, high


def _of_bool(atoms: Sequence[Atom]) -> str:
    for atom in atoms:
        if atom.operator in ("=", "!=") and isinstance(atom.value, bool):
            return f"st.just({atom.value is (atom.operator == '=')})"
    return "st.booleans()"


def _of_text(kind: FieldType, atoms: Sequence[Atom], near: Sequence[Scalar]) -> str:
    for atom in atoms:
        if atom.operator == "=" and isinstance(atom.value, str):
            return f"st.just({literal(atom.value)})"
    return call("texts", near=tuple(value for value in near if isinstance(value, str)), most=kind.length or None)


def _filtered(text: str, filters: Sequence[str]) -> str:
    return "".join([text, *(f".filter({name})" for name in filters)])


def _order(path: Path) -> tuple[tuple[str, int], ...]:
    """An array comes before its length, and that before its items."""
    return tuple(("", step + 1) if isinstance(step, int) else ("", 0) if step == LENGTH else (step, 0) for step in path)
