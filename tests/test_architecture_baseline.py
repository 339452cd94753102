# SPDX-License-Identifier: Apache-2.0
"""Findings of the architecture through the real command: what a log says of them, and what a baseline keeps."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, haros, write
from mutations import LAUNCH_XML, LISTENER_CPP, ROS2, TALKER_CPP, system

from haros_ci import cli

RULE = "topic-type-mismatch"


def check(root: Path, *arguments: str) -> list[dict[str, Any]]:
    """The findings of that rule."""
    done = haros("check", *arguments, "--fail-on=never", "--output=json", "--profile=architecture", cwd=root)
    assert done.returncode == 0, done.stderr
    return [r for r in json.loads(done.stdout)["results"] if r["rule"] == RULE]


@pytest.fixture
def known(tmp_path: Path) -> Path:
    """A workspace whose one finding is in its baseline file; the launch file is in another package than the nodes."""
    apart = {path: text for path, text in ROS2.items() if path != LAUNCH_XML}
    root = write(tmp_path / "ws", {**apart, "other/package.xml": ROS2["walker/package.xml"].replace("walker", "other"),
                                   "other/launch/all.launch.xml": ROS2[LAUNCH_XML]})  # fmt: skip
    assert haros("baseline", "create", "--profile=architecture", cwd=root).returncode == 0
    assert RULE in (root / ".haros-ci-baseline.jsonl").read_text(encoding="utf-8")
    return root


class TestPartsOfAWorkspace:
    def test_the_whole_knows_it(self, known: Path) -> None:
        assert [r["state"] for r in check(known, "--baseline=.haros-ci-baseline.jsonl")] == ["unchanged"]

    @pytest.mark.parametrize("part", ["walker", "walker/src", "other", LISTENER_CPP, "walker/package.xml"])
    def test_a_part_takes_nothing_for_gone(self, known: Path, part: str) -> None:
        states = [r["state"] for r in check(known, "--baseline=.haros-ci-baseline.jsonl", part)]
        assert states in ([], ["unchanged"])

    @pytest.mark.parametrize(
        "arguments", [["walker"], [LISTENER_CPP], ["--profile=google"], ["--profile=architecture"]]
    )
    def test_an_update_keeps_it(self, known: Path, arguments: list[str]) -> None:
        before = (known / ".haros-ci-baseline.jsonl").read_text(encoding="utf-8")
        for command in ("update", "prune"):
            done = haros("baseline", command, *arguments, cwd=known)
            assert done.returncode == 0, done.stderr
        assert (known / ".haros-ci-baseline.jsonl").read_text(encoding="utf-8") == before

    def test_the_whole_takes_what_is_mended_for_gone(self, known: Path) -> None:
        write(known, {LISTENER_CPP: ROS2[LISTENER_CPP].replace("Int32", "String")})
        assert [r["state"] for r in check(known, "--baseline=.haros-ci-baseline.jsonl")] == ["absent"]
        assert haros("baseline", "prune", "--profile=architecture", cwd=known).returncode == 0
        assert RULE not in (known / ".haros-ci-baseline.jsonl").read_text(encoding="utf-8")


class TestLog:
    @pytest.fixture(scope="class")
    def logs(self, tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
        root = write(tmp_path_factory.mktemp("log") / "ws", ROS2)
        logs = {}
        for audience in ("archive", "github"):
            done = haros(
                "check",
                "--profile=architecture",
                f"--sarif-for={audience}",
                "--output=sarif",
                "--fail-on=never",
                cwd=root,
            )
            assert done.returncode == 0, done.stderr
            runs = json.loads(done.stdout)["runs"]
            [logs[audience]] = [run for run in runs if run["tool"]["driver"]["name"] == "haros-ci"]
        return logs

    def test_the_graph_and_the_way_through_it(self, logs: dict[str, dict[str, Any]]) -> None:
        run = logs["archive"]
        [result], [graph] = run["results"], run["graphs"]
        [traversal] = result["graphTraversals"]
        ends = {edge["id"]: (edge["sourceNodeId"], edge["targetNodeId"]) for edge in graph["edges"]}
        assert [ends[step["edgeId"]] for step in traversal["edgeTraversals"]] == [
            ("node:/first", "topic:/goal"), ("topic:/goal", "node:/second")]  # fmt: skip
        starts = {n["id"]: n["location"]["physicalLocation"] for n in graph["nodes"] if n["id"].startswith("node:")}
        assert starts["node:/first"]["artifactLocation"]["uri"] == LAUNCH_XML
        assert starts["node:/first"]["region"]["startLine"] == 2

    def test_the_way_through_the_code(self, logs: dict[str, dict[str, Any]]) -> None:
        for run in logs.values():
            [flow] = run["results"][0]["codeFlows"]
            steps = [step["location"] for step in flow["threadFlows"][0]["locations"]]
            places = [step["physicalLocation"]["artifactLocation"]["uri"] for step in steps]
            assert len(steps) > 1 and all(step["message"]["text"] for step in steps)
            assert {LAUNCH_XML, LISTENER_CPP} <= set(places)

    def test_what_it_is_about(self, logs: dict[str, dict[str, Any]]) -> None:
        for run in logs.values():
            [result] = run["results"]
            names = [
                n["fullyQualifiedName"] for n in result["locations"][0]["logicalLocations"] if n["kind"] == "rosName"
            ]
            assert {"/first", "/goal", "/second"} <= set(names)
            assert {"harosCiSubject/v1", "harosCiRoles/v1"} <= set(result["partialFingerprints"])
            [rule] = run["tool"]["driver"]["rules"]
            assert rule["properties"]["catalogueId"] == "G06"
            assert rule["properties"]["precision"] in ("very-high", "high", "medium", "low")

    def test_github_gets_no_graph(self, logs: dict[str, dict[str, Any]]) -> None:
        assert "graphs" not in logs["github"] and "graphTraversals" not in logs["github"]["results"][0]


def test_a_pull_request_is_told_of_what_it_breaks(tmp_path: Path) -> None:
    """The base has a mismatch; the change renames its topic, and makes another one."""
    root = write(tmp_path / "ws", ROS2)
    base = commit(root)
    more = "  rclcpp::spin"
    after = system(
        (TALKER_CPP, '"goal"', '"target"'), (LAUNCH_XML, 'to="goal"', 'to="target"'),
        (TALKER_CPP, more, '  auto b = node->create_publisher<std_msgs::msg::String>("b", 1);\n' + more),
        (LISTENER_CPP, more, '  auto b = node->create_subscription<std_msgs::msg::Int32>("b", 1, &take);\n' + more),
    )  # fmt: skip
    write(root, after)
    states = {" ".join(r["subject"]): r["state"] for r in check(root, f"--baseline-rev={base}")}
    assert {name for name, state in states.items() if state == "new"} == {"/b /first /second"}
    assert {name for name, state in states.items() if state == "updated"} == {"/first /second /target"}
    assert len(states) == 2


PART = "cmake_minimum_required(VERSION 3.8)\nproject({})\nfind_package(ament_cmake REQUIRED)\ninstall(DIRECTORY missing DESTINATION share)\nament_package()\n"
MANIFEST = (
    '<package format="3"><name>{}</name><version>0.1.0</version><description>d</description><maintainer email="a@b.org">A</maintainer>'
    "<license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>\n"
)


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("arm",), "1 finding is known now."),
        (("arm", "leg"), "2 findings are known now, check shows 1 of them together"),
    ],
)
def test_as_many_are_known_as_check_shows_or_it_says_why(
    names: tuple[str, ...],
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    write(tmp_path, {f"{name}/package.xml": MANIFEST.format(name) for name in names})
    write(tmp_path, {f"{name}/CMakeLists.txt": PART.format(name) for name in names})
    monkeypatch.chdir(tmp_path)
    assert cli.main(["baseline", "create", "--profile=architecture", "--no-cache"]) == 0
    assert said in capfd.readouterr().out
