# SPDX-License-Identifier: Apache-2.0
"""What a block of code assigns to, builds up or gives away, by names, and what its variables stand for."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.index.mentions import READING, REFERENCES, last
from haros_ci.syntax.walk import Part, everything


def targets(item: Part, found: set[str]) -> None:
    """The last names of all that is assigned to, read into or built up in a block, and of what is given away by its address.

    What a variable of the block stands for, and is changed by it in its place, is among them: ``names = self.names; names["a"] = "b"``.
    """
    inside, plainly = set[str](), set[str]()
    for node in everything(item):
        target: syntax.Expression | None = None
        if type(node) is syntax.Assignment:
            target = node.target
        elif type(node) is syntax.Operation and node.operator in (">>", "<<") and len(node.operands) == 2:
            target = node.operands[1] if node.operator == ">>" else node.operands[0]
        elif type(node) is syntax.Call and type(node.callee) is syntax.Member:
            target = node.callee.object if node.callee.name not in READING else None
        elif type(node) is syntax.Call and type(node.callee) is syntax.Name and node.callee.name in REFERENCES:
            target = node.arguments[0] if len(node.arguments) == 1 else None
        elif type(node) is syntax.Address and not (type(node.value) is syntax.Name and "::" in node.value.name):
            target = node.value
        root = _root(target)
        if root is not None:
            found.add(last(root.name))
            if type(root) is syntax.Name:
                (plainly if target is root and type(node) is syntax.Assignment else inside).add(root.name)
    if inside or plainly:
        _stood_for(item, inside, plainly, found)


def _root(target: syntax.Expression | None) -> syntax.Name | syntax.Member | None:
    """The variable or member that *target* is a part of, or what it points to."""
    while target is not None:
        if type(target) is syntax.Name or type(target) is syntax.Member:
            return target
        if type(target) is syntax.Subscript:
            target = target.object
        elif type(target) is syntax.Call:
            target = target.callee
        else:
            target = target.value if isinstance(target, (syntax.Dereference, syntax.Address, syntax.Cast)) else None
    return None


def _stood_for(item: Part, inside: set[str], plainly: set[str], found: set[str]) -> None:
    """Add to *found* what variables stand for, references that are changed at all, and those of Python that are changed *inside*, not *plainly*."""
    pairs = list[tuple[str, str]]()
    for node in everything(item):
        name, value = "", None
        if type(node) is syntax.Assignment and type(node.target) is syntax.Name and node.operator == "=":
            name, value = node.target.name, node.value
        elif type(node) is syntax.Variable and "&" in node.type.marks and "c" not in node.type.marks:
            name, value = node.name, node.init.value if type(node.init) is syntax.Equals else None
            inside = inside | ({name} & plainly)
        elif type(node) is syntax.Each and ("&" in node.type.marks or not node.type.name):
            name, value = node.name, node.iterable
            inside = inside | ({name} & plainly if node.type.marks else set())
        root = _root(value) if not isinstance(value, syntax.Call) else None
        if root is not None:
            pairs.append((name, root.name))
    seen, new = set[str](), inside
    while new:
        seen |= new
        meant = {value for name, value in pairs if name in new}
        found.update(map(last, meant))
        new = meant - seen
