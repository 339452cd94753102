# SPDX-License-Identifier: Apache-2.0
"""Python: attributes that ``setattr`` gives names that are computed, and interfaces that are found by their names."""

from __future__ import annotations

import pytest
from follow_kit import names, python, types

CLASS = "class K:\n    default = 'd'\n    def __init__(self, **options):\n        self.topic = 'first'\n%s\n        PUB(self.topic)\nK(topic='t', other=1)\n"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("for k, v in options.items():\n    setattr(self, k, v)", "/t"),
        ("for k in ('topic', 'x'):\n    setattr(self, k, k + 's')", "/topics"),
        ("name = 'top' + 'ic'\nsetattr(self, name, 'u')", "/u"),
        ("setattr(self, 'topic', 'v')", "/v"),
        ("for k in ('a', 'b'):\n    setattr(self, '%s_topic' % k, k + '/x')\nself.topic = self.a_topic + self.b_topic", "/a/xb/x"),
        ("for k in ('default',):\n    setattr(self, k, 'e')\nself.topic = self.default", "/e"),
        ("self.inner = K2()\nfor k in ('z',):\n    setattr(self.inner, k, 'w')\nself.topic = self.inner.z", "/w"),
    ],
)  # fmt: skip
def test_attributes(body: str, expected: str) -> None:
    lines = "\n".join(f"        {line}" for line in body.splitlines())
    assert names(python("class K2:\n    pass\n" + CLASS % lines)) == [expected]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("for k in ('other', 'more'):\n    setattr(self, k, 'x')", "/first"),
        ("for k in other():\n    setattr(self, k, 'x')", "/first"),
        ("for k in ('default',):\n    setattr(self, k, 'e')\nself.topic = K.default", "/d"),
        ("for k in ('topic',):\n    if other():\n        setattr(self, k, 'x')", "/?"),
        ("for k in ('topic',):\n    setattr(self, k, other())", "/?"),
        ("for k in ('new',):\n    if other():\n        setattr(self, k, 'x')\nself.topic = self.new", "/?"),
        ("for k in ('p',):\n    setattr(self, k, 'x')\nself.topic = self.p", "/?"),
    ],
)
def test_attributes_that_are_others_or_not_known(body: str, expected: str) -> None:
    lines = "\n".join(f"        {line}" for line in body.splitlines())
    text = CLASS.replace(
        "    def __init__", "    @property\n    def p(self):\n        return other()\n    def __init__"
    )
    assert sorted(set(names(python(text % lines)))) == expected.split()


FIND = "from roslib.message import get_message_class, get_service_class\nimport roslib.message\n"


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("get_message_class('std_msgs/Bool')", "std_msgs/Bool"),
        ("roslib.message.get_message_class('sensor_msgs/Image')", "sensor_msgs/Image"),
        ("get_message_class('%s/%s' % ('std_msgs', 'Int8'), reload_on_error=True)", "std_msgs/Int8"),
        ("get_message_class(other())", None),
        ("get_message_class('Bool')", None),
        ("get_message_class('std_msgs/' + other())", None),
        ("get_message_class('a/b/c/D')", None),
        ("get_message_class()", None),
    ],
)
def test_interfaces_by_name(kind: str, expected: str | None) -> None:
    assert types(python(FIND + f"rospy.Publisher('a', {kind}, queue_size=1)\n")) == [("/a", expected)]
