# SPDX-License-Identifier: Apache-2.0
"""Questions about types: ``std::is_same_v<T, int>`` and a few of its kind (en.cppreference.com/w/cpp/header/type_traits).

A type is known if it is one of the language, a text, or one with a namespace; names that stand for several types (``int32_t``) are equal to none for certain.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import INTEGERS, REALS, STRINGS
from haros_ci.syntax import Type
from haros_ci.values.abstract import FALSE, TRUE, Value

#: What takes qualifiers away, which say nothing here.
_BARE = frozenset(
    f"std::{name}{end}"
    for name in ("decay", "remove_cv", "remove_reference", "remove_cvref", "remove_const")
    for end in ("_t", "::type")
)
#: Types of the language that are different from one another.
_PLAIN = frozenset(("int", "bool", "double", "float", "char", "void"))
_KINDS = {
    "std::is_integral": INTEGERS | {"bool"},
    "std::is_floating_point": REALS,
    "std::is_arithmetic": INTEGERS | REALS | {"bool"},
}


def decided(walk: Walk, frame: Frame, name: str, given: tuple[syntax.Argument, ...]) -> Value | None:
    """Whether the types *given* are what the trait *name* asks; None of another function, and where they are not known."""
    kinds = [_bare(walk, frame, item) for item in given if type(item) is Type]
    if len(kinds) != len(given) or not all(kind is not None for kind in kinds):
        return None
    if name == "std::is_same" and len(kinds) == 2:
        answer = _are_same(*(kind for kind in kinds if kind is not None))
        return None if answer is None else TRUE if answer else FALSE
    of = _KINDS.get(name)
    if of is None or len(kinds) != 1 or kinds[0] is None or kinds[0].marks:
        return None
    return TRUE if kinds[0].name in of else FALSE


def _bare(walk: Walk, frame: Frame, kind: Type) -> Type | None:
    """*kind* as it is resolved, without qualifiers; None if it is not known."""
    found = walk.type_in(kind, frame)
    while found.name in _BARE and (inner := found.of(0)) is not None:
        found = inner.bare() if "*" not in inner.marks else inner
    is_known = found.name in INTEGERS | REALS | STRINGS | _PLAIN or walk.class_of(found.name, frame.source) is not None
    is_qualified = "::" in found.name and found.name.partition("::")[0] not in frame.templates
    return found if (is_known or is_qualified) and "decltype" not in found.name and found.name not in _BARE else None


def _are_same(one: Type, other: Type) -> bool | None:
    if one.name == other.name:
        return True if (one.arguments, one.marks) == (other.arguments, other.marks) else None
    numbers = INTEGERS | REALS | {"bool", "char"}
    if one.name in numbers and other.name in numbers:
        return False if one.name in _PLAIN and other.name in _PLAIN else None
    return False if "*" not in one.marks + other.marks and not (one.name in STRINGS and other.name in STRINGS) else None
