# SPDX-License-Identifier: Apache-2.0
"""What the check's page cannot show: a mark in the first line, or a carriage return, would change the example."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import mended, said
from haros_ci.checking.page import Example, filled
from haros_ci.registry import checks

CHECK = next(check for check in checks() if check.id == "script-not-runnable")
CODE = "import rclpy\n\nrclpy.init()\nrclpy.spin(rclpy.create_node('talker'))\n"
SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='demo',\n    packages=[],\n"
    "    data_files=[('lib/demo', ['talker.py'])],\n)\n"
)


def findings(tmp_path: Path, files: dict[str, str], executables: tuple[str, ...] = ()) -> list[tuple[str, str, str]]:
    """Path, level and message of what is found, and that a fix of it mends it."""
    example = Example("", True, files, executables=frozenset(executables))
    results = said(CHECK, example, tmp_path / "before")
    after = said(CHECK, mended(example, results), tmp_path / "after")
    assert [r.message for r in after] == [r.message for r in results if not r.fixes]
    return [(r.location.path, r.level.value, r.message) for r in results]


@pytest.mark.parametrize("shebang", ["/usr/bin/env python", "/usr/bin/python", " /usr/bin/env python"])
def test_ros_2_has_python3_alone(shebang: str, tmp_path: Path) -> None:
    ((path, level, message),) = findings(tmp_path, filled({"talker.py": f"#!{shebang}\n{CODE}"}))
    assert (path, level) == ("talker.py", "warning")
    assert "write python3" in message


@pytest.mark.parametrize(
    "shebang", ["/usr/bin/env python3", "/usr/bin/python3", "/usr/bin/env -S python3 -u", "/opt/python"]
)
def test_other_interpreters_are_right(shebang: str, tmp_path: Path) -> None:
    assert findings(tmp_path, filled({"talker.py": f"#!{shebang}\n{CODE}"})) == []


def test_python_2_code_is_not_mended_by_its_shebang(tmp_path: Path) -> None:
    files = filled({"talker.py": "#!/usr/bin/env python\nimport rclpy\nprint 'hello'\nrclpy.init()\n"})
    (result,) = said(CHECK, Example("", True, files), tmp_path)
    assert result.fixes == ()


def test_a_carriage_return_belongs_to_the_name(tmp_path: Path) -> None:
    text = f"#!/usr/bin/env python3\n{CODE}".replace("\n", "\r\n")
    ((path, level, message),) = findings(tmp_path, filled({"talker.py": text}))
    assert (path, level) == ("talker.py", "error")
    assert "carriage return" in message


def test_a_carriage_return_elsewhere_does_no_harm(tmp_path: Path) -> None:
    assert findings(tmp_path, filled({"talker.py": "#!/usr/bin/env python3\n" + CODE.replace("\n", "\r\n")})) == []


def test_ros_1_has_python(tmp_path: Path) -> None:
    code = CODE.replace("rclpy", "rospy")
    assert findings(tmp_path, filled({"talker.py": f"#!/usr/bin/env python\n{code}"})) == []


def test_data_files_keep_their_mode(tmp_path: Path) -> None:
    files = {
        "package.xml": filled({"a.py": ""})["package.xml"].replace("ament_cmake", "ament_python"),
        "setup.py": SETUP,
        "talker.py": f"#!/usr/bin/env python3\n{CODE}",
        "other.py": "",
    }
    ((path, level, message),) = findings(tmp_path, files, ("other.py",))
    assert (path, level) == ("talker.py", "warning")
    assert "setup.py installs it with its file mode" in message


CFG_MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>'
    "<depend>dynamic_reconfigure</depend></package>\n"
)
CFG_CMAKE = (
    "cmake_minimum_required(VERSION 3.0.2)\nproject(demo)\nfind_package(catkin REQUIRED COMPONENTS dynamic_reconfigure)\n"
    "generate_dynamic_reconfigure_options(cfg/Rate.cfg)\ncatkin_package()\n"
)


@pytest.mark.parametrize(
    ("more", "expected"),
    [
        ({}, "warning"),
        ({"README.md": "A node.\n"}, "warning"),
        ({"README.md": "For ROS Noetic and Melodic.\n"}, "warning"),
        ({"README.md": "For ROS Noetic.\n", "Dockerfile": "FROM ros:melodic\n"}, "warning"),
        ({"README.md": "See https://wiki.ros.org/noetic\n"}, "warning"),
        ({"CHANGELOG.md": "For ROS Noetic.\n"}, "warning"),
        ({"README.md": "For ROS Noetic.\n"}, "note"),
        ({"docker/robot.Dockerfile": "FROM ros:noetic-ros-base\n"}, "note"),
        ({"install.sh": "rosdep install --from-paths src --rosdistro=noetic\n"}, "note"),
        (
            {
                "install.sh": "apt-get install -y ros-noetic-tf\ngit clone -b melodic-devel https://example.org/melodic/a.git\n"
            },
            "note",
        ),
        (
            {"doc/workspace.md": "git@example.org:a.git origin/noetic-devel\ngit@example.org:b.git origin/indigo\n"},
            "note",
        ),
        ({"doc/workspace.md": "git@example.org:b.git origin/noetic-devel\nor Melodic\n"}, "warning"),
        ({"doc/workspace.md": "git@example.org:b.git origin/noetic\n"}, "warning"),
    ],
)
def test_files_of_dynamic_reconfigure(more: dict[str, str], expected: str, tmp_path: Path) -> None:
    cfg = "#!/usr/bin/env python\nfrom dynamic_reconfigure.parameter_generator_catkin import *\n"
    files = {
        "package.xml": CFG_MANIFEST,
        "CMakeLists.txt": CFG_CMAKE,
        "cfg/Rate.cfg": cfg,
        "run.sh": "#!/bin/sh\n",
        **more,
    }
    ((path, level, _),) = findings(tmp_path, files, ("run.sh",))
    assert (path, level) == ("cfg/Rate.cfg", expected)


WRITER = "#!/usr/bin/env python3\nimport sys\n\nprint(sys.argv)\n"
WRITER_CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "set(WRITER ${CMAKE_CURRENT_SOURCE_DIR}/write.py)\nadd_custom_command(OUTPUT a.hpp COMMAND ${Python3_EXECUTABLE} ${WRITER})\n"
    "install(FILES write.py DESTINATION lib/${PROJECT_NAME})\ninstall(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()\n"
)


@pytest.mark.parametrize(
    ("more", "count"),
    [
        ({}, 0),
        ({"README.md": "It is written by write.py.\n"}, 0),
        ({"README.md": "ros2 run demo write.py\n"}, 1),
        ({"launch/a.launch.xml": '<launch><node pkg="demo" exec="write.py"/></launch>\n'}, 1),
    ],
)
def test_what_an_interpreter_is_given_may_be_started_by_others(
    more: dict[str, str], count: int, tmp_path: Path
) -> None:
    files = filled({"write.py": WRITER, **more}) | {"CMakeLists.txt": WRITER_CMAKE}
    assert len(said(CHECK, Example("", True, files), tmp_path)) == count


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("execute_process(COMMAND chmod +x ${CMAKE_INSTALL_PREFIX}/lib/demo/talker.py)", 0),
        ('install(CODE "execute_process(COMMAND chmod +x ${CMAKE_INSTALL_PREFIX}/lib/demo/talker.py)")', 0),
        ("file(CHMOD scripts/talker.py PERMISSIONS OWNER_EXECUTE)", 0),
        ("execute_process(COMMAND ls scripts)", 1),
        ("# execute_process(COMMAND chmod +x talker.py)", 1),
    ],
)
def test_a_build_that_changes_modes_by_itself(command: str, count: int, tmp_path: Path) -> None:
    cmake = (
        "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
        f"install(DIRECTORY scripts/ DESTINATION lib/demo)\n{command}\nament_package()\n"
    )
    files = filled({"scripts/talker.py": f"#!/usr/bin/env python3\n{CODE}", "CMakeLists.txt": cmake})
    assert len(findings(tmp_path, files)) == count


ROS1 = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@example.org">m</maintainer>'
    "<license>MIT</license><buildtool_depend>catkin</buildtool_depend><depend>rospy</depend></package>\n"
)
CATKIN = "cmake_minimum_required(VERSION 3.0)\nproject(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n{}\n"
TALK = "import rospy\n\nif __name__ == '__main__':\n    rospy.init_node('talker')\n"
PLACE = "DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}"


@pytest.mark.parametrize(
    ("command", "shebang", "bits", "level", "words"),
    [
        (f"install(FILES scripts/talker.py {PLACE})", True, ("scripts/talker.py",), "warning", "rosrun does not find it in an install space (in a"),
        (f"install(FILES scripts/talker.py {PLACE})", True, (), "error", "rosrun does not find it; use"),
        (f"install(DIRECTORY scripts/ {PLACE})", True, ("scripts/talker.py",), "warning", "does not find it in an install space (in a"),
        (f"install(DIRECTORY scripts/ {PLACE})", True, (), "error", "does not find it; use"),
        (f"catkin_install_python(PROGRAMS scripts/talker.py {PLACE})", False, ("scripts/talker.py",), "error", "the start from an install space (a devel space gives it to Python by itself) fails"),
        (f"install(PROGRAMS scripts/talker.py {PLACE})", False, ("scripts/talker.py",), "error", "the start fails"),
    ],
)  # fmt: skip
def test_a_devel_space_runs_what_has_its_bit(
    command: str, shebang: bool, bits: tuple[str, ...], level: str, words: str, tmp_path: Path
) -> None:
    text = f"#!/usr/bin/env python3\n{TALK}" if shebang else TALK
    files = {"package.xml": ROS1, "CMakeLists.txt": CATKIN.format(command), "scripts/talker.py": text}
    ((_, found, message),) = findings(tmp_path, files, bits or ("other",))
    assert found == level and words in message


@pytest.mark.parametrize("command", ["install(PROGRAMS", "catkin_install_python(PROGRAMS"])
def test_programs_of_ros_1_that_start(command: str, tmp_path: Path) -> None:
    text = f"#!/usr/bin/env python3\n{TALK}"
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN.format(f"{command} scripts/talker.py {PLACE})"),
        "scripts/talker.py": text,
    }
    assert findings(tmp_path, files, ("scripts/talker.py",)) == []


DRONE = "#!/usr/bin/env python\nimport rospy\n\nrospy.loginfo('read')\n\n\nclass Drone:\n    pass\n{}"
FLY = "#!/usr/bin/env python3\n{}\n\nif __name__ == '__main__':\n    Drone()\n"
MAIN = "\n\nif __name__ == '__main__':\n    Drone()\n"
START = '<launch><node pkg="demo" type="drone.py" name="drone"/></launch>\n'


@pytest.mark.parametrize(
    ("drone", "fly", "more", "count"),
    [
        (DRONE.format(""), FLY.format("import drone"), {}, 0),
        (DRONE.format(""), FLY.format("from drone import Drone"), {}, 0),
        (DRONE.format(""), FLY.format("import rospy, drone"), {}, 0),
        (DRONE.format(""), FLY.format("from drone import Drone"), {"README.md": "It is in drone.py.\n"}, 0),
        (DRONE.format(""), FLY.format("from drones import Drone"), {}, 1),
        (DRONE.format(MAIN), FLY.format("from drone import Drone"), {}, 1),
        (DRONE.format(""), FLY.format("from drone import Drone"), {"launch/a.launch": START}, 1),
        (DRONE.format(""), FLY.format("from drone import Drone"), {"README.md": "rosrun demo drone.py\n"}, 1),
    ],
)
def test_a_module_with_a_shebang_that_scripts_beside_it_import(
    drone: str, fly: str, more: dict[str, str], count: int, tmp_path: Path
) -> None:
    files = {
        "package.xml": ROS1,
        "CMakeLists.txt": CATKIN.format(f"install(PROGRAMS scripts/drone.py scripts/fly.py {PLACE})"),
        "scripts/drone.py": drone,
        "scripts/fly.py": fly,
        **more,
    }
    assert len(findings(tmp_path, files, ("scripts/fly.py",))) == count


WORDS = "{}\n\n\ndef greeting():\n    return 1\n"
WORDS_CMAKE = (
    "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n"
    "install({} words.py DESTINATION {})\ninstall(DIRECTORY launch DESTINATION share/demo)\nament_package()\n"
)


@pytest.mark.parametrize(
    "above",
    [
        "NAME = 1",
        "import sys\nsys.path.append('lib')",
        "from sys import path\npath.insert(0, 'lib')",
        "import warnings\nwarnings.filterwarnings('ignore')",
        "import numpy as np\nnp.set_printoptions(precision=3)",
        "import matplotlib\nmatplotlib.use('Agg')",
        "import roslib; roslib.load_manifest('demo')",
        "import logging\nlogging.basicConfig()",
    ],
)
def test_a_module_among_the_programs(above: str, tmp_path: Path) -> None:
    files = filled({"words.py": WORDS.format(above)}) | {"CMakeLists.txt": WORDS_CMAKE.format("PROGRAMS", "lib/demo")}
    ((path, level, message),) = findings(tmp_path, files)
    assert (path, level) == ("words.py", "note")
    assert "take it out of the programs" in message


@pytest.mark.parametrize(
    ("above", "level"),
    [
        ("run()", "error"),
        ("import sys\nsys.path.append('lib')\nrun()", "error"),
        ("import logging\nlogging.info('ready')", "error"),
        ("import a\na.path.walk()", "error"),
        ("if __name__ == '__main__':\n    run()", "error"),
    ],
)
def test_a_program_that_prepares_itself(above: str, level: str, tmp_path: Path) -> None:
    files = filled({"words.py": WORDS.format(above)}) | {"CMakeLists.txt": WORDS_CMAKE.format("PROGRAMS", "lib/demo")}
    ((_, found, message),) = findings(tmp_path, files)
    assert found == level
    assert "begin it with one" in message


@pytest.mark.parametrize(
    ("more", "how"),
    [
        ({"words.py": "NAME = 1\n"}, ("PROGRAMS", "lib/demo")),
        ({"words.py": "#!/usr/bin/env python3\n" + WORDS.format("")}, ("PROGRAMS", "lib/demo")),
        ({}, ("FILES", "lib/demo")),
        ({}, ("PROGRAMS", "share/demo")),
        ({"other/go.py": "import words\n"}, ("PROGRAMS", "lib/demo")),
        ({"other/go.py": "import os, words as w\n"}, ("PROGRAMS", "lib/demo")),
        ({"other/go.py": "from demo.words import greeting\n"}, ("PROGRAMS", "lib/demo")),
        ({"other/go.py": "from demo import (\n    words,\n)\n"}, ("PROGRAMS", "lib/demo")),
        ({"other/go.py": "def load():\n    return import_module('words')\n"}, ("PROGRAMS", "lib/demo")),
        ({"scripts/go": "#!/usr/bin/env python3\nimport words\n"}, ("PROGRAMS", "lib/demo")),
        ({"README.md": "ros2 run demo words.py\n"}, ("PROGRAMS", "lib/demo")),
        ({"launch/a.launch.xml": '<launch><node pkg="demo" exec="words.py"/></launch>\n'}, ("PROGRAMS", "lib/demo")),
        ({"words.py": "def greeting(:\n"}, ("PROGRAMS", "lib/demo")),
    ],
)
def test_a_module_that_is_wanted_or_not_known(more: dict[str, str], how: tuple[str, str], tmp_path: Path) -> None:
    files = filled({"words.py": WORDS.format("NAME = 1"), **more}) | {"CMakeLists.txt": WORDS_CMAKE.format(*how)}
    assert said(CHECK, Example("", True, files, executables=frozenset(("words.py",))), tmp_path) == ()
