# SPDX-License-Identifier: Apache-2.0
"""The body of a C++ function: calls, nesting, decisions and paths.

Paths are counted as Nejmeh does (CACM 31(2), 1988): a sequence multiplies, a decision adds. A statement that decides
nothing has one path; an expression has as many as ``&&`` and ``||`` in it, ``a ? b : c`` two and those of its parts.
"""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from haros_ci.extract.cpp import types
from haros_ci.extract.cpp.grammar import field, kinds, onwards, table
from haros_ci.extract.cpp.unit import Unit
from haros_ci.measuring.facts import DEEPEST, MOST_PATHS, FunctionCounts, times
from haros_ci.regex import regex

_BODY, _FUNCTION, _FIELD, _CONDITION = field("body"), field("function"), field("field"), field("condition")
_CONSEQUENCE, _ALTERNATIVE, _VALUE, _NAME = field("consequence"), field("alternative"), field("value"), field("name")
_IF = kinds("if_statement")
_CASE = kinds("case_statement")
_CATCH = kinds("catch_clause seh_except_clause seh_finally_clause")
_COMPOUND = kinds("compound_statement")
_BINARY = kinds("binary_expression")
_SHORT = kinds("&& || and or")
_TERNARY = kinds("conditional_expression")
_CALL = kinds("call_expression")
_COLON = kinds(":")
_MEMBER = kinds("field_expression")
_TYPE = kinds("primitive_type sized_type_specifier decltype")
_NAMED = kinds("identifier field_identifier template_function template_method qualified_identifier dependent_name")
_CLASS = types.CLASS_KINDS
#: Further branches of a conditional, where one is left.
_UNREAD = kinds("preproc_else preproc_elif preproc_elifdef")
#: Keywords that look like calls.
_NOT_CALLED = frozenset(
    "static_cast dynamic_cast const_cast reinterpret_cast typeid sizeof alignof alignas noexcept decltype defined"
    " static_assert assert va_arg va_start va_end offsetof typeof".split()
)
_MACRO = regex(r"[A-Z][A-Z0-9_]+")


