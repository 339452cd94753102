# SPDX-License-Identifier: Apache-2.0
"""Questions about types: ``std::is_same_v<T, int>`` and a few of its kind (en.cppreference.com/w/cpp/header/type_traits).

A type is known if it is one of the language, a text, a message, or a class of the workspace; names that stand for several types (``int32_t``) are equal to none for certain.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import INTEGERS, REALS, STRINGS
from haros_ci.regex import regex
from haros_ci.syntax import Type
from haros_ci.values.abstract import FALSE, TRUE, Value

#: What takes qualifiers away, which say nothing here.
_BARE = frozenset(
    f"std::{name}{end}"
    for name in ("decay", "remove_cv", "remove_reference", "remove_cvref", "remove_const")
    for end in ("_t", "::type")
)
#: Numbers, and those that are different from one another.
_NUMBERS = INTEGERS | REALS | {"bool"}
_PLAIN = frozenset(("int", "bool", "double", "float", "char"))
#: Messages, services and actions, by the names of packages as they are given (REP 144), or by the namespaces of ROS 2.
_MESSAGE = regex(r"(?:\w+::(?:msg|srv|action)|\w+_msgs|\w+_srvs)::\w+")
_KINDS = {
    "std::is_integral": INTEGERS | {"bool"},
    "std::is_floating_point": REALS,
    "std::is_arithmetic": _NUMBERS,
}


def decided(walk: Walk, frame: Frame, name: str, given: tuple[syntax.Argument, ...]) -> Value | None:
    """Whether the types *given* are what the trait *name* asks; None of another function, and where they are not known."""
    kinds = [_bare(walk, frame, item) for item in given if type(item) is Type]
    answer: bool | None = None
    if name == "std::is_same" and len(kinds) == len(given) == 2:
        answer = _are_same(walk, frame, kinds[0], kinds[1])
    elif name in _KINDS and len(kinds) == len(given) == 1 and _is_certain(walk, frame, kinds[0]):
        answer = kinds[0].name in _KINDS[name]
    return None if answer is None else TRUE if answer else FALSE


def _bare(walk: Walk, frame: Frame, kind: Type) -> Type:
    """*kind* as it is resolved, without qualifiers."""
    found = walk.type_in(kind, frame)
    while found.name in _BARE and (inner := found.of(0)) is not None:
        found = inner.bare() if "*" not in inner.marks else inner
    return found


def _is_certain(walk: Walk, frame: Frame, kind: Type) -> bool:
    """Whether a type is known for what it is: the name of any other may stand for a number, or for another type."""
    if kind.marks:
        return False
    is_plain = kind.name in _NUMBERS or kind.name in STRINGS or kind.name == "void"
    return is_plain or _MESSAGE.fullmatch(kind.name) is not None or walk.class_of(kind.name, frame.source) is not None


def _are_same(walk: Walk, frame: Frame, one: Type, other: Type) -> bool | None:
    if not (_is_certain(walk, frame, one) and _is_certain(walk, frame, other)):
        return None
    if one.name == other.name:
        return True if one.arguments == other.arguments else None
    if one.name in _NUMBERS and other.name in _NUMBERS:
        return False if one.name in _PLAIN and other.name in _PLAIN else None
    return None if one.name in STRINGS and other.name in STRINGS else False
