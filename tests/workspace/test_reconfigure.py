# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import pytest

from haros_ci.model.build import ConfigFile
from haros_ci.workspace.reconfigure import read_config

HEAD = """#!/usr/bin/env python
PACKAGE = "arm"
from dynamic_reconfigure.parameter_generator_catkin import *
from math import pi
gen = ParameterGenerator()
"""
TAIL = '\nexit(gen.generate(PACKAGE, "arm", "Arm"))\n'


def read(body: str) -> tuple[ConfigFile | None, list[tuple[int | None, str]]]:
    config, problems = read_config("cfg/Arm.cfg", HEAD + body + TAIL, "arm")
    return config, [(p.line, p.message) for p in problems]


def rows(body: str) -> list[tuple[str, str, Any, Any, Any, str]]:
    config, problems = read(body)
    assert config is not None and problems == []
    return [(p.name, p.type, p.default, p.minimum, p.maximum, p.group) for p in config.parameters]


def test_the_file() -> None:
    config, _ = read('gen.add("a", int_t, 0, "doc", 1, 0, 9)')
    assert config is not None
    assert (config.name, config.package, config.path) == ("Arm", "arm", "cfg/Arm.cfg")
    where = config.parameters[0].location
    assert (where.path, where.line, where.column) == ("cfg/Arm.cfg", 6, 1)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('gen.add("a", int_t, 0, "doc", 1, 0, 9)', [("a", "int", 1, 0, 9, "")]),
        (
            'gen.add("a", double_t, 0, "doc", pi/2, -pi, 2*pi)',
            [("a", "double", math.pi / 2, -math.pi, 2 * math.pi, "")],
        ),
        ('gen.add("a", bool_t, 0, "doc", True)', [("a", "bool", True, None, None, "")]),
        ('gen.add("a", str_t, 0, "doc")', [("a", "str", None, None, None, "")]),
        ('gen.add("a", str_t, 0, "doc", "x" + "y")', [("a", "str", "xy", None, None, "")]),
        ('gen.add("a", "double", 0, "d", .5, max=2)', [("a", "double", 0.5, None, 2, "")]),
        ('gen.add(name="a", paramtype=int_t, level=0, description="d", default=3)', [("a", "int", 3, None, None, "")]),
        ('N = "a"\nLOW, HIGH = 0, 10 ** 2\ngen.add(N, int_t, 0, "d", 1, LOW, HIGH)', [("a", "int", 1, 0, 100, "")]),
        (
            'g = gen.add_group("G")\nh = g.add_group(name="H")\nh.add("a", int_t, 0, "d")',
            [("a", "int", None, None, None, "G.H")],
        ),
        ('gen.add_group("G").add("a", int_t, 0, "d")', [("a", "int", None, None, None, "G")]),
        (
            'e = gen.enum([gen.const("X", int_t, 0, "x"), gen.const("Y", int_t, 1, "y")], "d")\n'
            'gen.add("a", int_t, 0, "d", 1, 0, 1, edit_method=e)',
            [("a", "int", 1, 0, 1, "")],
        ),
        (
            'for n in ["a", "b"]:\n  gen.add("x_" + n, int_t, 0, "d")',
            [(f"x_{n}", "int", None, None, None, "") for n in "ab"],
        ),
        (
            'for n, v in [("a", 1), ("b", 2)]:\n  gen.add(n, int_t, 0, "d", v)',
            [("a", "int", 1, None, None, ""), ("b", "int", 2, None, None, "")],
        ),
        (
            'for i in range(2):\n  gen.add("a" + str(i), int_t, 0, "d", i)',
            [("a0", "int", 0, None, None, ""), ("a1", "int", 1, None, None, "")],
        ),
        ('for i in range(1):\n  gen.add(f"a{str(i)}", int_t, 0, "d", i)', [("a0", "int", 0, None, None, "")]),
        ('print "python 2"\ngen.add("a", int_t, 0, "d", 010)', [("a", "int", 8, None, None, "")]),
        ('if __name__ == "__main__":\n\tgen.add("a", int_t, 0, "d")', [("a", "int", None, None, None, "")]),
        ('gen.add("a", int_t, 0, "d", compute(), f[0], x)', [("a", "int", None, None, None, "")]),
        ('X = compute()\ngen.add("a", int_t, 0, "d", X)', [("a", "int", None, None, None, "")]),
        ('X = 1\nif y:\n  X = 2\ngen.add("a", int_t, 0, "d", X)', [("a", "int", None, None, None, "")]),
        ('X = 1\nX += 1\ngen.add("a", int_t, 0, "d", X)', [("a", "int", None, None, None, "")]),
        ('gen.add("a", int_t, 0, "d", 1/0, 9**9**9**9, 1 << 4000)', [("a", "int", None, None, None, "")]),
        ('other.add("a", int_t, 0, "d")\nset().add("b")', []),
        ("def f():\n  return 1", []),
        ("while False:\n  x = 1", []),
    ],
)
def test_parameters(body: str, expected: list[tuple[str, str, Any, Any, Any, str]]) -> None:
    assert rows(body) == expected


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('gen.add(name(), int_t, 0, "d")', "the parameter's name is not known before it runs; it is missing"),
        ('gen.add("a", kind, 0, "d")', "the type of 'a' is not bool_t, int_t, double_t or str_t; it is missing"),
        ("gen.add(*row)", "arguments unpacked with * or ** are not followed; the parameter is missing"),
        (
            'for n in names():\n  gen.add(n, int_t, 0, "d")',
            "parameters declared in this loop are not known before it runs; they are missing",
        ),
        (
            'for n in ["a"]:\n  if n: break\n  gen.add(n, int_t, 0, "d")',
            "parameters declared in this loop are not known before it runs; they are missing",
        ),
        (
            'if x:\n  gen.add("a", int_t, 0, "d")',
            "parameters declared under a condition or in a function are not followed",
        ),
        (
            'def f(g):\n  g.add("a", int_t, 0, "d")',
            "parameters declared under a condition or in a function are not followed",
        ),
        ("g = gen.add_group(name())", "the group's name is not a literal; its parameters are listed without it"),
    ],
)
def test_problems(body: str, message: str) -> None:
    config, problems = read(body)
    assert config is not None and config.parameters == ()
    assert problems == [(6, message)]


