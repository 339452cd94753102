# SPDX-License-Identifier: Apache-2.0
"""Assignment, to variables, members, elements and patterns; indexing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from haros_ci.link import activation, call_arguments, construct, conversions, expressions, operators, texts
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import MAPS, SEQUENCES
from haros_ci.link.values import (
    NONE,
    Cell,
    Known,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    join,
)
from haros_ci.model.program import Expression


def assignment(run: Run, frame: Frame, expression: Expression) -> Value:
    """``=`` and its kin: the target holds the value from here on."""
    _, symbol, target, source = expression
    if target[0] in ("list",):
        return _unpack(run, frame, target, expressions.evaluate(run, frame, source))
    value = expressions.evaluate(run, frame, source)
    cell = _target(run, frame, target)
    if cell is None:
        return value
    if symbol != "=":
        value = operators.binary(run, frame, symbol[:-1], cell.value, value)
    elif isinstance(value, Sequence) and frame.source.program.language != "python" and source[0] in ("name", "field"):
        value = Sequence(Cell(value.content.value), value.type)
    if cell.type is not None:
        value = conversions.converted(value, cell.type)
        if isinstance(cell.value, Sequence) and isinstance(value, Sequence) and value.type is None:
            value.type = cell.value.type
    run.state.write(cell, value)
    return value


def _unpack(run: Run, frame: Frame, target: Expression, value: Value) -> Value:
    items: Any = value.content.value if isinstance(value, Sequence) else None
    known = isinstance(items, tuple) and len(items) == len(target[1])
    for index, item in enumerate(target[1]):
        if item[0] == "list":
            _unpack(run, frame, item, items[index].value if known else run.opaque("it is unpacked", frame))
            continue
        cell = _target(run, frame, item)
        if cell is not None:
            run.state.write(
                cell, items[index].value if known else run.opaque("it is unpacked from what is not known", frame)
            )
    return value


def _target(run: Run, frame: Frame, target: Expression) -> Cell | None:
    """The cell to assign to; Python makes it where there is none."""
    python = frame.source.program.language == "python"
    if python and target[0] == "name":
        module = run.modules.get(frame.source.path)
        if module is frame:
            cell = frame.scopes[0].get(target[1])
        else:
            cell = frame.find(target[1])
        if cell is None:
            cell = Cell(NONE)
            frame.scopes[0][target[1]] = cell
        return cell
    cell = expressions.cell_of(run, frame, target)
    if cell is None and target[0] == "field":
        owner = expressions.evaluate(run, frame, target[1])
        if isinstance(owner, Pointer):
            owner = owner.cell.value
        if isinstance(owner, Object):
            cell = owner.fields[target[2]] = Cell(run.opaque("it is not set before", frame))
    return cell


def indexed(run: Run, frame: Frame, expression: Expression) -> Value:
    """``a[b]``."""
    container = expressions.evaluate(run, frame, expression[1])
    key = expressions.evaluate(run, frame, expression[2])
    if isinstance(container, Pointer):
        container = container.cell.value
    cell = element(run, frame, container, key)
    if cell is not None:
        return cell.value
    if isinstance(container, Known) and isinstance(key, Known):
        if isinstance(container.value, str) and frame.source.program.language != "python":
            if isinstance(key.value, int) and 0 <= key.value < len(container.value):
                return texts.number(Known(container.value[key.value]))
            return run.opaque("a character that is not known", frame)
        try:
            return Known(container.value[key.value])
        except (LookupError, TypeError):
            if isinstance(container.value, (dict, list)):
                return NONE  # yaml-cpp: an undefined node
    if isinstance(container, Object) and container.definition is not None:
        method = construct.method_of(run, container, "operator[]")
        if method is not None:
            return activation.invoke(run, frame, method, (call_arguments.Argument(key),), None)
    cells = container.content.value if isinstance(container, Sequence) else ()
    if isinstance(cells, tuple) and isinstance(container, Sequence) and isinstance(key, Known):
        return run.opaque(f"there is no element {key.value}: the list has {len(cells)}", frame)
    if isinstance(cells, tuple) and cells and not isinstance(key, Known):
        return any_of(cell.value for cell in cells)
    kind = None
    if isinstance(container, Sequence) and container.type is not None and container.type[1]:
        kind = container.type[1][0]
    elif isinstance(container, Opaque) and container.type is not None and container.type[0] in (SEQUENCES | MAPS):
        kind = container.type[1][-1] if container.type[1] else None
    return run.opaque("an element that is not known", frame, None, kind)


def any_of(values: Iterable[Value]) -> Value:
    """One of *values*, there is no telling which."""
    result: Value | None = None
    for value in values:
        result = value if result is None else join(result, value)
    return result if result is not None else NONE


def element(run: Run, frame: Frame, container: Value, key: Value) -> Cell | None:
    """The cell of one element of a sequence or map; a map of C++ makes what is not there."""
    if isinstance(container, Pointer):
        container = container.cell.value
    if isinstance(container, Sequence) and isinstance(container.content.value, tuple):
        cells = container.content.value
        if isinstance(key, Known) and isinstance(key.value, int) and -len(cells) <= key.value < len(cells):
            found: Cell = cells[key.value]
            return found
        return None
    if isinstance(container, Mapped) and isinstance(container.content.value, dict) and isinstance(key, Known):
        try:
            cell = container.content.value.get(key.value)
        except TypeError:
            return None
        if cell is None and isinstance(key.value, (str, int)):
            cell = Cell(run.opaque("an entry that is not there", frame))
            run.state.write(container.content, {**container.content.value, key.value: cell})
        return cell
    return None
