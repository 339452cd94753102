# SPDX-License-Identifier: Apache-2.0
"""What Python's ``isinstance`` and ``type`` say of plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow.ros.qos_profiles import PROFILES
from haros_ci.regex import regex
from haros_ci.values.abstract import NONE, Callable, ClassValue, Known, Library, Mapped, Module, Object, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: The types of plain data, and the built-in ones that each is a kind of; ``basestring`` is of Python 2.
KINDS = {
    "str": frozenset(("str", "basestring", "object")),
    "bool": frozenset(("bool", "int", "object")),
    "int": frozenset(("int", "object")),
    "float": frozenset(("float", "object")),
    "list": frozenset(("list", "object")),
    "tuple": frozenset(("tuple", "object")),
    "dict": frozenset(("dict", "object")),
    "set": frozenset(("set", "object")),
    "frozenset": frozenset(("frozenset", "object")),
}
#: The types that ``isinstance`` tests can distinguish.
TOLD = frozenset(KINDS) | {"basestring", "object"}

#: The modules of a package's messages, services and actions.
INSIDE = regex(r"\w\.(?:msg|srv|action)\.\w")
#: The kinds of values that are objects, none of which is ``None``.
OBJECTS = frozenset((Object, Sequence, Mapped, Callable, ClassValue, Module))


def is_instance(args: tuple[PassedArgument, ...]) -> Value | None:
    """What ``isinstance(value, type)``, also of several types, gives; None where it is not known."""
    if len(args) != 2:
        return None
    own, requested = _kinds(args[0].value), _type_names(args[1].value)
    if not own or not requested or not requested <= TOLD:
        return None
    reported = {not KINDS[item].isdisjoint(requested) for item in own}
    return Known(reported.pop()) if len(reported) == 1 else None


def type_of(value: Value) -> Value | None:
    """The type of plain data: ``type(value)``."""
    own = _kinds(value)
    return Library(own[0]) if len(own) == 1 else None


def same(left: Value, right: Value) -> bool | None:
    """Whether two built-in types are the same one, or an object is ``None``, which it is not; None if it is about nothing of this."""
    if (left == NONE or right == NONE) and {left.__class__, right.__class__} & OBJECTS:
        return False
    if (left == NONE and _is_there(right)) or (right == NONE and _is_there(left)):
        return False
    if isinstance(left, Library) and isinstance(right, Library) and {left.name, right.name} <= KINDS.keys():
        return left.name == right.name
    return None


def _is_there(value: Value) -> bool:
    """Whether a name of a library is known to be no ``None``: a type, a message's class, a quality of service."""
    if not isinstance(value, Library) or value.this is not None:
        return False
    last = value.name.rpartition(".")[2]
    is_profile = last.startswith("qos_profile_") and f"rmw_{last}" in PROFILES
    return value.name in KINDS or is_profile or (INSIDE.search(value.name) is not None and last[:1].isupper())


def _kinds(value: Value) -> tuple[str, ...]:
    """The types that a value may have; a list and a tuple are kept alike."""
    if isinstance(value, Known) and value != NONE:
        name = type(value.value).__name__
        return (name,) if name in KINDS else ()
    if isinstance(value, Mapped):
        return ("dict",)
    return ("list", "tuple", "set", "frozenset") if isinstance(value, Sequence) else ()


def _type_names(value: Value) -> frozenset[str]:
    """The names of the types that are asked for; empty if they are not known."""
    if isinstance(value, Library):
        return frozenset((value.name,))
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        every = [_type_names(cell.value) for cell in value.content.value]
        return frozenset().union(*every) if all(every) else frozenset()
    return frozenset()
