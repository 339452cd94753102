# SPDX-License-Identifier: Apache-2.0
"""Rules ``when … do …``: the properties that they are, where their faults stand, and what checks say of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import write

from haros_ci.behaviour.declared import in_project
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.meaning import mistakes, unused_aliases
from haros_ci.behaviour.rules import parse_rule
from haros_ci.behaviour.text import canonical
from haros_ci.cli import main

TEMPLATE = "nodes:\n  demo/talker.py:\n    hpl:\n      rules:\n        - {}\n"


@pytest.mark.parametrize(
    ("text", "property"),
    [
        (
            "when /a as A {x > 0} do (/b {x = @A.x} or /c)",
            "globally: /a as A {x > 0} causes (/b {x = @A.x} or /c)",
        ),
        ("when (/a or /b) do not (/c or /d) for 10 hz", "globally: (/a or /b) forbids (/c or /d) within 100 ms"),
        ("when /a as A do not /b {x > @A.x} until /c", "after /a as A until /c: no /b {x > @A.x}"),
        ("when when do do", "globally: when causes do"),
        (
            "when /a {x > 0 or y} for 500 ms do (/b or /c) within 1 s",
            "globally: /a {x > 0 or y} causes (/b or /c or /a {not (x > 0 or y)}) within 1.5 s",
        ),
        ('# id: stops\n# notes: "n"\nwhen /a  # why\n  do /b', "globally: /a causes /b"),
    ],
)
def test_a_rule_is_a_property(text: str, property: str) -> None:
    found = parse_rule(text)
    assert canonical(found) == property and not mistakes(found) and not list(unused_aliases(found))


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("", 1, 1),
        ("globally: no /a", 1, 1),
        ("when do /b", 1, 9),
        ("when /a", 1, 8),
        ("when /a do", 1, 11),
        ("when /a do not", 1, 15),
        ("when /a\n  for s do /b", 2, 7),
        ("when /a\n  for 2 sec do /b", 2, 9),
        ("when /a {x}\n  for 2 s\n  do /b", 2, 3),
        ("when /a {x ==\n 1} do /b", 1, 12),
        ("when /a do /b within 1 s for 1 s", 1, 26),
        ("when /a as A {@A.x > 0} for 1 s do /b within 1 s", 1, 6),
        ("when /a do /b;", 1, 14),
    ],
)
def test_a_fault_has_its_place(text: str, line: int, column: int) -> None:
    with pytest.raises(HplFault) as caught:
        parse_rule(text)
    assert (caught.value.at.line, caught.value.at.column) == (line, column)


def test_rules_are_promises_with_places() -> None:
    text = TEMPLATE.format("'when /a {x} do /b within 1 sec'") + "        - 'when /a do /b'\n        - {a: b}\n"
    wrong, right, odd = in_project(text, "haros.yaml", lambda name: None)
    assert wrong.fault is not None and str(wrong.location) == "haros.yaml:5:39"
    assert right.parsed is not None and not right.is_axiom and right.identity == "globally: /a causes /b"
    assert odd.fault is not None and "must be text" in odd.fault.message
    (none,) = in_project(TEMPLATE.replace("- {}", "when /a do /b"), "haros.yaml", lambda name: None)
    assert none.fault is not None and none.fault.message == "'rules' must be a list"


FILES = {
    "demo/package.xml": "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.org'>a</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>"
    "<depend>rclpy</depend><depend>std_msgs</depend><export><build_type>ament_cmake</build_type></export></package>",
    "demo/CMakeLists.txt": "project(demo)\nfind_package(ament_cmake)\ninstall(PROGRAMS talker.py DESTINATION lib/demo)\nament_package()\n",
    "demo/talker.py": "#!/usr/bin/env python3\nimport rclpy\nfrom sensor_msgs.msg import LaserScan\nfrom std_msgs.msg import Bool, UInt8\n\n"
    "rclpy.init()\nnode = rclpy.create_node('talker')\nnode.create_subscription(LaserScan, 'scan', print, 10)\n"
    "stop = node.create_publisher(Bool, 'stop', 10)\nlevel = node.create_publisher(UInt8, 'level', 10)\nrclpy.spin(node)\n",
}


def said(tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, rule: str) -> str:
    write(tmp_path, {**FILES, "haros.yaml": TEMPLATE.format(f"'{rule}'")})
    monkeypatch.chdir(tmp_path)
    main(["hpl", "haros.yaml", "--no-cache", "--output", "text"])
    return capsys.readouterr().out


@pytest.mark.parametrize(
    ("rule", "check"),
    [
        ("when /scan {range_mn < 1} for 1 s do /stop {data} within 1 s", "hpl-unknown-field"),
        ("when /scan do /level {data > 300}", "hpl-out-of-range"),
        ("when /scn do /stop", "hpl-foreign-topic"),
        ("when /stop do /scan", "hpl-wrong-direction"),
        ("when /scan do /stop within 0 s", "hpl-empty-bound"),
        ("when /level {data > 1} do /level {data > 2}", "hpl-overlap"),
        ("when /scan do /stop now", "hpl-syntax"),
    ],
)
def test_rules_are_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, rule: str, check: str
) -> None:
    out = said(tmp_path, capsys, monkeypatch, rule)
    assert check in out and "haros.yaml:5:" in out


@pytest.mark.parametrize(
    "rule",
    [
        "when /scan {range_min < 1.0} for 1 s do /stop {data} within 100 ms",
        "when /scan {ranges[0] < 1.0 and not intensities[1] > 3} for 1 s do /stop within 100 ms",
        "when /scan {max(ranges[0], ranges[1]) < 1.0} for 1 s do (/stop or /level) within 100 ms",
        "when /level {data = 1} do not /level {data = 3} until /scan {range_max > 3}",
        "when /level {data = 1} do /level {data = 2}",
        "when /scan as S do /level {data > @S.range_min}",
    ],
)
def test_and_quiet_where_they_are_right(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, rule: str
) -> None:
    assert "haros-ci:" not in said(tmp_path, capsys, monkeypatch, rule)
