# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions that never end, grow without bounds or lead outside: each is given up, and the others are read."""

from __future__ import annotations

import pytest
from hostile_kit import Trap, assert_harmless, assert_the_rest_is_analysed

MANIFEST = """<package format="3"><name>bad</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license>
<buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>
"""
GOOD = """<robot name="g"><link name="a"/>
<joint name="j" type="fixed"><parent link="a"/>
<child link="missing"/></joint></robot>
"""
L = "<xacro:property name='l' value='${[0]*20000}'/>"
WIDE = f"{L}<xacro:property name='m' value='${{[l]*20000}}'/>\n<xacro:property name='n' value='${{[[0]*19999 + [1]]*20000}}'/>"


#: A tenth of the steps that a description, and all together, may take.
FEWER = """
from haros_ci.robot import evaluating, sources
whole = sources.DescriptionSources.__post_init__
def tenth(self):
    whole(self)
    self.steps = sources.MAX_STEPS // 10
evaluating.MAX_STEPS //= 10
sources.DescriptionSources.__post_init__ = tenth
"""


def names(step: int) -> list[str]:
    return ["".join(chr(0x4E00 + (at * step + number) % 9000) for at in range(5000)) for number in range(8)]


#: What stands in the robot; it is expanded as a launch file asks for it.
ENDLESS = {
    "itself": '<xacro:include filename="x.xacro"/>\n' * 3,
    "macro": '<xacro:macro name="m"><xacro:m/><xacro:m/></xacro:macro><xacro:m/>',
    "doubling": "\n".join(
        f'<xacro:macro name="m{n}"><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>' for n in range(40)
    )
    + '<xacro:macro name="m40"/><xacro:m0/>',
    "turns": "<link name='${[a for a in range(19999) for b in range(19999) if False]}'/>",
    "lists": f"{L}\n" + "<link name='${1 in l}'/>\n" * 5_000,
    "parameters": '<xacro:macro name="o"><xacro:macro name="m" params="'
    + "a=${\n" * 4_000
    + '"/></xacro:macro>'
    + "<xacro:o/>\n" * 3_000,
    "patterns": "\n".join(f'<xacro:include filename="*z{n}.xacro"/>' for n in range(8_000)),
}
HUGE = {
    "text of lists": f"{WIDE}<link name='${{m}}'/><link name='${{str(m)}}'/>",
    "text of texts": "<xacro:property name='t' value='${\"x\"*20000}'/><link name='${str([t]*20000)}'/>",
    "equal lists": f"{WIDE}<link name='${{m == n}}'/><link name='${{m.count(n)}}'/><link name='${{n in m}}'/>",
    "sums": "<xacro:property name='l' value='${[[1]]*19000}'/>\n" + "<link name='${len(sum(l, []))}'/>\n" * 500,
    "powers": "<link name='${9**9**9}'/><link name='${(9**500)**500}'/><link name='${\"a\"*10**10}'/>",
    "ranges": "<link name='${list(range(10**9))}'/><link name='${sum(range(10**10))}'/>",
    "formats": "<link name='${\"%0999999999d\" % 1}'/><link name='${f\"{1:>999999999}\"}'/><link name='${str(1).zfill(10**9)}'/>",
    "unlike names": "\n".join(f'<xacro:macro name="{name}"/>' for name in names(7))
    + "\n".join(f"<xacro:{name}/>" for name in names(11)),
    "many names": "\n".join(f'<xacro:macro name="macro_{n}_name"/>\n<xacro:makro_{n}_name/>' for n in range(3_000)),
    "blocks": "\n".join(f'<xacro:property name="p{n}" value="1"/>' for n in range(10_000))
    + '<xacro:insert_block name="b"/>\n' * 20_000,
    "names of includes": f'<xacro:include filename="{"${a}x" * 25}y.xacro"/>',
    "bracket": f'<xacro:include filename="{"[" * 900_000}"/>',
    "YAML": "<link name='${xacro.load_yaml(\"many.yaml\")[0]}'/>",
    "YAML in base 60": '<link name=\'${xacro.load_yaml("base60.yaml")["a"]}\'/>',
    "YAML aliases": "<link name='${xacro.load_yaml(\"alias.yaml\")}'/>",
    "deep YAML": "<link name='${xacro.load_yaml(\"deep.yaml\")}'/>",
}
FILES = {
    "many.yaml": "- [a, b, {c: d}]\n" * 100_000,
    "base60.yaml": f"a: 1{':20' * 160_000}\n",
    "alias.yaml": "&a [*a, *a, *a]\n",
    "deep.yaml": "[\n" * 100_000,
    f"{'x' * 200}.xacro": "<robot/>",
}


