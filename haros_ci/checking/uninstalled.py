# SPDX-License-Identifier: Apache-2.0
"""Executables and scripts of a package that no install() names, and packages that install nothing at all."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from haros_ci.checking.installing import is_said_not_installed, landings, left_out_on_purpose
from haros_ci.checking.interpreted import is_given_to_another
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.model.build import PluginClass, Target
from haros_ci.model.launch_facts import ProgramUse
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.rule import Level

#: Parts of paths and names of what is there for developers.
_ASIDE = regex(
    r"(?:^|[/_-])(?:tests?|testing|tester|examples?|benchmarks?|benchmarking|bench|demos?|samples?|tutorials?|tools?|fuzz\w*|mock|dummy"
    r"|scratch|experimental|debug|generate|generator|gen|profil\w+|playground|sandbox|old|deprecated|unused)(?:$|[/_.-])"
)
#: The first comments and text of a script, and how one says there that it is to be looked at.
_HEAD = regex(r"(?:[ \t]*#[^\n]{0,300}\n|[ \t]*\n){0,60}(?:\"{3}.{0,1500}?\"{3}|'{3}.{0,1500}?'{3})?", re.DOTALL)
_DEMONSTRATION = regex(r"\b(?:demo(?:nstrat\w+)?|example|tutorial|test case|playground)\b", re.IGNORECASE)
_TESTS = regex(r"(?:^|_)(?:tests?|testing|benchmarks?|tools)(?:$|_)")
#: Copies that editors and people keep beside a script.
_KEPT = regex(r"(?:~|\.(?:bak|backup|old|orig|org|save|swp|tmp|disabled)\d*)\Z", re.IGNORECASE)
_MAIN_BLOCK = regex(r"__name__\s*==\s*['\"]__main__['\"]")
_RUN = regex(r"\b(?:ros2 run|rosrun)\s+([\w-]+)\s+([\w.-]+)")
#: What the code of a node uses by itself, and what leaves it to a library.
_CLIENT = regex(r"\b(?:ros|roscpp|rclcpp\w*|rcl|nodelet|nav2_\w+)::\w|\brclcpp\b|\binit\s*\(\s*argc\b")


@dataclass(frozen=True, slots=True)
class Uninstalled:
    """A program that no install() names: *kind* is executable or script, *name* the target or the path in the package, *shown* what users call it.

    *level* says how much depends on it: an error where a launch file of ROS 2 starts it. *related* is what starts it.
    """

    kind: str
    name: str
    shown: str
    level: Level
    at: Location
    related: tuple[tuple[Location, str], ...]


class Programs:
    """The programs of a project that something starts, by package and name: launch files, and pages that run them."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self.started: dict[tuple[str, str], Location] = {}
        #: Programs that packages certainly do not have, of which unknown-executable tells.
        self.lost: set[tuple[str, str]] = set()
        for system in project.systems:
            for use in system.facts(ProgramUse):
                if use.kind == "executable":
                    self.started.setdefault((use.package, use.program), use.location)
                    if use.is_found is False:
                        self.lost.add((use.package, use.program))
        self._documented_places: Mapping[tuple[str, str], Location] | None = None

    def documented(self, package: str, name: str) -> Location | None:
        """Where a page in Markdown or reStructuredText says ``ros2 run`` or ``rosrun`` with the program."""
        if self._documented_places is None:
            self._documented_places = _documented(self.project)
        return self._documented_places.get((package, name))


def installs_nothing(package: ProjectPackage) -> bool:
    """Whether the CMake files of *package* are known, and have no command that installs anything, seen or not.

    What a library that lies in the package, with a manifest of its own, installs of itself (``add_subdirectory(extern/serial)``) does not count.
    """
    if not package.build.commands or not package.cmake.is_whole or package.cmake.installs_unknown:
        return False
    bundled = package.project.sources.once(("bundled", package.path), lambda: _bundled(package))
    return not (
        any(not install.command.location.path.startswith(bundled) for install in package.cmake.installs)
        or any(not one.path.startswith(bundled) for one in package.build.installed)
        or any(
            target.is_installed and not target.location.path.startswith(bundled)
            for target in package.cmake.targets.values()
        )
    )


def _bundled(package: ProjectPackage) -> tuple[str, ...]:
    """The directories inside *package* that have a manifest of their own, each with a slash at its end."""
    names = (posixpath.dirname(name) for name in package.project.below(package.path) if name.endswith("/package.xml"))
    return tuple(f"{folder}/" for folder in names if folder != package.path)


