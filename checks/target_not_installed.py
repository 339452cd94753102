# SPDX-License-Identifier: Apache-2.0
"""Executables, libraries and scripts that are not installed, or to where nothing looks for them."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator
from dataclasses import replace

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, spelled_out
from haros_ci.api.packages import (
    DevelSpaces,
    Programs,
    Target,
    Uninstalled,
    install_line,
    installs_nothing,
    is_copy_by_name,
    is_program,
    is_said_not_installed,
    left_out_on_purpose,
    lost_plugins,
    may_be_installed,
    plugin_library,
    uninstalled,
)

_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".h++", ".ipp", ".tpp", ".inl")
#: How the reason ends where nothing is seen to need the library.
_ALONE = "nothing can load it; add it to install(TARGETS ...)"
#: How it ends where a class loader needs it.
_BY_CLASS = "is loaded from it"
_NODELET = "nodelet::Nodelet"
#: Languages of files that load nodelets by name.
_LOADERS = ("launch", "python", "yaml", "xml", "shell")
_ORDER = (Level.ERROR, Level.WARNING, Level.NOTE)


def check(project: Project) -> Iterator[Finding]:
    programs, devel = Programs(project), DevelSpaces(project)
    for package in project.packages:
        for finding in _of(package, programs):
            yield replace(finding, level=Level.NOTE) if devel.has(package) else finding
        if _is_known(package) and package.ros is not None and not package.raw.is_metapackage:
            yield from _elsewhere(package, programs)  # a rule that is there, and wrong, counts in a devel space, too


def _of(package: ProjectPackage, programs: Programs) -> Iterator[Finding]:
    if package.ros is None or package.raw.is_metapackage:
        return
    libraries = list(_libraries(package)) if _is_known(package) else []
    left = list(uninstalled(package, programs))
    if _installs_python_alone(package):
        libraries = [replace(library, level=Level.NOTE) for library in libraries]
        left = [replace(one, level=Level.NOTE) if one.kind == "executable" else one for one in left]
    if (libraries or left) and installs_nothing(package):
        yield _nothing(package, libraries, left)
        return
    yield from libraries
    groups: dict[Level, list[Uninstalled]] = {}
    for other_uninstalled in left:
        groups.setdefault(other_uninstalled.level, []).append(other_uninstalled)
    for group in groups.values():
        yield _left_out(package, group)


def _is_known(package: ProjectPackage) -> bool:
    return bool(package.build.commands) and package.cmake.is_whole and not package.cmake.installs_unknown


def _installs_python_alone(package: ProjectPackage) -> bool:
    """Whether all that a package of ROS 1 installs are scripts, by catkin_install_python(): a devel space needs that, too, for their interpreter."""
    return (
        package.ros == 1
        and _is_known(package)
        and bool(package.commands("catkin_install_python"))
        and not package.commands("install")
    )


def _nothing(package: ProjectPackage, libraries: list[Finding], left: list[Uninstalled]) -> Finding:
    """One finding for a package without any install rule: nothing else of it is to be said.

    A note in ROS 1, where who never installs uses such a package from its devel space.
    """
    places = [(library.at, library.apart[0], library.level or Level.ERROR, library.related) for library in libraries]
    places += [
        (other_uninstalled.at, other_uninstalled.shown, other_uninstalled.level, other_uninstalled.related)
        for other_uninstalled in left
    ]
    names = [name for _, name, _, _ in places]
    are = "is" if len(names) == 1 else "are"
    finder = "ros2 run and launch do" if package.ros == 2 else "in an install space rosrun and roslaunch do"
    them = "it" if len(names) == 1 else "them"
    message = f"{package.name} has no install() at all: {spelled_out(names)} {are} built, but not installed, and {finder} not find {them}"
    return Finding(
        at=places[0][0],
        message=message,
        about=(package.name,),
        related=_related(((at, f"{name} is not installed") for at, name, _, _ in places[1:]), (r for *_, r in places)),
        level=min((level for _, _, level, _ in places), key=_ORDER.index) if package.ros == 2 else Level.NOTE,
        fixes=_fixes(package, left) if left and not libraries else (),
    )


def _left_out(package: ProjectPackage, group: list[Uninstalled]) -> Finding:
    """One finding for all programs for which the same is at stake: who adds one to the installation adds them all."""
    group = sorted(group, key=lambda one: is_copy_by_name(one.at.path))  # what is meant first
    first, kinds = group[0], sorted({other_uninstalled.kind for other_uninstalled in group})
    kind = kinds[0] if len(kinds) == 1 else "program"
    runner = "ros2 run and launch do" if package.ros == 2 else "in an install space rosrun and roslaunch do"
    names = [other_uninstalled.shown for other_uninstalled in group]
    command = " and ".join(f"install({'PROGRAMS' if kind == 'script' else 'TARGETS'} ...)" for kind in kinds)
    if len(group) == 1:
        message = f"the {kind} {first.shown} is not installed: {runner} not find it; add it to {command}"
    else:
        message = f"the {kind}s {spelled_out(names)} are not installed: {runner} not find them; add them to {command}"
    things = tuple(other_uninstalled.name for other_uninstalled in group)
    others = ((other_uninstalled.at, f"{other_uninstalled.shown} is not installed") for other_uninstalled in group[1:])
    return Finding(
        at=first.at,
        message=message,
        about=(package.name, *things),
        related=_related(others, (other_uninstalled.related for other_uninstalled in group)),
        apart=things,
        level=first.level,
        fixes=_fixes(package, group),
    )


def _related(
    others: Iterable[tuple[Location, str]], starts: Iterable[tuple[tuple[Location, str], ...]]
) -> tuple[tuple[Location, str], ...]:
    """The other places, and what starts the programs: each place once."""
    found: dict[Location, str] = {}
    for place, text in (*others, *(item for group in starts for item in group)):
        found.setdefault(place, text)
    return tuple(found.items())


def _fixes(package: ProjectPackage, group: list[Uninstalled]) -> tuple[Fix, ...]:
    targets = " ".join(one.name for one in group if one.kind != "script")
    scripts = " ".join(one.name for one in group if one.kind == "script")
    if targets and any(one.at.path != package.cmake_path for one in group if one.kind != "script"):
        return ()
    place = "lib/${PROJECT_NAME}" if package.ros == 2 else "${CATKIN_PACKAGE_BIN_DESTINATION}"
    python = "install" if package.ros == 2 else "catkin_install_python"
    lines = [f"install(TARGETS {targets} DESTINATION {place})"] if targets else []
    lines += [f"{python}(PROGRAMS {scripts} DESTINATION {place})"] if scripts else []
    fix = install_line(package, "\n".join(lines), f"install {spelled_out([one.name for one in group])}")
    return (fix,) if fix is not None else ()


def _elsewhere(package: ProjectPackage, programs: Programs) -> Iterator[Finding]:
    """Executables that are installed to where nothing looks for them: one finding for all that one install() puts there."""
    groups: dict[tuple[Location, str], list[tuple[Target, Location | None]]] = {}
    for target in package.cmake.targets.values():
        if is_program(package, target) and may_be_installed(package, target):
            use = programs.started.get((package.name, target.output))
            place = _wrong_place(package, list(package.cmake.destinations(target.name)), use is not None)
            if place is not None:
                installs = (
                    install.command.location for install in package.cmake.installs if target.name in install.things
                )
                groups.setdefault((next(installs, target.location), place), []).append((target, use))
    for (at, place), group in groups.items():
        yield _misplaced(package, at, place, group)


def _libraries(package: ProjectPackage) -> Iterator[Finding]:
    """Libraries that something needs when it runs, or that are exported."""
    cmake, reported = package.cmake, set[str]()
    lost = lost_plugins(package) if package.ros == 1 else {}
    for target, why, where in _needed(package):
        if target.name in reported or may_be_installed(package, target) or target.is_conditional:
            continue
        if cmake.is_shared(target) is not True:
            continue
        reported.add(target.name)
        is_empty = _has_no_code(target)
        hint = (
            "; it has only headers, and the linker may leave it out: make it an INTERFACE library" if is_empty else ""
        )
        described = sorted({posixpath.basename(plugin.location.path) for plugin in lost.get(target.name, ())})
        if described:
            hint += f"; neither is {described[0]}, which describes it"
        level = Level.ERROR if package.ros == 2 and not is_empty and not why.endswith(_ALONE) else Level.WARNING
        yield _finding(
            package,
            target.name,
            f"the library {target.name} is not installed, but {why}{hint}",
            level=Level.NOTE if why.endswith(_BY_CLASS) and _is_idle(package, target) else level,
            at=target.location,
            related=where,
            fix=_fix(package, target, described),
        )
    if package.ros == 2:
        for plugin in package.build.plugins:
            places = cmake.destinations(plugin.library) if plugin.base == "rclcpp_components::NodeFactory" else ()
            if not places or any("$" in p or p in ("lib", "") for p in places) or plugin.library in reported:
                continue
            reported.add(plugin.library)
            yield _finding(
                package,
                plugin.library,
                (
                    f"the library {plugin.library} is installed to {places[0]}, but component containers load {plugin.type} from "
                    "lib; correct the destination"
                ),
                level=Level.ERROR,
                at=next((i.command.location for i in cmake.installs if plugin.library in i.things), target.location),
                related=((plugin.location, "is registered here"),),
            )


def _is_idle(package: ProjectPackage, target: Target) -> bool:
    """Whether *target* holds nodelets alone, and no launch file, script or page of the workspace names one of them."""
    plugins = [plugin for plugin in package.build.plugins if plugin_library(package, plugin) is target]
    if package.ros != 1 or not plugins or any(plugin.base != _NODELET for plugin in plugins):
        return False
    names = {name for plugin in plugins for name in (plugin.name, plugin.type.replace("::", "/"))}
    described = {plugin.location.path for plugin in plugins} | {package.manifest_path}
    workspace = package.project.workspace
    paths = {file.path for file in workspace.files if file.language in _LOADERS}
    paths |= {path for path in workspace.names if path.lower().endswith((".md", ".rst", ".launch", ".test"))}
    texts = (package.project.text(path) for path in sorted(paths - described) if "CHANGELOG" not in path)
    return not any(name in text for text in texts for name in names)


def _has_no_code(target: Target) -> bool:
    """Whether all sources of a library are headers: it exports nothing, and linkers with --as-needed drop it."""
    return bool(target.sources) and all(path.endswith(_HEADERS) for path in target.sources)


def _needed(package: ProjectPackage) -> Iterator[tuple[Target, str, tuple[tuple[Location, str], ...]]]:
    """Libraries of the package that something else needs, with the reason."""
    cmake = package.cmake
    for target in cmake.targets.values():
        if target.is_installed and not target.is_test and target.kind in ("executable", "library"):
            what = "executable" if target.kind == "executable" else "library"
            for other in cmake.linked(target.name):
                at_run = "fails to start" if target.kind == "executable" else "cannot be loaded"
                why = f"the installed {what} {target.name} is linked with it and {at_run} from the install space"
                yield other, why, ((target.location, f"{target.name}, which is installed"),)
    for plugin in package.build.plugins:
        found = plugin_library(package, plugin)
        if found is not None:
            yield found, f"{plugin.type} {_BY_CLASS}", ((plugin.location, f"declares {plugin.type}"),)
    yield from _left_of_many(package)
    keywords = ("INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS")
    for command in package.commands("ament_export_libraries", "catkin_package"):
        words = command.arguments if command.name != "catkin_package" else command.after("LIBRARIES", *keywords)
        for word in words:
            if word in cmake.targets and not command.is_conditional:
                why = f"{command.name}() exports it: packages that use it cannot find it"
                yield cmake.targets[word], why, ((command.location, "exports it"),)


def _left_of_many(package: ProjectPackage) -> Iterator[tuple[Target, str, tuple[tuple[Location, str], ...]]]:
    """The one shared library of several that is not installed and that no target links: nothing can load it."""
    cmake = package.cmake
    every = [t for t in cmake.targets.values() if t.kind == "library" and not t.is_test and cmake.is_shared(t) is True]
    left = [target for target in every if not may_be_installed(package, target)]
    if len(left) != 1 or len(every) < 4 or is_said_not_installed(package, left[0].location):
        return
    if left[0].name in left_out_on_purpose(package):
        return
    if any(left[0].name in command.arguments[1:] for command in package.commands("target_link_libraries")):
        return
    installed = [(target.location, f"{target.name}, which is installed") for target in every if target is not left[0]]
    yield left[0], f"the {len(installed)} other libraries of {package.name} are: {_ALONE}", tuple(installed[:3])


def _wrong_place(package: ProjectPackage, places: list[str], is_started: bool) -> str | None:
    """The first of *places* if ``ros2 run`` or ``rosrun`` does not find an executable there; None if it does, or nobody can tell."""
    expected = f"lib/{package.name}"
    if not places or any("$" in place or place.startswith("/") for place in places):
        return None
    found = {expected} if package.ros == 2 else {expected, f"share/{package.name}"}
    if any(place in found or (package.ros == 1 and place.startswith(f"share/{package.name}/")) for place in places):
        return None
    if not is_started and any(place.split("/")[0] in ("bin", "sbin", "libexec", "opt") for place in places):
        return None
    return places[0]


def _misplaced(
    package: ProjectPackage, at: Location, place: str, group: list[tuple[Target, Location | None]]
) -> Finding:
    """The executables that the install() *at* puts to *place*, each with where it is started."""
    names = [target.output for target, _ in group]
    what = f"executable {names[0]} is" if len(names) == 1 else f"executables {spelled_out(names)} are"
    runner = "ros2 run and launch look" if package.ros == 2 else "rosrun and roslaunch look"
    things = tuple(target.name for target, _ in group)
    starts = [use for _, use in group if use is not None]
    return Finding(
        at=at,
        message=f"the {what} installed to {place or 'the prefix'}, but {runner} in lib/{package.name}",
        about=(package.name, *things),
        related=_related((), (((use, "is started here"),) for use in starts)),
        apart=things,
        level=Level.ERROR if starts and package.ros == 2 else Level.WARNING,
    )


def _fix(package: ProjectPackage, target: Target, described: Iterable[str] = ()) -> Fix | None:
    """An install() of its own for a library, and one for the files that describe its plug-ins."""
    if target.location.path != package.cmake_path:
        return None
    if package.ros == 2:
        line = f"install(TARGETS {target.name} ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)"
    else:
        place = "${CATKIN_PACKAGE_LIB_DESTINATION}"
        line = f"install(TARGETS {target.name} ARCHIVE DESTINATION {place} LIBRARY DESTINATION {place})"
    for name in described:
        line += f"\ninstall(FILES {name} DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})"
    return install_line(package, line, f"install {target.name}")


def _finding(
    package: ProjectPackage,
    thing: str,
    message: str,
    *,
    level: Level,
    at: Location,
    related: tuple[tuple[Location, str], ...] = (),
    fix: Fix | None = None,
) -> Finding:
    return Finding(
        at=at,
        message=message,
        about=(package.name, thing),
        related=related,
        apart=(thing,),
        level=level,
        fixes=(fix,) if fix is not None else (),
    )


CHECK = Check(
    id="target-not-installed",
    summary="Executable, library or script that is used but not installed.",
    level=Level.ERROR,
    catalogue="B05",
    tags=("build",),
    project=check,
)
