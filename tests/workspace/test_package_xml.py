# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.model.package import Dependency, Package
from haros_ci.model.workspace import Problem
from haros_ci.workspace.package_xml import parse_package


def package(xml: str, environment: dict[str, str] | None = None) -> Package:
    found = parse_package("src/arm/package.xml", xml.encode(), environment=environment)
    assert isinstance(found, Package), found
    return found


def fault(xml: str | bytes) -> Problem:
    data = xml if isinstance(xml, bytes) else xml.encode()
    found = parse_package("src/arm/package.xml", data)
    assert isinstance(found, Problem), found
    return found


FORMAT_1 = """<?xml version="1.0"?>
<package>
  <name>arm</name>
  <version>0.7.6</version>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend version_gte="1.0">roscpp</build_depend>
  <run_depend>roscpp</run_depend>
  <conflict>leg</conflict>
  <export><metapackage/></export>
</package>
"""


def test_format_1() -> None:
    assert package(FORMAT_1) == Package(
        name="arm",
        path="src/arm",
        format=1,
        version="0.7.6",
        build_type="",
        ros=1,
        dependencies=(
            Dependency("catkin", "buildtool_depend", line=5),
            Dependency("roscpp", "build_depend", line=6),
            Dependency("roscpp", "run_depend", line=7),
        ),
        is_metapackage=True,
    )


def test_formats_2_and_3() -> None:
    found = package(
        '<package format="3"><name> arm\n</name><depend>rclcpp</depend><exec_depend>a</exec_depend>'
        "<build_export_depend>b</build_export_depend><doc_depend>c</doc_depend><test_depend>d</test_depend>"
        "<member_of_group>g</member_of_group><group_depend>h</group_depend><depend> </depend>"
        "<export><build_type>ament_cmake</build_type></export></package>"
    )
    assert (found.name, found.format, found.build_type, found.ros) == ("arm", 3, "ament_cmake", 2)
    assert [(d.name, d.kind) for d in found.dependencies] == [
        ("rclcpp", "depend"),
        ("a", "exec_depend"),
        ("b", "build_export_depend"),
        ("c", "doc_depend"),
        ("d", "test_depend"),
    ]


def test_the_root_is_a_dot() -> None:
    found = parse_package("package.xml", b"<package><name>arm</name></package>")
    assert isinstance(found, Package) and found.path == "."


BOTH = """<package format="3"><name>arm</name>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>
  <export>
    <build_type condition="$ROS_VERSION == 1">catkin</build_type>
    <build_type condition="$ROS_VERSION == 2">ament_cmake</build_type>
  </export></package>"""


@pytest.mark.parametrize(
    ("environment", "ros", "build_type", "dependencies"),
    [
        (None, None, "", [("catkin", "$ROS_VERSION == 1"), ("ament_cmake", "$ROS_VERSION == 2")]),
        ({"ROS_VERSION": "1"}, 1, "catkin", [("catkin", None)]),
        ({"ROS_VERSION": "2"}, 2, "ament_cmake", [("ament_cmake", None)]),
    ],
)
def test_a_package_for_both(
    environment: dict[str, str] | None, ros: int | None, build_type: str, dependencies: list[tuple[str, str | None]]
) -> None:
    found = package(BOTH, environment)
    assert (found.ros, found.build_type) == (ros, build_type)
    assert [(d.name, d.condition) for d in found.dependencies] == dependencies


#: A package that says that it is built in both, whatever it depends on.
TYPES = "<export><build_type>catkin</build_type><build_type>ament_cmake</build_type></export>"


@pytest.mark.parametrize(
    ("body", "ros"),
    [
        ("<buildtool_depend>ament_cmake_ros</buildtool_depend>", 2),
        ("<depend>rclpy</depend>", 2),
        ("<run_depend>rospy</run_depend>", 1),
        ("<export><build_type>cmake</build_type></export>", None),
        ("<export><build_type>cmake</build_type></export><depend>rclcpp</depend>", 2),
        ("<depend>rclcpp</depend><depend>roscpp</depend>", None),
        (
            "<buildtool_depend>ament_cmake</buildtool_depend><buildtool_depend>catkin</buildtool_depend><depend>rclcpp</depend>",
            None,
        ),
        (f"{TYPES}<buildtool_depend>ament_cmake</buildtool_depend><depend>rclcpp</depend>", 2),
        (f"{TYPES}<buildtool_depend>catkin</buildtool_depend><depend>roscpp</depend>", 1),
        (TYPES, None),
        ("<depend>eigen</depend>", None),
        ("", None),
    ],
)
def test_ros_version(body: str, ros: int | None) -> None:
    assert package(f"<package format='2'><name>arm</name>{body}</package>").ros == ros


