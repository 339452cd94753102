# SPDX-License-Identifier: Apache-2.0
"""Packages whose directories programs ask for, and that their own package does not depend on."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, listed, spelled_out
from haros_ci.api.packages import (
    Lookup,
    Provisions,
    Reason,
    closes_a_cycle,
    dependency_tags,
    last_dependency,
    lookups,
    meant_here,
    proposed_before,
    said_misplaced,
)

#: So many places of one package are related.
_SHOWN = 3


def check(project: Project) -> Iterator[Finding]:
    provisions, proposed = Provisions(project), dict(proposed_before(Reason.LOOKUP, project))
    for package in project.packages:
        found = list(lookups(package)) if package.manifest is not None and package.ros is not None else []
        if not found:
            continue
        provided = provisions.of(package, tests=False)
        missing: dict[str, list[Lookup]] = {}
        circular: dict[str, list[Lookup]] = {}
        for use in found:
            if use.name == package.name or not _is_to_be_had(use.name, package):
                continue
            if not provisions.lacks(provided, frozenset((use.name,))):
                continue
            if closes_a_cycle(package.name, use.name, project.manifests):
                continue
            closing = closes_a_cycle(package.name, use.name, project.manifests, proposed)
            (circular if closing else missing).setdefault(use.name, []).append(use)
            if not closing:
                proposed[package.name] = proposed.get(package.name, frozenset()) | {use.name}
        if missing:
            yield _finding(package, missing)
        if circular:
            yield _circular(package, circular)


def _is_to_be_had(name: str, package: ProjectPackage) -> bool:
    """Whether declaring it helps: unknown-package-in-code tells of what does not exist."""
    project = package.project
    if project.package(name) is not None:
        return True
    if project.knowledge.is_package(name) is not True or not project.knowledge.is_current(name, package.ros):
        return False
    names = {other_package.name for other_package in project.packages}
    return any(name in other_package.declared for other_package in project.packages) or meant_here(name, names) is None


def _finding(package: ProjectPackage, missing: dict[str, list[Lookup]]) -> Finding:
    tag = "exec_depend" if package.raw.format > 1 else "run_depend"
    names = tuple(missing)
    them, without = ("it", names[0]) if len(names) == 1 else ("them", "these packages")
    return Finding(
        at=last_dependency(package),
        message=f"programs of {package.name} look up the directory of {listed(names)}, but package.xml does not declare {them}: "
        f"they fail on a machine without {without}; add {spelled_out([dependency_tags(package, tag, name) for name in names])}{said_misplaced(package, names)}",
        about=(package.name, *names),
        related=tuple((use.location, f"needs {name}") for name, uses in missing.items() for use in uses[:_SHOWN]),
        apart=names,
    )


def _circular(package: ProjectPackage, circular: dict[str, list[Lookup]]) -> Finding:
    """What other findings of the run have these packages declare leads back to *package*: both cannot be declared."""
    names = tuple(circular)
    them = ("it needs", "it") if len(names) == 1 else ("they need", "them")
    return Finding(
        at=last_dependency(package),
        message=f"programs of {package.name} look up the directory of {listed(names)}, but package.xml does not declare {them[1]}; "
        f"{them[0]} {package.name} in turn, as another finding says, and with both declared the build tool finds no order; "
        f"move what is looked up to a package that both depend on",
        about=(package.name, *names),
        related=tuple((use.location, f"needs {name}") for name, uses in circular.items() for use in uses[:_SHOWN]),
        apart=names,
        level=Level.NOTE,
    )


CHECK = Check(
    id="undeclared-lookup-dependency",
    summary="Package whose directory a program looks up and package.xml does not declare.",
    level=Level.WARNING,
    tags=("packages", "code"),
    project=check,
)
