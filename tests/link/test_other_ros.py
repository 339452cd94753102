# SPDX-License-Identifier: Apache-2.0
"""Programs whose package is of the other ROS than they are, or does not say of which it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = "<package format='3'><name>demo</name><version>1.0.0</version>{}</package>"
SILENT = MANIFEST.format("<depend>std_msgs</depend>")
BROKEN = "<package format='3'><name>demo</name>"
BOTH = MANIFEST.format(
    "<buildtool_depend condition='$ROS_VERSION == 1'>catkin</buildtool_depend>"
    "<buildtool_depend condition='$ROS_VERSION == 2'>ament_cmake</buildtool_depend>"
)
AMENT = MANIFEST.format("<export><build_type>ament_cmake</build_type></export>")
CATKIN = MANIFEST.format("<buildtool_depend>catkin</buildtool_depend>")
TWO = """#!/usr/bin/env python3
import rclpy
from std_msgs.msg import String
def main():
    rclpy.init()
    node = rclpy.create_node('talker')
    node.create_publisher(String, 'chatter', 1)
if __name__ == '__main__':
    main()
"""
ONE = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String
rospy.init_node('talker')
rospy.Publisher('chatter', String)
if __name__ == '__main__':
    rospy.spin()
"""
CPP_TWO = """#include <demo/all.hpp>
#include <std_msgs/msg/string.hpp>
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("talker");
  auto pub = node->create_publisher<std_msgs::msg::String>("chatter", 1);
  rclcpp::spin(node);
}
"""
ALL = "#pragma once\n#include <rclcpp/rclcpp.hpp>\n"
CPP_ONE = """#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char ** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle nh;
  ros::Publisher pub = nh.advertise<std_msgs::String>("chatter", 1);
  ros::spin();
}
"""
COMPONENT = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <rclcpp_components/register_node_macro.hpp>
class Talker : public rclcpp::Node {
public:
  explicit Talker(const rclcpp::NodeOptions & options) : Node("talker", options) {
    pub_ = create_publisher<std_msgs::msg::String>("chatter", 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
RCLCPP_COMPONENTS_REGISTER_NODE(Talker)
"""
BUILT = "project(demo)\nadd_executable(talk src/talk.cpp)\n"
LIBRARY = "project(demo)\nadd_library(talk SHARED src/talk.cpp)\n"
LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    "def generate_launch_description():\n    return LaunchDescription([Node(package='demo', executable='{}')])\n"
)


def model(root: Path, files: dict[str, str]) -> Architecture:
    for path, text in files.items():
        (root / "src" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "src" / path).write_text(text)
        if path.endswith(".py") and "launch" not in path:
            (root / "src" / path).chmod(0o755)
    return architecture(discover(root, ()), Settings(root=root), MemoryCache())


def talking(made: Architecture) -> list[tuple[str, int]]:
    """The configurations with a publisher of the topic, and the ROS of its node."""
    return [
        (each.name, node.ros)
        for each in made.configurations
        for node in each.nodes
        if any(end.name == "/chatter" and end.kind == "publishers" for end in node.endpoints)
    ]


def said(made: Architecture) -> list[str]:
    return [f"{each.path}: {each.message}" for each in made.problems if "client library" in each.message]


@pytest.mark.parametrize(
    ("manifest", "files", "expected"),
    [
        (SILENT, {"scripts/talk.py": TWO}, ("demo/talk.py", 2)),
        (SILENT, {"scripts/talk.py": ONE}, ("demo/talk.py", 1)),
        (SILENT, {"src/talk.cpp": CPP_ONE, "CMakeLists.txt": BUILT}, ("demo/talk", 1)),
        (
            SILENT,
            {"src/talk.cpp": CPP_TWO, "include/demo/all.hpp": ALL, "CMakeLists.txt": BUILT},
            ("demo/talk", 2),
        ),
        (SILENT, {"src/talk.cpp": COMPONENT, "CMakeLists.txt": LIBRARY}, ("demo/Talker", 2)),
        (BROKEN, {"scripts/talk.py": TWO}, ("demo/talk.py", 2)),
        (BROKEN, {"scripts/talk.py": ONE}, ("demo/talk.py", 1)),
    ],
)
def test_a_manifest_that_does_not_tell(
    tmp_path: Path, manifest: str, files: dict[str, str], expected: tuple[str, int]
) -> None:
    made = model(tmp_path, {"demo/package.xml": manifest, **{f"demo/{path}": text for path, text in files.items()}})
    assert (talking(made), said(made)) == ([expected], [])


def test_a_launch_file_of_ros_2_in_such_a_package(tmp_path: Path) -> None:
    files = {
        "demo/package.xml": SILENT,
        "demo/scripts/talk.py": TWO,
        "demo/launch/all.launch.py": LAUNCH.format("talk.py"),
    }
    assert talking(model(tmp_path, files)) == [("demo/launch/all.launch.py", 2)]


@pytest.mark.parametrize(
    ("manifest", "files", "words"),
    [
        (CATKIN, {"scripts/talk.py": TWO}, "scripts/talk.py: this program uses the client library of ROS 2, but its"),
        (CATKIN, {"scripts/talk.py": TWO.partition("\n")[2]}, "scripts/talk.py: this program uses"),
        (CATKIN, {"scripts/a.py": TWO, "scripts/b.py": TWO}, "scripts/a.py: this program and 1 more use the client"),
        (
            AMENT,
            {"scripts/talk.py": ONE},
            "this program uses the client library of ROS 1, but its package is taken for",
        ),
        (BOTH, {"scripts/talk.py": ONE}, "this program uses the client library of ROS 1, but its package is taken for"),
        (AMENT, {"src/talk.cpp": CPP_ONE, "CMakeLists.txt": BUILT}, "src/talk.cpp: this program uses"),
        (CATKIN, {"src/talk.cpp": COMPONENT, "CMakeLists.txt": LIBRARY}, "src/talk.cpp: this program uses"),
    ],
)
def test_what_is_of_the_other_ros_is_named_once(
    tmp_path: Path, manifest: str, files: dict[str, str], words: str
) -> None:
    made = model(tmp_path, {"demo/package.xml": manifest, **{f"demo/{path}": text for path, text in files.items()}})
    assert (talking(made), [words in each for each in said(made)]) == ([], [True])


@pytest.mark.parametrize(
    ("manifest", "files"),
    [
        (AMENT, {"scripts/talk.py": TWO}),
        (CATKIN, {"scripts/talk.py": ONE}),
        (BOTH, {"scripts/talk.py": TWO}),
        # of both, or neither
        (CATKIN, {"scripts/talk.py": ONE.replace("import rospy", "import rclpy\nimport rospy")}),
        (AMENT, {"scripts/talk.py": ONE.replace("import rospy", "import rclpy\nimport rospy")}),
        (CATKIN, {"scripts/talk.py": "#!/usr/bin/env python\nimport os\n"}),
        # tests, modules, what sets up the package
        (CATKIN, {"test/talk.py": TWO}),
        (AMENT, {"test/talk.py": ONE}),
        (CATKIN, {"src/demo/talk.py": TWO.partition("\n")[2].partition("if __name__")[0]}),
        (AMENT, {"setup.py": ONE.partition("\n")[2]}),
        # a program that is not built, or takes both
        (AMENT, {"src/talk.cpp": CPP_ONE, "CMakeLists.txt": "project(demo)\n"}),
        (AMENT, {"src/talk.cpp": "#include <rclcpp/rclcpp.hpp>\n" + CPP_ONE, "CMakeLists.txt": BUILT}),
        # the other package is of that ROS
        (AMENT, {"../old/package.xml": CATKIN.replace("demo", "old"), "../old/scripts/talk.py": ONE}),
    ],
)
def test_what_is_as_its_package_says_or_no_program(tmp_path: Path, manifest: str, files: dict[str, str]) -> None:
    made = model(tmp_path, {"demo/package.xml": manifest, **{f"demo/{path}": text for path, text in files.items()}})
    assert said(made) == []


@pytest.mark.parametrize(
    ("manifest", "program", "started", "reason"),
    [
        (CATKIN, ONE, "talk.py", "demo/talk.py (src/demo/scripts/talk.py) is a program of the other ROS"),
        (
            CATKIN,
            TWO,
            "talk.py",
            "demo/talk.py (src/demo/scripts/talk.py) uses the client library of ROS 2, but its package is taken for ROS 1",
        ),
        (
            CATKIN,
            TWO,
            "none.py",
            "package demo is in the workspace, but no C++ or Python program called none.py was found in it",
        ),
        # a module of a console script is no program
        (
            AMENT.replace("ament_cmake", "ament_python"),
            TWO,
            "talk.py",
            "package demo is in the workspace, but no C++ or Python program called talk.py was found in it",
        ),
    ],
)
def test_launched_programs_that_are_not_followed(
    tmp_path: Path, manifest: str, program: str, started: str, reason: str
) -> None:
    files = {
        "demo/package.xml": manifest,
        "demo/setup.py": "from setuptools import setup\nsetup(name='demo', packages=['scripts'], "
        "entry_points={'console_scripts': ['talk = scripts.talk:main']})\n",
        "demo/scripts/__init__.py": "",
        "demo/scripts/talk.py": program,
        "new/package.xml": AMENT.replace("demo", "new"),
        "new/launch/all.launch.py": LAUNCH.format(started),
    }
    found = [each for each in model(tmp_path, files).configurations if each.launch]
    unknowns = [each for node in found[0].nodes for each in node.unknowns if each.field == "endpoints"]
    assert [each.reason for each in unknowns] == [reason]
