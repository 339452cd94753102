# SPDX-License-Identifier: Apache-2.0
"""Whole xacro files expanded: what comes out of each construct, which faults are certain, and that hostile files end."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.model.environment import Environment
from haros_ci.model.robot import Robot
from haros_ci.robot.expand import GIVEN_UP, expand
from haros_ci.robot.sources import DescriptionSources, by_names
from haros_ci.robot.unknown import UNKNOWN
from haros_ci.robot.urdf import read_robot
from haros_ci.workspace.discover import discover

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
MANIFEST = "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description><maintainer email='a@b.c'>a</maintainer><license>x</license></package>"


def read(root: Path, body: str, *, legacy: bool = False, given: dict[str, object] | None = None, **files: str) -> Robot:
    (root / "package.xml").write_text(MANIFEST)
    (root / "r.xacro").write_text(f"{HEAD}\n{body}\n</robot>")
    for name, text in files.items():
        (root / name.replace("__", ".")).write_text(text)
    workspace = discover(root, (".",))
    robot = read_robot(DescriptionSources(workspace, by_names(workspace)), "r.xacro", given, legacy=legacy)  # type: ignore[arg-type]
    assert robot is not None
    return robot


def links(robot: Robot) -> list[str | None]:
    return [link.name for link in robot.links]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("<xacro:property name='a' value='x'/><link name='${a}'/>", ["x"]),
        ("<xacro:property name='a' value='${b}_1'/><xacro:property name='b' value='x'/><link name='${a}'/>", ["x_1"]),
        ("<xacro:property name='a' value='x'/><xacro:property name='a' default='y'/><link name='${a}'/>", ["x"]),
        ("<xacro:property name='a' default='y'/><link name='${a}'/>", ["y"]),
        ("<xacro:property name='b'><link name='x'/></xacro:property><xacro:insert_block name='b'/>", ["x"]),
        ("<xacro:arg name='a' default='x'/><link name='$(arg a)'/>", ["x"]),
        ("<link name='$(optenv NOBODY_SETS_IT x)'/>", ["x"]),
        ("<xacro:if value='${1 == 1}'><link name='x'/></xacro:if><xacro:unless value='true'><link name='y'/></xacro:unless>", ["x"]),
        ("<xacro:macro name='m' params='a b:=2'><link name='${a}${b}'/></xacro:macro><xacro:m a='x'/>", ["x2"]),
        ("<xacro:property name='p' value='x'/><xacro:macro name='m' params='p:=^'><link name='${p}'/></xacro:macro><xacro:m/>", ["x"]),
        ("<xacro:macro name='m' params='p:=^|y'><link name='${p}'/></xacro:macro><xacro:m/>", ["y"]),
        ("<xacro:macro name='m' params='*b'><xacro:insert_block name='b'/></xacro:macro><xacro:m><link name='x'/></xacro:m>", ["x"]),
        ("<xacro:macro name='m' params='**b'><xacro:insert_block name='b'/></xacro:macro><xacro:m><b><link name='x'/><link name='y'/></b></xacro:m>", ["x", "y"]),
        ("<xacro:macro name='m' params=''><xacro:property name='p' value='x' scope='parent'/></xacro:macro><xacro:m/><link name='${p}'/>", ["x"]),
        ("<xacro:macro name='m' params='n'><link name='${n}'/><xacro:if value='${n}'><xacro:m n='${n - 1}'/></xacro:if></xacro:macro><xacro:m n='2'/>", ["2", "1", "0"]),
        ("<xacro:macro name='m' params=''><link name='x'/></xacro:macro><xacro:property name='w' value='m'/><xacro:call macro='${w}'/>", ["x"]),
        ("<xacro:element xacro:name='${&quot;li&quot; + &quot;nk&quot;}' name='x'/>", ["x"]),
        ("<link><xacro:attribute name='name' value='x'/></link>", ["x"]),
        ("<!-- ${nothing} --><link name='x'/>", ["x"]),
        ("<xacro:include filename='inc.xacro'/><link name='${from_there}'/>", ["i", "x"]),
        ("<xacro:include filename='$(find demo)/inc.xacro' ns='n'/><link name='${n.from_there}'/><xacro:n.m/>", ["i", "x", "m"]),
        ("<xacro:include filename='in*.xacro'/>", ["i"]),
        ("<xacro:include filename='nowhere.xacro' optional='true'/><link name='x'/>", ["x"]),
        ("<xacro:property name='y' value=\"${xacro.load_yaml('y.yaml')}\"/><link name='${y.a[1].b}'/>", ["x"]),
        ("<link name='$${a}'/>", ["${a}"]),
        ("<xacro:property name='n' value='007'/><link name='a${n}'/>", ["a7"]),
        ("<xacro:property name='n' value='1e3'/><link name='a${n}'/>", ["a1000.0"]),
    ],
)  # fmt: skip
def test_what_comes_out(tmp_path: Path, body: str, expected: list[str]) -> None:
    robot = read(
        tmp_path,
        body,
        inc__xacro=f"{HEAD}<xacro:property name='from_there' value='x'/><xacro:macro name='m'><link name='m'/></xacro:macro><link name='i'/></robot>",
        y__yaml="a: [1, {b: x}]",
    )
    assert links(robot) == expected
    assert not [fault for fault in robot.faults if fault.certain]


@pytest.mark.parametrize(
    ("body", "kind", "name"),
    [
        ("<link name='${a}'/>", "property", "a"),
        ("<link name='$(arg a)'/>", "argument", "a"),
        ("<xacro:m/>", "macro", "m"),
        ("<xacro:insert_block name='b'/>", "block", "b"),
        ("<xacro:arg name='a'/>", "default", "a"),
        ("<xacro:macro name='m' params='a b'/><xacro:m b='1'/>", "parameter", "a"),
        ("<xacro:macro name='m' params='*b'/><xacro:m/>", "parameter", "*b"),
        ("<xacro:macro name='m' params='a'/><xacro:m a='1' c='1'/>", "extra", "c"),
        ("<xacro:macro name='m' params='a:=^'/><xacro:m/>", "property", "a"),
        ("<xacro:macro name='m' params='a'><link name='${a}'/></xacro:macro><m a='x'/>", "unprefixed", "m"),
        ("<link name='x'>${text}</link>", "property", "text"),
        ("<xacro:macro name='m' params='a'><link name='${q}'/></xacro:macro><xacro:m a='1'/>", "property", "q"),
        (
            "<xacro:macro name='m'><xacro:property name='p' value='1'/></xacro:macro><xacro:m/><link name='${p}'/>",
            "property",
            "p",
        ),
    ],
)
def test_what_is_wrong(tmp_path: Path, body: str, kind: str, name: str) -> None:
    found = [(fault.kind, fault.name) for fault in read(tmp_path, body).faults if fault.certain]
    assert found == [(kind, name)]


LOOP = (
    "<xacro:macro name='m' params='l:=^'><xacro:if value='${l}'><xacro:property name='i' value='${l.pop(0)}'/><link name='${i}'/>"
    "<xacro:m/></xacro:if></xacro:macro>"
)
PASSED = LOOP.replace("<xacro:m/>", "<xacro:m l='${l}'/>")
CASES = "<xacro:property name='y' value=\"${xacro.load_yaml('y.yaml')}\"/>"
ABC = "<xacro:property name='l' value=\"${['a', 'b', 'c']}\"/>"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (LOOP + "<xacro:m l=\"${['a', 'b']}\"/>", ["a", "b"]),
        (PASSED + "<xacro:m l=\"${['a', 'b']}\"/>", ["a", "b"]),
        (LOOP.replace("pop(0)", "pop()") + "<xacro:m l=\"${['a', 'b']}\"/>", ["b", "a"]),
        (LOOP + "<xacro:m l='${[]}'/><link name='x'/>", ["x"]),
        (LOOP + ABC + "<xacro:m/><xacro:m/><link name='${len(l)}'/>", ["a", "b", "c", "0"]),
        (LOOP + ABC + "<xacro:m l='${list(l)}'/><link name='${len(l)}'/>", ["a", "b", "c", "3"]),
        (LOOP + "<xacro:macro name='o' params='l'><xacro:m/></xacro:macro><xacro:o l=\"${['a', 'b']}\"/>", ["a", "b"]),
        (LOOP + CASES + "<xacro:m l='${y.c}'/><link name='${len(y.c)}'/>", ["u", "v", "0"]),
        (LOOP + CASES + CASES.replace("'y'", "'z'", 1) + "<xacro:m l='${y.c}'/><link name='${len(z.c)}'/>", ["u", "v", "2"]),
        (ABC + "<xacro:property name='i' value='${l.pop(0)}'/><link name='${l[0]}'/><link name='${i}${i}'/><link name='${l[0]}'/>", ["a", "aa", "b"]),
        (ABC + "<link name='${l.append(1)}${len(l)}'/><link name='${l.remove(1)}${l.reverse()}${l[0]}'/>", ["None4", "NoneNonec"]),
        (ABC + "<link name=\"${l.insert(0, 'x')}\"/><link name=\"${l.extend(['y'])}${l[0]}${l[-1]}\"/><link name='${l.clear()}${l}'/>", ["None", "Nonexy", "None[]"]),
    ],
)  # fmt: skip
def test_lists_that_are_changed(tmp_path: Path, body: str, expected: list[str]) -> None:
    robot = read(tmp_path, body, y__yaml="c: [u, v]")
    assert links(robot) == expected
    assert not robot.faults


@pytest.mark.parametrize(
    ("body", "known"),
    [
        # what an unknown condition changes may be changed or not
        (ABC + "<xacro:if value='$(env A)'><link name='${l.pop(0)}'/></xacro:if><link name='${l[0]}'/>", []),
        (ABC + "<xacro:if value='$(env A)'><link name='${l.clear()}'/></xacro:if><link name='${l.pop()}'/><link name='${l[7]}'/>", []),
        (CASES + "<xacro:if value='$(env A)'><link name='${y.c.pop()}'/></xacro:if><link name='${y.c[1]}'/>", []),
        (LOOP + ABC + "<xacro:if value='$(env A)'><xacro:m/></xacro:if><link name='${l[0]}'/>", []),
        # inside of it everything is as it is
        (LOOP + "<xacro:if value='$(env A)'><xacro:m l=\"${['a', 'b']}\"/></xacro:if>", ["a", "b"]),
        (LOOP + "<xacro:macro name='o' params='l'><xacro:m/></xacro:macro><xacro:if value='$(env A)'><xacro:o l=\"${['a']}\"/></xacro:if>", ["a"]),
        # what is added is not known, or may hold the list itself
        (ABC + "<xacro:property name='q' value='$(env A)'/><link name='${l.append(q)}'/><link name='${l[0]}'/>", []),
        (ABC + "<link name='${l.append(l)}'/><link name='${l[0]}'/>", []),
        (ABC + "<link name='${l.sort()}'/><link name='x'/>", ["x"]),
        # nobody knows how often it goes on
        (LOOP + "<xacro:m l='$(env A)'/><link name='x'/>", ["x"]),
        (LOOP + "<xacro:m l='${A.b}'/><xacro:include filename='$(env A)'/><link name='x'/>", ["x"]),
    ],
)  # fmt: skip
def test_lists_that_may_be_changed(tmp_path: Path, body: str, known: list[str]) -> None:
    robot = read(tmp_path, body, y__yaml="c: [u, v]")
    assert [name for name in links(robot) if name is not None] == known
    assert not [fault for fault in robot.faults if fault.certain and fault.kind != "property"]


def test_a_recursion_that_is_not_known_is_no_endless_one(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST)
    texts = {
        "open": LOOP + "<xacro:m l='$(env A)'/><link name='x'/>",
        "both": "<xacro:macro name='m'><xacro:if value='$(env A)'><xacro:m/><xacro:m/></xacro:if></xacro:macro><xacro:m/>",
        "endless": LOOP.replace(".pop", ".count") + "<xacro:m l='${[1]}'/>",
        "ends": LOOP + "<xacro:m l='${[1]}'/>",
    }
    said = {}
    for name, text in texts.items():
        (tmp_path / f"{name}.xacro").write_text(f"{HEAD}{text}</robot>")
        workspace = discover(tmp_path, (".",))
        sources = DescriptionSources(workspace, by_names(workspace))
        expand(sources, f"{name}.xacro", {})
        said[name] = [problem.message for problem in sources.problems.values()]
    open_one = ["the macro m calls itself, and how often is not known; what it makes then is missing"]
    assert said == {"open": open_one, "both": open_one, "endless": [GIVEN_UP], "ends": []}


@pytest.mark.parametrize(
    "body",
    [
        "<xacro:include filename='$(find elsewhere)/a.xacro'/><xacro:m/><link name='${a}$(arg b)'/><xacro:insert_block name='c'/>",
        "<xacro:include filename='$(env A)/a.xacro'/><link name='${a}'/>",
        "<xacro:if value='$(env A)'><link name='${a}'/><xacro:m/></xacro:if>",
        "<xacro:if value='$(env A)'><xacro:property name='a' value='1'/></xacro:if><link name='${a}'/>",
        "<xacro:if value='$(env A)'><xacro:macro name='m' params='a'/></xacro:if><xacro:macro name='m' params='b'/><xacro:if value='$(env A)'><xacro:macro name='m' params='c'/></xacro:if><xacro:m d='1'/>",
        "<xacro:property name='${1}$(env A)' value='1'/><link name='${a}'/>",
        "<xacro:macro name='never' params='a'><link name='${q}'/><xacro:nothing/></xacro:macro>",
        "<link name='${sorted([3, 1])}${hex(3)}'/>",
        "<xacro:property name='a' value='${b}'/>",
        "<wheel a='1'/><xacro:macro name='wheel' params='a'/>",
        "<xacro:macro name='link' params='name'/><link name='x'/>",
        "<xacro:call macro='$(env A)'/><link name='${a}'/>",
        "<link name='$()'/><link name='$( )'/>",
        "<link name='${ {1: 2}[3] }'/>",
        "<xacro:property name='a' value='1'/><xacro:property name='a' remove='true'/>",
    ],
)
def test_what_is_not_certain(tmp_path: Path, body: str) -> None:
    assert not [fault for fault in read(tmp_path, body).faults if fault.certain and fault.kind != "expression"]


def test_both_branches_of_an_unknown_condition_may_be(tmp_path: Path) -> None:
    robot = read(
        tmp_path, "<link name='a'/><xacro:if value='$(arg x)'><link name='b'/></xacro:if>", given={"x": UNKNOWN}
    )
    assert [(link.name, link.certain) for link in robot.links] == [("a", True), ("b", False)]
    assert not robot.is_whole


def test_an_argument_that_is_given_counts(tmp_path: Path) -> None:
    robot = read(tmp_path, "<xacro:arg name='x' default='a'/><link name='$(arg x)'/>", given={"x": "b"})
    assert links(robot) == ["b"] and robot.is_whole


@pytest.mark.parametrize("substitution", ["$(env SIDE)", "$(optenv SIDE left)"])
def test_environment_variables(tmp_path: Path, substitution: str) -> None:
    read(tmp_path, f"<link name='{substitution}'/>")
    workspace = discover(tmp_path, (".",))
    sources = DescriptionSources(workspace, by_names(workspace))
    given = expand(sources, "r.xacro", environment={"SIDE": "right"})
    lost = expand(sources, "r.xacro", environment=Environment(lost={"SIDE": "a command makes it"}))
    assert given.root is not None and [child.given("name") for child in given.root.children] == ["right"]
    assert lost.root is not None and [child.given("name") for child in lost.root.children] == [None]


def test_tags_without_prefix_of_old(tmp_path: Path) -> None:
    body = "<property name='p' value='x'/><macro name='m' params='a'><link name='${a}${p}'/></macro><m a='1'/>"
    assert links(read(tmp_path, body, legacy=True)) == ["1x"]
    assert links(read(tmp_path, body)) == []


def test_the_way_to_a_fault(tmp_path: Path) -> None:
    robot = read(
        tmp_path,
        "<xacro:include filename='m.xacro'/>\n<xacro:m/>",
        m__xacro=f"{HEAD}\n<xacro:macro name='m'>\n<link name='${{q}}'/></xacro:macro></robot>",
    )
    (fault,) = robot.faults
    assert (fault.location.path, fault.location.line) == ("m.xacro", 3)
    assert [(place.path, place.line) for place, _ in fault.way] == [("r.xacro", 3)]


def test_joints_and_meshes(tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "a.stl").write_bytes(b"solid a" + bytes(90))
    robot = read(
        tmp_path,
        "<link name='a'><visual><geometry><mesh filename='package://demo/meshes/a.stl'/></geometry></visual></link>"
        "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><limit lower='${-1}' effort='1'/><mimic joint='k'/></joint>",
    )
    (joint,) = robot.joints
    assert (joint.name, joint.type, joint.parent, joint.child, joint.mimic) == ("j", "revolute", "a", "b", "k")
    assert joint.limit is not None and (joint.limit.lower, joint.limit.upper, joint.limit.velocity) == (
        "-1",
        None,
        None,
    )
    assert [mesh.path for mesh in robot.meshes] == ["meshes/a.stl"]


def test_the_first_bytes_of_a_mesh(tmp_path: Path) -> None:
    (tmp_path / "a.stl").write_bytes(b"solid a" + bytes(900))
    (tmp_path / "link.stl").symlink_to("/etc/passwd")
    workspace = discover(tmp_path, (".",))
    assert len(workspace.head("a.stl")) == 84 and workspace.head("a.stl").startswith(b"solid a")
    assert workspace.head("link.stl") == b"" and workspace.head("nowhere.stl") == b"" and workspace.head("../a") == b""


@pytest.mark.parametrize(
    "body",
    [
        "<xacro:macro name='m'><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:include filename='r.xacro'/>",
        "<xacro:macro name='m'><xacro:n/><xacro:n/></xacro:macro><xacro:macro name='n'><xacro:m/><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:property name='a' value='${b}'/><xacro:property name='b' value='${a}'/><link name='${a}'/>",
        "<xacro:property name='a0' value='xxxxxxxxxx'/>"
        + "".join(f"<xacro:property name='a{i}' value='{'${a%d}' % (i - 1) * 10}'/>" for i in range(1, 12))
        + "<link name='${a11}'/>",
        "".join(f"<xacro:property name='p{i}' value='${{p{i + 1}}}'/>" for i in range(900)) + "<link name='${p0}'/>",
        "<a>" * 90 + "</a>" * 90,
        "<xacro:property name='l' value='${[1]}'/><xacro:macro name='m'><a b='${l.append(1)}'/><xacro:m/><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:property name='l' value='${[1]}'/><xacro:macro name='m'><a b='${l.extend(list(l))}'/><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:macro name='m' params='n'>"
        + "<xacro:if value='${n}'><xacro:m n='${n - 1}'/><xacro:m n='${n - 1}'/></xacro:if></xacro:macro><xacro:m n='40'/>",
    ],
)
def test_hostile_files_end(tmp_path: Path, body: str) -> None:
    robot = read(tmp_path, body + "<link name='end'/>")
    assert not [fault for fault in robot.faults if fault.certain and fault.kind != "expression"]
    assert robot.size <= 2
