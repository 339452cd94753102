# SPDX-License-Identifier: Apache-2.0
"""Interface types as strategies: a function of Python for each, and what a value at a path of a message can be."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.behaviour.messages import FLOATS, INTEGERS, TEXTS, Constant, Message, Messages
from haros_ci.interfaces.definitions import FieldType, field_type
from haros_ci.monitor_files.literals import literal
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.test_files.names import identifier

#: Types that one message is made of, and how deep they lie in each other.
MOST_TYPES, DEEPEST = 200, 12
#: Items of an array of a fixed size.
MOST_ITEMS = 2_000
#: The way to a value: names of fields, indices; ``LENGTH`` at its end is the number of items (``property_tests/messages.py``).
Path = tuple[str | int, ...]
LENGTH = "len()"

_STEP = regex(r"\.?(?P<name>[A-Za-z_]\w*)|\[(?P<index>\d{1,6})\]", re.ASCII)
_LEN = regex(r"len\((?P<inner>[^()]*)\)\Z")
_TIME = ("time", "duration")


class TooLarge(ValueError):
    """A type that no test makes messages of; the text says why."""


def path_of(term: str) -> Path | None:
    """The path that a term of a condition (``a.b[0]``, ``len(a)``) means; None for any other."""
    counted = _LEN.match(term)
    if counted is not None:
        inner = path_of(counted["inner"])
        return None if inner is None else (*inner, LENGTH)
    found: list[str | int] = []
    at = 0
    while at < len(term):
        step = _STEP.match(term, at)
        if step is None or (at == 0) is (step[0][0] in ".["):
            return None
        found.append(step["name"] if step["index"] is None else int(step["index"]))
        at = step.end()
    return tuple(found) or None


@dataclass(slots=True)
class Types:
    """The functions for the types of one file. With *non_finite* floating point numbers can be infinite, or NaN."""

    messages: Messages
    ros: int
    non_finite: bool = False
    names: dict[str, str] = field(default_factory=dict)
    taken: set[str] = field(default_factory=set)
    texts: list[str] = field(default_factory=list)

    def function(self, name: str, depth: int = 0) -> str:
        """The name of the function for the type ``pkg/T``, which is written where it is not yet; TooLarge if there can be none."""
        if name in self.names:
            return self.names[name]
        found = self.messages.named(name)
        if found is None:
            raise TooLarge(f"the definition of {name} is not known")
        if depth > DEEPEST or len(self.names) >= MOST_TYPES:
            raise TooLarge(f"{name} is made of too many types")
        fields = [
            f"        {literal(key)}: {self.strategy(kind, found, depth)},\n" for key, kind in self._fields(found)
        ]
        made = identifier(name, self.taken)
        self.names[name] = made
        body = f"{{\n{''.join(fields)}    }}" if fields else "{}"
        self.texts.append(f"def {made}():\n    return message({body})\n")
        return made

    def _fields(self, found: Message) -> Iterator[tuple[str, str]]:
        return ((name, kind) for name, kind in found.fields.items())

    def strategy(self, written: str, owner: Message, depth: int = 0) -> str:
        """The expression for a field of *owner* of the type that is *written*."""
        kind = field_type(written)
        if kind is None:
            raise TooLarge(f"{owner.name} has a field of the type {written}, which is not known")
        near = self.constants(kind, owner)
        if owner.name == "std_msgs/Header" and kind.base != "string":  # rospy counts, and the time is that of sending
            return (
                "st.just(0)" if kind.base not in ("time", "builtin_interfaces/Time") else f"st.just({self._no_time()})"
            )
        item = self.item(kind, near, depth)
        match kind.form:
            case "":
                return item
            case "array" if kind.size > MOST_ITEMS:
                raise TooLarge(f"{owner.name} has an array of {kind.size} items")
            case "array":
                return f"array({item}, {kind.size}, {kind.size})"
            case "bounded":
                return f"array({item}, 0, {min(kind.size, 4)})"
            case _:
                return f"array({item})"

    def _no_time(self) -> str:
        return literal({"secs": 0, "nsecs": 0} if self.ros == 1 else {"sec": 0, "nanosec": 0})

    def item(self, kind: FieldType, near: tuple[float | str, ...] = (), depth: int = 0) -> str:
        """The expression for one value of this kind."""
        base = kind.base
        if kind.is_nested:
            return f"{self.function(base, depth + 1)}()"
        if base == "bool":
            return "st.booleans()"
        if base in INTEGERS:
            return call("whole", *map(literal, self.limits(base)), near=near)
        if base in FLOATS:
            return self.floats(-math_inf, math_inf, near, bits_of(kind))
        if base in TEXTS:
            return call("texts", near=near, most=kind.length or None)
        if base in _TIME and self.ros == 1:
            return "times()" if base == "time" else "times(False)"
        raise TooLarge(f"the type {base} is not known")

    def floats(
        self,
        low: float,
        high: float,
        near: tuple[float | str, ...],
        bits: int,
        open_low: bool = False,
        open_high: bool = False,
    ) -> str:
        """The expression for floating point numbers between these ends."""
        made = call(
            "floats",
            *(() if low == -math_inf and high == math_inf else (literal(low), literal(high))),
            near=near,
            bits=32 if bits == 32 else None,
            open_low=open_low or None,
            open_high=open_high or None,
        )
        return f"({made} | non_finite())" if self.non_finite and (low == -math_inf or high == math_inf) else made

    def limits(self, base: str) -> tuple[int, int]:
        """The integers of a type; a byte is signed in ROS 1 alone."""
        if base == "byte":
            return (-128, 127) if self.ros == 1 else (0, 255)
        return INTEGERS[base]

    def constants(self, kind: FieldType, owner: Message) -> tuple[float | str, ...]:
        """The constants of the message that have the type of a field: often the values that it is meant to have."""
        if kind.base == "bool" or kind.is_nested:
            return ()
        values = [Constant(base, text).value for base, text in owner.constants.values() if base == kind.base]
        return tuple(dict.fromkeys(value for value in values if value is not None and not isinstance(value, bool)))[:32]

    def at(self, message: Message, path: Path) -> FieldType | None:
        """The type of the value that *path* leads to; None if that is not known, or no single value."""
        here: Message | None = message
        kind: FieldType | None = None
        for step in path:
            if isinstance(step, int):
                if kind is None or not kind.form or (kind.form == "array" and step >= kind.size):
                    return None
                kind = FieldType(kind.base, kind.length)
            else:
                if here is None or step not in here.fields:
                    return None
                kind = field_type(here.fields[step])
            here = self.messages.named(kind.base) if kind is not None and kind.is_nested and not kind.form else None
        return kind


math_inf = float("inf")


def bits_of(kind: FieldType) -> int:
    return 32 if kind.base == "float32" else 64


def call(name: str, *arguments: str, **named: object) -> str:
    """A call with these expressions, and these values by name where they are not None, () or False."""
    given = [f"{key}={literal(value)}" for key, value in named.items() if value not in (None, (), False)]
    return f"{name}({', '.join([*arguments, *given])})"


Near = Mapping[Path, tuple[float | str, ...]]
