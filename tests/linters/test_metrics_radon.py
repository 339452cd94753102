# SPDX-License-Identifier: Apache-2.0
"""Python measured by hand and by the worker."""

from __future__ import annotations

from math import log2
from typing import Any

import pytest

from haros_ci.linters.metrics_worker import Unmeasurable
from haros_ci.linters.radon_worker import measure


def functions(code: str) -> dict[str, dict[str, Any]]:
    return {f["name"]: f for f in measure(code.encode())["functions"]}


def only(code: str) -> dict[str, Any]:
    (function,) = measure(code.encode())["functions"]
    return dict(function)


@pytest.mark.parametrize(
    ("body", "complexity"),
    [
        ("pass", 1),
        ("if a: pass", 2),
        ("if a and b or c: pass", 4),
        ("for i in a: pass", 2),
        ("while a: pass", 2),
        ("return [i for i in a if i]", 3),
        ("return 1 if a else 2", 2),
        ("assert a and b", 1),
        ("x = 'if a'  # if a", 1),
    ],
)
def test_complexity(body: str, complexity: int) -> None:
    assert only(f"def f():\n    {body}\n")["cc"] == complexity


@pytest.mark.parametrize(
    ("code", "parameters"),
    [
        ("def f(): pass", 0),
        ("def f(a, /, b, *, c=1): pass", 3),
        ("def f(*a, **b): pass", 2),
        ("class A:\n    def f(self, a): pass", 1),
        ("class A:\n    @classmethod\n    def f(cls): pass", 0),
        ("class A:\n    @staticmethod\n    def f(a): pass", 1),
        ("class A:\n    def f(*a): pass", 1),
        ("async def f(a): pass", 1),
    ],
)
def test_parameters(code: str, parameters: int) -> None:
    assert only(code)["parameters"] == parameters


def test_names_and_places() -> None:
    code = "\n".join(
        (
            "class A:",
            "    @property",
            "    def b(self):",
            "        def c(): pass",
            "        return c",
            "    class D:",
            "        async  def  e(self): pass",
            "if True:",
            "    def f(): pass",
            "try:",
            "    pass",
            "except ValueError:",
            "    é = 1; g = lambda: 1",
            "    def h(): pass",
        )
    )
    places = {name: (f["line"], f["column"]) for name, f in functions(code).items()}
    assert places == {"A.b": (3, 9), "A.b.c": (4, 13), "A.D.e": (7, 21), "f": (9, 9), "h": (14, 9)}


LENGTHS = '''\
def f(a):
    """A docstring
    of two lines."""
    # a comment

    b = g(
        a,
    )
    return b  # trailing
'''


def test_lengths() -> None:
    f = only(LENGTHS)
    assert f["nloc"] == 5
    assert f["eloc"] == 4  # without the closing bracket
    metrics = measure(LENGTHS.encode())["file"]
    assert metrics["nloc"] == 5
    assert metrics["comment_ratio"] == pytest.approx(4 / 8)


def test_halstead() -> None:
    """``a + b`` has one operator and two operands."""
    assert measure(b"a + b\n")["file"]["volume"] == pytest.approx(3 * log2(3))
    assert measure(b"a = b\n")["file"]["volume"] == 0


@pytest.mark.parametrize("code", [b"", b"\n\n", b"# only a comment\n", b'"""Only a docstring."""\n', b"\xef\xbb\xbf"])
def test_no_code(code: bytes) -> None:
    metrics = measure(code)["file"]
    assert (metrics["nloc"], metrics["volume"], metrics["mi"]) == (0, 0, 100)


def test_many_branches() -> None:
    code = "def f(x):\n" + "    if x: pass\n" * 10_000
    assert only(code)["cc"] == 10_001


@pytest.mark.parametrize(
    ("code", "line"),
    [
        (b'print "hello"\n', 1),
        (b"x = 1\ntry:\n    pass\nexcept E, e:\n    pass\n", 4),
        (b"def f(:\n", 1),
        (b"x = 1\0\n", None),
    ],
)
def test_what_is_not_python_3(code: bytes, line: int | None) -> None:
    with pytest.raises(Unmeasurable) as caught:
        measure(code)
    assert line in (None, caught.value.line)


@pytest.mark.parametrize("first", ["# coding: latin-1\n", "# café\n", "# coding: no-such-coding\n", "\r\n"])
def test_latin_1(first: str) -> None:
    (function,) = measure((first + "def grün(): pass\n").encode("latin-1"))["functions"]
    assert (function["name"], function["line"], function["column"]) == ("grün", 2, 5)
