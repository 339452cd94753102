# SPDX-License-Identifier: Apache-2.0
"""Python: decorators of the workspace that note functions, or make something around them."""

from __future__ import annotations

import pytest
from follow_kit import explicit
from test_ros2_python import program

LIST = "REG = []\ndef reg(f):\n    REG.append(f)\n    return f\n"
NAMED = "REG = {}\ndef reg(name):\n    def inner(f):\n        REG[name] = f\n        return f\n    return inner\n"
MAKING = "def a(n):\n    n.create_publisher(String, '/a', 1)\n"
AROUND = "what the decorator around puts around functions is not followed"
WRAPPER = "def around(f):\n    def inner(n):\n        %s\n        return f(n)\n    return inner\n@around\n"


def made(body: str, before: str) -> tuple[list[str], list[str]]:
    """The publishers, and why there may be more."""
    (node,) = program("n = Node('n')\n" + body, before).nodes
    return sorted(end.name for end in explicit(node)), [one.reason for one in node.unknowns]


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("for f in REG:\n    f(n)", LIST + "@reg\n" + MAKING),
        ("for f in REG:\n    f(n)", LIST.replace(".append", ".insert").replace("(f)\n    return", "(0, f)\n    return") + "@reg\n" + MAKING),
        ("REG['x'](n)", NAMED + "@reg('x')\n" + MAKING),
        ("for f in REG.values():\n    f(n)", NAMED + "@reg('x')\n" + MAKING),
        ("lib.REG['x'](n)", "from p import lib\nfrom p.lib import reg\n@reg('x')\n" + MAKING),
    ],
)  # fmt: skip
def test_what_is_noted_is_called(body: str, before: str) -> None:
    if "lib" in before:
        (node,) = program("n = Node('n')\n" + body, before, lib=NAMED).nodes
        assert [end.name for end in explicit(node)] == ["/a"]
    else:
        assert made(body, before) == (["/a"], [])


@pytest.mark.parametrize(
    ("body", "before", "names"),
    [
        ("for f in REG:\n    f(n)", LIST + MAKING, []),
        ("REG['y']", NAMED + "@reg('x')\n" + MAKING, []),
        ("a(n)", LIST + "@reg\n" + MAKING, ["/a"]),
        ("a(n)", (WRAPPER % "print(n)") + MAKING, ["/a"]),
        ("a(n)", "import functools\n" + (WRAPPER % "n.x = 1").replace("    def inner", "    @functools.wraps(f)\n    def inner") + MAKING, ["/a"]),
        ("a(n)", "import outside\n@outside.reg\n" + MAKING, ["/a"]),
        ("a(n)", "import functools\n@functools.lru_cache\n" + MAKING, ["/a"]),
    ],
)  # fmt: skip
def test_what_is_not_noted_is_called_as_it_was(body: str, before: str, names: list[str]) -> None:
    assert made(body, before) == (names, [])


def test_what_a_decorator_makes_around_a_function_is_named_as_missing() -> None:
    assert made("a(n)", (WRAPPER % "n.create_publisher(String, '/w', 1)") + MAKING) == (["/a"], [AROUND])
