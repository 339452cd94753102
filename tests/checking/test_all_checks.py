# SPDX-License-Identifier: Apache-2.0
"""All checks of a run: the same findings from however many processes, and what a change does from this one."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from haros_ci.checking.all_checks import OF_CHANGES, SYSTEMS, run_all
from haros_ci.checking.check import Check, Finding
from haros_ci.checking.project import Project
from haros_ci.checking.system import System
from haros_ci.forks import shared
from haros_ci.model.architecture import Architecture, Configuration, Node
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.results.rule import Level

HERE = os.getpid()


class Nothing:
    def text(self, path: str) -> str:
        return ""

    def data(self, path: str) -> bytes | None:
        return None

    def head(self, path: str, length: int) -> bytes:
        return b""


NAMES = frozenset({"a/COLCON_IGNORE", "a/package.xml"})
WORKSPACE = Workspace(root=Path("/"), packages=(), files=(), reader=Nothing(), names=NAMES)
PROJECT = Project(WORKSPACE, {}, {})


def finding(message: str, path: str = "b.cpp", line: int = 1) -> Finding:
    return Finding(at=Location(path, line), message=message, about=(message,))


def check(name: str, *findings: Finding, tags: tuple[str, ...] = ()) -> Check:
    return Check(id=name, summary=name, level=Level.WARNING, project=lambda project: findings, tags=tags)


def failing(name: str) -> Check:
    def fail(project: Project) -> Iterator[Finding]:
        raise KeyError(name)
        yield

    return replace(check(name), project=fail)


def of_systems(system: System) -> Iterator[Finding]:
    yield finding(f"seen in {system.name}", "c.cpp")


CHECKS = (
    check("late", finding("z", line=9), finding("a", line=2)),
    failing("broken-first"),
    check("changed", finding("only here"), tags=("topics", OF_CHANGES)),
    check("of-builds", finding("not built", "a/package.xml"), tags=("packages",)),
    failing("broken-second"),
    Check(id="of-systems", summary="s", level=Level.ERROR, run=of_systems),
    *(check(f"many-{number}", finding(f"m{number}", line=number + 1)) for number in range(30)),
)
CONFIGURATION = Configuration(
    name="demo", nodes=(Node(name="/n", kind="node", package="p", type="t", source="launch", ros=2),)
)
SYSTEMS_HERE = (System(CONFIGURATION, Architecture(configurations=(CONFIGURATION,))),)


def run(processes: int, **more: Any) -> Any:
    share = partial(shared, processes=processes, here=OF_CHANGES)
    return run_all(CHECKS, SYSTEMS_HERE, PROJECT, "haros-ci", None, share, **more)


@pytest.mark.parametrize("processes", [2, 3, 8])
def test_as_many_processes_as_there_are_find_the_same(processes: int) -> None:
    assert run(processes) == run(1)


def test_findings_are_sorted_and_failures_in_the_order_of_the_checks() -> None:
    of_system, of_project, changes, _ = run(3)
    assert [result.message for result in of_system.results] == ["seen in demo"]
    places = [result.sort_key for result in of_project.results]
    assert places == sorted(places) and len(places) == 34
    assert [note.message.split()[2] for note in of_project.notifications] == ["broken-first", "broken-second"]
    assert changes is None, "there is no base revision"


def test_a_package_that_no_build_sees_is_a_note_unless_the_change_hides_it() -> None:
    def level(base: Workspace | None) -> Level:
        _, found, _, _ = run(2, base=base)
        (result,) = (result for result in found.results if result.rule == "of-builds")
        return result.level

    assert level(None) is Level.NOTE
    assert level(WORKSPACE) is Level.NOTE
    assert level(replace(WORKSPACE, names=frozenset({"a/package.xml"}))) is Level.WARNING


@dataclass
class Asked:
    """Does everything here, and notes the groups."""

    groups: Sequence[Hashable] = ()

    def __call__(self, jobs: Sequence[Callable[[], Any]], groups: Sequence[Hashable]) -> list[Any]:
        self.groups = groups
        return [job() for job in jobs]


def test_what_looks_at_the_base_revision_is_one_piece_of_work_and_the_first() -> None:
    asked = Asked()
    _, _, changes, _ = run_all(CHECKS, SYSTEMS_HERE, PROJECT, "haros-ci", None, asked, WORKSPACE)
    assert list(asked.groups[:3]) == [OF_CHANGES, OF_CHANGES, SYSTEMS]
    assert OF_CHANGES not in asked.groups[2:]
    assert changes is not None and not changes.changes
