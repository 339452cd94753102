# SPDX-License-Identifier: Apache-2.0
"""The evaluator of expressions: its limits hold wherever an expression may stand, and what is within them is what Python gives."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable

import pytest

from haros_ci.bounded_python.limits import Limits, TooMuch, bounded, parsed, weight
from haros_ci.launch.ros2.expression import expression_value
from haros_ci.robot.expressions import Invalid, Undefined
from haros_ci.robot.expressions import evaluate as of_xacro
from haros_ci.robot.functions import Module
from haros_ci.robot.scopes import XacroGlobals, XacroScope
from haros_ci.robot.unknown import UnknownValue
from haros_ci.substitutions.expression import ExpressionScopes, Undecided, Wrong
from haros_ci.substitutions.expression import evaluate as of_roslaunch
from haros_ci.substitutions.names import literal, unknown

SMALL = Limits(characters=100, depth=5, size=20, bits=64, weight=50, brackets=3, signs=6)


class Steps:
    def __init__(self) -> None:
        self.left = 500_000

    def __call__(self, steps: int) -> None:
        self.left -= steps
        if self.left < 0:
            raise TooMuch


def xacro(text: str) -> str | None:
    try:
        found = of_xacro(text, XacroScope(XacroGlobals(lambda text, _: text, Module())), Steps())
    except (Invalid, Undefined):
        return None
    return None if isinstance(found, UnknownValue) else str(found)


def roslaunch(text: str) -> str | None:
    try:
        return of_roslaunch(text, ExpressionScopes({}, unknown, {}, ""))
    except (Undecided, Wrong):
        return None


def launch(text: str) -> str | None:
    found = expression_value(literal(text))
    return found.raw if found.known else None


EVERY = pytest.mark.parametrize("value", [xacro, roslaunch, launch])


@EVERY
@pytest.mark.parametrize(
    "text",
    [
        "1 + 2 * 3 - 4 / 5 // 1 % 7",
        "-1 + +2",
        "not 1 > 2 or 'a' in 'abc' and 'd' not in 'abc'",
        "1 < 2 <= 2 != 3",
        "'yes' if 1 == 1 else 'no'",
        "[1, 'a', (2.5,)][0:2]",
        "'a,b'.split(',')[-1].upper()",
        "str(1) + str('a')",
        "int('12') + len('abc') + max(1, 2) + abs(-1)",
        "sorted([2, 1])",
        "None is None",
        "'abc'[1:]",
        "'aba'.replace('a', 'cc')",
        "list(tuple([1, 2]))",
        "bool('') == any([]) == False",
        "1 if all([1, 'a']) else 2",
        "float('1e3') * 2",
    ],
)
def test_what_all_languages_follow_is_what_python_gives(value: Callable[[str], str | None], text: str) -> None:
    assert value(text) == str(eval(text))


@EVERY
@pytest.mark.parametrize(
    "text",
    [
        "9 ** 9 ** 9",
        "2 ** 100000",
        "'a' * 10 ** 9",
        "10 ** 9 * [0]",
        "(1, 2) * 10 ** 9",
        "[['a' * 10000] * 10000] * 10000",
        "str([['a' * 10000] * 10000] * 10000)",
        "'%s' % ([['a' * 10000] * 10000] * 10000)",
        "f'{[[0] * 10000] * 10000}'",
        "sum([[0] * 1000] * 1000, [])",
        "'%999999999d' % 1",
        "'%*d' % (999999999, 1)",
        "'{:999999999}'.format(1)",
        "('a' * 9999).replace('a', 'b' * 9999)",
        "('a' * 9999).join(['a'] * 9999)",
        "int('9' * 5000)",
        "'a'.zfill(10 ** 9)",
        "'a'.center(10 ** 9)",
        "list(range(10 ** 9))",
        "[i for i in range(10 ** 9)]",
        "[1 for a in range(1000) for b in range(1000) for c in range(1000)]",
        "factorial(100000)",
        "1 << 10 ** 9",
        "bytes(10 ** 9)",
        "[" * 90 + "]" * 90,
        "-" * 900 + "1",
        "not " * 400 + "1",
        "1" + "+1" * 900,
        "'" + "a" * 5000 + "'",
        "().__class__.__bases__[0].__subclasses__()",
        "__import__('os').system('true')",
        "open('/etc/hostname').read()",
        "(lambda: 1)()",
        "exec('1')",
        "'a'.__class__",
        "'{0.__class__}'.format(1)",
        "(x := 1)",
        "[*'ab'] + [1]",
    ],
)
def test_what_is_hostile_is_not_followed_and_soon_left(value: Callable[[str], str | None], text: str) -> None:
    start = time.perf_counter()
    assert value(text) is None
    assert time.perf_counter() - start < 2


@pytest.mark.parametrize("value", [xacro, roslaunch])
def test_numbers_are_rounded_within_limits(value: Callable[[str], str | None]) -> None:
    assert value("round(1234, -10 ** 9)") == "0"
    assert value("round(1.26, 1)") == "1.3"


def test_what_stands_first_is_said_first_by_roslaunch() -> None:
    with pytest.raises(Wrong, match="'one' is not"):
        of_roslaunch("one[two:]", ExpressionScopes({}, unknown, {}, ""))


def test_xacro_sorts_backwards() -> None:
    assert xacro("sorted([1, 3, 2], reverse=True)") == "[3, 2, 1]"


@EVERY
def test_the_parser_warns_nobody_of_what_a_workspace_says(value: Callable[[str], str | None]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert value("'\\d'") == "\\d"


@pytest.mark.parametrize("text", ["1" * 101, "((((", "------- 1"])
def test_a_text_over_a_limit_is_not_parsed(text: str) -> None:
    with pytest.raises(TooMuch):
        parsed(text, SMALL)


@pytest.mark.parametrize("value", ["a" * 21, [0] * 21, range(21), 2**64])
def test_a_value_over_a_limit_is_refused(value: object) -> None:
    with pytest.raises(TooMuch):
        bounded(value, SMALL)


def test_what_a_value_holds_counts_each_time() -> None:
    ten = [0] * 10
    assert weight([ten, ten], SMALL) == 23
    with pytest.raises(TooMuch):
        weight([ten] * 5, SMALL)
