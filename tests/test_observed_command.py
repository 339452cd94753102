# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --observed``: what a recording has and the model lacks, and the reverse."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from commandline import TALKER_PACKAGE

from haros_ci.cli import main
from haros_ci.model.architecture import Configuration, Endpoint, Node, Qos
from haros_ci.model.observed import ObservedTopic, compare
from haros_ci.model.rates import Rate, Rates, exactly

TALKER = """\
#!/usr/bin/env python3
import rospy
from std_msgs.msg import UInt8

rospy.init_node('talker')
out = rospy.Publisher('level', UInt8, queue_size=1)
spare = rospy.Publisher('spare', UInt8, queue_size=1)
rospy.Subscriber('ask', UInt8, print)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    out.publish(1)
    rate.sleep()
"""
LAUNCH = (
    "<launch><node pkg='demo' type='talker.py' name='a' ns='robot'><remap from='ask' to='/question'/></node></launch>"
)
FILES = {**TALKER_PACKAGE, "src/demo/talker.py": TALKER, "src/demo/launch/demo.launch": LAUNCH}


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def record(path: Path, period: float) -> str:
    rows = [("/robot/level", number * period) for number in range(30)] + [("/question", 1.0), ("/other", 1.0)]
    file = path / "run.jsonl"
    file.write_text(
        "".join(json.dumps({"topic": topic, "time": time, "msg": {"data": 1}}) + "\n" for topic, time in rows)
    )
    return str(file)


