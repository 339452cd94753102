# SPDX-License-Identifier: Apache-2.0
"""Metapackages that list the packages of their repository, but not all of them, or none that exists."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, is_slip, regex, spelled_out
from haros_ci.api.packages import exports, needs, place

#: Words in names of packages that lists leave out on purpose.
LEFT_OUT = regex(
    r"(?:^|_)(?:tests?|testing|testsuite|test\w*|demos?|examples?|tutorials?|samples?|benchmarks?|deprecated|legacy|experimental|dev|devel|docs?|documentation|"
    r"internal|ci|docker|template|playground|sandbox|simulat\w+|sim|gazebo\w*|ignition|gz|webots|tools?|utils?|dummy|mock|rqt|minimal|py)(?:_|$)"
)
_OF_A_LIST = {"buildtool_depend", "exec_depend", "test_depend"}
#: A list of fewer packages tells nothing about what it is a list of.
LEAST = 3
#: The share of the repository's packages that are on the list if it is a list of them.
SHARE = 0.75
#: So many missing packages are named, and so many of their manifests.
RELATED = 20


def check(project: Project) -> Iterator[Finding]:
    lists = [package for package in project.packages if _is_list(package)]
    everywhere = {need.name for meta in lists for need in needs(meta)}
    for meta in lists:
        beside = _beside(project, meta, lists)
        listed = {need.name for need in needs(meta)}
        known = [package for package in beside if package.name in listed]
        eligible = [package for package in beside if not _left_out(package, known)]
        if len(known) >= LEAST and len(known) >= SHARE * len(eligible):
            brought = _installed_with(project, listed)
            text = project.text(meta.manifest_path)
            missing = [
                package
                for package in eligible
                if package.name not in brought | everywhere and not re.search(rf"\b{re.escape(package.name)}\b", text)
            ]
            if missing:
                yield _missing(meta, missing)
        if len(known) >= LEAST:
            yield from _unknown(project, meta, beside, listed)


def _is_list(package: ProjectPackage) -> bool:
    """Whether *package* is a metapackage: it says so, or, in ROS 2, has nothing but packages that are there when it runs."""
    if package.raw.is_metapackage:
        return True
    build = package.build
    has_own = bool(build.targets or build.installed or build.entry_points or build.interfaces or build.python_roots)
    kinds = [need.kind for need in needs(package)]
    return package.ros == 2 and not has_own and kinds.count("exec_depend") >= LEAST and set(kinds) <= _OF_A_LIST


def _beside(project: Project, meta: ProjectPackage, lists: list[ProjectPackage]) -> list[ProjectPackage]:
    """The packages of its repository: those below the directory that it stands in; metapackages are none."""
    above = meta.path.rpartition("/")[0] if meta.path != "." else ""
    prefix = f"{above}/" if above else ""
    return [p for p in project.packages if p.path.startswith(prefix) and p not in lists]


def _left_out(package: ProjectPackage, known: list[ProjectPackage]) -> bool:
    """Whether *package* is not for everybody: by its name, where no listed one is called so, or as it says itself."""
    if exports(package, "deprecated"):
        return True
    mark = LEFT_OUT.search(package.name)
    return mark is not None and not any(mark[0].strip("_") in other_package.name.split("_") for other_package in known)


def _installed_with(project: Project, names: set[str]) -> set[str]:
    """All that is installed with packages of these *names*."""
    found: set[str] = set()
    rest = list(names)
    while rest:
        name = rest.pop()
        if name not in found:
            found.add(name)
            package = project.package(name)
            rest += [need.name for need in needs(package)] if package is not None else []
    return found


def _missing(meta: ProjectPackage, packages: list[ProjectPackage]) -> Finding:
    """One finding for a list, however many packages are not on it."""
    names = [package.name for package in packages]
    one = len(names) == 1
    return Finding(
        at=place(meta, next(iter(needs(meta, "run_depend", "exec_depend")), None)),
        message=f"the metapackage {meta} does not list {spelled_out(names)} of its repository: users who install "
        f"{meta} do not get {('it' if one else 'them')}; add {('it' if one else 'them')} to the list, or add "
        "<deprecated/> to the manifest of a package to leave out",
        about=(meta.name, *names),
        related=tuple((place(package, None), f"{package} is not in the list") for package in packages[:RELATED]),
        apart=(meta.name,),
    )


def _unknown(
    project: Project, meta: ProjectPackage, beside: list[ProjectPackage], listed: set[str]
) -> Iterator[Finding]:
    """Entries that are not here, and by one slip the name of a package that is, and is not on the list."""
    missing = [package.name for package in beside if package.name not in listed]
    for need in needs(meta):
        if project.package(need.name) is not None or need.name in ("catkin", "ament_cmake"):
            continue
        near = next((name for name in missing if is_slip(need.name, name)), None)
        if near is not None:
            yield Finding(
                at=place(meta, need),
                message=f"the metapackage {meta} lists {need.name}, which does not exist: rosdep stops here; write {near}, which "
                "is not listed",
                about=(meta.name, need.name),
                level=Level.WARNING,
            )


CHECK = Check(
    id="incomplete-metapackage",
    summary="Metapackage that does not list all packages of its repository.",
    level=Level.NOTE,
    catalogue="M05",
    tags=("packages",),
    project=check,
)
