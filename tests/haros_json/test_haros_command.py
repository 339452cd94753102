# SPDX-License-Identifier: Apache-2.0
"""The real command writes the folder, only where it is asked to, and the same one twice."""

from __future__ import annotations

import json
from pathlib import Path

import haros_kit as kit
import pytest
from commandline import commit, haros, write

FILES = {
    "src/pub/package.xml": (
        '<package format="2"><name>pub</name><version>1.2.0</version><description>Says <b>much</b>.</description>'
        '<maintainer email="m@example.org">M</maintainer><license>Apache-2.0</license><author>A</author>'
        '<url type="repository">https://example.org/pub</url><buildtool_depend>catkin</buildtool_depend>'
        "<depend>roscpp</depend><depend>std_msgs</depend></package>"
    ),
    "src/pub/CMakeLists.txt": (
        "cmake_minimum_required(VERSION 3.5)\nproject(pub)\nfind_package(catkin REQUIRED COMPONENTS roscpp std_msgs)\n"
        "catkin_package()\nadd_executable(pub src/pub.cpp)\ntarget_link_libraries(pub ${catkin_LIBRARIES})\n"
    ),
    "src/pub/src/pub.cpp": (
        "#include <ros/ros.h>\n#include <std_msgs/String.h>\n\nint main(int argc, char** argv)\n{\n"
        '  ros::init(argc, argv, "pub");\n  ros::NodeHandle nh;\n'
        '  ros::Publisher p = nh.advertise<std_msgs::String>("chatter", 10);\n  ros::spin();\n  return 0;\n}\n'
    ),
    "src/pub/launch/both.launch": (
        '<launch><node pkg="pub" type="pub" name="a"/><node pkg="pub" type="pub" name="b"/></launch>\n'
    ),
    ".haros-ci.yaml": (
        "project: Two Talkers\nconfigurations:\n  both:\n    launch: [pub/launch/both.launch]\n"
        "rules:\n  crowded:\n    name: One publisher\n    description: Said twice\n    tags: [mine]\n"
        '    scope: configuration\n    query: "topics[len(self.publishers) > 1]"\n'
    ),
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = write(tmp_path_factory.mktemp("viz") / "ws", FILES)
    commit(root)
    return root


def test_a_folder_that_the_visualizer_can_show(workspace: Path) -> None:
    out = workspace.parent / "data"
    asked = ("check", ".", "--profile", "architecture", "--output", f"haros-json={out}", "--output", "text")
    done = haros(*asked, cwd=workspace)
    assert done.returncode == 1, done.stderr
    texts = {path.relative_to(out).as_posix(): path.read_text() for path in out.rglob("*") if path.is_file()}
    found = kit.read(texts)
    (issue,) = found["Two Talkers/compliance/runtime/both.json"]
    assert issue["rule"] == "user:crowded"
    assert issue["resources"] == [{"name": "/chatter", "resourceType": "topic"}]
    (system,) = found["Two Talkers/configurations.json"]
    assert [one["name"] for one in system["nodes"]] == ["/a", "/b"]
    (package,) = found["Two Talkers/packages.json"]
    assert (package["description"], package["authors"], package["repository"]) == (
        "Says much.",
        ["A"],
        "https://example.org/pub",
    )
    summary = found["Two Talkers/summary.json"]
    assert summary["history"]["timestamps"] == ["2024-01-01-00-00"]
    assert summary["components"]["nodes"] == 1
    assert summary["analysis"]["userRules"] == 1
    main = [one for one in found["Two Talkers/metrics/pub.json"] if one["location"]["function"] == "main"]
    assert ("cyclomatic_complexity", 1) in [(one["metric"], one["value"]) for one in main]

    again = haros(*asked, "--no-cache", cwd=workspace)
    assert again.stdout == done.stdout
    assert {path.relative_to(out).as_posix(): path.read_text() for path in out.rglob("*") if path.is_file()} == texts


def test_nothing_of_it_is_written_or_loaded_unasked(workspace: Path) -> None:
    before = {path for path in workspace.rglob("*") if ".git" not in path.parts}
    done = haros(
        "check", ".", "--profile", "architecture", "--output", f"json={workspace.parent / 'r.json'}", cwd=workspace
    )
    assert done.returncode == 1
    assert {path for path in workspace.rglob("*") if ".git" not in path.parts} == before
    assert json.loads((workspace.parent / "r.json").read_text())["results"]


def test_a_file_in_the_way_is_a_mistake_of_the_user(workspace: Path) -> None:
    done = haros("check", ".", "--output", "haros-json=.haros-ci.yaml", cwd=workspace)
    assert done.returncode == 2
    assert ".haros-ci.yaml is no directory" in done.stderr
    assert (workspace / ".haros-ci.yaml").read_text() == FILES[".haros-ci.yaml"]
