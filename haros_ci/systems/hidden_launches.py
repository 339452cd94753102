# SPDX-License-Identifier: Apache-2.0
"""Launch files of ROS 1 that are in no configuration, as they are included only under conditions that nobody can make true from outside.

Of ``<include if="$(arg db)">`` below an include that does not pass ``db`` nothing is evaluated. What such a file says of names by itself is a fact all the same.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from haros_ci.launch.facts.memory import Memo
from haros_ci.launch.ros1.entry import includes_of
from haros_ci.launch.ros1.roslaunch import evaluate
from haros_ci.model.launch import LaunchFile
from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    IncludeUse,
    LaunchFact,
    PackageUse,
    ProgramUse,
)
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.substitutions.files import files_of

#: So many such files are evaluated.
MAX_HIDDEN = 200
Load = Callable[[str], LaunchFile | None]


def hidden_facts(
    workspace: Workspace,
    load: Load,
    environment: Mapping[str, str],
    facts: Mapping[tuple[str, ...], Iterable[LaunchFact]],
    memo: Memo | None = None,
) -> dict[tuple[str, ...], tuple[LaunchFact, ...]]:
    """By the launch files of a configuration what the files say that they include, at any depth, and of which no configuration has *facts*.

    Each is evaluated as if it were started itself, and counts for the first configuration that leads there. Kept is what does not depend on the
    values that an include passes: names of arguments, and packages and programs that stand in the text.
    """
    seen = {fact.location.path for every in facts.values() for fact in every}
    found: dict[tuple[str, ...], tuple[LaunchFact, ...]] = {}
    count = 0
    included = _Includes(workspace, load, environment)
    for entries in facts:
        for path, chain in _below(included, entries):
            if path in seen or count >= MAX_HIDDEN:
                continue
            count += 1
            launched = evaluate((path,), workspace, load, {}, environment, memo=memo)
            seen |= {path, *launched.files}
            kept = (_kept(workspace, fact, chain) for fact in launched.facts)
            found[entries] = (*found.get(entries, ()), *(fact for fact in kept if fact is not None))
    return found


@dataclass(slots=True)
class _Includes:
    """What each launch file includes, by includes that may be made; what has been looked up is remembered."""

    workspace: Workspace
    load: Load
    environment: Mapping[str, str]
    known: dict[str, tuple[tuple[str, Location], ...]] = field(default_factory=dict)

    def of(self, path: str) -> tuple[tuple[str, Location], ...]:
        if path not in self.known:
            launch = self.load(path)
            files = files_of(self.workspace)
            found = includes_of(files, self.load, path, launch, self.environment) if launch is not None else ()
            self.known[path] = tuple((target, place) for target, place, is_dead in found if not is_dead)
        return self.known[path]


def _below(included: _Includes, entries: tuple[str, ...]) -> Iterator[tuple[str, tuple[Location, ...]]]:
    """The files that *entries* include, in breadth first order, each once, with the include tags that lead there."""
    seen = set(entries)
    waiting: list[tuple[str, tuple[Location, ...]]] = [(entry, ()) for entry in entries]
    for path, chain in waiting:
        for target, place in included.of(path):
            if target not in seen:
                seen.add(target)
                waiting.append((target, (*chain, place)))
    yield from waiting[len(entries) :]


def _kept(workspace: Workspace, fact: LaunchFact, chain: tuple[Location, ...]) -> LaunchFact | None:
    included = (*chain, *fact.included)
    text = workspace.text(fact.location.path)
    if isinstance(fact, ArgumentDeclaration):
        return replace(fact, included=included, is_top=False)
    if isinstance(fact, (ArgumentRead, IncludeUse)):
        return replace(fact, included=included)
    if isinstance(fact, PackageUse) and _is_written(fact.package, "pkg", text):
        return replace(fact, included=included)
    if isinstance(fact, ProgramUse) and _is_written(fact.package, "pkg", text):
        return replace(fact, included=included) if _is_written(fact.program, "type", text) else None
    return None


def _is_written(name: str, attribute: str, text: str) -> bool:
    """Whether *name* is the value of an *attribute* in *text*, or the package of a ``$(find)`` there, as no argument is."""
    word = re.escape(name)
    return re.search(rf"""\b{attribute}\s*=\s*["']{word}["']|\$\(find\s+{word}\s*\)""", text) is not None
