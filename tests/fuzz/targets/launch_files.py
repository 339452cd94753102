# SPDX-License-Identifier: Apache-2.0
"""Targets of launch files in every dialect, parameter files, robots, behaviour trees and policies."""

from __future__ import annotations

import json

from fuzz.targets.kit import ROOT, Entry, parts, ros_package, sound, text_of, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.bounded_yaml import YamlFault, YamlLimits
from haros_ci.bounded_yaml import data as yaml_data
from haros_ci.config.settings import Settings
from haros_ci.extract.launch.ros2_entity import compose, loaded
from haros_ci.extract.launch.xml import from_json, read_launch, to_json
from haros_ci.index.behavior_tree_files import trees_of
from haros_ci.launch.ros2.expression import expression_value
from haros_ci.launch.ros2.parameter_files import values_in
from haros_ci.launch.ros2.parameter_yaml import python_value, rcl_value, read_trees
from haros_ci.launch.ros2.refused_values import refused_value
from haros_ci.report.model_json import render as model_json
from haros_ci.robot.commands import xacro_command
from haros_ci.robot.descriptions import Descriptions
from haros_ci.security.policy import expanded, read_policy
from haros_ci.substitutions import presence as launch_presence
from haros_ci.substitutions.expression import ExpressionScopes, Undecided, Wrong, evaluate
from haros_ci.substitutions.names import literal, unknown
from haros_ci.substitutions.yaml import YamlError, read_yaml
from haros_ci.workspace.build import builds
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.xml import XmlError, parse_xml

CMAKE = b"cmake_minimum_required(VERSION 3.8)\nproject(bot)\ninstall(DIRECTORY launch config DESTINATION share/bot)\n"
PARAMETERS = b"/**:\n  ros__parameters:\n    a: 1\n    use_sim_time: true\n"


def _launched(data: bytes, default: str, ros: int) -> object:
    files = {"bot/package.xml": ros_package(ros=ros), "bot/CMakeLists.txt": CMAKE, "bot/config/p.yaml": PARAMETERS}
    files |= parts(data, default)
    found = architecture(workspace(files), Settings(root=ROOT), MemoryCache(), environment={"HOME": "/home/u"})
    sound(*found.problems)
    written = model_json(found)
    assert "\\ue000" not in written and "\ue000" not in written or b"\xee\x80\x80" in data or b"ue000" in data
    return written


def launch_xml(data: bytes) -> object:
    text = text_of(data, "launch")
    if text is None:
        return None
    launch = read_launch(text)
    stored = json.dumps(to_json(launch))
    again = from_json(json.loads(stored))
    assert again is not None and json.dumps(to_json(again)) == stored
    return launch


def roslaunch(data: bytes) -> object:
    return _launched(data, "bot/launch/main.launch", 1)


def ros2_xml(data: bytes) -> object:
    return _launched(data, "bot/launch/main.launch.xml", 2)


def ros2_yaml(data: bytes) -> object:
    return _launched(data, "bot/launch/main.launch.yaml", 2)


def ros2_python(data: bytes) -> object:
    return _launched(data, "bot/launch/main.launch.py", 2)


def parameter_yaml(data: bytes) -> object:
    """YAML as rosparam, rcl and launch load it."""
    text = text_of(data, "yaml")
    if text is None:
        return None
    found: list[object] = []
    try:
        found.append(read_yaml(literal(text)))
    except YamlError as err:
        assert err.line >= 1 and str(err)
        found.append(str(err))
    try:
        trees = read_trees(literal(text))
        found.append(trees)
        found += [(rcl_value(tree), python_value(tree)) for tree in trees if hasattr(tree, "is_plain")]
    except YamlFault as err:
        assert err.line >= 1 and str(err)
        found.append(str(err))
    refused = refused_value(text, "bot/p.yaml")
    assert refused is None or (1 <= refused.line <= len(text) + 1 and refused.problem)
    found.append(refused)
    try:
        found.append(compose(text) is None)
    except YamlFault as err:
        assert err.line >= 1 and str(err)
    try:
        yaml_data(text, YamlLimits())
    except YamlFault as err:
        assert err.line >= 1 and str(err)
    return found, loaded(text), values_in(text, "bot/p.yaml")


