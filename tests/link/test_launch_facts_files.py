# SPDX-License-Identifier: Apache-2.0
"""Files, packages, programs and absolute paths that launch files name; what is not certain is None."""

from __future__ import annotations

import pytest
from launch_facts_kit import CMAKE, facts, ros1
from roslaunch_kit import MAIN, run

from haros_ci.launch.ros1 import roslaunch
from haros_ci.model.launch_facts import FileUse, PackageUse, ParameterFileUse, PathUse, ProgramUse

SHARE = "$(find-pkg-share p)"
YAML = "n:\n  ros__parameters:\n    a: 1\n"


def found(uses: list[FileUse]) -> list[tuple[str, str, bool | None]]:
    return [(use.kind, use.inner, use.is_found) for use in uses]


def node(inner: str = "", attributes: str = "") -> str:
    return f'<node pkg="p" exec="n" {attributes}>{inner}</node>'


MISSING = [
    pytest.param(f'<include file="{SHARE}/launch/b.launch.xml"/>', ("include", "launch/b.launch.xml"), id="include"),
    pytest.param('<include file="$(dirname)/b.launch.xml"/>', ("include", "launch/b.launch.xml"), id="dirname"),
    pytest.param(node(f'<param from="{SHARE}/config/b.yaml"/>'), ("parameters", "config/b.yaml"), id="parameters"),
    pytest.param(node(attributes=f'args="-d {SHARE}/rviz/b.rviz"'), ("value", "rviz/b.rviz"), id="argument"),
    pytest.param(node(f'<param name="m" value="{SHARE}/maps/b.yaml"/>'), ("value", "maps/b.yaml"), id="value"),
    pytest.param(f'<arg name="m" default="{SHARE}/maps/b.yaml"/>', ("default", "maps/b.yaml"), id="default"),
    pytest.param(
        node(f'<param name="d" value="$(command \'xacro {SHARE}/b.urdf.xacro\')"/>'),
        ("value", "b.urdf.xacro"),
        id="command",
    ),
    pytest.param(
        f'<set_parameters_from_file filename="{SHARE}/b.yaml"/>{node()}', ("parameters", "b.yaml"), id="global"
    ),
]


@pytest.mark.parametrize(("body", "expected"), MISSING)
def test_a_file_that_is_not_there(body: str, expected: tuple[str, str]) -> None:
    assert (*expected, False) in found(facts(FileUse, body))


PYTHON = [
    "IncludeLaunchDescription(os.path.join(get_package_share_directory('p'), 'launch', 'b.launch.py'))",
    "IncludeLaunchDescription([FindPackageShare('p'), '/launch/b.launch.py'])",
    "IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare('p'), 'launch', 'b.launch.py']))",
    "IncludeLaunchDescription([ThisLaunchFileDir(), '/b.launch.py'])",
]


@pytest.mark.parametrize("body", PYTHON)
def test_a_file_that_python_names(body: str) -> None:
    assert found(facts(FileUse, body, name="a.launch.py")) == [("include", "launch/b.launch.py", False)]
    there = {"p/launch/b.launch.py": "def generate_launch_description():\n  return None\n"}
    assert found(facts(FileUse, body, there, name="a.launch.py")) == [("include", "launch/b.launch.py", True)]


QUIET = [
    pytest.param(
        f'<include file="{SHARE}/launch/b.launch.xml"/>', {"p/launch/b.launch.xml": "<launch/>"}, True, id="there"
    ),
    pytest.param('<include file="$(find-pkg-share q)/launch/b.launch.xml"/>', {}, None, id="elsewhere"),
    pytest.param(
        node(f'<param from="{SHARE}/b.yaml"/>'),
        {"p/config/b.yaml": YAML, "p/CMakeLists.txt": CMAKE + "install(FILES config/b.yaml DESTINATION share/p)\n"},
        True,
        id="installed",
    ),
    pytest.param(
        node(f'<param from="{SHARE}/c.yaml"/>'),
        {
            "p/config/b.yaml": YAML,
            "p/CMakeLists.txt": CMAKE + "install(FILES config/b.yaml DESTINATION share/p RENAME c.yaml)\n",
        },
        True,
        id="renamed",
    ),
    pytest.param(
        node(f'<param from="{SHARE}/config/b.yaml"/>'),
        {"p/CMakeLists.txt": CMAKE + "configure_file(b.in ${CMAKE_CURRENT_BINARY_DIR}/b.yaml)\n"},
        None,
        id="configured",
    ),
    pytest.param(
        node(f'<param from="{SHARE}/config/b.yaml"/>'),
        {"p/CMakeLists.txt": CMAKE + "copy_my_files(b.yaml)\n"},
        None,
        id="named-by-the-build",
    ),
    pytest.param(
        node(f'<param from="{SHARE}/config/b.yaml"/>'), {"p/other/b.yaml": YAML}, None, id="perhaps-installed"
    ),
]