def laid(trap: Trap, body: str) -> None:
    """A package whose description is *body*, beside one with a fault that must be told."""
    trap.write("good/package.xml", MANIFEST.replace("bad", "good"))
    trap.write("good/urdf/good.urdf", GOOD)
    trap.write("bad/package.xml", MANIFEST)
    trap.write("bad/CMakeLists.txt", "project(bad)\nament_package()\n")
    trap.write(
        "bad/launch/x.launch.xml",
        '<launch><node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description" '
        "value=\"$(command 'xacro $(find-pkg-share bad)/urdf/x.xacro')\"/></node></launch>",
    )
    robot = f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">\n{body}\n<link name="base"/></robot>\n'
    trap.write("bad/urdf/x.xacro", robot.replace("><", ">\n<"))


@pytest.mark.parametrize("name", sorted(ENDLESS))
def test_a_description_without_end_is_given_up_and_told(trap: Trap, name: str) -> None:
    laid(trap, ENDLESS[name])
    outcome = trap.run("--profile=architecture", driver=trap.impatient(FEWER))
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, ("good/urdf/good.urdf", 2, "broken-robot-model"))
    assert any(path == "bad/urdf/x.xacro" and "not expanded to its end" in said for path, said in outcome.notes())


@pytest.mark.parametrize("name", sorted(HUGE))
def test_what_grows_is_not_known(trap: Trap, name: str) -> None:
    laid(trap, HUGE[name])
    for path, text in FILES.items():
        trap.write(f"bad/urdf/{path}", text)
    outcome = trap.run("--profile=architecture")
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, ("good/urdf/good.urdf", 2, "broken-robot-model"))


def test_many_descriptions_share_what_they_may_take(trap: Trap) -> None:
    laid(trap, "<link name='a'/>")
    for number in range(40):
        trap.write(f"bad/urdf/a{number}.xacro", f'<robot xmlns:xacro="x" name="r">{ENDLESS["turns"]}</robot>')
    for number in range(250):
        trap.write(f"bad/more/f_{number}.xacro", '<robot name="r"><link name="a"/></robot>')
    trap.write("bad/config/a.yaml", "# xacro\n" + "".join(f'"k{number}": 1\n' for number in range(10_000)))
    trap.write("bad/config/b.yaml", "# xacro\n" + "q_f_ f_ x f_\n" * 10_000)
    outcome = trap.run("--profile=architecture", driver=trap.impatient(FEWER))
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, ("good/urdf/good.urdf", 2, "broken-robot-model"))


def test_nothing_outside_is_read(trap: Trap) -> None:
    outside = str(trap.outside / "secret.py")
    up = "../" * 12
    laid(
        trap,
        "\n".join(
            f'<xacro:include filename="{path}"/><link name="${{xacro.load_yaml(&quot;{path}&quot;)}}"/>'
            for path in (
                outside,
                f"file://{outside}",
                f"{up}etc/passwd",
                f"$(find bad)/{up}etc/passwd",
                "link.xacro",
                "/etc/*",
                "../../../outside/*",
            )
        ),
    )
    (trap.root / "bad/urdf/link.xacro").symlink_to("/etc/passwd")
    outcome = trap.run("--profile=architecture")
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome, ("good/urdf/good.urdf", 2, "broken-robot-model"))