class CppBody:
    """Counts what is in a function's *parts*; local classes and functions are put aside, in the order of the text."""

    def __init__(self, unit: Unit) -> None:
        self.unit = unit
        self.counts = FunctionCounts()
        self.local: list[Node] = []
        self.paths = 1

    def take(self, parts: Iterable[Node]) -> None:
        """Constructor initialisers and the body."""
        for part in parts:
            self.paths = times(self.paths, self._statement(part, 0, 0))
        self.paths = min(self.paths + self.counts.apart, MOST_PATHS)

    def _statement(self, node: Node, nesting: int, depth: int) -> int:
        """The paths through a statement inside *nesting* control structures."""
        if depth > DEEPEST:
            self.counts.is_too_deep = True
            return 1
        handler = _STATEMENTS.get(node.kind_id)
        if handler is not None:
            return handler(self, node, nesting, depth + 1)
        return max(1, self._expression(node, nesting, depth))

    def _sequence(self, nodes: Iterable[Node], nesting: int, depth: int) -> int:
        paths = 1
        for node in nodes:
            if node.is_named:
                paths = times(paths, self._statement(node, nesting, depth))
        return paths

    def _block(self, node: Node, nesting: int, depth: int) -> int:
        return self._sequence((child for child in node.children if child.kind_id not in _UNREAD), nesting, depth)

    def _field(self, node: Node, name: int, nesting: int, depth: int) -> int:
        """The paths of the statement in a field of *node*; 1 where it is missing."""
        inner = node.child_by_field_id(name)
        return 1 if inner is None else self._statement(inner, nesting, depth)

    def _if(self, node: Node, nesting: int, depth: int) -> int:
        """An ``else if`` adds a path, not a level."""
        paths = 0
        while True:
            self.counts.complexity += 1
            self.counts.nested(nesting + 1)
            condition, otherwise = node.child_by_field_id(_CONDITION), node.child_by_field_id(_ALTERNATIVE)
            paths += 0 if condition is None else self._expression(condition, nesting, depth)
            paths += self._field(node, _CONSEQUENCE, nesting + 1, depth)
            inner = (
                next((child for child in reversed(otherwise.children) if child.is_named), None) if otherwise else None
            )
            if inner is None:
                return min(paths + 1, MOST_PATHS)
            if inner.kind_id not in _IF:
                return min(paths + self._statement(inner, nesting + 1, depth), MOST_PATHS)
            node = inner

    def _loop(self, node: Node, nesting: int, depth: int) -> int:
        """for, range-based for, while, do: the body or not."""
        self.counts.complexity += 1
        self.counts.nested(nesting + 1)
        body = node.child_by_field_id(_BODY)
        paths = 1
        for child in node.children:
            if child == body:
                paths += self._statement(child, nesting + 1, depth)
            elif child.is_named:
                paths += self._expression(child, nesting, depth)
        return min(paths, MOST_PATHS)

    def _switch(self, node: Node, nesting: int, depth: int) -> int:
        """Each range of statements behind labels is a path; without ``default`` there is one past all of them."""
        self.counts.nested(nesting + 1)
        condition, body = node.child_by_field_id(_CONDITION), node.child_by_field_id(_BODY)
        paths = 0 if condition is None else self._expression(condition, nesting, depth)
        has_default = False
        ranges: list[list[Node]] = []
        for child in body.children if body is not None else ():
            if child.kind_id in _CASE:
                value = child.child_by_field_id(_VALUE)
                has_default = has_default or value is None
                self.counts.complexity += value is not None
                statements = _after_colon(child)
                if not ranges or ranges[-1]:
                    ranges.append(statements)
                else:
                    ranges[-1] = statements
            elif child.is_named and ranges:
                ranges[-1].append(child)
        paths += sum(self._sequence(span, nesting + 1, depth) for span in ranges)
        return min(max(paths + (not has_default), 1), MOST_PATHS)

    def _try(self, node: Node, nesting: int, depth: int) -> int:
        """The block to its end, or one of the handlers."""
        self.counts.nested(nesting + 1)
        paths = 0
        for child in node.children:
            if child.kind_id in _COMPOUND:
                paths += self._statement(child, nesting + 1, depth)
            elif child.kind_id in _CATCH:
                self.counts.complexity += 1
                paths += self._field(child, _BODY, nesting + 1, depth)
            elif child.is_named:  # the initialisers of a constructor
                paths += self._expression(child, nesting, depth)
        return min(max(paths, 1), MOST_PATHS)

    def _last(self, node: Node, nesting: int, depth: int) -> int:
        """The statement behind a label or an attribute."""
        inner = [child for child in node.children if child.is_named]
        return self._statement(inner[-1], nesting, depth) if inner else 1

    def _behind_macro(self, node: Node, nesting: int, depth: int) -> int:
        """What looks like a function in a function is a macro with a block behind it."""
        return self._field(node, _BODY, nesting, depth)

    def _nothing(self, node: Node, nesting: int, depth: int) -> int:
        return 1

    def _elsewhere(self, node: Node, nesting: int, depth: int) -> int:
        self.local.append(node)
        return 1

    def _expression(self, root: Node, nesting: int, depth: int) -> int:
        """The paths that the operators under *root* add; calls are counted, lambdas and blocks measured on the way."""
        paths = 0
        cursor = root.walk()
        while True:
            node = cursor.node
            assert node is not None
            is_inside = node.is_named or node == root
            if is_inside:
                kind = node.kind_id
                if kind in _BINARY:
                    operator = node.child(1) if node.child_count == 3 else None
                    if operator is not None and operator.kind_id in _SHORT:
                        self.counts.complexity += 1
                        paths += 1
                elif kind in _TERNARY:
                    self.counts.complexity += 1
                    paths += 2
                elif kind in _CALL:
                    self._call(node)
                elif kind in _COMPOUND:
                    self.counts.apart += self._statement(node, nesting, depth + 1) - 1
                    is_inside = False
                elif kind in _CLASS and node.child_by_field_id(_BODY) is not None:
                    self.local.append(node)
                    is_inside = False
            if not onwards(cursor, is_inside):
                return min(paths, MOST_PATHS)

    def _call(self, node: Node) -> None:
        function = node.child_by_field_id(_FUNCTION)
        if function is None or function.kind_id in _TYPE:
            return
        if function.kind_id in _MEMBER:
            function = function.child_by_field_id(_FIELD) or function
        if function.kind_id not in _NAMED:
            self.counts.called(self.unit.collapsed(function.start_byte, function.end_byte))
            return
        name = types.path(self.unit, function, 0)[0]
        last = name.rpartition("::")[2]
        if last not in _NOT_CALLED and not _MACRO.fullmatch(last):
            self.counts.called(name)


def _after_colon(case: Node) -> list[Node]:
    children = case.children
    start = next((i for i, child in enumerate(children) if child.kind_id in _COLON), len(children))
    return [child for child in children[start + 1 :] if child.is_named]


_STATEMENTS = table(
    {
        "compound_statement preproc_if preproc_ifdef ERROR": CppBody._block,
        "if_statement": CppBody._if,
        "for_statement for_range_loop while_statement do_statement": CppBody._loop,
        "switch_statement": CppBody._switch,
        "try_statement constructor_try_statement seh_try_statement": CppBody._try,
        "labeled_statement attributed_statement": CppBody._last,
        "class_specifier struct_specifier union_specifier template_declaration": CppBody._elsewhere,
        "function_definition": CppBody._behind_macro,
        "comment preproc_def preproc_function_def preproc_call preproc_include identifier type_identifier"
        " break_statement continue_statement goto_statement": CppBody._nothing,
    }
)
