# SPDX-License-Identifier: Apache-2.0
"""What C++ copies and what it refers to: values of class, vector and map types, braces, arrays, returned references."""

from __future__ import annotations

from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow import assignments, bases, call_arguments, construct, expressions, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import qos_profiles, ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.types import MAPS, SEQUENCES, STRINGS, is_smart_pointer, pointee
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Expression, Function, Type
from haros_ci.syntax.walk import everything
from haros_ci.values import iterators
from haros_ci.values.abstract import Cell, Choice, Known, Mapped, Object, Opaque, Sequence, Text, Value

#: Values inside values that are copied, and all of them together.
DEEP = 6
CELLS = 2_000
PAIR = "std::pair"
#: Of what a lambda captures all by value: what is copied, whether it is used or not.
CAPTURED = (Known, Text, Choice, Opaque, Sequence, Mapped)


def is_by_value(kind: Type | None) -> bool:
    """Whether a variable of the resolved type holds a value of its own, and no pointer or reference."""
    if kind is None or kind.name in ("", "auto", "()"):
        return False
    return "*" not in kind.marks and "&" not in kind.marks and not is_smart_pointer(kind)


def copied(walk: Walk, value: Value, kind: Type | None) -> Value:
    """*value* as another variable of static type *kind* holds it in C++: objects, vectors and maps are copied.

    Pointers, references, objects of libraries and what is of no known type stay the same.
    """
    if isinstance(value, (Object, Sequence, Mapped, Choice)) and is_by_value(kind):
        assert kind is not None
        return _copy(walk, value, kind, DEEP, [CELLS])
    return value


def _copy(walk: Walk, value: Value, kind: Type, depth: int, left: list[int]) -> Value:
    if isinstance(value, Choice):
        return Choice(tuple(_copy(walk, option, kind, depth, left) for option in value.options))
    if not isinstance(value, (Object, Sequence, Mapped)):
        return value
    if depth < 0 or left[0] < 0:
        return Opaque("it is too large to be followed", None, kind)
    if isinstance(value, Sequence):
        cells = value.content.value
        inner = kind.of(0) if kind.name in SEQUENCES else None
        if isinstance(cells, tuple):
            cells = tuple(_twin(walk, cell, cell.type or inner, depth, left) for cell in cells)
        return Sequence(Cell(cells), value.type or (kind if kind.name in SEQUENCES else None))
    if isinstance(value, Mapped):
        pairs = value.content.value
        inner = kind.of(1) if kind.name in MAPS else None
        if isinstance(pairs, dict):
            pairs = {key: _twin(walk, cell, cell.type or inner, depth, left) for key, cell in pairs.items()}
        return Mapped(Cell(pairs))
    if value.definition is None:
        if value.name == ros2_nodes.NODE_OPTIONS:
            return ros2_nodes.copied(value)
        if value.name != PAIR and value.name not in qos_profiles.CLASSES:
            return value
        return replace(value, fields={n: _twin(walk, cell, cell.type, depth, left) for n, cell in value.fields.items()})
    owner = walk.class_of(kind.name, value.definition[0])
    if owner is None or not bases.derives(walk, value.definition, owner[1]):
        return value
    constructor = _copy_constructor(walk, owner)
    if constructor is not None and constructor not in walk.active:
        argument = call_arguments.PassedArgument(value, Cell(value, syntax.Type(value.name, value.arguments, "")))
        where = value.location or Location(owner[0].path)
        return construct.instance(walk, Frame(owner[0], ""), owner, value.arguments, (argument,), where)
    twin = replace(value, fields={})
    if owner[1] is not value.definition[1]:
        twin = replace(twin, name=owner[1].name, definition=owner)
    for name, cell in value.fields.items():
        twin.fields[name] = cell if is_reference(walk, value, name) else _twin(walk, cell, cell.type, depth, left)
    return twin


