# SPDX-License-Identifier: Apache-2.0
"""Elements that are read: ``a[b]``, of lists, maps, texts and what classes make of it."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.follow import activation, assignments, braces, call_arguments, dispatch, enums, methods, slices, thrown
from haros_ci.follow.frames import Frame, of_element
from haros_ci.follow.libraries import texts, tuples
from haros_ci.follow.walk import Walk
from haros_ci.index.types import MAPS, SEQUENCES
from haros_ci.values.abstract import (
    NONE,
    UNSET,
    UNSET_OR_INHERITED,
    Choice,
    ClassValue,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Partial,
    Sequence,
    Value,
    join,
)
from haros_ci.values.given import letter


def indexed(walk: Walk, frame: Frame, expression: syntax.Subscript) -> Value:  # noqa: C901 - one branch for each kind of container
    """``a[b]``."""
    container, key, kind = assignments.parts(walk, frame, expression)
    if isinstance(key, Object) and key.name == "slice":
        return slices.part(walk, frame, container, key)
    if isinstance(key, Choice) and isinstance(container, Mapped):
        return _chosen(walk, frame, container, key)
    cell = assignments.element(walk, frame, container, key, kind)
    if cell is not None:
        return cell.value
    if isinstance(container, Known) and isinstance(key, Known):
        if issubclass(container.kind, str) and frame.source.program.language != "python":
            if isinstance(key.value, int) and key.value >= 0 and container.ask("longer than", key.value):
                return texts.number(letter(container, key.value))
            return walk.opaque("a character that is not known", frame)
        try:
            return Known(container.value[key.value])  # type: ignore[index]  # LookupError or TypeError if it has none
        except (LookupError, TypeError):
            if frame.source.separator == ".":
                thrown.throws(walk, thrown.KEY if isinstance(container.value, dict) else thrown.INDEX)
            elif isinstance(container.value, (dict, list)):
                return NONE  # yaml-cpp: an undefined node
    if isinstance(container, (ClassValue, Library)) and (member := enums.named(walk, container, key)) is not None:
        return member
    if isinstance(container, Object) and (part := _of_object(walk, frame, container, key)) is not None:
        return part
    if isinstance(container, Mapped) and frame.source.separator == ".":
        pairs = container.content.value
        if isinstance(pairs, dict) and isinstance(key, Known) and issubclass(key.kind, (str, int)):
            thrown.throws(walk, thrown.KEY)
    cells = container.content.value if isinstance(container, Sequence) else ()
    if isinstance(cells, Partial) and cells.last is not None and key == Known(-1) and frame.source.separator == ".":
        return cells.last.value
    if isinstance(cells, tuple) and isinstance(container, Sequence) and isinstance(key, Known):
        if frame.source.separator == ".":
            thrown.throws(walk, thrown.INDEX)
        return walk.opaque(f"there is no element {key.value}: the list has {len(cells)}", frame)
    if isinstance(cells, tuple) and cells and not isinstance(key, Known) and not braces.is_open(container):
        return any_of(cell.value for cell in cells)
    held = dispatch.entry(container) if not isinstance(key, Known) and frame.source.separator == "." else None
    if held is not None:
        return held
    kind = None
    if isinstance(container, Sequence) and container.type is not None and container.type.arguments:
        kind = container.type.of(0)
    elif isinstance(container, Opaque) and container.type is not None and container.type.name in (SEQUENCES | MAPS):
        kind = container.type.of(len(container.type.arguments) - 1) if container.type.arguments else None
    return walk.opaque(of_element(key), frame, None, kind)


def _of_object(walk: Walk, frame: Frame, container: Object, key: Value) -> Value | None:
    """What ``operator[]`` of an object's class gives, or a part of a pair or struct that is taken apart."""
    method = methods.method_of(walk, container, "operator[]") if container.definition is not None else None
    if method is not None:
        return activation.invoke(walk, frame, method, (call_arguments.PassedArgument(key),))
    part = tuples.part(container, key.value) if isinstance(key, Known) else None
    return part.value if part is not None else None


def _chosen(walk: Walk, frame: Frame, container: Mapped, key: Choice) -> Value:
    """The entry of one of several keys; Python does not go on with one that is not there."""
    cells = [assignments.element(walk, frame, container, option) for option in key.options]
    found = [cell.value for cell in cells if cell is not None]
    if not found or (len(found) < len(cells) and frame.source.separator != "."):
        return walk.opaque("an element that is not known", frame)
    return any_of(found)


def any_of(values: Iterable[Value]) -> Value:
    """One of *values*, there is no telling which."""
    result: Value | None = None
    for value in values:
        result = value if result is None else join(result, value)
        if isinstance(result, Opaque) and result.reason not in (UNSET, UNSET_OR_INHERITED):
            break  # it stays so
    return result if result is not None else NONE
