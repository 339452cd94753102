# SPDX-License-Identifier: Apache-2.0
"""ROS 1: the private parameters of a node of whose name a part is not known are those that its own tag sets."""

from __future__ import annotations

import pytest
from follow_kit import follow, names, node, python, python_files, script

CODE = 'PUB(rospy.get_param("~topic", "chatter"))\n'
N = '<node pkg="p" type="n.py" name="%s">%s</node>'
SET = '<param name="topic" value="x"/>'
ANON, ARG = "$(anon n)", "$(arg who)_n"
WHO = '<arg name="who"/>'


@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        (N % (ANON, SET), "/x"),
        (N % (ANON, ""), "/chatter"),
        (N % (ANON, "<rosparam>topic: x</rosparam>"), "/x"),
        (N % (ANON, "<rosparam>topic: y</rosparam>" + SET), "/x"),
        ('<param name="~topic" value="x"/>' + N % (ANON, ""), "/x"),
        (WHO + N % (ARG, SET), "/x"),
        (f'{WHO}<group ns="$(arg who)">{N % ("n", SET)}</group>', "/?/x"),
        (f'<node pkg="p" type="n.py" name="{ANON}" args="_topic:=x"/>', "/x"),
        ('<param name="topic" value="y"/>' + N % (ANON, SET), "/x"),
        (N % (ANON, '<rosparam file="$(find elsewhere)/x.yaml"/>' + SET), "/x"),
        # what another node's tag sets is not its own
        (N % (ANON, "") + '<node pkg="q" type="q" name="$(anon n)"><param name="topic" value="y"/></node>', "/chatter"),
        (N % (ANON, SET) + '<node pkg="q" type="q" name="n_m"><param name="topic" value="y"/></node>', "/x"),
        # what may be set
        (N % (ANON, '<param name="topic" value="$(env X)"/>'), "/?"),
        (N % (ANON, '<rosparam file="$(find elsewhere)/x.yaml"/>'), "/?"),
        (N % (ANON, SET) + '<rosparam file="$(find elsewhere)/x.yaml"/>', "/?"),
        ('<param name="$(env X)/topic" value="y"/>' + N % (ANON, SET), "/?"),
        ('<param name="n_1/topic" value="y"/>' + N % (ANON, ""), "/?"),
        (WHO + '<param name="a_n/topic" value="y"/>' + N % (ARG, ""), "/?"),
        (N % (ANON, '<param name="topic" value="x" if="$(env X)"/>'), "/?"),
    ],
)
def test_its_own_tag_tells_them(launch: str, expected: str) -> None:
    found = follow(python_files(script(CODE), f"<launch>{launch}</launch>"))
    (own,) = [each for each in found.configurations[0].nodes if each.package == "p"]
    assert names(own) == [expected]


def test_the_name_of_the_parameter_itself_stays_unknown() -> None:
    found = node(follow(python_files(script('rospy.get_param("~rate")'), f"<launch>{N % (ANON, SET)}</launch>")))
    (getter,) = [end for end in found.endpoints if end.kind == "getters"]
    assert (getter.name, [u.field for u in getter.unknowns]) == ("/n_?/rate", ["type", "name"])


def test_its_type_is_that_of_what_the_tag_sets() -> None:
    launch = f'<launch>{N % (ANON, """<param name="rate" value="2.5"/>""")}</launch>'
    found = node(follow(python_files(script('rospy.get_param("~rate")'), launch)))
    assert [end.type for end in found.endpoints if end.kind == "getters"] == ["double"]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('rospy.set_param("~a", "x")\nPUB(rospy.get_param("~a"))', "/x"),
        ('rospy.set_param("~b", "x")\nPUB(rospy.get_param("~topic"))', "/x"),
        ('rospy.set_param("~" + f(), "x")\nPUB(rospy.get_param("~topic"))', "/?"),
        ('rospy.set_param("~topic", "z")\nPUB(rospy.get_param("~topic"))', "/z"),
    ],
)
def test_what_the_node_sets_itself(code: str, expected: str) -> None:
    assert names(python(code, f"<launch>{N % (ANON, SET)}</launch>")) == [expected]


def test_a_node_that_nobody_starts_has_its_defaults() -> None:
    text = (
        "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\nrospy.init_node('a', anonymous=True)\n"
    )
    code = "rospy.Publisher(rospy.get_param('~topic', 'chatter'), String, queue_size=1)\n"
    assert names(node(follow(python_files(text + code)))) == ["/chatter"]
