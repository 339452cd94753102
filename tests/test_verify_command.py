# SPDX-License-Identifier: Apache-2.0
"""``haros-ci verify``: what is verified under which names, what is reported where, recordings that the monitor replays, and hostile texts."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import threading
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from commandline import TALKER_PACKAGE

from haros_ci.cli import main
from haros_ci.report.verify_mermaid import render
from haros_ci.report.verify_text import ShownFinding, ShownRun, ShownStep, Verification, as_json, text

needs_solver = pytest.mark.skipif(find_spec("z3") is None, reason="needs the extra: pip install 'haros-ci[verify]'")

NODE = """\
#!/usr/bin/env python3
import rospy
from std_msgs.msg import UInt8

rospy.init_node('{name}')
{ends}
rospy.spin()
"""
FILES = {
    **TALKER_PACKAGE,
    "src/demo/sensor.py": NODE.format(name="sensor", ends="out = rospy.Publisher('level', UInt8, queue_size=1)"),
    "src/demo/relay.py": NODE.format(
        name="relay",
        ends="out = rospy.Publisher('output', UInt8, queue_size=1)\nrospy.Subscriber('input', UInt8, print, queue_size=2)",
    ),
    "src/demo/launch/demo.launch": "<launch><node pkg='demo' type='sensor.py' name='sensor' ns='robot'/>"
    "<node pkg='demo' type='relay.py' name='first' ns='robot'><remap from='input' to='level'/><remap from='output' to='middle'/></node>"
    "<node pkg='demo' type='relay.py' name='second' ns='robot'><remap from='input' to='middle'/><remap from='output' to='/alarm'/></node></launch>",
}
PROJECT = """\
packages: [demo]
configurations:
  demo:
    launch: [demo/launch/demo.launch]
    hpl:
      assumptions:
        - 'globally: no /robot/level {data > 100}'
      properties:
        - |
          # id: alarms
          globally: /robot/level as L {data > 50} causes /alarm {data = @L.data} within 100 ms
        - |
          # id: quick
          globally: /robot/level as L {data > 50} causes /alarm {data = @L.data} within 90 ms
        - |
          # id: bounded
          globally: no /alarm {data > 99}
        - |
          # id: comes
          globally: some /alarm
        - |
          # id: idle
          globally: /robot/level {data > 200} causes /alarm
        - |
          # id: waves
          globally: no /alarm {sin(data) > 1}
nodes:
  demo/relay.py:
    hpl:
      properties:
        - 'globally: input as I causes output {data = @I.data} within 50 ms'
        - 'globally: output as O requires input {data = @O.data} within 50 ms'
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    return made(tmp_path, monkeypatch, PROJECT)


def made(path: Path, monkeypatch: pytest.MonkeyPatch, project: str) -> Path:
    for name, content in {**FILES, "haros.yaml": project}.items():
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_text(content, encoding="utf-8")
    monkeypatch.chdir(path)
    return path


def verify(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, Any]:
    code = main(["verify", "--no-cache", "--depth", "4", "--output", "json", *arguments])
    return code, json.loads(capsys.readouterr().out)


