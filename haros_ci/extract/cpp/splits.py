# SPDX-License-Identifier: Apache-2.0
"""What stands in the one branch left of a conditional that splits a statement or braces: it is there where that branch is compiled."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expansion
from haros_ci.extract.cpp.branches import Split
from haros_ci.extract.cpp.grammar import field, kinds
from haros_ci.extract.cpp.unit import Unit

_CALLED = kinds("call_expression")
#: What may go on in a branch with what stands before it as its first part.
_LONGER = kinds(
    "binary_expression conditional_expression field_expression call_expression subscript_expression concatenated_string"
)
_MEMBERS = kinds("field_expression template_function qualified_identifier subscript_expression")
_CONSEQUENCE = field("consequence")
_ALTERNATIVE = field("alternative")

Statements = list[syntax.Statement]


def statement(
    unit: Unit, node: Node, depth: int, out: Statements, lower: Callable[[Unit, Node, int, Statements], None]
) -> None:
    """Lower a statement to *out*: under the ``#if`` in whose branch it stands; an ``else`` behind that counts without the branch, too."""
    split = unit.split(node) or _cut(unit, node)
    if split is None:
        lower(unit, node, depth, out)
        return
    inside: Statements = []
    before, unit.found.within = unit.found.within, (*unit.found.within, split)
    lower(unit, node, depth, inside)
    unit.found.within = before
    branches = [syntax.Branch(split.line, 1, split.text, tuple(inside))]
    last = inside[-1] if inside else None
    last = last.body[-1] if type(last) is syntax.Nested and last.body else last
    previous = out[-1] if out else None
    if type(last) is syntax.If and unit.split(node) is None:
        branches.append(syntax.Branch(split.next, 1, "#else", last.other if last.else_line else last.then))
    elif type(previous) is syntax.Preprocessor and previous.branches[-1].line == split.line:
        branches = [syntax.replace(branches[0], body=(*previous.branches[-1].body, *inside))]
        out.pop()
    out.append(syntax.Preprocessor(tuple(branches)))


def _cut(unit: Unit, node: Node) -> Split | None:
    """The branch in which an ``if`` begins whose body, or that of its ``else``, is behind it: ``#ifdef A``, ``if (x) f(); else``, ``#endif``."""
    then, other = node.child_by_field_id(_CONSEQUENCE), node.child_by_field_id(_ALTERNATIVE)
    split = unit.split(node, whole=False) if then is not None else None
    if then is None or split is None:
        return None
    ended = unit.locate(then.end_byte - 1 + unit.shift)[0]
    if other is None:
        return split if split.is_alone and ended > split.last else None
    return split if ended <= split.last < unit.position(other.children[-1])[0] else None


def expression(
    unit: Unit, node: Node, depth: int, split: Split, lower: Callable[[Unit, Node, int], syntax.Expression]
) -> syntax.Expression:
    """An expression in such a branch; where that is not compiled, what ``#else`` has in its place, if it has one. What is called is called whatever its name."""
    before, unit.found.within = unit.found.within, (*unit.found.within, split)
    found = lower(unit, node, depth)
    unit.found.within = before
    around: Node | None = node
    while around is not None and (above := around.parent) is not None and above.children[0] == around:
        if above.kind_id in _CALLED:
            return found
        around = above if above.kind_id in _MEMBERS else None
    text = " ".join(unit.cut(node).split())
    other = next((listed for listed in split.others if listed.own == text), None)
    instead = expansion.piece(unit, other.text, (other.line, other.column), depth) if other is not None else None
    return syntax.Conditional(syntax.Compiled(((split.line, 1, split.text),)), found, instead or unit.opaque(node))


def going_on(unit: Unit, node: Node) -> tuple[Split, Node] | None:
    """The branch in which *node* goes on and ends (``a``, ``#ifdef A``, ``+ 1``, ``#endif``), and the part of it that is before."""
    if unit.fixed is not None or unit.level:
        return None
    before, after = node, node
    while before.kind_id in _LONGER and before.child_count > 1:
        before, after = before.children[0], before.children[1]
        ended, begun = (unit.locate(offset + unit.shift)[0] for offset in (before.end_byte - 1, after.start_byte))
        for split in unit.found.splits:
            if split not in unit.found.within and ended < split.first <= begun <= split.last:
                last = unit.locate(node.end_byte - 1 + unit.shift)[0]
                return (split, before) if last <= split.last else None
    return None


def longer(
    unit: Unit,
    node: Node,
    depth: int,
    split: Split,
    before: Node,
    lower: Callable[[Unit, Node, int], syntax.Expression],
) -> syntax.Expression:
    """An expression that goes on in such a branch; where that is not compiled, what is before it alone: nothing is known where there is an ``#else``."""
    outside, unit.found.within = unit.found.within, (*unit.found.within, split)
    whole = lower(unit, node, depth)
    alone = lower(unit, before, depth) if split.is_alone else unit.opaque(node)
    unit.found.within = outside
    return syntax.Conditional(syntax.Compiled(((split.line, 1, split.text),)), whole, alone)
