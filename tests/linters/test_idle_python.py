# SPDX-License-Identifier: Apache-2.0
"""Notes on Python that nothing in the workspace runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.linters.idle_python import with_idle_python
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level
from haros_ci.workspace.discover import discover

MANIFEST = (
    '<package format="3"><name>heron</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>Apache-2.0</license>{}</package>\n"
)
ROS_2 = MANIFEST.format("<depend>rclpy</depend><export><build_type>ament_python</build_type></export>")
ROS_1 = MANIFEST.format("<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend>")
MAIN = 'if __name__ == "__main__":\n    walk()\n'
FUNCTION = "def walk():\n    pass\n\n\ndef weigh(a):\n    return scale * a  # HERE\n\n\n"
PROGRAM = FUNCTION + MAIN
CLASS = "class Leg:\n    def lift(self):\n        return height  # HERE\n\n\ndef walk():\n    pass\n\n\n" + MAIN
SHELL = "last = 0\nwhile True:\n    if motor.uptime > last:  # HERE\n        last = motor.uptime\n"
OLD = "import time\n\nport = raw_input('port')  # HERE\ntime.sleep(1)\n"
PORT = "import rospy\n\n\nclass Rates:\n    pass\n\n\nRates(1)  # HERE\n"
STUB = "class Filter:\n    def __init__():  # HERE\n        pass\n"


def level(
    root: Path, text: str, more: dict[str, str], rule: str, *, is_given: bool = False, path: str = "heron/leg.py"
) -> Level:
    """The level that an error of pylint at the line of HERE in *path* has."""
    files = {path: text, "package.xml": ROS_2, **more}
    for place, content in files.items() if path.startswith("heron/") else (*more.items(), (path, text)):
        (root / place).parent.mkdir(parents=True, exist_ok=True)
        (root / place).write_text(content, encoding="utf-8")
    line = text[: text.index("HERE")].count("\n") + 1
    name = "raw_input" if "raw_input" in text else "motor"
    result = Result("pylint", rule, Level.ERROR, f"Undefined variable '{name}'", Location(path, line, 5))
    (weighed,) = with_idle_python([result], discover(root, (".",)), lambda result: is_given)
    return weighed.level


@pytest.mark.parametrize(
    ("text", "more", "rule"),
    [
        # a function or a class of a program, which nothing names
        (PROGRAM, {}, "undefined-variable"),
        (PROGRAM, {}, "no-value-for-parameter"),
        (PROGRAM + "# weigh(1)\n", {}, "undefined-variable"),
        (PROGRAM, {"heron/arm.py": PROGRAM + "weigh(2)\n"}, "undefined-variable"),  # of its own
        (PROGRAM, {"heron/arm.py": "weighed = 1\n"}, "undefined-variable"),
        (CLASS, {}, "undefined-variable"),
        # lines for the shell of a tool
        (SHELL, {}, "undefined-variable"),
        (SHELL, {"README.md": "Try it by hand.\n"}, "undefined-variable"),
        # for ROS 1, in a package of ROS 2
        (PORT, {}, "too-many-function-args"),
        (PORT, {"heron/leg.test": '<launch><test pkg="heron" type="leg.py" test-name="leg"/></launch>\n'}, "too-many-function-args"),
        # a sketch of a class
        (STUB, {}, "no-method-argument"),
        (STUB.replace("pass", '"""To be done."""'), {}, "no-method-argument"),
    ],
)  # fmt: skip
def test_nothing_runs_it(tmp_path: Path, text: str, more: dict[str, str], rule: str) -> None:
    assert level(tmp_path, text, more, rule) is Level.NOTE
    assert level(tmp_path, text, more, rule, is_given=True) is Level.ERROR


@pytest.mark.parametrize(
    ("text", "more", "rule"),
    [
        (PROGRAM + "weigh(1)\n", {}, "undefined-variable"),
        (PROGRAM + "CALLED = 'weigh'\n", {}, "undefined-variable"),
        (PROGRAM.replace("pass", "weigh(1)"), {}, "undefined-variable"),
        (PROGRAM.replace("def weigh", "@route\ndef weigh"), {}, "undefined-variable"),
        (PROGRAM.replace("weigh", "on_goal"), {}, "undefined-variable"),
        (PROGRAM.replace("weigh", "test_leg"), {}, "undefined-variable"),
        (PROGRAM + "globals()['we' + 'igh']()\n", {}, "undefined-variable"),
        (PROGRAM, {"heron/arm.py": "from heron.leg import weigh\n"}, "undefined-variable"),
        (PROGRAM, {"heron/arm.py": "from leg import *\n\n\ndef weigh():\n    weigh()\n"}, "undefined-variable"),
        (PROGRAM, {"config/a.yaml": "call: weigh\n"}, "undefined-variable"),
        (PROGRAM, {}, "syntax-error"),
        (PROGRAM, {}, "not-in-loop"),
        (PROGRAM, {}, "function-redefined"),
        (FUNCTION, {}, "undefined-variable"),  # a module: others may import it
        (PROGRAM.replace("pass", "pass  # HERE").replace("a  # HERE", "a"), {}, "undefined-variable"),
        (CLASS.replace("Leg:", "Leg(Node):"), {}, "undefined-variable"),
        (CLASS.replace("Leg:", "Leg(metaclass=Register):"), {}, "undefined-variable"),
        (CLASS.replace("class Leg", "@register\nclass Leg"), {}, "undefined-variable"),
        (CLASS.replace("pass", "Leg().lift()"), {}, "undefined-variable"),
        (SHELL, {"README.md": "Run `python heron/leg.py`.\n"}, "undefined-variable"),
        (SHELL, {"launch/a.launch.py": "cmd = ['leg.py']\n"}, "undefined-variable"),
        (SHELL, {}, "not-callable"),
        ('"""Limits."""\nREACH = ARM_REACH  # HERE\n', {}, "undefined-variable"),  # a module of constants
        ("import motor_tools\n" + SHELL, {}, "undefined-variable"),
        (SHELL + "motor(1)\n", {}, "undefined-variable"),
        (OLD, {}, "undefined-variable"),  # in a package
        (PORT, {"package.xml": ROS_1}, "too-many-function-args"),
        (PORT, {"package.xml": ROS_2.replace("<depend>", '<depend condition="$ROS_VERSION == 2">')}, "too-many-function-args"),
        ("try:\n    import rclpy\nexcept ImportError:\n    pass\n" + PORT, {}, "too-many-function-args"),
        (PORT.replace("import rospy", "import math"), {}, "too-many-function-args"),
        (STUB, {"heron/arm.py": "from heron.leg import Filter\n"}, "no-method-argument"),
        (STUB + "    def run(self):\n        return 1\n", {}, "no-method-argument"),
        (STUB.replace("Filter", "Filter(Base)"), {}, "no-method-argument"),
        (STUB, {}, "undefined-variable"),
    ],
)  # fmt: skip
def test_it_may_run(tmp_path: Path, text: str, more: dict[str, str], rule: str) -> None:
    assert level(tmp_path, text, more, rule) is Level.ERROR


@pytest.mark.parametrize(
    ("text", "more", "expected"),
    [
        (OLD, {}, Level.NOTE),
        ("#!/usr/bin/env python\n" + OLD, {}, Level.NOTE),
        ("#!/usr/bin/env python3\n" + OLD, {}, Level.ERROR),
        (OLD, {"run.sh": "python tools/ask.py\n"}, Level.ERROR),
        (OLD, {"tools/b.py": "import ask\n"}, Level.ERROR),
        (OLD.replace("raw_input", "read_input"), {}, Level.ERROR),
    ],
)
def test_names_of_python_2_in_a_file_of_no_package(
    text: str, more: dict[str, str], expected: Level, tmp_path: Path
) -> None:
    more = {"heron/package.xml": ROS_2, **more}
    assert level(tmp_path, text, more, "undefined-variable", path="tools/ask.py") is expected


def test_of_other_tools_nothing_changes(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(ROS_2, encoding="utf-8")
    result = Result("ruff", "F821", Level.ERROR, "Undefined name `x`", Location("package.xml", 1, 1))
    assert with_idle_python([result], discover(tmp_path, (".",)), lambda result: False) == (result,)
