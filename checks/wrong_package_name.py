# SPDX-License-Identifier: Apache-2.0
"""Package names that the rules do not allow, and other names where the package's own name is required."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import CMakeCommand

#: The macros that compare the name in the manifest with that of project(), and stop.
COMPARING = (
    "catkin_package",
    "catkin_metapackage",
    "ament_package",
    "ament_auto_package",
    "rosidl_generate_interfaces",
)
#: What catkin_pkg reads at all.
READABLE = regex(r"[a-zA-Z0-9][a-zA-Z0-9_-]*")
#: What REP 144 asks for: lower case, digits and single underscores, a letter first, two characters at least.
PROPER = regex(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*_?")
#: What rosidl generates code for: no hyphen, no capital, no two underscores, none at the end.
OF_INTERFACES = regex(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.manifest is None:
            continue
        yield from _allowed(package)
        if package.raw.build_type != "ament_python":  # nothing runs its CMake
            yield from _of_project(package)
        yield from _of_setup(package)


def _allowed(package: ProjectPackage) -> Iterator[Finding]:
    name = package.name
    interfaces = package.commands("rosidl_generate_interfaces")
    if READABLE.fullmatch(name) is None:
        if any(mark in name for mark in "@{}$%<>"):
            return  # a template of a manifest
        message = (
            f"{name} is not a valid package name: catkin and colcon reject the manifest; use lower case letters, "
            "digits and _"
        )
        yield _finding(package, package.at("name"), message, "refused", Level.ERROR)
    elif interfaces and OF_INTERFACES.fullmatch(name) is None:
        message = (
            f"{name} is not a valid name for an interface package: rosidl generates no code for it; use lower case "
            "letters, digits and single _"
        )
        related = ((interfaces[0].location, "interfaces are generated here"),)
        yield _finding(package, package.at("name"), message, "interfaces", Level.ERROR, related)
    elif PROPER.fullmatch(name) is None or len(name) < 2:
        message = (
            f"{name} does not follow REP 144 (lower case letters, digits and single _, a letter first): tools that "
            "derive names of code, topics or Debian packages from it fail; rename it"
        )
        yield _finding(package, package.at("name"), message, "convention", Level.NOTE)


def _of_project(package: ProjectPackage) -> Iterator[Finding]:
    """The name that project() gives must be the package's own."""
    calls = [c for c in package.commands(*COMPARING) if not c.is_conditional and not c.is_test]
    if not calls:
        return
    named = _named(package, calls[0])
    name = named.arguments[0] if named is not None and named.arguments else package.name
    if named is not None and name != package.name and "${" not in name:
        yield _finding(
            package,
            named.location,
            (
                f"CMake has project({name}), package.xml has {package}: {calls[0].name}() stops, because the two names "
                "must be equal"
            ),
            "project",
            Level.ERROR,
            (
                (package.at("name"), f"the package's name is {package}"),
                (calls[0].location, "the names are compared here"),
            ),
        )


def _named(package: ProjectPackage, call: CMakeCommand) -> CMakeCommand | None:
    """The project() that counts where *call* stands: the last before it in the same file, if all of them are certain."""
    before = []
    for command in package.commands("project", call.name):
        if command is call:
            break
        if command.directory == call.directory:
            before.append(command)
    return before[-1] if before and not any(command.is_conditional for command in before) else None


def _of_setup(package: ProjectPackage) -> Iterator[Finding]:
    """setup.py of an ament_python package should call it as the manifest does."""
    distribution = package.build.distribution
    if package.raw.build_type != "ament_python" or distribution is None or not distribution.name:
        return
    if _normal(distribution.name) != _normal(package.name):
        yield _finding(
            package,
            Location(distribution.location.path, distribution.location.line),
            (
                f"setup.py has the name {distribution.name}, package.xml {package}: ROS and Python search for the files of the "
                "package under different names; use one name"
            ),
            "setup.py",
            None,
            ((package.at("name"), f"the package's name is {package}"),),
        )


def _normal(name: str) -> str:
    """Names of Python distributions are equal whatever their case and separators (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def _finding(
    package: ProjectPackage,
    at: Location,
    message: str,
    what: str,
    level: Level | None,
    related: tuple[tuple[Location, str], ...] = (),
) -> Finding:
    return Finding(at=at, message=message, about=(package.name, what), related=related, level=level)


CHECK = Check(
    id="wrong-package-name",
    summary="Invalid package name, or different names in package.xml, CMake and setup.py.",
    level=Level.WARNING,
    catalogue="M08",
    tags=("packages",),
    project=check,
)
