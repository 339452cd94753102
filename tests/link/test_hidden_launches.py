# SPDX-License-Identifier: Apache-2.0
"""Launch files that are included only under conditions that nobody can make true from outside: names in them are checked all the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.analysis.architecture import varied
from haros_ci.checking.run import run_checks
from haros_ci.checking.system import systems
from haros_ci.config.settings import Settings
from haros_ci.registry import checks
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

MANIFEST = (
    '<package format="2"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license><buildtool_depend>catkin</buildtool_depend><exec_depend>rosbag</exec_depend></package>\n"
)
RULES = ("unset-launch-argument", "unused-launch-argument", "unknown-package", "unknown-executable")
#: The file that is started, and the one between, whose argument nobody passes.
TOP = '<launch>\n<include file="$(find demo)/launch/demo.launch"/>\n</launch>\n'
DEMO = """<launch>
<arg name="db" default="false"/>
<include if="$(arg db)" file="$(find demo)/launch/db.launch">
  <arg name="path" value="/data"/>
</include>
</launch>
"""
DB = """<launch>
<arg name="path"/>
<param name="path" value="$(arg path)"/>
{}
</launch>
"""


def messages(files: dict[str, str], folder: Path) -> list[tuple[str, str]]:
    every = {
        "package.xml": MANIFEST,
        "CMakeLists.txt": "project(demo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
        "launch/top.launch": TOP,
        "launch/demo.launch": DEMO,
        **files,
    }
    for path, text in every.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    workspace = discover(folder, (".",))
    made = varied(workspace, Settings(root=folder), MemoryCache(), alternatives=True)
    chosen = [check for check in checks() if check.id in RULES]
    outcome = run_checks(chosen, systems(made.architecture, workspace), "haros-ci")
    assert not outcome.notifications
    return [(one.location.path, one.message) for one in outcome.results if one.level.value != "note"]


@pytest.mark.parametrize(
    ("inside", "words"),
    [
        ('<param name="rate" value="$(arg rat)"/>', "$(arg rat) is read, but never declared or set"),
        ('<node pkg="roslanch" type="a" name="a"/>', "package 'roslanch' does not exist; did you mean 'roslaunch'?"),
        ('<node pkg="rosbag" type="recrd" name="a"/>', "did you mean 'record'?"),
        (
            '<include file="$(find demo)/launch/below.launch"><arg name="spped" value="1"/></include>',
            "passes 'spped' to launch/below.launch, which does not declare it: launch stops here; did you mean 'speed'?",
        ),
    ],
)
def test_names_are_checked(inside: str, words: str, tmp_path: Path) -> None:
    below = '<launch>\n<arg name="speed"/>\n<param name="speed" value="$(arg speed)"/>\n</launch>\n'
    ((path, message),) = messages({"launch/db.launch": DB.format(inside), "launch/below.launch": below}, tmp_path)
    assert path == "launch/db.launch" and words in message


@pytest.mark.parametrize(
    "files",
    [
        {"launch/db.launch": DB.format("")},
        {"launch/db.launch": DB.format('<node pkg="rosbag" type="record" name="a"/>')},
        # what the include passes is not the default
        {
            "launch/demo.launch": DEMO.replace('"path" value="/data"', '"pkg" value="rosbag"'),
            "launch/db.launch": '<launch>\n<arg name="pkg" default="roslanch"/>\n<node pkg="$(arg pkg)" type="record" name="a"/>\n</launch>\n',
        },
        # the argument that it needs is given
        {
            "launch/db.launch": DB.format(
                '<include file="$(find demo)/launch/below.launch"><arg name="path" value="$(arg path)"/></include>'
            ),
            "launch/below.launch": '<launch>\n<arg name="path"/>\n<param name="p" value="$(arg path)"/>\n</launch>\n',
        },
        # no code that anybody means
        {
            "launch/demo.launch": DEMO.replace('if="$(arg db)"', 'if="false"').replace(
                '<arg name="db" default="false"/>', ""
            ),
            "launch/db.launch": DB.format('<node pkg="roslanch" type="a" name="a"/>'),
        },
    ],
)
def test_quiet(files: dict[str, str], tmp_path: Path) -> None:
    assert messages(files, tmp_path) == []


def test_each_is_told_of_once(tmp_path: Path) -> None:
    other = {"launch/top_two.launch": TOP, "launch/db.launch": DB.format('<param name="a" value="$(arg rat)"/>')}
    assert len(messages(other, tmp_path)) == 1
