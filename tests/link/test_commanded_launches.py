# SPDX-License-Identifier: Apache-2.0
"""Launch files that are not called so, or lie elsewhere: those that a command starts, and Python with the function that ros2 launch calls."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_loose_launches import ALONE, NEWER, NODE, PACKAGE, PYTHON, configurations

from haros_ci.model.launch_commands import Commanded, commanded
from haros_ci.model.package import SourceFile
from haros_ci.workspace.discover import discover

PAGE = "# Demo\n\n    {}\n"
XML = '<launch><node pkg="p" exec="n"/></launch>'
YAML = "launch:\n- node:\n    pkg: p\n    exec: n\n"


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"src/p/bring_up/all.py": PYTHON}, ["p/bring_up/all.py"]),
        ({"src/p/launch/robots/all.py": PYTHON}, ["p/launch/robots/all.py"]),
        ({"src/p/all.py": PYTHON}, ["p/all.py"]),
        ({"src/p/config/all.xml": XML, "README.md": PAGE.format("ros2 launch p all.xml")}, ["p/config/all.xml"]),
        ({"src/p/launch/all.yaml": YAML, "go.sh": "ros2 launch p all.yaml use:=1 &\n"}, ["p/launch/all.yaml"]),
        ({"tools/all.py": PYTHON, "README.md": PAGE.format("ros2 launch tools/all.py")}, ["tools/all.py"]),
        (
            {"launch/all.py": PYTHON, "README.md": PAGE.format("`ros2 launch ~/ws/src/demo/launch/all.py`")},
            ["launch/all.py"],
        ),
        (
            {"docs/all.launch.py": PYTHON, "README.md": PAGE.format("ros2 launch ./docs/all.launch.py")},
            ["docs/all.launch.py"],
        ),
        ({"a/b/all.py": PYTHON, "Dockerfile": "FROM ros\nCMD ros2 launch --debug /ws/a/b/all.py\n"}, ["a/b/all.py"]),
        # nothing starts them, or another of their name
        ({"src/p/config/all.xml": XML}, ALONE),
        ({"src/p/launch/all.yaml": YAML}, ALONE),
        ({"src/p/config/all.xml": XML, "README.md": PAGE.format("ros2 launch q all.xml")}, ALONE),
        ({"src/p/config/all.xml": XML, "README.md": PAGE.format("See all.xml, and ros2 launch p other.xml")}, ALONE),
        ({"tools/all.py": PYTHON}, ALONE),
        ({"launch/all.py": PYTHON}, ALONE),
        ({"tools/all.py": PYTHON, "README.md": PAGE.format("ros2 launch utils/all.py")}, ALONE),
        ({"tools/all.py": PYTHON, "README.md": PAGE.format("python3 tools/all.py")}, ALONE),
        # no launch files, tests, examples, what is put aside, modules of others
        ({"src/p/config/all.xml": "<robot/>", "README.md": PAGE.format("ros2 launch p all.xml")}, ALONE),
        ({"src/p/config/all.yaml": "a: 1\n", "README.md": PAGE.format("ros2 launch p all.yaml")}, ALONE),
        ({"src/p/bring_up/all.py": PYTHON.replace("description()", "description(arguments)")}, ALONE),
        ({"src/p/bring_up/all.py": PYTHON.replace("[Node(package='p', executable='n')]", "[]")}, ALONE),
        ({"src/p/bring_up/all.py": "# def generate_launch_description():\n"}, ALONE),
        ({"src/p/test/all.py": PYTHON}, ALONE),
        ({"src/p/bring_up/test_all.py": PYTHON}, ALONE),
        ({"src/p/examples/all.py": PYTHON}, ALONE),
        ({"src/p/old/all.py": PYTHON}, ALONE),
        (
            {"tools/all.py": PYTHON.replace("'p'", "'rviz2'"), "README.md": PAGE.format("ros2 launch tools/all.py")},
            ALONE,
        ),
        (
            {"src/p/p/parts.py": PYTHON, "src/p/launch/a.launch.py": f"from p.parts import *\n{PYTHON}"},
            ["p/launch/a.launch.py"],
        ),
        (
            {
                "src/p/bring_up/all.py": PYTHON,
                "src/p/launch/a.launch.xml": '<launch><include file="$(find-pkg-share p)/bring_up/all.py"/></launch>',
            },
            ["p/launch/a.launch.xml"],
        ),
    ],
)
def test_launch_files_of_ros2_by_other_names(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    assert configurations(tmp_path, {**NEWER, **files}) == expected


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"src/p/launch/all.xml": NODE, "README.md": PAGE.format("roslaunch p all.xml")}, ["p/launch/all.xml"]),
        ({"docs/a.launch": NODE, "README.md": PAGE.format("roslaunch docs/a.launch")}, ["docs/a.launch"]),
        (
            {"other/launch/deep/a.launch": NODE, "go.sh": "roslaunch --wait deep/a.launch\n"},
            ["other/launch/deep/a.launch"],
        ),
        ({"src/p/launch/all.xml": NODE}, ALONE),
        ({"src/p/launch/all.xml": NODE, "README.md": PAGE.format("roslaunch q all.xml")}, ALONE),
        ({"src/p/launch/all.xml": "<robot/>", "README.md": PAGE.format("roslaunch p all.xml")}, ALONE),
        ({"docs/a.launch": NODE, "README.md": PAGE.format("roslaunch p a.launch")}, ALONE),
        ({"docs/a.launch": NODE.replace('"p"', '"rviz"'), "README.md": PAGE.format("roslaunch docs/a.launch")}, ALONE),
    ],
)
def test_launch_files_of_ros1_that_a_command_starts(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    assert configurations(tmp_path, {**PACKAGE, **files}) == expected


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ({"tools/all.py": PYTHON}, ["tools/all.py"]),
        ({"tools/all.py": PYTHON, "README.md": PAGE.format("ros2 launch tools/all.py")}, []),
        ({"tools/all.py": "def generate(): pass\n"}, []),
        ({"docs/a.launch": NODE}, ["docs/a.launch"]),
        ({"docs/a.launch": NODE, "README.md": PAGE.format("roslaunch docs/a.launch")}, []),
    ],
)
def test_those_that_are_no_configuration_are_named(tmp_path: Path, files: dict[str, str], expected: list[str]) -> None:
    for path, text in {**NEWER, **files}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    found = [problem for problem in discover(tmp_path, (".",)).problems if "no package" in problem.message]
    assert [problem.path for problem in found] == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("roslaunch p a.launch x:=1", Commanded(frozenset({("p", "a.launch")}), frozenset())),
        ("$ ros2  launch -d p sub/a.py", Commanded(frozenset({("p", "a.py")}), frozenset())),
        ("`ros2 launch a.launch.py`", Commanded(frozenset(), frozenset({"a.launch.py"}))),
        ("ros2 launch ./x/a.xml # it", Commanded(frozenset(), frozenset({"x/a.xml"}))),
        ("ros2 launch p\n", Commanded(frozenset(), frozenset())),
        ("ros2 launch the files a.launch", Commanded(frozenset(), frozenset())),
        ("roslaunch is a tool, a.launch a file", Commanded(frozenset(), frozenset())),
        ("ros2 run p a.py", Commanded(frozenset(), frozenset())),
    ],
)
def test_commands(text: str, expected: Commanded) -> None:
    page = SourceFile("README.md", "markdown", 1, "")
    assert commanded([page], lambda path: text) == expected
    assert commanded([SourceFile("a.py", "python", 1, "")], lambda path: text) == Commanded(frozenset(), frozenset())
