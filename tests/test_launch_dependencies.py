# SPDX-License-Identifier: Apache-2.0
"""undeclared-launch-dependency: one finding for a manifest and level, none for packages that a launch file can do without."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.optional import depends_on_package
from haros_ci.checking.page import Example
from haros_ci.model.location import Location
from haros_ci.registry import checks
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

PACKAGE = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>Apache-2.0</license>'
    "<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(demo)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"


def results(files: dict[str, str], tmp_path: Path) -> list[Result]:
    check = next(check for check in checks() if check.id == "undeclared-launch-dependency")
    install = CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)")
    return said(check, Example("", True, {"package.xml": PACKAGE, "CMakeLists.txt": install, **files}), tmp_path)


def nodes(*packages: str) -> str:
    return "<launch>\n" + "".join(f'  <node pkg="{name}" exec="n"/>\n' for name in packages) + "</launch>\n"


def test_one_finding_names_all_packages(tmp_path: Path) -> None:
    files = {
        "launch/a.launch.xml": nodes("turtlesim", "joy"),
        "launch/b.launch.xml": nodes("joy", "robot_localization"),
    }
    (result,) = results(files, tmp_path)
    assert result.message == (
        "launch files of demo use turtlesim, joy and robot_localization, but package.xml does not declare them: they fail on a machine without "
        "these packages; add <exec_depend>turtlesim</exec_depend>, <exec_depend>joy</exec_depend> and "
        "<exec_depend>robot_localization</exec_depend>"
    )
    assert result.subject == ("demo", "joy", "robot_localization", "turtlesim")
    assert [(str(each.location.path), each.message) for each in result.related] == [
        ("launch/a.launch.xml", "needs turtlesim"),
        ("launch/a.launch.xml", "needs joy"),
        ("launch/b.launch.xml", "needs joy"),
        ("launch/b.launch.xml", "needs robot_localization"),
    ]


def test_one_package(tmp_path: Path) -> None:
    (result,) = results({"launch/a.launch.xml": nodes("turtlesim")}, tmp_path)
    assert result.message == (
        "a launch file of demo uses turtlesim, but package.xml does not declare it: the launch fails on a machine without turtlesim; "
        "add <exec_depend>turtlesim</exec_depend>"
    )


def test_notes_are_apart(tmp_path: Path) -> None:
    found = results({"launch/a.launch.xml": nodes("turtlesim", "rqt_graph", "joy", "plotjuggler")}, tmp_path)
    assert sorted((result.level.value, result.subject) for result in found) == [
        ("note", ("demo", "plotjuggler", "rqt_graph")),
        ("warning", ("demo", "joy", "turtlesim")),
    ]


def test_a_package_that_the_setup_assistant_wrote(tmp_path: Path) -> None:
    files = {".setup_assistant": "moveit_setup_assistant_config:\n", "launch/a.launch.xml": nodes("joy", "turtlesim")}
    (result,) = results(files, tmp_path)
    assert result.level is Level.NOTE


def test_a_package_that_another_launch_file_asks_for(tmp_path: Path) -> None:
    asking = (
        "from ament_index_python.packages import get_packages_with_prefixes\nfrom launch import LaunchDescription\n"
        "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n    nodes = []\n"
        "    if 'joy' in get_packages_with_prefixes():\n        nodes.append(Node(package='joy', executable='joy_node'))\n"
        "    return LaunchDescription(nodes)\n"
    )
    assert results({"launch/a.launch.py": asking}, tmp_path) == ()
    (result,) = results({"launch/a.launch.py": asking, "launch/b.launch.xml": nodes("joy")}, tmp_path)
    assert result.level is Level.NOTE


def test_what_cannot_be_declared_closes_no_cycle(tmp_path: Path) -> None:
    """control cannot declare world, which needs it; so base can declare control, though a launch file of world uses base."""

    def package(name: str, needs: str, *used: str) -> dict[str, str]:
        install = CMAKE.replace("demo", name).format(f"install(DIRECTORY launch DESTINATION share/{name})")
        manifest = PACKAGE.replace("demo", name).replace("<export>", f"{needs}<export>")
        return {
            f"{name}/package.xml": manifest,
            f"{name}/CMakeLists.txt": install,
            f"{name}/launch/a.launch.xml": nodes(*used),
        }

    files = {
        **package("base", "", "control"),
        **package("control", "", "world"),
        **package("world", "<depend>control</depend>", "base"),
    }
    check = next(check for check in checks() if check.id == "undeclared-launch-dependency")
    found = said(check, Example("", True, files), tmp_path)
    assert sorted(result.subject for result in found) == [("base", "control"), ("base", "world")]


HEAD = "from ament_index_python.packages import *\n"
NAVIGATION = "get_package_share_directory('navigation')"


@pytest.mark.parametrize(
    "text",
    [
        "if 'navigation' in get_packages_with_prefixes():\n    HERE",
        "if 'navigation' in ament_index_python.get_packages_with_prefixes().keys():\n    HERE",
        "if 'navigation' not in get_packages_with_prefixes():\n    pass\nelse:\n    HERE",
        "there = get_packages_with_prefixes()\nhas = 'navigation' in there\nif has:\n    HERE",
        "def f():\n    if 'navigation' not in get_packages_with_prefixes():\n        return []\n    HERE",
        "def has(name):\n    return name in get_packages_with_prefixes()\nif has('navigation'):\n    HERE",
        f"try:\n    x = {NAVIGATION}\n    HERE\nexcept PackageNotFoundError:\n    x = None",
        f"try:\n    x = {NAVIGATION}\nexcept packages.PackageNotFoundError:\n    x = None\nif x is not None:\n    HERE",
        f"try:\n    x = {NAVIGATION}\nexcept (OSError, LookupError):\n    x = None\nif x:\n    HERE",
        f"try:\n    x = {NAVIGATION}\n    HERE\nexcept:\n    print('without navigation')",
        f"def has(name):\n    try:\n        {NAVIGATION}\n        return True\n    except PackageNotFoundError:\n        return False\n"
        "if has('navigation'):\n    HERE",
        "Node(\n  condition=IfCondition(str('navigation' in get_packages_with_prefixes())),\n  package=HERE)",
    ],
)
def test_what_goes_on_without_the_package(text: str) -> None:
    assert is_optional(HEAD + text)


@pytest.mark.parametrize(
    "text",
    [
        "HERE",
        "if 'navigation' in get_packages_with_prefixes():\n    pass\nHERE",
        "print(get_packages_with_prefixes())\nHERE",
        f"try:\n    x = {NAVIGATION}\n    HERE\nexcept PackageNotFoundError:\n    raise RuntimeError('install navigation')",
        f"try:\n    x = {NAVIGATION}\n    HERE\nexcept PackageNotFoundError:\n    print('install navigation')\n    sys.exit(1)",
        f"try:\n    x = {NAVIGATION}\n    HERE\nfinally:\n    print('done')",
        f"try:\n    x = {NAVIGATION}\n    HERE\nexcept OSError:\n    x = None",
        "try:\n    HERE\nexcept Exception:\n    pass",
        f"x = {NAVIGATION}\nif x:\n    HERE",
        "if 'navigation' in packages:\n    HERE",
        "if (:\n    HERE",
    ],
)
def test_what_does_not(text: str) -> None:
    assert not is_optional(HEAD + text)


def is_optional(text: str) -> bool:
    line = next(number for number, each in enumerate(text.split("\n"), 1) if "HERE" in each)
    return depends_on_package(text, Location("launch/a.launch.py", line))


DESCRIBED = """from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    model = PathJoinSubstitution([FindPackageShare("demo"), "urdf", "arm.xacro"])
    return LaunchDescription([
        Node(package="demo", executable="n", parameters=[{{"robot_description": Command({})}}]),
    ])
