# SPDX-License-Identifier: Apache-2.0
"""From the tree of a query to a function that evaluates it. Nothing of Python is within reach of a query.

Expressions, conditions and paths are here; for-let-where-return is in ``flwr.py``. Semantics: pyflwor-ext 1.2
(``symbols.py``); what differs is in docs/queries.md.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from haros_ci.query.access import attribute, call, call_method, indexed
from haros_ci.query.fault import QueryError, suggestion
from haros_ci.query.free import free
from haros_ci.query.functions import BUILTINS, truth
from haros_ci.query.machine import Machine, Scope
from haros_ci.query.operators import ARITHMETIC, COMPARISONS, SET_COMPARISONS, SETS, contains, negated
from haros_ci.query.syntax import (
    And,
    Arithmetic,
    Attribute,
    Chain,
    Compare,
    DictOf,
    Flwr,
    ListOf,
    Literal,
    Membership,
    Negative,
    Not,
    Or,
    Path,
    Quantified,
    QueryCall,
    QueryFunction,
    QueryIf,
    QuerySubscript,
    SetCompare,
    SetOperation,
    Tree,
)
from haros_ci.query.values import QueryList, QueryRecord, Value, elements, items_of, kind_of, weight_of

Run = Callable[[Scope], Value]
Names = frozenset[str]


class UnknownVariable(QueryError):
    """A variable that a query uses and nothing has bound."""

    def __init__(self, name: str, at: int, known: Collection[str]) -> None:
        super().__init__(f"there is no variable {name!r}", at, suggestion(name, known, set(known) - BUILTINS.keys()))
        self.name = name


class Compiler:
    """Makes functions for one *machine*; *known* are the variables that it will have."""

    def __init__(self, machine: Machine, known: Collection[str]) -> None:
        self.machine = machine
        self.known = frozenset(known)

    def make(self, tree: Tree, names: Names) -> Run:
        """What evaluates *tree*, where the query itself has bound *names*."""
        run: Run = getattr(self, _MAKERS[tree.__class__])(tree, names)
        if isinstance(tree, (Path, SetOperation, Flwr, Quantified)) and names and not free(tree) & names:
            return self._constant(run, tree)
        return run

    def _constant(self, run: Run, tree: Tree) -> Run:
        """*run*, once: no variable of the query has to do with it."""
        machine, key = self.machine, id(tree)

        def constant(scope: Scope) -> Value:
            if key not in machine.cache:
                machine.cache[key] = run({})
            return machine.cache[key]

        return constant

    def condition(self, tree: Tree, names: Names) -> Callable[[Scope], bool]:
        run = self.make(tree, names)
        if isinstance(tree, (Compare, Membership, SetCompare, Quantified, Not, And, Or)):
            return run
        return lambda scope: truth(run(scope))

    def variable(self, name: str, at: int, names: Names) -> Run:
        if name in names:

            def bound(scope: Scope) -> Value:
                try:
                    return scope[name]
                except KeyError:
                    raise QueryError(f"{name} is used before it is let", at) from None

            return bound
        if name not in self.known:
            raise UnknownVariable(name, at, names | self.known)
        machine = self.machine
        return lambda scope: machine.variables[name]

    # Values.

    def _literal(self, tree: Literal, names: Names) -> Run:
        value = tree.value
        return lambda scope: value

    def _list(self, tree: ListOf, names: Names) -> Run:
        items = [self.make(item, names) for item in tree.items]
        return self.placed(lambda scope: QueryList.of([item(scope) for item in items]), tree.at)

    def _dict(self, tree: DictOf, names: Names) -> Run:
        pairs = [(self.make(key, names), self.make(value, names)) for key, value in tree.pairs]
        return self.placed(lambda scope: QueryRecord({key(scope): value(scope) for key, value in pairs}), tree.at)

    def _if(self, tree: QueryIf, names: Names) -> Run:
        condition = self.condition(tree.condition, names)
        then, otherwise = self.make(tree.then, names), self.make(tree.otherwise, names)
        return lambda scope: then(scope) if condition(scope) else otherwise(scope)

    def _arithmetic(self, tree: Arithmetic, names: Names) -> Run:
        first = self.make(tree.first, names)
        rest = [(ARITHMETIC[sign], self.make(item, names), at) for sign, item, at in tree.rest]
        machine = self.machine

        def arithmetic(scope: Scope) -> Value:
            value = first(scope)
            for operator, item, at in rest:
                other = item(scope)
                machine.tick(weight_of(value) + weight_of(other))
                try:
                    value = operator(value, other)
                except QueryError as err:
                    raise _at(err, at) from None
            return value

        return arithmetic

    def _negative(self, tree: Negative, names: Names) -> Run:
        item = self.make(tree.item, names)
        return self.placed(lambda scope: negated(item(scope)), tree.at)

    def _chain(self, tree: Chain, names: Names) -> Run:
        run = self.variable(tree.name, tree.at, names)
        links = list(tree.links)
        while links:
            link = links.pop(0)
            if isinstance(link, Attribute) and links and isinstance(links[0], QueryCall):
                run = self._method(run, link, links.pop(0), names)
            elif isinstance(link, Attribute):
                run = self._attribute(run, link)
            elif isinstance(link, QuerySubscript):
                run = self._index(run, link, names)
            else:
                run = self._call(run, link, names)
        return run

    def _attribute(self, run: Run, link: Attribute) -> Run:
        machine, name, at = self.machine, link.name, link.at

        def read(scope: Scope) -> Value:
            value = attribute(run(scope), name, at)
            if value.__class__ is QueryList or value.__class__ is QueryRecord:
                machine.tick(value.weight >> 3)
            return value

        return read

    def _method(self, run: Run, link: Attribute, raw_arguments: Any, names: Names) -> Run:
        arguments = [self.make(argument, names) for argument in raw_arguments.arguments]
        machine, name, at = self.machine, link.name, link.at
        return self.placed(
            lambda scope: call_method(machine, run(scope), name, [one(scope) for one in arguments], at), at
        )

    def _call(self, run: Run, link: QueryCall, names: Names) -> Run:
        arguments = [self.make(argument, names) for argument in link.arguments]
        machine = self.machine
        return self.placed(lambda scope: call(machine, run(scope), [one(scope) for one in arguments]), link.at)

    def _index(self, run: Run, link: QuerySubscript, names: Names) -> Run:
        key = self.make(link.key, names)
        return self.placed(lambda scope: indexed(run(scope), key(scope)), link.at)

    def placed(self, run: Run, at: int) -> Run:
        """*run*, whose errors are at *at* unless they know better."""

        def placed(scope: Scope) -> Value:
            try:
                return run(scope)
            except QueryError as err:
                raise _at(err, at) from None

        return placed

    # Conditions.

    def _not(self, tree: Not, names: Names) -> Run:
        item = self.condition(tree.item, names)
        return lambda scope: not item(scope)

    def _and(self, tree: And, names: Names) -> Run:
        items = [self.condition(item, names) for item in tree.items]
        return lambda scope: all(item(scope) for item in items)

    def _or(self, tree: Or, names: Names) -> Run:
        items = [self.condition(item, names) for item in tree.items]
        return lambda scope: any(item(scope) for item in items)

    def _compare(self, tree: Compare, names: Names) -> Run:
        left, right, compare = self.make(tree.left, names), self.make(tree.right, names), COMPARISONS[tree.sign]
        machine, at = self.machine, tree.at

        def compared(scope: Scope) -> bool:
            a, b = left(scope), right(scope)
            if a.__class__ is QueryList or a.__class__ is QueryRecord:
                machine.tick(weight_of(a))
            try:
                return compare(a, b)
            except QueryError as err:
                raise _at(err, at) from None

        return compared

    def _member(self, tree: Membership, names: Names) -> Run:
        item, container, expected = self.make(tree.item, names), self.make(tree.container, names), not tree.negated
        machine = self.machine

        def member(scope: Scope) -> bool:
            one, all_of_them = item(scope), container(scope)
            machine.tick(weight_of(one) + (weight_of(all_of_them) if isinstance(all_of_them, str) else 0))
            return contains(all_of_them, one) is expected

        return self.placed(member, tree.at)

    def _set_compare(self, tree: SetCompare, names: Names) -> Run:
        left, right, compare = self.make(tree.left, names), self.make(tree.right, names), SET_COMPARISONS[tree.sign]
        return lambda scope: compare(left(scope), right(scope))

    def _quantified(self, tree: Quantified, names: Names) -> Run:
        source = self.make(tree.source, names)
        condition = self.condition(tree.condition, names | {tree.name})
        machine, name, every, at = self.machine, tree.name, tree.every, tree.at

        def quantified(scope: Scope) -> bool:
            found = items_of(source(scope))
            if found is None:
                raise QueryError("'in' needs a path or a list here", at)
            inner, is_empty = dict(scope), True
            for item in found:
                machine.tick()
                is_empty = False
                inner[name] = item
                if condition(inner) is not every:
                    return not every
            return every and not is_empty

        return quantified

    # Paths and sets.

    def _path(self, tree: Path, names: Names) -> Run:
        head = self.variable(tree.steps[0].name, tree.at, names)
        inner = names | {"self"}
        conditions = [None if s.condition is None else self.condition(s.condition, inner) for s in tree.steps]
        steps = list(zip(tree.steps[1:], conditions[1:], strict=True))
        machine = self.machine

        def kept(
            value: Value, condition: Callable[[Scope], bool] | None, scope: Scope, into: dict[Value, None]
        ) -> None:
            for item in elements(value):
                machine.tick()
                if condition is not None:
                    scope["self"] = item
                    if not condition(scope):
                        continue
                into[item] = None

        def path(scope: Scope) -> Value:
            own = dict(scope)
            level: dict[Value, None] = {}
            kept(head(scope), conditions[0], own, level)
            for step, condition in steps:
                found: dict[Value, None] = {}
                for item in level:
                    machine.tick()
                    try:
                        value = attribute(item, step.name, step.at)
                    except QueryError as err:
                        machine.missing.setdefault((step.at, step.name, kind_of(item)), (err.message, err.help))
                        continue
                    kept(value, condition, own, found)
                level = found
            return QueryList.of(level, True)

        return self.placed(path, tree.at)

    def _set_operation(self, tree: SetOperation, names: Names) -> Run:
        items, operator = [self.make(item, names) for item in tree.items], SETS[tree.sign]
        machine = self.machine

        def operation(scope: Scope) -> Value:
            value = items[0](scope)
            for item in items[1:]:
                other = item(scope)
                machine.tick((len(value) + len(other)) >> 3)
                value = operator(value, other)
            return value

        return self.placed(operation, tree.at)

    def _flwr(self, tree: Flwr, names: Names) -> Run:
        from haros_ci.query.flwr import make_flwr

        return make_flwr(self, tree, names)

    def function(self, tree: QueryFunction, names: Names) -> Run:
        from haros_ci.query.flwr import make_function

        return make_function(self, tree, names)


def _at(err: QueryError, at: int) -> QueryError:
    if err.at < 0:
        err.at = at
    return err


_MAKERS: dict[type, str] = {
    Literal: "_literal", ListOf: "_list", DictOf: "_dict", Chain: "_chain", QueryIf: "_if", Arithmetic: "_arithmetic",
    Negative: "_negative", Not: "_not", And: "_and", Or: "_or", Compare: "_compare", Membership: "_member",
    SetCompare: "_set_compare", Quantified: "_quantified", Path: "_path", SetOperation: "_set_operation",
    QueryFunction: "function", Flwr: "_flwr",
}  # fmt: skip