BOMB = """<?xml version="1.0"?>
<!DOCTYPE package [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<package><name>&b;</name></package>"""


@pytest.mark.parametrize(
    ("xml", "line", "words"),
    [
        ("<package>\n<name>arm</name>\n", 3, "no element found"),
        ("<package>\n<name>arm</nome></package>", 2, "mismatched tag"),
        ("", 1, "no element found"),
        ("<package>\n</package>", 1, "no package name"),
        ("<package><name> </name></package>", 1, "no package name; add <name>"),
        ("<package>\n<version>1</version>\n<n>arm</n></package>", 3, "write <name>arm</name>"),
        ("<package>\n<Name> arm </Name></package>", 2, "<Name> is no tag of package.xml"),
        ("<package>\n<license>MIT</license></package>", 1, "no package name; add <name>"),
        ("<package>\n<summary>An arm that grips</summary></package>", 1, "no package name; add <name>"),
        ("<package>\n<export><n>arm</n></export></package>", 1, "no package name; add <name>"),
        ("\n<robot/>", 2, "<robot>"),
        ("<package format='x'><name>arm</name></package>", 1, "'x'"),
        (BOMB, 2, "declaration is not allowed"),
        (
            '<!DOCTYPE p SYSTEM "file:///etc/passwd"><package><name>arm</name></package>',
            1,
            "declaration is not allowed",
        ),
        ("<package><name>&e;</name></package>", 1, "undefined entity"),
        ("<package>\n" + "<a>" * 5000, 2, "nested deeper"),
        ("<package>" + "<a/>" * 100_001 + "</package>", 1, "more than 100000 elements"),
        (b"\x7fELF\x00\x01", 1, "not well-formed"),
        (b'<?xml version="1.0" encoding="no-such"?><package/>', 1, "unknown"),
        (b'<?xml version="1.0" encoding="rot13"?><package/>', 1, "unknown"),
        (b"<package><name>\xff</name></package>", 1, "invalid token"),
        (
            "<package>\n<!-- old:\n<!-- arm -->\n-->\n</package>",
            3,
            "a comment inside of the comment that begins in line 2",
        ),
        ("<package>\n<!-- a -->\n<!-- a -- b -->\n</package>", 3, "'--' inside of the comment that begins in line 3"),
        ("<package>\n<!-- a --->\n</package>", 2, "'--' inside of the comment that begins in line 2"),
        ("<package>\n<!-- a --\n</package>", 2, "'--' inside of the comment that begins in line 2"),
        ("<package>\n<!-- a -->\n<name>a -- b & c</name>\n</package>", 3, "invalid token"),
        ("<package>\n<!-- a -->\n<name --='1'/>\n</package>", 3, "invalid token"),
        ("<package>\n<!-- a", 2, "unclosed token"),
    ],
)
def test_faults(xml: str | bytes, line: int, words: str) -> None:
    found = fault(xml)
    assert (found.path, found.line) == ("src/arm/package.xml", line)
    assert words in found.message


@pytest.mark.parametrize(
    "data",
    [
        b"\xef\xbb\xbf<package><name>arm</name></package>",
        b"<package>\r\n<name>arm</name>\r\n</package>\r\n",
        '<?xml version="1.0" encoding="ISO-8859-1"?><package><name>arm</name><author>Gómez</author></package>'.encode(
            "latin-1"
        ),
        b"<!-- by hand --><package xmlns:x='urn:x' x:y='z'><name>arm</name></package><!-- end -->",
    ],
)
def test_unusual_but_sound(data: bytes) -> None:
    found = parse_package("package.xml", data)
    assert isinstance(found, Package) and found.name == "arm"
