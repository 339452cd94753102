# SPDX-License-Identifier: Apache-2.0
"""Joins by hash give what the nested loops give, in their order."""

from __future__ import annotations

from itertools import product

from hypothesis import given as for_all
from hypothesis import settings
from hypothesis import strategies as st
from query_worlds import Thing, fault

from haros_ci.query.engine import Query
from haros_ci.query.fault import QueryError
from haros_ci.query.values import UNKNOWN, QueryList, Value

NAMES = ("u", "v", "w")
VALUES = st.sampled_from([0, 1, 2, 1.0, True, None, "?", "x", UNKNOWN])
THINGS = st.lists(st.builds(lambda a, b, s: Thing(a=a, b=b, s=s), VALUES, VALUES, VALUES), max_size=5)
ATTRIBUTE = st.sampled_from("abs")


@st.composite
def conditions(draw: st.DrawFn) -> str:
    """A condition on u, v and w: ties, filters, both, neither, and some that cannot be evaluated for every element."""
    kind = draw(st.integers(0, 8))
    p, q = draw(st.permutations(NAMES))[:2]
    x, y = draw(ATTRIBUTE), draw(ATTRIBUTE)
    return [
        f"{p}.{x} == {q}.{y}",
        f"{p}.{x} == {q}.{y}",
        f"{p}.{x} != {q}.{y}",
        f"{p}.{x} == 1",
        f"{p}.{x} != None",
        f"({p}.{x} == 1 or {q}.{y} == 'x')",
        f"not {p}.{x} == {q}.{y}",
        f"k == {q}.{y}",
        f"{p}.{x} + 1 == {q}.{y}",
    ][kind]


def nested(where: list[str], pools: list[list[Thing]]) -> list[tuple[Thing, ...]]:
    """The rows that go through all conditions one by one, each row by a query of its own: no join can be made there."""
    text = f"let k = u.a where {' and '.join(where)} return 1"
    query = Query(text, NAMES)
    return [row for row in product(*pools) if query.matches(dict(zip(NAMES, row, strict=True)))]


@settings(max_examples=60, deadline=None)
@for_all(st.lists(conditions(), min_size=1, max_size=4), THINGS, THINGS, THINGS)
def test_a_join_is_the_nested_loop(where: list[str], us: list[Thing], vs: list[Thing], ws: list[Thing]) -> None:
    pools = [us, vs, ws]
    variables: dict[str, Value] = {name: QueryList.of(pool) for name, pool in zip("xyz", pools, strict=True)}
    text = f"for u in x, v in y, w in z let k = u.a where {' and '.join(where)} return u, v, w"
    try:
        expected: object = nested(where, pools)
    except QueryError:
        expected = None  # a row cannot be evaluated; the join may have ruled it out before
    try:
        found: object = [tuple(row) for row in Query(text, variables).matches(variables)]
    except QueryError:
        found = None
        assert expected is None
    if expected is not None:
        assert found == expected


def steps(text: str, size: int) -> int:
    things = QueryList.of(Thing(a=n, b=n % 7, s=str(n)) for n in range(size))
    query = Query(text, ("x",))
    query.matches({"x": things})
    return query.taken


def test_ties_make_the_work_grow_with_the_elements_not_with_their_product() -> None:
    text = "for u in x, v in x, w in x where u.a == v.a and v.s == w.s return u, v, w"
    assert steps(text, 400) < 16 * 400


def test_the_order_of_the_variables_does_not_matter_for_that() -> None:
    text = "for u in x, w in x, v in x where u.a == v.a and v.s == w.s return u, v, w"
    assert steps(text, 400) < 16 * 400


def test_a_let_of_one_variable_can_tie() -> None:
    text = "for u in x, v in x let k = u.a + 0, f = function(n) { n } where f(k) == v.a return u"
    assert steps(text, 400) < 16 * 400


def test_rows_that_nothing_ties_are_many() -> None:
    assert steps("for u in x, v in x where u.a < v.a return 1", 60) >= 60 * 60


def test_an_attribute_that_is_not_there_is_told_from_a_tie() -> None:
    things = [Thing(a=1), Thing(a=2)]
    assert "no attribute 'nope'" in fault("for u in <x>, v in <x> where u.a == v.nope return u", x=things)


def test_unknown_texts_are_tied_to_nothing() -> None:
    things = [Thing(s=UNKNOWN), Thing(s=UNKNOWN), Thing(s="x")]
    variables = {"x": QueryList.of(things)}
    assert Query("for u in <x>, v in <x> where u.s == v.s return 1", variables).matches(variables) == (1,)
    assert Query("for u in <x>, v in <x> where u.s != v.s return 1", variables).matches(variables) == ()
    assert len(Query("x[self.s == '?']", variables).matches(variables)) == 2