def _twin(walk: Walk, cell: Cell, kind: Type | None, depth: int, left: list[int]) -> Cell:
    left[0] -= 1
    if kind is not None and is_by_value(kind):
        return Cell(_copy(walk, cell.value, kind, depth - 1, left), cell.type)
    return Cell(cell.value, cell.type)


def is_reference(walk: Walk, value: Object, name: str) -> bool:
    """Whether a member is a reference."""
    assert value.definition is not None
    source, definition = value.definition
    key = ("reference", source.path, definition.name, name)
    if key not in walk.found:
        found = methods.field_of(walk, source, definition, name, {})
        walk.found[key] = found is not None and "&" in found[2].marks
    return bool(walk.found[key])


def _single(walk: Walk, owner: tuple[Source, Class]) -> list[tuple[Function, Type]]:
    """The constructors that take one argument, with its type."""
    source, definition = owner
    key = ("constructors of one", source.path, definition.name)
    if key not in walk.found:
        name = f"{definition.name}::{definition.name.rpartition('::')[2]}"
        frame = Frame(source, definition.name)
        walk.found[key] = [
            (function, walk.type_in(function.parameters[0].type, frame))
            for _, function in walk.index.near(walk.index.functions, name, source, walk.files)
            if function.parameters and all(p.default is not None for p in function.parameters[1:])
        ]
    found: list[tuple[Function, Type]] = walk.found[key]
    return found


def _copy_constructor(walk: Walk, owner: tuple[Source, Class]) -> Function | None:
    for function, kind in _single(walk, owner):
        if (
            kind.name == owner[1].name
            and kind.marks.count("&") == 1
            and "*" not in kind.marks
            and function.body is not None
        ):
            return function
    return None


def duplicate(walk: Walk, owner: tuple[Source, Class], argument: call_arguments.PassedArgument) -> Value | None:
    """``C(c)`` as a copy; None where it is no copy, or where a constructor of the class says what happens."""
    value = argument.value
    if isinstance(value, Opaque):
        return _perhaps(walk, owner, argument, value)
    if not isinstance(value, Object) or value.definition is None or not bases.derives(walk, value.definition, owner[1]):
        return None
    if argument.type is not None and ("*" in argument.type.marks or is_smart_pointer(argument.type)):
        return None
    for function, kind in _single(walk, owner):
        if kind.name in function.templates:
            return None
        if is_smart_pointer(kind) or "*" in kind.marks:
            if argument.cell is None or argument.cell.type is None:  # perhaps a pointer
                return None
            continue
        found = walk.class_of(pointee(kind).name, owner[0])
        if found is not None and bases.derives(walk, value.definition, found[1]) and function.body is not None:
            return None
    return copied(walk, value, syntax.Type(owner[1].name, value.arguments, ""))


def _perhaps(
    walk: Walk, owner: tuple[Source, Class], argument: call_arguments.PassedArgument, value: Opaque
) -> Opaque | None:
    """``C{x}`` for an aggregate and an *x* that is not known: a copy, unless its type says that it is a member."""
    source, definition = owner
    kind = value.type if value.type is not None and value.type.name not in ("", "auto") else argument.type
    if kind is not None and kind.name not in ("", "auto"):
        found = walk.class_of(kind.name, source) if "*" not in kind.marks else None
        is_told = call_arguments.is_scalar(kind) or kind.name in STRINGS or "::" in kind.name or "*" in kind.marks
        if not bases.derives(walk, found, definition) if found is not None else is_told:  # else a template's parameter
            return None
    if methods.class_method(walk, source, definition, definition.name.rpartition("::")[2]) is not None:
        return None
    return Opaque(value.reason, value.location, syntax.Type(definition.name))


def referred(walk: Walk, cell: Cell, kind: Type) -> Cell:
    """What a reference of the resolved type *kind* is to the variable in *cell*: by that of a base class, it is seen as one of that class."""
    value = cell.value
    if not isinstance(value, Object) or value.definition is None or kind.name in ("", "auto", value.name):
        return cell
    owner = walk.class_of(kind.name, value.definition[0]) if "*" not in kind.marks else None
    return cell if owner is None or owner[1] is value.definition[1] else Cell(value, kind)


