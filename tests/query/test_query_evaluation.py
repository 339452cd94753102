# SPDX-License-Identifier: Apache-2.0
"""What queries give: paths, sets, for-let-where-return, functions; and what they say where they cannot."""

from __future__ import annotations

import pytest
from query_worlds import Thing, fault, given

from haros_ci.query.engine import Query
from haros_ci.query.values import QueryList, QueryRecord

ONE = Thing(name="one", a=1, b=2, s="/x", map=QueryRecord({"k": 1, "m": 2}))
TWO = Thing(name="two", a=2, b=2, s="y", parts=QueryList.of((ONE,)))
TOP = Thing(name="top", a=3, s="/z", parts=QueryList.of((ONE, TWO, ONE)))
X = [1, 2, 3]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("things", ["one", "two", "top"]),
        ("top", ["top"]),
        ("things[self.a > 1]", ["two", "top"]),
        ("things[self.a > 1]/parts", ["one", "two"]),
        ("things/parts/name", ["one", "two"]),
        ("things/parts/parts", ["one"]),
        ("things[self.s.startswith('/')]/parts[self.b == 2]/a", [1, 2]),
        ("things/map", ["key", "key"]),
        ("things/map[self.value == 2]/key", ["m"]),
        ("x[some t in <things> satisfies (t.a == self)]", [1, 2, 3]),
        ("x[self in <things[self.b == 2]/a>]", [1, 2]),
        ("x[top.a == self]", [3]),
        ("x[len(<things[self.a == 1]>) == self]", [1]),
        ("none", []),
        ("things/b", [2]),
    ],
)
def test_paths(text: str, found: list[object]) -> None:
    result = given(text, things=[ONE, TWO, TOP], top=TOP, x=X, none=None)
    assert [item if not hasattr(item, "key") else "key" for item in result] == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x | y", [1, 2, 3, 4]),
        ("x & y", [3]),
        ("x - y", [1, 2]),
        ("y - x | x", [4]),
        ("x - y & x", [1, 2]),
        ("(x - y) & x", [1, 2]),
        ("x - (y - x)", [1, 2, 3]),
        ("x | x", [1, 2, 3]),
        ("t/parts | t", ["one", "two", "top"]),
    ],
)
def test_sets(text: str, found: list[object]) -> None:
    assert given(text, x=X, y=[3, 4], t=[TOP]) == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("for a in <x> return a", [1, 2, 3]),
        ("for a in <x>, b in <y> return a, b", [[1, 3], [1, 4], [2, 3], [2, 4], [3, 3], [3, 4]]),
        ("for a in <x> where a > 1 return 'k': a, 'm': a * a", [{"k": 2, "m": 4}, {"k": 3, "m": 9}]),
        ("for a in {for b in <x> return b + 1} return a", [2, 3, 4]),
        ("for a in [5, 6] return a", [5, 6]),
        ("for a in [1, 1] return a", [1, 1]),
        ("for a in 'ab' return a", ["a", "b"]),
        ("for a in m return a", ["k", "n"]),
        ("for a in <x> let b = a + 1, c = b * 2 let d = <x[self > a]> where c > 4 return c, len(d)", [[6, 1], [8, 0]]),
        ("for a in <x> let f = function(p, q) { p + q + a } return f(1, 2)", [4, 5, 6]),
        ("for a in <x> let f = function() { for b in <x> where b < a return b } return f()", [[], [1], [1, 2]]),
        ("let f = function(n) { if n < 2 then 1 else n * f(n - 1) } return f(5)", [120]),
        ("let f = function(n) { g(n) + 1 }, g = function(n) { n * 2 } return f(4)", [9]),
        ("let a = {for b in <x> return b} return a[1]", [2]),
        ("return 1, 2", [[1, 2]]),
        ("return <x>", [[1, 2, 3]]),
        ("for a in <x> order by 0 desc return a", [3, 2, 1]),
        ("for a in <x> order by 1 ascd return a, -a", [[3, -3], [2, -2], [1, -1]]),
        (
            "for a in <x> order by 'n' desc return 'k': a, 'n': a * a",
            [{"k": 3, "n": 9}, {"k": 2, "n": 4}, {"k": 1, "n": 1}],
        ),
        ("for a in <x> return flatten {for b in <y> return a, b}", [1, 3, 1, 4, 2, 3, 2, 4, 3, 3, 3, 4]),
        ("for a in <x> return flatten <y>", [3, 4, 3, 4, 3, 4]),
        ("for a in <x> return flatten [a]", [[1], [2], [3]]),
        ("for a in <x> return if a > 1 then <y> else a", [1, [3, 4], [3, 4]]),
        ("for a in <none> return a", []),
    ],
)
def test_clauses(text: str, found: list[object]) -> None:
    assert given(text, x=X, y=[3, 4], m=QueryRecord({"k": 1, "n": 2}), none=[]) == found


def test_values_are_collected_under_keys() -> None:
    text = "for a in <x> collect a as (a > 1) with function(sum, n) { if sum then sum + n else n }"
    assert given(text, x=X) == [{"key": False, "value": 1}, {"key": True, "value": 5}]


