# SPDX-License-Identifier: Apache-2.0
"""Packages that are built with catkin or ament's CMake and do not depend on it: the build tool is a package like any other."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.check import Finding
from haros_ci.checking.editing import add_dependency
from haros_ci.checking.manifests import BUILD, EXPORTED, build_types, needs, place, word
from haros_ci.checking.needs import needs_of
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.provision import Provisions
from haros_ci.model.build import CMakeCommand
from haros_ci.model.location import Location
from haros_ci.results.fix import Fix
from haros_ci.results.rule import Level

AMENT = ("ament_package", "ament_auto_package", "autoware_ament_auto_package")
CATKIN = ("catkin_package", "catkin_metapackage")


def undeclared_build_tools(project: Project) -> Iterator[Finding]:
    """One finding for a package whose manifest has no dependency on its build tool, where no other need tells of it (a dependency that is
    known nowhere may bring it: a warning).
    """
    bringing, provisions = _bringing(project), Provisions(project)
    for package in project.packages:
        if package.manifest is not None:
            yield from _lacking(package, bringing, provisions)


def _lacking(package: ProjectPackage, bringing: frozenset[str], provisions: Provisions) -> Iterator[Finding]:
    catkin = always_called(package, *CATKIN)
    kinds = {need.kind for need in needs(package) if need.name == "catkin"}
    if (
        package.name != "catkin"
        and package.ros != 2
        and catkin is not None
        and always_called(package, *AMENT) is None
        and "buildtool_depend" not in kinds
        and not _is_undeclared(package, "catkin", provisions)
    ):
        is_built = bool(kinds & {"build_depend", "depend"})
        stops = catkin.name == "catkin_package" and not is_built
        effect = "and catkin_package() stops without" if stops else "of which catkin warns"
        if is_built or stops or package.raw.is_metapackage:
            yield _finding(
                package,
                place(package, next((n for n in needs(package) if n.name == "catkin"), None)),
                f"{package} has no buildtool_depend on catkin, {effect}; add <buildtool_depend>catkin</buildtool_depend>",
                "catkin",
                ((catkin.location, f"{catkin.name}() is called"),),
                add_dependency(package, "buildtool_depend", "catkin"),
                None if stops else Level.WARNING,
            )
    found = _finds(package, "ament_cmake_auto") or _finds(package, "ament_cmake_ros") or _finds(package, "ament_cmake")
    if package.ros == 2 and found is not None and [word(e) for e in build_types(package)] == ["ament_cmake"]:
        if not any(_is_cmake(need.name) or need.name in bringing for need in needs(package, *BUILD)):
            name = found.arguments[0]
            if _is_undeclared(package, name, provisions) or _is_brought(package, name, provisions):
                return
            yield _finding(
                package,
                place(package, None),
                (
                    f"{package} is built with {name}, but does not depend on it: on a machine with only the declared "
                    f"dependencies {name} is missing; add <buildtool_depend>{name}</buildtool_depend>"
                ),
                name,
                ((found.location, f"{name} is searched for here"),),
                add_dependency(package, "buildtool_depend", name),
                Level.WARNING,
            )


def _is_undeclared(package: ProjectPackage, name: str, provisions: Provisions) -> bool:
    """Whether undeclared-dependency tells that the manifest lacks the CMake package *name*."""
    provided = provisions.of(package, tests=False)
    uses = (use for use in needs_of(package, package.project.sources) if use.what == f"find_package({name})")
    return any(provisions.lacks(provided, use.providers) for use in uses)


def _is_brought(package: ProjectPackage, name: str, provisions: Provisions) -> bool:
    """Whether what the manifest declares brings the CMake package *name* along: rosidl_default_generators has ament_cmake."""
    waiting, seen = [need.name for need in needs(package, *BUILD)], set[str]()
    while waiting:
        brought = (provisions.brought(waiting.pop(), 2) or frozenset()) - seen
        if name in brought:
            return True
        seen |= brought
        waiting += brought
    return False


def _bringing(project: Project) -> frozenset[str]:
    """The packages that ament's CMake, or what may be it, comes along with wherever they are used."""
    users: dict[str, list[str]] = {}
    for package in project.packages:
        for need in needs(package, *EXPORTED):
            users.setdefault(need.name, []).append(package.name)
    rest = [name for name in users if _is_cmake(name)]
    found: set[str] = set()
    while rest:
        new = set(users.get(rest.pop(), ())) - found
        found |= new
        rest += new
    return frozenset(found)


def _is_cmake(name: str) -> bool:
    return "cmake" in name


def always_called(package: ProjectPackage, *names: str) -> CMakeCommand | None:
    """The first call of one of *names* that is made in every build."""
    return next((c for c in package.commands(*names) if not c.is_conditional and not c.is_test), None)


def _finds(package: ProjectPackage, name: str) -> CMakeCommand | None:
    calls = package.commands("find_package")
    return next((c for c in calls if c.arguments[:1] == (name,) and not c.is_conditional and not c.is_test), None)


def _finding(
    package: ProjectPackage,
    at: Location,
    message: str,
    name: str,
    related: tuple[tuple[Location, str], ...],
    fix: Fix | None,
    level: Level | None,
) -> Finding:
    return Finding(
        at=at,
        message=message,
        about=(package.name, name),
        related=related,
        apart=(name,),
        fixes=() if fix is None else (fix,),
        level=level,
    )
