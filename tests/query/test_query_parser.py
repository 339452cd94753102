# SPDX-License-Identifier: Apache-2.0
"""The language: what is read, how it binds, and what is said of what cannot be read."""

from __future__ import annotations

import pytest
from query_worlds import fault, given

from haros_ci.query.fault import QueryError
from haros_ci.query.parser import DEEPEST, parse
from haros_ci.query.syntax import Arithmetic, Chain, Compare, Flwr, Not, Or, Path, SetOperation
from haros_ci.query.tokens import tokens


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0),
        ("12", 12),
        ("017", 15),
        ("0x1F", 31),
        ("0XaB", 171),
        ("1.5", 1.5),
        (".5", 0.5),
        ("2e3", 2000.0),
        ("1.5E-1", 0.15),
        ("'a b'", "a b"),
        ('"it\'s"', "it's"),
        ("''", ""),
        ("'a\nb'", "a\nb"),
        ("'\\n'", "\\n"),
        ("'héllo'", "héllo"),
    ],
)
def test_literals(text: str, value: object) -> None:
    assert given(f"return {text}") == [value]


@pytest.mark.parametrize(
    "text",
    [
        "a // all of it",
        "a /* all\nof it */",
        "/* */ a /**/",
        "// first\na",
        "\ta\r\n",
        "/* ** / * */ a",
    ],
)
def test_comments_and_spaces_are_passed_over(text: str) -> None:
    assert isinstance(parse(text), Path)
    assert given(text, a=[1]) == [1]


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("a - b | c & d", ("-", "a", ("|", "b", ("&", "c", "d")))),
        ("a & b | c - d", ("-", ("|", ("&", "a", "b"), "c"), "d")),
        ("a - b - c", ("-", "a", "b", "c")),
        ("a & (b | c)", ("&", "a", ("|", "b", "c"))),
        ("(a - b) & c", ("&", ("-", "a", "b"), "c")),
        ("((a))", "a"),
    ],
)
def test_intersection_binds_tightest_and_difference_loosest(text: str, tree: object) -> None:
    def shape(item: object) -> object:
        if isinstance(item, SetOperation):
            return (item.sign, *map(shape, item.items))
        assert isinstance(item, Path)
        return item.steps[0].name

    assert shape(parse(text)) == tree


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2 * 3", 7),
        ("(1 + 2) * 3", 9),
        ("7 - 2 - 1", 4),
        ("12 / 3 / 2", 2),
        ("7 / 2", 3),
        ("-7 / 2", -4),
        ("7.0 / 2", 3.5),
        ("-2 * -3", 6),
        ("2 - -1", 3),
        ("'a' + 'b' * 2", "abb"),
        ("[1] + [2, 3]", [1, 2, 3]),
        ("if 1 > 2 then 'a' else if 2 > 1 then 'b' else 'c'", "b"),
        ("{'k': 1, 'm': [2]}", {"k": 1, "m": [2]}),
        ("{}", {}),
        ("[]", []),
    ],
)
def test_arithmetic(text: str, value: object) -> None:
    assert given(f"return {text}") == [value]


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("1 == 1 or 1 == 2 and 1 == 3", True),
        ("(1 == 1 or 1 == 2) and 1 == 3", False),
        ("not 1 == 2 and 2 == 2", True),
        ("not (1 == 1 or 2 == 2)", False),
        ("not not 1 == 1", True),
        ("not not not 1 == 1", False),
        ("1 < 2", True),
        ("2 <= 1", False),
        ("2 > 1 and 2 >= 2", True),
        ("1 + 1 != 2", False),
        ("(1 + 1) * 2 == 4", True),
        ("((1 == 1))", True),
        ("3 in [1, 2, 3]", True),
        ("3 not in [1, 2, 3]", False),
        ("not 3 in [1, 2]", True),
        ("'b' in 'abc'", True),
        ("2 in <x>", True),
        ("2 in x", True),
        ("5 not in <x>", True),
        ("some y in <x> satisfies (y > 2)", True),
        ("every y in <x> satisfies (y > 2)", False),
        ("every y in <x[self > 9]> satisfies (y > 2)", False),
        ("some y in {for z in <x> return z + 5} satisfies (y == 8)", True),
        ("<x[self > 1]> subset <x>", True),
        ("<x> proper subset <x>", False),
        ("<x> superset <x[self > 1]>", True),
        ("<x> proper superset <x[self > 1]>", True),
        ("<x> is <x>", True),
        ("<x> is not <x>", False),
        ("x", True),
        ("0", False),
        ("''", False),
    ],
)
def test_conditions(condition: str, holds: bool) -> None:
    assert given(f"x[{condition}]", x=[1, 2, 3]) == ([1, 2, 3] if holds else [])


