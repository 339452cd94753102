# SPDX-License-Identifier: Apache-2.0
"""From findings to results: under which arguments, told once, and none lost by another's fault."""

from __future__ import annotations

import re
import signal
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from haros_ci.checking import patience
from haros_ci.checking.check import Check, Finding
from haros_ci.checking.project import Project
from haros_ci.checking.run import Assigned, graph_of, run_checks, run_on_project
from haros_ci.checking.system import System
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node
from haros_ci.model.launch_facts import ConstructUse
from haros_ci.model.location import Location
from haros_ci.model.presence import Choice
from haros_ci.model.workspace import Workspace
from haros_ci.results.rule import Level


def end(kind: str, name: str, line: int, type: str = "std_msgs/msg/String", **more: object) -> Endpoint:
    place = Location("node.cpp", line, 3)
    return Endpoint(kind=kind, name=name, original_name=name, type=type, location=place, **more)  # type: ignore[arg-type]


def node(name: str, *ends: Endpoint, **more: object) -> Node:
    place = Location("all.launch.py", 5)
    common = {"kind": "node", "package": "demo", "type": name.strip("/"), "source": "launch", "ros": 2, "process": name}
    return Node(name=name, location=place, endpoints=ends, **{**common, **more})  # type: ignore[arg-type]


def system(*nodes: Node, name: str = "demo/launch/all.launch.py", **more: object) -> System:
    made = Configuration(name=name, launch=(name,), nodes=nodes, **more)  # type: ignore[arg-type]
    return System(made, Architecture(configurations=(made,)))


def pairs(found: System) -> Iterator[Finding]:
    for topic in found.topics:
        for publisher, subscriber in topic.pairs():
            yield Finding(
                at=subscriber.location,
                message=f"{publisher.node} meets {subscriber.node}",
                about=(publisher, subscriber),
            )


MEET = Check(id="meet", summary="Nobody meets.", level=Level.WARNING, run=pairs)
TALKER = node("/talker", end("publishers", "/chat", 7))
LISTENER = node("/listener", end("subscribers", "/chat", 9))


class Nothing:
    def text(self, path: str) -> str:
        return ""

    def data(self, path: str) -> bytes | None:
        return None

    def head(self, path: str, length: int) -> bytes:
        return b""


EMPTY = Project(Workspace(root=Path("/"), packages=(), files=(), reader=Nothing()), {}, {})


def messages(*found: System, **more: object) -> list[str]:
    return [result.message for result in run_checks((MEET,), found, "haros-ci", **more).results]  # type: ignore[arg-type]


def test_a_result_names_places_names_and_roles() -> None:
    (result,) = run_checks((MEET,), (system(TALKER, LISTENER),), "haros-ci").results
    assert (result.tool, result.rule, result.level) == ("haros-ci", "meet", Level.WARNING)
    assert result.location == Location("node.cpp", 9, 3)
    assert result.subject == ("/chat", "/listener", "/talker")
    assert result.roles == ("publishers demo/talker", "subscribers demo/listener")
    assert result.edges == (("node:/talker", "topic:/chat"), ("topic:/chat", "node:/listener"))
    assert result.message == "/talker meets /listener; in demo/launch/all.launch.py"


def test_the_graph_of_a_finding_is_in_the_run() -> None:
    checked = run_checks(
        (MEET,), (system(TALKER, LISTENER), system(TALKER, name="demo/launch/b.launch.py")), "haros-ci"
    )
    (graph,) = checked.graphs
    assert graph == graph_of(system(TALKER, LISTENER))
    assert [vertex.id for vertex in graph.vertices] == ["node:/listener", "node:/talker", "topic:/chat"]


def test_the_same_in_two_configurations_is_told_once() -> None:
    both = (system(TALKER, LISTENER), system(TALKER, LISTENER, name="demo/launch/b.launch.py"))
    assert messages(*both) == ["/talker meets /listener; in demo/launch/all.launch.py"]


def test_of_other_topics_the_nodes_are_not_named() -> None:
    both = [node("/talker", end("publishers", "/chat", 7)), node("/pilot", end("publishers", "/drive", 7))]
    check = Check(
        id="c",
        summary="s",
        level=Level.NOTE,
        run=lambda found: [Finding(at=e.location, message=f"{e.name} is here", about=(e,)) for e in found.ends],
    )
    (result,) = run_checks((check,), (system(*both),), "haros-ci").results
    assert result.message.endswith("; likewise for /drive")


