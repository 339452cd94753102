# SPDX-License-Identifier: Apache-2.0
"""What interface-break says of a change, beside where: the changes in words, hashes, users, and the level."""

from __future__ import annotations

from pathlib import Path

from haros_ci.analysis.architectures import project_of
from haros_ci.api.testing import read
from haros_ci.checking.page import filled
from haros_ci.checking.run import run_on_project
from haros_ci.registry import checks
from haros_ci.results.result import Result

(CHECK,) = (check for check in checks() if check.id == "interface-break")


def said(before: dict[str, str], after: dict[str, str], tmp_path: Path) -> tuple[Result, ...]:
    base = None
    for files, name in ((before, "base"), (after, "head")):
        workspace, made, systems = read(filled(files), tmp_path / name)
        base = project_of(made, workspace, systems, base)
    assert base is not None
    outcome = run_on_project((CHECK,), base, "haros-ci")
    assert not outcome.notifications
    return outcome.results


NODE = """import rclpy
from demo.msg import Pose, State

rclpy.init()
node = rclpy.create_node("listener")
sub = node.create_subscription(State, "state", print, 1)
print(Pose.UNKNOWN)
"""


def test_all_that_uses_it_is_related(tmp_path: Path) -> None:
    files = {"msg/State.msg": "Pose pose\n", "node.py": NODE}
    before = {**files, "msg/Pose.msg": "float64 x\nfloat64 y\nuint8 UNKNOWN=255\n"}
    (result,) = said(before, {**files, "msg/Pose.msg": "float32 x\nfloat64 y\nuint8 UNKNOWN=255\n"}, tmp_path)
    assert result.level.name == "WARNING" and result.subject == ("demo/Pose",)
    assert "field x: float64 → float32" in result.message and "RIHS01_" in result.message
    assert [(r.location.path, r.location.line, r.message) for r in result.related] == [
        ("node.py", 2, "imports it"),
        ("msg/State.msg", None, "demo/State contains it and changes with it"),
        ("node.py", 6, "/listener: subscriber /state, as a part of demo/State"),
        ("node.py", 2, "imports it, as a part of demo/State"),
    ]


def test_what_is_gone_and_still_used_is_an_error(tmp_path: Path) -> None:
    files = {"msg/State.msg": "Pose pose\n", "node.py": NODE}
    before = {**files, "msg/Pose.msg": "float64 x\nuint8 UNKNOWN=255\n"}
    (result,) = said(before, {**files, "msg/Pose.msg": "float64 x\n"}, tmp_path)
    assert result.level.name == "ERROR"
    assert "the type hash stays RIHS01_" in result.message and "node.py:7:7 still uses UNKNOWN" in result.message
    assert (result.related[0].location.path, result.related[0].location.line) == ("node.py", 7)


def test_what_is_gone_and_no_longer_used_is_a_warning(tmp_path: Path) -> None:
    before = {"msg/Pose.msg": "float64 x\nuint8 UNKNOWN=255\n", "node.py": NODE}
    after = {"msg/Pose.msg": "float64 x\n", "node.py": NODE.replace("Pose.UNKNOWN", "Other.UNKNOWN")}
    (result,) = said(before, after, tmp_path)
    assert result.level.name == "WARNING"


def test_many_changes_are_counted(tmp_path: Path) -> None:
    before = {"msg/Pose.msg": "".join(f"float64 f{n}\n" for n in range(9))}
    after = {"msg/Pose.msg": "".join(f"float32 f{n}\n" for n in range(9))}
    (result,) = said(before, after, tmp_path)
    assert "field f3: float64 → float32, 5 more changes" in result.message


def test_an_unknown_part_leaves_the_hash_out(tmp_path: Path) -> None:
    (result,) = said({"msg/A.msg": "other_msgs/X x"}, {"msg/A.msg": "other_msgs/X y"}, tmp_path)
    assert "hash" not in result.message and "field x renamed to y" in result.message
