# SPDX-License-Identifier: Apache-2.0
"""What a workspace repeats many times is looked at in proportion, not in the square: calls are counted, never seconds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

import pytest
from launching.launching_kit import loader, workspace

from haros_ci.checking.system import systems
from haros_ci.index.build import build_index
from haros_ci.index.relevance import Relevance
from haros_ci.index.trace import Trace
from haros_ci.keeping import consulted
from haros_ci.launch.ros2.entry import entry_files
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.places import Places
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.build import Build, PluginClass, Target
from haros_ci.model.launch import LaunchedSystem
from haros_ci.model.launch_facts import IncludeUse
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.systems.entries import Programs, described_classes, files_of

PLACE = Location("bot/CMakeLists.txt", 1)


def counted(monkeypatch: pytest.MonkeyPatch, owner: type, name: str) -> list[int]:
    """How often the method *name* of *owner* is called from now on, in a list of one."""
    count, before = [0], getattr(owner, name)

    def counting(*arguments: Any) -> Any:
        count[0] += 1
        return before(*arguments)

    monkeypatch.setattr(owner, name, counting)
    return count


def chain(length: int) -> dict[str, str]:
    """Launch files of which each includes the next."""
    include = '<include file="$(find-pkg-share bot)/launch/l{}.launch.xml"/>'
    return {
        f"bot/launch/l{number}.launch.xml": f"<launch>{include.format(number + 1) if number < length else ''}</launch>"
        for number in range(length + 1)
    }


def launched(files: Mapping[str, str]) -> LaunchedSystem:
    return launch_system(
        ["bot/launch/l0.launch.xml"], workspace(files), loader(files), {}, {}, Places(workspace(files))
    )


def test_a_chain_of_includes_is_not_hashed_at_each_of_its_links(monkeypatch: pytest.MonkeyPatch) -> None:
    hashed = counted(monkeypatch, Location, "__hash__")
    counts = []
    for length in (15, 30, 60):
        hashed[0] = 0
        assert len([fact for fact in launched(chain(length)).facts if isinstance(fact, IncludeUse)]) == length
        counts.append(hashed[0])
    assert counts[2] < 2.5 * counts[1] < 6.25 * counts[0]


def test_what_is_included_by_two_tags_is_two_facts() -> None:
    files = chain(2)
    include = '<include file="$(find-pkg-share bot)/launch/l1.launch.xml"/>'
    files["bot/launch/l0.launch.xml"] = f"<launch>\n{include}\n{include}\n</launch>"
    facts = [fact for fact in launched(files).facts if isinstance(fact, IncludeUse)]
    assert sorted(len(fact.included) for fact in facts) == [0, 0, 1, 1]


def test_launch_files_that_may_be_modules_are_each_read_a_few_times(monkeypatch: pytest.MonkeyPatch) -> None:
    files = {f"bot/launch/m{number}_launch.py": "from launch import LaunchDescription\n" for number in range(60)}
    places = Places(workspace(files))
    read = counted(monkeypatch, Workspace, "text")
    entry_files(places.workspace, loader(files), places, lambda path: True)
    assert read[0] <= 6 * len(files)


class Targets(tuple[Target, ...]):
    """Targets that count how often they are gone through."""

    passes = 0

    def __iter__(self) -> Iterator[Target]:
        type(self).passes += 1
        return super().__iter__()


def made_of(*targets: Target, plugins: int = 0) -> Programs:
    described = tuple(
        PluginClass(name=f"bot/C{n}", type=f"bot::C{n}", base="B", library="lib/libc", package="bot", location=PLACE)
        for n in range(plugins)
    )
    build = Build(package="bot", targets=Targets(targets), plugins=described)
    return Programs(build_index(()), build_index(()), {}, MappingProxyType({"bot": build}))


def target(name: str, *links: str) -> Target:
    return Target(
        name=name, package="bot", kind="library", output=name, location=PLACE, sources=(f"bot/{name}.cpp",), links=links
    )


def test_the_library_of_many_described_classes_is_looked_up_once() -> None:
    programs = made_of(*(target(f"l{number}") for number in range(30)), target("c"), plugins=100)
    Targets.passes = 0
    assert not described_classes(programs)  # none is defined
    assert Targets.passes <= 3


def test_what_can_be_linked_is_gathered_once_for_all_targets() -> None:
    programs = made_of(*(target(f"l{number}", f"l{number - 1}") for number in range(30)))
    Targets.passes = 0
    found = [files_of(programs, item) for item in tuple.__iter__(programs.builds["bot"].targets)]
    assert [len(files) for files in found] == list(range(1, 31))
    assert Targets.passes <= 3
    assert files_of(programs, programs.builds["bot"].targets[7]) is found[7]


def test_a_trace_is_kept_for_so_many_nodes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(consulted, "MAX_KEPT", 1_000)
    trace, relevance = Trace(), Relevance(build_index(()), ())
    kept = []
    for number in range(100):
        trace.names.add(f"name{number}")
        kept.append(consulted.small(trace, relevance, ("cpp", 2, frozenset())) is not None)
    assert kept == [number * (number + 1) // 2 <= 1_000 for number in range(1, 101)]


def test_systems_of_one_architecture_share_the_tables_of_its_packages() -> None:
    packages = (Package("one", "src/one"), Package("two", "src/two"))
    ones = tuple(Configuration(name=name) for name in "abc")
    first, *others = systems(Architecture(packages=packages, configurations=ones))
    assert first.packages == {"one": packages[0], "two": packages[1]}
    assert first.packages_by_path == {"src/one": packages[0], "src/two": packages[1]}
    assert all(other.packages is first.packages for other in others)
    assert all(other.packages_by_path is first.packages_by_path for other in others)
