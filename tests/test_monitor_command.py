# SPDX-License-Identifier: Apache-2.0
"""``haros-ci monitor``: which properties of which configuration, under which names, what is said, and the exit codes."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from io import StringIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from commandline import TALKER_PACKAGE

from haros_ci.cli import main

TALKER = """\
#!/usr/bin/env python3
import rospy
from std_msgs.msg import UInt8

rospy.init_node('talker')
out = rospy.Publisher('level', UInt8, queue_size=1)
rospy.Subscriber('ask', UInt8, print)
rospy.spin()
"""
FILES = {
    **TALKER_PACKAGE,
    "src/demo/talker.py": TALKER,
    "src/demo/launch/demo.launch": "<launch><node pkg='demo' type='talker.py' name='a' ns='robot'>"
    "<remap from='ask' to='/question'/></node><node pkg='demo' type='talker.py' name='b'/></launch>",
    "src/demo/launch/other.launch": "<launch><node pkg='demo' type='talker.py' name='c'/></launch>",
}
PROJECT = """\
packages: [demo]
configurations:
  demo:
    launch: [demo/launch/demo.launch]
    hpl:
      assumptions:
        - 'globally: no /question {data = 9}'
      properties:
        - |
          # id: answers
          globally: /question causes /robot/level within 100 ms
        - 'globally: no /robot/level {data > 100}'
        - 'globally: no /robot/level {data ='
nodes:
  demo/talker.py:
    hpl:
      properties:
        - |
          # id: asked
          globally: level requires ask
