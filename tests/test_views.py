# SPDX-License-Identifier: Apache-2.0
"""Packages of one name in a workspace."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.coverage import coverage_of
from haros_ci.analysis.views import in_views
from haros_ci.config.settings import Settings
from haros_ci.model.location import Location
from haros_ci.results.own import TOOL
from haros_ci.results.result import Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover
from haros_ci.workspace.views import views

HEAD = "<version>1.0.0</version><description>d</description><maintainer email='a@example.com'>a</maintainer><license>MIT</license>"
CATKIN = f"<package format='2'><name>{{}}</name>{HEAD}<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend></package>"
AMENT = (
    f"<package format='3'><name>{{}}</name>{HEAD}<depend>rclpy</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
NEITHER = f"<package format='3'><name>{{}}</name>{HEAD}</package>"
ONE = "#!/usr/bin/env python\nimport rospy\nfrom std_msgs.msg import String\nrospy.init_node('talker')\nrospy.Publisher('{}', String)\n"
TWO = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\nrclpy.init()\n"
    "node = rclpy.create_node('talker')\nnode.create_publisher(String, '{}', 1)\n"
)
MANIFESTS = {"catkin": CATKIN, "ament": AMENT, "neither": NEITHER}


def plant(root: Path, *packages: tuple[str, str]) -> None:
    """A package ``foo`` at each path, of a build type, with a script that publishes a topic named like the path."""
    for path, kind in packages:
        place = root / path
        (place / "scripts").mkdir(parents=True)
        (place / "package.xml").write_text(MANIFESTS[kind].format("foo"))
        install = "lib/foo" if kind == "ament" else "${CATKIN_PACKAGE_BIN_DESTINATION}"
        tool = "ament_cmake" if kind == "ament" else "catkin"
        (place / "CMakeLists.txt").write_text(
            f"project(foo)\nfind_package({tool} REQUIRED)\ninstall(PROGRAMS scripts/talker.py DESTINATION {install})\n"
        )
        script = place / "scripts" / "talker.py"
        script.write_text((TWO if kind == "ament" else ONE).format(path.replace("/", "_")))
        script.chmod(0o755)


def topics(root: Path) -> dict[str, list[str]]:
    """The topics that are published, by configuration."""
    workspace = discover(root, (".",))
    made = varied(workspace, Settings(root=root), MemoryCache(), alternatives=False)
    return {
        one.name: [
            end.name for node in one.nodes for end in node.endpoints if end.kind == "publishers" and not end.implicit
        ]
        for one in made.architecture.configurations
    }


@pytest.mark.parametrize(
    ("packages", "expected"),
    [
        ([("a", "catkin"), ("b", "ament")], {"foo/talker.py (ROS 1)": ["/a"], "foo/talker.py (ROS 2)": ["/b"]}),
        ([("a", "ament"), ("b", "catkin")], {"foo/talker.py (ROS 1)": ["/b"], "foo/talker.py (ROS 2)": ["/a"]}),
        (
            [("a", "catkin"), ("b", "catkin"), ("c", "ament")],
            {"foo/talker.py (ROS 1)": ["/a"], "foo/talker.py (ROS 2)": ["/c"]},
        ),
        ([("a", "catkin"), ("b", "catkin")], {"foo/talker.py": ["/a"]}),
        ([("b", "ament"), ("a/x", "ament")], {"foo/talker.py": ["/a_x"]}),
        ([("3rdparty/foo", "ament"), ("src/foo", "ament")], {"foo/talker.py": ["/src_foo"]}),
        ([("a", "ament")], {"foo/talker.py": ["/a"]}),
    ],
)
def test_the_model_of_packages_of_one_name(
    tmp_path: Path, packages: list[tuple[str, str]], expected: dict[str, list[str]]
) -> None:
    plant(tmp_path, *packages)
    assert topics(tmp_path) == expected


def test_what_is_not_doubled_is_there_once_and_keeps_its_name(tmp_path: Path) -> None:
    plant(tmp_path, ("a", "catkin"), ("b", "ament"))
    plant(tmp_path, ("c", "ament"), ("d", "catkin"))
    for path, name in (("c", "other"), ("d", "older")):
        for file in ("package.xml", "CMakeLists.txt"):
            text = (tmp_path / path / file).read_text()
            (tmp_path / path / file).write_text(text.replace("foo", name))
    assert topics(tmp_path) == {
        "foo/talker.py (ROS 1)": ["/a"],
        "foo/talker.py (ROS 2)": ["/b"],
        "older/talker.py": ["/d"],
        "other/talker.py": ["/c"],
    }


def test_a_package_of_neither_version_counts_where_no_other_does(tmp_path: Path) -> None:
    plant(tmp_path, ("a", "neither"), ("b", "ament"))
    (view,) = views(discover(tmp_path, (".",)))
    assert [package.path for package in view.workspace.packages] == ["b"]


def test_an_ignored_package_does_not_count(tmp_path: Path) -> None:
    plant(tmp_path, ("a", "ament"), ("b", "ament"))
    (tmp_path / "a" / "COLCON_IGNORE").write_text("")
    workspace = discover(tmp_path, (".",))
    assert topics(tmp_path) == {"foo/talker.py": ["/b"]}
    assert workspace.problems == ()


@pytest.mark.parametrize(
    ("packages", "warned"),
    [
        ([("a", "catkin"), ("b", "ament")], []),
        ([("a", "catkin"), ("b", "catkin")], ["b"]),
        ([("a", "catkin"), ("b", "ament"), ("c", "ament")], ["c"]),
        ([("3rdparty/foo", "ament"), ("src/foo", "ament")], ["3rdparty/foo"]),
    ],
)
def test_only_what_is_left_out_is_warned_of(tmp_path: Path, packages: list[tuple[str, str]], warned: list[str]) -> None:
    plant(tmp_path, *packages)
    problems = discover(tmp_path, (".",)).problems
    assert [problem.path for problem in problems] == warned
    assert all("COLCON_IGNORE" in problem.message and "exclude" in problem.message for problem in problems)


def test_each_view_has_the_findings_of_its_own_packages(tmp_path: Path) -> None:
    plant(tmp_path, ("a", "catkin"), ("b", "ament"))
    one, two = views(discover(tmp_path, (".",)))
    assert [one.holds(path) for path in ("a/package.xml", "b/package.xml", "x.launch")] == [True, False, True]
    assert [two.holds(path) for path in ("a/package.xml", "b/package.xml", "x.launch")] == [False, True, True]


@pytest.mark.parametrize(
    ("packages", "path", "message", "expected"),
    [
        (("robot/src/foo", "server/src/foo"), "server/src/user/a.py", "foo defines no X", True),
        (("robot/src/foo", "server/src/foo"), "server/launch/a.launch", "package foo builds no program", True),
        (("robot/src/foo", "server/src/foo"), "server/src/user/a.py", "foo/Map has no field x", True),
        (("robot/src/foo", "server/src/foo", "web/src/foo"), "web/src/user/a.py", "foo defines no X", True),
        (("robot/src/foo", "server/src/foo"), "robot/src/user/a.py", "foo defines no X", False),
        (("robot/src/foo", "server/src/foo"), "tools/a.py", "foo defines no X", False),
        (("robot/src/foo", "server/src/foo"), "server/src/user/a.py", "foo_msgs defines no X", False),
        (("robot/src/foo", "server/src/foo"), "server/src/user/a.py", "a-foo defines no X", False),
        (("robot/src/foo", "server/src/foo"), "server/src/user/a.py", "bar defines no X", False),
        (("robot/src/foo", "robot/src/old/foo"), "robot/src/user/a.py", "foo defines no X", False),
        (("robot/src/foo",), "server/src/user/a.py", "foo defines no X", False),
    ],
)
def test_a_package_that_is_nearer_and_does_not_count(
    tmp_path: Path, packages: tuple[str, ...], path: str, message: str, expected: bool
) -> None:
    plant(tmp_path, *((package, "ament") for package in packages))
    (view,) = views(discover(tmp_path, (".",)))
    assert view.is_nearer_another(path, message) == expected


def test_what_a_change_brings_hides_nothing(tmp_path: Path) -> None:
    plant(tmp_path, ("robot/src/foo", "ament"), ("server/src/foo", "ament"))
    workspace = discover(tmp_path, (".",))
    workspace = replace(workspace, hiding=replace(workspace.hiding, later=frozenset({"server/src/foo"})))
    (view,) = views(workspace)
    assert not view.is_nearer_another("server/src/user/a.py", "foo defines no X")


def test_the_other_version_of_ros_has_a_view_of_its_own(tmp_path: Path) -> None:
    plant(tmp_path, ("robot/src/foo", "catkin"), ("server/src/foo", "ament"))
    for view in views(discover(tmp_path, (".",))):
        assert not view.is_nearer_another("server/src/user/a.py", "foo defines no X")


@pytest.mark.parametrize(
    ("rule", "path", "kept"),
    [
        ("undefined-interface", "server/src/user/a.py", False),
        ("undefined-interface", "robot/src/user/a.py", True),
        ("undeclared-import", "server/src/user/package.xml", True),
    ],
)
def test_findings_on_the_neighbour(tmp_path: Path, rule: str, path: str, kept: bool) -> None:
    plant(tmp_path, ("robot/src/foo", "ament"), ("server/src/foo", "ament"))
    run = Run(Tool(TOOL), results=(Result(TOOL, rule, Level.ERROR, "foo defines no X", Location(path, 1)),))
    seen = in_views(run, discover(tmp_path, (".",)), None, lambda view: run)
    assert seen.results == (run.results if kept else ())


def test_calls_of_both_are_counted(tmp_path: Path) -> None:
    plant(tmp_path, ("a", "catkin"), ("b", "ament"))
    workspace, settings = discover(tmp_path, (".",)), Settings(root=tmp_path)
    made = varied(workspace, settings, MemoryCache(), alternatives=False)
    sites = coverage_of(made, workspace, settings).sites
    assert [(site.path, site.state) for site in sites if site.name.endswith("ublisher")] == [
        ("a/scripts/talker.py", "endpoint"),
        ("b/scripts/talker.py", "endpoint"),
    ]
