# SPDX-License-Identifier: Apache-2.0
"""Messages name what is meant: the file that needs a directory, the line in which a path ends, the name to write."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_first_run import CATKIN, MANIFEST, ROS1, ROS2, messages

from haros_ci.report.gathered import _of_many

CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"
LAUNCH = '<launch><arg name="world" default="$(find-pkg-share demo)/worlds/a.world"/>\n<node pkg="demo" exec="x" args="$(var world)"/></launch>\n'
MODEL = '<robot name="r"><link name="a"><visual><geometry><mesh filename="package://demo/meshes/a.stl"/></geometry></visual></link></robot>\n'


def robot(install: str) -> dict[str, str]:
    return {"package.xml": MANIFEST.format("demo", ROS2), "CMakeLists.txt": CMAKE.format(install), "urdf/r.urdf": MODEL, "meshes/a.stl": "solid"}  # fmt: skip


def test_the_file_that_needs_a_directory(tmp_path: Path) -> None:
    found = messages("directory-not-installed", robot("install(DIRECTORY urdf DESTINATION share/demo)"), tmp_path)
    assert found == ["the directory meshes of demo is not installed, but urdf/r.urdf:1 needs it; add it to install(DIRECTORY ...)"]  # fmt: skip


@pytest.mark.parametrize(
    ("destination", "words"),
    [
        ("share/demo/meshes", "; write DIRECTORY meshes/ with a slash, or leave meshes out of the destination"),
        ("share/demo/things", "; correct the destination"),
    ],
)
def test_a_directory_in_itself(destination: str, words: str, tmp_path: Path) -> None:
    install = f"install(DIRECTORY urdf DESTINATION share/demo)\ninstall(DIRECTORY meshes DESTINATION {destination})"
    (message,) = messages("directory-not-installed", robot(install), tmp_path)
    assert message.endswith(words)


@pytest.mark.parametrize(
    ("install", "words"),
    [
        (
            "install(DIRECTORY urdf/ meshes/ DESTINATION share/demo)",
            "; write DIRECTORY meshes without a slash, which installs the directory itself",
        ),
        (
            "install(DIRECTORY urdf meshes/ DESTINATION share/${PROJECT_NAME}/)",
            "; write DIRECTORY meshes without a slash, which installs the directory itself",
        ),
        ("install(DIRECTORY urdf meshes/ DESTINATION share/other)", "; correct the destination"),
        ("install(DIRECTORY urdf meshes/ DESTINATION share/demo/mesh)", "; correct the destination"),
        ("install(FILES meshes/a.stl DESTINATION share/demo)", "; correct the destination"),
    ],
)
def test_a_directory_whose_content_alone_is_installed(install: str, words: str, tmp_path: Path) -> None:
    (message,) = messages("directory-not-installed", robot(install), tmp_path)
    assert message.endswith(words)


def test_the_default_of_an_argument(tmp_path: Path) -> None:
    files = {"package.xml": MANIFEST.format("demo", ROS2), "CMakeLists.txt": CMAKE.format(""), "launch/a.launch.xml": LAUNCH}  # fmt: skip
    (message,) = messages("missing-launch-file", files, tmp_path)
    assert message.startswith("the default of 'world' is worlds/a.world of demo, but this file does not exist")


@pytest.mark.parametrize(
    ("name", "count"),
    [("b.py", 1), ("b", 1), ("b.py.bak", 0), ("b.py~", 0), ("b.py.old", 0), ("b.py.orig", 0), ("b.bak2", 0)],
)
def test_scripts_that_are_kept_beside(name: str, count: int, tmp_path: Path) -> None:
    script = (
        "#!/usr/bin/env python\nimport rospy\nif __name__ == '__main__':\n    rospy.init_node('n')\n    rospy.spin()\n"
    )
    cmake = CATKIN.format("demo", "install(PROGRAMS scripts/a.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})")
    files = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": cmake, "scripts/a.py": script, f"scripts/{name}": script}  # fmt: skip
    found = messages("target-not-installed", files, tmp_path)
    assert len(found) == count


@pytest.mark.parametrize(
    ("reason", "words"),
    [("it is Python 2", "they are Python 2"), ("it is not valid Python 3.11", "they are not valid Python 3.11"), ("a header is missing", "a header is missing")],
)  # fmt: skip
def test_one_reason_of_many_files(reason: str, words: str) -> None:
    assert _of_many(reason) == words


MESH = '<link name="{0}"><visual><geometry><mesh filename="package://demo/meshes/{0}"/></geometry></visual></link>'


@pytest.mark.parametrize(
    ("there", "named", "count"),
    [
        (("a.dae",), ("a.obj", "b.obj", "c.obj"), 1),
        (("a.dae", "d.obj"), ("a.obj", "b.obj", "c.obj"), 3),
        (("a.dae",), ("a.dae", "b.obj"), 1),
        (("a.dae",), ("a.dae",), 0),
        (("a.obj", "b.obj", "c.obj"), ("a.obj", "b.obj", "c.obj"), 0),
    ],
)
def test_meshes_of_a_format_that_the_directory_has_not(there: tuple[str, ...], named: tuple[str, ...], count: int, tmp_path: Path) -> None:  # fmt: skip
    model = f'<robot name="r">{"".join(map(MESH.format, named))}</robot>\n'
    install = CMAKE.format("install(DIRECTORY urdf meshes DESTINATION share/demo)")
    files = {"package.xml": MANIFEST.format("demo", ROS2), "CMakeLists.txt": install, "urdf/r.urdf": model}
    found = messages("mesh-not-loaded", {**files, **{f"meshes/{name}": "solid" for name in there}}, tmp_path)
    assert len(found) == count
    assert any(message.endswith("; 2 more meshes are looked for in the same directory, which has no file *.obj") for message in found) is (there == ("a.dae",) and len(named) == 3)  # fmt: skip


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"msg/A.msg": "int8 a\n", "srv/A.srv": "---\n"}, "so no code can use it"),
        ({"msg/A.msg": "int8 a\n", "srv/B.srv": "---\n"}, "which uses it, does not build or start"),
    ],
)
def test_a_message_and_a_service_of_one_name(files: dict[str, str], expected: str, tmp_path: Path) -> None:
    service = next(name for name in files if name.startswith("srv/"))[4:]
    cmake = f"find_package(catkin REQUIRED)\nadd_service_files(FILES {service})\ngenerate_messages()"
    name = "A" if service == "A.srv" else "A, B"
    kind = "srv" if service == "A.srv" else "msg"
    code = f"#!/usr/bin/env python\nfrom demo.{kind} import {name.split(',')[0]}\nimport rospy\nif __name__ == '__main__':\n    rospy.init_node('n')\n"
    texts = {"package.xml": MANIFEST.format("demo", ROS1), "CMakeLists.txt": CATKIN.format("demo", cmake), "scripts/n.py": code}  # fmt: skip
    (message,) = messages("interface-not-generated", {**texts, **files}, tmp_path)
    assert expected in message and "msg/A.msg" in message


SUPPORT = 'rosidl_get_typesupport_target(support demo rosidl_typesupport_cpp)\nlink_libraries("${support}")\n'


@pytest.mark.parametrize(
    ("before", "after", "count"),
    [(SUPPORT, "", 0), ("link_libraries(m)\n", "", 1), ("", SUPPORT, 1), ("", "", 1), ("", SUPPORT.replace("link_libraries(", "target_link_libraries(n "), 0)],
)  # fmt: skip
def test_libraries_of_all_targets(before: str, after: str, count: int, tmp_path: Path) -> None:
    cmake = f'find_package(rosidl_default_generators REQUIRED)\nrosidl_generate_interfaces(demo "msg/A.msg")\n{before}add_executable(n n.cpp)\n{after}'
    files = {"package.xml": MANIFEST.format("demo", ROS2), "CMakeLists.txt": CMAKE.format(cmake), "msg/A.msg": "int8 a\n", "n.cpp": '#include "demo/msg/a.hpp"\nint main() {}\n'}  # fmt: skip
    assert len(messages("generation-not-awaited", files, tmp_path)) == count
