# SPDX-License-Identifier: Apache-2.0
"""Facts as the evaluators record them, with what the workspace and its builds know of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from haros_ci.graph.given_parameters import matches
from haros_ci.launch.facts.files import Finder
from haros_ci.launch.facts.programs import Programs
from haros_ci.model.architecture import Node
from haros_ci.model.build import Build
from haros_ci.model.launch_facts import ConstructUse, FileUse, LaunchFact, NodePattern, PackageUse, ProgramUse
from haros_ci.model.similar_files import similar_names
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.systems.following import Types
from haros_ci.systems.known.load import load_known
from haros_ci.systems.system import Job


@dataclass(slots=True)
class Completion:
    """Completes the facts of configurations; what has been looked up is remembered."""

    workspace: Workspace
    builds: Mapping[str, Build]
    types: Types
    finder: Finder = field(init=False)
    programs: Programs = field(init=False)
    packages: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        self.finder = Finder(self.workspace, self.builds)
        types = self.types
        known = {*types.startable, *types.ros2_programs, *types.components}
        self.programs = Programs(self.finder, self.builds, known)
        self.packages = frozenset(package.name for package in self.workspace.packages)

    def completed(self, facts: Iterable[LaunchFact]) -> tuple[LaunchFact, ...]:
        return tuple(dict.fromkeys(self._completed(fact) for fact in facts))

    def _completed(self, fact: LaunchFact) -> LaunchFact:
        if isinstance(fact, FileUse):
            return self.finder.completed(fact)
        if isinstance(fact, ProgramUse):
            return self.programs.completed(fact) if fact.package in self.packages else self._with_known(fact)
        if isinstance(fact, PackageUse):
            return replace(fact, is_here=fact.package in self.packages)
        if isinstance(fact, ConstructUse) and fact.kind == "foreign":
            return replace(fact, is_installed=self.finder.is_installed(fact.location.path))
        return fact

    def _with_known(self, use: ProgramUse) -> ProgramUse:
        """The use of a package outside of the workspace, with those of its programs or components that are known and may be meant."""
        if self.types.known(use.package, use.program, use.ros) is not None:
            return use
        known = load_known(use.package, use.ros) or {}
        return use if use.program in known else replace(use, similar=similar_names(use.program, known, use.package))

    def given(self, job: Job, nodes: Iterable[Node]) -> tuple[LaunchFact, ...]:
        """The parameter files of a launched process, and which of their sections are for one of its *nodes*.

        A process that is not followed from its source to its end may have more nodes than are known.
        """
        if not job.files:
            return ()
        every = tuple(nodes)
        names = [node.name for node in every]
        is_whole = job.group is not None and not any(
            "?" in node.name or any(unknown.field == "endpoints" for unknown in node.unknowns) for node in every
        )
        found = []
        for use in job.files:
            patterns = tuple(_matched(pattern, names, is_whole) for pattern in use.patterns)
            text = use.text if not use.text.startswith("$(rewritten") else ""
            made = self.finder.completed(FileUse(location=use.location, kind="parameters", text=text))
            is_found = True if use.is_read else made.is_found
            found.append(replace(use, patterns=patterns, is_found=is_found, path=use.path or made.path))
        return tuple(found)


def _matched(pattern: NodePattern, names: list[str], is_whole: bool) -> NodePattern:
    if pattern.matches is not None:
        return pattern
    if any("?" not in name and matches(pattern.pattern, name) for name in names):
        return replace(pattern, matches=True)
    return replace(pattern, matches=False if is_whole else None)
