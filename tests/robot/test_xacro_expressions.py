# SPDX-License-Identifier: Apache-2.0
"""Expressions of xacro: what is evaluated, what is unknown, what is refused, and that hostile ones stay small."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

from haros_ci.robot.expressions import Invalid, Undefined, evaluate
from haros_ci.robot.functions import TooMuch
from haros_ci.robot.scopes import XacroGlobals, XacroScope
from haros_ci.robot.texts import is_read, literal, parameters_of, parts_of, truth
from haros_ci.robot.unknown import UNKNOWN
from haros_ci.robot.yaml_values import YamlDict, yaml_value


class Steps:
    def __init__(self, left: int = 100_000) -> None:
        self.left = left

    def __call__(self, steps: int) -> None:
        self.left -= steps
        if self.left < 0:
            raise TooMuch


def value(text: str, **names: Any) -> Any:
    from haros_ci.robot.functions import Module

    scope = XacroScope(XacroGlobals(lambda text, _: text, Module()))
    for name, each in names.items():
        scope.put(name, each, lazy=False, location=None)
    return evaluate(text, scope, Steps())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("pi / 2", math.pi / 2),
        ("math.sin(0)", 0.0),
        ("radians(180)", math.pi),
        ("-x ** 2", -9),
        ("'a' + str(x)", "a3"),
        ("x if x > 2 else 0", 3),
        ("1 < x <= 3", True),
        ("x == 4 or x == 3", True),
        ("not x", False),
        ("[1, 2, 3][-1]", 3),
        ("'a b'.split()[1]", "b"),
        ("d['k'].lower()", "v"),
        ("d.k", "V"),
        ("len(list(range(4)))", 4),
        ("[i * 2 for i in range(4) if i % 2]", [2, 6]),
        ("dict(a=1)['a']", 1),
        ("max(1, min(5, x))", 3),
        ("python.abs(-1)", 1),
        ("'%s'", "%s"),
        ("x // 2", 1),
        ("python.isinstance('a', (list, str)) and not isinstance(1, str)", True),
        ("'x' in 'xyz'", True),
        ("'-'.join(['a', 'b'])", "a-b"),
    ],
)
def test_values(text: str, expected: object) -> None:
    assert value(text, x=3, d=YamlDict(k="V")) == expected


@pytest.mark.parametrize(
    "text",
    [
        "9 ** 9 ** 9",
        "'a' * 10 ** 9",
        "[0] * 10 ** 9",
        "list(range(10 ** 9))",
        "[i for i in range(10 ** 9)]",
        "(lambda: 1)()",
        "open('/etc/passwd')",
        "type(1)",
        "u + 1",
        "u['a']",
        "f'{1}'",
        "'%99999d' % 1",
        "'{:99999}'.format(1)",
        "(1).__class__",
        "''.__class__.__mro__",
        "d.keys.__self__",
        "factorial(100000)",
        "'a'.ljust(10 ** 9)",
        "sum([u])",
    ],
)
def test_what_is_not_followed_is_unknown(text: str) -> None:
    assert value(text, u=UNKNOWN, d=YamlDict(k=1)) is UNKNOWN


@pytest.mark.parametrize("text", ["missing", "missing + 1", "abs(missing)", "'a' if missing else 'b'"])
def test_names_that_are_not_there(text: str) -> None:
    with pytest.raises(Undefined) as caught:
        value(text)
    assert caught.value.name == "missing"


@pytest.mark.parametrize("text", ["1 +", "", "1 / 0", "'a' + 1", "[][1]", "d['z']", "x = 1", "(" * 500])
def test_what_xacro_refuses(text: str) -> None:
    with pytest.raises(Invalid):
        value(text, d=YamlDict(k=1))


def test_steps_are_bounded() -> None:
    assert value("[1 for a in range(1000) for b in range(1000) for c in range(1000)]") is UNKNOWN


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a", (("text", "a"),)),
        ("${a}b", (("expression", "a"), ("text", "b"))),
        ("$(arg x)/${y}", (("substitution", "arg x"), ("text", "/"), ("expression", "y"))),
        ("$${a}", (("text", "${"), ("text", "a}"))),
        ("5$", (("text", "5"), ("text", "$"))),
        ("${a", None),
    ],
)
def test_parts(text: str, expected: object) -> None:
    assert parts_of(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1", 1), ("1.5", 1.5), ("true", True), ("'1'", "1"), ("1_0", "1_0"), ("x", "x"), ("", ""), ("False", False)],
)
def test_literals(text: str, expected: object) -> None:
    assert literal(text) == expected and type(literal(text)) is type(expected)


@pytest.mark.parametrize(
    ("given", "expected"),
    [("true", True), ("0", False), ("2", True), (0.0, False), ("yes", None), ("1.0", None), ([], False)],
)
def test_truth(given: object, expected: bool | None) -> None:
    assert truth(given) is expected


def test_parameters_of_a_macro() -> None:
    text = "a b:=1 c='x y' d:=^ e:=^|2 f:=${p * 2} *g **h i:='' j:=$(arg z)"
    assert list(parameters_of(text)) == [
        ("a", False, None),
        ("b", False, "1"),
        ("c", False, "'x y'"),
        ("d", True, None),
        ("e", True, "2"),
        ("f", False, "${p * 2}"),
        ("*g", False, None),
        ("**h", False, None),
        ("i", False, "''"),
        ("j", False, "$(arg z)"),
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ns:=''' b", [("ns", False, "'''"), ("b", False, None)]),
        ('ns:=""" b:=1', [("ns", False, '"""'), ("b", False, "1")]),
        ("a:='x'y'z' b", [("a", False, "'x'y'z'"), ("b", False, None)]),
        ('a:="it\'s" b', [("a", False, '"it\'s"'), ("b", False, None)]),
        ("a:=x'y z'w b", [("a", False, "x'y z'w"), ("b", False, None)]),
        ("a := 1 b = 2", [("a", False, "1"), ("b", False, "2")]),
        ("a:= b:=2", [("a", False, "b:=2")]),
        ("a:=^|'x y' b:=^ c:=^|", [("a", True, "'x y'"), ("b", True, None), ("c", True, None)]),
        ("a:=^x b", [("a", True, "x"), ("b", False, None)]),
        ("a:=${[1, 2][0]} b:=$(find x)", [("a", False, "${[1, 2][0]}"), ("b", False, "$(find x)")]),
        ("b:=$(find x)/y", [("b", False, "$(find"), ("x)/y", False, None)]),
        ("a:=${d['x y']} *b **c", [("a", False, "${d['x y']}"), ("*b", False, None), ("**c", False, None)]),
        ("a:= 'x b", [("a", False, None), ("'x", False, None), ("b", False, None)]),
        ("\n  a:=''\n  b:=\n", [("a", False, "''"), ("b", False, None)]),
    ],
)
def test_defaults_as_xacro_reads_them(text: str, expected: list[tuple[str, bool, str | None]]) -> None:
    assert list(parameters_of(text)) == expected
    theirs = re.compile(
        r"^\s*([^\s:=]+?)\s*:?=\s*(\^\|?)?(\$\{.*?\}|\$\(.*?\)|(?:'.*?'|\".*?\"|[^\s'\"]+)+|)(?:\s+|$)(.*)", re.DOTALL
    )
    found, left = [], text
    while left.strip():
        match = theirs.match(left)
        if match is not None:
            name, forward, default, left = match.groups()
            found.append((name, bool(forward), default or None))
        else:
            name, *rest = left.split(None, 1)
            left = rest[0] if rest else ""
            found.append((name, False, None))
    assert found == expected


def test_parameters_that_are_no_names_are_told() -> None:
    assert is_read(["a", "*b", "**c", "d.e", "f,"])
    assert not any(is_read(["a", name]) for name in ("'x", 'b:="', "c:", "${d}"))


def test_parameters_of_a_hostile_macro_end() -> None:
    assert len(list(parameters_of("a:=" + "'x\"" * 6_000 + " b"))) == 2
    assert len(list(parameters_of("a:='\" " * 3_000))) <= 300
    assert len(list(parameters_of("a:=" + "'" * 19_000 + "x" * 500 + "'"))) <= 300
    assert len(list(parameters_of("a " * 9_000))) == 300


def test_yaml_units_and_merges() -> None:
    text = "a: &x {k: 1, l: !degrees 180}\nb: {<<: *x, k: 2}\nc: !!python/object:os.system x\n"
    read = yaml_value(text, float)
    assert isinstance(read, YamlDict)
    assert read["a"]["l"] == pytest.approx(math.pi)
    assert read["b"] == {"k": 2, "l": read["a"]["l"]}
    assert read["c"] is UNKNOWN


def test_yaml_of_many_aliases_is_unknown() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 9)]
    assert yaml_value("\n".join(lines), float) is UNKNOWN
    assert yaml_value("a: [", float) is UNKNOWN
