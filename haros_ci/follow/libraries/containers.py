# SPDX-License-Identifier: Apache-2.0
"""Models of C++ containers: vectors and maps by their methods."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import alternatives, assignments, construct, conversions, copies, indexing
from haros_ci.follow.frames import Frame, of_element
from haros_ci.follow.libraries import elements, ordering, tuples
from haros_ci.follow.walk import Walk
from haros_ci.index.types import is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    LIST_LIMIT,
    NONE,
    Cell,
    Choice,
    Elements,
    Known,
    Mapped,
    Object,
    Opaque,
    Partial,
    Sequence,
    Text,
    Value,
)
from haros_ci.values.cells import Content
from haros_ci.values.state import certain, last, possible

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument


#: Methods of maps that add an entry.
PUTTING = ("insert", "emplace", "try_emplace", "insert_or_assign")
#: Methods that add elements.
ADDING = frozenset(("insert", "emplace"))


def _added(
    walk: Walk, receiver: Sequence, name: str, args: tuple[PassedArgument, ...], inner: Type | None
) -> tuple[Cell, ...] | Opaque | None:
    """A set's content with one more element, or a list's or set's with those of a range; None if that is not known."""
    cells = receiver.content.value
    is_set = receiver.type is not None and receiver.type.name == "std::set"
    held = certain(cells)
    values = [argument.value for argument in args]
    if is_set and len(args) == 1 and name in ("insert", "emplace") and isinstance(values[0], Known):
        new = [conversions.converted(values[0], inner) if inner is not None else values[0]]
    elif len(args) == (2 if is_set else 3) and name == "insert" and (is_set or values[0] is receiver.end):
        found = _range(values[-2], values[-1])
        if found is None or (is_set and not all(isinstance(value, Known) for value in found)):
            return None
        new = found
    else:
        return None
    if is_set:
        there = [cell.value.value for cell in held if isinstance(cell.value, Known)]
        new = [fromkey for fromkey in dict.fromkeys(new) if isinstance(fromkey, Known) and fromkey.value not in there]
    if len(held) + len(new) > LIST_LIMIT:
        return None
    whole = (*held, *(Cell(value, inner) for value in new))
    return whole if isinstance(cells, tuple) else Partial(cells.reason, cells.location, cells.type, whole)


def _grown(
    walk: Walk, frame: Frame, cells: Elements, name: str, args: tuple[PassedArgument, ...], inner: Type | None
) -> Opaque:
    """The content of a list that is not known with one more element: what is added behind the others is the last."""
    result = walk.opaque("the list is built in a way that is not followed", frame)
    some, end = certain(cells), None
    if not isinstance(cells, tuple) and name in ("push_back", "emplace_back") and len(args) == 1:
        end = Cell(conversions.converted(copies.copied(walk, args[0].value, inner), inner), inner)
        some = (*some, end)[-LIST_LIMIT:]
    others = possible(cells)
    return Partial(result.reason, result.location, result.type, some, others, end) if some or others else result


def _range(first: Value, end: Value) -> list[Value] | None:
    """The elements from the beginning to the end of one list or set."""
    if not isinstance(first, Object) or not isinstance(end, Object) or end.name != iterators.END:
        return None
    owners = [object_.fields["[of]"].value for object_ in (first, end) if "[of]" in object_.fields]
    content = owners[0].content.value if len(owners) == 2 and isinstance(owners[0], Sequence) else None
    if owners[0] is not owners[-1] or not isinstance(content, tuple) or iterators.position(first):
        return None
    return [cell.value for cell in content]


