# SPDX-License-Identifier: Apache-2.0
"""ROS 1: controllers and robot hardware of the workspace, each by itself on the node that loads it."""

from __future__ import annotations

from pathlib import Path

import pytest
from follow_kit import CPP_HEAD, ROS2_CMAKE, Nothing, explicit, follow, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Node

CONTROLLER = "controller_interface::ControllerBase"
HARDWARE = "hardware_interface::RobotHW"
CMAKE = (
    "cmake_minimum_required(VERSION 3.0)\nproject(arm)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    "add_library(arm_lib src/lift.cpp)\n"
)
PACKAGE = (
    '<package><name>arm</name><export><controller_interface plugin="${prefix}/plugins.xml"/>'
    '<hardware_interface plugin="${prefix}/plugins.xml"/></export></package>'
)
JOINT = "hardware_interface::EffortJointInterface"
ONE, TWO = "ros::NodeHandle & nh", "ros::NodeHandle & root_nh, ros::NodeHandle & nh"
HEAD = CPP_HEAD + "#include <controller_interface/controller.h>\n#include <realtime_tools/realtime_publisher.h>\n"


def controller(init: str, handles: str = ONE, update: str = "", more: str = "", base: str = "") -> str:
    """The class ``arm::Lift`` with this in its methods."""
    base = base or f"controller_interface::Controller<{JOINT}>"
    return (
        f"namespace arm {{\nclass Lift : public {base} {{\npublic:\n"
        f"bool init({JOINT} * hw, {handles}) {{ {init} return true; }}\n"
        f"void update(const ros::Time & time, const ros::Duration & period) {{ {update} }}\n{more}\nint a_;\n}};\n}}\n"
    )


def followed(
    code: str, base: str = CONTROLLER, kind: str = "arm::Lift", lookup: tuple[str, ...] = ("arm/Lift",)
) -> Architecture:
    described = "".join(f'<class name="{name}" type="{kind}" base_class_type="{base}"/>' for name in lookup)
    texts = {
        "arm/CMakeLists.txt": CMAKE,
        "arm/package.xml": PACKAGE,
        "arm/plugins.xml": f'<library path="lib/libarm_lib">{described}</library>',
        "arm/src/lift.cpp": HEAD + code,
    }
    return follow(texts)


def lift(code: str, base: str = CONTROLLER) -> Node:
    (found,) = followed(code, base).configurations
    (node,) = found.nodes
    assert found.name == "arm/Lift (plug-ins)"
    return node


def names(node: Node, kind: str = "publishers") -> list[str]:
    return sorted(end.name for end in explicit(node, kind))


PUB = '{}.advertise<std_msgs::String>("{}", 1);'


def test_the_handles_of_a_controller() -> None:
    code = controller(PUB.format("nh", "own") + PUB.format("root_nh", "near") + PUB.format("nh", "/all"), TWO)
    node = lift(code)
    assert (node.name, node.kind, node.package, node.class_name) == ("/?", "node", "arm", "arm::Lift")
    assert names(node) == ["/?/own", "/all", "/near"]
    assert [(u.field, u.reason) for u in node.unknowns] == [
        ("name", "it is the node of the process that has the controller manager")
    ]
    (own,) = (end for end in explicit(node) if end.name == "/?/own")
    assert "it is called as whoever loads it says" in {unknown.reason for unknown in own.unknowns}


def test_what_is_made_later_and_of_real_time_publishers() -> None:
    code = controller(
        'nh_ = nh; pub_.reset(new realtime_tools::RealtimePublisher<std_msgs::String>(nh, "state", 4));'
        'sub_ = nh.subscribe("in", 1, &Lift::take, this);',
        update=PUB.format("nh_", "late"),
        more="ros::NodeHandle nh_;\nros::Subscriber sub_;\nboost::shared_ptr<realtime_tools::RealtimePublisher<std_msgs::String>> pub_;\n"
        "void take(const std_msgs::String::ConstPtr & msg) { " + PUB.format("nh_", "echo") + " }",
    )
    node = lift(code)
    assert names(node) == ["/?/echo", "/?/late", "/?/state"]
    assert names(node, "subscribers") == ["/?/in"]


