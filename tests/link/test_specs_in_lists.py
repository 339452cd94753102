# SPDX-License-Identifier: Apache-2.0
"""Python: what a list of objects or dictionaries tells of each: keyword arguments out of parameters, and members that are no None."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, node, python_files, script
from test_ros2_python import node as ros2_node

YAML = "inputs:\n- {topic: a, other: b, rate: 0.5}\n- {topic: c, other: d, rate: 1}\n"
LAUNCH = '<launch><node pkg="p" type="n.py" name="n"><rosparam file="$(find p)/c.yaml" command="load"/></node></launch>'
HANDLE = """class H(object):
    def __init__(self, topic, other, rate, more=True):
        self.p = rospy.Publisher(topic, String, queue_size=1)
        self.q = rospy.Publisher(other, String, queue_size=1)
"""
READ = 'every = rospy.get_param("~inputs")\n'
KNOWN = (
    "for one in every:\n    h = H(**one)\n",
    "for n, one in enumerate(every):\n    try:\n        h = H(**one)\n    except ValueError:\n        pass\n",
    "for one in every:\n    if len({'topic'} - set(one.keys())) != 0:\n        raise ValueError('x')\nhs = [H(**one) for one in every]\n",
    "for one in every:\n    h = H(more=False, **one)\n",
)
UNKNOWN = (
    "for one in rospy.get_param('~others'):\n    h = H(**one)\n",
    "import os\nh = H(**os.environ)\n",
)


def _names(body: str) -> list[str]:
    files = {**python_files(script(HANDLE + READ + body), LAUNCH), "p/c.yaml": YAML}
    return sorted(end.name for end in node(follow(files)).endpoints if end.kind == "publishers")


@pytest.mark.parametrize("body", KNOWN)
def test_keywords_out_of_parameters(body: str) -> None:
    assert _names(body) == ["/a", "/b", "/c", "/d"]


@pytest.mark.parametrize("body", UNKNOWN)
def test_keywords_that_are_not_known(body: str) -> None:
    assert set(_names(body)) <= {"/?"}


SPEC = """from dataclasses import dataclass
@dataclass
class Spec:
    name: str
    kind: type
    qos: object = None
"""
SUBSCRIBE = "for s in specs:\n    qos = s.qos if s.qos is not None else 10\n    self.create_subscription(s.kind, s.name, print, qos)\n"


@pytest.mark.parametrize(
    "profile", ["qos_profile_sensor_data", "QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)"]
)
@pytest.mark.parametrize("test", ["s.qos is not None", "None is not s.qos", "s.qos != None", "not (s.qos is None)"])
def test_a_quality_of_service_is_no_none(profile: str, test: str) -> None:
    body = f"q = {profile}\nspecs = [Spec('a', String, q), Spec('b', String, q), Spec('c', String)]\n"
    found = ros2_node(body + SUBSCRIBE.replace("s.qos is not None", test), head=SPEC)
    told = {end.name: (end.qos.depth, end.qos.reliability) for end in explicit(found, "subscribers") if end.qos}
    assert told == {"/s/a": (5, "best_effort"), "/s/b": (5, "best_effort"), "/s/c": (10, "reliable")}
    assert not any(end.unknowns for end in explicit(found, "subscribers"))


@pytest.mark.parametrize("kind", ["String", "SetBool", "str"])
def test_types_are_no_none(kind: str) -> None:
    found = ros2_node(f"k = {kind}\nif k is None:\n    self.create_publisher(String, 'never', 1)\n")
    assert all(end.is_ruled_out for end in explicit(found, "publishers"))


@pytest.mark.parametrize("value", ["os.environ", "QoSProfile.found", "argparse.x", "self.known"])
def test_what_may_be_none_stays_open(value: str) -> None:
    head = "import os, argparse"
    found = ros2_node(f"k = {value}\nif k is None:\n    self.create_publisher(String, 'perhaps', 1)\n", head=head)
    assert [end.is_ruled_out for end in explicit(found, "publishers")] == [False]
