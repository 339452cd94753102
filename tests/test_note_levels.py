# SPDX-License-Identifier: Apache-2.0
"""Findings that are a note: paths of credentials, sleeps that hold nothing up, names beside nodes that are not known."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_check_levels import CMAKE, ROS1, ROS2, levels

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.rule import Level


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("/home/anna/certificates/robot.pem", Level.NOTE),
        ("/home/anna/robot.KEY", Level.NOTE),
        ("/data/tls/server.crt", Level.NOTE),
        ("/data/tls/client.p12", Level.NOTE),
        ("/home/anna/.ssh/id_rsa", Level.NOTE),
        ("/home/anna/keys/id_ed25519.pub", Level.NOTE),
        ("/home/anna/api_token.txt", Level.NOTE),
        ("/home/anna/credentials.json", Level.NOTE),
        ("/home/anna/maps/keyframes.yaml", Level.WARNING),
        ("/home/anna/tokenizer/words.json", Level.WARNING),
        ("/home/anna/maps/monkey.dae", Level.WARNING),
        ("/data/secretariat/hall.yaml", Level.WARNING),
    ],
)
def test_paths_of_credentials(path: str, expected: Level, tmp_path: Path) -> None:
    launch = f'<launch><node pkg="demo" exec="n" args="-f {path}"/></launch>\n'
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
        "launch/a.launch.xml": launch,
    }
    check = next(check for check in checks() if check.id == "machine-specific-path")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected
    assert ("find-pkg-share" in result.message) == (expected is Level.WARNING)


@pytest.mark.parametrize(
    ("dockerfile", "tag", "expected"),
    [
        ("", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.WARNING),
        (
            "FROM ros:humble\nCOPY . /sim_ws/\n",
            '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>',
            Level.NOTE,
        ),
        ('COPY ["a b", "/sim_ws"]\n', '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.NOTE),
        ("WORKDIR '/sim_ws'\n", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.NOTE),
        (
            "RUN a && \\\n  mkdir -p /sim_ws/maps\n",
            '<node pkg="demo" exec="n" args="-f /sim_ws/maps/a.yaml"/>',
            Level.NOTE,
        ),
        ("COPY /sim_ws/a /opt/b\n", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.WARNING),
        ("COPY . /\n", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.WARNING),
        ("COPY . /sim\n", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.WARNING),
        ("# COPY . /sim_ws\n", '<node pkg="demo" exec="n" args="-f /sim_ws/maps/hall.yaml"/>', Level.WARNING),
        ("", '<arg name="x" default="/maps/hall.yaml"/><node pkg="demo" exec="n" args="$(var x)"/>', Level.NOTE),
        ("", '<arg name="x" default="1"/><node pkg="demo" exec="n" args="/maps/hall.yaml $(var x)"/>', Level.WARNING),
        (
            "",
            '<arg name="b" default="/home/anna/m"/><arg name="x" default="$(var b)/a"/><node pkg="demo" exec="n" args="$(var x)"/>',
            Level.NOTE,
        ),
        ("", '<let name="x" value="/maps/hall.yaml"/><node pkg="demo" exec="n" args="$(var x)"/>', Level.WARNING),
    ],
)
def test_paths_that_users_can_give_or_a_container_has(
    dockerfile: str, tag: str, expected: Level, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
        "launch/a.launch.xml": f"<launch>{tag}</launch>\n",
        "docker/Dockerfile": dockerfile,
    }
    check = next(check for check in checks() if check.id == "machine-specific-path")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected


NODE = """#!/usr/bin/env python3
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        {0}

    def on_call(self, request, response):
        self.move()
        return response

    def on_message(self, message):
        {1}

    def move(self):
        {2}


