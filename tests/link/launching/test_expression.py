# SPDX-License-Identifier: Apache-2.0
"""``$(eval ...)``: what is computed, and what is left unknown."""

from __future__ import annotations

import pytest

from haros_ci.launch.ros2.expression import expression_value
from haros_ci.substitutions.names import MARK, Text, literal


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("1", "1"),
        ("1 + 2 * 3", "7"),
        ("7 // 2", "3"),
        ("3 / 2", "1.5"),
        ("-1", "-1"),
        ("'a' + 'Module, '", "aModule, "),
        ("'x' == 'x'", "True"),
        ("'x' != 'x' or not False", "True"),
        ("1 < 2 <= 2", "True"),
        ("'a' in 'abc' and 'd' not in 'abc'", "True"),
        ("'a' in ['a', 'b']", "True"),
        ("'yes' if 1 > 2 else 'no'", "no"),
        ("'' or 'b'", "b"),
        ("len('abc')", "3"),
        ("str(1) + '2'", "12"),
        ("float('1.5')", "1.5"),
        ("int('12')", "12"),
        ("bool('')", "False"),
        ("' A b '.strip().lower()", "a b"),
        ("'abc'.startswith('a')", "True"),
        ("'a_b'.split('_')[1]", "b"),
        ("'abc'[1:]", "bc"),
        ("'a-b'.replace('-', '_')", "a_b"),
        ("[1, 'a']", "[1, 'a']"),
        ("list(set('a_b'.split('_')).intersection(['a', 'c']))", "['a']"),
        ("len({1, 2})", "2"),
        ("None", "None"),
    ],
)
def test_what_is_computed(source: str, expected: str) -> None:
    assert expression_value(literal(source)) == literal(expected)


@pytest.mark.parametrize(
    "source",
    [
        "",
        "1 +",
        "true",
        "__import__('os')",
        "().__class__",
        "'a'.__class__",
        "open('x')",
        "lambda: 1",
        "[x for x in 'ab']",
        "2 ** 100",
        "'a' * 10",
        "f'{1}'",
        "'a'.format(1)",
        "1 / 0",
        "int('a')",
        "[][1]",
        "'a' + 1",
        "list({'a', 'b'})",
        "str({1})",
        "str(*['a'])",
        "(" * 100,
        "-" * 3000 + "1",
        "[" * 300 + "]" * 300,
        "1" * 5000,
        "'" + "a" * 5000 + "'",
    ],
)
def test_what_is_left_unknown(source: str) -> None:
    made = expression_value(literal(source))
    assert made.raw == MARK
    assert len(made.reasons) == 1
    assert made.reasons[0]


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("'?' == 'a'", None),
        ("'?' == 'a' and False", "False"),
        ("'?' == 'a' or True", "True"),
        ("'?' == 'a' or False", None),
        ("False and '?'", "False"),
        ("'?' + 'x'", "?x"),
        ("'a' if '?' == 'b' else 'a'", "a"),
        ("'a' if '?' == 'b' else 'c'", None),
        ("? or True", None),
        ("len('?')", None),
        ("'?'.lower()", None),
        ("not '?' == 'a'", None),
    ],
)
def test_an_unknown_part_counts_where_it_matters(source: str, expected: str | None) -> None:
    made = expression_value(Text(source.replace("?", MARK), ("why",)))
    if expected is None:
        assert made == Text(MARK, ("why",))
    else:
        assert made == Text(expected.replace("?", MARK), ("why",) * expected.count("?"))
