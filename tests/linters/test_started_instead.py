# SPDX-License-Identifier: Apache-2.0
"""Prefixes that start something else than the node are named where a change brings them."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.started_instead import notifications, odd_prefixes

NODE = '<launch>\n  <node pkg="arm" type="arm" name="arm" launch-prefix="{}"/>\n</launch>\n'
ODD = [
    "echo",
    "true",
    "/bin/sh -c 'rosrun arm leg'",
    "bash -c 'sleep 5'",
    "&#101;cho",
    "A=b echo",
    "unshare",
]
USUAL = [
    "",
    "xterm -e",
    "gdb -ex run --args",
    "xterm -e gdb --args",
    "$(arg launch_prefix)",
    "$(find arm)/scripts/wait.sh",
    "bash -c 'sleep 5; $0 $@'",
    "bash -c 'exec &quot;$@&quot;' --",
    "nice -n -5",
    "taskset -c 1",
    "env A=b",
    "A=b gdb",
    "/usr/bin/valgrind",
    "stdbuf -o L",
    "python3 -m cProfile",
    "bash",
]


@pytest.mark.parametrize("prefix", ODD)
def test_fires(prefix: str) -> None:
    assert [line for line, _ in odd_prefixes(NODE.format(prefix), "launch")] == [2]


@pytest.mark.parametrize("prefix", USUAL)
def test_stays_quiet(prefix: str) -> None:
    assert list(odd_prefixes(NODE.format(prefix), "launch")) == []


@pytest.mark.parametrize(
    ("text", "language", "count"),
    [
        ('<launch><executable cmd="a" prefix="echo"/></launch>', "launch", 1),
        ("<launch><node pkg='a' exec='b'\n  launch-prefix='echo'/></launch>", "launch", 1),
        ("launch:\n- node:\n    pkg: a\n    launch-prefix: echo\n", "launch", 1),
        ("launch:\n- node:\n    launch-prefix: 'xterm -e'\n", "launch", 0),
        ("from launch_ros.actions import Node\nNode(package='a', prefix='echo')\n", "python", 1),
        ("from launch_ros.actions import Node\nNode(package='a', prefix=['echo ', x])\n", "python", 1),
        ("from launch_ros.actions import Node\nNode(package='a', prefix=['xterm -e'])\n", "python", 0),
        ("def f(prefix='arm'): pass\n", "python", 0),
        ('<launch><!-- <node launch-prefix="echo"/> --></launch>', "launch", 0),
        ('<robot><xacro:arm prefix="left"/></robot>', "xml", 0),
        ('<launch><arg name="prefix" default="left"/></launch>', "launch", 0),
        ("prefix: left\n", "yaml", 0),
        ("<launch><executable cmd=\"bash -c 'R=ros2; $R run a b'\"/></launch>", "launch", 1),
        ("<launch><executable cmd=\"bash -c 'f() { ros2 run a b; }; f'\"/></launch>", "launch", 1),
        ("<launch><executable cmd=\"sh -lc 'alias r=&quot;rosrun a&quot;; r b'\"/></launch>", "launch", 1),
        ("<launch><executable cmd=\"bash -c 'sleep 1; ros2 run a b'\"/></launch>", "launch", 0),
        ("<launch><executable cmd=\"bash -c 'A=b ros2 run a b'\"/></launch>", "launch", 0),
        ("<launch><executable cmd='ros2 run a b --ros-args -p x:=ros2'/></launch>", "launch", 0),
        ("import launch_ros\nExecuteProcess(cmd=['bash', '-c', 'R=\"ros2 run\"; $R a b'])\n", "python", 1),
        ("import launch_ros\n# bash -c 'R=ros2'\nx = 1\n", "python", 0),
        ("launch:\n- executable:\n    cmd: bash -c 'R=rosrun; $R a b'\n", "launch", 1),
    ],
)
def test_kinds(text: str, language: str, count: int) -> None:
    assert len(list(odd_prefixes(text, language))) == count


@pytest.mark.parametrize("part", ["<node ", "<node prefix=", '<node prefix="', "<!--", "launch-prefix: ", "prefix=['"])
def test_many_take_linear_time(part: str) -> None:
    for language in ("launch", "python"):
        list(odd_prefixes(f"<launch_ros {part * 20_000}", language))


def test_what_a_change_brings(tmp_path: Path) -> None:
    def said(base: str, head: str) -> list[str | None]:
        texts = (("b", base), ("h", head))
        places = [workspace(tmp_path / side / str(len(head)), {"arm.launch": text}) for side, text in texts]
        return [note.path for note in notifications(places[1], places[0])]

    assert said(NODE.format("xterm -e"), NODE.format("echo")) == ["arm.launch"]
    assert said(NODE.format("echo"), "\n" + NODE.format("echo")) == []
    assert notifications(workspace(tmp_path / "w", {"arm.launch": NODE.format("echo")}), None) == ()
