# SPDX-License-Identifier: Apache-2.0
"""A part of a workspace refuses what is not to be seen of it, however a check comes to it, and gives all else."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from commandline import write

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.kept_findings import parts_of
from haros_ci.checking.check import Check, Finding
from haros_ci.checking.includes import includes
from haros_ci.checking.project import Project
from haros_ci.checking.system import System
from haros_ci.checking.unseen import Part, Refused, hidden_in, without_text
from haros_ci.code.calls import calls_of
from haros_ci.config.settings import Settings
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Level
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

CPP, PY, XML = "walker/src/go.cpp", "walker/go.py", "walker/package.xml"
FILES = {
    CPP: "#include <map>\nvoid go() { stay(); }\n",
    PY: "go()\n",
    XML: "<package format='3'><name>walker</name><version>1.0.0</version></package>\n",
    "walker/launch/go.launch.py": "x = 1\n",
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    return discover(write(tmp_path_factory.mktemp("unseen"), FILES), (".",))


@pytest.fixture(scope="module")
def parts(workspace: Workspace) -> tuple[Part, ...]:
    made = Architectures(Settings(root=workspace.root), MemoryCache()).of(workspace)
    return parts_of(made, workspace, "", ())


Look = Callable[[Project], object]
#: What both refuse, what only the first refuses, and what neither does.
NEVER: dict[str, Look] = {
    "the text": lambda project: project.text(CPP),
    "the bytes": lambda project: project.workspace.data(CPP),
    "the text, another way": lambda project: project.workspace.reader.text(CPP),
    "all texts": lambda project: [project.text(file.path) for file in project.workspace.files],
    "the first bytes of any file": lambda project: project.workspace.head(PY),
    "the base revision": lambda project: project.base,
    "what has changed": lambda project: project.changes,
    "the robots": lambda project: project.descriptions,
}
WITH_PROGRAMS: dict[str, Look] = {
    "the program": lambda project: project.programs[CPP],
    "the program, if there is one": lambda project: project.programs.get(CPP),
    "whether there is a program": lambda project: CPP in project.programs,
    "all programs": lambda project: list(project.programs.values()),
    "how many programs there are": lambda project: len(project.programs),
    "the call graph": lambda project: project.code,
    "a word in all texts": lambda project: calls_of(project.code, "stay"),
    "a word": lambda project: project.has_word(CPP, "stay"),
    "a text with a word": lambda project: project.text_with(CPP, "stay"),
    "what is included": lambda project: includes(CPP, project.glance(CPP)),
    "a text of the call graph's": lambda project: project.code.text(CPP),
}
ALWAYS: dict[str, Look] = {
    "other code": lambda project: project.text(PY),
    "other programs": lambda project: project.programs[PY],
    "a word of other code": lambda project: project.has_word(PY, "go"),
    "a manifest": lambda project: project.element(XML),
    "the names of files": lambda project: CPP in project.workspace.names,
    "the systems": lambda project: list(project.systems),
    "the builds": lambda project: [package.build for package in project.packages],
    "what a file is": lambda project: [(file.path, file.language) for file in project.workspace.files],
}


def is_refused(part: Part, look: Look) -> bool:
    try:
        look(part.project)
    except Refused:
        return True
    return False


@pytest.mark.parametrize("look", NEVER.values(), ids=NEVER)
def test_refused(parts: tuple[Part, ...], look: Look) -> None:
    assert [is_refused(part, look) for part in parts] == [True, True]


@pytest.mark.parametrize("look", WITH_PROGRAMS.values(), ids=WITH_PROGRAMS)
def test_refused_without_programs(parts: tuple[Part, ...], look: Look) -> None:
    assert [is_refused(part, look) for part in parts] == [True, False]


@pytest.mark.parametrize("look", ALWAYS.values(), ids=ALWAYS)
def test_given(parts: tuple[Part, ...], look: Look) -> None:
    assert [is_refused(part, look) for part in parts] == [False, False]


def test_what_is_looked_up_or_read_is_noted(workspace: Workspace) -> None:
    made = Architectures(Settings(root=workspace.root), MemoryCache()).of(workspace)
    _, part = parts_of(made, workspace, "", ())
    part.project.text_with(CPP, "nowhere")
    part.project.has_word(CPP, "stay")
    calls_of(part.project.code, "walk")
    assert (part.words, part.read) == ({"nowhere", "stay", "walk"}, set())
    part.project.text_with(CPP, "map")
    assert part.read == {CPP}
    part.project.text_with(PY, "go")
    part.project.code.text(PY)
    assert part.read == {CPP}, "other files are part of the key"


def test_a_row_of_a_refused_file_tells_nothing_of_its_text(workspace: Workspace) -> None:
    write(workspace.root, {CPP: "// more\n" + FILES[CPP]})
    other = discover(workspace.root, (".",))
    write(workspace.root, {CPP: FILES[CPP]})
    assert workspace.files != other.files and hidden_in(workspace) == {CPP}
    assert without_text(workspace).files == without_text(other).files


def test_no_part_where_there_is_no_cpp(tmp_path: Path) -> None:
    bare = discover(write(tmp_path, {PY: FILES[PY], XML: FILES[XML]}), (".",))
    made = Architectures(Settings(root=bare.root), MemoryCache()).of(bare)
    assert parts_of(made, bare, "", ()) == ()


def plain(project: Project) -> Iterator[Finding]:
    yield Finding(at=Location(XML, 1), message="said", about=("walker",))


def reading(project: Project) -> Iterator[Finding]:
    try:
        project.text(CPP)
    except Exception:  # what catches all of its own exceptions does not catch this
        yield from plain(project)
    yield from plain(project)


def failing(project: Project) -> Iterator[Finding]:
    raise KeyError("fault")
    yield


CHECK = Check(id="plain", summary="s", level=Level.ERROR, project=plain)


def test_what_is_said_of_a_part(parts: tuple[Part, ...]) -> None:
    found = parts[0].of_project(CHECK, "haros-ci", ())
    assert found is not None and [result.message for result in found.results] == ["said"]
    assert found.unseen.programs == {"plain"} and not found.unseen.texts
    with_programs = parts[1].of_project(CHECK, "haros-ci", ())
    assert with_programs is not None and with_programs.unseen.texts == {"plain"} and not with_programs.unseen.programs


@pytest.mark.parametrize("run", (reading, failing))
def test_what_asks_for_more_or_fails_has_said_nothing(
    parts: tuple[Part, ...], run: Callable[[Project], Iterator[Finding]]
) -> None:
    check = replace(CHECK, project=run)
    assert [part.of_project(check, "haros-ci", ()) for part in parts] == [None, None]


def test_systems_refuse_the_same(workspace: Workspace) -> None:
    from haros_ci.model.architecture import Architecture, Configuration

    one = Configuration(name="demo")
    every = (System(one, Architecture(configurations=(one,)), without_text(workspace)),)
    part = Part(Project(without_text(workspace), {}, {}), every)

    def of(path: str) -> Check:
        def run(system: System) -> Iterator[Finding]:
            assert system.workspace is not None
            yield Finding(at=Location(path, 1), message=system.workspace.text(path)[:2], about=("walker",))

        return replace(CHECK, project=None, run=run)

    assert part.of_systems(of(CPP), "haros-ci") is None
    found = part.of_systems(of(PY), "haros-ci")
    assert found is not None and [result.message for result in found.results] == ["go"]
