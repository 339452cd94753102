# SPDX-License-Identifier: Apache-2.0
"""Decorators of the workspace over classes of Python: another class that they give is made, what is not known is a gap."""

from __future__ import annotations

import pytest
from follow_kit import follow, names, node, python_files, script

OTHER = 'class Other:\n    def __init__(self):\n        PUB("other")\n\n'
OWN = 'class Own:\n    def __init__(self):\n        PUB("own")\n\nOwn()\n'
#: By what stands over the class: what is made.
OTHERS = {
    "def swap(cls):\n    return Other\n\n@swap\n": ["/other"],
    "def swap(kind):\n    def inner(cls):\n        return kind\n    return inner\n\n@swap(Other)\n": ["/other"],
    "swap = lambda cls: Other\n\n@swap\n": ["/other"],
    "def same(cls):\n    return cls\n\ndef swap(cls):\n    return Other\n\n@same\n@swap\n": ["/other"],
}
SAME = {
    "def same(cls):\n    return cls\n\n@same\n": ["/own"],
    "def mark(cls):\n    cls.mark = 1\n    return cls\n\n@mark\n": ["/own"],
    "KNOWN = {}\n\ndef register(name):\n    def inner(cls):\n        KNOWN[name] = cls\n        return cls\n    return inner\n\n@register('a')\n": [
        "/own"
    ],
    "import dataclasses\n\n@dataclasses.dataclass(init=False)\n": ["/own"],
    "import abc\n\n@abc.final\n": ["/own"],
    "def unused(cls):\n    return Other\n\n": ["/own"],
}
UNKNOWN = (
    "def swap(cls):\n    return type('New', (Other,), {})\n\n@swap\n",
    "class Swap:\n    def __init__(self, cls):\n        self.cls = cls\n    def __call__(self):\n        return Other()\n\n@Swap\n",
    "import somewhere\n\ndef swap(cls):\n    return somewhere.changed(cls)\n\n@swap\n",
)


@pytest.mark.parametrize(("over", "made"), [*OTHERS.items(), *SAME.items()])
def test_what_a_decorator_gives_is_made(over: str, made: list[str]) -> None:
    found = node(follow(python_files(script(OTHER + over + OWN))))
    assert names(found) == made
    assert not [unknown for unknown in found.unknowns if "decorator" in unknown.reason]


@pytest.mark.parametrize("over", UNKNOWN)
def test_what_is_not_known_is_a_gap(over: str) -> None:
    found = node(follow(python_files(script(OTHER + over + OWN))))
    (gap,) = [unknown for unknown in found.unknowns if unknown.field == "endpoints"]
    assert gap.reason.endswith("makes of the class Own is not known: it may be another class")
