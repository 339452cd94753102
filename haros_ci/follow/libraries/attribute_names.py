# SPDX-License-Identifier: Apache-2.0
"""Python: attributes whose names are computed: ``dir``, ``inspect.getmembers``, ``getattr`` with a name that is known in part."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

from haros_ci.follow import comprehensions, members, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Class
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    ClassValue,
    Known,
    Mapped,
    Object,
    Pointer,
    Sequence,
    Text,
    Value,
    join,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Methods of one object that a name that is known in part may mean.
MOST = 50
#: Classes that a class is derived from.
DEEP = 100
#: Why an attribute that ``setattr`` makes is not known on the paths that do not come there.
UNSET = "it is not set before"
#: What stands for ``x.__dict__.update`` and ``vars(x).update``, and why an attribute is not known after it.
UPDATE, UPDATED = "[update]", "it may be one of attributes that are not known"
#: The function, and what of it keeps methods alone (docs.python.org/3/library/inspect.html#inspect.getmembers).
MEMBERS = "inspect.getmembers"
FUNCTIONS = frozenset(("inspect.ismethod", "inspect.isfunction", "inspect.isroutine", "callable"))


def directory(walk: Walk, value: Value) -> Value | None:
    """``dir(value)`` of an object or class of the workspace: what its classes here define and it has been given, sorted.

    One more name, which is not known, stands for those with ``__`` at both ends and those of base classes that are not here.
    """
    names = _names(walk, value)
    if names is None:
        return None
    held: tuple[Value, ...] = (*map(Known, names), comprehensions.OTHER_NAMES)
    return Sequence(Cell(tuple(map(Cell, held))))


def pairs(walk: Walk, value: Value, predicate: Value | None, frame: Frame) -> Value | None:
    """``inspect.getmembers``: the names and values of ``dir(value)``; of some *predicate* the methods alone."""
    kind = getattr(predicate, "name", "")
    if predicate is not None and kind not in FUNCTIONS:
        return None
    found = [(name, members.attribute(walk, value, name, frame)) for name in _names(walk, value) or ()]
    kept = [(name, held) for name, held in found if predicate is None or isinstance(held, Callable)]
    rows = (Sequence(Cell((Cell(Known(name)), Cell(held)))) for name, held in kept)
    return Sequence(Cell(tuple(Cell(row) for row in rows))) if found else None


def possible(walk: Walk, value: Value, name: Value, default: tuple[Value, ...], frame: Frame) -> Value | None:
    """``getattr(value, name)`` with a *name* that is known in part: one of the methods whose names fit, or the *default*; None if none fits."""
    if not isinstance(name, Text):
        return None
    first, last = name.parts[0], name.parts[-1]
    start, end = (part if isinstance(part, str) else "" for part in (first, last))
    fitting = [item for item in _names(walk, value) or () if item.startswith(start) and item.endswith(end)]
    found = [members.attribute(walk, value, item, frame) for item in fitting if len(item) >= len(start) + len(end)]
    called = [item for item in found if isinstance(item, Callable)]
    return reduce(join, (*called, *default)) if called and len(called) == len(found) <= MOST else None


def assigned(walk: Walk, owner: Value, name: Value, value: Value, frame: Frame) -> Value | None:
    """``setattr(owner, name, value)`` with a computed *name* that is known, of an object of the workspace; None of anything else."""
    this = owner.cell.value if isinstance(owner, Pointer) else owner
    if not isinstance(this, Object) or this.definition is None or not isinstance(name, Known) or name.kind is not str:
        return None
    text = name.of(str)
    if methods.method_of(walk, this, text) is not None:  # a property, or a method of this object alone
        return None
    cell = members.own_cell(walk, this, text, frame)
    if cell is None:
        cell = this.fields[text] = Cell(walk.opaque(UNSET, frame))
    walk.state.write(cell, value)
    return NONE


def updated(walk: Walk, owner: Value, args: tuple[PassedArgument, ...], frame: Frame) -> Value:
    """``owner.__dict__.update(…)``: attributes of an object of the workspace are set; where it is not known which, none is known."""
    this = owner.cell.value if isinstance(owner, Pointer) else owner
    given = [_given(argument) for argument in args]
    pairs = None if None in given else {name: value for one in given if one for name, value in one.items()}
    if not isinstance(this, Object) or this.definition is None:
        return NONE
    for name, cell in list(this.fields.items()) if pairs is None else ():
        if isinstance(cell.value, (Known, Text)) and name.isidentifier():
            walk.state.write(cell, walk.opaque(UPDATED, frame, None, cell.type))
    for name, value in (pairs or {}).items():
        assigned(walk, this, Known(name), value, frame)
    return NONE


def _given(argument: PassedArgument) -> dict[str, Value] | None:
    """The attributes that one argument of an update sets; None if they are not known."""
    if argument.keyword.startswith("*"):
        return None
    return {argument.keyword: argument.value} if argument.keyword else _pairs(argument.value)


def _pairs(value: Value) -> dict[str, Value] | None:
    """The entries of a dictionary with texts for keys; None if they are not known."""
    if isinstance(value, Mapped) and isinstance(value.content.value, dict):
        entries: dict[object, Value] = {key: cell.value for key, cell in value.content.value.items()}
    elif isinstance(value, Known) and isinstance(value.value, dict):
        entries = {key: Known(item) for key, item in value.value.items()}
    else:
        return None
    return {str(key): item for key, item in entries.items()} if all(isinstance(key, str) for key in entries) else None


def _names(walk: Walk, value: Value) -> list[str] | None:
    """The sorted names of an object or class of the workspace, without those with ``__`` at both ends; None of anything else."""
    if isinstance(value, Object) and value.definition is not None and value.definition[0].separator == ".":
        own, owner = set(value.fields), value.definition
    elif isinstance(value, ClassValue) and value.source.separator == ".":
        own, owner = set(), (value.source, value.definition)
    else:
        return None
    waiting, seen = [owner], list[Class]()
    while waiting and len(seen) < DEEP:
        source, definition = waiting.pop()
        if any(definition is known for known in seen):
            continue
        seen.append(definition)
        own |= {field.name for field in definition.fields}
        own |= {
            function.name.rpartition(".")[2]
            for function in source.program.functions
            if function.owner == definition.name
        }
        owners = (methods.python_class(walk, base, source) for base in definition.bases)
        waiting += [found for found in owners if found is not None]
    return sorted(name for name in own if name.isidentifier() and not (name.startswith("__") and name.endswith("__")))
