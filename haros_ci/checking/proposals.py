# SPDX-License-Identifier: Apache-2.0
"""Which packages of a workspace the checks of manifests propose to declare: dependencies that are proposed in one run close no cycle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from enum import IntEnum

from haros_ci.checking.imports import imports_of
from haros_ci.checking.lookups import lookups
from haros_ci.checking.needs import Need, lacking, needs_of
from haros_ci.checking.project import Project
from haros_ci.checking.provision import Provisions
from haros_ci.checking.undeclared import closes_a_cycle, used_by_launch_files

#: By package, packages that it is to declare.
Edges = Mapping[str, frozenset[str]]


class Reason(IntEnum):
    """What asks for a dependency. Of two that close a cycle the earlier one is proposed: what stops a build comes first."""

    BUILD = 1
    IMPORT = 2
    LAUNCH = 3
    LOOKUP = 4
    TEST = 5
    PLUGIN = 6


def proposed_before(reason: Reason, project: Project) -> Edges:
    """What reasons before *reason* have proposed, by package, of packages of the workspace alone: no other ones need them.

    Dependencies that would close a cycle with declared or with earlier ones are left out, as no check proposes them. More may be named than is
    proposed in the end (uses that are optional, or of tests): a later check then proposes less.
    """
    return project.sources.once(("proposed before", reason), lambda: _before(reason, project))


def _before(reason: Reason, project: Project) -> Edges:
    if reason is Reason.BUILD:
        return {}
    last = Reason(reason - 1)
    edges = dict(proposed_before(last, project))
    names = project.manifests.keys()
    for package, asked in _asked(last, project):
        for name in sorted((asked & names) - {package}):
            if not closes_a_cycle(package, name, project.manifests, edges):
                edges[package] = edges.get(package, frozenset()) | {name}
    return edges


def _asked(reason: Reason, project: Project) -> Iterator[tuple[str, frozenset[str]]]:
    if reason is Reason.LAUNCH:
        for system in project.systems:
            yield from sorted(used_by_launch_files(system).items())
        return
    provisions = Provisions(project)
    for package in project.packages:
        if package.manifest is None:
            continue
        if reason is Reason.LOOKUP:
            found: Iterable[str] = (use.name for use in lookups(package)) if package.ros is not None else ()
            yield package.name, frozenset(found)
            continue
        is_test = reason is Reason.TEST
        needs: list[Need] = []
        if reason in (Reason.BUILD, Reason.TEST):
            needs += needs_of(package, project.sources, tests=is_test)
        if reason in (Reason.IMPORT, Reason.TEST):
            needs += imports_of(package, project.sources, tests=is_test)
        yield package.name, lacking(package, needs, provisions)