def uninstalled(package: ProjectPackage, programs: Programs) -> Iterator[Uninstalled]:
    """The executables and Python scripts of *package* that users or launch files run and that are not installed."""
    if package.ros is None or package.raw.is_metapackage:
        return
    if package.build.commands and package.cmake.is_whole and not package.cmake.installs_unknown:
        yield from (
            executable for executable in _executables(package, programs) if not _is_left_out(package, executable)
        )
    yield from (script for script in _scripts(package, programs) if not _is_left_out(package, script))


def _is_left_out(package: ProjectPackage, other_uninstalled: Uninstalled) -> bool:
    """Whether a comment at an install() has the program, or one above the target says so: it is meant.

    The latter counts where only launch files that are for developers, too, start the program.
    """
    is_aside = all(_ASIDE.search(place.path.rpartition("/")[2].lower()) for place, _ in other_uninstalled.related)
    if other_uninstalled.kind == "executable" and is_aside and is_said_not_installed(package, other_uninstalled.at):
        return True
    if other_uninstalled.kind == "script" and _KEPT.search(other_uninstalled.at.path):
        return True
    if other_uninstalled.kind == "script" and _is_meant(package, other_uninstalled.at.path):
        return True
    words = left_out_on_purpose(package)
    return bool(words) and not words.isdisjoint((other_uninstalled.name, posixpath.basename(other_uninstalled.name)))


def _is_meant(package: ProjectPackage, path: str) -> bool:
    """Whether an install() names the script without its ending, as a file that is not there: that is a finding by itself."""
    commands = package.commands("install", "catkin_install_python")
    return any(
        place == posixpath.splitext(path)[0] and not package.project.exists(place)
        for command in commands
        for place in map(command.place, command.arguments)
        if place is not None
    )


def may_be_installed(package: ProjectPackage, target: Target) -> bool:
    """Whether *target* is installed, is a test, or is named by a command that is not known and may install it."""
    return target.is_installed or target.name in package.cmake.mentioned or target.is_test


def is_program(package: ProjectPackage, target: Target) -> bool:
    """Whether *target* is an executable that the build always makes and that is no test and no component's."""
    is_one = target.kind == "executable" and not target.is_test and not target.is_conditional and not target.component
    return is_one and package.raw.build_type != "cmake"


def plugin_library(package: ProjectPackage, plugin: PluginClass) -> Target | None:
    """The target of *package* that makes the library of *plugin*, as its description names it."""
    targets, by_output = package.cmake.targets, package.cmake.by_output
    base = posixpath.basename(plugin.library).removesuffix(".so")
    return targets.get(base) or by_output.get(base) or by_output.get(f"lib{base}")


def describes_installed(package: ProjectPackage, inner: str) -> bool:
    """Whether the file *inner* of the package describes plug-ins of a library that is installed, which nobody finds without it.

    It is not where an install() names another description, which is not there: missing-install-source tells of that one.
    """
    suffix = posixpath.splitext(inner)[1]
    named = (install.command.place(thing) for install in package.cmake.installs for thing in install.things)
    if any(path is not None and path.endswith(suffix) and not package.project.exists(path) for path in named):
        return False
    for plugin in package.build.plugins if package.ros == 1 else ():
        target = plugin_library(package, plugin) if plugin.location.path == package.inside(inner) else None
        if target is not None and target.is_installed:
            return True
    return False


def lost_plugins(package: ProjectPackage) -> Mapping[str, tuple[PluginClass, ...]]:
    """By target the plug-ins of *package* whose libraries, and the descriptions of these beside package.xml, are not installed either."""
    found: dict[str, tuple[PluginClass, ...]] = {}
    if not package.build.commands or not package.cmake.is_whole or package.cmake.installs_unknown:
        return found
    for plugin in package.build.plugins:
        target, path = plugin_library(package, plugin), plugin.location.path
        if target is None or may_be_installed(package, target) or target.is_conditional:
            continue
        if path != package.inside(posixpath.basename(path)) or not path.endswith(".xml") or landings(package, path):
            continue
        if posixpath.basename(path) not in package.cmake.mentioned and package.cmake.is_shared(target) is True:
            found[target.name] = (*found.get(target.name, ()), plugin)
    return found


def _documented(project: Project) -> dict[tuple[str, str], Location]:
    found: dict[tuple[str, str], Location] = {}
    for path in sorted(project.workspace.names):
        if path.lower().endswith((".md", ".rst")) and not re.match(r"changelog", posixpath.basename(path), re.I):
            text = project.text(path)
            for match in _RUN.finditer(text):
                found.setdefault((match[1], match[2]), Location(path, text.count("\n", 0, match.start()) + 1))
    return found


