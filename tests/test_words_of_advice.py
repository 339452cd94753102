# SPDX-License-Identifier: Apache-2.0
"""What findings advise: that which mends the package at hand."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_first_run import CATKIN, MANIFEST, ROS1, ROS2, messages

GENERATES = "add_message_files(FILES A.msg)\ngenerate_messages()\n"
NODE = "#!/usr/bin/env python3\nimport rclpy\n\n\ndef main():\n    rclpy.init()\n"
SETUP = "from setuptools import setup\nsetup(name='demo', version='1.0.0', packages=['demo'], data_files=[('share/demo', ['package.xml'])], entry_points={'console_scripts': [%s]})\n"


@pytest.mark.parametrize(
    ("awaited", "words"),
    [
        ("demo_generate_messages_eus", "demo_generate_messages_eus makes the code in EusLisp and no headers of C++"),
        ("demo_genlisp", "demo_genlisp makes the code in Lisp and no headers"),
        ("demo_generate_messages_py demo_gennodejs", "make the code in Python and JavaScript and no headers"),
        ("demo_generate_messages_java", "has a name that no target has"),
        ("other_generate_messages_py", "has a name that no target has"),
        ("demo_generate_messages_py demo_messages_cpp", "has a name that no target has"),
    ],
)
def test_generation_for_another_language(awaited: str, words: str, tmp_path: Path) -> None:
    build = f"{GENERATES}add_executable(walk walk.cpp)\nadd_dependencies(walk {awaited})"
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", build),
        "msg/A.msg": "int32 a\n",
        "walk.cpp": "#include <demo/A.h>\nint main() { return 0; }\n",
    }
    (message,) = messages("generation-not-awaited", files, tmp_path)
    assert words in message


def test_a_script_without_entry_point(tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2).replace("ament_cmake", "ament_python"),
        "setup.py": SETUP % "'other = demo.doors:main'",
        "resource/demo": "",
        "demo/__init__.py": "",
        "demo/walls.py": NODE,
        "demo/doors.py": NODE,
        "launch/a.launch.xml": '<launch><node pkg="demo" exec="walls"/></launch>\n',
    }
    (message,) = messages("unknown-executable", files, tmp_path)
    assert "RENAME" not in message
    assert message.endswith(
        "the package has walls.py, but setup.py makes no program of it: add 'walls = MODULE:main' to console_scripts in entry_points"
    )


@pytest.mark.parametrize(
    ("scripts", "program", "words"),
    [
        ("'walls_exe = demo.walls:main'", "walls", "; setup.py makes the program 'walls_exe' of module walls: write 'walls_exe'"),
        ("'walls_exe = demo.walls:run'", "walls", "of module walls: write 'walls_exe'"),
        ("'far = demo.walls:main'", "walls", "; setup.py makes the program 'far' of module walls: write 'far'"),
        ("'b = demo.walls:main', 'a = demo.walls:main'", "walls", "makes the programs 'a' and 'b' of module walls: write 'a' or 'b'"),
        ("'other = demo.doors:main'", "walls", "setup.py makes no program of it"),
        ("'walls_exe = elsewhere.walls:main'", "walls", "setup.py makes no program of it"),
        ("'walls_exe = demo.doors:walls'", "walls", "setup.py makes no program of it"),
        ("'walls_exe = demo.walls.doors:main'", "walls", "setup.py makes no program of it"),
        ("'wall = demo.doors:main'", "walls", "setup.py makes no program of it"),
        ("'walls = demo.walls:main'", "wall", "; did you mean 'walls' or 'walls.py'?"),
    ],
)  # fmt: skip
def test_a_program_of_the_module_that_is_asked_for(scripts: str, program: str, words: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2).replace("ament_cmake", "ament_python"),
        "setup.py": SETUP % scripts,
        "resource/demo": "",
        "demo/__init__.py": "",
        "demo/walls.py": NODE,
        "demo/doors.py": NODE,
        "launch/a.launch.xml": f'<launch><node pkg="demo" exec="{program}"/></launch>\n',
    }
    (message,) = messages("unknown-executable", files, tmp_path)
    assert message.endswith(words) or (words.startswith("setup.py") and words in message)


@pytest.mark.parametrize("program", ["walls_exe", "walls_there"])
def test_a_program_that_is_there_by_that_name(program: str, tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS2).replace("ament_cmake", "ament_python"),
        "setup.py": SETUP % "'walls_exe = demo.walls:main', 'walls_there = demo.doors:main'",
        "resource/demo": "",
        "demo/__init__.py": "",
        "demo/walls.py": NODE,
        "demo/doors.py": NODE,
        "launch/a.launch.xml": f'<launch><node pkg="demo" exec="{program}"/></launch>\n',
    }
    assert messages("unknown-executable", files, tmp_path) == []


@pytest.mark.parametrize(
    ("line", "there", "words"),
    [
        ("install(DIRECTORY config DESTINATION share/demo)", "cfg/a.yaml", "did you mean cfg?"),
        ("install(DIRECTORY launches DESTINATION share/demo)", "launch/a.launch", "did you mean launch?"),
        ("install(DIRECTORY trajectoris DESTINATION share/demo)", "trajectories/a.csv", "did you mean trajectories?"),
        ("install(DIRECTORY config cfg DESTINATION share/demo)", "cfg/a.yaml", "stores no directory that is empty"),
        ("install(DIRECTORY config DESTINATION share/demo)", "launch/a.launch", "stores no directory that is empty"),
        ("install(DIRECTORY config DESTINATION share/demo)", "cfg", "stores no directory that is empty"),
        ("install(DIRECTORY maps DESTINATION share/demo)", "apps/a.txt", "stores no directory that is empty"),
    ],
)
def test_a_directory_of_another_name(line: str, there: str, words: str, tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": CATKIN.format("demo", line), there: "a\n"}
    (message,) = messages("missing-install-source", files, tmp_path)
    assert message.endswith(words)


@pytest.mark.parametrize(
    ("found", "names", "count"),
    [
        ("COMPONENTS roscpp", "message_runtime", 0),
        ("COMPONENTS roscpp", "std_msgs", 0),
        ("", "message_runtime", 1),
        ("COMPONENTS roscpp", "eigen", 1),
        ("COMPONENTS roscpp", "OpenCV", 1),
    ],
)
def test_packages_of_ros_behind_depends(found: str, names: str, count: int, tmp_path: Path) -> None:
    cmake = f"cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED {found})\ncatkin_package(DEPENDS {names})\n"
    files = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": cmake}
    assert len(messages("unknown-target", files, tmp_path)) == count


SCRIPT = "#!/usr/bin/env python\nimport rospy\nfrom tools import add\nrospy.init_node('n')\n"
INSTALL = "catkin_python_setup()\ninstall(PROGRAMS src/demo/node.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"


@pytest.mark.parametrize(
    ("packages", "words"),
    [
        ("['demo']", "; import it as demo.tools, which setup.py installs"),
        ("['other']", "or make it a module of a Python package (catkin_python_setup)"),
        ("", "or make it a module of a Python package (catkin_python_setup)"),
    ],
)
def test_a_module_of_a_package_that_is_installed(packages: str, words: str, tmp_path: Path) -> None:
    setup = "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\nsetup(**generate_distutils_setup(packages=%s, package_dir={'': 'src'}))\n"
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", INSTALL if packages else INSTALL.partition("\n")[2]),
        "src/demo/__init__.py": "",
        "src/demo/node.py": SCRIPT,
        "src/demo/tools.py": "def add():\n    pass\n",
    }
    if packages:
        files["setup.py"] = setup % packages
    (message,) = messages("module-not-installed", files, tmp_path)
    assert message.endswith(words)


@pytest.mark.parametrize(
    ("depends", "generates", "words"),
    [
        (
            "<depend>our_msgs</depend>",
            GENERATES.replace("A.msg", "Pose.msg"),
            "; use our_msgs/Pose, which our_msgs generates",
        ),
        ("", GENERATES.replace("A.msg", "Pose.msg"), "; call add_message_files() and generate_messages()"),
        ("<depend>our_msgs</depend>", "", "; call add_message_files() and generate_messages()"),
    ],
)
def test_an_interface_that_has_moved(depends: str, generates: str, words: str, tmp_path: Path) -> None:
    files = {
        "demo/package.xml": MANIFEST.format("demo", ROS1 + depends),
        "demo/CMakeLists.txt": CATKIN.format("demo", ""),
        "demo/msg/Pose.msg": "int32 a\n",
        "demo/scripts/a.py": "#!/usr/bin/env python\nimport rospy\nfrom demo.msg import Pose\nrospy.init_node('n')\nrospy.Publisher('p', Pose)\n",
        "our_msgs/package.xml": MANIFEST.format("our_msgs", ROS1),
        "our_msgs/CMakeLists.txt": CATKIN.format("our_msgs", generates),
        "our_msgs/msg/Pose.msg": "int32 a\n",
    }
    found = [message for message in messages("interface-not-generated", files, tmp_path) if "demo/Pose" in message]
    assert [words in message for message in found] == [True]


def test_a_definition_that_only_another_left_over_uses(tmp_path: Path) -> None:
    script = "#!/usr/bin/env python\nimport rospy\nfrom demo.msg import Pose\nrospy.init_node('n')\nrospy.Publisher('p', Pose)\n"
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", ""),
        "msg/Status.msg": "int32 a\n",
        "msg/Pose.msg": "demo/Status status\n",
    }
    assert messages("interface-not-generated", files, tmp_path / "a") == []
    found = messages("interface-not-generated", {**files, "scripts/a.py": script}, tmp_path / "b")
    assert len(found) == 2


def test_a_script_that_is_called_like_its_package(tmp_path: Path) -> None:
    setup = "from distutils.core import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\nsetup(**generate_distutils_setup(packages=['demo'], package_dir={'': 'src'}))\n"
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", INSTALL.replace("node.py", "demo.py")),
        "setup.py": setup,
        "src/demo/__init__.py": "",
        "src/demo/demo.py": SCRIPT,
        "src/demo/tools.py": "def add():\n    pass\n",
    }
    (message,) = messages("module-not-installed", files, tmp_path)
    assert message.endswith("; install src/demo/tools.py to lib/demo, too")


ACTION = """#include <demo/action/dock.hpp>
#include <rclcpp_action/rclcpp_action.hpp>

