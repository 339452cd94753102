# SPDX-License-Identifier: Apache-2.0
"""Python's generators: who goes through them, or takes what comes next, sees what they yield."""

from __future__ import annotations

import pytest
from follow_kit import names, python

AB = 'def g():\n    yield "a"\n    yield "b"\n'
#: Code, and the names that follow.
KNOWN = (
    (AB + "for n in g():\n    PUB(n)", ["/a", "/b"]),
    (AB + "[PUB(n) for n in g()]", ["/a", "/b"]),
    (AB + 'l = [n + "x" for n in g()]\nPUB(l[1])', ["/bx"]),
    (AB + "l = list(g())\nPUB(l[1])", ["/b"]),
    (AB + "l = tuple(g())\nfor n in l[1:]:\n    PUB(n)", ["/b"]),
    (AB + "i = g()\nPUB(next(i))", ["/a"]),
    (AB + "i = g()\nnext(i)\nPUB(next(i))", ["/b"]),
    (AB + "i = iter(['c'])\nnext(i)\nPUB(next(i, 'd'))", ["/d"]),
    (AB + "for n, m in zip(g(), ['x', 'y']):\n    PUB(n + m)", ["/ax", "/by"]),
    (AB + "s = '_'.join(g())\nPUB(s)", ["/a_b"]),
    (AB + "x, y = g()\nPUB(y)", ["/b"]),
    (AB + 'def h():\n    yield from g()\n    yield "c"\nfor n in h():\n    PUB(n)', ["/a", "/b", "/c"]),
    (AB + 'def h():\n    for n in g():\n        yield n + "1"\nfor n in h():\n    PUB(n)', ["/a1", "/b1"]),
    (
        'def g(l, n):\n    for i in range(0, len(l), n):\n        yield l[i:i + n]\nfor c in g(["a", "b", "c"], 2):\n    PUB(c[0])',
        ["/a", "/c"],
    ),
    (
        'def g():\n    i = 0\n    while i < 2:\n        yield "t%d" % i\n        i += 1\nfor n in g():\n    PUB(n)',
        ["/t0", "/t1"],
    ),
    ('def g():\n    yield "a"\n    return\n    yield "b"\nfor n in g():\n    PUB(n)', ["/a"]),
    (
        'def g():\n    for k, v in sorted({"a": "b"}.items()):\n        yield k, v\nfor k, v in g():\n    PUB(k + v)',
        ["/ab"],
    ),
    (
        'class C:\n    def g(self):\n        for i in range(2):\n            yield "t%d" % i\nfor n in C().g():\n    PUB(n)',
        ["/t0", "/t1"],
    ),
    ('class C:\n    @staticmethod\n    def g():\n        yield "a"\nfor n in C.g():\n    PUB(n)', ["/a"]),
    ('def g():\n    try:\n        yield "a"\n    except ValueError:\n        pass\nfor n in g():\n    PUB(n)', ["/a"]),
    (
        "from contextlib import contextmanager\n@contextmanager\ndef g():\n    yield 'a'\nwith g() as n:\n    PUB(n)",
        ["/a"],
    ),
    ("g = (n + 'x' for n in ['a', 'b'])\nfor n in g:\n    PUB(n)", ["/ax", "/bx"]),
)


@pytest.mark.parametrize(("code", "expected"), KNOWN)
def test_what_a_generator_yields_is_known(code: str, expected: list[str]) -> None:
    assert names(python(code + "\n")) == expected


#: What it yields, or whether it is one, is not known.
NOT_KNOWN = (
    "from o import x\ndef g():\n    yield x\nfor n in g():\n    PUB(n)",
    "from o import many\ndef g():\n    for x in many():\n        yield x\nfor n in g():\n    PUB(n)",
    "from o import many\ndef g():\n    yield 'a'\n    yield from many()\nfor n in g():\n    PUB(n)",
    "def g():\n    x = yield 'a'\n    yield x\nfor n in g():\n    PUB(n)",
    "from o import wrapped\n@wrapped\ndef g():\n    yield 'a'\nPUB(g())",
    "from contextlib import contextmanager\n@contextmanager\ndef g():\n    x = yield 'a'\nwith g() as n:\n    PUB(n)",
    "from o import cond\ndef g():\n    if cond():\n        yield 'a'\n    yield 'b'\nl = list(g())\nPUB(l[0])",
    "def g():\n    i = 0\n    while True:\n        yield 't%d' % i\n        i += 1\nfor n in g():\n    PUB(n)",
)


@pytest.mark.parametrize("code", NOT_KNOWN)
def test_what_is_not_known_is_not_told(code: str) -> None:
    assert names(python(code + "\n")) == ["/?"]


def test_what_a_generator_makes_is_made() -> None:
    assert names(python('def g():\n    PUB("a")\n    yield 1\nfor n in g():\n    pass\n')) == ["/a"]


def test_a_function_inside_that_yields_is_another_one() -> None:
    code = 'def f():\n    def g():\n        yield "a"\n    return "b"\nPUB(f())\n'
    assert names(python(code)) == ["/b"]
