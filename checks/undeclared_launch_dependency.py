# SPDX-License-Identifier: Apache-2.0
"""Packages that a launch file needs, and that its own package does not depend on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.api import (
    Check,
    Finding,
    Level,
    Location,
    Project,
    ProjectPackage,
    System,
    dataclass,
    listed,
    spelled_out,
)
from haros_ci.api.launch import PackageUse, included_by, is_nested, is_optional, owner, said_by
from haros_ci.api.packages import (
    Leftovers,
    Package,
    Provisions,
    Reason,
    Sources,
    closes_a_cycle,
    dependency_place,
    dependency_tag,
    imports_of,
    is_aside,
    is_left_out,
    is_of_tests,
    is_to_be_had,
    lacking,
    needs_of,
    proposed_before,
    provided,
    said_gone,
    unreached,
)

#: So many places of one package are related.
_SHOWN = 3


@dataclass(frozen=True, slots=True)
class _UndeclaredPackage:
    """A package that a manifest does not declare, and where its launch files use it."""

    name: str
    uses: tuple[PackageUse, ...]


def check(project: Project) -> Iterator[Finding]:
    """One finding stands for a manifest and level, whatever configurations show it: the first system tells of all."""
    if not project.systems:
        return
    system, leftovers = project.systems[0], Leftovers(project)
    provisions, sources = Provisions(project), project.sources
    used = _used(project.systems)
    names = {**proposed_before(Reason.LAUNCH, project)}
    for name, (_, packages) in used.items():
        names[name] = names.get(name, frozenset()) | _declarable(name, packages, system)
    for package, packages in used.values():
        found, is_whole = provided(package, system)
        if not packages.keys() <= found:
            found |= _of_others(project.package(package.name), provisions, sources)
        groups: dict[tuple[Level | None, bool], list[_UndeclaredPackage]] = {}
        for name, uses in packages.items():
            if name in found or not is_to_be_had(name, package.ros, system):
                continue
            needing = tuple(use for use in uses if not is_optional(use, system))
            needing = tuple(use for use in needing if not leftovers.has(use.location.path, package.name))
            if not needing or all(is_left_out(package, use, system) for use in needing):
                continue
            if closes_a_cycle(package.name, name, system.packages, names):
                continue
            others = tuple(use for use in needing if not is_of_tests(use, package, system))
            if not others:
                groups.setdefault((Level.NOTE, True), []).append(_UndeclaredPackage(name, needing))
                continue
            needing = others
            is_asked = any(
                is_optional(use, system) for use in uses
            )  # another launch file asks: it is meant to be optional
            is_sure = is_whole and not is_asked and not _is_generated(package, system)
            is_sure = is_sure and not all(is_aside(use, system) for use in needing)
            groups.setdefault((None if is_sure else Level.NOTE, False), []).append(_UndeclaredPackage(name, needing))
        for (level, is_test), group in groups.items():
            yield _finding(package, group, level, is_test)


def _of_others(package: ProjectPackage | None, provisions: Provisions, sources: Sources) -> frozenset[str]:
    """What undeclared-dependency and undeclared-import have *package* declare: that is there when its launch files run, too.

    Imports of files that nothing starts or imports do not count: these files may as well go.
    """
    if package is None or package.manifest is None:
        return frozenset()
    imports = tuple(imports_of(package, sources))
    aside = unreached(package, {import_.location.path for import_ in imports}) if imports else frozenset()
    running = (import_ for import_ in imports if import_.location.path not in aside)
    return lacking(package, (*needs_of(package, sources), *running), provisions)


def _finding(package: Package, group: list[_UndeclaredPackage], level: Level | None, is_test: bool) -> Finding:
    tag = "test_depend" if is_test else "exec_depend" if package.format > 1 else "run_depend"
    names = tuple(missing.name for missing in group)
    is_one = len({use.location.path for missing in group for use in missing.uses}) == 1
    if len(group) == 1:
        them, lacking = "it", names[0]
    else:
        them, lacking = "them", "these packages"
    files, fails = ("a launch file", "the launch fails") if is_one else ("launch files", "they fail")
    if is_test:
        files = "a launch file for tests" if is_one else "launch files for tests"
    return Finding(
        at=dependency_place(package),
        message=f"{files} of {package.name} {'uses' if is_one else 'use'} {listed(names)}, but package.xml does not declare {them}: "
        f"{fails} on a machine without {lacking}; add {spelled_out([dependency_tag(tag, name, package) for name in names])}{said_gone(names, package.ros)}",
        about=(package.name, *names),
        related=tuple((use.location, f"needs {missing.name}") for missing in group for use in missing.uses[:_SHOWN]),
        flow=included_by(group[0].uses[0]) if len(group) == 1 else (),
        apart=names,
        level=level,
    )


def _used(systems: Iterable[System]) -> Mapping[str, tuple[Package, dict[str, list[PackageUse]]]]:
    """By package of the workspace, with it, what its launch files use of other packages, at each place once."""
    found: dict[str, tuple[Package, dict[str, list[PackageUse]]]] = {}
    seen: set[tuple[Location, str]] = set()
    for system in systems:
        for use in (said_by(fact, system) for fact in system.facts(PackageUse)):
            place = (use.location, use.package)
            if place in seen or use.location.path in system.refused:
                continue
            seen.add(place)
            package = owner(system, use.location)
            if package is not None and package.name != use.package and not is_nested(use.location, package, system):
                found.setdefault(package.name, (package, {}))[1].setdefault(use.package, []).append(use)
    return found


def _declarable(name: str, packages: Iterable[str], system: System) -> frozenset[str]:
    """Those of the *packages* that the launch files of the package *name* use which do not need *name* by their manifests."""
    return frozenset(package for package in packages if not closes_a_cycle(name, package, system.packages))


def _is_generated(package: Package, system: System) -> bool:
    """Whether MoveIt's setup assistant has written the package: few of its launch files are ever started."""
    folder = "" if package.path == "." else f"{package.path}/"
    return system.workspace is not None and f"{folder}.setup_assistant" in system.workspace.names


CHECK = Check(
    id="undeclared-launch-dependency",
    summary="Package used by a launch file that package.xml does not declare.",
    level=Level.WARNING,
    catalogue="L04",
    tags=("launch", "packages"),
    project=check,
)
