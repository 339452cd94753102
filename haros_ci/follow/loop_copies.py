# SPDX-License-Identifier: Apache-2.0
"""Elements of the list that a loop goes through, as far as its body may change them, or copies of them (``for (auto item : items)``)."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.follow import copies, expressions, statements, static_types
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Block, Expression, Type
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Cell, Known, Mapped, Object, Pointer, Sequence, Value

#: Functions that read a character that they are given.
READING = frozenset(
    f"{space}{name}"
    for space in ("", "::", "std::")
    for name in "toupper tolower isalnum isalpha isdigit islower isupper isspace ispunct isxdigit to_string".split()
)


def changes(walk: Walk, statement: syntax.Each) -> bool:
    """Whether the body of a loop may change its variable, which is a copy of the element: by a method, or by another name, too."""
    key = ("sets", id(statement))
    if key not in walk.found:
        name = statement.name
        walk.found[key] = (any(_may_change(node, name) for node in everything(statement.body)), statement)
    return bool(walk.found[key][0])


def changes_elements(walk: Walk, statement: syntax.Each, kind: Type, items: Iterable[Value | Cell]) -> bool:
    """Whether the body of a loop may change the *items* that it goes through, by a variable of the type *kind*."""
    if not changes(walk, statement):
        return False
    if "&" in kind.marks and "c" not in kind.marks:
        return True
    values = (item.value if isinstance(item, Cell) else item for item in items)
    held = (Pointer,) if kind.name else (Pointer, Object, Sequence, Mapped)  # else C++ copies them
    return any(isinstance(value, held) for value in values)


def _may_change(node: object, name: str) -> bool:
    if type(node) is syntax.Assignment:
        return _root(node.target) == name
    if type(node) is syntax.Call:
        return _root(node.callee) == name if type(node.callee) is syntax.Member else syntax.Name(name) in node.arguments
    return type(node) is syntax.Variable and "&" in node.type.marks and name in map(_root, syntax.started(node.init))


def element_type(value: Value, known: Type | None) -> Type | None:
    """The type of an element that a loop over it copies: that of a map is a pair."""
    is_pair = known is None and isinstance(value, Object) and value.name == copies.PAIR
    return syntax.Type(copies.PAIR) if is_pair else known


def _root(target: Expression) -> str:
    """The variable of which a member or an element is assigned to; "" of all else."""
    while isinstance(target, (syntax.Member, syntax.Subscript)):
        target = target.object
    return target.name if type(target) is syntax.Name else ""


def changed_text(walk: Walk, frame: Frame, statement: syntax.Each) -> Cell | None:
    """The variable with the text whose characters the body sets: ``for (auto& c : text) c = toupper(c);``."""
    kind, iterable = statement.type, statement.iterable
    if frame.source.separator != "::" or "&" not in kind.marks or "c" in kind.marks:
        return None
    cell = expressions.cell_of(walk, frame, iterable) if isinstance(iterable, (syntax.Name, syntax.Member)) else None
    is_text = cell is not None and isinstance(cell.value, Known) and issubclass(cell.value.kind, str)
    return cell if is_text and _sets(statement.body, syntax.Name(statement.name)) else None


def _sets(body: Block, target: syntax.Name) -> bool:
    """Whether a body assigns to a variable, or hands it to a function by its name, which may."""
    return any(
        (type(node) is syntax.Assignment and node.target == target)
        or (type(node) is syntax.Call and type(node.callee) is syntax.Name and target in node.arguments)
        for node in everything(body)
        if not (type(node) is syntax.Call and type(node.callee) is syntax.Name and node.callee.name in READING)
    )


def turn(walk: Walk, frame: Frame, statement: syntax.Each, kind: Type, value: Value | Cell) -> str:
    """The body of a loop for one element, which its variable of the type *kind* is, or is a copy of."""
    is_written = kind.name not in ("", "auto")
    frame.scopes.append({})
    try:
        if isinstance(value, Cell) and "&" in kind.marks:
            frame.declare(statement.name, copies.referred(walk, value, kind))
        else:
            inner = value.value if isinstance(value, Cell) else value
            is_copied = frame.source.separator == "::" and "&" not in kind.marks
            if isinstance(inner, Object) and is_copied and changes(walk, statement):
                held = kind if is_written else type_of_element(walk, frame, statement.iterable, kind)
                inner = copies.copied(walk, inner, element_type(inner, held))
            frame.declare(statement.name, Cell(inner, kind if is_written else None))
        return statements.execute(walk, frame, statement.body)
    finally:
        frame.scopes.pop()


def type_of_element(walk: Walk, frame: Frame, iterable: Expression, written: Type) -> Type | None:
    """The type of the elements of a list, where a loop does not write it."""
    return static_types.element_type(walk, frame, iterable) if written.name in ("", "auto") else written