def static_copy(walk: Walk, frame: Frame, expression: Expression) -> Type | None:
    """The type of value that *expression* has, so that ``auto`` copies it; None where that is not known."""
    kind: Type | None = None
    if type(expression) is syntax.Cast:
        kind = walk.type_in(expression.type, frame)
    elif type(expression) is syntax.Conditional:
        return static_copy(walk, frame, expression.then)
    elif type(expression) is syntax.Dereference:
        at = expressions.evaluate(walk, frame, expression.value)
        if isinstance(at, Object) and "[of]" in at.fields:
            kind = _element(at)
            return kind.bare() if kind is not None and is_by_value(kind) else None
        cell = (
            expressions.cell_of(walk, frame, expression.value)
            if isinstance(expression.value, call_arguments.LVALUES)
            else None
        )
        kind = cell.type if cell is not None else None
        if kind is None or not (is_smart_pointer(kind) or kind.marks.count("*") == 1):
            return None
        kind = pointee(kind)
    elif type(expression) is syntax.Call and type(expression.callee) is syntax.Name:
        kind = walk.type_in(syntax.Type(expression.callee.name, expression.templates, ""), frame)
        is_class = kind.name in qos_profiles.CLASSES or walk.class_of(kind.name, frame.source) is not None
        return kind if is_class else None
    elif (
        type(expression) is syntax.Call
        and type(expression.callee) is syntax.Member
        and expression.callee.name in qos_profiles.CHAINED
    ):
        kind = static_copy(walk, frame, expression.callee.object)
        return kind if kind is not None and kind.name in qos_profiles.CLASSES else None
    elif isinstance(expression, (syntax.Name, syntax.Member, syntax.Subscript, syntax.Call)):
        cell = expressions.cell_of(walk, frame, expression)
        kind = cell.type if cell is not None else None
    if kind is None or "*" in kind.marks or not is_by_value(kind.bare()):
        return None
    return kind.bare()


def _element(at: Object) -> Type | None:
    """The type of the element that an iterator leads to, if that is known."""
    cell = iterators.pointed(at)
    if cell is None or cell.type is not None:
        return cell.type if cell is not None else None
    is_pair = isinstance(cell.value, Object) and cell.value.name == PAIR
    return syntax.Type(PAIR) if is_pair else iterators.kind(at)


def taken(walk: Walk, frame: Frame, kind: Type, expression: Expression, value: Value) -> Value:
    """The value of *expression* as a new variable of the resolved type *kind* takes it: copied if it is another's."""
    if frame.source.program.language == "python" or "*" in kind.marks or "&" in kind.marks:
        return value
    if type(expression) is syntax.Call and walk.references is None:
        if syntax.name_of(expression.callee) not in (*assignments.ACCESSORS, *qos_profiles.CHAINED):
            return value
    if isinstance(expression, (syntax.New, syntax.Lambda, syntax.Address, syntax.This)):
        return value
    known = kind if kind.name not in ("auto", "") else static_copy(walk, frame, expression)
    if known is None and isinstance(value, Sequence) and isinstance(expression, (syntax.Name, syntax.Member)):
        known = value.type or syntax.Type("std::vector")
    return copied(walk, value, known)


def returned(walk: Walk, inner: Frame, function: Function, returns: Type, value: Value) -> Value:
    """What a call gives: a copy, or the value of the cells that are referred to, which the run keeps."""
    walk.references = None
    if inner.source.program.language == "python" or not isinstance(returns.marks, str):
        return value
    if "&" in returns.marks:
        written, local = _returning(walk, function)
        cells = [_referred(walk, inner, expression, local) for expression in written]
        walk.references = tuple(cell for cell in cells if cell is not None) if all(cells) else ()
        return value
    if not isinstance(value, (Object, Sequence, Mapped, Choice)) or function.returns.name in function.templates:
        return value
    written, local = _returning(walk, function)
    if all(
        isinstance(e, (syntax.Call, syntax.New, syntax.ListLiteral)) or (type(e) is syntax.Name and e.name in local)
        for e in written
    ):
        return value
    return copied(walk, value, returns)


