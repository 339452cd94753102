# SPDX-License-Identifier: Apache-2.0
"""Going through programs, whatever they are made of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias, TypeVar, Union, cast

import msgspec

from haros_ci.syntax import expressions, program, statements
from haros_ci.syntax.node import Record

#: A part of a program, several, or none.
Part: TypeAlias = Union[Record, "tuple[Part, ...]", None]
P = TypeVar("P", bound=Part)

_LEAVES = frozenset(("str", "int", "bool", "int | float", "tuple[str, ...]", "tuple[tuple[int, int, str], ...]"))
#: For each class its fields that hold parts.
_HOLDING: dict[type, tuple[str, ...]] = {
    kind: tuple(name for name in kind.__struct_fields__ if kind.__annotations__[name] not in _LEAVES)
    for module in (expressions, statements, program)
    for kind in vars(module).values()
    if isinstance(kind, type) and issubclass(kind, Record) and kind.__struct_fields__ and kind is not program.Program
}


def below(part: Part) -> list[Record]:
    """What *part* is made of directly, in the order of its fields; of several parts, these."""
    found: list[Record] = []
    if isinstance(part, tuple):
        _gather(part, found)
    elif part is not None:
        for name in _HOLDING.get(part.__class__, ()):
            value: Part = getattr(part, name)
            if isinstance(value, tuple):
                _gather(value, found)
            elif value is not None:
                found.append(value)
    return found


def _gather(parts: Iterable[Part], found: list[Record]) -> None:
    for part in parts:
        if isinstance(part, tuple):
            _gather(part, found)
        elif part is not None:
            found.append(part)


def everything(part: Part) -> Iterator[Record]:
    """*part* and all that it is made of, the last first."""
    waiting = below((part,))
    while waiting:
        node = waiting.pop()
        yield node
        waiting += below(node)


def preorder(part: Part) -> Iterator[Record]:
    """The same, the outermost and the first first."""
    waiting = below((part,))[::-1]
    while waiting:
        node = waiting.pop()
        yield node
        waiting += reversed(below(node))


def placeless(part: Part) -> Part:
    """*part* without the lines and columns of its calls."""
    if isinstance(part, tuple):
        return tuple([placeless(item) for item in part])
    if part is None:
        return None
    values = {name: placeless(getattr(part, name)) for name in _HOLDING.get(part.__class__, ())}
    if isinstance(part, expressions.Call):
        return msgspec.structs.replace(part, **values, line=0, column=0)
    return msgspec.structs.replace(part, **values) if values else part


def without(part: P, statement: statements.Statement) -> P:
    """*part* with an empty block in place of one statement in it; the same object where that is not in it."""
    return cast("P", _without(part, statement))


def _without(part: Part, statement: statements.Statement) -> Part:
    if part is statement:
        return statements.Nested(())
    if isinstance(part, tuple):
        inner = tuple([_without(item, statement) for item in part])
        return part if all(one is other for one, other in zip(part, inner, strict=True)) else inner
    if part is None:
        return None
    values = {name: getattr(part, name) for name in _HOLDING.get(part.__class__, ())}
    changed = {name: _without(value, statement) for name, value in values.items()}
    if all(changed[name] is values[name] for name in values):
        return part
    return msgspec.structs.replace(part, **changed)
