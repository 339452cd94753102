# SPDX-License-Identifier: Apache-2.0
"""Parameters that a launch file may set, and nobody knows: what nodes read then is not known either."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, cpp_files, ends, follow, main, names, node, python

from haros_ci.graph.parameters import ParameterServer, Perhaps
from haros_ci.model.architecture import Parameter, Unknown
from haros_ci.model.location import Location

TALKER = (
    CPP_HEAD
    + """
int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle nh, pnh("~");
  std::string topic;
  int queue;
  pnh.param<std::string>("topic", topic, "chatter");
  pnh.param("queue", queue, 10);
  ros::Publisher pub = nh.advertise<std_msgs::String>(topic, queue);
  ros::spin();
}
"""
)
FILES = {
    "a/CMakeLists.txt": CMAKE.format("a") + "add_executable(talker src/talker.cpp)\n",
    "a/src/talker.cpp": TALKER,
}
OUTSIDE = '<rosparam file="$(find elsewhere)/x.yaml"%s/>'
T = '<node pkg="a" type="talker" name="t">%s</node>'


@pytest.mark.parametrize(
    ("launch", "expected"),
    [
        (T % OUTSIDE % "", ["/?"]),
        (T % OUTSIDE % ' command="load"', ["/?"]),
        (OUTSIDE % "" + T % "", ["/?"]),
        (OUTSIDE % ' ns="t"' + T % "", ["/?"]),
        (OUTSIDE % ' ns="t" param="topic"' + T % "", ["/?"]),
        (T % "" + OUTSIDE % "", ["/?"]),
        (f'<group ns="g">{OUTSIDE % ""}{T % ""}</group>', ["/?"]),
        (T % (OUTSIDE % "" + '<param name="queue" value="1"/>'), ["/?"]),
        (T % ('<rosparam file="$(env X)"/>'), ["/?"]),
        (T % ('<rosparam>"a: ["</rosparam><rosparam>a: [</rosparam>'), ["/?"]),
        (T % ('<param name="topic" command="cat x"/>'), ["/?"]),
        (T % ('<param name="topic" textfile="$(find elsewhere)/x"/>'), ["/?"]),
        ('<param name="$(env X)/topic" value="x"/>' + T % "", ["/?"]),
        (OUTSIDE % ' if="$(env X)"' + T % "", ["/?"]),
        # what is surely not touched, or set anew
        (T % OUTSIDE % ' ns="other"', ["/chatter"]),
        (OUTSIDE % ' ns="other"' + T % "", ["/chatter"]),
        (OUTSIDE % ' ns="tt"' + T % "", ["/chatter"]),
        (f'<group ns="g">{OUTSIDE % ""}</group>' + T % "", ["/chatter"]),
        (OUTSIDE % ' ns="t" param="topi"' + T % "", ["/chatter"]),
        (OUTSIDE % ' ns="~t"' + T % "", ["/chatter"]),
        (OUTSIDE % ' command="delete" param="t"' + T % "", ["/chatter"]),
        (T % (OUTSIDE % "" + '<param name="topic" value="x"/>'), ["/x"]),
        (T % ('<param name="topic" value="x"/>' + OUTSIDE % ""), ["/x"]),
        (OUTSIDE % "" + T % '<param name="topic" value="x"/>', ["/x"]),
        (T % '<param name="topic" value="x"/>' + OUTSIDE % "", ["/?"]),
        (OUTSIDE % "" + "<rosparam>t: {topic: x}</rosparam>" + T % "", ["/x"]),
        (T % ('<param name="queue" command="cat x"/>'), ["/chatter"]),
        ('<param name="$(env X)/topic/more" value="x"/>' + T % "", ["/chatter"]),
    ],
)
def test_a_parameter_that_an_unreadable_file_may_set_is_not_known(launch: str, expected: list[str]) -> None:
    assert names(node(follow(FILES | {"a/launch/all.launch": f"<launch>{launch}</launch>"}))) == expected


def test_why_a_parameter_is_not_known_leads_to_the_tag() -> None:
    (end,) = ends(node(follow(FILES | {"a/launch/all.launch": f"<launch>{T % OUTSIDE % ''}</launch>"})))
    name, queue = end.unknowns
    reason = "it may be set: <rosparam> loads '$(find elsewhere)/x.yaml': package 'elsewhere' is not in the workspace"
    assert (name.field, name.reason, name.location) == ("name", reason, Location("a/launch/all.launch", 1, 46))
    assert queue.field == "queue_size"


SEARCH = (
    'std::string key, topic = "t"; ros::NodeHandle pnh("~");\n'
    'if (pnh.searchParam("key", key)) nh.getParam(key, topic);\nADV(topic, 1);'
)


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ('<param name="key" value="x"/>', "/g/x"),
        (OUTSIDE % "" + '<param name="key" value="x"/>', "/?"),
        ('<param name="/key" value="x"/>' + OUTSIDE % ' ns="h"', "/g/x"),
    ],
)
def test_a_search_ends_where_a_parameter_may_be(before: str, expected: str) -> None:
    launch = f'<launch><group ns="g">{before}<node pkg="p" type="n" name="n"/></group></launch>'
    found = node(follow(cpp_files(main(SEARCH), launch)))
    assert expected in names(found)


MAP = 'XmlRpc::XmlRpcValue all; pnh.getParam("all", all);\nfor (int i = 0; i < 1; i++) ADV(std::string(all["x"]), 1);'


@pytest.mark.parametrize(
    ("inner", "expected"),
    [
        ("<rosparam>all: {x: one}</rosparam>", ["/one"]),
        (OUTSIDE % ' ns="all"' + "<rosparam>all: {x: one}</rosparam>", ["/?"]),
        (OUTSIDE % ' ns="all/deep"', ["/?"]),
        (OUTSIDE % ' ns="all/deep"' + "<rosparam>all: {x: one}</rosparam>", ["/?"]),
        (OUTSIDE % ' ns="al"' + "<rosparam>all: {x: one}</rosparam>", ["/one"]),
    ],
)
def test_a_map_of_which_a_part_may_be_set_is_not_known(inner: str, expected: list[str]) -> None:
    launch = f'<launch><node pkg="p" type="n" name="n">{inner}</node></launch>'
    assert names(node(follow(cpp_files(main('ros::NodeHandle pnh("~");' + MAP), launch)))) == expected


@pytest.mark.parametrize(
    ("vague", "name", "fits"),
    [
        ("/?", "/a", True),
        ("/?", "/a/b", True),
        ("/a/?", "/a/b", True),
        ("/a/?", "/b", False),
        ("/?/a", "/x/y/a", True),
        ("/?/a", "/x/y/b", False),
        ("/a?a", "/aa", True),
        ("/a?a", "/a", False),
        ("/x?b?c", "/x1c2b", False),
        ("/x?b?c", "/x1b2c", True),
        ("/" + "a?" * 500 + "b", "/" + "a" * 4000 + "c", False),
    ],
)
def test_names_of_which_parts_are_known(vague: str, name: str, fits: bool) -> None:
    unknown = Unknown("name", "r", None)
    server = ParameterServer([Parameter(name=vague, type="int", value=1, unknowns=(unknown,))])
    assert server.get(name) == (Perhaps("it may be set: r") if fits else None)


def test_a_value_with_others_below_it_is_no_fault() -> None:
    launch = (
        '<launch><node pkg="p" type="n" name="n"><rosparam>all: 1</rosparam><param name="all/x" value="a"/>'
        '<param name="all/x/y" value="b"/></node></launch>'
    )
    found = node(
        follow(cpp_files(main('ros::NodeHandle pnh("~"); XmlRpc::XmlRpcValue v; pnh.getParam("all", v);'), launch))
    )
    assert [unknown.reason for unknown in found.unknowns] == []


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('rospy.set_param("~m", {"t": "x"})\nPUB(rospy.get_param("~m/t", "y"))', "/x"),
        ('rospy.set_param("~m", {"a": {"t": "x"}})\nPUB(rospy.get_param("~m/a/t", "y"))', "/x"),
        ('rospy.set_param("~m", {"u": "x"})\nPUB(rospy.get_param("~m/t", "y"))', "/y"),
        ('rospy.set_param("~m", 1)\nPUB(rospy.get_param("~m/t", "y"))', "/y"),
        ('rospy.set_param("~m", unknown())\nPUB(rospy.get_param("~m/t", "y"))', "/?"),
        ('rospy.set_param("~mm", {"t": "x"})\nPUB(rospy.get_param("~m/t", "y"))', "/y"),
    ],
)
def test_what_is_inside_a_map_that_the_node_sets(code: str, expected: str) -> None:
    assert names(python(code)) == [expected]


# The command line of a node


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("_topic:=x", ["/x"]),
        ("_topic:=x _queue:=3", ["/x"]),
        ("_topic:=x image:=y", ["/x"]),
        ("_topic:=$(env X)", ["/?"]),
        ("_topic:=x other:=$(env X)", ["/x"]),
        ("--flag $(env X) _topic:=x", ["/x"]),
        ("chatter:=x", ["/x"]),
        ("chatter:=$(env X)", ["/?"]),
        ("chatter:=x $(env X)", ["/x"]),
        ("__name:=other", ["/chatter"]),
        ("topic:=x", ["/chatter"]),
    ],
)
def test_the_command_line_sets_parameters_and_remaps(args: str, expected: list[str]) -> None:
    launch = f'<launch><node pkg="a" type="talker" name="t" args="{args}"/></launch>'
    found = node(follow(FILES | {"a/launch/all.launch": launch}))
    assert names(found) == expected


def test_a_condition_of_the_node_itself_is_none_of_its_parameters() -> None:
    inner = '<node pkg="a" type="talker" name="t">%s</node>'
    param = '<param name="topic" value="x"/>'
    doubtful = '<param if="$(env Y)" name="topic" value="x"/>'
    for body, expected in (
        (f'<group if="$(env X)">{inner % param}</group>', "/x"),
        (f'<group if="$(env X)"><rosparam>t: {{topic: x}}</rosparam>{inner % ""}</group>', "/x"),
        (f'<group if="$(env X)">{inner % doubtful}</group>', "/?"),
        (f'<group if="$(env X)"><rosparam>t: {{topic: x}}</rosparam></group>{inner % ""}', "/?"),
        (f'<group if="$(env X)"><rosparam>t: {{topic: x}}</rosparam></group>{inner % param}', "/x"),
        (f'<rosparam>t: {{topic: y}}</rosparam><group if="$(env X)">{inner % param}</group>', "/x"),
    ):
        found = node(follow(FILES | {"a/launch/all.launch": f"<launch>{body}</launch>"}))
        assert names(found) == [expected], body
