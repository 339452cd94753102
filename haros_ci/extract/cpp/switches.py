# SPDX-License-Identifier: Apache-2.0
"""The cases of a ``switch`` (C++), and what the parser has beside them: blocks under an ``#if``."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions, preprocessor
from haros_ci.extract.cpp.grammar import field as named
from haros_ci.extract.cpp.grammar import kinds
from haros_ci.extract.cpp.unit import DEEPEST, Unit
from haros_ci.records import dataclass, field
from haros_ci.syntax import Block

_CASE = kinds("case_statement")
_COLON = kinds(":")
_VALUE = named("value")
#: What stands around cases under an #if.
_UNDER = kinds("preproc_if preproc_ifdef preproc_else preproc_elif preproc_elifdef")
#: An #if in another, and its other branches, that are looked into for cases.
NESTED = 8

Guard = tuple[int, int, str]
Lower = Callable[[Unit, list[Node], int], Block]


def cases(unit: Unit, nodes: list[Node], depth: int, block: Lower) -> tuple[syntax.Case, ...]:
    """The cases among *nodes*, the children of the body; *block* lowers statements."""
    found = _Cases(unit, block)
    found.collect(nodes, depth, None)
    return tuple(found.every)


@dataclass(slots=True)
class _Cases:
    unit: Unit
    block: Lower
    every: list[syntax.Case] = field(default_factory=list)

    def collect(self, nodes: list[Node], depth: int, guard: Guard | None) -> None:
        """Cases under an #if have their blocks under that #if, and so has what goes on there with the case before it."""
        rest: list[Node] = []
        for node in nodes:
            if node.kind_id in _CASE:
                self._go_on(rest, depth, guard)
                children = node.children
                value = node.child_by_field_id(_VALUE)
                start = next((index for index, child in enumerate(children) if child.kind_id in _COLON), 0) + 1
                inside = self.block(self.unit, children[start:], depth)
                meant = None if value is None else expressions.expression(self.unit, value, depth)
                self.every.append(syntax.Case(meant, _guarded(inside, guard) if guard else inside))
            elif node.kind_id in preprocessor.CONDITIONAL and depth <= DEEPEST and _has_cases(node):
                self._go_on(rest, depth, guard)
                for line, column, text, children in preprocessor.branches(self.unit, node):
                    self.collect(children, depth + 1, (line, column, text))
            else:
                rest.append(node)
        self._go_on(rest, depth, guard)

    def _go_on(self, rest: list[Node], depth: int, guard: Guard | None) -> None:
        """Put the statements *rest* into the last case: the parser has them beside it, behind an #if."""
        inside = self.block(self.unit, rest, depth) if rest and self.every else ()
        if inside:
            last = self.every[-1]
            self.every[-1] = syntax.Case(last.value, last.body + (_guarded(inside, guard) if guard else inside))
        rest.clear()


def _guarded(inside: Block, guard: Guard) -> Block:
    return (syntax.Preprocessor((syntax.Branch(*guard, inside),)),)


def _has_cases(node: Node, depth: int = 0) -> bool:
    """Whether cases of the switch around it stand under an #if."""
    return any(
        child.kind_id in _CASE or (depth < NESTED and child.kind_id in _UNDER and _has_cases(child, depth + 1))
        for child in node.children
    )
