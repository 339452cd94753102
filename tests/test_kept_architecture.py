# SPDX-License-Identifier: Apache-2.0
"""The architecture of a base revision comes from the cache, and is the one that would be made; so does that of moved lines."""

from __future__ import annotations

import zlib
from base64 import b64encode
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, write
from mutations import LAUNCH_XML, LISTENER_CPP, ROS2

from haros_ci import pipeline
from haros_ci.analysis.architecture_codec import LineLost, decoded, encoded
from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.kept_architecture import KeptArchitectures
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Qos, Unknown
from haros_ci.model.launch_facts import ArgumentRead, FileUse
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.results.result import Report
from haros_ci.systems.link import Linked
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

CODE, LAUNCH = "walker/src/go.cpp", "walker/launch/go.launch.py"
PLACE, FAR = Location(CODE, 7, 3), Location(CODE, 9, 1, 9, 4)
END = Endpoint(
    kind="publishers",
    name="/goal",
    original_name="/goal",
    type="std_msgs/msg/Int32",
    location=PLACE,
    conditions=(Condition("if", "ready", FAR, is_early=True),),
    qos=Qos(depth=10, deadline=0.5),
    value=[1, 2.0, True, "x", None, {"a": []}],
    written="goal",
)


def of(*ends: Endpoint, problems: tuple[Problem, ...] = (), **more: Any) -> Architecture:
    nodes = (Node(name="/go", kind="node", package="walker", type="go", endpoints=ends, location=PLACE, **more),)
    facts = (
        ArgumentRead(location=Location(LAUNCH, 3), name="speed"),
        FileUse(location=Location(LAUNCH, 2), kind="include", text="a"),
        ArgumentRead(location=Location(LAUNCH, 1), name="color"),
    )
    parameter = Parameter(name="/go:depth", type="int", value=3, location=Location(LAUNCH, 4), command="cat")
    one = Configuration(
        name="walker/go", nodes=nodes, alternatives=(replace(nodes[0], name="/run"),), parameters=(parameter,),
        alternative_parameters=(replace(parameter, value=4),), launch_facts=facts,
    )  # fmt: skip
    return Architecture(configurations=(one, Configuration(name="walker/stay")), problems=problems)


def test_comes_back_as_it_was() -> None:
    found = of(END, replace(END, name="/way"), problems=(Problem(CODE, "nothing is known", 7),))
    data = encoded(found)
    assert data is not None
    back = decoded(data, found.packages)
    assert repr(back) == repr(found)
    one = back.configurations[0]
    assert one.nodes[0].endpoints[0] is one.alternatives[0].endpoints[0]
    assert one.nodes[0].endpoints[0] is not one.nodes[0].endpoints[1]


LOSSY: dict[str, Endpoint] = {
    "a tuple": replace(END, value=(1, 2)),
    "a whole number where a real one is meant": replace(END, qos=Qos(deadline=1)),
    "half a character": replace(END, name="/\ud800"),
    "a large number": replace(END, effective=1 << 70),
    "no number": replace(END, value=float("nan")),
    "a set": replace(END, value=frozenset()),
}


@pytest.mark.parametrize("end", LOSSY.values(), ids=LOSSY)
def test_not_kept_where_it_would_not(end: Endpoint) -> None:
    assert encoded(of(end)) is None


def moved(found: Architecture, lines: dict[int, int]) -> Architecture:
    data = encoded(found)
    assert data is not None
    return decoded(data, found.packages, {CODE: lines})


def test_things_stand_on_new_lines() -> None:
    found = moved(of(END, problems=(Problem(CODE, "nothing is known", 7), Problem(LAUNCH, "or", 7))), {7: 8, 9: 12})
    node = found.configurations[0].nodes[0]
    assert (node.location, node.endpoints[0].location) == (Location(CODE, 8, 3), Location(CODE, 8, 3))
    assert node.endpoints[0].conditions == (Condition("if", "ready", Location(CODE, 12, 1, 12, 4), is_early=True),)
    assert [problem.line for problem in found.problems] == [8, 7]
    assert found.configurations[0].launch_facts == of(END).configurations[0].launch_facts


FIRST = replace(END, location=Location(CODE, 1), conditions=())
LOST: dict[str, tuple[Architecture, dict[int, int]]] = {
    "a line that has no code": (of(END), {7: 8}),
    "the end of something": (of(replace(END, location=Location(CODE, 7, 1, 8, 2))), {7: 8, 9: 10}),
    "a first line that may stand for the file": (of(FIRST, twins=()), {1: 2, 7: 8}),
    "a sentence with a line": (of(END, unknowns=(Unknown("name", "see go.cpp:7", PLACE),)), {7: 8, 9: 10}),
    "a place in a text": (of(END, container=f"{CODE}:7:walker"), {7: 8, 9: 10}),
    "a place in a sentence on another file": (
        of(END, problems=(Problem(LAUNCH, f"as {CODE}:7 does", 7),)),
        {7: 8, 9: 10},
    ),
    "another such sentence": (of(END, problems=(Problem(CODE, "unlike line 7", 7),)), {7: 8, 9: 10}),
}