def test_other_names_at_the_same_places_are_counted() -> None:
    other = [replace(each, name="/left" + each.name) for each in (TALKER, LISTENER)]
    assert messages(system(TALKER, LISTENER), system(*other, name="b")) == [
        "/left/talker meets /left/listener; in b; likewise for /listener, /talker"
    ]


def test_a_check_that_fails_loses_nothing_else() -> None:
    def broken(found: System) -> Iterator[Finding]:
        raise KeyError(found.name)

    checked = run_checks((replace(MEET, id="broken", run=broken), MEET), (system(TALKER, LISTENER),), "haros-ci")
    assert len(checked.results) == 1
    (note,) = checked.notifications
    assert (note.level, note.tool) == (Level.ERROR, "haros-ci")
    assert note.message.startswith("the check broken failed on demo/launch/all.launch.py: KeyError")


def test_a_check_that_takes_too_long_is_ended_and_loses_nothing_else(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(patience, "MOST", 0.05)
    began = []

    def endless(found: System | Project) -> Iterator[Finding]:
        began.append(found)
        while True:
            with suppress(Exception):
                re.search(r"(?:a|b|ab)*c", "ab" * 9 + "!")
        yield from ()

    systems = (system(TALKER, LISTENER), system(TALKER, LISTENER, name="demo/launch/b.launch.py"))
    checked = run_checks((replace(MEET, id="endless", run=endless), MEET), systems, "haros-ci")
    assert len(checked.results) == 1
    (note,) = checked.notifications
    assert (note.level, note.tool) == (Level.ERROR, "haros-ci")
    assert note.message == "the check endless was ended on demo/launch/all.launch.py: it took too long"
    assert len(began) == 1, "it is not begun again on the next system"
    once = run_on_project((replace(MEET, id="endless", run=None, project=endless),), EMPTY, "haros-ci")
    assert [note.message for note in once.notifications] == ["the check endless was ended: it took too long"]
    assert signal.getsignal(signal.SIGPROF) is signal.SIG_DFL and signal.getitimer(signal.ITIMER_PROF)[0] == 0


def test_stays_quiet_where_two_never_exist_together() -> None:
    code = [Condition(s, "x", Location("node.cpp", line)) for s, line in (("if", 3), ("else", 5))]
    mine, yours = (
        end(k, "/chat", 7, conditions=(c,)) for k, c in zip(("publishers", "subscribers"), code, strict=True)
    )
    assert messages(system(node("/both", mine, yours))) == []
    other = replace(yours, conditions=(replace(code[1], condition="y"),))
    assert len(messages(system(node("/both", mine, other)))) == 1
    assert len(messages(system(node("/one", mine), node("/two", yours)))) == 1, "each process decides for itself"


@pytest.mark.parametrize(
    ("one", "other", "count"),
    [
        ("talk", "hear", 0),
        ("sub talk", "sub hear", 0),
        ("sub talk", "hear", 0),
        ("talk", "talk", 1),
        ("sub", "sub hear", 1),
        ("", "hear", 1),
    ],
)
def test_two_commands_of_a_program_never_run_together(one: str, other: str, count: int) -> None:
    def made(kind: str, names: str) -> Endpoint:
        found = tuple(Condition("command", name, Location("tool.py", 3)) for name in names.split())
        return end(kind, "/chat", 7, conditions=found)

    mine, yours = made("publishers", one), made("subscribers", other)
    assert len(messages(system(node("/both", mine, yours)))) == count
    assert len(messages(system(node("/one", mine), node("/two", yours)))) == 1


class TestOtherArguments:
    """A finding that the default arguments do not show."""

    on, off = Choice("simulate", "true"), Choice("simulate", "false")

    def variant(self, talker: Choice | None, listener: Choice | None) -> System:
        made = [
            replace(each, presence=(choice,) if choice else ())
            for each, choice in ((TALKER, talker), (LISTENER, listener))
        ]
        default = [each for each in made if self.on not in each.presence]
        others = tuple(each for each in made if self.on in each.presence)
        return system(*default, alternatives=others, arguments=(("simulate", "false"),))

    def test_is_told_with_the_command_that_shows_it(self) -> None:
        asked: list[Assigned] = []

        def under(found: System, arguments: Assigned) -> System:
            asked.append(arguments)
            return system(TALKER, LISTENER)

        assert messages(self.variant(self.on, None), under=under) == [
            "/talker meets /listener; seen with ros2 launch demo all.launch.py simulate:=true"
        ]
        assert asked == [(("simulate", "true"),)]

    def test_is_dropped_if_these_arguments_do_not_show_it(self) -> None:
        assert messages(self.variant(self.on, None), under=lambda found, arguments: system(TALKER)) == []
        assert messages(self.variant(self.on, None), under=lambda found, arguments: None) == []
        assert messages(self.variant(self.on, None)) == []

    def test_is_dropped_in_contradictory_contexts(self) -> None:
        assert messages(self.variant(self.on, self.off), under=lambda found, arguments: system(TALKER, LISTENER)) == []

    def test_needs_no_argument_that_is_the_default(self) -> None:
        assert messages(self.variant(self.off, self.off)) == ["/talker meets /listener; in demo/launch/all.launch.py"]


def refused(path: str = "a.launch", *included: Location) -> ConstructUse:
    return ConstructUse(location=Location(path, 2), included=included, kind="foreign", text="type= of <node>")


def located(path: str) -> Check:
    def run(found: System) -> Iterator[Finding]:
        yield Finding(at=Location(path, 3), message="wrong", about=(found.nodes[0],))

    return Check(id="located", summary="Nothing is wrong.", level=Level.WARNING, run=run)


@pytest.mark.parametrize(
    ("facts", "place", "is_heard"),
    [
        ((), "a.launch", True),
        ((refused(),), "a.launch", False),
        ((refused(),), "node.cpp", False),  # nothing of it starts
        ((refused("b.launch", Location("a.launch", 4)),), "b.launch", False),
        ((refused("b.launch", Location("a.launch", 4)),), "a.launch", True),
        ((refused("b.launch", Location("a.launch", 4)),), "node.cpp", True),
        ((replace(refused(), kind="deprecated"),), "a.launch", True),
        ((replace(refused(), stops=False),), "a.launch", True),
    ],
)
def test_what_launch_refuses_is_one_finding(facts: tuple[ConstructUse, ...], place: str, is_heard: bool) -> None:
    found = system(TALKER, launch_facts=facts)
    assert len(run_checks((located(place),), (found,), "haros-ci").results) == is_heard
    assert len(run_checks((replace(located(place), of_refused=True),), (found,), "haros-ci").results) == 1


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("topic_type_mismatch", ("publishers", "subscribers")),
        ("action_type_mismatch", ("action_servers", "action_clients")),
    ],
)
def test_many_ends_of_one_name_do_not_take_long(name: str, kinds: tuple[str, str]) -> None:
    """Thousands of ends on both sides: what is asked of one end is found out once, and pairs that tell nothing new are passed over."""
    check: Check = import_module(f"haros_ci_checks.{name}").CHECK
    few = 50
    givers = [node(f"/g{n}", *[end(kinds[0], "/chat", 7)] * few) for n in range(few)]
    takers = [node(f"/t{n}", *[end(kinds[1], "/chat", 9, "std_msgs/msg/Empty")] * few) for n in range(few)]
    checked = run_checks((check,), (system(*givers, *takers),), "haros-ci")
    assert not checked.notifications
    (result,) = checked.results
    assert result.location.line == 9
    assert {f"/g{few - 1}", f"/t{few - 1}", "/chat"} <= set(result.subject)


