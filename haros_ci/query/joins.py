# SPDX-License-Identifier: Apache-2.0
"""Which rows of a ``for`` can satisfy its ``where``, without going through all of them.

Conditions that ``and`` joins are used in two ways: one on a single variable filters its elements, an equality between two
variables (``a.x == b.y``) finds the partners by hash. What is given is what the nested loops would give, in their order.
Only an error that a row would raise which such a condition rules out is not raised.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import isnan
from typing import TYPE_CHECKING, Any

from haros_ci.query.fault import QueryBudgetExhausted, QueryError
from haros_ci.query.free import conjuncts, free
from haros_ci.query.machine import Machine, Scope
from haros_ci.query.syntax import Compare, Flwr, Tree
from haros_ci.query.values import UnknownText, Value
from haros_ci.records import dataclass

if TYPE_CHECKING:
    from haros_ci.query.evaluate import Compiler, Names, Run

Condition = Callable[[Scope], bool]
#: The key of an element for which the condition cannot be evaluated: it stays, until the whole ``where`` decides.
WILD: Any = object()
#: Rows that are held at once.
MOST_ROWS = 1_000_000


@dataclass(frozen=True, slots=True)
class JoinOperand:
    """An expression of one variable, with the ``let`` that it needs."""

    variable: int
    name: str
    lets: tuple[tuple[str, Run], ...]
    run: Callable[[Scope], Value]

    def of(self, element: Value, scope: Scope) -> Value:
        """Its value for *element*; WILD if it has no value."""
        own = {**scope, self.name: element}
        try:
            for name, let in self.lets:
                own[name] = let(own)
            return self.run(own)
        except QueryBudgetExhausted:
            raise
        except QueryError:
            return WILD


@dataclass(frozen=True, slots=True)
class Part:
    """A condition of ``where``: *filter* on one variable, or equality of *sides*, or neither."""

    condition: Condition
    filter: JoinOperand | None = None
    sides: tuple[JoinOperand, JoinOperand] | None = None


@dataclass(frozen=True, slots=True)
class JoinPlan:
    """*parts* of ``where``, in order; *where* is the whole."""

    parts: tuple[Part, ...]

    @staticmethod
    def of(compiler: Compiler, tree: Flwr, names: Names, lets: Sequence[tuple[str, Run]]) -> JoinPlan:
        variables = [one.name for one in tree.fors]
        let_names = [let.name for let in tree.lets]
        inner = names | set(variables) | set(let_names)
        is_clear = len({*variables, *let_names}) == len(variables) + len(let_names) and len(variables) > 1
        uses = {let.name: free(let.value) for let in tree.lets}

        def use(part: Tree, run: Callable[[Scope], Value]) -> JoinOperand | None:
            needed = _closure(free(part), uses)
            mine = [name for name in variables if name in needed]
            if len(mine) != 1:
                return None
            own = tuple((name, let) for name, let in lets if name in needed)
            return JoinOperand(variables.index(mine[0]), mine[0], own, run)

        parts = []
        for part in conjuncts(tree.where):
            condition = compiler.condition(part, inner)
            sides = None
            found = use(part, condition) if is_clear else None
            if found is None and is_clear and isinstance(part, Compare) and part.sign == "==":
                left = use(part.left, compiler.make(part.left, inner))
                right = use(part.right, compiler.make(part.right, inner))
                sides = (left, right) if left and right else None
            parts.append(Part(condition, found, sides))
        return JoinPlan(tuple(parts))


def _closure(names: frozenset[str], uses: dict[str, frozenset[str]]) -> set[str]:
    """*names*, and what the ``let`` among them use, and so on."""
    found: set[str] = set()
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting.extend(uses.get(name, ()))
    return found


def rows(
    plan: JoinPlan, machine: Machine, pools: Sequence[tuple[Value, ...]], scope: Scope
) -> Iterator[tuple[tuple[Value, ...], Sequence[Condition]]]:
    """The rows that may satisfy ``where``, in the order of nested loops, each with the conditions that are still to be held."""
    everything = [part.condition for part in plan.parts]
    if not any(part.filter or part.sides for part in plan.parts):
        yield from ((row, everything) for row in _product(pools, machine))
        return
    left, chosen = _filtered(plan, machine, pools, scope)
    edges = [_edge(part.sides, pools, left, scope, machine) for part in plan.parts if part.sides is not None]
    if not edges:
        still = [part.condition for part in plan.parts if not part.filter] if chosen else everything
        pools = [tuple(pool[n] for n in kept) for pool, kept in zip(pools, left, strict=True)]
        yield from ((row, still) for row in _product(pools, machine))
        return
    is_exact = chosen and all(edge.is_exact for edge in edges)
    still = [p.condition for p in plan.parts if not (p.filter or p.sides)] if is_exact else everything
    for positions in _joined(left, edges, machine):
        yield tuple(pool[n] for pool, n in zip(pools, positions, strict=True)), still


def _product(pools: Sequence[tuple[Value, ...]], machine: Machine) -> Iterator[tuple[Value, ...]]:
    """As itertools.product, which copies nothing; every row is a step."""
    from itertools import product

    for row in product(*pools):
        machine.tick()
        yield row


def _filtered(
    plan: JoinPlan, machine: Machine, pools: Sequence[tuple[Value, ...]], scope: Scope
) -> tuple[list[list[int]], bool]:
    """Positions of the elements that their own conditions leave, and whether all of these could be evaluated."""
    left = [list(range(len(pool))) for pool in pools]
    is_exact = True
    wild: list[set[int]] = [set() for _ in pools]
    for part in plan.parts:
        use = part.filter
        if use is None:
            continue
        kept = []
        for n in left[use.variable]:
            machine.tick()
            if n in wild[use.variable]:
                kept.append(n)
                continue
            value = use.of(pools[use.variable][n], scope)
            if value is WILD:
                wild[use.variable].add(n)
                is_exact = False
            if value:
                kept.append(n)
        left[use.variable] = kept
    return left, is_exact


@dataclass(frozen=True, slots=True)
class JoinCondition:
    """An equality between two variables: the key of each element that is left, by position."""

    variables: tuple[int, int]
    keys: tuple[dict[int, Value], dict[int, Value]]
    is_exact: bool

    def side(self, variable: int) -> dict[int, Value]:
        return self.keys[self.variables.index(variable)]

    def other(self, variable: int) -> int:
        return self.variables[1 - self.variables.index(variable)]


def _edge(
    sides: tuple[JoinOperand, JoinOperand],
    pools: Sequence[tuple[Value, ...]],
    left: Sequence[list[int]],
    scope: Scope,
    machine: Machine,
) -> JoinCondition:
    keys: list[dict[int, Value]] = []
    is_exact = True
    for use in sides:
        found: dict[int, Value] = {}
        for n in left[use.variable]:
            machine.tick()
            value = found[n] = use.of(pools[use.variable][n], scope)
            if (
                value is WILD
                or value.__class__ is UnknownText
                or value == "?"
                or (value.__class__ is float and isnan(value))
            ):
                is_exact = False  # equal keys are not all that == asks for
        keys.append(found)
    return JoinCondition((sides[0].variable, sides[1].variable), (keys[0], keys[1]), is_exact)


def _joined(left: Sequence[list[int]], edges: Sequence[JoinCondition], machine: Machine) -> list[tuple[int, ...]]:
    """The rows, as positions, in the order of nested loops; found in the order that makes few of them."""
    order = _order(left, edges)
    partial: list[tuple[int, ...]] = [()]
    for depth, variable in enumerate(order):
        own = [edge for edge in edges if variable in edge.variables and edge.other(variable) in order[:depth]]
        partners = _partners(variable, left[variable], own, order[:depth])
        grown: list[tuple[int, ...]] = []
        for row in partial:
            found = partners(row)
            machine.tick(1 + len(found))
            grown.extend((*row, n) for n in found)
            if len(grown) > MOST_ROWS:
                help = "tie the variables together with == in where"
                raise QueryBudgetExhausted(f"more than {MOST_ROWS:,} rows have to be looked at", -1, help)
        partial = grown
    if order != sorted(order):
        back = [order.index(variable) for variable in range(len(order))]
        partial = sorted(tuple(row[n] for n in back) for row in partial)
    return partial


def _order(left: Sequence[list[int]], edges: Sequence[JoinCondition]) -> list[int]:
    """The variable with the fewest elements first, then always one that an equality ties to those before, if there is one."""
    waiting = set(range(len(left)))
    order: list[int] = []
    while waiting:
        tied = {v for v in waiting for edge in edges if v in edge.variables and edge.other(v) in order}
        chosen = min(tied or waiting, key=lambda v: (len(left[v]), v))
        order.append(chosen)
        waiting.remove(chosen)
    return order


def _partners(
    variable: int, positions: list[int], edges: Sequence[JoinCondition], before: Sequence[int]
) -> Callable[[tuple[int, ...]], Sequence[int]]:
    """For a row of the variables *before*, the positions of *variable* that its equalities allow."""
    if not edges:
        return lambda row: positions
    mine = [edge.side(variable) for edge in edges]
    theirs = [(edge.side(edge.other(variable)), before.index(edge.other(variable))) for edge in edges]
    table: dict[tuple[Value, ...], list[int]] = {}
    wild: list[int] = []
    for n in positions:
        key = tuple(side[n] for side in mine)
        if any(one is WILD for one in key):
            wild.append(n)
        else:
            table.setdefault(key, []).append(n)

    def partners(row: tuple[int, ...]) -> Sequence[int]:
        key = tuple(side[row[at]] for side, at in theirs)
        if any(one is WILD for one in key):
            return positions
        found = table.get(key, [])
        return sorted((*found, *wild)) if wild else found

    return partners
