# SPDX-License-Identifier: Apache-2.0
"""Assignment, to variables, members, elements and patterns; what is not known where the target is not."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import (
    activation,
    alternatives,
    braces,
    call_arguments,
    conversions,
    copies,
    expressions,
    handed_out,
    members,
    methods,
    operators,
    properties,
    python_names,
    uncertain,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import python_lists, tuples
from haros_ci.follow.walk import Walk
from haros_ci.index.types import MAPS
from haros_ci.syntax import Expression, Type
from haros_ci.values.abstract import (
    LIST_LIMIT,
    NONE,
    UNSET,
    UNSET_OR_INHERITED,
    Cell,
    ClassValue,
    Known,
    Mapped,
    Module,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
)

TIES = frozenset(map(syntax.Name, ("std::tie", "boost::tie", "tie")))
#: What a structured binding of C++ takes apart, which has no name.
TAKEN_APART = syntax.Name("")
#: Methods of containers that give one of their elements.
ACCESSORS = frozenset(("at", "front", "back"))


def assignment(walk: Walk, frame: Frame, expression: syntax.Assignment) -> Value:
    """``=`` and its kin: the target holds the value from here on."""
    symbol, target, source = expression.operator, expression.target, expression.value
    python = frame.source.program.language == "python"
    if type(target) is syntax.ListLiteral:
        return _unpack(walk, frame, target.items, expressions.evaluate(walk, frame, source))
    if type(target) is syntax.Call and target.callee in TIES and symbol == "=":
        return _unpack(walk, frame, target.arguments, expressions.evaluate(walk, frame, source))
    walk.references = None
    value = expressions.evaluate(walk, frame, source)
    if python and type(target) is syntax.Member and symbol == "=" and properties.assigned(walk, frame, target, value):
        return value
    is_lvalue = not python and (
        (type(source) is not syntax.Call and type(source) is not syntax.New and type(source) is not syntax.ListLiteral)
        or walk.references is not None
    )
    if value.__class__ is Pointer and type(target) is syntax.Member and not python:
        handed_out.stored(walk, frame, target, value)
    cell = _target(walk, frame, target)
    if cell is None:
        uncertain.lost(walk, frame, target, value if symbol == "=" else walk.opaque("it is changed", frame))
        return value
    held = cell.value
    if not python and isinstance(held, Object) and held.definition is not None and _is_own(held, cell.type):
        argument = call_arguments.PassedArgument(value, None, conversions.value_type(value))
        method = methods.method_of(walk, held, f"operator{symbol}", (argument,))
        if method is not None and method.function.body is not None:
            return activation.invoke(walk, frame, method, (argument,))
    if symbol != "=":
        if python and isinstance(held, Sequence) and symbol[0] in python_lists.CHANGING:
            return python_lists.changed(walk, frame, held, symbol[0], value)
        value = operators.binary(walk, frame, symbol[:-1], held, value)
    elif type(source) is syntax.ListLiteral and not python and cell.type is not None:
        value = braces.from_list(walk, frame, cell.type, value)
    elif is_lvalue:
        value = copies.copied(walk, value, _copied_type(walk, frame, cell.type, source))
    if cell.type is not None:
        value = conversions.converted(value, cell.type)
        if isinstance(held, Sequence) and isinstance(value, Sequence) and value.type is None:
            value.type = held.type
    is_own = not python and symbol == "=" and isinstance(held, Object) and _is_own(held, cell.type)
    if is_own and isinstance(held, Object) and _fill(walk, held, value):
        return held
    walk.state.write(cell, value)
    return value


def _is_own(held: Object, kind: Type | None) -> bool:
    """Whether a variable of that type holds the object itself, and no pointer to it."""
    return kind is not None and copies.is_by_value(kind) and kind.name == held.name


def _copied_type(walk: Walk, frame: Frame, kind: Type | None, source: Expression) -> Type | None:
    return kind if kind is not None else copies.static_copy(walk, frame, source)


def _fill(walk: Walk, held: Object, value: Value) -> bool:
    """Assign to an object in its place, as pointers lead to it: member by member. False if it is none of the class."""
    if held is value or held.definition is None:
        return held is value
    same = isinstance(value, Object) and value.definition is not None
    for name, member in held.fields.items():
        if copies.is_reference(walk, held, name):
            continue
        if same and isinstance(value, Object) and name in value.fields:
            walk.state.write(member, value.fields[name].value)
        else:
            walk.state.write(member, Opaque(uncertain.UNCERTAIN, None, member.type))
    if not isinstance(value, Object) or value.definition is None:
        return False
    for name, member in value.fields.items():
        if name not in held.fields:
            fresh = held.fields[name] = Cell(Opaque("it is not set before", None, member.type), member.type)
            walk.state.write(fresh, member.value)
    return value.definition[1] is held.definition[1]


def _unpack(walk: Walk, frame: Frame, targets: tuple[Expression, ...], value: Value) -> Value:
    items: list[Value] | None = None
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        items = [cell.value for cell in value.content.value]
    elif isinstance(value, Object) and value.name == tuples.PAIR:
        items = [cell.value for number in range(2) if (cell := tuples.part(value, number)) is not None]
    elif isinstance(value, Known) and issubclass(value.kind, list):
        items = [Known(item) for item in value.of(list)]
    parts = _parts(items, targets) if items is not None else None
    for index, item in enumerate(targets):
        one = parts[index] if parts is not None else walk.opaque("it is unpacked from what is not known", frame)
        if type(item) is syntax.Star:
            item = item.value
        if type(item) is syntax.ListLiteral:
            _unpack(walk, frame, item.items, one)
            continue
        cell = _target(walk, frame, item)
        if cell is None:
            uncertain.lost(walk, frame, item, one)
        else:
            walk.state.write(cell, conversions.converted(one, cell.type))
    return value


def _parts(items: list[Value], targets: tuple[Expression, ...]) -> list[Value] | None:
    """What each of *targets* gets of *items*, one with a star the list of the rest; None where their numbers differ."""
    starred = [index for index, item in enumerate(targets) if type(item) is syntax.Star]
    if not starred:
        return items if len(items) == len(targets) else None
    rest = len(items) - len(targets) + 1
    if len(starred) > 1 or rest < 0:
        return None
    first, last = starred[0], starred[0] + rest
    return [*items[:first], Sequence(Cell(tuple(map(Cell, items[first:last])))), *items[last:]]


def _target(walk: Walk, frame: Frame, target: Expression) -> Cell | None:
    """The cell to assign to; Python makes it where there is none."""
    python = frame.source.program.language == "python"
    if python and type(target) is syntax.Name:
        is_module = walk.modules.get(frame.source.path) is frame
        scopes = frame.scopes[:1] if is_module else reversed(frame.scopes)
        cell = next((scope[target.name] for scope in scopes if target.name in scope), None)
        if cell is None:
            cell = frame.scopes[0][target.name] = Cell(NONE)
        return cell
    if python and type(target) is syntax.Member:
        cell = members.own_cell(walk, expressions.evaluate(walk, frame, target.object), target.name, frame)
    else:
        cell = expressions.cell_of(walk, frame, target)
    if cell is None and python and type(target) is syntax.Subscript:
        return _entry(walk, frame, target)
    if cell is None and type(target) is syntax.Member:
        owner = expressions.evaluate(walk, frame, target.object)
        if isinstance(owner, Pointer):
            owner = owner.cell.value
        if isinstance(owner, Object) and "[of]" not in owner.fields:
            cell = owner.fields[target.name] = Cell(walk.opaque(_unset(walk, owner), frame))
        elif isinstance(owner, Module):
            before = members.attribute(walk, owner, target.name, frame)
            cell = python_names.module_frame(walk, owner.source).scopes[0][target.name] = Cell(before)
        elif isinstance(owner, ClassValue) and python:
            key = (owner.source.path, f"{owner.definition.name}.{target.name}")
            cell = walk.globals[key] = Cell(members.attribute(walk, owner, target.name, frame))
    if cell is None and type(target) is syntax.Call and not python:
        walk.references = None
        expressions.evaluate(walk, frame, target)
        if walk.references is not None and len(walk.references) == 1:
            return walk.references[0]
    return cell


def _unset(walk: Walk, owner: Object) -> str:
    """Why an attribute that is assigned to for the first time is not known on the paths that do not come there."""
    if owner.definition is None or owner.definition[0].separator != ".":
        return "it is not set before"
    inherits = any(base != "object" for base in methods.library_bases(walk, *owner.definition))
    return UNSET_OR_INHERITED if inherits else UNSET


def _entry(walk: Walk, frame: Frame, target: syntax.Subscript) -> Cell | None:
    """The new entry of a dictionary that Python assigns to; None for all that is no dictionary, or is not known."""
    container, key, _ = parts(walk, frame, target)
    pairs = container.content.value if isinstance(container, Mapped) else None
    if not isinstance(pairs, dict) or not isinstance(key, Known) or issubclass(key.kind, (list, dict)):
        return None
    if len(pairs) >= LIST_LIMIT:
        return None
    cell: Cell = Cell(walk.opaque("it is not set before", frame))
    assert isinstance(container, Mapped)
    walk.state.write(container.content, {**pairs, key.value: cell})
    return cell


def parts(walk: Walk, frame: Frame, expression: syntax.Subscript) -> tuple[Value, Value, Type | None]:
    """The container, the key and the type of the entries of ``a[b]``; arrays of objects are made here."""
    inner = expression.object
    cell = expressions.cell_of(walk, frame, inner) if isinstance(inner, call_arguments.LVALUES) else None
    value = cell.value if cell is not None else expressions.evaluate(walk, frame, inner)
    key = expressions.evaluate(walk, frame, expression.index)
    if type(expression.index) is syntax.Assignment:  # ``i++`` is lowered as ``++i`` is
        key = walk.opaque("an index that is counted on the way", frame)
    if isinstance(value, Pointer):
        value = value.cell.value
    if cell is None or frame.source.program.language == "python":
        return value, key, None
    if value == NONE and cell.type is not None and braces.is_array_of_objects(walk, frame, cell.type):
        value = braces.array(walk, frame, [], cell.type)
        walk.state.write(cell, value)
    kind = cell.type
    return value, key, kind.of(1) if kind is not None and kind.name in MAPS else None


def accessed(walk: Walk, frame: Frame, expression: syntax.Subscript | syntax.Call) -> Cell | None:
    """The cell of ``v[i]``, ``v.at(i)``, ``v.front()`` or ``v.back()``."""
    if type(expression) is syntax.Subscript and expression.object == TAKEN_APART and frame.source.separator == "::":
        taken = expressions.evaluate(walk, frame, expression.object)
        if isinstance(taken, Object) and type(expression.index) is syntax.Number:
            return tuples.part(taken, expression.index.value)
    if type(expression) is syntax.Subscript:
        return element(walk, frame, *parts(walk, frame, expression))
    callee = expression.callee
    if frame.source.program.language == "python" or type(callee) is not syntax.Member or callee.name not in ACCESSORS:
        return None
    if not isinstance(callee.object, call_arguments.LVALUES):
        return None
    value = expressions.evaluate(walk, frame, callee.object)
    if isinstance(value, Pointer):
        value = value.cell.value
    if not isinstance(value, (Sequence, Mapped)) or (callee.name == "at") != (len(expression.arguments) == 1):
        return None
    provided = expression.arguments
    at = expressions.evaluate(walk, frame, provided[0]) if provided else Known(0 if callee.name == "front" else -1)
    return element(walk, frame, value, at)


def element(walk: Walk, frame: Frame, container: Value, key: Value, kind: Type | None = None) -> Cell | None:
    """The cell of one element of a sequence or map; a map of C++ makes what is not there, as *kind* says: that of its entries."""
    if isinstance(container, Pointer):
        container = container.cell.value
    if isinstance(container, Sequence) and isinstance(container.content.value, tuple):
        cells = container.content.value
        if isinstance(key, Known) and issubclass(key.kind, int) and -len(cells) <= key.of(int) < len(cells):
            found: Cell = cells[key.of(int)]
            return found if not walk.look_ups else alternatives.looked_up(walk, frame, found)
        if isinstance(key, Known) and issubclass(key.kind, int) and braces.is_open(container):
            return braces.grown(walk, frame, container, key.of(int))
        return None
    if isinstance(container, Mapped) and isinstance(container.content.value, dict) and isinstance(key, Known):
        try:
            cell = container.content.value.get(key.value)
        except TypeError:
            return None
        if cell is None and isinstance(key.value, (str, int)) and frame.source.separator != ".":
            value: Value = walk.opaque("an entry that is not there", frame, None, kind)
            if kind is not None and copies.is_by_value(kind) and walk.class_of(kind.name, frame.source) is not None:
                value = braces.made(walk, frame, kind)
            cell = Cell(value, kind)
            walk.state.write(container.content, {**container.content.value, key.value: cell})
        return cell
    if (
        kind is not None
        and isinstance(container, Mapped)
        and container.content.value == {}
        and not isinstance(key, Known)
    ):
        walk.state.write(
            container.content, walk.opaque("an entry whose key is not known", frame)
        )  # it has one from now on
    return None
