# SPDX-License-Identifier: Apache-2.0
"""What a manifest says under the ROS that its package counts for: conditions decided where they can be (REP 149)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.wording import listed
from haros_ci.knowledge.knowledge import ROS_1, ROS_2
from haros_ci.model.condition import evaluate
from haros_ci.model.element import Element
from haros_ci.model.location import Location
from haros_ci.model.package import Dependency
from haros_ci.regex import regex

_VARIABLE = regex(r"\$(\w{1,100})")
#: Variables that systems set, or that build farms do.
_OF_SYSTEMS = frozenset(("ROS_PYTHON_VERSION", "ROS_OS_OVERRIDE", "PLATFORM", "DISTRIB_CODENAME", "DISTRIB_ID"))
#: A distribution of ROS 2 that is yet to come.
_LATER = "zzz"
#: The kinds of dependencies that are there when the package is built.
BUILD = ("buildtool_depend", "build_depend", "depend")
#: Those that are there when it runs.
EXEC = ("exec_depend", "run_depend", "depend")
#: Those that come with a package wherever another one needs it (REP 149: build_export_depend, buildtool_export_depend, exec_depend).
EXPORTED = ("build_export_depend", "buildtool_export_depend", *EXEC)

#: Packages that are looked through for what others bring along; a distribution has some 2,000 in all.
MOST = 3_000


def holds(package: ProjectPackage, condition: str | None) -> bool | None:
    """Whether *condition* holds under the package's ROS; None if it depends on anything else."""
    if condition is None:
        return True
    return evaluate(condition, {"ROS_VERSION": str(package.ros)} if package.ros else {})


def never_holds(package: ProjectPackage, condition: str | None) -> bool:
    """Whether *condition* holds nowhere where the package is built: not under its ROS, for no distribution of that, with other variables unset, which are then empty (REP 149)."""
    if condition is None or package.ros is None:
        return False
    known = {name: "" for name in _VARIABLE.findall(condition) if name not in _OF_SYSTEMS}
    known |= {"ROS_VERSION": str(package.ros)}
    distributions = ROS_1 if package.ros == 1 else (*ROS_2, _LATER)
    return all(evaluate(condition, {**known, "ROS_DISTRO": one}) is False for one in distributions)


def counted(package: ProjectPackage) -> tuple[Dependency, ...]:
    """The dependencies of *package* but for those whose condition never holds."""
    return tuple(one for one in package.raw.dependencies if not never_holds(package, one.condition))


def said_never(package: ProjectPackage, names: Iterable[str]) -> str:
    """Where the manifest has one of the packages *names* under a condition that never holds; "" where it has none so."""
    asked = frozenset(names)
    for one in package.raw.dependencies:
        if one.name in asked and never_holds(package, one.condition):
            return f" (line {one.line} has {one.name} under a condition that never holds here: {one.condition})"
    return ""


def holds_for_python(condition: str | None, version: str) -> bool | None:
    """Whether *condition* holds where ROS_PYTHON_VERSION is *version*; None if it depends on anything else."""
    return True if condition is None else evaluate(condition, {"ROS_PYTHON_VERSION": version})


def applying(package: ProjectPackage, parent: Element, *tags: str) -> tuple[Element, ...]:
    """The children of *parent* with *tags* that no condition rules out."""
    return tuple(
        element for element in parent.all(*tags) if holds(package, element.attributes.get("condition")) is not False
    )


def needs(package: ProjectPackage, *kinds: str) -> tuple[Dependency, ...]:
    """The dependencies of these kinds (all without any) that no condition rules out."""
    return tuple(
        dependency
        for dependency in package.raw.dependencies
        if (not kinds or dependency.kind in kinds) and holds(package, dependency.condition) is not False
    )


def exports(package: ProjectPackage, *tags: str) -> tuple[Element, ...]:
    """The elements of the export section with *tags* (all without any) that no condition rules out."""
    if package.manifest is None:
        return ()
    return tuple(
        child
        for export in package.manifest.all("export")
        for child in (applying(package, export, *tags) if tags else tuple(export.children))
    )


def build_types(package: ProjectPackage) -> tuple[Element, ...]:
    """Its build_type elements that no condition rules out."""
    return exports(package, "build_type")


def word(element: Element) -> str:
    """The text of *element*, white space put in order."""
    return " ".join(element.text.split())


def place(package: ProjectPackage, element: Element | Dependency | None) -> Location:
    """Where *element* stands in the manifest; its root without one."""
    line = element.line if element is not None else package.manifest.line if package.manifest is not None else 1
    return Location(package.manifest_path, line or 1)


def is_nested(package: ProjectPackage) -> bool:
    """Whether it lies inside another package. Never in a run: what lies inside a package is part of it, as for catkin and colcon."""
    parts = package.path.split("/")
    above = {"/".join(parts[:end]) for end in range(1, len(parts))} | {"."}
    return not package.project.roots.isdisjoint(above - {package.path})


def reaches(package: ProjectPackage, kinds: tuple[str, ...], *targets: str) -> bool | None:
    """Whether the package depends, directly or not, by one of these *kinds* of dependency on one of *targets*; None if that is not known."""
    return brings(package, (need.name for need in needs(package, *kinds)), *targets)


def brings(package: ProjectPackage, names: Iterable[str], *targets: str) -> bool | None:
    """Whether one of *targets* is among *names* or a dependency of one of them; None if that is not known.

    The dependencies of a package of the workspace are those of its manifest, those of other packages come from the knowledge of releases for the
    ROS of *package*.
    """
    ones = frozenset(names)
    key = ("brings", package.ros, ones, targets)
    return package.project.sources.once(key, lambda: _brings(package, ones, targets))


def _brings(package: ProjectPackage, names: Iterable[str], targets: Sequence[str]) -> bool | None:
    project = package.project
    seen: set[str] = set()
    rest = sorted(names)
    is_known = True
    while rest:
        name = rest.pop()
        if name in targets:
            return True
        if name in seen:
            continue
        seen.add(name)
        if len(seen) > MOST:
            return None
        other = project.package(name)
        if other is not None:
            rest += [need.name for need in needs(other, *EXPORTED)]
        else:
            brought = project.knowledge.depends(name, package.ros)
            is_known = is_known and brought is not None and project.knowledge.is_whole(name)
            rest += sorted(brought or ())
    return False if is_known else None


def said_misplaced(package: ProjectPackage, names: Iterable[str]) -> str:
    """Where the manifest has the packages *names* inside of another element, in which no tool reads them; "" where it has none so."""
    dependencies = frozenset(names)
    found: list[tuple[str, Element, Element]] = []
    waiting = list(package.manifest.children) if package.manifest is not None else []
    while waiting:
        element = waiting.pop()
        waiting += element.children
        for child in element.children:
            if (child.tag == "depend" or child.tag.endswith("_depend")) and child.text.strip() in dependencies:
                found.append((child.text.strip(), child, element))
    if not found:
        return ""
    _, first, outer = min(found, key=lambda item: item[1].line)
    if len({name for name, _, _ in found}) == 1:
        return f" (line {first.line} has it inside <{outer.tag}>, where no tool reads it: move it out)"
    there = listed(sorted({name for name, _, _ in found}))
    return f" (package.xml has {there} inside <{outer.tag}>, from line {first.line} on, where no tool reads them: move them out)"
