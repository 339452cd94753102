# SPDX-License-Identifier: Apache-2.0
"""What one line of a xacro macro makes in several calls is one finding; how the limits of a joint that follows another one are mended."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

HEAD = '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
PART = (
    '<xacro:macro name="part" params="name">\n<link name="${name}"><visual><geometry>\n'
    '<mesh filename="package://demo/meshes/${name}.dae"/>\n</geometry></visual></link>\n</xacro:macro>\n'
)


PACKAGE = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>An example.</description>'
    '<maintainer email="a@example.org">A</maintainer><license>MIT</license></package>\n'
)


def results(check_id: str, files: dict[str, str], tmp_path: Path) -> list[Result]:
    check = next(check for check in checks() if check.id == check_id)
    return list(said(check, Example("", True, {"package.xml": PACKAGE, **files}), tmp_path))


@pytest.mark.parametrize("count", [1, 2, 6])
def test_meshes(count: int, tmp_path: Path) -> None:
    calls = "".join(f'<xacro:part name="left_{number}"/>\n' for number in range(count))
    files = {"urdf/robot.urdf.xacro": f"{HEAD}{PART}{calls}</robot>\n", "meshes/base.dae": "<COLLADA/>\n"}
    (result,) = results("mesh-not-loaded", files, tmp_path)
    assert result.location.line == 4
    assert ("by other calls of this macro" in result.message) == (count > 1)
    assert ("2 more" in result.message) == (count == 6)
    assert [place.location.line for place in result.related] == [*range(8, 7 + count)]


def test_one_mesh_in_two_robots(tmp_path: Path) -> None:
    files = {
        "urdf/part.xacro": f"{HEAD}{PART}</robot>\n",
        "meshes/base.dae": "<COLLADA/>\n",
        **{
            f"urdf/{name}.urdf.xacro": f'{HEAD}<xacro:include filename="part.xacro"/>\n<xacro:part name="{name}"/>\n</robot>\n'
            for name in ("left", "right")
        },
    }
    (result,) = results("mesh-not-loaded", files, tmp_path)
    assert "meshes/left.dae does not exist" in result.message and "meshes/right.dae, by other" in result.message


@pytest.mark.parametrize(
    ("mimic", "expected"),
    [
        ("", "swap the two values"),
        ('<mimic joint="left"/>', "swap the two values"),
        ('<mimic joint="left" multiplier="2"/>', "swap the two values"),
        ('<mimic joint="left" multiplier="-1"/>', 'times -1: write lower="-0.4" upper="0"'),
        ('<mimic joint="left" multiplier="-2" offset="0.1"/>', 'times -2: write lower="-0.7" upper="0.1"'),
        ('<mimic joint="other" multiplier="-1"/>', "write the range of other times -1, the smaller value first"),
        ('<mimic joint="left" multiplier="minus"/>', "the joint mimics left: write the range that this gives it"),
    ],
)
def test_limits_of_a_joint_that_follows(mimic: str, expected: str, tmp_path: Path) -> None:
    joint = '<joint name="{}" type="revolute"><parent link="palm"/><child link="{}"/>{}<limit lower="{}" upper="{}" effort="1" velocity="1"/></joint>\n'
    left, right = joint.format("left", "l", "", "0", "0.4"), joint.format("right", "r", mimic, "0.4", "0")
    text = f'<robot name="hand"><link name="palm"/><link name="l"/><link name="r"/>\n{left}{right}</robot>\n'
    (result,) = results("broken-robot-model", {"urdf/hand.urdf": text}, tmp_path)
    assert result.level is Level.WARNING and expected in result.message


def test_limits_of_a_macro(tmp_path: Path) -> None:
    macro = (
        '<xacro:macro name="finger" params="name">\n<link name="${name}"/>\n'
        '<joint name="${name}_joint" type="prismatic"><parent link="palm"/><child link="${name}"/>\n'
        '<limit lower="0.1" upper="-0.1" effort="1" velocity="1"/>\n</joint>\n</xacro:macro>\n'
    )
    text = f'{HEAD}<link name="palm"/>\n{macro}<xacro:finger name="a"/>\n<xacro:finger name="b"/>\n</robot>\n'
    (result,) = results("broken-robot-model", {"urdf/hand.urdf.xacro": text}, tmp_path)
    assert "; the same is true of joint b_joint, by other calls" in result.message


def test_a_file_that_a_macro_includes(tmp_path: Path) -> None:
    macro = '<xacro:macro name="part" params="name">\n<xacro:include filename="$(find demo)/urdf/${name}.xacro"/>\n</xacro:macro>\n'
    calls = '<xacro:part name="arm"/>\n<xacro:part name="hand"/>\n'
    launch = '<launch><param name="robot_description" command="xacro $(find demo)/urdf/a.urdf.xacro"/></launch>\n'
    files = {"urdf/a.urdf.xacro": f'{HEAD}{macro}{calls}<link name="l"/>\n</robot>\n', "launch/a.launch": launch}
    found = results("undefined-in-xacro", files, tmp_path)
    assert len(found) == 1 and "the same is true of" in found[0].message and "hand.xacro" in found[0].message


def test_two_names_in_one_line_are_two_findings(tmp_path: Path) -> None:
    text = f'{HEAD}<xacro:macro name="part" params="n">\n<link name="${{a}}${{n}}"/><link name="${{b}}${{n}}"/>\n</xacro:macro>\n'
    text += '<xacro:part n="1"/>\n<xacro:part n="2"/>\n<link name="c"/><joint name="j"/>\n</robot>\n'
    launch = '<launch><param name="robot_description" command="xacro $(find demo)/urdf/a.urdf.xacro"/></launch>\n'
    found = results("undefined-in-xacro", {"urdf/a.urdf.xacro": text, "launch/a.launch": launch}, tmp_path)
    assert len(found) == 2 and not any("the same is true" in each.message for each in found)