def sequence(walk: Walk, frame: Frame, receiver: Sequence, name: str, args: tuple[PassedArgument, ...]) -> Value | None:  # noqa: C901 - one branch for each method
    ordering.put(walk, receiver)
    cells = receiver.content.value
    known = isinstance(cells, tuple)
    held = cells if isinstance(cells, tuple) else ()
    inner = receiver.type.of(0) if receiver.type is not None else None
    args = elements.constructed(walk, frame, inner, name, args)
    if name in ADDING and (added := _added(walk, receiver, name, args, inner)) is not None:
        walk.state.write(receiver.content, added)
        return NONE
    if name in ("push_back", "emplace_back", "insert", "push_front", "emplace_front", "emplace"):
        value: Value = args[0].value if len(args) == 1 else NONE
        if known and name in ("push_back", "emplace_back") and len(args) == 1 and len(held) < LIST_LIMIT:
            value = conversions.converted(copies.copied(walk, value, inner), inner)
            walk.state.write(receiver.content, (*held, Cell(value, inner)))
        elif known and name == "emplace_back" and inner is not None and len(held) < LIST_LIMIT:
            value = construct.of_template(walk, frame, inner, args, Location(frame.source.path))
            walk.state.write(receiver.content, (*held, Cell(value, inner)))
        else:
            walk.state.write(receiver.content, _grown(walk, frame, cells, name, args, inner))
        if name not in ("emplace_back", "emplace_front"):
            return NONE
        return value if isinstance(value, Object) else walk.opaque("an element of a list", frame, None, inner)
    if name == "clear":
        walk.state.write(receiver.content, ())
        return NONE
    if name in ("resize", "assign"):
        if args and isinstance(args[0].value, Known) and isinstance(args[0].value.value, int) and name == "resize":
            expected = args[0].value.value
            if known and 0 <= expected <= 1000:
                kind, place = inner or syntax.Type(""), Location(frame.source.path)
                made = [
                    Cell(
                        copies.copied(walk, args[1].value, inner)
                        if len(args) > 1
                        else construct.of_template(walk, frame, kind, (), place),
                        inner,
                    )
                    for _ in range(expected - len(held))
                ]
                walk.state.write(receiver.content, (*held[:expected], *made))
                return NONE
            if 0 <= expected <= 1000:  # so many, whatever they are
                unknown: Value = walk.opaque("an element that is not known", frame, None, inner)
                walk.state.write(receiver.content, tuple(Cell(unknown, inner) for _ in range(expected)))
                return NONE
        walk.state.write(receiver.content, walk.opaque("a list of unknown length", frame))
        return NONE
    if name in ("size", "empty", "length"):
        if known:
            return Known(not held) if name == "empty" else Known(len(held))
        return walk.opaque("the length of a list that is not known", frame, None, syntax.Type("int"))
    if name in ("front", "back", "at"):
        if held and name != "at":
            outer = held[0 if name == "front" else -1]
            return alternatives.looked_up(walk, frame, outer).value if walk.look_ups else outer.value
        if name == "back" and (end := last(cells)) is not None:
            return end.value
        if name == "at" and args:
            cell = assignments.element(walk, frame, receiver, args[0].value)
            if cell is not None:
                return cell.value
        return walk.opaque(of_element(args[0].value if args else None), frame, None, inner)
    if name in ("begin", "end", "cbegin", "cend", "rbegin", "rend"):
        if name.endswith("end") or (known and not held):
            return iterators.end_of(receiver)
        if known and name != "rbegin":
            return iterators.at(receiver, 0)
        return Object(iterators.ITERATOR, fields={"[of]": Cell(receiver)})
    if name == "pop_back" and held:
        walk.state.write(receiver.content, held[:-1])
        return NONE
    if name == "swap" and args and isinstance(args[0].value, Sequence):
        other = args[0].value.content
        walk.state.write(receiver.content, other.value)
        walk.state.write(other, cells)
        return NONE
    return None


def _parts(value: Value) -> list[Value]:
    """The key and the value of a pair, or of what stands in braces."""
    if isinstance(value, Object) and value.name == tuples.PAIR:
        return [cell.value for number in range(2) if (cell := tuples.part(value, number)) is not None]
    cells = value.content.value if isinstance(value, Sequence) else ()
    return [cell.value for cell in cells] if isinstance(cells, tuple) else []