"""
Row = tuple[str, float, int]


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in {**FILES, "haros.yaml": PROJECT}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def record(path: Path, *rows: Row) -> str:
    file = path / "run.jsonl"
    file.write_text("".join(json.dumps({"topic": t, "time": s, "msg": {"data": d}}) + "\n" for t, s, d in rows))
    return str(file)


def verdicts(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, dict[str, str], Any]:
    code = main(["monitor", *arguments, "--no-cache", "--output", "json"])
    said = json.loads(capsys.readouterr().out)
    return code, {f"{each['id']} {each['node'] or ''}".strip(): each["verdict"] for each in said["properties"]}, said


QUESTION, LEVEL = "/question", "/robot/level"


def test_properties_of_a_configuration_and_its_nodes(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = record(workspace, (QUESTION, 5, 1), (LEVEL, 5.05, 7), (QUESTION, 6, 9), (LEVEL, 6.1, 7), (LEVEL, 6.2, 101))
    code, found, said = verdicts(capsys, "--jsonl", run)
    assert code == 1
    assert found == {
        "globally: no /question {data = 9}": "violated",
        "answers": "violated",
        "globally: no /robot/level {data > 100}": "violated",
        "asked /robot/a": "held",
        "asked /b": "never exercised",
    }
    (late,) = (each for each in said["properties"] if each["id"] == "answers")
    assert (late["time"], late["path"], late["line"]) == (6.1, "haros.yaml", 10)
    assert [(each["role"], each["number"], each["time"]) for each in late["witnesses"]] == [("trigger", 3, 6.0)]
    (above,) = (each for each in said["properties"] if "100" in each["id"])
    assert above["witnesses"][0]["publishers"] == [{"node": "/robot/a", "path": "src/demo/talker.py", "line": 6}]
    assert said["recording"]["notes"] == ["haros.yaml:13:45: is no HPL; haros-ci hpl says why"]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--property", "answers"), (1, {"answers": "violated"})),
        (("--property", "globally: some /question"), (0, {"globally: some /question": "held"})),
        (("--property", "globally: some /question", "--property", "asked"), (0, {
            "globally: some /question": "held", "asked /robot/a": "held", "asked /b": "never exercised"})),
        (("--property", "globally: some /question", "--configuration", "demo"), (0, {"globally: some /question": "held"})),
        (("--property", "answers", "--fail-on", "never"), (0, {"answers": "violated"})),
        (("--property", "until /question: no /robot/level"), (0, {"until /question: no /robot/level": "held"})),
    ],
)  # fmt: skip
def test_properties_that_are_asked_for(
    workspace: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], expected: object
) -> None:
    run = record(workspace, (QUESTION, 6, 9), (LEVEL, 6.1, 7))
    assert verdicts(capsys, "--jsonl", run, *arguments)[:2] == expected


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((), "one recording is needed"),
        (("--bag", "x", "--jsonl", "y"), "one recording is needed"),
        (("--jsonl", "none"), "cannot be read"),
        (("--jsonl", "run.jsonl", "--property", "no such"), "is no id of a property, and no HPL"),
        (
            ("--jsonl", "run.jsonl", "--property", "globally: no /a {x = @B.y}"),
            "no event before this one has the alias B",
        ),
        (("--jsonl", "run.jsonl", "--configuration", "none"), "no configuration none"),
        (("--jsonl", "run.jsonl", "--output", "unheard"), "unknown format"),
    ],
)
def test_wrong_usage(
    workspace: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], text: str
) -> None:
    record(workspace, (QUESTION, 6, 9))
    assert main(["monitor", *arguments, "--no-cache"]) == 2
    assert text in capsys.readouterr().err


def test_without_a_project_file_a_configuration_is_named(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (workspace / "haros.yaml").unlink()
    run = record(workspace, (QUESTION, 6, 9))
    assert main(["monitor", "--jsonl", run, "--no-cache"]) == 2
    assert "the workspace has several configurations, and none is named" in capsys.readouterr().err
    assert verdicts(capsys, "--jsonl", run, "--property", "globally: no /question")[0] == 1


def test_the_text_has_a_timeline_and_moves_no_cursor(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = record(workspace, (QUESTION, 0, 1), (QUESTION, 5, 1), ("/\x1b[2J", 10, 7))
    assert main(["monitor", "--jsonl", run, "--no-cache", "--property", "globally: no /question {data = 1}"]) == 1
    text = capsys.readouterr().out
    assert "x violated: globally: no /question {data = 1}" in text and "|x-----" in text and "\x1b" not in text


def test_findings_stand_at_the_property_and_lead_over_the_publishers(workspace: Path) -> None:
    run = record(workspace, (QUESTION, 5, 1), (LEVEL, 6, 101))
    assert (
        main(["monitor", "--jsonl", run, "--no-cache", "--output", "sarif=run.sarif", "--output", "junit=run.xml"]) == 1
    )
    (log,) = json.loads((workspace / "run.sarif").read_text())["runs"]
    found = {each["ruleId"]: each for each in log["results"] if "100}" in each["message"]["text"]}
    result = found["hpl-violated"]
    place = result["locations"][0]["physicalLocation"]
    assert (place["artifactLocation"]["uri"], place["region"]["startLine"]) == ("haros.yaml", 12)
    (step,) = result["codeFlows"][0]["threadFlows"][0]["locations"]
    assert step["location"]["physicalLocation"]["artifactLocation"]["uri"] == "src/demo/talker.py"
    assert "t = +1.000 s: behaviour on /robot/level with data = 101" in step["location"]["message"]["text"]
    assert "hpl-violated" in (workspace / "run.xml").read_text()


def test_the_code_flow_is_in_the_order_of_the_messages(workspace: Path) -> None:
    run = record(workspace, (LEVEL, 5, 1), ("/level", 5.5, 2))
    text = "globally: /robot/level forbids /level within 1 s"
    arguments = ["--jsonl", run, "--no-cache", "--configuration", "demo", "--property", text]
    assert main(["monitor", *arguments, "--output", "sarif=run.sarif"]) == 1
    (log,) = json.loads((workspace / "run.sarif").read_text())["runs"]
    (result,) = log["results"]
    steps = [one["location"] for one in result["codeFlows"][0]["threadFlows"][0]["locations"]]
    assert [one["message"]["text"].split(";")[0] for one in steps] == [
        "t = +0.000 s: trigger on /robot/level",
        "t = +0.500 s: behaviour on /level",
    ]
    assert [one["message"]["text"].split(";")[1] for one in steps] == [
        " /robot/a publishes it here.",
        " /b publishes it here.",
    ]
    assert {one["physicalLocation"]["region"]["startLine"] for one in steps} == {6}


def test_the_code_flow_ends_where_what_did_not_come_is_published(workspace: Path) -> None:
    run = record(workspace, (QUESTION, 5, 1), (QUESTION, 8, 1))
    arguments = ["--jsonl", run, "--no-cache", "--configuration", "demo", "--property", "answers"]
    assert main(["monitor", *arguments, "--output", "sarif=run.sarif"]) == 1
    (log,) = json.loads((workspace / "run.sarif").read_text())["runs"]
    (flow,) = log["results"][0]["codeFlows"][0]["threadFlows"]
    (step,) = (one["location"] for one in flow["locations"])  # nobody in the model publishes the question
    assert step["message"]["text"] == "t = +0.100 s: /robot/level did not come; /robot/a publishes it here."
    assert step["physicalLocation"]["region"]["startLine"] == 6


def test_junit_has_a_case_for_each_property(workspace: Path) -> None:
    run = record(workspace, (QUESTION, 5, 1), (LEVEL, 6, 101))
    assert (
        main(["monitor", "--jsonl", run, "--no-cache", "--output", "junit=run.xml", "--output", "json=run.json"]) == 1
    )
    suites = ElementTree.parse(workspace / "run.xml").getroot()
    said = json.loads((workspace / "run.json").read_text())["properties"]
    kinds = {"violated": "failure", "held": None, "never exercised": "skipped", "undecided": "skipped"}
    cases = [(case.attrib["name"], next((child.tag for child in case), None)) for case in suites.iter("testcase")]
    found = [kind for _, kind in cases]
    assert cases == [(one["id"], kinds[one["verdict"]]) for one in said] and {"failure", "skipped"} <= {*found}
    counts = {name: int(suites.attrib[name]) for name in ("tests", "failures", "errors", "skipped")}
    assert counts == {
        "tests": len(cases),
        "failures": found.count("failure"),
        "errors": 0,
        "skipped": found.count("skipped"),
    }
    failures = list(suites.iter("failure"))
    assert len(failures) == 2 and all(one.attrib["type"] == "haros-ci:hpl-violated" for one in failures)
    assert "causes /robot/level within 100 ms" in str(failures[0].text)


def test_junit_of_what_holds_has_cases_that_passed(workspace: Path) -> None:
    run = record(workspace, (QUESTION, 5, 1), (LEVEL, 6, 1))
    arguments = ["--jsonl", run, "--no-cache", "--property", "globally: no /robot/level {data > 100}"]
    assert main(["monitor", *arguments, "--output", "junit=run.xml"]) == 0
    (case,) = ElementTree.parse(workspace / "run.xml").getroot().iter("testcase")
    assert case.attrib["name"] == "globally: no /robot/level {data > 100}" and not list(case)


def test_progress_is_shown_on_a_terminal_with_the_time_that_is_left(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from haros_ci.commands import monitor as command
    from haros_ci.recordings.jsonl import JsonLines

    class Terminal(StringIO):
        def isatty(self) -> bool:
            return True

    recording = JsonLines(Path(record(workspace, *((QUESTION, float(n), 1) for n in range(2_000)))))
    monkeypatch.setattr(command, "_EVERY", 500)
    monkeypatch.setattr(command, "_PAUSE", -1.0)
    for stderr, is_shown in ((Terminal(), True), (StringIO(), False)):
        monkeypatch.setattr(sys, "stderr", stderr)
        assert len(list(command.shown(recording, recording.messages(frozenset((QUESTION,)))))) == 2_000
        text = stderr.getvalue()
        assert bool(re.search(r"\r[\d,]+ messages, \d+ s left", text)) == is_shown and (is_shown or not text)


def test_the_clock_is_that_of_recording_or_of_headers(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def line(topic: str, time: float, stamp: float) -> str:
        header = {"stamp": {"sec": int(stamp), "nanosec": round(stamp % 1 * 1_000_000_000)}}
        return json.dumps({"topic": topic, "time": time, "msg": {"header": header, "data": 1}}) + "\n"

    path = workspace / "run.jsonl"
    path.write_text(line(QUESTION, 5, 15) + line(LEVEL, 5.05, 15.25))
    for clock, verdict, code, end in (("log", "held", 0, 5.05), ("header", "violated", 1, 15.25)):
        done, found, said = verdicts(capsys, "--jsonl", str(path), "--property", "answers", "--clock", clock)
        assert (done, found, said["clock"], said["recording"]["end"]) == (code, {"answers": verdict}, clock, end)
    path.write_text('{"topic": "/question", "time": 5, "msg": {"data": 1}}\n')
    _, found, said = verdicts(capsys, "--jsonl", str(path), "--property", "answers", "--clock", "header")
    assert found == {"answers": "undecided"} and "has no header stamp" in said["properties"][0]["reason"]


@pytest.mark.parametrize(("share", "code"), [(0.9, 1), (0.05, 2)])
def test_a_bag_that_was_cut_off(workspace: Path, capsys: pytest.CaptureFixture[str], share: float, code: int) -> None:
    from recordings.bags import ros2

    (path,) = ros2(workspace / "run", [(LEVEL, 101, number) for number in range(500)]).glob("*.db3")
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])
    text = "globally: no /robot/level {data > 100}"
    arguments = ["--bag", str(path), "--no-cache", "--configuration", "demo", "--property", text]
    assert main(["monitor", *arguments, "--output", "text", "--output", "sarif=run.sarif"]) == code
    out, err = capsys.readouterr()
    if code == 2:
        assert "run.db3: no message of it can be read: " in err and not (workspace / "run.sarif").exists()
    else:
        assert "x violated" in out and "note: run.db3 can be read up to message " in out
        assert "run.db3 can be read up to message " in (workspace / "run.sarif").read_text()


def test_a_comment_accepts_a_violation(workspace: Path) -> None:
    path = workspace / "haros.yaml"
    path.write_text(PROJECT.replace("> 100}'", "> 100}'  # haros: ignore[hpl-violated] known"))
    run = record(workspace, (QUESTION, 5, 1), (LEVEL, 5.01, 101))
    assert main(["monitor", "--jsonl", run, "--no-cache"]) == 0


def test_a_bag(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from recordings.bags import ros1

    ros1(workspace / "run.bag", [(QUESTION, 1, 0), (LEVEL, 7, 50), (QUESTION, 1, 1_000), (LEVEL, 7, 1_100)])
    code, found, said = verdicts(capsys, "--bag", "run.bag", "--property", "answers")
    assert (code, found) == (1, {"answers": "violated"})
    assert said["recording"]["topics"] == {QUESTION: 2, LEVEL: 2}


def test_nothing_of_it_is_loaded_elsewhere(workspace: Path) -> None:
    code = (
        "import sys; from haros_ci.cli import main; sys.argv[1:] = %r\ntry: main()\nexcept SystemExit: pass\n"
        "print([name for name in sys.modules if name.startswith(('haros_ci.monitoring', 'haros_ci.recordings', 'rosbags', 'numpy', 'sqlite3'))])"
    )
    for arguments in (["--help"], ["check", "--no-cache", "--profile", "architecture", "--output", "json=out.json"]):
        done = subprocess.run([sys.executable, "-c", code % arguments], capture_output=True, text=True, check=True)
        assert done.stdout.splitlines()[-1] == "[]", arguments


def exported(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = main(["monitor", *arguments, "--no-cache"])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_what_rosmonitoring_needs(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = exported(capsys, "--export", "rosmonitoring", "--configuration", "demo")
    assert code == 0 and "is no HPL" in err
    topics = [line.split()[-1] for line in out.splitlines() if "- name:" in line]
    assert topics == ["/ask", "/level", "/question", "/robot/level"] and out.count("type: std_msgs.msg.UInt8") == 4
    assert "ros_version: ros1" in out and '#     "globally: /question causes /robot/level within 100 ms"' in out
    code, out, _ = exported(
        capsys, "--export", "rosmonitoring=m.yaml", "--configuration", "demo", "--property", "answers"
    )
    text = (workspace / "m.yaml").read_text()
    assert (code, out) == (0, "") and [line.split()[-1] for line in text.splitlines() if "- name:" in line] == [
        "/question",
        "/robot/level",
    ]


def test_without_properties_all_topics_are_recorded(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (workspace / "haros.yaml").unlink()
    code, out, _ = exported(capsys, "--export", "rosmonitoring", "--configuration", "demo/launch/other.launch")
    assert code == 0 and [line.split()[-1] for line in out.splitlines() if "- name:" in line] == ["/ask", "/level"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--export", "monitors"), "no such format"),
        (("--export", "rosmonitoring", "--jsonl", "x"), "reads no recording"),
        (("--export", "rosmonitoring", "--output", "json"), "reads no recording"),
        (("--export", "rosmonitoring", "--property", "globally: no /other"), "no topic to record"),
    ],
)
def test_wrong_usage_of_export(
    workspace: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], said: str
) -> None:
    code, out, err = exported(capsys, "--configuration", "demo", *arguments)
    assert (code, out) == (2, "") and said in err


def test_a_log_of_rosmonitoring_is_a_recording(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [
        {"data": 1, "time": 10.5, "topic": "question"},
        {"request": {"a": 1}, "service": "add", "time": 10.51},
        {"data": 2, "time": 10.55, "topic": "robot/level"},
        {"data": 200, "time": 10.6, "topic": "robot/level"},
    ]
    (workspace / "log.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    code, found, said = verdicts(capsys, "--jsonl", "log.jsonl", "--configuration", "demo")
    assert code == 1 and found["answers"] == "held" and found["globally: no /robot/level {data > 100}"] == "violated"
    assert "1 lines are requests and responses" in str(said)


def test_every_rule_is_explained_and_has_its_place(capsys: pytest.CaptureFixture[str]) -> None:
    from haros_ci.commands.monitor import RULES
    from haros_ci.monitoring.verdict import Verdict

    assert set(RULES) == {verdict.value for verdict in Verdict} - {"held"}
    page = (Path(__file__).resolve().parents[1] / "docs" / "rules" / "haros-ci.md").read_text(encoding="utf-8")
    for rule in RULES.values():
        assert main(["explain", rule.id, "--full"]) == 0 and rule.help in capsys.readouterr().out
        assert f"\n## {rule.id}\n" in page


def test_a_comment_for_a_recording_is_no_idle_one_for_the_rest(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PROJECT.replace("{data > 100}'\n", "{data > 100}'  # haros: ignore[hpl-violated] known\n")
    (workspace / "haros.yaml").write_text(text, encoding="utf-8")
    main(
        ["check", ".", "--no-cache", "--profile", "architecture", "--select", "unused-suppression", "--output", "text"]
    )
    assert "unused-suppression" not in capsys.readouterr().out
    code, found, _ = verdicts(
        capsys, "--jsonl", record(workspace, (QUESTION, 1, 1), (LEVEL, 1.05, 101)), "--configuration", "demo"
    )
    assert (code, found["globally: no /robot/level {data > 100}"]) == (0, "violated")