using GoalHandle = rclcpp_action::ServerGoalHandle<demo::action::Dock>;

class Docking : public rclcpp::Node
{
public:
  void execute(const std::shared_ptr<GoalHandle> goal_handle)
  {
    auto result = std::make_shared<demo::action::Dock::Result>();
    %s
    if (count_ > 3) {
      goal_handle->succeed(result);
    }
  }
};
"""


@pytest.mark.parametrize(
    ("before", "words"),
    [
        ("", "but the path that reaches the end of the function neither succeeds nor aborts nor cancels"),
        (
            "if (count_ > 9) {\n      return;\n    }",
            "but the paths that end in line 12 and at the end of the function neither succeed",
        ),
    ],
)
def test_where_a_path_ends(before: str, words: str, tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS2), "src/dock.cpp": ACTION % before}
    (message,) = messages("action-without-result", files, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (
            "self.finish(1)",
            "calls self.finish(), but nothing sets or defines it: the line raises AttributeError; define the method",
        ),
        ("self.finish()\n        self.finish()", "define the method, or remove the call"),
        (
            "print(self.finish)",
            "reads self.finish, but nothing sets or defines it: the line raises AttributeError; set it in",
        ),
        ("print(self.finish)\n        self.finish()", "reads self.finish, but nothing"),
        ("self.finish.run()", "set it in __init__()"),
        ("self.finish[0]()", "set it in __init__()"),
        ("self.speeed()", "; did you mean self.speed?"),
    ],
)
def test_methods_that_nothing_defines(line: str, words: str, tmp_path: Path) -> None:
    script = f"""#!/usr/bin/env python
