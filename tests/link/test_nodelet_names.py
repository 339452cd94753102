# SPDX-License-Identifier: Apache-2.0
"""ROS 1: what a library makes in a nodelet without a handle of it has the manager's name (wiki.ros.org/nodelet)."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, follow, only

from haros_ci.model.architecture import Node

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("rate", double_t, 0, "", 5, 0, 10)
exit(gen.generate("p", "n", "X"))
"""
CODE = (
    CPP_HEAD
    + """#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.h>
#include <dynamic_reconfigure/server.h>
#include <p/XConfig.h>
struct Helper {{ dynamic_reconfigure::Server<p::XConfig> server; }};
namespace q {{ class N : public nodelet::Nodelet {{ {members}
void onInit() {{ {body} }} }}; }}
PLUGINLIB_EXPORT_CLASS(q::N, nodelet::Nodelet)
"""
)
LOADED = """<launch><group ns="ns"><node pkg="nodelet" type="nodelet" name="m" args="manager"/></group>
<node pkg="nodelet" type="nodelet" name="me" args="load p/N ns/m"/></launch>"""
ALONE = '<launch><node pkg="nodelet" type="nodelet" name="me" args="standalone p/N"/></launch>'


def nodelet(body: str, members: str = "", launch: str = LOADED) -> Node:
    manifest = '<package format="2"><name>p</name><export><nodelet plugin="${prefix}/n.xml"/></export></package>'
    description = (
        '<library path="lib/libq"><class name="p/N" type="q::N" base_class_type="nodelet::Nodelet"/></library>'
    )
    files = {
        "p/CMakeLists.txt": CMAKE.format("p")
        + "add_library(q src/q.cpp)\ngenerate_dynamic_reconfigure_options(cfg/X.cfg)\n",
        "p/package.xml": manifest,
        "p/n.xml": description,
        "p/cfg/X.cfg": CFG,
        "p/src/q.cpp": CODE.format(members=members, body=body),
        "p/launch/l.launch": launch,
    }
    return next(node for node in only(follow(files)).nodes if node.name.endswith("/me"))


def named(found: Node) -> list[str]:
    return sorted({end.name for end in found.endpoints})


SERVER = ["parameter_descriptions", "parameter_updates", "rate", "set_parameters"]


@pytest.mark.parametrize(
    ("body", "members"),
    [
        ("", "dynamic_reconfigure::Server<p::XConfig> server;"),
        ("server = new dynamic_reconfigure::Server<p::XConfig>();", "dynamic_reconfigure::Server<p::XConfig>* server;"),
        ("auto s = std::make_shared<dynamic_reconfigure::Server<p::XConfig>>();", ""),
        ("", "Helper helper;"),
        ("dynamic_reconfigure::Server<p::XConfig> s(mutex);", "boost::recursive_mutex mutex;"),
        ('dynamic_reconfigure::Server<p::XConfig> s(ros::NodeHandle("~"));', ""),
    ],
)
def test_a_server_without_a_handle_is_the_managers(body: str, members: str) -> None:
    assert named(nodelet(body, members)) == [f"/ns/m/{name}" for name in SERVER]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('double x; ros::param::get("~x", x);', "/ns/m/x"),
        ('double x; ros::param::get("x", x);', "/ns/x"),
        ('ros::topic::waitForMessage<std_msgs::String>("x");', "/ns/x"),
        ('ros::NodeHandle h; h.advertise<std_msgs::String>("x", 1);', "/ns/x"),
    ],
)
def test_functions_without_a_handle_are_of_the_process(body: str, expected: str) -> None:
    assert named(nodelet(body)) == [expected]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("dynamic_reconfigure::Server<p::XConfig> s(getPrivateNodeHandle());", [f"/me/{name}" for name in SERVER]),
        ("dynamic_reconfigure::Server<p::XConfig> s(getNodeHandle());", [f"/ns/{name}" for name in SERVER]),
        (
            'ros::NodeHandle n(getPrivateNodeHandle(), "in"); dynamic_reconfigure::Server<p::XConfig> s(n);',
            [f"/me/in/{name}" for name in SERVER],
        ),
        ('getPrivateNodeHandle().advertise<std_msgs::String>("x", 1);', ["/me/x"]),
        # A nodelet at the root has the handle NodeHandle("/"), which is in the namespace of its manager.
        ('getNodeHandle().advertise<std_msgs::String>("x", 1);', ["/ns/x"]),
        ('getNodeHandle().advertise<std_msgs::String>("/x", 1);', ["/x"]),
        ('double x; getPrivateNodeHandle().getParam("x", x);', ["/me/x"]),
        ('ros::NodeHandle n(getName()); n.advertise<std_msgs::String>("x", 1);', ["/me/x"]),
    ],
)
def test_what_has_a_handle_of_the_nodelet_is_its_own(body: str, expected: list[str]) -> None:
    assert named(nodelet(body)) == expected