def test_both_ways_of_initialisation() -> None:
    second = f"bool init({JOINT} * hw, {TWO}) {{ {PUB.format('nh', 'two')} return true; }}"
    assert names(lift(controller(PUB.format("nh", "one"), more=second))) == ["/?/one", "/?/two"]


def test_parameters_are_those_that_whoever_loads_it_sets() -> None:
    code = controller(
        'std::string topic; if (!nh.getParam("topic", topic)) { return false; } nh.advertise<std_msgs::String>(topic, 1);'
        + PUB.format("nh", "after")
    )
    node = lift(code)
    assert names(node) == ["/?", "/?/after"]
    assert names(node, "getters") == ["/?/topic"]


def test_a_search_for_a_parameter_ends_at_what_whoever_loads_it_may_set() -> None:
    code = 'std::string key; ros::NodeHandle("~").searchParam("topic", key); nh.advertise<std_msgs::String>(key, 1);'
    (end,) = explicit(lift(controller(code)))
    assert (end.name, [each.reason for each in end.unknowns]) == ("/?", ["whoever loads it may set it"])


def test_one_class_under_two_look_up_names_has_one_configuration() -> None:
    found = followed(controller(PUB.format("nh", "own")), lookup=("arm/Lift", "arm/Raise"))
    assert [each.name for each in found.configurations] == ["arm/Lift (plug-ins)"]


def test_a_class_of_ros2_is_not_one() -> None:
    texts = {
        "arm/CMakeLists.txt": ROS2_CMAKE.format("arm") + "ament_auto_add_library(arm_lib SHARED src/lift.cpp)\n"
        "pluginlib_export_plugin_description_file(controller_interface plugins.xml)\nament_auto_package()\n",
        "arm/plugins.xml": f'<library path="arm_lib"><class name="arm/Lift" type="arm::Lift" base_class_type="{CONTROLLER}"/></library>',
        "arm/src/lift.cpp": HEAD + controller(PUB.format("nh", "own")),
    }
    found = architecture(workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={})
    assert found.configurations == ()


def test_robot_hardware() -> None:
    code = (
        f"namespace arm {{\nclass Lift : public {HARDWARE} {{\npublic:\n"
        f"bool init({TWO}) {{ {PUB.format('nh', 'own')} {PUB.format('root_nh', 'near')} return true; }}\nint a_;\n}};\n}}\n"
    )
    assert names(lift(code, HARDWARE)) == ["/?/own", "/near"]


def test_a_base_class_of_the_workspace_and_one_of_others() -> None:
    base = controller(PUB.format("nh", "of_base")).replace("class Lift", "class Base")
    derived = "namespace arm {\nclass Lift : public Base { public: void starting(const ros::Time &) {} int b_; };\n}\n"
    assert names(lift(base + derived)) == ["/?/of_base"]
    node = lift(controller(PUB.format("nh", "own"), base="hoists::Common"))
    assert names(node) == ["/?/own"]
    assert "the base class hoists::Common is not in the workspace: what it makes and calls is not known" in {
        unknown.reason for unknown in node.unknowns if unknown.field == "endpoints"
    }


@pytest.mark.parametrize(
    ("code", "base", "kind"),
    [
        pytest.param(controller(""), CONTROLLER, "arm::Lift", id="it makes nothing"),
        pytest.param(controller(PUB.format("nh", "a")), CONTROLLER, "arm::Gone", id="a class that is not there"),
        pytest.param(
            controller(PUB.format("nh", "a"), "int nh_number, Handle nh"), CONTROLLER, "arm::Lift", id="no handle"
        ),
        pytest.param(
            controller(PUB.format("nh", "a")).replace("bool init", "bool initialise"),
            CONTROLLER,
            "arm::Lift",
            id="no init",
        ),
    ],
)
def test_no_configuration(code: str, base: str, kind: str) -> None:
    assert followed(code, base, kind).configurations == ()


def test_a_base_that_nobody_knows_is_loaded_by_somebody_else() -> None:
    (found,) = followed(controller(PUB.format("nh", "a")), "hoists::Base").configurations
    (node,) = found.nodes
    assert (found.name, node.name) == ("arm/arm::Lift (plug-ins)", "/?")
    assert any("whoever loads the plug-in" in why.reason for why in node.unknowns)