def _executables(package: ProjectPackage, programs: Programs) -> Iterator[Uninstalled]:
    for target in package.cmake.targets.values():
        if not is_program(package, target) or may_be_installed(package, target):
            continue
        use = programs.started.get((package.name, target.output))
        shown = [path.removeprefix(f"{package.path}/") for path in target.sources]
        is_idle = (
            use is None or _ASIDE.search(posixpath.dirname(use.path).removeprefix(package.path).lower()) is not None
        )
        if is_idle and _is_for_tests(package, target.name, *shown):
            continue
        least = Level.WARNING if use is not None or _may_be_node(package, target) else Level.NOTE
        yield Uninstalled(
            "executable",
            target.name,
            target.output,
            Level.ERROR if use is not None and package.ros == 2 else least,
            target.location,
            ((use, f"{target.output} is started here"),) if use is not None else (),
        )


def _may_be_node(package: ProjectPackage, target: Target) -> bool:
    """Whether a program may be a node: its sources are not known, or one uses the client library."""
    return not target.sources or any(_CLIENT.search(package.project.text(path)) for path in target.sources)


def _is_for_tests(package: ProjectPackage, *names: str) -> bool:
    """Whether an executable that nothing starts is there for developers alone, by the names of it, its files or its package."""
    return any(_ASIDE.search(name.lower()) for name in names) or bool(_TESTS.search(package.name))


def _scripts(package: ProjectPackage, programs: Programs) -> Iterator[Uninstalled]:
    """Python nodes that are files of their own."""
    if package.cmake_path not in package.project.workspace.names:
        return  # setup.py's packages start their nodes by entry points
    if not package.cmake.is_whole or any("${" in word for i in package.cmake.installs for word in i.things):
        return
    listed = {
        installed.path: installed for installed in package.build.installed if installed.kind in ("file", "program")
    }
    names = {posixpath.basename(path) for path in listed}  # what is started by one is that file, not another copy
    for path in package.build.scripts:
        shown, name = path.removeprefix(f"{package.path}/"), posixpath.basename(path)
        use, how = programs.started.get((package.name, name)), "is started here"
        if use is None and (package.name, posixpath.splitext(name)[0]) in programs.lost:
            continue  # it is started without its ending: unknown-executable says what to write and to install
        text = package.project.text(path)
        if landings(package, path) or name in package.cmake.mentioned or name in names:
            continue
        if _is_module(package, path) and (use is None or not _is_program_too(package, shown, text)):
            continue
        if any(word == name or word.endswith(f"/{name}") for word in package.cmake.mentioned):
            continue
        is_aside = _ASIDE.search(shown.lower()) is not None
        if use is None and not is_aside:
            use = programs.documented(package.name, name)
            how = "is run here"
        if use is None and not is_aside and _is_node(package, text):
            beside = (
                installed
                for installed in listed.values()
                if posixpath.dirname(installed.path) == posixpath.dirname(path)
            )
            other = next((installed for installed in beside if installed.kind == "program"), None)
            is_shown = _DEMONSTRATION.search((_HEAD.match(text) or [""])[0]) is not None
            is_apart = other is None or is_shown or is_given_to_another(path, package)
            use, how = (
                (None, how) if other is None or is_apart else (other.location, "installs the other scripts there")
            )
        if use is None or (is_aside and _ASIDE.search(use.path.lower())):
            continue
        level = Level.ERROR if how == "is started here" and package.ros == 2 else Level.WARNING
        message = how if how.startswith("installs") else f"{shown} {how}"
        yield Uninstalled("script", shown, shown, level, Location(path, 1), ((use, message),))


def _is_node(package: ProjectPackage, text: str) -> bool:
    """Whether a script is a node of the package's own ROS, to be run as it stands."""
    client = "rospy" if package.ros == 1 else "rclpy"
    return (
        _MAIN_BLOCK.search(text) is not None
        and re.search(rf"(?m)^[ \t]*(?:import|from)\s+{client}\b", text) is not None
    )


def _is_module(package: ProjectPackage, path: str) -> bool:
    """Whether the file is part of a Python package that is installed as such."""
    for name, directory in package.build.python_roots:
        below = f"{directory}/" if directory != "." else ""
        if name and path.startswith(below):
            return True
    return f"{posixpath.dirname(path)}/__init__.py" in package.project.workspace.names


def _is_program_too(package: ProjectPackage, shown: str, text: str) -> bool:
    """Whether a module is a program by its *text*, which setup.py does not install as one: who imports it finds it, roslaunch and ros2 launch do not."""
    return (
        text.startswith("#!")
        and _MAIN_BLOCK.search(text) is not None
        and shown not in package.project.text(package.inside("setup.py"))
    )
