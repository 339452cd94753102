# SPDX-License-Identifier: Apache-2.0
"""``haros-ci query``: what it prints, and its exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from haros_ci.cli import main

NODE = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String, Empty
rospy.init_node('talker')
out = rospy.Publisher('/chatter', String, queue_size=0)
stop = rospy.Subscriber('stop', Empty, print)
rospy.spin()
"""
PROJECT = """
project: Demo
configurations:
  demo:
    launch: [demo/launch/demo.launch]
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "src" / "demo"
    for path, text in {
        "package.xml": "<package><name>demo</name><version>1.0.0</version><description>d</description>"
        "<maintainer email='a@b.c'>a</maintainer><license>x</license><run_depend>rospy</run_depend></package>",
        "CMakeLists.txt": "project(demo)\nfind_package(catkin)\ncatkin_package()\ncatkin_install_python(PROGRAMS talker.py"
        " DESTINATION bin)\n",
        "talker.py": NODE,
        "launch/demo.launch": "<launch><node pkg='demo' type='talker.py' name='a'/><node pkg='demo' type='talker.py' name='b'/></launch>",
    }.items():
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (package / path).write_text(text, encoding="utf-8")
    (tmp_path / "haros.yaml").write_text(PROJECT, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def ask(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(["query", *arguments, "--no-cache"])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_matches_are_printed_one_a_line(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = ask(capsys, "topics[len(self.publishers) > 1]")
    assert code == 0
    assert out == "src/demo/talker.py:5:7: Topic('/chatter', std_msgs/String) [demo]\n"


def test_nothing_is_printed_where_nothing_matches(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ask(capsys, "topics[len(self.publishers) > 2]", ".", "--fail-on-match")[:2] == (0, "")


def test_a_match_can_fail(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ask(capsys, "topics/publishers[self.queue_size == 0]", "--fail-on-match")[0] == 1


def test_json_has_the_entities(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "for p in <nodes/publishers> where p.node.id == '/a' return 'p': p, 'n': 1"
    code, out, _ = ask(capsys, text, "--format", "json")
    assert code == 0
    assert json.loads(out) == [
        {
            "configuration": "demo",
            "match": {
                "p": {
                    "kind": "PublishLink",
                    "text": "Publication of node '/a' to topic '/chatter' of type 'std_msgs/String'",
                    "names": ["/a", "/chatter"],
                    "location": {"path": "src/demo/talker.py", "line": 5, "column": 7},
                    "source": ["source"],
                },
                "n": 1,
            },
        }
    ]
    assert json.loads(ask(capsys, "topics[1 > 2]", "--format", "json")[1]) == []


def test_the_query_may_be_in_a_file(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (workspace / "q.txt").write_text("nodes // all\n[self.rosname.own == 'b']/id", encoding="utf-8")
    assert ask(capsys, "--file", "q.txt")[:2] == (0, "'/b' [demo]\n")
    assert ask(capsys, ".", "--file", "q.txt")[:2] == (0, "'/b' [demo]\n")


def test_launch_and_configuration_choose_systems(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ask(capsys, "config/name", ".", "--isolated")[1] == "'demo/launch/demo.launch' [demo/launch/demo.launch]\n"
    assert ask(capsys, "config/name", ".", "--launch", "demo/launch/demo.launch")[1].startswith("'command line'")
    code, _, err = ask(capsys, "nodes", ".", "--configuration", "nope")
    assert (code, "no configuration nope" in err) == (2, True)


def test_other_scopes(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = ask(capsys, "nodes/advertise[is_rosglobal(self.name)]", ".", "--scope", "global")[1]
    assert out == "src/demo/talker.py:5:7: AdvertiseCall(/chatter, , std_msgs/String)\n"
    assert ask(capsys, "package/name", ".", "--scope", "package")[1] == "'demo'\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("topcs", "error: query, line 1, column 1: there is no variable 'topcs'\nhelp: did you mean 'topics'?"),
        (
            "topics[self.nme == 1]",
            "error: query, line 1, column 13: a Topic has no attribute 'nme'\nhelp: did you mean 'name'?",
        ),
        ("topics[", "the query ends here instead of a value"),
        ("nodes/name[1 / 0]", "division by zero"),
    ],
)
def test_a_wrong_query_ends_with_2(workspace: Path, capsys: pytest.CaptureFixture[str], text: str, said: str) -> None:
    code, out, err = ask(capsys, text)
    assert (code, out) == (2, "")
    assert said in err
    assert "^\n" in err


def test_a_step_that_leads_nowhere_is_noted(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = ask(capsys, "nodes/publisher")
    assert (code, out) == (0, "")
    assert "note: line 1, column 7: a NodeInstance has no attribute 'publisher'" in err


def test_without_a_query_it_says_what_to_do(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, _, err = ask(capsys)
    assert (code, "no query" in err) == (2, True)
