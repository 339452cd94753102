# SPDX-License-Identifier: Apache-2.0
"""catkin_lint and a check of ours on one thing of one package are one finding."""

from __future__ import annotations

import pytest

from haros_ci.linters.said_by_ours import said_once
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NEEDS = "robot needs tf to build (#include <tf/tf.h>), and nothing that it declares brings it; add <depend>tf</depend>."
DIRECTORY = "the directory src of robot is not installed, but 2 places need it."
HEADERS = "the headers in include are exported, but not installed: robot"
PLUGIN = "nav_core plugin file 'src/a/b.xml' is not installed to ${CATKIN_PACKAGE_SHARE_DESTINATION}."
EXPORTS = "catkin_package() exports package include path that is not installed."


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
        ("DUPLICATE_CMD", "'tf'", "undeclared-dependency", NEEDS),
    ],
)
def test_two(rule: str, message: str, ours: str, text: str) -> None:
    assert len(joined(rule, message, ours, text)) == 2


def test_others_stay() -> None:
    others = (finding("cppcheck", "a", "'tf'", "robot/a"), finding("haros-ci", "undeclared-dependency", NEEDS, "a"))
    assert said_once(others, lambda path: path.partition("/")[0]) == others
    assert said_once(others, lambda path: None) == others
