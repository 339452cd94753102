# SPDX-License-Identifier: Apache-2.0
"""The environment variables that launch files see: environment hooks, files of the project file, and what is said of them."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.environment import NOTHING, Environment, key_of
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

CATKIN = "<package><name>arm</name><buildtool_depend>catkin</buildtool_depend></package>"
AMENT = '<package format="3"><name>arm</name><export><build_type>ament_cmake</build_type></export></package>'
ROS1 = '<launch><node name="$(env ARM_NAME)" pkg="joy" type="joy_node"/></launch>'
ROS2 = '<launch><node name="$(env ARM_NAME)" pkg="joy" exec="joy_node"/></launch>'
PYTHON = """
import os
from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package='joy', executable='joy_node', name=os.environ['ARM_NAME'])])
"""


def model(
    root: Path, files: Mapping[str, str], project: Mapping[str, Any] | None = None, **env: str
) -> tuple[list[str], list[str]]:
    """The names of the nodes, and the problems."""
    for path, text in files.items():
        (root / "arm" / path).parent.mkdir(parents=True, exist_ok=True)
        (root / "arm" / path).write_text(text, encoding="utf-8")
    settings = Settings(root=root, project=dict(project or {}))
    found: Architecture = architecture(discover(root, ()), settings, MemoryCache(), environment=env)
    names = [node.name for each in found.configurations for node in each.nodes]
    return names, [problem.message for problem in found.problems]


def catkin(hook: str, name: str = "10.arm.sh", launch: str = ROS1, more: str = "") -> dict[str, str]:
    cmake = (
        f"project(arm)\n{more}catkin_add_env_hooks(10.arm SHELLS sh DIRECTORY ${{CMAKE_CURRENT_SOURCE_DIR}}/hooks)\n"
    )
    return {"package.xml": CATKIN, "CMakeLists.txt": cmake, f"hooks/{name}": hook, "launch/a.launch": launch}


def ament(hook: str, name: str, launch: str = ROS2, path: str = "launch/a.launch.xml") -> dict[str, str]:
    cmake = (
        f'project(arm)\nfind_package(ament_cmake REQUIRED)\nament_environment_hooks("hooks/{name}")\nament_package()\n'
    )
    return {"package.xml": AMENT, "CMakeLists.txt": cmake, f"hooks/{name}": hook, path: launch}


def test_without_a_hook_it_is_not_known(tmp_path: Path) -> None:
    assert model(tmp_path, {"package.xml": CATKIN, "launch/a.launch": ROS1})[0] == ["/?"]


@pytest.mark.parametrize(
    ("files"),
    [
        catkin("export ARM_NAME=left"),
        catkin(": ${ARM_NAME:=left}\nexport ARM_NAME", "10.arm.sh.em"),
        catkin("@[if DEVELSPACE]\nexport OTHER=1\n@[end if]\nexport ARM_NAME=left  # me@@home", "10.arm.sh.em"),
        catkin('if [ -z "$ARM_NAME" ]; then export ARM_NAME=left; fi', "10.arm.sh.in"),
        catkin("export ARM_NAME=left", launch=ROS1.replace("$(env ARM_NAME)", "$(optenv ARM_NAME right)")),
        catkin("export ARM_NAME=left", launch=ROS1.replace("$(env ARM_NAME)", "$(eval optenv('ARM_NAME', 'right'))")),
        ament("export ARM_NAME=left", "arm.sh"),
        ament("export ARM_NAME=left", "arm.sh.in"),
        ament("set;ARM_NAME;left\n", "arm.dsv"),
        ament("set-if-unset;ARM_NAME;left\n", "arm.dsv.in"),
        ament("export ARM_NAME=left", "arm.sh", PYTHON, "launch/a.launch.py"),
        ament(
            "export ARM_NAME=left",
            "arm.sh",
            PYTHON.replace("environ['ARM_NAME']", "getenv('ARM_NAME', 'right')"),
            "launch/a.launch.py",
        ),
        ament(
            "export ARM_NAME=@PROJECT_NAME@", "arm.sh.in", ROS2.replace("$(env ARM_NAME)", "left_of_$(env ARM_NAME)")
        ),
        ament("export ARM_NAME=left", "arm.sh", ROS2.replace("ARM_NAME)", "ARM_NAME right)")),
    ],
)
def test_hooks_give_values(tmp_path: Path, files: dict[str, str]) -> None:
    names, problems = model(tmp_path, files)
    assert names in (["/left"], ["/left_of_arm"])
    assert not [each for each in problems if "ARM_NAME" in each]


@pytest.mark.parametrize(
    "files",
    [
        catkin("export ARM_NAME=$(hostname)"),
        catkin("export ARM_NAME=@(ROBOT)", "10.arm.sh.em"),
        catkin("@[if DEVELSPACE]\nexport ARM_NAME=left\n@[else]\nexport ARM_NAME=right\n@[end if]\n", "10.arm.sh.em"),
        catkin("export ARM_NAME=left", "11.other.sh"),
        catkin("ARM_NAME=left"),
        {**catkin("export ARM_NAME=left"), "CMakeLists.txt": "project(arm)\n"},
        catkin("export ARM_NAME=$(hostname)", launch=ROS1.replace("$(env ARM_NAME)", "$(optenv ARM_NAME right)")),
        {
            **catkin("export ARM_NAME=left"),
            "hooks/20.arm.sh": "export ARM_NAME=right",
            "CMakeLists.txt": "project(arm)\n"
            + "".join(
                f"catkin_add_env_hooks({n}.arm SHELLS sh DIRECTORY ${{CMAKE_CURRENT_SOURCE_DIR}}/hooks)\n"
                for n in (10, 20)
            ),
        },
        {
            **catkin("export ARM_NAME=left"),
            "CMakeLists.txt": "project(arm)\nif(HAVE_ARM)\n"
            "catkin_add_env_hooks(10.arm SHELLS sh DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/hooks)\nendif()\n",
        },
        {
            **catkin("export SIDE=left"),
            "hooks/20.arm.sh": "export ARM_NAME=$SIDE",
            "CMakeLists.txt": "project(arm)\nif(HAVE_ARM)\n"
            "catkin_add_env_hooks(10.arm SHELLS sh DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/hooks)\nendif()\n"
            "catkin_add_env_hooks(20.arm SHELLS sh DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/hooks)\n",
        },
        ament("export ARM_NAME=@CMAKE_INSTALL_PREFIX@/x", "arm.sh.in"),
        ament("set;ARM_NAME;share/arm\n", "arm.dsv"),
        ament("prepend-non-duplicate;ARM_NAME;share\n", "arm.dsv"),
        ament("export ARM_NAME=$(hostname)", "arm.sh", ROS2.replace("ARM_NAME)", "ARM_NAME right)")),
        ament("export ARM_NAME=$(hostname)", "arm.sh", PYTHON, "launch/a.launch.py"),
    ],
)
def test_what_cannot_be_read_gives_nothing(tmp_path: Path, files: dict[str, str]) -> None:
    assert model(tmp_path, files)[0] == ["/?"]


def test_hooks_that_agree_are_one_value(tmp_path: Path) -> None:
    files = ament(": ${ARM_NAME:=left}; export ARM_NAME", "arm.sh")
    files["hooks/arm.dsv"] = "set-if-unset;ARM_NAME;left\n"
    files["CMakeLists.txt"] = files["CMakeLists.txt"].replace('arm.sh"', 'arm.sh" hooks/arm.dsv')
    assert model(tmp_path, files)[0] == ["/left"]


def many(scripts: list[str]) -> dict[str, str]:
    """A package with a hook for each of *scripts*."""
    files = {f"hooks/h{number}.sh": script for number, script in enumerate(scripts)}
    commands = "".join(f'ament_environment_hooks("{path}")\n' for path in files)
    cmake = f"project(arm)\nfind_package(ament_cmake REQUIRED)\n{commands}ament_package()\n"
    return {"package.xml": AMENT, "CMakeLists.txt": cmake, "launch/a.launch.xml": ROS2, **files}


def test_hooks_with_many_variables_lose_none(tmp_path: Path) -> None:
    scripts = ["".join(f"export A{hook}_{number}=1\n" for number in range(300)) for hook in range(3)]
    assert model(tmp_path, many([*scripts, "export ARM_NAME=left"]))[0] == ["/left"]


@pytest.mark.parametrize(
    ("others", "expected"),
    [
        (["export SIDE=left"], "/left"),
        (["export SIDE=left", "export SIDE=left"], "/left"),
        (["export SIDE=left", "export SIDE=right"], "/?"),
        (["export SIDE=left", "export SIDE=$(ls)"], "/?"),
        (["export SIDE=right"], "/?"),
        (["export ARM_NAME=${ARM_NAME:-left}"], "/left"),
    ],
)
def test_a_hook_sees_what_the_others_set(tmp_path: Path, others: list[str], expected: str) -> None:
    assert model(tmp_path, many(["export ARM_NAME=${SIDE:-left}", *others]))[0] == [expected]


def test_hostile_hooks_are_cheap(tmp_path: Path) -> None:
    scripts = ["(\n" + " ".join(f"a{hook}_{number}=" for number in range(6_000)) for hook in range(15)]
    start = time.process_time()
    model(tmp_path, many(scripts))
    assert time.process_time() - start < 4


@pytest.mark.parametrize(
    "files", [catkin("export ARM_NAME=left"), ament("export ARM_NAME=left", "arm.sh", PYTHON, "launch/a.launch.py")]
)
def test_the_project_file_and_the_command_line_come_first(tmp_path: Path, files: dict[str, str]) -> None:
    launch = next(path for path in files if path.startswith("launch/"))
    project = {"configurations": {"x": {"launch": [f"arm/{launch}"], "environment": {"ARM_NAME": "middle"}}}}
    assert model(tmp_path, files, project)[0] == ["/middle"]
    assert model(tmp_path, files, project, ARM_NAME="right")[0] == ["/right"]
    assert model(tmp_path, files, ARM_NAME="right")[0] == ["/right"]
    both = {"configurations": {**project["configurations"], "y": [f"arm/{launch}"]}}
    assert model(tmp_path, files, both)[0] == ["/middle", "/left"]


def test_an_include_that_a_variable_names_is_followed_and_is_no_entry(tmp_path: Path) -> None:
    files = catkin(
        "export ARM_KIND=big",
        launch='<launch><include file="$(find arm)/launch/parts/$(env ARM_KIND).launch"/></launch>',
    )
    files["launch/parts/big.launch"] = ROS1.replace("$(env ARM_NAME)", "big")
    names, problems = model(tmp_path, files)
    assert names == ["/big"] and not problems


def test_files_of_the_project_file(tmp_path: Path) -> None:
    files = {
        **catkin("export ARM_NAME=left"),
        "config/site.env": "ARM_NAME=middle\n",
        ".env.lab": "ARM_NAME=lab\n",
        "site.sh": ": ${ARM_NAME:=script}\nexport ARM_NAME\n",
    }
    lab = {"launch": ["arm/launch/a.launch"], "environment_files": ["arm/.env.lab"]}
    assert model(tmp_path, files, {"environment_files": ["arm/config/site.env"]})[0] == ["/middle"]
    assert model(tmp_path, files, {"environment_files": ["arm/config/site.env", "arm/site.sh"]})[0] == ["/middle"]
    assert model(tmp_path, files, {"environment_files": ["arm/site.sh"]})[0] == ["/script"]
    assert model(tmp_path, files, {"configurations": {"x": lab}})[0] == ["/lab"]
    assert model(tmp_path, files, {"configurations": {"x": {**lab, "environment": {"ARM_NAME": "own"}}}})[0] == ["/own"]
    assert model(tmp_path, files, {"configurations": {"x": lab}}, ARM_NAME="asked")[0] == ["/asked"]
    doubt = {**files, "a.env": "ARM_NAME=$UNSET\nSIDE=left\n", "b.env": "ARM_NAME=$SIDE\n"}
    assert model(tmp_path, doubt, {"environment_files": ["arm/a.env", "arm/b.env"]})[0] == ["/left"]
    assert model(tmp_path, doubt, {"environment_files": ["arm/b.env", "arm/a.env"]})[0] == ["/?"]
    names, problems = model(tmp_path, files, {"environment_files": ["arm/none.env"]})
    assert names == ["/left"] and any("no file arm/none.env" in each for each in problems)


def test_a_lost_variable_alone_is_an_environment() -> None:
    lost = Environment({}, {"A": "why"})
    assert lost and not NOTHING
    assert Environment({"A": "1", "B": "2"}).over(lost) == Environment({"B": "2"}, {"A": "why"})
    assert lost.over({"A": "3"}, None, {}) == Environment({"A": "3"})


def test_environments_with_another_outcome_have_another_key() -> None:
    given = Environment({"A": "1"})
    others = [
        Environment(),
        Environment({"A": "2"}),
        Environment({}, {"A": "1"}),
        replace(given, chosen=frozenset("A")),
    ]
    assert len({each.key for each in (given, *others)}) == 5
    assert given.key == key_of({"A": "1"})


ENV_INCLUDE = '<launch><include file="$(env ARM_FILE)"/></launch>'
ENV_PYTHON = PYTHON.replace(
    "LaunchDescription([Node(package='joy', executable='joy_node', name=os.environ['ARM_NAME'])])",
    ("LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(os.environ['ARM_FILE']))])"),
).replace(
    "from launch import LaunchDescription",
    (
        "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
        "from launch.launch_description_sources import AnyLaunchDescriptionSource"
    ),
)


@pytest.mark.parametrize(
    ("hook", "name"),
    [
        ("set;ARM_FILE;share/arm/launch/b.launch.xml\n", "arm.dsv"),
        ("set;ARM_FILE;share/@PROJECT_NAME@/launch/b.launch.xml\n", "arm.dsv.in"),
        ("export ARM_FILE=$AMENT_CURRENT_PREFIX/share/arm/launch/b.launch.xml\n", "arm.sh"),
        ('ARM_FILE="${AMENT_CURRENT_PREFIX}/share/@PROJECT_NAME@/launch/b.launch.xml"\nexport ARM_FILE\n', "arm.sh.in"),
    ],
)
@pytest.mark.parametrize(("launch", "path"), [(ENV_INCLUDE, "launch/a.launch.xml"), (ENV_PYTHON, "launch/a.launch.py")])
def test_paths_of_packages_below_the_install_prefix(
    tmp_path: Path, hook: str, name: str, launch: str, path: str
) -> None:
    files = ament(hook, name, launch, path)
    files["CMakeLists.txt"] = files["CMakeLists.txt"].replace(
        "ament_package", "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package"
    )
    files["launch/b.launch.xml"] = '<launch><node name="grip" pkg="joy" exec="joy_node"/></launch>'
    assert model(tmp_path, files) == (["/grip"], [])


@pytest.mark.parametrize(
    ("hook", "name"),
    [
        ("set;ARM_NAME;share/arm/../x\n", "arm.dsv"),
        ("set;ARM_NAME;lib/arm/x\n", "arm.dsv"),
        ("export ARM_NAME=$AMENT_CURRENT_PREFIX/lib/arm\n", "arm.sh"),
        ("export ARM_NAME=$AMENT_CURRENT_PREFIX/share/arm/a:$AMENT_CURRENT_PREFIX/share/arm/b\n", "arm.sh"),
        ("export ARM_NAME=x:$AMENT_CURRENT_PREFIX/share/arm\n", "arm.sh"),
        ("export ARM_NAME=$AMENT_CURRENT_PREFIX\n", "arm.sh"),
    ],
)
def test_other_paths_below_the_install_prefix_are_not_known(tmp_path: Path, hook: str, name: str) -> None:
    assert model(tmp_path, ament(hook, name))[0] in ([], ["/?"])
