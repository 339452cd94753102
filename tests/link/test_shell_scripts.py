# SPDX-License-Identifier: Apache-2.0
"""Shell scripts that launch files start as nodes: the node says what it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

CATKIN = "<package><name>demo</name><buildtool_depend>catkin</buildtool_depend></package>"
AMENT = '<package format="3"><name>demo</name><export><build_type>ament_cmake</build_type></export></package>'
NODE = '<launch><node pkg="demo" {}="{}" name="tool"/></launch>'
SHELL = "#!/bin/bash\nrosrun demo talk\n"
ONE = "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\nrospy.init_node('talker')\nrospy.Publisher('chatter', String)\n"
TWO = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\nrclpy.init()\n"
    "node = rclpy.create_node('talker')\nnode.create_publisher(String, 'chatter', 1)\n"
)
PYTHON = "#!/usr/bin/env python3\nprint(1)\n"


def launched(root: Path, manifest: str, started: str, files: dict[str, str]) -> list[Node]:
    word, launch = ("type", "a.launch") if manifest == CATKIN else ("exec", "a.launch.xml")
    every = {
        "package.xml": manifest,
        "CMakeLists.txt": "project(demo)\n",
        f"launch/{launch}": NODE.format(word, started),
    }
    for path, text in {**every, **files}.items():
        (root / "demo" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "demo" / path).write_text(text)
    made = architecture(discover(root, ()), Settings(root=root), MemoryCache())
    return [node for each in made.configurations if each.launch for node in each.nodes]


def reasons(root: Path, manifest: str, started: str, files: dict[str, str]) -> list[str]:
    nodes = launched(root, manifest, started, files)
    return [each.reason for node in nodes for each in node.unknowns if each.field == "endpoints"]


def installed(line: str) -> dict[str, str]:
    return {"CMakeLists.txt": f"project(demo)\nfind_package(ament_cmake REQUIRED)\n{line}\n"}


@pytest.mark.parametrize(
    ("manifest", "started", "files", "path"),
    [
        (CATKIN, "run.sh", {"scripts/run.sh": SHELL}, "scripts/run.sh"),
        (CATKIN, "run.sh", {"scripts/run.sh": "rosrun demo talk\n"}, "scripts/run.sh"),
        (CATKIN, "run.bash", {"run.bash": SHELL}, "run.bash"),
        (AMENT, "run.sh", {"scripts/run.sh": SHELL}, "scripts/run.sh"),
        (
            AMENT,
            "go",
            {"scripts/run.sh": SHELL, **installed("install(PROGRAMS scripts/run.sh DESTINATION lib/demo RENAME go)")},
            "scripts/run.sh",
        ),
    ],
)
def test_a_shell_script(tmp_path: Path, manifest: str, started: str, files: dict[str, str], path: str) -> None:
    expected = f"demo/{started} (demo/{path}) is a shell script: what it starts is not known"
    assert reasons(tmp_path, manifest, started, files) == [expected]


@pytest.mark.parametrize(
    ("manifest", "started", "files"),
    [
        (CATKIN, "run.sh", {}),
        (CATKIN, "run.sh", {"scripts/walk.sh": SHELL}),
        (CATKIN, "run", {"scripts/run.sh": SHELL}),
        (CATKIN, "run.sh", {"scripts/run.sh": PYTHON}),
        (CATKIN, "run.txt", {"scripts/run.txt": "some words\n"}),
        (CATKIN, "run.sh", {"../other/run.sh": SHELL}),
        (CATKIN, "run.sh", {"../leg/package.xml": CATKIN.replace("demo", "leg"), "../leg/run.sh": SHELL}),
        (AMENT, "run", {"scripts/run.sh": SHELL}),
        (AMENT, "none.sh", {"scripts/run.sh": SHELL}),
    ],
)
def test_what_is_none(tmp_path: Path, manifest: str, started: str, files: dict[str, str]) -> None:
    expected = f"package demo is in the workspace, but no C++ or Python program called {started} was found in it"
    assert reasons(tmp_path, manifest, started, files) == [expected]


def test_a_program_of_python_is_followed(tmp_path: Path) -> None:
    files = {"scripts/run.sh": PYTHON, **installed("install(PROGRAMS scripts/run.sh DESTINATION lib/demo)")}
    assert reasons(tmp_path, CATKIN, "run.py", {"scripts/run.py": PYTHON, **files}) == []


@pytest.mark.parametrize(
    ("manifest", "script"),
    [
        (CATKIN, '#!/bin/bash\nrosrun demo talk.py "$@"\n'),
        (CATKIN, "#!/bin/sh\n# starts it\nset -e\n. /opt/venv/activate\n\nexec rosrun demo talk.py $@\n"),
        (AMENT, '#!/bin/bash\nsource ~/venv/bin/activate\nros2 run demo talk.py "$@"\n'),
        (AMENT, "#!/bin/bash\npython3 $(ros2 pkg prefix demo)/lib/demo/talk.py $@\n"),
        (AMENT, '#!/bin/bash\nexec "$(ros2 pkg prefix demo)/lib/demo/talk.py" "${@}"\n'),
    ],
)
def test_a_script_that_hands_its_words_on_is_the_program(tmp_path: Path, manifest: str, script: str) -> None:
    files = {
        "scripts/talk.py": ONE if manifest == CATKIN else TWO,
        "scripts/run.sh": script,
        **installed("install(PROGRAMS scripts/talk.py scripts/run.sh DESTINATION lib/demo)"),
    }
    (node,) = launched(tmp_path, manifest, "run.sh", files)
    topics = [end.name for end in node.endpoints if end.kind == "publishers" and not end.implicit]
    assert (node.package, node.type, node.name, topics) == ("demo", "talk.py", "/tool", ["/chatter"])


@pytest.mark.parametrize(
    "script",
    [
        "rosrun demo talk.py\n",  # names and remappings stay behind
        'rosrun demo talk.py _rate:=1 "$@"\n',
        'rosrun demo talk.py "$@" &\n',
        'sleep 1\nrosrun demo talk.py "$@"\n',
        'export ROS_NAMESPACE=a\nrosrun demo talk.py "$@"\n',
        'rosrun demo talk.py "$@"\nrosrun demo other.py "$@"\n',
        'if true; then\nrosrun demo talk.py "$@"\nfi\n',
        'rosrun $PACKAGE talk.py "$@"\n',
        'source a.bash; rosrun demo talk.py "$@"\n',
        'source a.bash && rosrun demo other.py\nrosrun demo talk.py "$@"\n',
        'roslaunch demo talk.py "$@"\n',
        'python3 $(ros2 pkg prefix demo)/lib/leg/talk.py "$@"\n',
        "",
    ],
)
def test_a_script_that_does_anything_else(tmp_path: Path, script: str) -> None:
    files = {"scripts/talk.py": ONE, "scripts/run.sh": f"#!/bin/bash\n{script}"}
    expected = ["demo/run.sh (demo/scripts/run.sh) is a shell script: what it starts is not known"]
    assert reasons(tmp_path, CATKIN, "run.sh", files) == expected
