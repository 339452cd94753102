# SPDX-License-Identifier: Apache-2.0
"""Packages whose manifest names another build type or build tool than the one that they are written for, or none."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, is_slip, listed, regex
from haros_ci.api.packages import (
    AMENT,
    CATKIN,
    NO_ENTRIES,
    CMakeCommand,
    add_export,
    always_called,
    build_types,
    entries_of,
    exports,
    is_ignored,
    place,
    set_text,
    word,
)

#: What colcon can build, as a rule (colcon-ros and its extensions).
KNOWN = ("ament_cmake", "ament_python", "catkin", "cmake", "ament_cargo", "ament_gradle", "ament_swift")

#: What tells one ROS from the other: a condition of a manifest (REP 149), a branch of CMake.
_CONDITION = regex(r"\bcondition\s*=\s*[\"'][^\"'<>]{0,200}\$(?:ROS_VERSION|ROS_DISTRO)\b")
_BRANCH = regex(
    r"^[ \t]*(?:else)?if[ \t]*\([^\n#]{0,200}(?:ROS_VERSION|CATKIN_DEVEL_PREFIX|catkin_FOUND)\b",
    re.IGNORECASE | re.MULTILINE,
)
_COMMENT = regex(r"<!--.{0,10000}?-->", re.DOTALL)


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.manifest is not None:
            yield from _build_type(package)
    yield from _not_built(project)


def _build_type(package: ProjectPackage) -> Iterator[Finding]:
    """At most one finding about the build type: with it wrong, nothing more can be said."""
    found = build_types(package)
    certain = [element for element in found if not element.attributes.get("condition")]
    if len(certain) > 1 and len({word(element) for element in certain}) > 1:
        names = " and ".join(word(element) for element in certain)
        message = f"{package} has the build types {names}: colcon allows one and skips the package; remove the others"
        yield _finding(package, place(package, certain[1]), message, "several")
    elif not found:
        yield from _none(package)
    elif len(found) == 1:
        yield from _mismatches(package, word(found[0]), place(package, found[0]))


def _none(package: ProjectPackage) -> Iterator[Finding]:
    """Without a build type colcon takes catkin (REP 149)."""
    ament = always_called(package, *AMENT)
    has_files = bool(package.project.workspace.names)
    condition = ""
    if ament is not None and always_called(package, *CATKIN) is None and package.ros != 1:
        condition = ' condition="$ROS_VERSION == 2"' if _builds_for_both(package) else ""
        why = f"calls {ament.name}()"
        kind, seen = "ament_cmake", ((ament.location, f"{package} is built with ament"),)
    elif package.ros == 2 and has_files and package.has("setup.py") and not package.has("CMakeLists.txt"):
        why = "has a setup.py and no CMakeLists.txt"
        kind, seen = "ament_python", ((Location(package.inside("setup.py"), 1), "what would have to be run"),)
    else:
        return
    yield _finding(
        package,
        place(package, None),
        (
            f"{package} declares no build type and {why}: colcon treats it as a catkin package and leaves it out of "
            f"the environment; add <build_type{condition}>{kind}</build_type> to <export>"
        ),
        "none",
        seen,
        () if condition else _only(add_export(package, "build_type", kind, f"export the build type {kind}")),
        Level.WARNING if condition else None,
    )


def _not_built(project: Project) -> Iterator[Finding]:
    """Packages of catkin without what catkin builds; those of which git leaves it out are one finding, as one line of .gitignore may do it."""
    lost: dict[str, list[tuple[ProjectPackage, Location]]] = {}
    for package in project.packages:
        if package.manifest is None or package.ros != 1 or build_types(package) or not project.workspace.names:
            continue
        if package.raw.is_metapackage:  # catkin goes on with a warning (its catkin_workspace.cmake)
            continue
        tools = {item.name: item for item in package.raw.dependencies if item.kind == "buildtool_depend"}
        if set(tools) == {"catkin"} and not package.has("CMakeLists.txt") and not _has_misspelt(package):
            is_left_out = is_ignored(project.workspace, package.inside("CMakeLists.txt"))
            at = Location(package.manifest_path, tools["catkin"].line or 1)
            lost.setdefault("" if is_left_out else package.name, []).append((package, at))
    for name, found in lost.items():
        package, at = found[0]
        several = len(found) > 1
        names = listed([str(other) for other, _ in found])
        message = f"{names} {'are' if several else 'is'} built with catkin, but {'have' if several else 'has'} no CMakeLists.txt"
        hint = "add it" if name else "a line of .gitignore has git leave it out: correct that, and add the file"
        what = f"{message}: {'their builds fail' if several else 'its build fails'}, and catkin_make that of all packages; {hint}"
        related = tuple((place, f"{other} has none, either") for other, place in found[1:])
        yield _finding(package, at, what, "no CMakeLists.txt", related)


def _builds_for_both(package: ProjectPackage) -> bool:
    """Whether the package is built by either ROS: a condition of its manifest or a branch of its CMake tells one from the other."""
    return _CONDITION.search(_COMMENT.sub("", package.project.text(package.manifest_path))) is not None or (
        _BRANCH.search(package.project.text(package.cmake_path)) is not None
    )


def _has_misspelt(package: ProjectPackage) -> bool:
    """Whether a file beside package.xml is nearly called CMakeLists.txt."""
    folder = "" if package.path == "." else package.path
    inside = entries_of(package.project.workspace.names).get(folder, NO_ENTRIES)
    return any(is_slip(name, "CMakeLists.txt") for name in inside.names - inside.directories)


def _mismatches(package: ProjectPackage, kind: str, at: Location) -> Iterator[Finding]:
    ament, catkin = always_called(package, *AMENT), always_called(package, *CATKIN)
    has_files = bool(package.project.workspace.names)
    if kind not in KNOWN:
        near = next((name for name in KNOWN if is_slip(kind, name) or kind.replace("-", "_").lower() == name), None)
        if near is not None:
            element = build_types(package)[0]
            yield _finding(
                package,
                at,
                (
                    f"{package} has the build type {kind}, which does not exist: colcon does not build the package; write "
                    f"{near}"
                ),
                "unknown",
                fixes=_only(set_text(package, element, near, f"change it to {near}")),
            )
    elif kind in ("ament_cmake", "catkin", "cmake") and has_files and not package.has("CMakeLists.txt"):
        if _has_misspelt(package):
            return  # misspelt-build-file tells of it
        more = (
            " (it has a setup.py: did you mean ament_python?)"
            if package.has("setup.py") and kind == "ament_cmake"
            else ""
        )
        message = f"{package} has the build type {kind}, but no CMakeLists.txt: its build fails{more}"
        yield _finding(package, at, message, "no CMakeLists.txt")
    elif kind == "ament_python" and has_files and not any(map(package.has, ("setup.py", "pyproject.toml"))):
        message = (
            f"{package} has the build type ament_python, but no setup.py: its build fails; add setup.py, or correct "
            "the build type"
        )
        yield _finding(package, at, message, "no setup.py")
    elif kind == "ament_cmake" and catkin is not None and ament is None and not _is_for_both(package):
        yield _other(package, at, kind, catkin, "catkin")
    elif kind == "catkin" and ament is not None and catkin is None and not _is_for_both(package):
        yield _other(package, at, kind, ament, "ament_cmake")
    elif kind == "ament_python" and (ament or catkin) is not None and package.has("setup.py"):
        call = ament or catkin
        made = next((t for t in package.build.targets if not t.is_test and t.kind != "imported"), None)
        interfaces = always_called(package, "rosidl_generate_interfaces")
        if call is not None and (made is not None or interfaces is not None):
            lost, where = "", call.location
            if made is not None:
                lost, where = f"{made.name} is not built", made.location
            elif interfaces is not None:
                lost, where = "its interfaces are not generated", interfaces.location
            yield _finding(
                package,
                at,
                (
                    f"{package} has the build type ament_python: colcon runs setup.py but not CMakeLists.txt, so {lost}; "
                    "use ament_cmake with ament_cmake_python, or a separate package"
                ),
                "CMake is not run",
                ((where, "what CMake would make"),),
                level=Level.WARNING,
            )


def _is_for_both(package: ProjectPackage) -> bool:
    """Whether the manifest tells one ROS from the other: so does its CMake, somehow."""
    return any("ROS_VERSION" in export.attributes.get("condition", "") for export in exports(package, "build_type"))


def _other(package: ProjectPackage, at: Location, kind: str, call: CMakeCommand, meant: str) -> Finding:
    return _finding(
        package,
        at,
        (
            f"{package} has the build type {kind}, but its CMakeLists.txt calls {call.name}() of {meant}: the "
            "packages that use it do not find what it builds; correct the build type"
        ),
        "other",
        ((call.location, f"written for {meant}"),),
    )


def _only(fix: Fix | None) -> tuple[Fix, ...]:
    return () if fix is None else (fix,)


def _finding(
    package: ProjectPackage,
    at: Location,
    message: str,
    what: str,
    related: tuple[tuple[Location, str], ...] = (),
    fixes: tuple[Fix, ...] = (),
    level: Level | None = None,
) -> Finding:
    return Finding(at=at, message=message, about=(package.name, what), related=related, fixes=fixes, level=level)


CHECK = Check(
    id="wrong-build-type",
    summary="Build type that does not fit the package.",
    level=Level.ERROR,
    catalogue="M07",
    tags=("packages",),
    project=check,
)
