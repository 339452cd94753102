# SPDX-License-Identifier: Apache-2.0
"""``haros-ci monitor --generate``: which files are written, and that they say of a recording what ``haros-ci monitor`` says."""

from __future__ import annotations

import json
import py_compile
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from test_monitor_command import FILES, PROJECT

from haros_ci.cli import main

ACTIONS = "      on_violation: {answers: [{publish: /robot/level, message: {data: 0}}], '*': [{log: error}]}\n"
SECOND = """\
  other:
    launch: [demo/launch/other.launch]
    hpl: {properties: ['globally: no /level {data > 3}']}
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in {**FILES, "haros.yaml": PROJECT}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def generate(*arguments: str) -> int:
    return main(["monitor", "--generate", "out", "--no-cache", *arguments])


def ran(path: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The file in an interpreter that sees neither haros-ci nor anything else but the standard library."""
    command = [sys.executable, "-I", "-S", "-W", "error", str(path), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_it_judges_as_the_command_does(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows: list[tuple[str, float, Any]] = [
        ("/question", 5, {"data": 1}), ("/robot/level", 5.05, {"data": 7}), ("/unknown", 5.5, {}), ("/question", 6, {"data": 9}),
        ("/robot/level", 6.1, {"dat": 7}), ("/robot/level", 6.2, {"data": 101}), ("level", 6.3, {"data": 1}),
    ]  # fmt: skip
    lines = [json.dumps({"topic": topic, "time": time, "msg": sent}) for topic, time, sent in rows]
    Path("run.jsonl").write_text("\n".join([*lines, "no JSON", ""]), encoding="utf-8")
    assert generate() == 0
    assert main(["monitor", "--jsonl", "run.jsonl", "--no-cache", "--output", "json"]) == 1
    theirs = json.loads(capsys.readouterr().out)
    done = ran(workspace / "out/monitor_demo.py", "--jsonl", "run.jsonl", "--report", "report.json")
    assert (done.returncode, done.stderr) == (1, "")
    ours = json.loads(Path("report.json").read_text(encoding="utf-8"))
    assert {key: ours["recording"][key] for key in ("name", "messages", "begin", "end", "topics")} == {
        key: theirs["recording"][key] for key in ("name", "messages", "begin", "end", "topics")
    }
    reasons = ("faults", "warning", "reason")
    plain = [{key: value for key, value in one.items() if key not in reasons} for one in ours["properties"]]
    assert plain == [{key: value for key, value in one.items() if key != "reason"} for one in theirs["properties"]]
    assert main(["report", "--verdicts", "report.json", "--output", "page.html", "--no-cache"]) == 0


def test_a_file_for_each_configuration_with_properties(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("haros.yaml").write_text(PROJECT.replace("nodes:\n", f"{SECOND}nodes:\n"), encoding="utf-8")
    assert generate() == 0
    assert sorted(path.name for path in Path("out").iterdir()) == ["monitor_demo.py", "monitor_other.py"]
    said = capsys.readouterr().err
    assert "out/monitor_demo.py" in said and "haros.yaml:13:45: is no HPL" in said
    first = Path("out/monitor_demo.py").read_bytes()
    assert generate("--configuration", "demo") == 0
    assert Path("out/monitor_demo.py").read_bytes() == first and first.isascii()
    for path in Path("out").iterdir():
        py_compile.compile(str(path), doraise=True)


def test_actions_get_the_types_of_the_model(workspace: Path) -> None:
    Path("haros.yaml").write_text(
        PROJECT.replace("      assumptions:", f"{ACTIONS}      assumptions:"), encoding="utf-8"
    )
    assert generate() == 0
    text = Path("out/monitor_demo.py").read_text(encoding="utf-8")
    assert "'answers': [{'publish': '/robot/level', 'type': 'std_msgs/UInt8', 'message': {'data': 0}}]" in text
    assert "'*': [{'log': 'error'}]" in text


@pytest.mark.parametrize(
    ("actions", "said"),
    [
        ("{answers: [{publish: /nothing}]}", "the type of /nothing is not known"),
        ("{answers: [{call: /nothing}]}", "the type of /nothing is not known"),
    ],
)
def test_actions_without_a_type(actions: str, said: str, workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("haros.yaml").write_text(
        PROJECT.replace("      assumptions:", f"      on_violation: {actions}\n      assumptions:"), encoding="utf-8"
    )
    assert generate() == 2
    assert said in capsys.readouterr().err


def test_actions_of_no_property_are_named(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("haros.yaml").write_text(
        PROJECT.replace("      assumptions:", "      on_violation: {nobody: [{log: info}]}\n      assumptions:"),
        encoding="utf-8",
    )
    assert generate() == 0
    assert "on_violation names nobody, and no property has this id" in capsys.readouterr().err


@pytest.mark.parametrize(
    "flags", [("--jsonl", "x"), ("--bag", "x"), ("--export", "rosmonitoring"), ("--output", "json")]
)
def test_it_has_no_recording_and_no_output(
    flags: tuple[str, str], workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert generate(*flags) == 2
    assert "--generate reads no recording" in capsys.readouterr().err


def test_a_link_in_place_of_the_file_is_replaced(workspace: Path) -> None:
    assert generate() == 0
    place, outside = workspace / "out/monitor_demo.py", workspace / "outside.py"
    outside.write_text("mine", encoding="utf-8")
    place.unlink()
    place.symlink_to(outside)
    assert generate() == 0
    assert outside.read_text(encoding="utf-8") == "mine" and not place.is_symlink()


def test_without_properties_there_is_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for path, text in FILES.items():
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text(text, encoding="utf-8")
    assert generate() == 2
    assert "there are no properties" in capsys.readouterr().err and not Path("out").exists()


def test_usage_and_what_is_not_there(workspace: Path) -> None:
    assert generate() == 0
    path = workspace / "out/monitor_demo.py"
    assert ran(path, "--nonsense").returncode == 2
    nothing = ran(path, "--jsonl", "nothing.jsonl")
    assert nothing.returncode == 3 and "nothing.jsonl" in nothing.stderr
    without = ran(path)
    assert without.returncode == 3 and "ROS 1 is not at hand" in without.stderr