def test_a_minus_is_a_difference_in_a_path_and_a_subtraction_in_a_condition() -> None:
    assert given("x - x[self - 1 == 1]", x=[1, 2, 3]) == [1, 3]


def test_a_slash_is_a_step_in_a_path_and_a_division_in_a_condition() -> None:
    assert given("x[self / 2 == 1]", x=[1, 2, 3]) == [2, 3]


def test_reserved_words_are_names_of_attributes() -> None:
    chain = parse("x[self.order.by(1).is[0] == 1]").steps[0].condition.left  # type: ignore[union-attr]
    assert isinstance(chain, Chain)
    assert isinstance(parse("x/order/in"), Path)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("x[a or b]", Or),
        ("x[not a]", Not),
        ("x[a + b]", Arithmetic),
        ("x[a < b]", Compare),
        ("x[(a) < (b)]", Compare),
    ],
)
def test_what_a_condition_is(text: str, kind: type) -> None:
    tree = parse(text)
    assert isinstance(tree, Path)
    assert isinstance(tree.steps[0].condition, kind)


def test_clauses_are_read_in_their_order() -> None:
    tree = parse(
        "for a in <x>, b in {return 1}, c in [1] let d = 1, e = <x> let f = 2 where a order by 0 desc return a, b"
    )
    assert isinstance(tree, Flwr)
    assert [one.name for one in tree.fors] == ["a", "b", "c"]
    assert [one.name for one in tree.lets] == ["d", "e", "f"]
    assert tree.order is not None and tree.order.descending
    assert tree.output is not None and len(tree.output.values) == 2


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1, column 1: the query ends here instead of a variable"),
        ("a/", "line 1, column 3: the query ends here instead of the name of an attribute"),
        ("a/b[", "line 1, column 5: the query ends here instead of a value"),
        ("a b", "line 1, column 3: b stands here instead of the end of the query"),
        ("a[self.x == ]", "line 1, column 13: ] stands here instead of a value"),
        ("a\n| |", "line 2, column 3: | stands here instead of a variable"),
        ("a[self.s == 'x]", "line 1, column 13: the text that begins here has no end; close it with '"),
        ("a /* b", "line 1, column 3: the comment that begins here has no end; close it with */"),
        ("a[self.x = 1]", "line 1, column 10: = stands here instead of ']'"),
        ("a[$x]", "line 1, column 3: '$' is no sign of the language"),
        ("a[x is y]", "line 1, column 5: is stands here instead of ']'"),
        ("a[<b> < <c>]", "line 1, column 7: < stands here instead of subset, superset, proper, is or is not"),
        ("for in <a> return 1", "line 1, column 5: in stands here instead of the name of a variable"),
        ("for a in <x>", "line 1, column 13: the query ends here instead of return or collect"),
        ("for a in <x>, a in <x> return a", "line 1, column 15: a stands twice in one for"),
        ("for a in <x> order by 0 return a", "line 1, column 25: return stands here instead of ascd or desc"),
        ("for a in <x> order by 'k' ascd return a", "order by a name needs names in return"),
        ("for a in <x> order by 0 ascd return 'k': a", "order by a number needs return without names"),
        ("for a in <x> order by 'm' ascd return 'k': a", "return gives nothing called 'm'"),
        ("for a in <x> order by 2 ascd return a, a", "return gives 2 values, the first is number 0"),
        ("return 'k': 1, 2", "instead of 'name': value, as before"),
        ("return function(a) {a}", "a function stands only after 'let name =' and 'with'"),
        ("return 1 + <a>", "a path in <> does not stand here"),
        ("return 08", "begins with 0, which makes it octal"),
        ("1", "line 1, column 1: 1 stands here instead of a variable"),
    ],
)
def test_what_cannot_be_read_is_said_with_its_place(text: str, said: str) -> None:
    assert said in fault(text, a=[1], x=[1])


@pytest.mark.parametrize(
    "text", ["(" * 400, "a[" * 400, "return " + "[" * 400, "return " + "f(" * 400, "{" * 99, "a" * 30_000]
)
def test_what_is_too_deep_or_too_long_is_refused(text: str) -> None:
    with pytest.raises(QueryError):
        parse(text)


def test_reasonable_depth_is_read() -> None:
    depth = DEEPEST - 1
    assert given(f"return {'(' * depth}1{')' * depth}") == [1]


def test_the_last_word_is_the_end() -> None:
    assert [token.kind for token in tokens("a/b")] == ["name", "/", "name", "end"]
