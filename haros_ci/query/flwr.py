# SPDX-License-Identifier: Apache-2.0
"""Evaluation of for, let, where, order by, return and collect."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from haros_ci.query.access import Own, call
from haros_ci.query.fault import QueryError
from haros_ci.query.joins import JoinPlan, rows
from haros_ci.query.machine import Scope
from haros_ci.query.syntax import Collect, Flwr, Order, QueryFunction, ReturnedValue
from haros_ci.query.values import QueryEntity, QueryList, QueryRecord, Value, items_of, kind_of, words

if TYPE_CHECKING:
    from haros_ci.query.evaluate import Compiler, Names, Run


def make_function(compiler: Compiler, tree: QueryFunction, names: Names) -> Run:
    """A function sees all variables around it, those let after it included."""
    body = compiler.make(tree.body, names | set(tree.parameters))
    return lambda scope: Own(tree.parameters, body, scope)


def make_flwr(compiler: Compiler, tree: Flwr, names: Names) -> Run:
    sources = _sources(compiler, tree, names)
    variables = [one.name for one in tree.fors]
    lets = _lets(compiler, tree, names | set(variables))
    inner = names | set(variables) | {let.name for let in tree.lets}
    plan = JoinPlan.of(compiler, tree, names, lets)
    machine = compiler.machine

    def scopes(scope: Scope) -> Iterator[Scope]:
        """The variables of each row that ``where`` lets through."""
        pools = []
        for source, one in zip(sources, tree.fors, strict=True):
            value = source(scope)
            found = items_of(value)
            if found is None:
                raise QueryError(f"{one.name} cannot go through a {kind_of(value)}", one.at)
            pools.append(tuple(found))
            machine.tick(len(pools[-1]))
        for elements, where in rows(plan, machine, pools, scope):
            machine.tick()
            own = dict(scope)
            own.update(zip(variables, elements, strict=True))
            for name, let in lets:
                own[name] = let(own)
            if all(condition(own) for condition in where):
                yield own

    if tree.collects:
        return compiler.placed(_collecting(compiler, tree.collects, inner, scopes), tree.at)
    output = tree.output
    assert output is not None
    give = _output(compiler, output, inner)

    def run(scope: Scope) -> Value:
        found: list[Value] = []
        for own in scopes(scope):
            value = give(own)
            if tree.flatten:
                found.extend(flattened(value))
            else:
                found.append(value)
            if len(found) & 1023 == 0:
                QueryList.of(found)  # raises QueryError if there are too many
        return QueryList.of(found if tree.order is None else in_order(found, tree.order, output), True)

    return compiler.placed(run, tree.at)


def _sources(compiler: Compiler, tree: Flwr, names: Names) -> list[Run]:
    from haros_ci.query.evaluate import UnknownVariable

    try:
        return [compiler.make(one.source, names) for one in tree.fors]
    except UnknownVariable as err:
        if err.name in (one.name for one in tree.fors):
            err.message = f"{err.name} is a variable of the same for, which is not seen here"
            err.help = "go through all of them, and join the two in where"
        raise


def _lets(compiler: Compiler, tree: Flwr, names: Names) -> list[tuple[str, Run]]:
    every = names | {let.name for let in tree.lets}
    found = []
    for let in tree.lets:
        is_function = isinstance(let.value, QueryFunction)
        found.append((let.name, compiler.make(let.value, every if is_function else names)))
        names |= {let.name}
    return found


def _output(compiler: Compiler, output: ReturnedValue, names: Names) -> Run:
    values = [compiler.make(value, names) for value in output.values]
    if output.names:
        return lambda scope: QueryRecord({name: value(scope) for name, value in zip(output.names, values, strict=True)})
    if len(values) == 1:
        return values[0]
    return lambda scope: QueryList.of((value(scope) for value in values), True)


def flattened(value: Value) -> Iterator[Value]:
    """The values in tuples and sets, and in those within them."""
    if value.__class__ is QueryList and value.flat:
        for item in value:
            yield from flattened(item)
    else:
        yield value


def in_order(found: list[Value], order: Order, output: ReturnedValue) -> list[Value]:
    """*found*, sorted by one of the values returned."""

    def key(value: Value) -> tuple[int, Value]:
        if output.names:
            value = value[order.key]
        elif len(output.values) > 1:
            value = value[order.key]
        return sort_key(value)

    return sorted(found, key=key, reverse=order.descending)


def sort_key(value: Value) -> tuple[int, Value]:
    """None, then numbers, then texts and entities by name, then the rest as text."""
    if value is None:
        return (0, 0)
    if isinstance(value, (int, float)):
        return (1, value)
    if isinstance(value, str):
        return (2, str(value))
    if value.__class__ is QueryList:
        return (4, tuple(sort_key(item) for item in value))
    return (3, words(value)) if isinstance(value, QueryEntity) else (5, words(value))


def _collecting(
    compiler: Compiler, collects: tuple[Collect, ...], names: Names, scopes: Callable[[Scope], Iterator[Scope]]
) -> Run:
    """``collect value as key with function``: for each, a map of what the function makes of the values of a key, in order."""
    made = [
        (_output(compiler, one.output, names), compiler.make(one.key, names), compiler.make(one.reducer, names), one.at)
        for one in collects
    ]
    machine = compiler.machine

    def run(scope: Scope) -> Value:
        maps: list[dict[Value, Value]] = [{} for _ in made]
        for own in scopes(scope):
            for into, (value, key, reducer, at) in zip(maps, made, strict=True):
                group = key(own)
                try:
                    into[group] = call(machine, reducer(own), (into.get(group), value(own)))
                except QueryError as err:
                    err.at = at if err.at < 0 else err.at
                    raise
        found = [QueryRecord(one) for one in maps]
        return found[0] if len(found) == 1 else QueryList.of(found, True)

    return run
