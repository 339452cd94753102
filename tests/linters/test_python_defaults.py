# SPDX-License-Identifier: Apache-2.0
"""Mutable defaults that a function only reads, and those that calls could share."""

from __future__ import annotations

import pytest

from haros_ci.linters.python_defaults import is_only_read

READ = [
    "def f(a=[]):\n    for x in a:\n        print(x)\n",
    "def f(a={}):\n    return a.get('x', 1)\n",
    "def f(a=[1, 2]):\n    return a[0] + a[1]\n",
    "def f(a=[]):\n    return len(a) > 2 and 3 in a\n",
    "def f(a=[]):\n    return list(a)\n",
    "def f(a=[]):\n    return [x for x in a]\n",
    "def f(a=[]):\n    return a + [1]\n",
    "def f(a=[]):\n    a = a + [1]\n    print(a)\n",
    "def f(a=[]):\n    print('%s' % a, f'{a}')\n",
    "def f(a={}):\n    g(**a)\n",
    "def f(a=[]):\n    g(*a)\n",
    "def f(color=[255, 0, 0]):\n    cv2.line(image, 1, 2, color)\n",
    "def f(a=[]):\n    total = []\n    total += a\n",
    "def f(a=[]):\n    g(1, a)\ndef g(x, b):\n    print(b)\n",
    "def f(a=[]):\n    g(x=a)\ndef g(x):\n    print(x)\n",
    "class A:\n    def f(self, a=[]):\n        self.g(a)\n    def g(self, b):\n        print(b)\n",
    "def f(*, a=[]):\n    print(a)\n",
    "def f(a=dict()):\n    print(a['x'])\n",
    "async def f(a=[]):\n    print(a)\n",
    "def f(where=PathJoinSubstitution(['a']), a={}):\n    print(a.items())\n    return where\n",
    "def f(a=[1, 1]):\n    c.r, c.g = a\n",
    "def f(a=[]):\n    if a:\n        print(1)\n",
]
AT_RISK = [
    "def f(a=[]):\n    a.append(1)\n",
    "def f(a=[]):\n    return a\n",
    "def f(a=[]):\n    yield a\n",
    "def f(self, a=[]):\n    self.a = a\n",
    "def f(a={}):\n    a['x'] = 1\n",
    "def f(a={}):\n    del a['x']\n",
    "def f(a=[]):\n    a += [1]\n",
    "def f(a=[]):\n    b = a\n    b.append(1)\n",
    "def f(a=[]):\n    all_of_them.append(a)\n",
    "def f(a=[]):\n    return Node(a)\n",
    "def f(a=[]):\n    super().__init__(a)\n",
    "def f(a=[]):\n    g(1, a)\ndef g(x, b):\n    b.sort()\n",
    "def f(a=[]):\n    g(x=a)\ndef g(x):\n    return x\n",
    "def f(self, a=[], b=[]):\n    print(a)\n    self.b = b\n",
    "def f(self, a=None or [], b=[]):\n    self.b = b or 1\n",
    "def f(a=[]):\n    return {'a': a}\n",
    "def f(a=[]):\n    c = d, e = a\n",
    "def f(a=[]):\n    return lambda: a\n",
    "def f(a=A()):\n    a.x = 1\n",
    "def f(a=A()):\n    a.go()\n",
    "def f(a=[]):\n    f(a)\n    a.clear()\n",
    "def f(a=[]:\n",
    "x = 1\n",
    "",
]


def line_of(text: str) -> int:
    return next((i for i, line in enumerate(text.split("\n"), 1) if "def f" in line), 1)


@pytest.mark.parametrize("text", READ)
def test_only_read(text: str) -> None:
    assert is_only_read(text, line_of(text))


@pytest.mark.parametrize("text", AT_RISK)
def test_at_risk(text: str) -> None:
    assert not is_only_read(text, line_of(text))


def test_one_of_two_defaults() -> None:
    text = "def f(é='é', a=[],\n      b=[]):\n    a.sort()\n    print(b)\n"
    assert not is_only_read(text, 1, 15) and is_only_read(text, 2, 8)
    assert not is_only_read(text, 1, 3)


def test_functions_that_call_each_other() -> None:
    text = "def f(a=[]):\n    g(a)\ndef g(a):\n    f(a)\n    h(a)\ndef h(a):\n    {}\n"
    assert is_only_read(text.format("print(a)"), 1)
    assert not is_only_read(text.format("a.sort()"), 1)