@pytest.mark.parametrize(("body", "files", "expected"), QUIET)
def test_a_file_that_is_there_or_may_be(body: str, files: dict[str, str], expected: bool | None) -> None:
    assert [use.is_found for use in facts(FileUse, body, files)] == [expected]


@pytest.mark.parametrize(
    "body",
    [
        f'<arg name="x"/>{node(f"""<param from="{SHARE}/config/$(var x).yaml"/>""")}',
        node(f'<param name="prefix" value="{SHARE}/maps/hall"/>'),
        f'<group if="false"><include file="{SHARE}/launch/b.launch.xml"/></group>',
        node('<param name="topic" value="/a/b.yaml.d/c"/>'),
    ],
)
def test_no_file_is_named_for_certain(body: str) -> None:
    assert facts(FileUse, body) == []


def test_a_file_is_where_its_tag_stands_and_who_includes_it() -> None:
    inner = {"p/launch/b.launch.xml": f'<launch>\n  <include file="{SHARE}/launch/c.launch.xml"/>\n</launch>'}
    use = facts(FileUse, f'\n<include file="{SHARE}/launch/b.launch.xml"/>', inner)[-1]
    assert (use.location.path, use.location.line, use.location.column) == ("p/launch/b.launch.xml", 2, 3)
    assert [(place.path, place.line) for place in use.included] == [("p/launch/a.launch.xml", 2)]
    assert use.path == "p/launch/c.launch.xml"


def test_what_may_be_meant() -> None:
    files = {"p/config/drive.param.yaml": YAML}
    (use,) = facts(FileUse, node(f'<param from="{SHARE}/config/drive_param.yaml"/>'), files)
    assert use.similar == ("config/drive.param.yaml",)


ROS1 = [
    ('<include file="$(find p)/launch/b.launch"/>', ("include", "launch/b.launch")),
    ('<node pkg="p" type="n" name="n"><rosparam file="$(find p)/b.yaml"/></node>', ("parameters", "b.yaml")),
    ('<param name="d" textfile="$(find p)/b.urdf"/>', ("text", "b.urdf")),
    ('<param name="d" command="xacro $(find p)/b.xacro"/>', ("value", "b.xacro")),
    ('<node pkg="p" type="n" name="n" args="$(dirname)/b.yaml"/>', ("value", "launch/b.yaml")),
]


@pytest.mark.parametrize(("body", "expected"), ROS1)
def test_a_file_in_ros1(body: str, expected: tuple[str, str]) -> None:
    assert (*expected, False) in found(ros1(FileUse, body))
    there = {f"p/{expected[1]}": "a: 1\n" if body.endswith("</node>") else "<launch/>"}
    assert [use.is_found for use in ros1(FileUse, body, there)] == [True]


@pytest.mark.parametrize(
    "body",
    [
        '<rosparam command="dump" file="$(find p)/out.yaml"/>',
        '<arg name="x"/><include file="$(find p)/launch/$(arg x).launch"/>',
        '<param name="x" value="$(find p)"/>',
    ],
)
def test_no_file_in_ros1(body: str) -> None:
    assert ros1(FileUse, body) == []


def test_packages() -> None:
    body = '<node pkg="p" exec="n"/><node pkg="q" exec="n"/><include file="$(find-pkg-share r)/a.launch.xml"/>'
    uses = facts(PackageUse, body)
    assert [(use.kind, use.package, use.is_here) for use in uses] == [
        ("node", "p", True),
        ("node", "q", False),
        ("find", "r", False),
        ("include", "r", False),
    ]
    assert [use.package for use in ros1(PackageUse, '<node pkg="q" type="n" name="n"/>')] == ["q"]
    assert facts(PackageUse, '<arg name="x"/><node pkg="$(var x)" exec="n"/>') == []