def _entry(walk: Walk, args: tuple[PassedArgument, ...]) -> tuple[object, Value] | None:
    """The key and the value of an entry that a map is given; None if they are not known, nested braces, or one of several plug-ins."""
    values = _parts(args[0].value) if len(args) == 1 else [argument.value for argument in args]
    if len(values) != 2 or not isinstance(values[0], Known) or not issubclass(values[0].kind, (str, int)):
        return None
    is_braces = isinstance(values[1], Sequence) and values[1].type is None
    is_any = isinstance(values[1], Choice) and alternatives.are(walk, values[1].options)
    return None if is_braces or is_any else (values[0].value, values[1])


def mapped(
    walk: Walk, frame: Frame, receiver: Mapped, name: str, args: tuple[PassedArgument, ...], kind: Type | None = None
) -> Value | None:
    """A method of a map, of the type *kind* where that is known; None if there is no model of it."""
    ordering.put_before(walk, receiver, name)
    pairs = receiver.content.value
    args = elements.mapped(walk, frame, kind, name, args)
    if name in ("size", "empty", "count") and isinstance(pairs, dict):
        if name == "count":
            key = args[0].value if args else NONE
            return (
                Known(int(key.value in pairs)) if isinstance(key, Known) else walk.opaque("a key is not known", frame)
            )
        return Known(not pairs) if name == "empty" else Known(len(pairs))
    if name == "swap" and args and isinstance(args[0].value, Mapped):
        other = args[0].value.content
        walk.state.write(receiver.content, other.value)
        walk.state.write(other, pairs)
        return NONE
    if name in PUTTING and isinstance(pairs, dict):
        entry = _entry(walk, args)
        if entry is not None and len(pairs) < LIST_LIMIT:
            fresh = {entry[0]: Cell(entry[1])}
            walk.state.write(receiver.content, {**pairs, **fresh} if name == "insert_or_assign" else {**fresh, **pairs})
            return NONE
    if name in ("erase", "clear", "swap", *PUTTING):
        walk.state.write(receiver.content, {} if name == "clear" else walk.opaque("a map that is changed", frame))
        return NONE
    if name in ("begin", "cbegin", "end", "cend") and isinstance(pairs, dict):
        return iterators.end_of(receiver) if name.endswith("end") else iterators.at(receiver, 0)
    if name == "find" and len(args) == 1:
        return iterators.found(receiver, args[0].value)
    if name == "at" and args:
        cell = assignments.element(walk, frame, receiver, args[0].value)
        if cell is None and not isinstance(args[0].value, Known) and isinstance(pairs, dict) and pairs:
            return indexing.any_of(pair.value for pair in pairs.values())
        return cell.value if cell is not None else walk.opaque("an entry that is not known", frame)
    return None


#: Functions that put another value into their first argument.
SWAPS = frozenset(("std::swap", "boost::swap", "swap", "std::exchange", "boost::exchange"))


def swapped(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """``swap(a, b)`` of texts, numbers, pointers and whole containers, ``std::exchange(a, b)`` of texts and numbers; None for all else."""
    one, other = args[0].cell, args[1].cell
    plain = (Known, Text, Choice, Opaque)
    if name.endswith("exchange"):
        if one is None or not isinstance(one.value, plain) or not isinstance(args[1].value, plain):
            return None
        before = one.value
        walk.state.write(one, conversions.converted(args[1].value, one.type))
        return before
    if one is None or other is None:
        return None
    is_plain = isinstance(one.value, plain) and isinstance(other.value, plain)
    if is_plain or (_is_pointer(one) and _is_pointer(other)):
        return swap(walk, one, other)
    if isinstance(one.value, Sequence) and isinstance(other.value, Sequence):
        return swap(walk, one.value.content, other.value.content)
    if isinstance(one.value, Mapped) and isinstance(other.value, Mapped):
        return swap(walk, one.value.content, other.value.content)
    return None


def _is_pointer(cell: Cell) -> bool:
    return cell.type is not None and (is_smart_pointer(cell.type) or "*" in cell.type.marks)


def swap(walk: Walk, one: Cell[Content], other: Cell[Content]) -> Value:
    """Let two variables hold what the other one has held."""
    before = one.value
    walk.state.write(one, other.value)
    walk.state.write(other, before)
    return NONE
