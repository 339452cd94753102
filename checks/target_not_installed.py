# SPDX-License-Identifier: Apache-2.0
"""Executables, libraries and scripts that are not installed, or to where nothing looks for them."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage
from haros_ci.api.launch import ProgramUse
from haros_ci.api.packages import Target, install_line, landings

#: Parts of paths and names of what is there for developers.
_ASIDE = re.compile(
    r"(?:^|[/_-])(?:tests?|testing|tester|examples?|benchmarks?|benchmarking|bench|demos?|samples?|tutorials?|tools?|fuzz\w*|mock|dummy"
    r"|scratch|experimental|debug|generate|generator|gen|profil\w+|playground|sandbox|old|deprecated|unused)(?:$|[/_.-])"
)
_TESTS = re.compile(r"(?:^|_)(?:tests?|testing|benchmarks?|tools)(?:$|_)")
_RUN = re.compile(r"\b(?:ros2 run|rosrun)\s+([\w-]+)\s+([\w.-]+)")

#: The launch tags by package and program.
_Uses = Mapping[tuple[str, str], Location]
#: What the code of a node uses by itself, and what leaves it to a library.
_CLIENT = re.compile(r"\b(?:ros|roscpp|rclcpp\w*|rcl|nodelet|nav2_\w+)::\w|\brclcpp\b|\binit\s*\(\s*argc\b")


def check(project: Project) -> Iterator[Finding]:
    uses: dict[tuple[str, str], Location] = {}
    for system in project.systems:
        for use in system.facts(ProgramUse):
            if use.kind == "executable":
                uses.setdefault((use.package, use.program), use.location)
    told = _documented(project)
    for package in project.packages:
        if package.ros is None or package.raw.is_metapackage:
            continue
        found = list(_of(package, uses, told))
        if package.ros == 1 and len(found) > 1 and not package.cmake.installs:
            names = ", ".join(each.apart[0] for each in found)
            message = (
                f"{package.name} installs none of its targets: {names} do not exist in an install space; add "
                "install(TARGETS ...)"
            )
            found = [replace(found[0], message=message, about=(package.name,), apart=(), fixes=())]
        yield from found


def _of(package: ProjectPackage, uses: _Uses, told: _Uses) -> Iterator[Finding]:
    if package.build.commands and package.cmake.is_whole and not package.cmake.installs_unknown:
        yield from _libraries(package)
        yield from _executables(package, uses)
    yield from _scripts(package, uses, told)


def _documented(project: Project) -> dict[tuple[str, str], Location]:
    """The programs that Markdown and reStructuredText run by name."""
    found: dict[tuple[str, str], Location] = {}
    for path in sorted(project.workspace.names):
        if path.lower().endswith((".md", ".rst")) and not re.match(r"changelog", posixpath.basename(path), re.I):
            text = project.text(path)
            for match in _RUN.finditer(text):
                found.setdefault((match[1], match[2]), Location(path, text.count("\n", 0, match.start()) + 1))
    return found


def _libraries(package: ProjectPackage) -> Iterator[Finding]:
    """Libraries that something needs when it runs, or that are exported."""
    cmake, said = package.cmake, set[str]()
    for target, why, where in _needed(package):
        if target.name in said or _may_be_installed(package, target) or target.is_conditional:
            continue
        if cmake.is_shared(target) is not True:
            continue
        said.add(target.name)
        yield _finding(
            package,
            target.name,
            f"the library {target.name} is not installed, but {why}",
            level=Level.ERROR if package.ros == 2 else Level.WARNING,
            at=target.location,
            related=where,
            fix=_fix(package, target),
        )
    if package.ros == 2:
        for each in package.build.plugins:
            places = cmake.destinations(each.library) if each.base == "rclcpp_components::NodeFactory" else ()
            if not places or any("$" in p or p in ("lib", "") for p in places) or each.library in said:
                continue
            said.add(each.library)
            yield _finding(
                package,
                each.library,
                (
                    f"the library {each.library} is installed to {places[0]}, but component containers load {each.type} from "
                    "lib; correct the destination"
                ),
                level=Level.ERROR,
                at=next((i.command.location for i in cmake.installs if each.library in i.things), target.location),
                related=((each.location, "is registered here"),),
            )


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
    by_output = {f"{t.prefix or 'lib'}{t.output}": t for t in cmake.targets.values()}
    for each in package.build.plugins:
        base = posixpath.basename(each.library).removesuffix(".so")
        found = cmake.targets.get(base) or by_output.get(base) or by_output.get(f"lib{base}")
        if found is not None:
            yield found, f"{each.type} is loaded from it", ((each.location, f"declares {each.type}"),)
    keywords = ("INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS")
    for command in package.commands("ament_export_libraries", "catkin_package"):
        words = command.arguments if command.name != "catkin_package" else command.after("LIBRARIES", *keywords)
        for word in words:
            if word in cmake.targets and not command.is_conditional:
                why = f"{command.name}() exports it: packages that use it cannot find it"
                yield cmake.targets[word], why, ((command.location, "exports it"),)


def _executables(package: ProjectPackage, uses: _Uses) -> Iterator[Finding]:
    cmake = package.cmake
    for target in cmake.targets.values() if package.raw.build_type != "cmake" else ():
        if target.kind != "executable" or target.is_test or target.is_conditional or target.component:
            continue
        use = uses.get((package.name, target.output))
        related = ((use, "is started here"),) if use is not None else ()
        if _may_be_installed(package, target):
            places = [] if cmake.installs_unknown else list(cmake.destinations(target.name))
            yield from _misplaced(package, target, places, related)
            continue
        shown = [path.removeprefix(f"{package.path}/") for path in target.sources]
        if use is None and _is_for_tests(package, target.name, *shown):
            continue
        runner = "ros2 run and launch do" if package.ros == 2 else "in an install space rosrun and roslaunch do"
        least = Level.WARNING if use is not None or _may_be_node(package, target) else Level.NOTE
        yield _finding(
            package,
            target.name,
            f"the executable {target.output} is not installed: {runner} not find it",
            level=Level.ERROR if use is not None and package.ros == 2 else least,
            at=target.location,
            related=related,
            fix=_fix(package, target),
        )


def _may_be_node(package: ProjectPackage, target: Target) -> bool:
    """Whether a program may be a node: its sources are not known, or one uses the client library."""
    return not target.sources or any(_CLIENT.search(package.project.text(path)) for path in target.sources)


def _is_for_tests(package: ProjectPackage, *names: str) -> bool:
    """Whether an executable that nothing starts is there for developers alone, by the names of it, its files or its package."""
    return any(_ASIDE.search(name.lower()) for name in names) or bool(_TESTS.search(package.name))


def _misplaced(
    package: ProjectPackage, target: Target, places: list[str], related: tuple[tuple[Location, str], ...]
) -> Iterator[Finding]:
    """An executable that ``ros2 run`` or ``rosrun`` does not find where it is put."""
    wanted = f"lib/{package.name}"
    if not places or any("$" in place or place.startswith("/") for place in places):
        return
    found = {wanted} if package.ros == 2 else {wanted, f"share/{package.name}"}
    if any(place in found or (package.ros == 1 and place.startswith(f"share/{package.name}/")) for place in places):
        return
    if not related and any(place.split("/")[0] in ("bin", "sbin", "libexec", "opt") for place in places):
        return
    runner = "ros2 run and launch look" if package.ros == 2 else "rosrun and roslaunch look"
    yield _finding(
        package,
        target.name,
        f"the executable {target.output} is installed to {places[0] or 'the prefix'}, but {runner} in {wanted}",
        level=Level.ERROR if related and package.ros == 2 else Level.WARNING,
        at=next((i.command.location for i in package.cmake.installs if target.name in i.things), target.location),
        related=related,
    )


def _scripts(package: ProjectPackage, uses: _Uses, told: _Uses) -> Iterator[Finding]:
    """Python nodes that are files of their own."""
    if package.cmake_path not in package.project.workspace.names:
        return  # setup.py's packages start their nodes by entry points
    if not package.cmake.is_whole or any("${" in word for i in package.cmake.installs for word in i.things):
        return
    listed = {each.path: each for each in package.build.installed if each.kind in ("file", "program")}
    for path in package.build.scripts:
        shown, name = path.removeprefix(f"{package.path}/"), posixpath.basename(path)
        use, how = uses.get((package.name, name)), "is started here"
        text = package.project.text(path)
        if landings(package, path) or _is_module(package, path) or name in package.cmake.mentioned:
            continue
        if any(word == name or word.endswith(f"/{name}") for word in package.cmake.mentioned):
            continue
        is_aside = _ASIDE.search(shown.lower()) is not None
        if use is None and not is_aside:
            use = told.get((package.name, name))
            how = "is run here"
        if use is None and not is_aside and _is_node(package, text):
            beside = (each for each in listed.values() if posixpath.dirname(each.path) == posixpath.dirname(path))
            other = next((each for each in beside if each.kind == "program"), None)
            use, how = (other.location, "installs the other scripts there") if other is not None else (None, how)
        if use is None or (is_aside and _ASIDE.search(use.path.lower())):
            continue
        runner = "ros2 run and launch do" if package.ros == 2 else "in an install space rosrun and roslaunch do"
        yield _finding(
            package,
            shown,
            f"the script {shown} is not installed: {runner} not find it",
            level=Level.ERROR if how == "is started here" and package.ros == 2 else Level.WARNING,
            at=Location(path, 1),
            related=((use, how),),
            fix=install_line(package, _install_script(package, shown), f"install {shown}"),
        )


def _is_node(package: ProjectPackage, text: str) -> bool:
    """Whether a script is a node of the package's own ROS, to be run as it stands."""
    client = "rospy" if package.ros == 1 else "rclpy"
    is_main = re.search(r"__name__\s*==\s*['\"]__main__['\"]", text)
    return bool(is_main) and re.search(rf"(?m)^\s*(?:import|from)\s+{client}\b", text) is not None


