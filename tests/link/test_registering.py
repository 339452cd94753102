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


AROUND_IT = (
    "def around(p):\n    def d(f):\n        def inner(n, *a):\n            %s\n        return inner\n    return d\n"
)
GUARD = "def guard(f):\n    def inner(n):\n        if n is None:\n            return None\n        return f(n)\n    return inner\n@guard\n"


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ((WRAPPER % "n.create_publisher(String, '/w', 1)") + MAKING, (["/a", "/w"], [])),
        (
            AROUND_IT % "return f(n, '/b')" + "@around(1)\ndef a(n, t='/a'):\n    n.create_publisher(String, t, 1)\n",
            (["/b"], []),
        ),
        (
            AROUND_IT % "return f(n, p + '/b')"
            + "@around('/p')\ndef a(n, t='/a'):\n    n.create_publisher(String, t, 1)\n",
            (["/p/b"], []),
        ),
        (AROUND_IT % "return None" + "@around(1)\n" + MAKING, ([], [])),
        (GUARD + MAKING, (["/a"], [])),
        # what stays as it is
        (
            "import functools\n" + GUARD.replace("    def inner", "    @functools.wraps(f)\n    def inner") + MAKING,
            (["/a"], []),
        ),
        ("import functools\n@functools.lru_cache(maxsize=None)\n" + MAKING, (["/a"], [])),
        ("import elsewhere\n@elsewhere.guard\n" + MAKING, (["/a"], [])),
        (LIST + "@reg\n" + MAKING, (["/a"], [])),
        ("def guard(f):\n    return unknown(f)\n@guard\n" + MAKING, (["/a"], [])),
    ],
)
def test_what_a_decorator_puts_around_a_function_is_called(before: str, expected: tuple[list[str], list[str]]) -> None:
    assert made("a(n)", before) == expected


METHOD = "def suffix(s):\n    def d(f):\n        def w(self, t):\n            return f(self, t + s)\n        return w\n    return d\n"


def test_what_a_decorator_puts_around_a_method_is_called_on_the_object() -> None:
    before = (
        METHOD + "class T:\n    def __init__(self, n):\n        self.n = n\n    @suffix('_s')\n    def pub(self, t):\n"
    )
    before += "        self.n.create_publisher(String, t, 1)\n"
    assert made("T(n).pub('/a')", before) == (["/a_s"], [])


CLASSES = "@reg\nclass A:\n    T = '/a'\n@reg\nclass B:\n    T = '/b'\n"


@pytest.mark.parametrize(
    ("body", "before", "expected"),
    [
        ("for c in REG:\n    n.create_publisher(String, c.T, 1)", LIST + CLASSES, ["/a", "/b"]),
        ("n.create_publisher(String, REG[-1].T, 1)", LIST + CLASSES, ["/b"]),
        ("n.create_publisher(String, REG['x'].T, 1)", NAMED + "@reg('x')\nclass A:\n    T = '/a'\n", ["/a"]),
        ("n.create_publisher(String, A.T, 1)", "def reg(c):\n    return c\n" + CLASSES, ["/a"]),
        (
            "n.create_publisher(String, A.T, 1)",
            "import dataclasses\n@dataclasses.dataclass\nclass A:\n    T = '/a'\n",
            ["/a"],
        ),
    ],
)
def test_decorators_that_note_classes(body: str, before: str, expected: list[str]) -> None:
    assert made(body, before)[0] == expected