@needs_solver
def test_properties_of_the_configuration_under_the_axioms_of_its_nodes(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, found = verify(capsys)
    assert code == 1
    verdicts = {one["id"]: one["verdict"] for one in found["properties"]}
    assert verdicts == {
        "alarms": "proved",
        "quick": "violated",
        "bounded": "violated",
        "comes": "violated",
        "idle": "vacuous",
        "waves": "not modelled",
    }
    (quick,) = (one for one in found["properties"] if one["id"] == "quick")
    assert (quick["path"], quick["line"]) == ("haros.yaml", 13)
    steps = [(step["node"], step["topic"], step["role"]) for step in quick["run"]["steps"]]
    assert steps == [
        ("/robot/sensor", "/robot/level", "trigger"),
        ("/robot/first", "/robot/middle", None),
        ("/robot/second", "/alarm", None),
    ]
    assert quick["run"]["steps"][0]["places"] == [{"path": "src/demo/sensor.py", "line": 6}]
    assert quick["run"]["steps"][0]["receivers"] == [{"node": "/robot/first", "path": "src/demo/relay.py", "line": 7}]
    (alarms,) = (one for one in found["properties"] if one["id"] == "alarms")
    assert alarms["derivation"][-1] == "together within 100 ms"
    assert any("5 axioms are used" in sentence for sentence in found["assumptions"])


@needs_solver
def test_the_page_shows_what_is_printed(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["verify", "--no-cache", "--property", "alarms", "--property", "quick"])
    page = (Path(__file__).resolve().parents[1] / "docs/verify.md").read_text(encoding="utf-8")
    assert f"```text\n{capsys.readouterr().out}```" in page


@needs_solver
def test_a_later_network_has_its_latency(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, found = verify(capsys, "--property", "alarms", "--network", "async", "--latency", "5")
    assert (code, found["properties"][0]["verdict"]) == (0, "undetermined")
    assert found["properties"][0]["reason"] == "no run of so few events (4) puts it to the test; longer ones may"
    code, found = verify(capsys, "--property", "alarms", "--network", "async", "--latency", "5", "--depth", "5")
    (alarms,) = found["properties"]
    assert (code, alarms["verdict"], alarms["latency"]) == (1, "violated", "proved up to a latency of 0 s")
    text = "globally: /robot/level as L {data > 50} causes /alarm {data = @L.data} within 120 ms"
    code, found = verify(capsys, "--property", text, "--network", "async", "--latency", "1:5")
    assert (code, found["properties"][0]["verdict"]) == (0, "proved")
    assert found["properties"][0]["latency"] == "proved up to a latency of 10 ms"


@needs_solver
def test_counterexamples_are_recordings_of_the_same_verdict(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _, found = verify(capsys, "--traces", "traces")
    broken = [one["id"] for one in found["properties"] if one["verdict"] == "violated"]
    files = sorted(path.name for path in (workspace / "traces").iterdir())
    assert files == ["002-quick.jsonl", "003-bounded.jsonl", "004-comes.jsonl"]
    for name, identity in zip(files, broken):
        code = main(["monitor", "--jsonl", f"traces/{name}", "--property", identity, "--no-cache", "--output", "json"])
        (judged,) = json.loads(capsys.readouterr().out)["properties"]
        # that something never comes no recording can show
        expected = (0, "undecided") if identity == "comes" else (1, "violated")
        assert (code, judged["verdict"]) == expected, identity


@needs_solver
def test_findings_have_a_flow_through_the_source(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "--no-cache", "--property", "quick", "--output", "sarif=out.sarif"]) == 1
    (run,) = json.loads((workspace / "out.sarif").read_text())["runs"]
    (result,) = run["results"]
    assert result["ruleId"] == "hpl-violated"
    locations = result["codeFlows"][0]["threadFlows"][0]["locations"]
    places = [each["location"]["physicalLocation"] for each in locations]
    assert [(p["artifactLocation"]["uri"], p["region"]["startLine"]) for p in places] == [
        ("src/demo/sensor.py", 6), ("src/demo/relay.py", 7), ("src/demo/relay.py", 6), ("src/demo/relay.py", 7), ("src/demo/relay.py", 6),
    ]  # fmt: skip
    assert "publishes /robot/level {data = 51} (trigger)" in locations[0]["location"]["message"]["text"]


@needs_solver
def test_the_job_summary_has_a_sequence_diagram(
    workspace: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(workspace / "summary.md"))
    main(["verify", "--no-cache", "--property", "quick", "--output", "github"])
    page = (workspace / "summary.md").read_text()
    assert "sequenceDiagram" in page and "participant n0 as /robot/sensor" in page
    capsys.readouterr()
    assert main(["verify", "--no-cache", "--property", "alarms", "--output", "mermaid"]) == 0
    assert capsys.readouterr().out == "No counterexample in demo.\n"


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("--latency", "5"), "are of an asynchronous network"),
        (("--loss",), "are of an asynchronous network"),
        (("--network", "async", "--latency", "5:1"), "is no latency"),
        (("--network", "async", "--latency", "nan"), "is no latency"),
        (("--configuration", "none"), "no configuration none"),
        (("--property", "globally: no"), "is no id of a property, and no HPL"),
        (("--property", "globally: no /robot/level {data > 100}"), "is taken for granted here"),
        (("--depth", "1000"), "1000 is not in the range"),
        (("--budget", "0"), "0.0 is not in the range"),
    ],
)
@needs_solver
def test_wrong_usage(
    workspace: Path, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], text: str
) -> None:
    assert main(["verify", "--no-cache", *arguments]) == 2
    assert text in capsys.readouterr().err