def _install_script(package: ProjectPackage, shown: str) -> str:
    if package.ros == 1:
        return f"catkin_install_python(PROGRAMS {shown} DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})"
    return f"install(PROGRAMS {shown} DESTINATION lib/${{PROJECT_NAME}})"


def _is_module(package: ProjectPackage, path: str) -> bool:
    """Whether the file is part of a Python package that is installed as such."""
    for name, directory in package.build.python_roots:
        below = f"{directory}/" if directory != "." else ""
        if name and path.startswith(below):
            return True
    return f"{posixpath.dirname(path)}/__init__.py" in package.project.workspace.names


def _may_be_installed(package: ProjectPackage, target: Target) -> bool:
    return target.is_installed or target.name in package.cmake.mentioned or target.is_test


def _fix(package: ProjectPackage, target: Target) -> Fix | None:
    """An install() of its own."""
    if target.location.path != package.cmake_path:
        return None
    if target.kind == "executable":
        place = "lib/${PROJECT_NAME}" if package.ros == 2 else "${CATKIN_PACKAGE_BIN_DESTINATION}"
        line = f"install(TARGETS {target.name} DESTINATION {place})"
    elif package.ros == 2:
        line = f"install(TARGETS {target.name} ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)"
    else:
        place = "${CATKIN_PACKAGE_LIB_DESTINATION}"
        line = f"install(TARGETS {target.name} ARCHIVE DESTINATION {place} LIBRARY DESTINATION {place})"
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
