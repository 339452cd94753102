# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of Gazebo that go through the elements of their description, and what they read into variables."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CPP_HEAD, Nothing, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings

CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\nadd_library(eye src/eye.cpp)\n"
LAUNCH = (
    '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    '<param name="robot_description" command="$(find xacro)/xacro $(find p)/urdf/r.xacro"/>'
    '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model rover"/></launch>'
)
ROBOT = '<robot name="rover" xmlns:xacro="http://ros.org/xacro"><link name="head"/><gazebo><plugin name="e" filename="libeye.so">{}</plugin></gazebo></robot>'
PUB = "nh.advertise<std_msgs::String>({}, 1);"
WALK = (
    'std::map<std::string, Camera> all; all.insert(std::make_pair("color", Camera())); bool on = false; double rate = 0; std::string own;'
    "_sdf = _sdf->GetFirstElement(); do { std::string name = _sdf->GetName();"
    ' if (name == "rate") _sdf->GetValue()->Get(rate); else if (name == "on") _sdf->GetValue()->Get(on);'
    ' else if (name == "color") all["color"].topic = _sdf->GetValue()->GetAsString(); else if (name == "own") own = _sdf->Get<std::string>();'
    ' else if (name == "stop") break; _sdf = _sdf->GetNextElement(); } while (_sdf);'
)
EACH = 'for (sdf::ElementPtr e = _sdf->GetElement("eye"); e; e = e->GetNextElement("eye")) ' + PUB.format(
    "e->Get<std::string>()"
)
WHILE = (
    'sdf::ElementPtr e = _sdf->GetElement("eye"); while (e != nullptr) { '
    + PUB.format("e->Get<std::string>()")
    + ' e = e->GetNextElement("eye"); }'
)


def topics(load: str, inner: str) -> list[str]:
    code = (
        f"{CPP_HEAD}#include <gazebo/gazebo.hh>\nnamespace gazebo {{\nstruct Camera {{ std::string topic; }};\nclass Eye : public ModelPlugin {{\npublic:\n"
        f"void Load(physics::ModelPtr _parent, sdf::ElementPtr _sdf) {{ ros::NodeHandle nh; {load} }}\n}};\nGZ_REGISTER_MODEL_PLUGIN(Eye)\n}}\n"
    )
    texts = {
        "p/CMakeLists.txt": CMAKE,
        "p/launch/l.launch": LAUNCH,
        "p/urdf/r.xacro": ROBOT.format(inner),
        "p/src/eye.cpp": code,
    }
    found = architecture(
        workspace(texts, 1), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )
    return sorted(
        end.name
        for configuration in found.configurations
        for node in configuration.nodes
        for end in node.endpoints
        if end.kind == "publishers"
        and not end.is_ruled_out
        and end.location is not None
        and end.location.path.endswith(".cpp")
    )


@pytest.mark.parametrize(
    ("use", "inner", "expected"),
    [
        (PUB.format('all["color"].topic'), "<color>front</color>", ["/front"]),
        (PUB.format('all["color"].topic'), "<rate>5</rate><color>front</color><on>true</on>", ["/front"]),
        (PUB.format("own"), "<own> front </own><stop/><own>rear</own>", ["/front"]),
        (PUB.format("own"), "<own>rear</own><other/><own>front</own>", ["/front"]),
        ("if (on) " + PUB.format('"on"'), "<on>1</on>", ["/on"]),
        ("if (on) " + PUB.format('"on"'), "<on>0</on>", []),
        ("if (on) " + PUB.format('"on"'), "<rate>1</rate>", []),
        ('if (rate > 2) ' + PUB.format('"fast"'), "<rate>5.0</rate>", ["/fast"]),
        (PUB.format("own"), '<xacro:if value="$(optenv A)"><own>rear</own></xacro:if><own>front</own>', ["/?"]),
        (PUB.format("own"), "<own>$(optenv A)</own>", ["/?"]),
    ],
)  # fmt: skip
def test_from_the_first_to_the_last(use: str, inner: str, expected: list[str]) -> None:
    assert topics(WALK + use, inner) == expected


@pytest.mark.parametrize("load", [EACH, WHILE])
def test_those_of_a_name(load: str) -> None:
    assert topics(load, "<eye>a</eye><other>x</other><eye>b</eye>") == ["/a", "/b"]
    assert topics(load, "<other>x</other><eye>b</eye>") == ["/b"]
    assert "/?" in topics(load, '<eye>a</eye><xacro:if value="$(optenv A)"><eye>b</eye></xacro:if>')


@pytest.mark.parametrize("handle", ["GetHandle()", "this->GetHandle()"])
def test_the_name_of_the_plugin(handle: str) -> None:
    load = f"ros::NodeHandle own({handle}); own." + PUB.format('"t"').replace("nh.", "")
    assert topics(load, "") == ["/e/t"]