def test_without_the_solver_its_extra_is_named(
    workspace: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("haros_ci.verification.running.find_spec", lambda name: None)
    assert main(["verify", "--no-cache"]) == 2
    message = capsys.readouterr().err
    assert "z3-solver, which is not installed" in message and "pip install 'haros-ci[verify]'" in message


HOSTILE = "x; end\n```<img src=x onerror=alert(1)> ##[error] %% {0} @everyone | [a](http://b.example) \u202e\x1b[2J"


def test_hostile_names_stay_in_their_sinks() -> None:
    step = ShownStep(0.0, HOSTILE, HOSTILE, {HOSTILE: HOSTILE}, role="trigger", receivers=((HOSTILE + "2", None),))
    later = ShownStep(0.5, HOSTILE, HOSTILE, {}, receives=True, of=0)
    run = ShownRun((step, later), 0, 1.0, None)
    one = ShownFinding(HOSTILE, HOSTILE, None, "violated", HOSTILE, HOSTILE, 0, False, "", (HOSTILE,), (), run)
    found = Verification(HOSTILE, "messages arrive at once", 1, 1.0, (one,), (HOSTILE,), (HOSTILE,))
    page, printed = render(found), text(found)
    assert page.count("```") == 2 and "<img" not in page and "](" not in page and "@everyone" not in page
    inside = re.sub(r"#\d+;", "", page.split("```")[1])  # without entities
    assert not set(";<>\u202e\x1b") & set(inside.replace("->>", "").replace("-)", ""))
    assert not {"\x1b", "\u202e"} & set(printed) and "##[" not in printed
    assert json.loads(as_json(found))["configuration"] == HOSTILE


SLOW = [
    " and ".join(f"(data ** 4 * {n + 2} + data ** 3 > data ** 2 * {n})" for n in range(40)),
    " or ".join(f"(data * data * data = {n}.5 * data + {n})" for n in range(60)),
    "exists i in [0 to 15]: exists j in [0 to 15]: exists k in [0 to 15]: @i * @j * @k = data",
]


@needs_solver
@pytest.mark.parametrize("predicate", SLOW, ids=("powers", "products", "quantifiers"))
def test_no_text_is_endless(
    workspace: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, predicate: str
) -> None:
    monkeypatch.setattr("haros_ci.verification.running.GRACE", 5.0)
    text = f"globally: /robot/level {{{predicate}}} causes /alarm {{{predicate}}} within 10 ms"
    code, found = verify(capsys, "--property", text, "--budget", "1")
    assert code in (0, 1)
    assert found["properties"][0]["verdict"] in (
        "violated",
        "undetermined",
        "no counterexample",
        "vacuous",
        "not modelled",
    )


@needs_solver
def test_a_child_that_does_not_answer_is_ended(
    workspace: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from haros_ci.verification import groups, running

    monkeypatch.setattr(running, "GRACE", 0.1)
    monkeypatch.setattr(
        groups.Group, "search", lambda self: (self.tell(self.claims[0].claim.number, 0.1), threading.Event().wait())
    )
    code, found = verify(capsys, "--property", "quick", "--budget", "0.5")
    assert code == 0
    assert (found["properties"][0]["verdict"], found["properties"][0]["reason"]) == ("undetermined", running.TOO_LONG)


def test_the_solver_is_loaded_by_nothing_else(workspace: Path) -> None:
    script = (
        "import sys; from haros_ci.cli import main; main(['check', '.', '--no-cache', '--profile', 'architecture', '--output', 'json']); "
        "main(['verify', '--help']); print([name for name in sys.modules if name.startswith(('z3', 'haros_ci.verification'))], file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=workspace)
    assert done.stderr.strip().splitlines()[-1] == "[]"
