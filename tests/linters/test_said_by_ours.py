# SPDX-License-Identifier: Apache-2.0
"""catkin_lint and a check of ours on one thing of one package are one finding."""

from __future__ import annotations

import pytest

from haros_ci.linters.said_by_ours import said_once, unrepeated
from haros_ci.model.location import Location
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

NEEDS = "robot needs tf to build (#include <tf/tf.h>), and nothing that it declares brings it; add <depend>tf</depend>."
DIRECTORY = "the directory src of robot is not installed, but 2 places need it."
HEADERS = "the headers in include are exported, but not installed: robot"
PLUGIN = "nav_core plugin file 'src/a/b.xml' is not installed to ${CATKIN_PACKAGE_SHARE_DESTINATION}."
EXPORTS = "catkin_package() exports package include path that is not installed."

NO_BIT = "robot/cfg/Arm.cfg has no execute bit: dynamic_reconfigure runs it during the build, which may stop there."
NO_BITS = (
    "robot/cfg/Arm.cfg and robot/cfg/Leg.cfg have no execute bits: dynamic_reconfigure runs them during the build."
)
NO_LINE = "robot/scripts/go.py is installed as a program and has no shebang."


def finding(tool: str, rule: str, message: str, path: str) -> Result:
    return Result(tool, rule, Level.ERROR, message, Location(path, 3))


def joined(rule: str, message: str, ours: str, text: str, package: str = "robot") -> list[tuple[str, tuple[str, ...]]]:
    given = [
        finding("haros-ci", ours, text, "robot/package.xml"),
        finding("catkin_lint", rule, message, package + "/C"),
    ]
    return [(r.full_id, r.also) for r in said_once(given, lambda path: path.partition("/")[0])]


@pytest.mark.parametrize(
    ("rule", "message", "ours", "text"),
    [
        ("MISSING_DEPEND", "missing build_depend on 'tf'.", "undeclared-dependency", NEEDS),
        ("MISSING_FIND", "call to tf_x() requires find_package('tf').", "undeclared-dependency", NEEDS),
        ("UNINSTALLED_PLUGIN", PLUGIN, "directory-not-installed", DIRECTORY),
        ("UNINSTALLED_INCLUDE_PATH", EXPORTS, "directory-not-installed", HEADERS),
        ("PROJECT_NAME", "project name differs.", "wrong-package-name", "anything"),
        ("SCRIPT_NOT_EXECUTABLE", "script 'cfg/Arm.cfg' must be executable.", "script-not-runnable", NO_BIT),
        ("SCRIPT_NOT_EXECUTABLE", "script 'cfg/Leg.cfg' must be executable.", "script-not-runnable", NO_BITS),
        ("MISSING_SHEBANG", "script 'scripts/go.py' has no shebang.", "script-not-runnable", NO_LINE),
    ],
)
def test_one(rule: str, message: str, ours: str, text: str) -> None:
    assert joined(rule, message, ours, text) == [(f"haros-ci:{ours}", (f"catkin_lint:{rule}",))]
    assert len(joined(rule, message, ours, text, package="other")) == 2


@pytest.mark.parametrize(
    ("rule", "message", "ours", "text"),
    [
        ("MISSING_DEPEND", "missing build_depend on 'tf2'.", "undeclared-dependency", NEEDS),
        ("MISSING_DEPEND", "missing build_depend on 'tf'.", "directory-not-installed", NEEDS),
        ("UNINSTALLED_PLUGIN", PLUGIN.replace("src/", "config/"), "directory-not-installed", DIRECTORY),
        ("UNINSTALLED_INCLUDE_PATH", EXPORTS, "directory-not-installed", DIRECTORY),
        ("SCRIPT_NOT_EXECUTABLE", "script 'cfg/Leg.cfg' must be executable.", "script-not-runnable", NO_BIT),
        ("SCRIPT_NOT_EXECUTABLE", "script 'm.cfg' must be executable.", "script-not-runnable", NO_BIT),
        ("SCRIPT_NOT_EXECUTABLE", "script 'cfg/Arm.cfg' must be executable.", "unknown-target", NO_BIT),
        ("DUPLICATE_CMD", "'tf'", "undeclared-dependency", NEEDS),
    ],
)
def test_two(rule: str, message: str, ours: str, text: str) -> None:
    assert len(joined(rule, message, ours, text)) == 2


def test_others_stay() -> None:
    others = (finding("cppcheck", "a", "'tf'", "robot/a"), finding("haros-ci", "undeclared-dependency", NEEDS, "a"))
    assert said_once(others, lambda path: path.partition("/")[0]) == others
    assert said_once(others, lambda path: None) == others


