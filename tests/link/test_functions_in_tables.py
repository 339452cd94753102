# SPDX-License-Identifier: Apache-2.0
"""Python: functions and bound methods out of pairs, dictionaries and lists, called by a variable of a function."""

from __future__ import annotations

from follow_kit import case, names, python, table

PLAIN = 'def f():\n    PUB("f")\ndef g():\n    PUB("g")\ndef main():\n    %s\nmain()\n'
CLASS = (
    'class N:\n    def __init__(self):\n        self.table = {"a": self.on_a, "b": self.on_b}\n'
    '        self.pairs = [("a", self.on_a), ("b", self.on_b)]\n        rospy.Subscriber("cmd", String, self.called)\n'
    '    def called(self, msg):\n        %s\n    def on_a(self):\n        PUB("a")\n    def on_b(self):\n        PUB("b")\nN()\n'
)


@table((
    case("items of a dictionary", PLAIN % 'for k, h in {"a": f, "b": g}.items():\n        h()', "/f", "/g"),
    case("a list of pairs", PLAIN % 'for k, h in [("a", f), ("b", g)]:\n        h()', "/f", "/g"),
    case("numbered", PLAIN % "for i, h in enumerate([f, g]):\n        h()", "/f", "/g"),
    case("pairs in pairs", PLAIN % "for i, (k, h) in [(1, (2, f))]:\n        h()", "/f"),
    case("a pair", PLAIN % "k, h = (1, f)\n    h()", "/f"),
    case("a comprehension", PLAIN % "[h() for h in [f, g]]", "/f", "/g"),
    case("a comprehension of pairs", PLAIN % '[h() for k, h in [("a", f)]]', "/f"),
    case("of a method, items", CLASS % "for k, h in self.table.items():\n            h()", "/a", "/b"),
    case("of a method, pairs", CLASS % "for k, h in self.pairs:\n            if k == msg.data:\n                h()", "/a", "/b"),
    case("of a method, values", CLASS % "[h() for h in self.table.values()]", "/a", "/b"),
))  # fmt: skip
def test_they_are_followed(before: str, code: str, expected: list[str]) -> None:
    assert names(python(code)) == expected


@table((
    case("not called", PLAIN % "for k, h in [(1, f)]:\n        print(h)"),
    case("the other is called", PLAIN % "for k, h in [(str, f)]:\n        k()"),
    case("a number of that name", PLAIN % "f, g = 1, 2\n    for f in [1]:\n        print(f)"),
    case("not called in a comprehension", PLAIN % "[h for h in [f, g]]"),
))  # fmt: skip
def test_what_calls_none_makes_nothing(before: str, code: str, expected: list[str]) -> None:
    assert names(python(code)) == expected
