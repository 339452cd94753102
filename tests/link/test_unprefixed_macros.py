# SPDX-License-Identifier: Apache-2.0
"""Macros of xacro that a description calls without ``xacro:``, as releases up to ROS Melodic expand them: what the simulator has by their plug-ins."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CPP_HEAD, Nothing, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Endpoint

CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\nadd_library(eye src/eye.cpp)\n"
LAUNCH = (
    '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    '<param name="robot_description" command="$(find xacro)/xacro $(find p)/urdf/r.xacro"/>'
    '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model rover"/></launch>'
)
EYE = (
    f"{CPP_HEAD}#include <gazebo/gazebo.hh>\nnamespace gazebo {{\nclass Eye : public ModelPlugin {{\npublic:\n"
    "void Load(physics::ModelPtr _parent, sdf::ElementPtr _sdf) { ros::NodeHandle nh;"
    ' nh.advertise<std_msgs::String>(_sdf->Get<std::string>("topic"), 1); }\n};\nGZ_REGISTER_MODEL_PLUGIN(Eye)\n}\n'
)
PLUGIN = '<plugin name="e" filename="libeye.so"><topic>{}</topic></plugin>'
BARE = f'<xacro:macro name="eyes"><gazebo>{PLUGIN.format("scan")}</gazebo></xacro:macro>'
WITH = f'<xacro:macro name="eyes" params="t"><gazebo>{PLUGIN.format("${t}")}</gazebo></xacro:macro>'
INNER = f'<xacro:macro name="eyes">{PLUGIN.format("scan")}</xacro:macro>'


def made(body: str, readme: str = "") -> list[tuple[str, Endpoint]]:
    """The publishers of the plug-in, each with the node that has it."""
    texts = {
        "p/README.md": readme,
        "p/CMakeLists.txt": CMAKE,
        "p/launch/l.launch": LAUNCH,
        "p/urdf/r.xacro": f'<robot name="rover" xmlns:xacro="http://ros.org/xacro"><link name="head"/>{body}</robot>',
        "p/src/eye.cpp": EYE,
    }
    found = architecture(
        workspace(texts, 1), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return [
        (node.name, end)
        for configuration in found.configurations
        for node in configuration.nodes
        for end in node.endpoints
        if end.kind == "publishers" and end.location is not None and end.location.path.endswith(".cpp")
    ]


@pytest.mark.parametrize("readme", ["", "For Kinetic.", "`apt install ros-melodic-desktop`, or ros-noetic-desktop"])
@pytest.mark.parametrize(
    ("body", "topic"),
    [
        (BARE + "<eyes/>", "/scan"),
        (WITH + '<eyes t="front"/>', "/front"),
        (INNER + "<gazebo><eyes/></gazebo>", "/scan"),
        (BARE + '<xacro:macro name="robot_of"><eyes/></xacro:macro><robot_of/>', "/scan"),
    ],
)
def test_expanded_as_before_noetic(body: str, topic: str, readme: str) -> None:
    ((node, end),) = made(body, readme)
    assert (node, end.name, end.unknowns) == ("/gazebo", topic, ())


@pytest.mark.parametrize("body", [BARE + "<eyes/>", WITH + '<eyes t="scan"/>'])
def test_undecided_where_pages_name_noetic_alone(body: str) -> None:
    ((node, end),) = made(body, "Tested with ROS Noetic.")
    assert (node, end.name) == ("/gazebo", "/scan")
    assert [unknown.field for unknown in end.unknowns] == ["conditions"]


@pytest.mark.parametrize(
    "body",
    [
        WITH + "<eyes/>",  # without what it wants
        WITH + '<eyes t="a" u="b"/>',  # with what it does not take
        BARE,  # not called
        BARE.replace('"eyes"', '"material"') + '<link name="l"><visual><material/></visual></link>',
        "<eyes/>" + BARE,  # before it is there
    ],
)
def test_no_call(body: str) -> None:
    assert [node for node, _ in made(body)] == ["/?"]


@pytest.mark.parametrize("body", [BARE + "<xacro:eyes/>", BARE + '<xacro:call macro="eyes"/>'])
def test_with_the_prefix_pages_do_not_count(body: str) -> None:
    ((node, end),) = made(body, "Tested with ROS Noetic.")
    assert (node, end.name, end.unknowns) == ("/gazebo", "/scan", ())


def test_a_macro_that_makes_a_tag_of_its_own_name() -> None:
    body = f'<xacro:macro name="eyes"><gazebo>{PLUGIN.format("scan")}</gazebo><eyes/></xacro:macro><eyes/>'
    ((node, end),) = made(body)
    assert (node, end.name) == ("/gazebo", "/scan")
