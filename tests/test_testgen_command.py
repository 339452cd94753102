# SPDX-License-Identifier: Apache-2.0
"""``haros-ci testgen``: which properties become tests of what, under which names, and what is left out; nothing is run."""

from __future__ import annotations

from pathlib import Path

import pytest
from commandline import TALKER_PACKAGE

from haros_ci.cli import main

TALKER = """\
#!/usr/bin/env python3
import rospy
from std_msgs.msg import Empty, UInt8
from other_msgs.msg import Unknown

rospy.init_node('talker')
out = rospy.Publisher('level', UInt8, queue_size=1)
rospy.Subscriber('ask', UInt8, print)
rospy.Subscriber('stop', Empty, print)
rospy.Subscriber('odd', Unknown, print)
rospy.spin()
"""
FILES = {
    **TALKER_PACKAGE,
    "src/demo/talker.py": TALKER,
    "src/demo/launch/demo.launch": "<launch><arg name='x' default='0'/><node pkg='demo' type='talker.py' name='a' ns='robot'>"
    "<remap from='ask' to='/question'/></node><node pkg='demo' type='talker.py' name='b'/></launch>",
    "src/demo/launch/loop.launch": "<launch><node pkg='demo' type='talker.py' name='a'><remap from='ask' to='level'/></node></launch>",
}
PROJECT = """\
packages: [demo]
configurations:
  demo:
    launch: [demo/launch/demo.launch]
    args: {x: 1}
    hpl:
      assumptions:
        - 'globally: no /question {data = 9}'
      properties:
        - |
          # id: answers
          globally: /question causes /robot/level within 100 ms
        - 'globally: no /question {data > 200}'
        - 'globally: /nowhere causes /robot/level'
        - 'globally: no /robot/level {data ='
  loop:
    launch: [demo/launch/loop.launch]
nodes:
  demo/talker.py:
    hpl:
      properties:
        - |
          # id: asked
          globally: ask {data > 3} causes level
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in {**FILES, "haros.yaml": PROJECT}.items():
        path = tmp_path / "ws" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path


def test_a_file_for_the_configuration_and_for_each_node(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["testgen", "../t", ".", "--configuration", "demo", "--no-cache"]) == 0
    output = capsys.readouterr()
    names = ["test_demo.py", "test_demo_b.py", "test_demo_robot_a.py"]
    assert sorted(output.out.split()) == [f"../t/{name}" for name in names]
    assert "globally: /nowhere causes /robot/level: not tested" in output.err
    assert "nothing is sent on /odd" in output.err
    whole, second, first = ((workspace / "t" / name).read_text() for name in names)
    assert "Launch('demo', 'launch/demo.launch', ('x:=1',))" in whole
    assert "text='globally: /question causes /robot/level within 100 ms'" in whole and "def test_1_answers(" in whole
    assert "text='globally: /question {data > 3} causes /robot/level within 2 s'" in first
    assert "NODES = ['/robot/a']" in first and "Edge('/robot/a', '/question', False)" in first
    assert "text='globally: /ask {data > 3} causes /level within 2 s'" in second and "NODES = ['/b']" in second


def test_what_is_about_open_topics_alone_is_assumed(workspace: Path) -> None:
    assert main(["testgen", "../t", ".", "--configuration", "demo", "--no-cache"]) == 0
    text = (workspace / "t/test_demo.py").read_text()
    assumed = text[text.index("ASSUMPTIONS = [") :]
    assert "globally: no /question {data = 9}" in assumed and "globally: no /question {data > 200}" in assumed
    assert "test_2" not in text


def test_a_topic_that_the_node_publishes_itself_is_not_open(workspace: Path) -> None:
    assert main(["testgen", "../t", ".", "--configuration", "loop", "--no-cache"]) == 0
    text = (workspace / "t/test_loop_a.py").read_text()
    assert "TRIGGERS_1" not in text and "'/stop': 'std_msgs/Empty'" in text


def test_patience_is_the_bound_of_what_has_none(workspace: Path) -> None:
    assert main(["testgen", "../t", ".", "--configuration", "demo", "--patience", "0.5", "--no-cache"]) == 0
    text = (workspace / "t/test_demo_b.py").read_text()
    assert "causes /level within 500 ms'" in text and "what has not come within 0.5 s counts as missing" in text


def test_it_writes_the_same_again_and_nothing_over_other_files(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["testgen", "../t", ".", "--configuration", "demo", "--no-cache"]
    assert main(command) == 0
    before = {path: path.read_bytes() for path in (workspace / "t").rglob("*.py")}
    assert main(command) == 0
    assert before == {path: path.read_bytes() for path in (workspace / "t").rglob("*.py")}
    (workspace / "t/test_demo.py").write_text("mine")
    assert main(command) == 2
    assert (workspace / "t/test_demo.py").read_text() == "mine"
    assert "not of haros-ci testgen" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["test_demo.py", "property_tests/ros1.py"])
def test_no_link_of_a_workspace_leads_it_elsewhere(
    name: str, workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["testgen", "../t", ".", "--configuration", "demo", "--no-cache"]
    assert main(command) == 0
    place, outside = workspace / "t" / name, workspace / "outside.py"
    place.rename(outside)
    place.symlink_to(outside)
    before = outside.read_bytes()
    assert main(command) == 2 and "not of haros-ci testgen" in capsys.readouterr().err
    assert outside.read_bytes() == before and place.is_symlink()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--configuration", "nope"], "no configuration nope"),
        (["--configuration", "loop", "--isolated"], "no configuration loop"),
        (["--isolated", "--configuration", "demo/launch/demo.launch"], "no properties to test"),
    ],
)
def test_what_cannot_be(
    arguments: list[str], message: str, workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["testgen", "../t", ".", *arguments, "--no-cache"]) == 2
    assert message in capsys.readouterr().err
    assert not (workspace / "t").exists()


def test_a_node_that_no_launch_file_starts_has_no_tests(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in (workspace / "ws/src/demo/launch").iterdir():
        path.unlink()
    nodes = PROJECT[PROJECT.index("nodes:") :]
    (workspace / "ws/haros.yaml").write_text(f"packages: [demo]\n{nodes}")
    assert main(["testgen", "../t", ".", "--no-cache"]) == 2
    assert "no launch file starts" in capsys.readouterr().err
