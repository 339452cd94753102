# SPDX-License-Identifier: Apache-2.0
"""``haros-ci hpl suggest`` and ``haros-ci model --dependence``: what the code suggests, and what is printed of the dependence."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml
from commandline import TALKER_PACKAGE

from haros_ci.behaviour.parser import parse_property
from haros_ci.cli import main

CODE = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String

class Relay:
    def __init__(self):
        self.last = String()
        self.pub = rospy.Publisher("b", String, queue_size=1)
        self.slow = rospy.Publisher("slow", String, queue_size=1)
        self.some = rospy.Publisher("some", String, queue_size=1)
        self.sub = rospy.Subscriber("a", String, self.got)
        self.other = rospy.Subscriber("c", String, self.gone)
        self.timer = rospy.Timer(rospy.Duration(0.1), self.tick)

    def got(self, message):
        self.last = message
        self.pub.publish(message)

    def gone(self, message):
        if message.data:
            self.some.publish(message)

    def tick(self, event):
        self.slow.publish(self.last)

rospy.init_node("relay")
relay = Relay()
rospy.spin()
"""
FILES = {
    **TALKER_PACKAGE,
    "src/demo/relay.py": CODE,
    "src/demo/launch/demo.launch": "<launch><node pkg='demo' type='relay.py' name='r'/></launch>",
}
#: What is suggested, and nothing else: not that /c causes /some, which a condition decides.
SUGGESTED = [
    "globally: /a causes /b",
    "globally: /a causes /slow within 200 ms",
    "globally: /b requires /a",
    "globally: /some requires /c",
]


@pytest.fixture(autouse=True)
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main([*arguments, "--no-cache"]) == 0
    return capsys.readouterr().out


def test_suggestions_are_a_project_file_that_our_parser_reads(capsys: pytest.CaptureFixture[str]) -> None:
    text = printed(capsys, "hpl", "suggest")
    (block,) = yaml.safe_load(text)["configurations"].values()
    assert block["hpl"]["properties"] == SUGGESTED
    for line in SUGGESTED:
        parse_property(line)
    assert "src/demo/relay.py:17" in text  # the evidence


def test_no_file_is_taken_with_suggest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["hpl", "suggest", "haros.yaml", "--no-cache"]) == 2
    assert "takes no files" in capsys.readouterr().err


def test_text_has_a_line_for_each_way(capsys: pytest.CaptureFixture[str]) -> None:
    lines = printed(capsys, "model", "--dependence").splitlines()
    found = [line.strip() for line in lines[lines.index("  dependence:") :]]
    assert "/a publishes /b" in found
    assert "/a publishes /slow (through state last)" in found
    assert "/c publishes /some (if message.data [field data])" in found


def test_json_has_conditions_and_places(capsys: pytest.CaptureFixture[str]) -> None:
    (configuration,) = json.loads(printed(capsys, "model", "--dependence", "--format", "json"))["configurations"]
    (node,) = configuration["dependence"]
    some = next(one for one in node["outputs"] if one["name"] == "/some")
    assert some["reason"] is None and [cause["name"] for cause in some["causes"]] == ["/c"]
    (when,) = some["causes"][0]["conditions"]
    assert (when["text"], when["met"], when["reads"]) == ("message.data", True, ["field data"])
    assert [step["location"]["line"] for step in some["causes"][0]["path"]] == [12, 21]
    assert "slices" not in configuration


@pytest.mark.parametrize(
    ("option", "name", "expected"),
    [
        ("--affects", "/a", {("/a", "/b"), ("/a", "/slow")}),
        ("--affects", "/c", {("/c", "/some")}),
        ("--caused-by", "/slow", {("/a", "/slow"), ("", "/slow")}),
    ],
)
def test_slices(capsys: pytest.CaptureFixture[str], option: str, name: str, expected: set[tuple[str, str]]) -> None:
    (configuration,) = json.loads(printed(capsys, "model", option, name, "--format", "json"))["configurations"]
    (found,) = configuration["slices"]
    assert {(step["from"]["name"], step["to"]["name"]) for step in found["steps"]} == expected


def test_a_name_that_nobody_has_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "--affects", "/slo", "--no-cache"]) == 2
    assert "no node is on /slo" in capsys.readouterr().err


def test_graphs_have_an_edge_for_each_way(capsys: pytest.CaptureFixture[str]) -> None:
    dot = printed(capsys, "model", "--dependence", "--format", "dot")
    assert dot.count(" -> ") == 4 and dot.startswith("digraph dependence {") and "style=dashed" in dot
    mermaid = printed(capsys, "model", "--dependence", "--format", "mermaid")
    assert mermaid.count(" -->|") + mermaid.count(" -.->|") == 4 and "```mermaid" in mermaid
