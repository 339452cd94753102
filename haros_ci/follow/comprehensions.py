# SPDX-License-Identifier: Apache-2.0
"""Python's comprehensions, map, filter and dict: lists and dictionaries made of the elements of others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, calls, conversions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import LIST_LIMIT, NONE, Callable, Cell, Known, Mapped, Opaque, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Longer lists are not gone through; inside loops and other comprehensions they are shorter.
LONGEST = 256
LONGEST_INSIDE = 32
#: What stands for an element that is in the list if its condition holds.
MAYBE = Opaque("whether it is in the list")
#: What stands for the names of attributes that are not here; a guard that is not seen to let one through keeps them out.
OTHER_NAMES = Opaque("it may be the name of any other attribute", type=syntax.Type("str"))


def items(value: Value) -> list[Value] | None:
    """What a loop over a Python value goes through; None if that is not known."""
    content = value.content.value if isinstance(value, (Sequence, Mapped)) else None
    if isinstance(value, Sequence) and isinstance(content, tuple):
        return [cell.value for cell in content]
    if isinstance(value, Mapped) and isinstance(content, dict):
        return [Known(key) for key in content]
    data = value.value if isinstance(value, Known) and issubclass(value.kind, (str, list, dict)) else None
    return [Known(item) for item in data] if isinstance(data, (str, list, dict)) and len(data) <= LIST_LIMIT else None


def comprehension(walk: Walk, frame: Frame, is_flat: bool, args: tuple[PassedArgument, ...]) -> Value:
    """``[for](iterable, element, guard, the guard's text)``, see ``extract.python.comprehensions``.

    What a guard of which nothing is known lets through is made under it as a condition; the list is then not known.
    """
    if len(args) not in (2, 4) or not all(isinstance(a.value, Callable) for a in args[1:3]):
        return Sequence(Cell(walk.opaque("a list that is computed", frame)))
    element, guard = args[1].value, args[2].value if len(args) == 4 else None
    assert isinstance(element, Callable)
    found = items(args[0].value)
    if found is None or len(found) > (LONGEST if walk.turns == 1 else LONGEST_INSIDE):
        reason = "a list made from one that is not known"
        unknown = walk.opaque(reason, frame)
        walk.either_way([lambda: NONE, lambda: _guarded(walk, frame, element, guard, args, unknown) or NONE], reason)
        return Sequence(Cell(unknown))
    made: list[Cell] | None = []
    walk.turns *= 2
    for item in found:
        value = _guarded(walk, frame, element, guard, args, item)
        if value is None:
            continue
        more = (items(value) if is_flat else [value]) if value is not MAYBE else None
        made = [*made, *map(Cell, more)] if made is not None and more is not None else None
        if made is not None and len(made) > LIST_LIMIT:
            made = None
    walk.turns //= 2
    if made is None:
        return Sequence(Cell(walk.opaque("a list of which not all elements are known", frame)))
    return Sequence(Cell(tuple(made)))


def _guarded(
    walk: Walk, frame: Frame, element: Callable, guard: Value | None, args: tuple[PassedArgument, ...], item: Value
) -> Value | None:
    """One element; None where the guard keeps it out."""
    if not isinstance(guard, Callable):
        return _call(walk, frame, element, item)
    holds = conversions.truth(_call(walk, frame, guard, item))
    if holds is not None:
        return _call(walk, frame, element, item) if holds else None
    if item is OTHER_NAMES:
        return None
    text = args[3].value
    shown = text.of(str) if isinstance(text, Known) and issubclass(text.kind, str) else "if"
    mark = walk.state.mark()
    with walk.under("if", shown, Location(frame.source.path, guard.function.line, guard.function.column)):
        _call(walk, frame, element, item)
    walk.state.merge([{}, walk.state.undo(mark)])
    return MAYBE


def _call(walk: Walk, frame: Frame, function: Callable, item: Value) -> Value:
    return activation.invoke(walk, frame, function, (call_arguments.PassedArgument(item),))


def applied(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> Value:
    """``map(f, xs)`` and ``filter(f, xs)``, as if all that they give were asked for."""
    unknown = Sequence(Cell(walk.opaque(f"a list made by {name}", frame)))
    if len(args) != 2:
        return unknown
    function, found = args[0].value, items(args[1].value)
    location = Location(frame.source.path)

    def given(item: Value) -> Value:
        if function == NONE:
            return item
        return calls.apply(
            walk, frame, function, (call_arguments.PassedArgument(item),), (), location, syntax.Name(name)
        )

    if found is None or len(found) > LONGEST_INSIDE:
        reason = "a list made from one that is not known"
        element = walk.opaque(reason, frame)
        walk.either_way([lambda: NONE, lambda: given(element)], reason)
        return unknown
    made: list[Cell] = []
    is_whole = True
    for item in found:
        value = given(item)
        if name == "map":
            made.append(Cell(value))
            continue
        holds = conversions.truth(value)
        is_whole = is_whole and (holds is not None or item is OTHER_NAMES)
        if holds:
            made.append(Cell(item))
    return Sequence(Cell(tuple(made))) if is_whole else unknown


def dictionary(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value:
    """``dict(mapping or pairs, name=value)``, a new one."""
    made: dict[object, Cell] = {}
    unknown = Mapped(Cell(walk.opaque("a dictionary made from what is not known", frame)))
    for number, argument in enumerate(args):
        if argument.keyword in ("*", "**") or (number and not argument.keyword):
            return unknown
        if argument.keyword:
            made[argument.keyword] = Cell(argument.value)
            continue
        pairs = _pairs(argument.value)
        if pairs is None or len(pairs) > LIST_LIMIT:
            return unknown
        made.update(pairs)
    return Mapped(Cell(made))


def _pairs(value: Value) -> dict[object, Cell] | None:
    """The entries of a dictionary, or of a list of pairs; None where a key is not known."""
    if isinstance(value, Mapped):
        content = value.content.value
        return (
            {key: Cell(cell.value, cell.type) for key, cell in content.items()} if isinstance(content, dict) else None
        )
    if isinstance(value, Known) and issubclass(value.kind, dict):
        return {key: Cell(Known(item)) for key, item in value.of(dict).items()}
    found = items(value)
    made: dict[object, Cell] = {}
    for item in found or ():
        pair = items(item)
        if pair is None or len(pair) != 2:
            return None
        key = pair[0]
        if not isinstance(key, Known) or issubclass(key.kind, (list, dict)):
            return None
        made[key.value] = Cell(pair[1])
    return made if found is not None else None
