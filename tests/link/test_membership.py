# SPDX-License-Identifier: Apache-2.0
"""Python: whether a key is in a dict is known where all of its keys are, whatever stands under them."""

from __future__ import annotations

import pytest
from follow_kit import names, python

DICTS = "d = {'a': unheard(), 'b': lambda: 1}\n"


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("PUB('x' if 'a' in d else 'y')", ["/x"]),
        ("PUB('x' if 'c' in d else 'y')", ["/y"]),
        ("PUB('x' if 'c' not in d else 'y')", ["/x"]),
        ("PUB('x' if 'a' not in d else 'y')", ["/y"]),
        ("d['c'] = unheard()\nPUB('x' if 'c' in d else 'y')", ["/x"]),
        ("e = {'r': d, 's': {}}\nfor t in [k for k, v in e.items() if 'b' in v]:\n    PUB(t)", ["/r"]),
        ("e = {'r': d, 's': {}}\nfor k in e:\n    if 'b' not in e[k]:\n        PUB(k)", ["/s"]),
        ("if 'c' in d:\n    PUB('x')\nPUB('z')", ["/x", "/z"]),  # ruled out, and marked so
    ],
)
def test_keys_are_known(code: str, expected: list[str]) -> None:
    assert names(python(DICTS + code)) == expected


@pytest.mark.parametrize(
    "code",
    [
        "if unheard():\n    d['c'] = 1\nPUB('x' if 'c' in d else 'y')",
        "for k in unheard():\n    d[k] = 1\nPUB('x' if 'c' in d else 'y')",
        "d[unheard()] = 1\nPUB('x' if 'c' in d else 'y')",
        "d.update(unheard())\nPUB('x' if 'c' in d else 'y')",
        "d.pop(unheard(), None)\nPUB('x' if 'a' in d else 'y')",
        "d = dict(unheard())\nPUB('x' if 'c' in d else 'y')",
        "d = unheard()\nPUB('x' if 'c' in d else 'y')",
        "PUB('x' if unheard() in d else 'y')",
        "unheard(d)\nPUB('x' if 'c' in d else 'y')",
        "d = {**unheard(), 'a': 1}\nPUB('x' if 'c' in d else 'y')",
        "if unheard():\n    del d['a']\nPUB('x' if 'a' in d else 'y')",
        "d.setdefault(unheard(), 1)\nPUB('x' if 'c' in d else 'y')",
        "d |= unheard()\nPUB('x' if 'c' in d else 'y')",
        "while unheard():\n    d['c'] = 1\nPUB('x' if 'c' in d else 'y')",
    ],
)
def test_both_ways_stay_open(code: str) -> None:
    assert names(python(DICTS + code)) in (["/x", "/y"], ["/?"])


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("del d['a']\nPUB('x' if 'a' in d else 'y')", ["/y"]),
        ("d.pop('a')\nPUB('x' if 'a' in d else 'y')", ["/y"]),
        ("d.clear()\nPUB('x' if 'a' in d else 'y')", ["/y"]),
    ],
)
def test_what_is_taken_out_is_not_in_it(code: str, expected: list[str]) -> None:
    assert names(python(DICTS + code)) in (expected, ["/?"], ["/x", "/y"])


FILLED = """import rospy
from std_msgs.msg import String
class N:
    def __init__(self):
        self.d = {}
        rospy.Subscriber('s', String, self.one)
        rospy.Subscriber('t', String, self.two)
    def one(self, m):
        self.d[%s] = 1
    def two(self, m):
        if 'c' in self.d:
            rospy.Publisher('x', String, queue_size=1)
        rospy.Publisher('p' if 'c' in self.d else 'q', String, queue_size=1)
N()
"""


@pytest.mark.parametrize("key", ["'c'", "m.data"])
def test_what_another_callback_puts_in_is_not_ruled_out(key: str) -> None:
    found = python(FILLED % key)
    made = [end for end in found.endpoints if end.kind == "publishers"]
    assert not any(end.is_ruled_out for end in made)
    assert {"/x", "/p"} <= {end.name for end in made} or {"/x", "/?"} <= {end.name for end in made}