import rospy


class Driver:
    def __init__(self):
        self.speed = 1

    def stop_all(self):
        {line}


rospy.init_node('driver')
Driver().stop_all()
"""
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", INSTALL),
        "scripts/node.py": script,
    }
    (message,) = messages("undefined-attribute", files, tmp_path)
    assert words in message


def test_the_command_that_generates_a_service(tmp_path: Path) -> None:
    files = {
        "package.xml": MANIFEST.format("demo", ROS1),
        "CMakeLists.txt": CATKIN.format("demo", INSTALL),
        "scripts/node.py": SCRIPT.replace("import rospy", "import rospy\nfrom demo.srv import Reset"),
        "srv/Reset.srv": "---\n",
    }
    (message,) = messages("interface-not-generated", files, tmp_path)
    assert message.endswith("; call add_service_files() and generate_messages()")


@pytest.mark.parametrize(
    ("subscription", "words"),
    [
        ("", "make it reliable, or leave out transient local"),
        ("node.create_subscription(String, 'map', print, SHAKY)", "as every subscriber here asks for best effort"),
        ("node.create_subscription(String, 'map', print, 10)", "make it reliable, or leave out transient local"),
        ("node.create_subscription(String, 'map', print, qos_of())", "make it reliable, or leave out transient local"),
        ("node.create_subscription(String, 'other', print, SHAKY)", "make it reliable, or leave out transient local"),
    ],
)
def test_what_is_kept_and_sent_with_best_effort(subscription: str, words: str, tmp_path: Path) -> None:
    script = f"""#!/usr/bin/env python3
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from elsewhere import qos_of