"""


@pytest.mark.parametrize(
    ("command", "names"),
    [
        ('["xacro ", model]', ["xacro"]),
        ('[FindExecutable(name="xacro"), " ", model]', ["xacro"]),
        ('[PathJoinSubstitution([FindExecutable(name="xacro")]), " ", model, " use_sim:=true"]', ["xacro"]),
        ('["ros2 run xacro xacro ", model]', ["xacro"]),
        ('["/opt/ros/humble/bin/xacro ", model]', ["xacro"]),
        ('["ros2 run joy describe ", model]', ["joy"]),
        ('["cat ", model]', []),
        ('["xacro2urdf ", model]', []),
        ('["echo xacro ", model]', []),
        ('["cat xacro"]', []),
        ('[LaunchConfiguration("tool"), " ", model]', []),
        ('["ros2 run ", LaunchConfiguration("package"), " tool ", model]', []),
        ('["ros2 topic list ", model]', []),
        ('["ros2 run demo tool"]', []),
        ('["python3 xacro.py"]', []),
    ],
)
def test_what_a_command_runs(command: str, names: list[str], tmp_path: Path) -> None:
    found = results({"launch/a.launch.py": DESCRIBED.format(command), "urdf/arm.xacro": "<robot name='a'/>"}, tmp_path)
    assert [result.subject[1:] for result in found] == [tuple(names)] * bool(names)


def test_what_a_command_of_xml_runs(tmp_path: Path) -> None:
    text = '<launch><node pkg="demo" exec="n"><param name="robot_description" value="$(command \'xacro a.xacro\')"/></node></launch>\n'
    (result,) = results({"launch/a.launch.xml": text}, tmp_path)
    assert result.subject == ("demo", "xacro")


def test_what_a_command_runs_is_declared(tmp_path: Path) -> None:
    package = PACKAGE.replace("<export>", "<exec_depend>xacro</exec_depend><export>")
    files = {"package.xml": package, "launch/a.launch.py": DESCRIBED.format('["xacro ", model]')}
    assert not results(files, tmp_path)


def test_packages_inside_a_package(tmp_path: Path) -> None:
    """colcon and catkin_make look for no package inside a package: what is there has a manifest of its own."""
    inner = {
        "models/arm/package.xml": PACKAGE.replace(">demo<", ">arm<"),
        "models/arm/launch/b.launch.xml": nodes("joy"),
    }
    assert not results({"launch/a.launch.xml": nodes("demo"), **inner}, tmp_path / "a")
    (result,) = results({"launch/a.launch.xml": nodes("turtlesim"), **inner}, tmp_path / "b")
    assert result.subject == ("demo", "turtlesim")
    (result,) = results({"launch/a.launch.xml": nodes("joy"), **inner}, tmp_path / "c")
    assert [each.location.path for each in result.related] == ["launch/a.launch.xml"]
    (result,) = results({"models/arm/launch/b.launch.xml": nodes("joy")}, tmp_path / "d")
    assert result.subject == ("demo", "joy")


def test_an_unread_argument_of_a_package_inside_a_package(tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "unused-launch-argument")
    launch = '<launch>\n  <arg name="rate" default="10"/>\n  <node pkg="demo" exec="n"/>\n</launch>\n'
    files = {
        "package.xml": PACKAGE,
        "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch models DESTINATION share/demo)"),
        "models/arm/package.xml": PACKAGE.replace(">demo<", ">arm<"),
        "models/arm/launch/a.launch.xml": launch,
        "launch/b.launch.xml": launch,
    }
    found = {one.location.path: one.level for one in said(check, Example("", True, files), tmp_path)}
    assert found == {"models/arm/launch/a.launch.xml": Level.NOTE, "launch/b.launch.xml": Level.WARNING}


def test_two_recorders(tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "duplicate-node-name")
    for number, (command, expected) in enumerate(
        (("ros2 bag record -o {} /scan", [Level.NOTE]), ("ros2 run turtlesim turtlesim_node {}", [Level.WARNING]))
    ):
        lines = "".join(f'  <executable cmd="{command.format(name)}"/>\n' for name in ("a", "b"))
        files = {
            "package.xml": PACKAGE,
            "CMakeLists.txt": CMAKE.format("install(DIRECTORY launch DESTINATION share/demo)"),
            "launch/a.launch.xml": f"<launch>\n{lines}</launch>\n",
        }
        found = said(check, Example("", True, files), tmp_path / str(number))
        assert [one.level for one in found] == expected