def _returning(walk: Walk, function: Function) -> tuple[list[Expression], set[str]]:
    key = ("written", id(function))
    if key not in walk.found:
        walk.found[key] = (_written(function), function)
    found: tuple[list[Expression], set[str]] = walk.found[key][0]
    return found


def _written(function: Function) -> tuple[list[Expression], set[str]]:
    """The expressions that a function returns, and the names of its local variables."""
    found: list[Expression] = []
    local: set[str] = set()
    for node in everything(function.body):
        if type(node) is syntax.Return and node.value is not None:
            found.append(node.value)
        elif isinstance(node, (syntax.Variable, syntax.Each)):
            local.add(node.name)
    return found, local


def _referred(walk: Walk, frame: Frame, expression: Expression, local: set[str]) -> Cell | None:
    """The cell of a returned reference, after the function's end; None if it may be that of a local variable."""
    inner = expression
    while isinstance(inner, (syntax.Member, syntax.Subscript, syntax.Dereference, syntax.Cast)):
        if type(inner) is syntax.Subscript and not isinstance(inner.index, (syntax.Number, syntax.String, syntax.Name)):
            return None
        if type(inner) is syntax.Subscript and type(inner.index) is syntax.Name and inner.index.name in local:
            return None
        inner = inner.object if isinstance(inner, (syntax.Member, syntax.Subscript)) else inner.value
    if type(inner) is syntax.This or (type(inner) is syntax.Name and inner.name not in local):
        return expressions.cell_of(walk, frame, expression)
    return None


def passed(
    walk: Walk, inner: Frame, value: Value, kind: Type, argument: call_arguments.PassedArgument, is_open: bool
) -> Value:
    """An argument as a parameter of type *kind* takes it; if that is open, the argument's own type counts."""
    if inner.source.program.language == "python":
        return value
    if is_open:
        return copied(walk, value, argument.cell.type if argument.cell is not None and not kind.marks else None)
    return copied(walk, value, kind)


def by_value(walk: Walk, frame: Frame, names: tuple[str, ...]) -> dict[str, Cell]:
    """What a lambda captures by value, as it is where it is made; of all (``=``) texts, numbers, lists and maps."""
    found = {name: cell for scope in frame.scopes for name, cell in scope.items()} if "=" in names else {}
    found.update((name, cell) for name in names if (cell := frame.find(name)) is not None)
    return {
        name: Cell(copied(walk, cell.value, cell.type), cell.type)
        for name, cell in found.items()
        if f"&{name}" not in names
        and (isinstance(cell.value, CAPTURED) or (isinstance(cell.value, Object) and name in names))
        and cell not in walk.lasting
        and all(cell is not static for static in walk.statics.values())
    }


def captures(walk: Walk, frame: Frame, index: int) -> tuple[Function, tuple[syntax.Variable, ...]]:
    """A lambda without, and apart, the variables that its captures declare: they stand before its body's brace."""
    written = frame.source.program.functions[index]
    key = ("lambda", frame.source.path, index)
    found: tuple[Function, Function, tuple[syntax.Variable, ...]] | None = walk.found.get(key)
    if found is None or found[0] is not written:
        body = written.body or ()
        captured: list[syntax.Variable] = []
        brace = (written.body_line, written.body_column)
        for statement in body:
            if type(statement) is not syntax.Variable or (statement.line, statement.column) >= brace:
                break
            captured.append(statement)
        function = syntax.replace(written, body=body[len(captured) :]) if captured else written
        found = walk.found[key] = (written, function, tuple(captured))
    return found[1], found[2]
