# SPDX-License-Identifier: Apache-2.0
"""Python: classes that ``namedtuple`` gives, ``SimpleNamespace``, and attributes that ``__dict__.update`` sets."""

from __future__ import annotations

import pytest
from follow_kit import PYTHON_HEAD, PYTHON_INIT, ends, follow, node, python_files

HEAD = (
    PYTHON_HEAD
    + "import collections\nfrom collections import namedtuple\nimport types\nfrom types import SimpleNamespace\n"
    + "def PUB(n):\n    return rospy.Publisher(n, String, queue_size=1)\n"
    + PYTHON_INIT
)


def names(body: str) -> list[str]:
    return [end.name for end in ends(node(follow(python_files(HEAD + body)))) if not end.implicit]


@pytest.mark.parametrize(
    "body",
    [
        "T = namedtuple('T', ['name', 'rate'])\nPUB(T('a', 1).name)",
        "T = namedtuple('T', ('name', 'rate'))\nPUB(T(rate=1, name='a').name)",
        "T = namedtuple('T', 'rate name')\nPUB(T(1, 'a').name)",
        "T = collections.namedtuple('T', 'rate, name')\nPUB(T(1, name='a').name)",
        "T = namedtuple('T', 'name')\nfor t in [T('a')]:\n    PUB(t.name)",
        "T = namedtuple('T', 'name')\nU = namedtuple('T', 'rate name')\nT('b'), PUB(U(1, 'a').name)",
        "PUB(SimpleNamespace(name='a', rate=1).name)",
        "s = types.SimpleNamespace()\ns.name = 'a'\nPUB(s.name)",
        "class C:\n    def __init__(self, **words):\n        self.__dict__.update(words)\nPUB(C(name='a').name)",
        "class C:\n    def __init__(self, words):\n        vars(self).update(words)\nPUB(C({'name': 'a'}).name)",
        "class C:\n    name = 'b'\n    def __init__(self):\n        self.__dict__.update(name='a', other=text())\nPUB(C().name)",
        "class C:\n    def __init__(self):\n        self.name = 'a'\n        self.__dict__.update({'other': text()})\nPUB(C().name)",
    ],
)
def test_known(body: str) -> None:
    assert names(body) == ["/a"]


@pytest.mark.parametrize(
    "body",
    [
        "T = namedtuple('T', text())\nPUB(T('a').name)",
        "T = namedtuple('T', ['name', text()])\nPUB(T('a', 'b').name)",
        "T = namedtuple('T', 'name rate', defaults=['a', 1])\nPUB(T().name)",
        "T = namedtuple('T', 'class name', rename=True)\nPUB(T('b', 'a')._0)",
        "T = namedtuple('T', 'name')\nPUB(T(text()).name)",
        "T = namedtuple('T', 'name')\nPUB(T('a').other)",
        "T = namedtuple('T', 'name')\nPUB(T(*text()).name)",
        "T = namedtuple('T', 'name')\nPUB(T('a')._replace(name=text()).name)",
        "PUB(SimpleNamespace(**text()).name)",
        "PUB(SimpleNamespace(name='a').other)",
        "class C:\n    def __init__(self, words):\n        self.__dict__.update(words)\nPUB(C(text()).name)",
        "class C:\n    def __init__(self, words):\n        self.name = 'b'\n        self.__dict__.update(words)\nPUB(C(text()).name)",
        "class C:\n    def __init__(self, words):\n        self.name = 'b'\n        self.__dict__.update({'other': 1}, **words)\nPUB(C(text()).name)",
        "class C:\n    def __init__(self):\n        self.__dict__.update({text(): 'a'})\nPUB(C().name)",
        "words = {}\nwords.update(text())\nPUB(words['name'])",
    ],
)  # fmt: skip
def test_not_known(body: str) -> None:
    assert names(body) == ["/?"]