def test_the_parameter_of_an_updater_is_the_managers() -> None:
    """diagnostic_updater.h: ``ph = ros::NodeHandle("~")``."""
    assert "/ns/m/diagnostic_period" in named(nodelet("", "diagnostic_updater::Updater updater;"))


def test_a_nodelet_that_stands_alone_is_its_own_process() -> None:
    assert named(nodelet("", "dynamic_reconfigure::Server<p::XConfig> server;", ALONE)) == [
        f"/me/{name}" for name in SERVER
    ]


def test_of_an_unknown_manager_the_name_is_unknown_and_says_so() -> None:
    launch = '<launch><node pkg="nodelet" type="nodelet" name="me" args="load p/N $(env MANAGER)"/></launch>'
    found = nodelet("", "dynamic_reconfigure::Server<p::XConfig> server;", launch)
    assert all("?" in end.name for end in found.endpoints)
    assert all(any(unknown.field == "name" for unknown in end.unknowns) for end in found.endpoints)


#: Callbacks that the constructor registers, and a member that onInit() sets.
CALLED_LATER = [
    "int rate = 0; ros::Timer t; N() { ros::NodeHandle h; t = h.createTimer(ros::Duration(1), &N::tick, this); } void tick(const ros::TimerEvent&) { go(); }",
    'ros::NodeHandle nh; ros::Subscriber s; int rate = 0; N() : s(nh.subscribe("in", 1, &N::seen, this)) {} void seen(const std_msgs::String& m) { go(); }',
    "int rate = 0; ~N() { go(); }",
]


@pytest.mark.parametrize("members", CALLED_LATER)
def test_nothing_is_called_back_before_on_init(members: str) -> None:
    go = ' void go() { ros::NodeHandle h; h.advertise<std_msgs::String>(rate ? "set" : "unset", 1); }'
    found = named(nodelet("rate = 10;", members + go))
    assert "/ns/set" in found and "/ns/unset" not in found


def test_on_init_sees_what_the_constructor_has_set() -> None:
    go = " int rate = 0; N() { rate = 10; }"
    body = 'ros::NodeHandle h; h.advertise<std_msgs::String>(rate ? "set" : "unset", 1);'
    assert named(nodelet(body, go)) == ["/ns/set"]


@pytest.mark.parametrize("launch", [LOADED, ALONE])
def test_a_remapping_of_the_nodelet_is_none_of_its_managers_handles(launch: str) -> None:
    """A handle that the code constructs has the remappings of the process, which is the nodelet itself where it stands alone."""
    remapped = launch.replace('ns/m"/></launch>', 'ns/m"><remap from="sub" to="b"/></node></launch>')
    remapped = remapped.replace('p/N"/></launch>', 'p/N"><remap from="sub" to="b"/></node></launch>')
    node = nodelet('ros::NodeHandle h("sub"); h.advertise<std_msgs::String>("x", 1);', launch=remapped)
    assert named(node) == (["/b/x"] if launch is ALONE else ["/ns/sub/x"])
