# SPDX-License-Identifier: Apache-2.0
"""Packages that the tests of a package need, and that no declared dependency brings."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage
from haros_ci.api.packages import (
    Need,
    Provisions,
    Reason,
    add_dependency,
    closes_a_cycle,
    dependency_tags,
    first_provider,
    imports_of,
    is_of_ros,
    last_dependency,
    needs_of,
    others_of,
    proposed_before,
    said_misplaced,
)

_SHOWN = 3
#: Headers that come with the commands that make tests of them.
_FRAMEWORKS = ("#include <gtest/", "#include <gmock/")


def check(project: Project) -> Iterator[Finding]:
    provisions, sources = Provisions(project), project.sources
    proposed = dict(proposed_before(Reason.TEST, project))
    for package in project.packages:
        if package.manifest is None:
            continue
        always = {need.providers for need in (*needs_of(package, sources), *imports_of(package, sources))}
        needs = [*needs_of(package, sources, tests=True), *imports_of(package, sources, tests=True)]
        needs = [need for need in needs if need.providers not in always and not need.what.startswith(_FRAMEWORKS)]
        provided = provisions.of(package) if needs else None
        missing: dict[frozenset[str], list[Need]] = {}
        for need in needs:
            if provided is not None and provisions.lacks(provided, need.providers):
                missing.setdefault(need.providers, []).append(need)
        for uses in missing.values():
            name = first_provider(uses[0].providers, package)
            if any(name in providers and name == first_provider(providers, package) for providers in always):
                continue  # it is needed without the tests, too
            if closes_a_cycle(package.name, name, project.manifests, proposed):
                continue
            proposed[package.name] = proposed.get(package.name, frozenset()) | {name}
            yield _finding(package, uses)


def _finding(package: ProjectPackage, uses: list[Need]) -> Finding:
    name = first_provider(uses[0].providers, package)
    others = others_of(uses[0].providers, name, package)
    is_certain = not others and is_of_ros(name, package.project)
    fix = add_dependency(package, "test_depend", name) if is_certain else None
    alternative = f" (or {', '.join(others)})" if others else ""
    return Finding(
        at=last_dependency(package),
        message=f"the tests of {package.name} need {name} ({uses[0].what}), but package.xml does not declare it: they "
        f"fail on a machine without {name}; add {dependency_tags(package, 'test_depend', name)}{alternative}{said_misplaced(package, (name,))}",
        about=(package.name, name),
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=(name,),
        fixes=() if fix is None else (fix,),
    )


CHECK = Check(
    id="undeclared-test-dependency",
    summary="Test dependency that package.xml does not declare.",
    level=Level.WARNING,
    project=check,
    tags=("packages", "build"),
)