rclpy.init()
rclpy.spin(Arm())
"""
SERVICE = 'self.create_service(Trigger, "home", self.on_call)'
SUBSCRIPTION = 'self.create_subscription(Empty, "stop", self.on_message, 1)'
LONG = "time.sleep(2.0)"


@pytest.mark.parametrize(
    ("made", "on_message", "move", "expected"),
    [
        (SERVICE, "pass", LONG, Level.NOTE),  # requests wait, and none is lost
        (f"{SERVICE}; {SUBSCRIPTION}", "pass", LONG, Level.WARNING),
        (f"{SERVICE}; self.create_timer(0.1, self.tick)", "pass", LONG, Level.WARNING),
        (SUBSCRIPTION, LONG, "pass", Level.WARNING),
        (SUBSCRIPTION, f"if not self.port.is_open:\n            {LONG}\n            return", "pass", Level.NOTE),
        (SUBSCRIPTION, f"if self.has_failed:\n            {LONG}\n            self.reconnect()", "pass", Level.NOTE),
        (
            SUBSCRIPTION,
            f"try:\n            self.send()\n        except OSError:\n            {LONG}\n            self.connect()",
            "pass",
            Level.NOTE,
        ),
        (SUBSCRIPTION, f"if not self.port.is_open:\n            {LONG}\n        self.send()", "pass", Level.WARNING),
        (SUBSCRIPTION, f"if self.is_open:\n            {LONG}\n            return", "pass", Level.WARNING),
        (SUBSCRIPTION, f"if not self.initialized:\n            {LONG}", "pass", Level.NOTE),
        (SUBSCRIPTION, f"if self.is_limited:\n            {LONG}", "pass", Level.WARNING),
        (f"{SERVICE}; {SUBSCRIPTION}".replace("home", "init"), "pass", LONG, Level.NOTE),
        (f"{SERVICE}; {SUBSCRIPTION}".replace("home", "init_base"), "pass", LONG, Level.NOTE),
        (f"{SERVICE}; {SUBSCRIPTION}".replace("home", "initial_pose"), "pass", LONG, Level.WARNING),
    ],
)
def test_sleeps_that_hold_nothing_up(made: str, on_message: str, move: str, expected: Level, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": NODE.format(made, on_message, move),
    }
    assert levels("sleep-in-callback", files, tmp_path) == [expected]


@pytest.mark.parametrize(
    ("made", "advice"),
    [
        (SERVICE, "lost; put the callback into a separate callback group, with a multi-threaded executor"),
        (
            SUBSCRIPTION,
            "lost; use a timer, or put the callback into a separate callback group, with a multi-threaded executor",
        ),
    ],
)
def test_what_to_do_about_a_sleep(made: str, advice: str, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": NODE.format(made, "self.move()", LONG),
    }
    check = next(check for check in checks() if check.id == "sleep-in-callback")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.rstrip(".").endswith(advice)


@pytest.mark.parametrize(
    ("more", "expected", "words"),
    [
        ("", Level.WARNING, "neither has another partner"),
        ('<node pkg="rviz2" exec="rviz2" name="rviz"/>', Level.NOTE, "not all nodes are known"),
        ('<node pkg="elsewhere" exec="recorder"/>', Level.NOTE, "not all nodes are known"),
    ],
)
def test_names_that_a_node_which_is_not_known_may_have(more: str, expected: Level, words: str, tmp_path: Path) -> None:
    talker = 'import rclpy\nfrom std_msgs.msg import String\nrclpy.init()\nnode = rclpy.create_node("n%d")\nend = node.%s\nrclpy.spin(node)\n'
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS a.py b.py DESTINATION lib/demo)"),
        "a.py": "#!/usr/bin/env python3\n" + talker % (1, 'create_publisher(String, "velocity_command", 1)'),
        "b.py": "#!/usr/bin/env python3\n" + talker % (2, 'create_subscription(String, "velocity_comand", print, 1)'),
        "launch/a.launch.xml": f'<launch><node pkg="demo" exec="a.py"/><node pkg="demo" exec="b.py"/>{more}</launch>\n',
    }
    check = next(check for check in checks() if check.id == "near-miss-name")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected
    assert words in result.message


def test_a_sleep_is_named_with_its_function_and_time(tmp_path: Path) -> None:
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy"),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": NODE.format(SERVICE, "pass", LONG),
    }
    check = next(check for check in checks() if check.id == "sleep-in-callback")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert "sleeps for 2 s in Arm.move, which Arm.on_call, the callback of a service, runs" in result.message


def test_parameters_with_the_same_slip_are_named_once(tmp_path: Path) -> None:
    node = (
        'import rospy\nrospy.init_node("n")\na = rospy.get_param("max_speed", 1)\nb = rospy.get_param("poll_rate", 1)\n'
        'if a > 1:\n    b = rospy.get_param("poll_rate", 2)\n    a = rospy.get_param("max_speed", 2)\nrospy.spin()\n'
    )
    files = {
        "package.xml": ROS2.replace("rclcpp", "rospy").replace("ament_cmake", "catkin"),
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0.2)\nproject(demo)\nfind_package(catkin REQUIRED COMPONENTS rospy)\n"
        "catkin_package()\ncatkin_install_python(PROGRAMS n.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
        "n.py": "#!/usr/bin/env python\n" + node,
        "launch/a.launch": '<launch><node pkg="demo" type="n.py" name="n">\n<param name="max_speed" value="5"/>\n'
        '<param name="poll_rate" value="5"/>\n</node></launch>\n',
    }
    check = next(check for check in checks() if check.id == "parameter-near-miss")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert "set /max_speed here; likewise /poll_rate" in result.message
    assert not result.message.partition("likewise /poll_rate")[2].startswith(",")
    assert len({(each.location, each.message) for each in result.related}) == len(result.related)


GENERATED = "<!-- | This document was autogenerated by xacro from robot.urdf.xacro | -->\n"
MESHES = (
    '<robot name="robot">\n  <link name="base">\n'
    '    <visual><geometry><mesh filename="file://$(find demo)/meshes/a.dae"/></geometry></visual>\n'
    '    <visual><geometry><mesh filename="file://$(find demo)/meshes/b.dae"/></geometry></visual>\n  </link>\n</robot>\n'
)


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"urdf/robot.urdf": GENERATED + MESHES, "urdf/robot.urdf.xacro": ""}, Level.NOTE),
        ({"urdf/robot.urdf": GENERATED + MESHES, "urdf/robot.xacro": ""}, Level.NOTE),
        (
            {
                "urdf/robot.urdf": GENERATED + MESHES,
                "urdf/robot.urdf.xacro": "",
                "README.md": "    xacro robot.urdf.xacro -o robot.urdf\n",
                "launch/a.launch.xml": '<launch><node pkg="demo" exec="n" args="urdf/robot.urdf.xacro"/></launch>\n',
            },
            Level.NOTE,
        ),
        ({"urdf/robot.urdf": GENERATED + MESHES}, Level.ERROR),
        ({"urdf/robot.urdf": MESHES, "urdf/robot.urdf.xacro": ""}, Level.ERROR),
        (
            {
                "urdf/robot.urdf": GENERATED + MESHES,
                "urdf/robot.urdf.xacro": "",
                "README.md": "Open urdf/robot.urdf in RViz.\n",
            },
            Level.ERROR,
        ),
        (
            {
                "urdf/robot.urdf": GENERATED + MESHES,
                "urdf/robot.urdf.xacro": "",
                "launch/a.launch.xml": '<launch><node pkg="demo" exec="n" args="urdf/robot.urdf"/></launch>\n',
            },
            Level.ERROR,
        ),
    ],
)
def test_meshes_of_a_file_that_xacro_has_written(files: dict[str, str], expected: Level, tmp_path: Path) -> None:
    package = {"package.xml": ROS2, "CMakeLists.txt": CMAKE.format("install(DIRECTORY meshes DESTINATION share/demo)")}
    check = next(check for check in checks() if check.id == "mesh-not-loaded")
    (result,) = said(check, Example("", True, {**package, **files, "meshes/a.dae": "", "meshes/b.dae": ""}), tmp_path)
    assert result.level == expected
    assert "package://demo/meshes/a.dae" in result.message and "1 more mesh" in result.message
    assert len(result.related) == 1


@pytest.mark.parametrize(
    ("tag", "expected", "effect"),
    [
        ('<arg name="rate" value="10"/>', Level.NOTE, ""),
        ('<arg\n    name="rate"\n    value = "10" />', Level.NOTE, ""),
        ("<arg name='rate' value='a > b'/>", Level.NOTE, ""),
        ('<arg name="rate" default="10"/>', Level.WARNING, "has no effect"),
        ('<arg name="rate" default="a value=3"/>', Level.WARNING, "has no effect"),
        ('<arg name="rate"/><param name="a" value="10"/>', Level.WARNING, "has to set it, for nothing"),
    ],
)
def test_an_argument_of_ros1_that_nobody_can_set(tag: str, expected: Level, effect: str, tmp_path: Path) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.5)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        "install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})\n",
        "launch/a.launch": f'<launch>\n  {tag}\n  <node pkg="demo" type="n" name="n"/>\n</launch>\n',
    }
    check = next(check for check in checks() if check.id == "unused-launch-argument")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected
    found = [words for words in ("has no effect", "has to set it, for nothing") if words in result.message]
    assert found == ([effect] if effect else [])


@pytest.mark.parametrize(
    ("name", "declared", "expected"),
    [
        ("use_sim_time", "robot", Level.NOTE),
        ("use_sim_time", "use_simtime", Level.WARNING),
        ("speed", "robot", Level.WARNING),
    ],
)
def test_one_finding_for_what_several_files_pass_for_nothing(
    name: str, declared: str, expected: Level, tmp_path: Path
) -> None:
    include = (
        '<launch>\n  <include file="$(find-pkg-share demo)/launch/inner.launch.xml">\n'
        f'    <arg name="{name}" value="true"/>\n  </include>\n</launch>\n'
    )
    files = {
        "package.xml": ROS2,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
        "launch/a.launch.xml": include,
        "launch/b.launch.xml": include,
        "launch/inner.launch.xml": f'<launch>\n  <arg name="{declared}" default="r"/>\n'
        f'  <node pkg="demo" exec="n" namespace="$(var {declared})"/>\n</launch>\n',
    }
    check = next(check for check in checks() if check.id == "unused-launch-argument")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == expected
    assert result.location.path == "launch/a.launch.xml"
    assert [each.location.path for each in result.related] == ["launch/b.launch.xml"]


@pytest.mark.parametrize(
    ("line", "level", "words"),
    [
        ("m.data = [1, 2.0]", Level.WARNING, "raises AssertionError up to Iron"),
        ("m.data = 1", Level.ERROR, "a wrong value is sent"),
        ("m.data = 'rows'", Level.ERROR, "a wrong value is sent"),
    ],
)
def test_what_a_setter_makes_of_whole_numbers(line: str, level: Level, words: str, tmp_path: Path) -> None:
    code = f"import rclpy\nfrom std_msgs.msg import Float64MultiArray\n\nrclpy.init()\nnode = rclpy.create_node('n')\nm = Float64MultiArray()\n{line}\nrclpy.spin(node)\n"
    files = {
        "package.xml": ROS2.replace("rclcpp", "rclpy").replace(
            "<depend>rclpy", "<depend>std_msgs</depend><depend>rclpy"
        ),
        "CMakeLists.txt": CMAKE.format("install(PROGRAMS n.py DESTINATION lib/demo)"),
        "n.py": "#!/usr/bin/env python3\n" + code,
    }
    check = next(check for check in checks() if check.id == "wrong-field-value")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.level == level and words in result.message


@pytest.mark.parametrize(
    ("kind", "found", "expected"),
    [
        ("build_depend", "", Level.NOTE),
        ("depend", "", Level.NOTE),
        ("build_export_depend", "", Level.NOTE),
        ("build_depend", "find_package(catkin REQUIRED COMPONENTS robot)\n", Level.ERROR),
        ("exec_depend", "find_package(robot REQUIRED)\n", Level.ERROR),
        ("build_depend", "find_package(robot QUIET)\n", Level.NOTE),
    ],
)
def test_a_metapackage_that_cmake_cannot_find(kind: str, found: str, expected: Level, tmp_path: Path) -> None:
    cmake = "cmake_minimum_required(VERSION 3.0)\nproject({})\nfind_package(catkin REQUIRED)\n{}\n"
    files = {
        "demo/package.xml": ROS1.replace("<depend>rospy", f"<{kind}>robot</{kind}><depend>rospy"),
        "demo/CMakeLists.txt": cmake.format("demo", f"{found}catkin_package()"),
        "robot/package.xml": ROS1.replace("demo", "robot").replace(
            "</package>", "<export><metapackage/></export></package>"
        ),
        "robot/CMakeLists.txt": cmake.format("robot", "catkin_metapackage()"),
    }
    assert levels("metapackage-dependency", files, tmp_path) == [expected]