def test_files_that_generate_nothing() -> None:
    assert read_config("a.cfg", "[metadata]\nname = x", "arm") == (None, [])
    config, problems = read_config("a.cfg", "gen = ParameterGenerator()\ngen.generate(P, N, name())", "arm")
    assert config is None
    assert [p.message for p in problems] == [
        "no generate(package, node, name) with a literal name; the file is left out"
    ]
    config, problems = read_config("a.cfg", "gen = (", "arm")
    assert config is None
    assert [p.message for p in problems] == [
        "not Python that can be read (line 1: '(' was never closed); its parameters are missing"
    ]


@pytest.mark.parametrize(
    "body",
    [
        "x = " + "(" * 500 + ")" * 500,
        "x = " + "-" * 5000 + "1",
        "x = " + "a." * 5000 + "b",
        "gen" + ".add_group('a')" * 3000,
        "for i in range(99999999):\n  for j in range(99999999):\n    x = 1",
        "\x00",
    ],
)
def test_deep_and_long_input_ends(body: str) -> None:
    read(body)


def test_any_text() -> None:
    hypothesis = pytest.importorskip("hypothesis")
    st = hypothesis.strategies
    piece = st.sampled_from(
        [
            "gen",
            "=",
            ".add(",
            ".add_group(",
            "'a'",
            ",",
            ")",
            "\n",
            " ",
            "for x in ",
            "[",
            "]",
            ":",
            "int_t",
            "1",
            "*",
            "-",
            "x",
            "ParameterGenerator()",
            "\t",
            "if",
            "print x",
            "exec y",
            "0777",
            "**",
        ]
    )

    @hypothesis.settings(max_examples=60, deadline=None, database=None, derandomize=True)
    @hypothesis.given(st.lists(piece, max_size=25).map("".join))
    def check(text: str) -> None:
        assert read(text) == read(text)

    check()