@pytest.mark.parametrize(
    ("second", "count"),
    [
        (Finding(at=Location("a.xacro", 3), message="no mesh", about=("other",)), 1),
        (Finding(at=Location("a.xacro", 3), message="no mesh", about=("other",), apart=("other",)), 1),
        (Finding(at=Location("a.xacro", 3), message="no other mesh", about=("other",)), 2),
        (Finding(at=Location("a.xacro", 4), message="no mesh", about=("other",)), 2),
        (Finding(at=Location("b.xacro", 3), message="no mesh", about=("other",)), 2),
    ],
)
def test_the_same_is_said_of_a_place_once(second: Finding, count: int) -> None:
    first = Finding(at=Location("a.xacro", 3), message="no mesh", about=("one",))
    check = replace(MEET, run=None, project=lambda project: iter((first, second)))
    found = run_on_project((check,), EMPTY, "haros-ci").results
    assert len(found) == count and found[0].subject == ("one",)


def test_the_time_of_a_check_is_taken_once_for_all_systems(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[str] = []
    taken = patience.Patience.with_

    def counting(self: patience.Patience, name: str) -> object:
        begun.append(name)
        return taken(self, name)

    monkeypatch.setattr(patience.Patience, "with_", counting)
    checked = run_checks([MEET], [system(TALKER, LISTENER, name=f"s{number}") for number in range(50)], "tool")
    assert len(checked.results) == 1
    assert begun == ["meet"]