def lacks(capsys: pytest.CaptureFixture[str], run: str) -> tuple[dict[str, list[str]], Any]:
    assert main(["model", "--observed", run, "--no-cache", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    return {one["name"]: one["lacks"] for one in found["topics"]}, found


def test_names_are_those_of_the_configuration(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    topics, found = lacks(capsys, record(workspace, 0.1))
    assert topics == {
        "/other": ["the model does not have it"],
        "/question": ["no node of the model publishes it"],
        "/robot/level": [],
    }
    assert found["unrecorded"] == [{"name": "/robot/spare", "publishers": ["/robot/a"]}]
    (level,) = (one for one in found["topics"] if one["name"] == "/robot/level")
    assert level["model"]["rate"] == {"low": 10.0, "high": 10.0}
    assert round(level["rate"], 6) == 10.0


def test_a_rate_that_is_not_the_models_is_said(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    topics, _ = lacks(capsys, record(workspace, 0.5))
    assert topics["/robot/level"] == ["the model has 10 Hz, the recording 2 Hz"]


def test_the_text_says_that_a_recording_does_not_have_everything(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["model", "--observed", record(workspace, 0.1), "--no-cache"]) == 0
    said = capsys.readouterr().out
    assert "/other (1 message): the model does not have it" in said
    assert "/robot/level (30 messages, 10 Hz): published by /robot/a, 10 Hz in the model" in said
    assert "a recording does not have everything" in said
    assert "/robot/spare, published by /robot/a" in said


@pytest.mark.parametrize("options", [("--format", "dot"), ("--coverage",), ("--format", "json", "--compact")])
def test_it_is_text_or_json(workspace: Path, capsys: pytest.CaptureFixture[str], options: tuple[str, ...]) -> None:
    assert main(["model", "--observed", record(workspace, 0.1), "--no-cache", *options]) == 2


def test_a_bag_that_was_cut_off_is_named(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from recordings.bags import ros2

    (path,) = ros2(workspace / "run", [("/robot/level", 1, number) for number in range(500)]).glob("*.db3")
    content = path.read_bytes()
    path.write_bytes(content[: len(content) * 9 // 10])
    assert "run.db3 can be read up to message " in str(lacks(capsys, str(path))[1]["notes"])
    path.write_bytes(content[:9_000])
    assert main(["model", "--observed", str(path), "--no-cache"]) == 2
    assert "run.db3: no message of it can be read: " in capsys.readouterr().err


def topic(name: str, types: set[str] = frozenset(), count: int = 1, span: float = 0.0) -> ObservedTopic:  # type: ignore[assignment]
    return ObservedTopic(name, frozenset(types), count, 0, round(span * 1e9))


def end(kind: str, name: str, type: str | None = "std_msgs/String") -> Endpoint:
    return Endpoint(kind=kind, name=name, original_name=name, type=type, location=None)


LACKS = {
    "another type": (
        [end("publishers", "/a")],
        topic("/a", {"std_msgs/msg/Int32"}),
        "the model has the type std_msgs/String",
    ),
    "only a subscriber": ([end("subscribers", "/a")], topic("/a"), "no node of the model publishes it"),
    "a name that is not known": ([end("publishers", "/?")], topic("/a"), "the name of a topic is not known"),
    "too slow": (
        [end("publishers", "/a")],
        topic("/a", count=20, span=19.0),
        "the model has 10 Hz, the recording 1 Hz",
    ),
}
AGREES = {
    "the type of ROS 2": ([end("publishers", "/a")], topic("/a", {"std_msgs/msg/String"})),
    "a type that is not known": ([end("publishers", "/a", None)], topic("/a", {"std_msgs/msg/Int32"})),
    "no type in the recording": ([end("publishers", "/a")], topic("/a")),
    "nearly the rate": ([end("publishers", "/a")], topic("/a", count=20, span=2.0)),
    "too few messages for a rate": ([end("publishers", "/a")], topic("/a", count=3, span=19.0)),
    "a topic of an action": ([end("action_servers", "/a")], topic("/a/_action/feedback")),
    "what ROS makes": ([], topic("/rosout")),
}  # fmt: skip


def offered(name: str, **options: Any) -> ObservedTopic:
    return ObservedTopic(name, count=1, **options)


def of_qos(qos: Qos | None, latched: bool | None = None, name: str = "/a") -> Endpoint:
    return replace(end("publishers", name), qos=qos, latched=latched)


BEST, SURE = Qos(reliability="best_effort", durability="volatile"), Qos(reliability="reliable", durability="volatile")
LACKS |= {
    "another reliability": (
        [of_qos(SURE)],
        offered("/a", qos=(BEST,)),
        "a publisher of the recording has reliability best_effort, those of the model reliability reliable",
    ),
    "one of two publishers is another": (
        [of_qos(SURE)],
        offered("/a", qos=(SURE, replace(SURE, durability="transient_local"))),
        "has durability transient_local, those of the model durability volatile",
    ),
    "another deadline": ([of_qos(Qos(deadline=0.5))], offered("/a", qos=(Qos(deadline=1.0),)), "deadline 1.0"),
    "another node": ([of_qos(None)], offered("/a", nodes={"/n": None, "/m": None}), "in the recording /m publishes it, too"),
    "it latches": ([of_qos(None, False)], offered("/a", nodes={"/n": True}), "/n latches it, in the model it does not"),
    "it does not latch": ([of_qos(None, True)], offered("/a", nodes={"/n": False}), "/n does not latch it, in the model it does"),
}  # fmt: skip
AGREES |= {
    "the same QoS": ([of_qos(SURE)], offered("/a", qos=(SURE,))),
    "QoS of either publisher": ([of_qos(SURE), of_qos(BEST)], offered("/a", qos=(SURE, BEST))),
    "a reliability that is not known": ([of_qos(Qos(reliability="?"))], offered("/a", qos=(BEST,))),
    "a reliability of the system": ([of_qos(Qos(reliability=None))], offered("/a", qos=(BEST,))),
    "the best one that there is": ([of_qos(Qos(reliability="best_available"))], offered("/a", qos=(BEST,))),
    "a publisher without QoS": ([of_qos(SURE), of_qos(None)], offered("/a", qos=(BEST,))),
    "a depth alone": ([of_qos(Qos(depth=1))], offered("/a", qos=(SURE,))),
    "no deadline in the recording": ([of_qos(Qos(deadline=1.0))], offered("/a", qos=(SURE,))),
    "the same node": ([of_qos(None, False)], offered("/a", nodes={"/n": False})),
    "latching that is not known": ([of_qos(None)], offered("/a", nodes={"/n": True})),
    "latching that the recording lacks": ([of_qos(None, True)], offered("/a", nodes={"/n": None})),
    "two publishers of one node": ([of_qos(None, True), of_qos(None, False)], offered("/a", nodes={"/n": True})),
}


def test_a_nodelet_publishes_as_its_manager() -> None:
    nodelet = Node(name="/n", kind="nodelet", package="p", type="n", container="/manager", endpoints=(of_qos(None),))
    whole = Configuration(name="c", nodes=(nodelet,))
    seen = offered("/a", nodes={"/manager": None})
    assert [one.lacks for one in compare(whole, "run", {"/a": seen}, ()).topics] == [()]


def compared(ends: list[Endpoint], seen: ObservedTopic) -> list[str]:
    node = Node(name="/n", kind="node", package="p", type="n", endpoints=tuple(ends))
    rates = Rates((), (("/a", exactly(10.0)), ("/b", Rate(0.0, float("inf"), "why"))))
    whole = Configuration(name="c", nodes=(node,), rates=rates)
    return [text for one in compare(whole, "run", {seen.name: seen}, ()).topics for text in one.lacks]


@pytest.mark.parametrize("case", LACKS)
def test_what_the_model_lacks(case: str) -> None:
    ends, seen, expected = LACKS[case]
    (text,) = compared(ends, seen)
    assert expected in text


@pytest.mark.parametrize("case", AGREES)
def test_what_agrees_or_cannot_be_said(case: str) -> None:
    assert compared(*AGREES[case]) == []
