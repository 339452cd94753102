# SPDX-License-Identifier: Apache-2.0
"""C++ classes whose base is a parameter of their template: what is known of the argument is known of the base."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, conditions, cpp_files, ends, follow, main, names, node, only

from haros_ci.model.architecture import Node

BASE = """#pragma once
#include <ros/ros.h>
namespace wings { class Flap { public:
Flap() : own("~") {}
virtual ~Flap() {}
void init() { onInit(); }
ros::NodeHandle& handle() { return own; }
private: virtual void onInit() = 0; ros::NodeHandle own; }; }
"""
CLASS = """#include "flap.h"
template <class Base> class Kite : public Base {
std::string name{"/lift"}; ros::Publisher one, two;
virtual void onInit() {
ros::NodeHandle& nh{ HANDLE };
name = ros::this_node::getNamespace() + name;
one = nh.advertise<std_msgs::String>("own", 1);
two = nh.advertise<std_msgs::String>(name, 1);
} };
"""
MADE = "std::make_unique<Kite<wings::Flap>>()"
POINTER = "std::unique_ptr<wings::Flap> kite;\n"
IF = f'std::string kind; nh.getParam("kind", kind);\n{POINTER}if (kind == "kite") {{ kite = {MADE}; }}\nkite->init();\n'
LAUNCH = '<launch><param name="kind" value="kite"/><node pkg="p" type="n" name="n"/></launch>'
PROGRAMS = (
    f"{POINTER}kite = {MADE};\nkite->init();\n",
    "Kite<wings::Flap> kite;\nkite.init();\n",
    "wings::Flap* kite = new Kite<wings::Flap>();\nkite->init();\n",
    "boost::shared_ptr<wings::Flap> kite = boost::make_shared<Kite<wings::Flap>>();\nkite->init();\n",
    IF,
)


def _files(code: str, handle: str = "Base::handle()", base: str = BASE) -> dict[str, str]:
    return cpp_files(main(code, CLASS.replace("HANDLE", handle)), LAUNCH, flap__h=base)


@pytest.mark.parametrize("handle", ["Base::handle()", "this->handle()"])
@pytest.mark.parametrize("code", PROGRAMS)
def test_a_class_of_the_workspace_as_base(code: str, handle: str) -> None:
    found = node(follow(_files(code, handle)))
    assert [name for name in names(found) if name != "/rosout"] == ["/lift", "/n/own"]
    assert not found.unknowns and not any(end.unknowns for end in ends(found))


@pytest.mark.parametrize("code", PROGRAMS)
def test_nothing_is_called_by_a_library(code: str) -> None:
    assert not any(conditions(end) for end in ends(node(follow(_files(code)))))


def test_what_nothing_calls_is_not_made() -> None:
    found = node(follow(_files(f"{POINTER}kite = {MADE};\n")))
    assert [name for name in names(found) if name != "/rosout"] == []


#: The class that a library may call: it is the argument, or a base of it.
OUTSIDE = (
    ("std::make_unique<Kite<outside::Flap>>()", BASE),
    ("new Kite<outside::Flap>()", BASE),
    (
        MADE,
        BASE.replace("class Flap {", "class Flap : public outside::Flap {").replace("void init() { onInit(); }", ""),
    ),
)


@pytest.mark.parametrize(("made", "base"), OUTSIDE)
def test_a_library_may_call_what_it_is_the_base_of(made: str, base: str) -> None:
    found = node(follow(_files(f"auto kite = {made};\n", "*new ros::NodeHandle()", base)))
    said = [unknown.reason for end in ends(found) for unknown in end.unknowns]
    assert any("outside::Flap is not in the workspace: its library may call the object" in reason for reason in said)


NODELET = (
    CPP_HEAD
    + """#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.h>
namespace wings {
struct Soft { static const char* topic() { return "soft"; } };
struct Hard { static const char* topic() { return "hard"; } };
template <class Base> class Kite : public Base {
ros::Publisher one, two;
virtual void onInit() {
ros::NodeHandle& nh{ HANDLE };
one = nh.advertise<std_msgs::String>("lift", 1);
two = nh.advertise<std_msgs::String>(MORE, 1);
} };
TYPES }
PLUGINLIB_EXPORT_CLASS(wings::N, nodelet::Nodelet)
"""
)
DESCRIPTION = '<library path="lib/libq">{}</library>'
CLASSES = '<class name="p/{0}" type="wings::{0}" base_class_type="nodelet::Nodelet"/>'
MANIFEST = '<package format="2"><name>p</name><export><nodelet plugin="${prefix}/n.xml"/></export></package>'


def _nodelets(text: str, *classes: str) -> dict[str, Node]:
    nodes = "".join(f'<node pkg="nodelet" type="nodelet" name="{name}" args="load p/{name} m"/>' for name in classes)
    files = {
        "p/CMakeLists.txt": CMAKE.format("p") + "add_library(q src/q.cpp)\n",
        "p/package.xml": MANIFEST,
        "p/n.xml": DESCRIPTION.format("".join(map(CLASSES.format, classes))),
        "p/src/q.cpp": text,
        "p/launch/l.launch": f'<launch><node pkg="nodelet" type="nodelet" name="m" args="manager"/>{nodes}</launch>',
    }
    return {found.name: found for found in only(follow(files)).nodes}


@pytest.mark.parametrize("alias", ["using N = Kite<nodelet::Nodelet>;", "typedef Kite<nodelet::Nodelet> N;"])
@pytest.mark.parametrize("handle", ["Base::getPrivateNodeHandle()", "this->getPrivateNodeHandle()"])
def test_a_nodelet_by_the_base_that_it_is_given(alias: str, handle: str) -> None:
    text = NODELET.replace("TYPES", alias).replace("HANDLE", handle).replace("MORE", '"more"')
    found = _nodelets(text, "N")["/N"]
    assert [name for name in names(found) if name.startswith("/N/")] == ["/N/lift", "/N/more"]
    assert not found.unknowns


def test_two_nodelets_of_one_template() -> None:
    """What one of them is given is not what the other is."""
    text = NODELET.replace("class Base", "class Base, class Kind").replace("MORE", "Kind::topic()")
    both = "typedef Kite<nodelet::Nodelet, Soft> N; typedef Kite<nodelet::Nodelet, Hard> M;"
    nodes = _nodelets(text.replace("HANDLE", "Base::getPrivateNodeHandle()").replace("TYPES", both), "N", "M")
    assert [name for name in names(nodes["/N"]) if "/N/" in name] == ["/N/lift", "/N/soft"]
    assert [name for name in names(nodes["/M"]) if "/M/" in name] == ["/M/hard", "/M/lift"]


def test_a_nodelet_of_a_base_that_is_not_here() -> None:
    text = NODELET.replace("TYPES", "using N = Kite<outside::Lifted>;").replace("MORE", '"more"')
    found = _nodelets(text.replace("HANDLE", "Base::getPrivateNodeHandle()"), "N")["/N"]
    assert any("outside::Lifted is not in the workspace" in unknown.reason for unknown in found.unknowns)