@pytest.mark.parametrize(("found", "lines"), LOST.values(), ids=LOST)
def test_a_line_is_not_guessed(found: Architecture, lines: dict[int, int]) -> None:
    with pytest.raises(LineLost):
        moved(found, lines)


def test_the_first_line_stands_for_a_file_whose_first_line_has_no_code() -> None:
    found = moved(of(FIRST), {7: 8})
    assert found.configurations[0].nodes[0].endpoints[0].location == Location(CODE, 1)


class Spoiling(MemoryCache):
    """A cache that has *text* for every architecture."""

    def __init__(self, text: object) -> None:
        super().__init__()
        self._text = text

    def get(self, group: str, path: str, key: str) -> object | None:
        return self._text if path.startswith("systems ") else super().get(group, path, key)


def packed(data: bytes) -> str:
    return b64encode(zlib.compress(data)).decode()


WHOLE = encoded(of(END)) or b""
SPOILED: dict[str, object] = {
    "nothing": None,
    "no text": [1],
    "no base64": "?",
    "not packed": "AAAA",
    "half of it": packed(WHOLE)[:80],
    "no architecture": packed(b"\x01"),
    "an architecture cut off": packed(WHOLE[:-4]),
    "no parts": packed(b"\x97\xc4\x01\x90\xc4\x01\x90\xc4\x01\x90\x90\xc4\x01\x90\xc4\x01\x90\x90"),
}


@pytest.mark.parametrize("text", SPOILED.values(), ids=SPOILED)
def test_what_is_no_architecture_is_made_anew(tmp_path: Path, text: object) -> None:
    workspace = discover(write(tmp_path, {"go.cpp": ""}), ())

    def make() -> Linked:
        raise AssertionError

    assert KeptArchitectures("", Spoiling(text)).get(workspace, make, workspace) is None


class Runs:
    """Runs over one workspace with one cache; *linked* counts how often an architecture was made."""

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.root, self.store, self.linked = root, MemoryCache(), 0
        self.settings = Settings(root=root, profile="architecture", cache_dir=root.parent / "cache", jobs=1)
        real = Architectures._linked

        def counted(architectures: Architectures, workspace: Workspace) -> Linked:
            self.linked += 1
            return real(architectures, workspace)

        monkeypatch.setattr(Architectures, "_linked", counted)

    def run(self, base: str | None = "HEAD", store: MemoryCache | None = None) -> tuple[Report, int]:
        """The report of the workspace as it is, and how many architectures were made for it."""
        before = self.linked
        settings = replace(self.settings, baseline_rev=base, cache_dir=None if store else self.settings.cache_dir)
        return pipeline.analyse(settings, store or self.store)[0], self.linked - before


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Runs:
    root = write(tmp_path / "ws", ROS2)
    commit(root)
    return Runs(root, monkeypatch)


#: Changes, and how many architectures are made for each where that of the base is kept.
EDITS: dict[str, tuple[int, dict[str, str]]] = {
    "a comment": (0, {LISTENER_CPP: "// more\n" + ROS2[LISTENER_CPP]}),
    "a comment behind code": (0, {LISTENER_CPP: ROS2[LISTENER_CPP].replace(";\n", ";  // more\n", 1)}),
    "a statement": (1, {LISTENER_CPP: ROS2[LISTENER_CPP].replace("{", "{ int more = 1;", 1)}),
    "another type": (1, {LISTENER_CPP: ROS2[LISTENER_CPP].replace("Int32", "String")}),
    "a launch file": (1, {LAUNCH_XML: ROS2[LAUNCH_XML].replace("steps", "paces")}),
    "a file more": (1, {"walker/config/go.yaml": "go:\n  ros__parameters:\n    depth: 3\n"}),
}


@pytest.mark.parametrize(("made", "edit"), EDITS.values(), ids=EDITS)
def test_the_report_is_that_of_a_run_without_a_cache(runs: Runs, made: int, edit: dict[str, str]) -> None:
    assert runs.run(base=None)[1] == 1
    write(runs.root, edit)
    found, linked = runs.run()
    assert linked == made
    fresh, _ = runs.run(store=MemoryCache())
    assert replace(found, runs=()) == replace(fresh, runs=())
    assert found.runs == fresh.runs


def test_the_base_is_kept_by_the_first_change(runs: Runs) -> None:
    write(runs.root, EDITS["another type"][1])
    assert runs.run()[1] == 2
    write(runs.root, EDITS["a statement"][1])
    assert runs.run()[1] == 1


def test_nothing_is_kept_with_plugins_or_the_exact_tier(runs: Runs) -> None:
    for more in ({"plugins": ("more",)}, {"exact": True}, {"cache_dir": None}):
        settings = replace(runs.settings, **more)  # type: ignore[arg-type]  # fields by name
        known = Architectures(runs.settings, runs.store).registry
        assert Architectures(settings, runs.store, known).keeping() is None
