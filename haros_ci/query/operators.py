# SPDX-License-Identifier: Apache-2.0
"""What ``+ - * /``, comparisons and sets do with values, within bounds."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.query.fault import QueryError
from haros_ci.query.values import (
    LONGEST,
    WIDEST,
    QueryEntity,
    QueryList,
    QueryRecord,
    UnknownText,
    Value,
    kind_of,
    weight_of,
)

NUMBERS = (int, float)  # and bool


def equal(left: Value, right: Value) -> bool:
    """``==``: what is not known equals nothing but ``?``."""
    if left.__class__ is UnknownText:
        return right.__class__ is str and right == "?"
    if right.__class__ is UnknownText:
        return left.__class__ is str and left == "?"
    return bool(left == right)


def differ(left: Value, right: Value) -> bool:
    """``!=``: what is not known differs from nothing but a text that is not ``?``, written in the query or not known either.

    So ``p.type != q.type`` is true only where both types are known.
    """
    if left.__class__ is UnknownText or right.__class__ is UnknownText:
        return False
    return bool(left != right)


def ordered(sign: str) -> Callable[[Value, Value], bool]:
    """``< <= > >=``; false where a side is None, which is what a number that is not known is here."""

    def compare(left: Value, right: Value) -> bool:
        if left is None or right is None:
            return False
        if not _comparable(left, right):
            raise QueryError(f"{kind_of(left)} and {kind_of(right)} cannot be compared with {sign}")
        try:
            if sign == "<":
                return bool(left < right)
            if sign == "<=":
                return bool(left <= right)
            return bool(left > right) if sign == ">" else bool(left >= right)
        except TypeError:
            raise QueryError(f"the elements of two lists cannot be compared with {sign}") from None

    return compare


def _comparable(left: Value, right: Value) -> bool:
    if isinstance(left, NUMBERS) or isinstance(left, str):
        return isinstance(right, NUMBERS if isinstance(left, NUMBERS) else str)
    return left.__class__ is QueryList and right.__class__ is QueryList


def plus(left: Value, right: Value) -> Value:
    if isinstance(left, NUMBERS) and isinstance(right, NUMBERS):
        return narrow(left + right)
    if isinstance(left, str) and isinstance(right, str):
        return text(str(left) + str(right))
    if left.__class__ is QueryList and right.__class__ is QueryList:
        return QueryList.of((*left, *right), left.flat)
    raise _unfit("+", left, right)


def minus(left: Value, right: Value) -> Value:
    if isinstance(left, NUMBERS) and isinstance(right, NUMBERS):
        return narrow(left - right)
    if left.__class__ is QueryList and right.__class__ is QueryList:
        return difference(left, right)
    raise _unfit("-", left, right)


def times(left: Value, right: Value) -> Value:
    if isinstance(left, NUMBERS) and isinstance(right, NUMBERS):
        return narrow(left * right)
    if isinstance(left, int):
        left, right = right, left
    if isinstance(right, int) and (isinstance(left, str) or left.__class__ is QueryList):
        if right > 0 and (len(left) * right > LONGEST or weight_of(left) * right > LONGEST):
            raise QueryError(f"the product has more than {LONGEST} elements")
        return str(left) * right if isinstance(left, str) else QueryList.of(tuple(left) * right, left.flat)
    raise _unfit("*", left, right)


def divided(left: Value, right: Value) -> Value:
    """``/``: of two whole numbers the whole quotient, rounded down, as in pyflwor (``old_div``)."""
    if not (isinstance(left, NUMBERS) and isinstance(right, NUMBERS)):
        raise _unfit("/", left, right)
    if right == 0:
        raise QueryError("division by zero")
    if isinstance(left, int) and isinstance(right, int):
        return left // right
    return quotient(left, right)


def quotient(left: float, right: float) -> float:
    try:
        return left / right
    except OverflowError:
        raise QueryError("the number is too large") from None


def negated(item: Value) -> Value:
    if not isinstance(item, NUMBERS):
        raise QueryError(f"- is for numbers, not for a {kind_of(item)}")
    return -item


def narrow(number: int | float) -> int | float:
    """*number*, unless it is too large."""
    if isinstance(number, int) and number.bit_length() > WIDEST:
        raise QueryError("the number is too large")
    return number


def text(value: str) -> str:
    """*value*, unless it is too long."""
    if len(value) > LONGEST:
        raise QueryError(f"a text has more than {LONGEST} characters")
    return value


def power(base: Value, exponent: Value, modulus: Value = None) -> Value:
    if not all(isinstance(item, NUMBERS) for item in (base, exponent)):
        raise _unfit("pow", base, exponent)
    whole = isinstance(base, int) and isinstance(exponent, int) and exponent >= 0
    if modulus is not None:
        if not (whole and isinstance(modulus, int) and modulus != 0):
            raise QueryError("pow with three arguments needs whole numbers, the second not negative, the third not 0")
        return pow(base, exponent, modulus)
    if whole and base.bit_length() * exponent > WIDEST and abs(base) > 1:
        raise QueryError("the number is too large")
    try:
        result = pow(base, exponent)
    except ZeroDivisionError:
        raise QueryError("0 has no negative power") from None
    except OverflowError:
        raise QueryError("the number is too large") from None
    if isinstance(result, complex):
        raise QueryError("a negative number has no such power")
    return result


def contains(container: Value, item: Value) -> bool:
    """``item in container``."""
    if container.__class__ is QueryList:
        return item in container.members
    if isinstance(container, str):
        if not isinstance(item, str):
            raise QueryError(f"only a text can be in a text, not a {kind_of(item)}")
        return str(item) in str(container)
    if isinstance(container, QueryRecord):
        return item in container
    if isinstance(container, QueryEntity) and container.items is not None:
        return item in container.items.members or item in getattr(container, "by_name", ())
    raise QueryError(f"nothing can be in a {kind_of(container)}", -1, "write a path as in <topics/publishers>")


def union(left: QueryList, right: QueryList) -> QueryList:
    return QueryList.of(dict.fromkeys((*left, *right)), True)


def intersection(left: QueryList, right: QueryList) -> QueryList:
    """In the order of *right*, as in pyflwor."""
    return QueryList.of((item for item in right if item in left.members), True)


def difference(left: QueryList, right: QueryList) -> QueryList:
    return QueryList.of((item for item in left if item not in right.members), True)


SETS: dict[str, Callable[[QueryList, QueryList], QueryList]] = {"|": union, "&": intersection, "-": difference}
ARITHMETIC: dict[str, Callable[[Value, Value], Value]] = {"+": plus, "-": minus, "*": times, "/": divided}
COMPARISONS: dict[str, Callable[[Value, Value], bool]] = {
    "==": equal,
    "!=": differ,
    **{sign: ordered(sign) for sign in ("<", "<=", ">", ">=")},
}
SET_COMPARISONS: dict[str, Callable[[QueryList, QueryList], bool]] = {
    "is": lambda left, right: left.members == right.members,
    "is not": lambda left, right: left.members != right.members,
    "subset": lambda left, right: left.members <= right.members,
    "superset": lambda left, right: left.members >= right.members,
    "proper subset": lambda left, right: left.members < right.members,
    "proper superset": lambda left, right: left.members > right.members,
}


def _unfit(sign: str, left: Value, right: Value) -> QueryError:
    return QueryError(f"{sign} is not for {kind_of(left)} and {kind_of(right)}")
