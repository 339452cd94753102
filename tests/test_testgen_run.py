# SPDX-License-Identifier: Apache-2.0
"""``haros-ci testgen --run`` against running nodes of ROS 1, as Debian has it: a seeded bug is found and shrunk, the node without it passes, and
nothing that was started is left."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import uuid
from pathlib import Path
from typing import Any

import pytest
from commandline import TALKER_PACKAGE

ROSPY = Path("/usr/lib/python3/dist-packages/rospy")
pytestmark = pytest.mark.skipif(
    shutil.which("rosmaster") is None or not ROSPY.is_dir(),
    reason="ROS 1 of Debian is not here: apt-get install python3-rospy python3-rosmaster python3-roslaunch python3-std-msgs",
)

NODE = """\
#!/usr/bin/env python3
import os

import rospy
from std_msgs.msg import Int8

rospy.init_node('answerer')
ignored = rospy.get_param('~ignored', 1000)
out = rospy.Publisher('answer', Int8, queue_size=10)


def asked(message):
    if message.data == ignored:
        if rospy.get_param('~dies', False):
            os._exit(3)
        return
    out.publish(message)


rospy.Subscriber('ask', Int8, asked)
rospy.spin()
"""
LAUNCH = "<launch><node pkg='demo' type='talker.py' name='a'>{}</node></launch>"
PROJECT = """\
packages: [demo]
configurations:
  good:
    launch: [demo/launch/good.launch]
  bad:
    launch: [demo/launch/bad.launch]
  deadly:
    launch: [demo/launch/deadly.launch]
nodes:
  demo/talker.py:
    hpl:
      assumptions:
        - 'globally: no /ask {data < -100}'
      properties:
        - |
          # id: answers
          globally: /ask {data > 3} causes /answer within 200 ms
        - |
          # id: same
          globally: /answer as A requires /ask {data = @A.data} within 250 ms
"""
MARK = "HAROS_CI_TEST_MARK"


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    files = {
        **TALKER_PACKAGE,
        "src/demo/talker.py": NODE,
        "src/demo/launch/good.launch": LAUNCH.format(""),
        "src/demo/launch/bad.launch": LAUNCH.format("<param name='ignored' value='4'/>"),
        "src/demo/launch/deadly.launch": LAUNCH.format(
            "<param name='ignored' value='4'/><param name='dies' value='true'/>"
        ),
        "haros.yaml": PROJECT,
    }
    for name, text in files.items():
        path = tmp_path / "ws" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / "ws/src/demo/talker.py").chmod(0o755)
    return tmp_path / "ws"


def started(workspace: Path, *arguments: str, mark: str, packages: str = "") -> subprocess.Popen[str]:
    env = {
        **os.environ,
        "ROS_PACKAGE_PATH": packages or str(workspace / "src"),
        "PROPERTY_TESTS_REPORT": str(workspace.parent / "report.jsonl"),
        "ROS_HOME": str(workspace.parent / "ros"),
        MARK: mark,
    }
    return subprocess.Popen(
        [sys.executable, "-m", "haros_ci", "testgen", str(workspace.parent / "tests"), str(workspace), "--no-cache", *arguments],
        env=env, cwd=workspace, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip


def ran(workspace: Path, *arguments: str, packages: str = "") -> tuple[int, str]:
    mark = uuid.uuid4().hex
    with started(workspace, *arguments, mark=mark, packages=packages) as process:
        text, _ = process.communicate(timeout=240)
    assert left(mark) == []
    return process.returncode, text


def left(mark: str) -> list[str]:
    """What still runs of all that was started with this *mark* in its environment; there is a moment for what is ending."""
    found: list[str] = []
    for _ in range(600):  # a launcher gives its nodes up to 15 s; a machine with much other work is slow
        found = [path.parent.name for path in Path("/proc").glob("[0-9]*/environ") if _has(path, mark)]
        if not found:
            return []
        subprocess.run(["sleep", "0.05"], check=True)
    return found


def _has(path: Path, mark: str) -> bool:
    try:
        return f"{MARK}={mark}".encode() in path.read_bytes()
    except OSError:
        return False


def ask_one_property(workspace: Path) -> None:
    """The first one alone, as each takes its time."""
    (workspace / "haros.yaml").write_text(PROJECT[: PROJECT.index("        - |\n          # id: same")])


def reported(workspace: Path) -> dict[str, Any]:
    lines = [json.loads(line) for line in (workspace.parent / "report.jsonl").read_text().splitlines()]
    return {line["test"]: line for line in lines}


def test_a_seeded_bug_is_found_and_shrunk_and_the_trace_is_violated_offline(workspace: Path) -> None:
    ask_one_property(workspace)
    code, text = ran(workspace, "--configuration", "bad", "--run", "--examples", "20")
    assert code == 1, text
    assert "demo launch/bad.launch: /a (demo/talker.py)" in text
    lines = reported(workspace)
    assert lines["test_1_answers"]["result"] == "failed" and lines["test_1_answers"]["messages"] == [{"data": 4}]
    trace = workspace.parent / "tests/failures/test_1_answers.jsonl"
    command = [
        sys.executable,
        "-m",
        "haros_ci",
        "monitor",
        str(workspace),
        "--jsonl",
        str(trace),
        "--configuration",
        "bad",
        "--no-cache",
    ]
    held = subprocess.run([*command, "--property", "answers"], capture_output=True, text=True, cwd=workspace)
    assert held.returncode == 1 and "x violated" in held.stdout, held


def test_without_the_bug_it_passes(workspace: Path) -> None:
    code, text = ran(workspace, "--configuration", "good", "--run", "--examples", "8")
    assert code == 0, text
    lines = reported(workspace)
    assert {line["result"] for line in lines.values()} == {"passed"}
    assert all(line["exercised"] for line in lines.values())


def test_a_node_that_dies_is_a_failure(workspace: Path) -> None:
    ask_one_property(workspace)
    code, text = ran(workspace, "--configuration", "deadly", "--run", "--examples", "20")
    assert code == 1, text
    assert reported(workspace)["test_1_answers"]["messages"] == [{"data": 4}]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_nothing_is_left_of_a_run_that_is_interrupted(number: int, workspace: Path) -> None:
    mark = uuid.uuid4().hex
    with started(workspace, "--configuration", "good", "--run", "--examples", "5000", mark=mark) as process:
        assert process.stdout is not None
        while not any("talker.py" in command for command in _commands(mark)):
            assert process.poll() is None
            subprocess.run(["sleep", "0.05"], check=True)
        process.send_signal(number)
        process.communicate(timeout=60)
    assert left(mark) == []


def _commands(mark: str) -> list[str]:
    found = [path.parent / "cmdline" for path in Path("/proc").glob("[0-9]*/environ") if _has(path, mark)]
    return [text for path in found if (text := _text(path))]


def _text(path: Path) -> str:
    try:
        return path.read_text(errors="replace")
    except OSError:
        return ""


def test_a_system_that_does_not_start_is_trouble_and_no_violation(workspace: Path) -> None:
    code, text = ran(workspace, "--configuration", "good", "--run", "--examples", "2", packages="/nowhere")
    assert code == 3, text
    assert "there is no package demo: source the setup file of the built workspace" in text


def test_without_run_nothing_is_started(workspace: Path) -> None:
    code, text = ran(workspace, "--configuration", "good")
    assert code == 0 and text.strip().endswith("test_good_a.py")
    assert not (workspace.parent / "report.jsonl").exists()
