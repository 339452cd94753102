# SPDX-License-Identifier: Apache-2.0
"""The evaluator of expressions: every value that it makes is measured, and unknown values are passed on."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any, TypeVar, cast

from haros_ci.bounded_python.functions import Function
from haros_ci.bounded_python.language import COLLECTIONS, Language
from haros_ci.bounded_python.limits import NotFollowed, TooMuch, bounded, check_operation, weight

#: What makes values that may hold more than what they are made of; what a name or an index gives was weighed before.
_MAKES = (ast.BinOp, ast.Call, ast.Dict, ast.DictComp, ast.GeneratorExp, ast.List, ast.ListComp, ast.Set, ast.Tuple)
_WEIGHED = (str, *COLLECTIONS)
_Node = TypeVar("_Node", bound=ast.expr)
_Evaluator = Callable[["Evaluation", ast.expr, int], Any]


class Evaluation:
    """Evaluates expressions of *language*; NotFollowed, TooMuch, what the language raises, and what Python would."""

    def __init__(self, language: Language) -> None:
        self.language = language
        self.limits = language.limits
        self.local: dict[str, Any] = {}

    def value(self, node: ast.expr, depth: int = 0) -> Any:
        """The value of *node*, which stands *depth* deep."""
        if depth > self.limits.depth:
            raise TooMuch("depth")
        language = self.language
        language.spend(1)
        kind = type(node)
        evaluate = _EVALUATORS.get(kind) if kind in language.syntax else None
        if evaluate is None:
            raise NotFollowed(node)
        found = evaluate(self, node, depth + 1)
        if isinstance(node, _MAKES) and isinstance(found, _WEIGHED):
            language.spend(weight(found, self.limits) // 8)
        return found

    def is_lost(self, value: Any) -> bool:
        """Whether *value* itself is not known, whatever may be in it."""
        return not isinstance(value, COLLECTIONS) and self.language.is_unknown(value)

    def _constant(self, node: ast.Constant, _: int) -> Any:
        if node.value is not None and not isinstance(node.value, self.language.constants):
            raise NotFollowed(node)
        return bounded(node.value, self.limits)

    def _name(self, node: ast.Name, _: int) -> Any:
        return self.local[node.id] if node.id in self.local else self.language.name(node.id)

    def _binop(self, node: ast.BinOp, depth: int) -> Any:
        language = self.language
        compute = language.operators.get(type(node.op))
        if compute is None and language.is_arithmetic:
            raise NotFollowed(node.op)
        left, right = self.value(node.left, depth), self.value(node.right, depth)
        if language.is_unknown_operand(left) or language.is_unknown_operand(right):
            return language.unknown()
        if compute is None:
            return language.unfollowed(node.op)
        if not isinstance(node.op, ast.Add):
            left, right = language.looked_into(left), language.looked_into(right)
            if language.is_arithmetic and not (isinstance(left, (int, float)) and isinstance(right, (int, float))):
                raise NotFollowed(node)
            if isinstance(node.op, ast.Mod) and isinstance(left, str) and not language.has_formats:
                raise NotFollowed(node)
        check_operation(node.op, left, right, self.limits)
        return bounded(compute(left, right), self.limits)

    def _unaryop(self, node: ast.UnaryOp, depth: int) -> Any:
        compute = self.language.signs.get(type(node.op))
        if compute is None:
            raise NotFollowed(node)
        value = self.value(node.operand, depth)
        is_not = isinstance(node.op, ast.Not)
        if self.language.is_unknown(value):
            return self.language.unknown(is_not)
        if self.language.is_arithmetic and not is_not and not isinstance(value, (int, float)):
            raise NotFollowed(node)
        return compute(value)

    def _boolop(self, node: ast.BoolOp, depth: int) -> Any:
        """The first operand that decides; an unknown truth does not matter before one that decides alone."""
        language = self.language
        stops_at = isinstance(node.op, ast.Or)
        doubt = False
        value: Any = None
        for other_node in node.values:
            value = self.value(other_node, depth)
            if language.is_unknown(value):
                if not (language.looks_past_unknown and language.is_truth(value)):
                    return language.unknown()
                doubt = True
            elif bool(value) is stops_at:
                return value if not doubt or isinstance(value, bool) else language.unknown()
        return language.unknown(isinstance(value, bool) or language.is_truth(value)) if doubt else value

    def _compare(self, node: ast.Compare, depth: int) -> Any:
        language = self.language
        left = self.value(node.left, depth)
        doubt = False
        for op, comparator in zip(node.ops, node.comparators, strict=True):
            right = self.value(comparator, depth)
            if language.is_unknown(left) or language.is_unknown(right):
                if not language.looks_past_unknown:
                    return language.unknown(True)
                doubt = True
            elif not language.compare(op, left, right):
                return False
            left = right
        return language.unknown(True) if doubt else True

    def _ifexp(self, node: ast.IfExp, depth: int) -> Any:
        language = self.language
        test = self.value(node.test, depth)
        if not language.is_unknown(test):
            return self.value(node.body if test else node.orelse, depth)
        if not language.looks_past_unknown:
            return language.unknown()
        one, other = self.value(node.body, depth), self.value(node.orelse, depth)
        if not language.is_unknown(one) and type(one) is type(other) and one == other:
            return one
        return language.unknown(isinstance(one, bool) and isinstance(other, bool))

    def _list(self, node: ast.List, depth: int) -> Any:
        return [self.value(elt, depth) for elt in node.elts]

    def _tuple(self, node: ast.Tuple, depth: int) -> Any:
        return tuple([self.value(elt, depth) for elt in node.elts])

    def _set(self, node: ast.Set, depth: int) -> Any:
        values = [self.value(elt, depth) for elt in node.elts]
        return self.language.unknown() if self.language.is_unknown(values) else self.language.set_of(values)

    def _dict(self, node: ast.Dict, depth: int) -> Any:
        found = {}
        for key, value in zip(node.keys, node.values, strict=True):
            if key is None:
                raise NotFollowed(node)
            name = self.language.looked_into(self.value(key, depth))
            if self.language.is_unknown(name):
                return self.language.unknown()
            found[name] = self.value(value, depth)
        return found

    def _subscript(self, node: ast.Subscript, depth: int) -> Any:
        owner = self.language.looked_into(self.value(node.value, depth))
        if isinstance(node.slice, ast.Slice):
            bounds = (node.slice.lower, node.slice.upper, node.slice.step)
            parts = [None if bound is None else self.value(bound, depth) for bound in bounds]
            if node.slice.step is not None and not self.language.has_steps:
                raise NotFollowed(node)
            index: Any = slice(*parts)
        else:
            index = self.language.looked_into(self.value(node.slice, depth))
            parts = [index]
        if self.is_lost(owner) or self.language.is_unknown(parts):
            return self.language.unknown()
        return self.language.item(owner, index)

    def _attribute(self, node: ast.Attribute, depth: int) -> Any:
        return self.language.attribute(self.value(node.value, depth), node.attr)

    def _callee(self, node: ast.Call, depth: int) -> Any:
        called = node.func
        if self.language.has_functions:
            return self.value(called, depth)
        if isinstance(called, ast.Name):
            return self.language.function(called.id)
        if not isinstance(called, ast.Attribute):
            raise NotFollowed(node)
        if self.language.methods is not None and called.attr not in self.language.methods:
            return Function(called.attr, lambda *_: self.language.unfollowed(node))
        return self.language.attribute(self.value(called.value, depth), called.attr)

    def _call(self, node: ast.Call, depth: int) -> Any:
        language = self.language
        if node.keywords and not language.has_keywords:
            raise NotFollowed(node)
        function = self._callee(node, depth)
        arguments: list[Any] = []
        for argument in node.args:
            if isinstance(argument, ast.Starred) and ast.Starred in language.syntax:
                value = self.value(argument.value, depth)
                arguments += [value] if language.is_unknown(value) else list(bounded(value, self.limits))
            else:
                arguments.append(self.value(argument, depth))
        named = {keyword.arg: self.value(keyword.value, depth) for keyword in node.keywords if keyword.arg is not None}
        if not isinstance(function, Function) or len(named) != len(node.keywords):
            return language.unknown()
        if function.name == "str" and len(arguments) == 1 and isinstance(arguments[0], str) and not named:
            return arguments[0]  # all the same what is known of it
        if language.is_unknown(arguments) or language.is_unknown(named):
            return language.unknown(function.is_truth)
        language.spend(1 + sum(len(argument) for argument in arguments if hasattr(argument, "__len__")) // 16)
        return bounded(function.call(*arguments, **named), self.limits)

    def _joinedstr(self, node: ast.JoinedStr, depth: int) -> Any:
        parts = [self.value(value, depth) for value in node.values]
        if self.language.is_unknown(parts):
            return self.language.unknown()
        return bounded("".join(map(str, parts)), self.limits)

    def _formattedvalue(self, node: ast.FormattedValue, depth: int) -> Any:
        if node.conversion != -1 or node.format_spec is not None:
            raise NotFollowed(node)
        return self.value(node.value, depth)

    def _listcomp(self, node: ast.ListComp | ast.GeneratorExp, depth: int) -> Any:
        return self._collected(node.generators, lambda: self.value(node.elt, depth), depth)

    def _dictcomp(self, node: ast.DictComp, depth: int) -> Any:
        pairs = self._collected(
            node.generators, lambda: (self.value(node.key, depth), self.value(node.value, depth)), depth
        )
        return self.language.unknown() if self.language.is_unknown(pairs) else dict(pairs)

    def _collected(self, generators: list[ast.comprehension], item: Callable[[], Any], depth: int) -> Any:
        found: list[Any] = []
        kept = {**self.local}
        known = self._turn(generators, item, found, depth)
        self.local = kept
        return found if known else self.language.unknown()

    def _turn(self, generators: list[ast.comprehension], item: Callable[[], Any], found: list[Any], depth: int) -> bool:
        """All turns of the first of *generators*; False if it is not known what they are."""
        if not generators:
            found.append(item())
            bounded(found, self.limits)
            return True
        values = self.value(generators[0].iter, depth)
        if not isinstance(values, (str, range, *COLLECTIONS)) or self.is_lost(values):
            return False
        for entry in bounded(values, self.limits):
            self.language.spend(1)
            if not self._bind(generators[0].target, entry):
                return False
            tests = [self.value(test, depth) for test in generators[0].ifs]
            if self.language.is_unknown(tests):
                return False
            if all(tests) and not self._turn(generators[1:], item, found, depth + 1):
                return False
        return True

    def _bind(self, target: ast.expr, value: Any) -> bool:
        if isinstance(target, ast.Name):
            self.local[target.id] = value
            return True
        if not isinstance(target, (ast.Tuple, ast.List)) or not isinstance(value, (tuple, list)):
            return False
        if len(target.elts) != len(value):
            return False
        return all(self._bind(elt, part) for elt, part in zip(target.elts, value, strict=True))


def _on(kind: type[_Node], evaluate: Callable[[Evaluation, _Node, int], Any]) -> tuple[type[ast.expr], _Evaluator]:
    """*evaluate* for nodes of *kind*, and for no others."""
    return kind, cast(_Evaluator, evaluate)


_EVALUATORS: dict[type[ast.expr], _Evaluator] = dict(
    (
        _on(ast.Constant, Evaluation._constant),
        _on(ast.Name, Evaluation._name),
        _on(ast.BinOp, Evaluation._binop),
        _on(ast.UnaryOp, Evaluation._unaryop),
        _on(ast.BoolOp, Evaluation._boolop),
        _on(ast.Compare, Evaluation._compare),
        _on(ast.IfExp, Evaluation._ifexp),
        _on(ast.List, Evaluation._list),
        _on(ast.Tuple, Evaluation._tuple),
        _on(ast.Set, Evaluation._set),
        _on(ast.Dict, Evaluation._dict),
        _on(ast.Subscript, Evaluation._subscript),
        _on(ast.Attribute, Evaluation._attribute),
        _on(ast.Call, Evaluation._call),
        _on(ast.JoinedStr, Evaluation._joinedstr),
        _on(ast.FormattedValue, Evaluation._formattedvalue),
        _on(ast.ListComp, Evaluation._listcomp),
        _on(ast.GeneratorExp, Evaluation._listcomp),
        _on(ast.DictComp, Evaluation._dictcomp),
    )
)