def test_several_collections_follow_each_other() -> None:
    add = "with function(sum, n) { if sum then sum + n else n }"
    text = f"for a in <x> collect a as 'sum' {add} collect 1 as 'count' {add}"
    assert given(text, x=X) == [{"key": "sum", "value": 6}, {"key": "count", "value": 3}]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("abs(-2)", 2),
        ("bool('')", False),
        ("bool(<x>)", True),
        ("cmp(1, 2)", -1),
        ("cmp('b', 'a')", 1),
        ("divmod(7, 2)", [3, 1]),
        ("float('1.5')", 1.5),
        ("int('12')", 12),
        ("int(3.9)", 3),
        ("long(4)", 4),
        ("len('abc')", 3),
        ("len(<x>)", 3),
        ("max(<x>)", 3),
        ("max(1, 5, 2)", 5),
        ("min([3, 2])", 2),
        ("min([])", None),
        ("pow(2, 10)", 1024),
        ("pow(2, 10, 7)", 2),
        ("sum(<x>)", 6),
        ("sum(<x>, 4)", 10),
        ("round(2.567, 2)", 2.57),
        ("isinstance(1, int)", True),
        ("isinstance('a', int)", False),
        ("isinstance(t, 'Thing')", True),
        ("isinstance(1.0, [int, float])", True),
        ("is_rosglobal('/a')", True),
        ("is_rosglobal('a')", False),
        ("is_rosglobal(None)", False),
        ("s.split('/')", ["a", "b"]),
        ("s.join(['x', 'y'])", "xa/by"),
        ("s.endswith(['x', 'b'])", True),
        ("s.upper().replace('A', 'B').count('B')", 2),
        ("m.get('none', 3)", 3),
        ("m.items()", [["k", 1]]),
        ("m['k']", 1),
        ("y.index(2)", 1),
        ("y[-1]", 3),
        ("t.parts[0].name", "one"),
        ("None.anything.at.all()", None),
        ("None < 1 or None > 1", False),
        ("True", True),
    ],
)
def test_functions_and_methods(text: str, value: object) -> None:
    assert given(f"return ({text})", x=X, y=X, t=TWO, m=QueryRecord({"k": 1}), s="a/b") == [value]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("thing", "line 1, column 1: there is no variable 'thing'; did you mean 'things'?"),
        ("t/parts[q.a == 1]", "there is no variable 'q'; there is m, self, t, things, x"),
        ("t[self.nam == 'x']", "line 1, column 8: a Thing has no attribute 'nam'; did you mean 'name'?"),
        (
            "for a in <t>\nwhere a.foo == 1 return a",
            "line 2, column 9: a Thing has no attribute 'foo'; there is a, b, map",
        ),
        ("for a in <t>, b in <a/parts> return b", "a is a variable of the same for, which is not seen here"),
        ("t[self.name()]", "a text cannot be called"),
        ("t[self.s.startwith('/')]", "a text has no attribute 'startwith'; did you mean 'startswith'?"),
        ("t[self.s.lower]", "lower of a text is a method; call it: lower()"),
        ("x[self + 'a' == 1]", "line 1, column 8: + is not for number and text"),
        ("x[self < 'a']", "number and text cannot be compared with <"),
        ("x[1 / 0]", "division by zero"),
        ("x[len(self)]", "a number has no length"),
        ("x[len(1, 2)]", "len takes 1 arguments, not 2"),
        ("t[self.s.split('')]", "an empty text cannot separate"),
        ("t[self.parts[2]]", "there is no element 2 among 1"),
        ("x[m['zz']]", "the map has no key 'zz'"),
        ("for a in 1 return a", "a cannot go through a number"),
        ("let f = function(a) {a} return f()", "the function takes 1 arguments, not 0"),
        ("let a = f(1), f = function(b) {b} return a", "there is no variable 'f'"),
        ("return int('x')", "text 'x' is no whole number"),
    ],
)
def test_what_cannot_be_evaluated_is_said_with_its_place(text: str, said: str) -> None:
    assert said in fault(text, things=[ONE], t=TWO, x=X, m=QueryRecord({"k": 1}))


def test_a_step_that_an_element_has_no_attribute_for_gives_nothing_and_a_note() -> None:
    text = "things/part/name"
    query = Query(text, ("things",))
    assert query.matches({"things": QueryList.of((ONE, TWO))}) == ()
    ((at, note),) = query.notes()
    assert (at, note) == (
        7,
        "a Thing has no attribute 'part', so this step gives nothing for it, as in HAROS; did you mean 'parts'?",
    )


@pytest.mark.parametrize("text", ["things/parts", "things[self.a == 9]/nothing", "things/b/self", "none/x"])
def test_no_note_where_nothing_is_passed_over(text: str) -> None:
    query = Query(text, ("things", "none"))
    query.matches({"things": QueryList.of(()) if "self" in text else QueryList.of((ONE,)), "none": None})
    assert query.notes() == ()


def test_a_query_is_asked_of_one_world_after_the_other() -> None:
    query = Query("x[self in <y>]", ("x", "y"))
    first = {"x": QueryList.of(X), "y": QueryList.of((1,))}
    assert [query.matches(first), query.matches({**first, "y": QueryList.of((2, 3))})] == [(1,), (2, 3)]
