# SPDX-License-Identifier: Apache-2.0
"""``haros-ci policy``: what it writes, and that the check of policies is content with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.cli import main

FILES = {
    "package.xml": "<package format='3'><name>demo</name><version>1.0.0</version>"
    "<description>d</description><maintainer email='a@b.org'>a</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>"
    "<depend>rclpy</depend><export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": "project(demo)\nfind_package(ament_cmake)\ninstall(PROGRAMS talker.py DESTINATION lib/demo)\n"
    "install(DIRECTORY launch DESTINATION share/demo)\nament_package()\n",
    "talker.py": "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\nfrom std_srvs.srv import Trigger\n\n"
    "rclpy.init()\nnode = rclpy.create_node('talker')\nnode.create_publisher(String, 'chatter', 10)\n"
    "node.create_client(Trigger, '~/reset')\nrclpy.spin(node)\n",
    "launch/demo.launch.xml": "<launch><arg name='ns' default='left'/><node pkg='demo' exec='talker.py' namespace='$(var ns)'/></launch>",
}


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in FILES.items():
        (tmp_path / "demo" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "demo" / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main([*arguments, "--no-cache"])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_a_launch_file_becomes_a_policy(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, "policy", "demo/launch/demo.launch.xml", "--arg", "ns:=right")
    assert (code, err) == (0, "")
    assert '<enclave path="/right/talker">' in out and '<profile ns="/right" node="talker">' in out
    assert "<topic>chatter</topic>" in out and "<service>~/reset</service>" in out and "<topic>/clock</topic>" in out


def test_the_check_is_content_with_what_was_written(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "policy", "--output", "demo/demo.policy.xml")[0] == 0
    check = ("check", ".", "--profile", "architecture", "--select", "security-policy-mismatch", "--output", "text")
    _, out, _ = run(capsys, *check)
    assert "security-policy-mismatch" not in out
    policy = workspace / "demo" / "demo.policy.xml"
    policy.write_text(policy.read_text().replace("<topic>chatter</topic>", "<topic>gossip</topic>"))
    code, out, _ = run(capsys, *check)
    assert code == 1 and "publishes /left/chatter" in out and "publish /left/gossip" in out


def test_wrong_usage_ends_with_2(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, _, err = run(capsys, "policy", "--arg", "ns:=right")
    assert (code, "--arg is for launch files" in err) == (2, True)
    (workspace / "demo" / "talker.py").unlink()
    (workspace / "demo" / "launch" / "demo.launch.xml").unlink()
    code, _, err = run(capsys, "policy")
    assert (code, "no node of ROS 2" in err) == (2, True)