NEEDS_CORE = "target '{}' depends on target 'core' which is not installed."


def of_targets(*said: tuple[str, str, str]) -> list[tuple[str, int]]:
    given = [finding("catkin_lint", rule, message, path) for rule, message, path in said]
    return [(r.rule, len(r.related)) for r in said_once(given, lambda path: path.partition("/")[0])]


def test_a_target_that_is_not_installed_is_said_once() -> None:
    exported = ("UNINSTALLED_EXPORT_LIB", "exported library 'core' is not installed.", "robot/C")
    left, right = (("UNINSTALLED_DEPEND", NEEDS_CORE.format(name), "robot/C") for name in ("left", "right"))
    assert of_targets(left, right) == [("UNINSTALLED_DEPEND", 1)]
    assert of_targets(exported, left, right) == [("UNINSTALLED_EXPORT_LIB", 2)]
    assert joined("UNINSTALLED_DEPEND", left[1], "target-not-installed", "core of robot is not installed") == [
        ("haros-ci:target-not-installed", ("catkin_lint:UNINSTALLED_DEPEND",))
    ]


def test_other_targets_are_said_for_themselves() -> None:
    left = ("UNINSTALLED_DEPEND", NEEDS_CORE.format("left"), "robot/C")
    other = ("UNINSTALLED_DEPEND", "target 'left' depends on target 'base' which is not installed.", "robot/C")
    assert len(of_targets(left, other)) == 2
    assert len(of_targets(left, (left[0], left[1], "arm/C"))) == 2
    assert len(of_targets(left, ("UNINSTALLED_PLUGIN", "plugin file 'core' is not installed.", "robot/C"))) == 2
    assert len(joined("UNINSTALLED_DEPEND", left[1], "target-not-installed", "left of robot is not installed")) == 2


@pytest.mark.parametrize(
    ("package", "text", "left"),
    [("robot", DIRECTORY, 0), ("other", DIRECTORY, 1), ("robot", "the directory config of robot is not installed", 1)],
)
def test_a_hint_that_is_left_out_is_not_told_by_the_other(package: str, text: str, left: int) -> None:
    hint = finding("haros-ci", "directory-not-installed", text, "robot/CMakeLists.txt")
    theirs = finding("catkin_lint", "UNINSTALLED_PLUGIN", PLUGIN, f"{package}/CMakeLists.txt")
    other = finding("pylint", "UNINSTALLED_PLUGIN", PLUGIN, "robot/a.py")
    found = unrepeated([theirs, other], [hint], lambda path: path.partition("/")[0])
    assert len(found) == left + 1 and found[-1] == other
    assert unrepeated([theirs, other], [], lambda path: "robot") == (theirs, other)


def of_markers(*others: tuple[str, str, str, int]) -> list[tuple[str, tuple[str, ...]]]:
    related = Related(Location("b.py", 9), "the markers of the same merge")
    ours = Result(
        "haros-ci", "merge-conflict", Level.ERROR, "a.py holds the markers", Location("a.py", 7), related=(related,)
    )
    given = [Result(tool, rule, Level.ERROR, "bad", Location(path, line)) for tool, rule, path, line in others]
    return [(r.full_id, r.also) for r in said_once([*given, ours], lambda path: None)]


def test_the_markers_of_a_merge_are_one_finding() -> None:
    both = of_markers(("pylint", "syntax-error", "a.py", 7), ("pylint", "syntax-error", "b.py", 9))
    assert both == [("haros-ci:merge-conflict", ("pylint:syntax-error",))]
    behind = of_markers(("pylint", "syntax-error", "a.py", 21), ("pylint", "syntax-error", "b.py", 10))
    assert behind == both
    assert of_markers(("ruff", "invalid-syntax", "a.py", 7)) == [("haros-ci:merge-conflict", ("ruff:invalid-syntax",))]


@pytest.mark.parametrize(
    "other",
    [
        ("pylint", "syntax-error", "a.py", 3),
        ("pylint", "syntax-error", "c.py", 7),
        ("pylint", "syntax-error", "b.py", 7),
        ("pylint", "undefined-variable", "a.py", 7),
    ],
)
def test_what_is_not_of_the_markers(other: tuple[str, str, str, int]) -> None:
    assert of_markers(other) == [(":".join(other[:2]), ()), ("haros-ci:merge-conflict", ())]


def test_a_fault_of_syntax_without_a_merge() -> None:
    fault = Result("pylint", "syntax-error", Level.ERROR, "bad", Location("a.py", 7))
    assert said_once([fault], lambda path: None) == (fault,)