def expressions(data: bytes) -> object:
    text = data.decode("utf-8", "replace")
    try:
        of_roslaunch: object = evaluate(text, ExpressionScopes({}, unknown, {}, ""))
    except (Undecided, Wrong) as err:
        of_roslaunch = str(err)
    return xacro_command(text), launch_presence.compared_with(text), of_roslaunch, expression_value(literal(text))


def robots(data: bytes) -> object:
    files = {"bot/package.xml": ros_package(), "bot/CMakeLists.txt": CMAKE, **parts(data, "bot/urdf/a.urdf.xacro")}
    space = workspace(files)
    found = Descriptions(space, builds(space))
    made = tuple(found.of_files())
    sound(*found.problems)
    return made, found.problems


def behavior_trees(data: bytes) -> object:
    text = text_of(data, "xml")
    if text is None:
        return None
    launch = read_launch(text)
    if launch.root is None:
        return launch.problems
    trees = trees_of(launch.root)
    return trees, tuple(trees.of(name) for name in ("", "MainTree"))


def policies(data: bytes) -> object:
    files = parts(data, "bot/policy.xml")

    def element(path: str) -> object:
        try:
            return parse_xml(files[path]) if path in files else None
        except XmlError as err:
            assert err.line >= 1 and err.message
            return None

    found = read_policy("bot/policy.xml", element)  # type: ignore[arg-type]
    return found, expanded(data[:50].decode("utf-8", "replace"), "/a", "n")


_XML = (b"$(arg a)", b"$(find bot)", b"$(env X)", b"$(eval 1 + 1)", b"$(anon a)", b"$(dirname)", b'if="$(arg a)"')
_ROS2 = (b"$(var a)", b"$(find-pkg-share bot)", b"$(env X y)", b"$(eval '1 + 1')", b"$(command 'ls')", b"$(dirname)")
_XACRO = (
    b"${a}",
    b"${1 + 2}",
    b"$(arg a)",
    b"$(find bot)",
    b"xacro:macro",
    b"xacro:if",
    b"xacro:property",
    b"*origin",
    b"**b",
)

TARGETS = {
    "launch-xml": Entry(launch_xml, "tags of launch files in XML", ("extract.launch.xml",)),
    "roslaunch": Entry(
        roslaunch,
        "launch files of ROS 1, launched",
        ("launch.ros1", "launch.facts", "substitutions", "graph.words"),
        _XML,
    ),
    "ros2-launch-xml": Entry(ros2_xml, "launch files of ROS 2 in XML", ("extract.launch.ros2", "launch.ros2"), _ROS2),
    "ros2-launch-yaml": Entry(ros2_yaml, "launch files of ROS 2 in YAML", ("extract.launch.ros2_yaml",), _ROS2),
    "ros2-launch-python": Entry(ros2_python, "launch files of ROS 2 in Python", ("launch.python",)),
    "parameter-yaml": Entry(
        parameter_yaml,
        "parameter files",
        (
            "bounded_yaml",
            "substitutions.yaml",
            "launch.ros2.parameter_yaml",
            "launch.ros2.refused_values",
            "extract.launch.ros2_entity",
        ),
        (
            b"!!binary ",
            b"!degrees ",
            b"deg(1)",
            b"&a ",
            b"*a",
            b"<<: ",
            b"ros__parameters:",
            b"/**:",
            b"!!python/none ",
        ),
    ),
    "commands": Entry(
        expressions, "command lines and expressions of launch files", ("robot.commands", "bounded_python")
    ),
    "robots": Entry(robots, "xacro, URDF and SRDF", ("robot",), _XACRO),
    "behavior-trees": Entry(behavior_trees, "behaviour trees", ("index.behavior_tree_files",)),
    "policies": Entry(policies, "policies of SROS 2", ("security.policy",)),
}
