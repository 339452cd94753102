# SPDX-License-Identifier: Apache-2.0
"""Packages whose manifest names another build type or build tool than the one that they are written for, or none."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, is_slip
from haros_ci.api.packages import (
    BUILD,
    EXPORTED,
    CMakeCommand,
    Provisions,
    add_dependency,
    add_export,
    build_types,
    exports,
    needs,
    needs_of,
    place,
    set_text,
    word,
)

#: What colcon can build, as a rule (colcon-ros and its extensions).
KNOWN = ("ament_cmake", "ament_python", "catkin", "cmake", "ament_cargo", "ament_gradle", "ament_swift")
AMENT = ("ament_package", "ament_auto_package", "autoware_ament_auto_package")
CATKIN = ("catkin_package", "catkin_metapackage")

#: What tells one ROS from the other: a condition of a manifest (REP 149), a branch of CMake.
_CONDITION = re.compile(r"\bcondition\s*=\s*[\"'][^\"'<>]{0,200}\$(?:ROS_VERSION|ROS_DISTRO)\b")
_BRANCH = re.compile(
    r"^[ \t]*(?:else)?if[ \t]*\([^\n#]{0,200}(?:ROS_VERSION|CATKIN_DEVEL_PREFIX|catkin_FOUND)\b",
    re.IGNORECASE | re.MULTILINE,
)
_COMMENT = re.compile(r"<!--.{0,10000}?-->", re.DOTALL)


def check(project: Project) -> Iterator[Finding]:
    bringing = _bringing(project)
    for package in project.packages:
        if package.manifest is not None:
            yield from _build_type(package)
            yield from _build_tool(package, bringing)


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
    ament = _call(package, *AMENT)
    has_files = bool(package.project.workspace.names)
    condition = ""
    if ament is not None and _call(package, *CATKIN) is None and package.ros != 1:
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


def _builds_for_both(package: ProjectPackage) -> bool:
    """Whether the package is built by either ROS: a condition of its manifest or a branch of its CMake tells one from the other."""
    return _CONDITION.search(_COMMENT.sub("", package.project.text(package.manifest_path))) is not None or (
        _BRANCH.search(package.project.text(package.cmake_path)) is not None
    )


def _has_misspelt(package: ProjectPackage) -> bool:
    """Whether a file beside package.xml is nearly called CMakeLists.txt."""
    prefix = package.inside("")
    names = (path[len(prefix) :] for path in package.project.workspace.names if path.startswith(prefix))
    return any(is_slip(name, "CMakeLists.txt") for name in names if "/" not in name)


def _mismatches(package: ProjectPackage, kind: str, at: Location) -> Iterator[Finding]:
    ament, catkin = _call(package, *AMENT), _call(package, *CATKIN)
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
    elif (
        kind == "ament_python" and has_files and not any(map(package.has, ("setup.py", "setup.cfg", "pyproject.toml")))
    ):
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
        if call is not None and made is not None:
            yield _finding(
                package,
                at,
                (
                    f"{package} has the build type ament_python: colcon runs setup.py but not CMakeLists.txt, so {made.name} "
                    "is not built; use ament_cmake with ament_cmake_python, or a separate package"
                ),
                "CMake is not run",
                ((made.location, f"{made.name} is defined here"),),
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


def _build_tool(package: ProjectPackage, bringing: frozenset[str]) -> Iterator[Finding]:
    """The build tool is a package like any other: what calls it depends on it."""
    catkin = _call(package, *CATKIN)
    kinds = {need.kind for need in needs(package) if need.name == "catkin"}
    if (
        package.name != "catkin"
        and package.ros != 2
        and catkin is not None
        and _call(package, *AMENT) is None
        and "buildtool_depend" not in kinds
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
                _only(add_dependency(package, "buildtool_depend", "catkin")),
                None if stops else Level.WARNING,
            )
    found = _finds(package, "ament_cmake_auto") or _finds(package, "ament_cmake_ros") or _finds(package, "ament_cmake")
    if package.ros == 2 and found is not None and [word(e) for e in build_types(package)] == ["ament_cmake"]:
        if not any(_is_cmake(need.name) or need.name in bringing for need in needs(package, *BUILD)):
            name = found.arguments[0]
            if _is_undeclared(package, name) or _is_brought(package, name):
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
                _only(add_dependency(package, "buildtool_depend", name)),
                Level.WARNING,
            )


def _is_undeclared(package: ProjectPackage, name: str) -> bool:
    """Whether undeclared-dependency tells that the manifest lacks the CMake package *name*."""
    provisions = Provisions(package.project)
    provided = provisions.of(package, tests=False)
    uses = (use for use in needs_of(package, package.project.sources) if use.what == f"find_package({name})")
    return any(provisions.lacks(provided, use.providers) for use in uses)


def _is_brought(package: ProjectPackage, name: str) -> bool:
    """Whether what the manifest declares brings the CMake package *name* along: rosidl_default_generators has ament_cmake."""
    waiting, seen = [need.name for need in needs(package, *BUILD)], set[str]()
    provisions = Provisions(package.project)
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


def _call(package: ProjectPackage, *names: str) -> CMakeCommand | None:
    """The first call of one of *names* that is made in every build."""
    return next((c for c in package.commands(*names) if not c.is_conditional and not c.is_test), None)


def _finds(package: ProjectPackage, name: str) -> CMakeCommand | None:
    calls = package.commands("find_package")
    return next((c for c in calls if c.arguments[:1] == (name,) and not c.is_conditional and not c.is_test), None)


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