KEPT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SHAKY = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
rclpy.init()
node = rclpy.create_node('maps')
node.create_publisher(String, 'map', KEPT)
{subscription}
rclpy.spin(node)
"""
    files = {
        "package.xml": MANIFEST.format("demo", ROS2),
        "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
        "install(PROGRAMS scripts/node.py DESTINATION lib/demo)\nament_package()\n",
        "scripts/node.py": script,
    }
    (message,) = messages("qos-contradiction", files, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({}, "add <exec_depend>python3-serial</exec_depend>"),
        ({"serial/tests/try_serial.py": "import os\n"}, "add <exec_depend>python3-serial</exec_depend>"),
        ({"serial/src/serial/__init__.py": ""}, "add <exec_depend>serial</exec_depend>"),
        ({"serial/setup.py": "from setuptools import setup\nsetup(packages=['serial'])\n"}, "<exec_depend>serial<"),
        ({"serial/msg/Line.msg": "int32 a\n"}, "<exec_depend>serial<"),
        (
            {"serial/CMakeLists.txt": CATKIN.format("serial", "pybind11_add_module(serial src/a.cpp)")},
            "_depend>serial<",
        ),
    ],
)
def test_a_driver_that_is_called_like_a_module(more: dict[str, str], words: str, tmp_path: Path) -> None:
    files = {
        "demo/package.xml": MANIFEST.format("demo", ROS1),
        "demo/CMakeLists.txt": CATKIN.format("demo", "install(PROGRAMS node.py DESTINATION lib/demo)"),
        "demo/node.py": "#!/usr/bin/env python3\nimport serial\n\nserial.Serial('/dev/ttyUSB0').read()\n",
        "serial/package.xml": MANIFEST.format("serial", ROS1),
        "serial/CMakeLists.txt": CATKIN.format("serial", "add_library(serial src/serial.cpp)"),
        "serial/src/serial.cpp": "int serial() { return 0; }\n",
        **more,
    }
    found = [message for message in messages("undeclared-import", files, tmp_path) if "serial" in message]
    assert len(found) == 1 and words in found[0], found
