# SPDX-License-Identifier: Apache-2.0
"""What is known of packages elsewhere: right where it says something, silent (None) where it does not know."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.knowledge.facts import FACTS, Facts, write_facts
from haros_ci.knowledge.knowledge import Knowledge

KNOWN = Knowledge()


@pytest.mark.parametrize(
    ("header", "provider"),
    [
        ("rclcpp/rclcpp.hpp", "rclcpp"),
        ("tf2_ros/buffer.h", "tf2_ros"),
        ("ros/ros.h", "roscpp"),
        ("ros/console.h", "rosconsole"),
        ("moveit/planning_scene/planning_scene.h", "moveit_core"),
        ("sensor_msgs/msg/image.hpp", "sensor_msgs"),
        ("sensor_msgs/Image.h", "sensor_msgs"),
        ("Eigen/Core", "eigen"),
        ("yaml-cpp/yaml.h", "yaml_cpp_vendor"),
        ("kdl/tree.hpp", "orocos_kdl"),
    ],
)
def test_who_has_a_header(header: str, provider: str) -> None:
    assert provider in (KNOWN.provider_of_header(header) or ())


@pytest.mark.parametrize(
    "header", ["vector", "moveit/not_there.h", "our_company/x.hpp", "foo.h", "", "/", "stdio.h", "moveit"]
)
def test_nobody_is_said_to_have_a_header(header: str) -> None:
    assert KNOWN.provider_of_header(header) is None


@pytest.mark.parametrize(
    ("module", "provider"),
    [
        ("rclpy", "rclpy"),
        ("rclpy.node", "rclpy"),
        ("yaml", "python3-yaml"),
        ("cv2", "python3-opencv"),
        ("PIL", "python3-pil"),
        ("PyKDL", "python_orocos_kdl_vendor"),
        ("tf.transformations", "tf"),
        ("std_msgs.msg", "std_msgs"),
        ("PyQt5.QtWidgets", "python3-pyqt5"),
        ("PyQt5.QtWidgets", "python3-qt5-bindings"),
        ("PySide2", "python3-pyside2"),
        ("camera_info_manager", "camera_info_manager_py"),
    ],
)
def test_who_has_a_module(module: str, provider: str) -> None:
    assert provider in (KNOWN.provider_of_module(module) or ())


@pytest.mark.parametrize(
    ("module", "key"),
    [
        ("PyQt5", "python3-sip"),
        ("PyQt5", "python3-pyqt6"),
        ("PyQt6", "python3-pyqt5"),
        ("PySide2", "python3-pyqt5"),
        ("PySide6", "python3-sip"),
        ("camera_info_manager", "camera_info_manager"),
    ],
)
def test_a_key_of_several_packages_does_not_give_each_the_modules_of_all(module: str, key: str) -> None:
    assert key not in (KNOWN.provider_of_module(module) or ())


@pytest.mark.parametrize("module", ["os", "our_company", "utils", "", "scripts", "navigation"])
def test_nobody_is_said_to_have_a_module(module: str) -> None:
    assert KNOWN.provider_of_module(module) is None


@pytest.mark.parametrize(
    ("name", "provider"), [("Eigen3", "eigen"), ("rclcpp", "rclcpp"), ("TinyXML2", "tinyxml2_vendor")]
)
def test_who_has_a_cmake_package(name: str, provider: str) -> None:
    assert provider in (KNOWN.provider_of_cmake(name) or ())


@pytest.mark.parametrize(("name", "other"), [("Eigen3", "cmake_modules"), ("PROJ4", "cmake_modules")])
def test_who_does_not_have_a_cmake_package(name: str, other: str) -> None:
    assert other not in (KNOWN.provider_of_cmake(name) or ())


@pytest.mark.parametrize("name", ["Threads", "OpenMP", "Python3", "our_company", ""])
def test_nobody_is_said_to_have_a_cmake_package(name: str) -> None:
    assert KNOWN.provider_of_cmake(name) is None


def test_packages_and_their_distributions() -> None:
    assert KNOWN.is_package("rclcpp") is KNOWN.is_package("rclcpp", "humble") is True
    assert KNOWN.is_package("roscpp", "noetic") is True
    assert KNOWN.is_package("roscpp", "humble") is KNOWN.is_package("our_company") is False
    assert KNOWN.is_package("rclcpp", "zebra") is None
    assert KNOWN.is_in("roscpp", 1) and not KNOWN.is_in("roscpp", 2)
    assert KNOWN.is_current("roscpp", 1) and KNOWN.is_current("rclcpp", 2) and KNOWN.is_current("eigen", 1)
    assert KNOWN.is_in("pcl", 1) and not KNOWN.is_current("pcl", 1) and not KNOWN.is_current("roscpp", 2)
    assert KNOWN.is_in("eigen", 1) and KNOWN.is_in("rclcpp", 2) and not KNOWN.is_in("our_company", None)


def test_metapackages() -> None:
    assert KNOWN.is_metapackage("navigation", 1) is True
    assert KNOWN.is_metapackage("rclcpp") is False
    assert KNOWN.is_metapackage("our_company") is None
    assert KNOWN.is_metapackage("moveit") is None, "one in ROS 1, and none in ROS 2"


def test_what_comes_with_a_package() -> None:
    assert {"tf2", "tf2_ros", "geometry_msgs", "eigen"} <= (KNOWN.depends("tf2_eigen", 2) or set())
    assert "tf2_ros" not in (KNOWN.depends("tf2_eigen", 1) or set())
    assert "eigen" in (KNOWN.depends("libpcl-all-dev") or set())
    assert KNOWN.depends("our_company") is None


def test_interfaces() -> None:
    assert KNOWN.provides_interface("std_msgs/String", "msg") is True
    assert KNOWN.provides_interface("std_srvs/Trigger", "srv") is True
    assert KNOWN.provides_interface("nav2_msgs/NavigateToPose", "action") is True
    assert KNOWN.provides_interface("move_base_msgs/MoveBaseActionGoal", "msg") is True
    assert (
        KNOWN.provides_interface("std_msgs/Sring", "msg") is KNOWN.provides_interface("std_msgs/String", "srv") is False
    )
    assert KNOWN.provides_interface("our_company/String", "msg") is None


def test_plugins() -> None:
    assert ("nav2_navfn_planner", "nav2_core::GlobalPlanner") in (
        KNOWN.plugins("nav2_navfn_planner::NavfnPlanner") or ()
    )
    assert KNOWN.plugins("our_company/Planner") is None


def test_the_file_is_small_and_says_where_it_is_from() -> None:
    assert FACTS.stat().st_size < 2_000_000
    sources = Facts().about["sources"]
    assert sources["github:ros/rosdistro"] and len(sources["repositories that the index names"]) > 100


@pytest.mark.parametrize(
    "data", [b"", b"{}\n", b"not json\n", b'{"version":99,"sections":{"packages":[0,5]}}\nhello', b"[1]\n"]
)
def test_without_facts_nothing_is_said(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "facts.dat"
    path.write_bytes(data)
    nothing = Knowledge(Facts(path))
    assert not nothing.is_there
    assert nothing.is_package("rclcpp") is None
    assert nothing.provider_of_header("rclcpp/rclcpp.hpp") is None
    assert nothing.depends("rclcpp") is None
    assert not Knowledge(Facts(tmp_path / "none.dat")).is_there


def test_what_is_written_is_read(tmp_path: Path) -> None:
    path = tmp_path / "facts.dat"
    write_facts(
        path, {"distributions": ["humble"]}, {"packages": {"b": "1", "a": "0"}, "headers": {"x/": "a b", "mixed/": ""}}
    )
    again = Knowledge(Facts(path))
    assert again.packages() == ("a", "b")
    assert again.is_package("b", "humble") is True and again.is_package("a", "humble") is None
    assert again.provider_of_header("x/y.h") == {"a", "b"}
    assert again.provider_of_header("mixed/y.h") is None
