# SPDX-License-Identifier: Apache-2.0
"""Packages of plug-ins that the model shows nothing of."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.unmodelled import of_tests, unmodelled
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.index.index import Source
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.model.build import Build, PluginClass
from haros_ci.model.location import Location
from haros_ci.workspace.discover import discover

HERE = Location("plugins.xml", 1)
MANIFEST = "<package format='3'><name>{}</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>m</maintainer><license>MIT</license><export><build_type>{}</build_type></export></package>"


def build(package: str, base: str, name: str = "arm/Stiff", type_: str = "arm::Stiff") -> dict[str, Build]:
    return {
        package: Build(
            package=package,
            plugins=(PluginClass(name=name, type=type_, base=base, library="lib", package=package, location=HERE),),
        )
    }


def architecture(*nodes: Node) -> Architecture:
    return Architecture(configurations=(Configuration(name="all", nodes=nodes),))


def test_a_controller_that_no_node_loads_is_said() -> None:
    (said,) = unmodelled(architecture(), build("arm", "controller_interface::ControllerInterface"))
    assert said.startswith(
        "Not modelled: plug-ins of 1 package (arm: controller_interface::ControllerInterface). No node"
    )


def test_of_many_packages_five_are_named() -> None:
    builds: dict[str, Build] = {}
    for number in range(7):
        builds |= build(f"p{number}", "nav2_core::Controller")
    (said,) = unmodelled(architecture(), builds)
    assert "of 7 packages" in said and "p4: nav2_core::Controller; and 2 more)" in said and "p5" not in said


@pytest.mark.parametrize(
    ("builds", "nodes"),
    [
        ({}, ()),
        ({"arm": Build(package="arm")}, ()),
        (build("arm", "nodelet::Nodelet"), ()),
        (build("arm", "rclcpp_components::NodeFactory"), ()),
        (
            build("arm", "controller_interface::ControllerInterface"),
            (Node(name="/stiff", kind="node", package="arm", type="Stiff"),),
        ),
        (
            build("arm", "controller_interface::ControllerInterface"),
            (Node(name="/s", kind="node", package="arm", type="arm/Stiff"),),
        ),
        (
            build("arm", "nav2_core::Controller"),
            (Node(name="/s", kind="library", package="arm", type="x", class_name="arm::Stiff"),),
        ),
    ],
)
def test_nothing_is_said_where_nothing_is_missing(builds: dict[str, Build], nodes: tuple[Node, ...]) -> None:
    assert unmodelled(architecture(*nodes), builds) == ()


HERE_CPP = "arm/stiff.cpp"


def source(code: str) -> Source:
    return Source(HERE_CPP, "arm", read_cpp(code))


MAKING = 'namespace arm { class Stiff : public Base { void init() { nh_.advertise<Lamp>("lamp", 1); } }; }'
BELOW = (
    'namespace arm { struct Base { void init() { nh_.advertise<Lamp>("lamp", 1); } }; struct Stiff : public Base {}; }'
)


@pytest.mark.parametrize(
    ("code", "line", "expected"),
    [
        (MAKING, None, 1),
        (MAKING, 2, 1),  # an endpoint elsewhere
        (MAKING, 1, 0),
        (BELOW, None, 1),
        (BELOW, 1, 0),
        (MAKING.replace("advertise", "print"), None, 0),  # it makes nothing
        ("namespace arm { class Soft {}; }", None, 1),  # its code is not here
    ],
)
def test_what_the_model_has_of_a_plugin_is_not_missing(code: str, line: int | None, expected: int) -> None:
    place = Location(HERE_CPP, line, 1)
    end = Endpoint(kind="publishers", name="/lamp", original_name="/lamp", type="a/Lamp", location=place)
    nodes = (Node(name="/host", kind="node", package="host", type="host", endpoints=(end,) if line else ()),)
    assert len(unmodelled(architecture(*nodes), build("arm", "tools::Tool"), (source(code),))) == expected


def test_an_instance_of_a_template_is_known_by_the_class_that_it_is_for() -> None:
    builds = build("arm", "tools::Factory", type_="tools::Maker<arm::Stiff>")
    assert len(unmodelled(architecture(), builds, (source(MAKING),))) == 1
    assert unmodelled(architecture(), builds, (source(MAKING.replace("advertise", "print")),)) == ()


@pytest.mark.parametrize(
    ("package", "path", "kind", "is_named"),
    [
        ("tag_test", "launch/camera.launch.py", "ament_cmake", True),
        ("arm_tests", "launch/arm_launch.xml", "ament_cmake", True),
        ("arm", "launch/test_arm.launch.py", "ament_cmake", True),
        # Those of other names are configurations; nobody misses one in a directory of tests, or a file that launches nothing.
        ("arm", "launch/arm.launch.py", "ament_cmake", False),
        ("arm", "test/test_arm.launch.py", "ament_cmake", False),
        ("tag_test", "tests/camera.launch.py", "ament_cmake", False),
        ("tag_test", "scripts/camera.py", "ament_cmake", False),
        ("latest", "launch/latest.launch.py", "ament_cmake", False),
        ("tag_test", "launch/camera.launch.xml", "catkin", False),  # those of ROS 1 are configurations
    ],
)
def test_launch_files_that_are_named_as_tests(
    tmp_path: Path, package: str, path: str, kind: str, is_named: bool
) -> None:
    file = tmp_path / package / path
    file.parent.mkdir(parents=True)
    file.write_text("<launch/>" if path.endswith("xml") else "x = 1\n")
    (tmp_path / package / "package.xml").write_text(MANIFEST.format(package, kind))
    note = of_tests(discover(tmp_path, ()))
    assert [f"{package}/{path}" in line for line in note] == [True] * is_named


def test_of_many_launch_files_of_tests_five_are_named(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST.format("a_test", "ament_cmake"))
    for number in range(7):
        (tmp_path / "launch" / f"{number}.launch.py").write_text("x = 1\n")
    (note,) = of_tests(discover(tmp_path, ()))
    assert "launch/4.launch.py and 2 more" in note
