# SPDX-License-Identifier: Apache-2.0
"""What predicates say of messages, held against definitions: which field is meant, of which type, with which values.

Definitions are those of the workspace, and of the packages that every distribution has (``interfaces/common.py`` states their source).
Where one is not known for certain, nothing is said.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Union

from haros_ci.behaviour import kinds
from haros_ci.behaviour.tree import Expression, Field, Item, Variable
from haros_ci.interfaces.definitions import Definitions, FieldType, field_type
from haros_ci.interfaces.structs import Structs
from haros_ci.records import dataclass

#: The integers that each type holds. A byte is signed in ROS 1 and not in ROS 2, so it is taken as both.
INTEGERS: Mapping[str, tuple[int, int]] = {
    **{f"int{bits}": (-(1 << bits - 1), (1 << bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, (1 << bits) - 1) for bits in (8, 16, 32, 64)},
    "char": (0, 255),
    "byte": (-128, 255),
}
FLOATS = frozenset(("float32", "float64"))
TEXTS = frozenset(("string", "wstring"))


@dataclass(frozen=True, slots=True)
class Message:
    """A definition: its *name* (``pkg/T``), the types of its *fields*, and its *constants* with their types and values."""

    name: str
    fields: Mapping[str, str]
    constants: Mapping[str, tuple[str, str]]

    @property
    def names(self) -> tuple[str, ...]:
        return (*self.fields, *self.constants)


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of a definition: its type, and its value as it is written."""

    type: str
    written: str

    @property
    def value(self) -> bool | int | float | str | None:
        """None if it is not known."""
        if self.type in TEXTS:
            return self.written.strip().strip("\"'")
        if self.type == "bool":
            return {"true": True, "1": True, "false": False, "0": False}.get(self.written.strip().lower())
        try:
            number = int(self.written, 0) if self.type in INTEGERS else float(self.written)
        except ValueError:
            return None
        low, high = INTEGERS.get(self.type, (-math.inf, math.inf))
        return number if low <= number <= high else None


@dataclass(frozen=True, slots=True)
class Missing:
    """*field* asks *message* for what it does not have."""

    field: Field
    message: Message


Typed = Union[Message, FieldType, Constant, Missing, None]


class Messages:
    """The definitions that nodes of one ROS version see."""

    def __init__(self, known: Definitions) -> None:
        self.known = known
        self.structs = Structs(known)
        self.made: dict[str, Message | None] = {}

    def named(self, name: str) -> Message | None:
        """The message ``pkg/T``; None if it is not known for certain."""
        if name not in self.made:
            self.made[name] = self._find(name)
        return self.made[name]

    def _find(self, name: str) -> Message | None:
        package, _, rest = name.partition("/")
        short = rest.rpartition("/")[2]
        struct = self.structs.named(f"{package}.msg.{short}")
        found = self.known.find("msg", f"{package}/{short}")
        if struct is None or found is None:
            return None
        constants = {
            section.name: (section.type, section.value) for section in found.sections[0] if section.is_constant
        }
        if frozenset(constants) != struct.constants:  # not the same ones in all distributions
            return None
        return Message(f"{package}/{short}", struct.fields, constants)


@dataclass(frozen=True, slots=True)
class Scene:
    """What is known of one event: the message of its topic, and those of the aliases that it can use (None where they are not known)."""

    messages: Messages
    own: Message | None
    aliases: Mapping[str, Message | None]

    def typed(self, expression: Expression) -> Typed:
        """What a field, an item or an alias stands for; None if that is not known."""
        match expression:
            case Variable(name=name):
                return self.aliases.get(name)
            case Item(base=base):
                return self._nested(self.typed(base))
            case Field(base=base, name=name):
                owner = self.own if base is None else self.typed(base)
                return self._member(owner, expression, name) if isinstance(owner, Message) else None
            case _:
                return None

    def _member(self, owner: Message, field: Field, name: str) -> Typed:
        if name in owner.constants:
            return Constant(*owner.constants[name])
        if name not in owner.fields:
            return Missing(field, owner)
        kind = field_type(owner.fields[name])
        return self.messages.named(kind.base) if kind is not None and kind.is_nested and not kind.form else kind

    def _nested(self, array: Typed) -> Typed:
        if not isinstance(array, FieldType) or not array.form:
            return None
        return self.messages.named(array.base) if array.is_nested else FieldType(array.base, array.length)


def kind_of(typed: Typed) -> int | None:
    """The kind of value; None if it is not known."""
    match typed:
        case Message():
            return kinds.MESSAGE
        case Constant(type=base):
            return _kind(base)
        case FieldType(form=form, base=base):
            return kinds.ARRAY if form else _kind(base)
        case _:
            return None


def _kind(base: str) -> int | None:
    if base == "bool":
        return kinds.BOOL
    if base in TEXTS:
        return kinds.TEXT
    return kinds.NUMBER if base in INTEGERS or base in FLOATS else None