PROGRAMS = [
    ('<node pkg="p" exec="m"/>', {}, False),
    ('<node pkg="p" exec="n"/>', {}, True),
    ('<node pkg="q" exec="m"/>', {}, None),
    ('<node pkg="p" exec="m"/>', {"p/CMakeLists.txt": CMAKE + "make_my_program(m)\n"}, None),
    ('<node pkg="p" exec="m"/>', {"p/CMakeLists.txt": CMAKE + "my_add_executable(x)\n"}, None),
    ('<node pkg="p" exec="m.py"/>', {"p/scripts/m.py": "#!/usr/bin/env python3\n"}, True),
]


@pytest.mark.parametrize(("body", "files", "expected"), PROGRAMS)
def test_programs(body: str, files: dict[str, str], expected: bool | None) -> None:
    assert [use.is_found for use in facts(ProgramUse, body, files)] == [expected]


def test_programs_of_ros1() -> None:
    body = '<node pkg="p" type="m" name="a"/><node pkg="p" type="n" name="b"/>'
    body += '<node pkg="nodelet" type="nodelet" name="c" args="load p/M manager"/>'
    assert [(use.program, use.is_found) for use in ros1(ProgramUse, body)] == [
        ("m", False),
        ("n", True),
        ("nodelet", None),
        ("p/M", False),
    ]


PATHS = [
    ('<arg name="m" default="/home/anna/m.yaml"/>', ["home"]),
    (node('<param name="m" value="/data/maps/m.yaml"/>'), ["absolute"]),
    ('<include file="/opt/own/x.launch.xml"/>', []),
    ('<include file="/srv/own/x.launch.xml"/>', ["absolute"]),
    (node('<param name="t" value="/robot/points"/>'), []),
    (node('<param name="t" value="~/input/points"/>'), []),
    (node('<param name="d" value="/dev/video0"/>'), []),
    (node('<param name="d" value="/tmp/x.yaml"/>'), []),
    (node('<remap from="~/in" to="/home/in"/>'), []),
    (node(f'<param name="d" value="{SHARE}/x.yaml"/>'), []),
    (node('<param name="d" value="https://host/x/y.yaml"/>'), []),
]


@pytest.mark.parametrize(("body", "expected"), PATHS)
def test_absolute_paths(body: str, expected: list[str]) -> None:
    assert [use.kind for use in facts(PathUse, body)] == expected


def test_absolute_paths_of_ros1() -> None:
    assert [use.text for use in ros1(PathUse, '<param name="m" value="/home/anna/m.yaml"/>')] == ["/home/anna/m.yaml"]
    assert ros1(PathUse, '<param name="frame" value="/base_link"/><param name="d" value="/dev/ttyUSB0"/>') == []


def test_parameter_files_and_the_nodes_of_their_sections() -> None:
    text = "/**:\n  ros__parameters: {b: 1}\nother:\n  ros__parameters:\n    a: 1\nns:\n  m:\n    ros__parameters:\n      c: 2\n"
    body = '<node pkg="p" exec="n" name="m" namespace="ns"><param from="$(find-pkg-share p)/config/b.yaml"/></node>'
    (use,) = facts(ParameterFileUse, body, {"p/config/b.yaml": text})
    assert (use.node, use.program, use.path, use.is_found) == ("/ns/m", ("p", "n"), "p/config/b.yaml", True)
    assert [(each.pattern, each.location.line) for each in use.patterns] == [("/**", 1), ("other", 3), ("/ns/m", 7)]
    assert [each.matches for each in use.patterns][0] is True
    assert use.patterns[2].matches is True
    (lost,) = facts(ParameterFileUse, body)
    assert (lost.is_read, lost.is_found, lost.patterns) == (False, False, ())
    (outside,) = facts(ParameterFileUse, body.replace("share p", "share q"))
    assert outside.is_found is None


def test_facts_outlast_a_budget_that_ends_in_a_file_outside_the_workspace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(roslaunch, "steps_for", lambda _, steps: steps // 8)  # of any number all of them are taken
    body = '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    launched = run([MAIN], {MAIN: f"<launch>{'<group/>' * 40}{body * 300}</launch>"})
    assert any("more than can be evaluated" in problem.message for problem in launched.problems)
    assert any(isinstance(fact, PackageUse) and fact.package == "gazebo_ros" for fact in launched.facts)
