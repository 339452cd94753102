# SPDX-License-Identifier: Apache-2.0
"""The same finding in copies of one text is one finding for who reads; a new copy is new, whatever is known of the others."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from commandline import commit, git, haros, write

LAUNCH = """<launch>
  <arg name="port" default="7"/>
  <node pkg="{name}" type="drive.py" name="drive"/>
</launch>
"""
MANIFEST = """<package format="2">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>{name}</description>
  <maintainer email="a@example.org">a</maintainer>
  <license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED)
catkin_package()
catkin_install_python(PROGRAMS scripts/drive.py DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})
install(DIRECTORY launch DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})
"""
DRIVE = "#!/usr/bin/env python3\nprint('hello')\n"


def variant(root: Path, name: str, launch: str = LAUNCH) -> None:
    write(
        root,
        {
            f"{name}/package.xml": MANIFEST.format(name=name),
            f"{name}/CMakeLists.txt": CMAKE.format(name=name),
            f"{name}/launch/drive.launch": launch.format(name=name),
            f"{name}/scripts/drive.py": DRIVE,
        },
    )
    (root / name / "scripts/drive.py").chmod(0o755)


def found(root: Path, *options: str, output: str = "json") -> list[dict[str, object]]:
    run = haros("check", ".", f"--output={output}", *options, cwd=root)
    assert run.returncode in (0, 1), run.stderr
    data = json.loads(run.stdout)
    results = data["results"] if output == "json" else [r for run in data["runs"] for r in run["results"]]
    key = "rule" if output == "json" else "ruleId"
    return [result for result in results if result[key] == "unused-launch-argument"]


def open_ones(root: Path, *options: str) -> list[dict[str, object]]:
    return [result for result in found(root, *options) if result["open"]]


@pytest.fixture
def robots(tmp_path: Path) -> Path:
    for name in ("walker_one", "walker_two", "walker_three"):
        variant(tmp_path, name)
    return tmp_path


def test_one_finding_names_the_copies(robots: Path) -> None:
    text = haros("check", ".", "--output=text", cwd=robots).stdout
    assert text.count("[haros-ci:unused-launch-argument]") == 1
    copies = "walker_three/launch/drive.launch, walker_two/launch/drive.launch"
    assert f"; and the same in 2 copies ({copies})" in " ".join(text.split())
    assert text.startswith("walker_one/launch/drive.launch:2:")


def test_programs_have_each_copy(robots: Path) -> None:
    first, *copies = open_ones(robots)
    assert (first["path"], first["copyOf"]) == ("walker_one/launch/drive.launch", None)
    assert {str(copy["path"]): copy["copyOf"] for copy in copies} == {
        f"walker_{n}/launch/drive.launch": {"path": "walker_one/launch/drive.launch", "line": 2}
        for n in ("two", "three")
    }
    assert not any("the same in" in str(result["message"]) for result in (first, *copies))
    assert "; and the same in 2 copies (walker_three" in str(first["shownAs"])
    assert [copy["shownAs"] for copy in copies] == [None, None]
    for option in ("--sarif-for=github", "--sarif-for=archive"):
        assert len(found(robots, option, output="sarif")) == 3
    assert len(json.loads(haros("check", ".", "--output=gitlab", cwd=robots).stdout)) == 3


@pytest.mark.parametrize(
    "other",
    [
        LAUNCH.replace("</launch>", '  <node pkg="{name}" type="drive.py" name="again"/>\n</launch>'),
        LAUNCH.replace('"7"', '"8"'),
        LAUNCH.replace('name="port"', 'name="baud"').replace("drive.py", "turn.py").replace('name="drive"', 'name="x"'),
        LAUNCH.replace("<launch>", "<launch>\n  <!-- not the same place -->\n  <group ns='a'/>"),
    ],
    ids=["one more node", "another number", "three other names", "other lines before"],
)
def test_other_texts_are_no_copies(tmp_path: Path, other: str) -> None:
    variant(tmp_path, "walker_one")
    variant(tmp_path, "walker_two", other)
    results = open_ones(tmp_path)
    assert sum(" but never read" in str(result["message"]) for result in results) == 2
    assert not any(result["copyOf"] for result in results)


def test_a_new_copy_is_new_against_a_revision(robots: Path) -> None:
    git(robots, "init", "-q", "-b", "main")
    commit(robots)
    assert open_ones(robots, "--baseline-rev=HEAD") == []
    variant(robots, "walker_four")
    (result,) = open_ones(robots, "--baseline-rev=HEAD")
    assert (result["path"], result["copyOf"]) == ("walker_four/launch/drive.launch", None)


def test_the_first_mended_leaves_the_others_known(robots: Path) -> None:
    git(robots, "init", "-q", "-b", "main")
    commit(robots)
    variant(robots, "walker_one", '<launch>\n  <node pkg="{name}" type="drive.py" name="drive"/>\n</launch>\n')
    results = found(robots, "--baseline-rev=HEAD")
    assert [result["state"] for result in results if result["path"] != "walker_one/launch/drive.launch"] == [
        "unchanged",
        "unchanged",
    ]
    assert not any(result["open"] for result in results)


@pytest.mark.parametrize("kind", ["log", "file"])
def test_a_baseline_file_knows_every_copy(robots: Path, tmp_path_factory: pytest.TempPathFactory, kind: str) -> None:
    known = tmp_path_factory.mktemp("known") / "known"
    if kind == "log":
        run = haros("check", ".", f"--output=sarif={known}", cwd=robots)
    else:
        run = haros("baseline", "create", ".", f"--file={known}", cwd=robots)
    assert known.exists(), run.stderr
    option = f"--baseline={known}"
    assert open_ones(robots, option) == []
    assert {result["state"] for result in found(robots, option)} == {"unchanged"}
    variant(robots, "walker_four")
    (result,) = open_ones(robots, option)  # the fourth alone
    assert result["path"] == "walker_four/launch/drive.launch"
