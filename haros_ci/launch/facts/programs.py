# SPDX-License-Identifier: Apache-2.0
"""Whether the programs, components and nodelets are there that launch files start: built or installed by their packages."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Mapping
from dataclasses import replace

from haros_ci.launch.facts.files import Finder
from haros_ci.model.build import Build
from haros_ci.model.launch_facts import ProgramUse
from haros_ci.model.program_words import is_called_otherwise, is_not_made, may_make_program
from haros_ci.model.similar_files import similar_names
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

#: Commands of CMake that make programs under names of their own.
_MAKERS = regex(r"^[ \t]*(\w{0,80}?(?:add_executable|add_node|register_node|python_install|add_program)\w*)\s*\(", re.M)
_KNOWN_MAKERS = frozenset(
    (
        "add_executable",
        "ament_auto_add_executable",
        "rclcpp_components_register_node",
        "rclcpp_components_register_nodes",
    )
)
_KNOWN_MAKERS |= {"ament_python_install_package", "ament_python_install_module", "catkin_install_python"}
_LOADED = ("rclcpp_components::NodeFactory", "rclcpp_components::NodeFactoryTemplate")
_NODELET = "nodelet::Nodelet"
_MAKEFILES = ("Makefile", "makefile", "GNUmakefile")


@dataclass(slots=True)
class Programs:
    """Programs by package; *known* are those that the code of the workspace has, by package and name."""

    finder: Finder
    builds: Mapping[str, Build]
    known: Collection[tuple[str, str]]
    _found: dict[tuple[str, str, str, int], tuple[bool | None, tuple[str, ...], bool, bool]] = field(
        default_factory=dict
    )
    _versions: dict[str, int | None] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        self._versions = {package.name: package.ros for package in self.finder.workspace.packages}

    def completed(self, use: ProgramUse) -> ProgramUse:
        key = (use.kind, use.package, use.program, use.ros)
        if key not in self._found:
            is_found, similar, is_library = self._look_up(use)
            build = self.builds.get(use.package)
            running = _running_module(build, use) if build is not None and is_found is False and not is_library else ()
            self._found[key] = is_found, running or similar, is_library, bool(running)
        is_found, similar, is_library, is_module = self._found[key]
        return replace(use, is_found=is_found, similar=similar, is_library=is_library, is_module=is_module)

    def _look_up(self, use: ProgramUse) -> tuple[bool | None, tuple[str, ...], bool]:
        build = self.builds.get(use.package)
        start = self.finder.files.directories.get(use.package)
        if start is None or build is None or not self.finder.has_build_file(start):
            return None, (), False  # of a package that nothing builds, that is what is wrong
        if self._versions.get(use.package) not in (None, use.ros):
            return None, (), False  # the package of this name for the other ROS, which is another one
        if use.kind == "executable" and (called := self._is_not_made(use, build, start)) is not None:
            return False, called, False
        if use.kind == "executable" and use.ros == 2 and (called := self._are_names_of(use, build, start)):
            return False, called, False
        if (use.package, use.program) in self.known or (use.kind == "nodelet" and self._is_described(use.program)):
            return True, (), False
        names = self._classes(build, use) if use.kind != "executable" else build.programs()
        if use.program in names:
            return True, (), False
        if use.kind == "executable" and self._is_library(use, build, start):
            return False, _running(build, use.program), True
        if self._may_be_made(use, start):
            return None, (), False
        script, similar = f"{use.program}.py", similar_names(use.program, names, use.package)
        if script in names:  # nothing is nearer than the script without its ending
            similar = (script, *(name for name in similar if name != script))[:3]
        return False, similar, False

    def _is_not_made(self, use: ProgramUse, build: Build, start: str) -> tuple[str, ...] | None:
        """The names that may be meant, where the package has a target of this name which it never builds, or builds under another name; else None."""
        targets = [target for target in build.targets if use.program in (target.name, target.output)]
        if len(targets) != 1 or targets[0].kind != "executable" or targets[0].is_conditional:
            return None
        if self.finder.steps < 0 or self.finder.is_doubled(use.package) or use.program in _files_of(build):
            return None
        text = self.finder.script(use.package, start)
        if any(match[1].lower() not in _KNOWN_MAKERS for match in _MAKERS.finditer(text)):
            return None
        (target,) = targets
        if is_not_made(text, target.name):
            return ()
        output = f"{target.prefix}{target.output or target.name}{target.suffix}"
        is_other = use.program != output and is_called_otherwise(text, use.program)
        return (output,) if is_other else None

    def _are_names_of(self, use: ProgramUse, build: Build, start: str) -> tuple[str, ...]:
        """The names under which a script of this name is installed, where it is installed under others only (``RENAME``); else ()."""
        programs = [one for one in build.installed if one.kind == "program"]
        own = [one for one in programs if posixpath.basename(one.path) == use.program]
        names = {one.name for one in own}
        others = {one.name or posixpath.basename(one.path) for one in programs} | {e.name for e in build.entry_points}
        others |= {name for target in build.targets for name in (target.name, target.output)}
        if not names or use.program in others or self.finder.steps < 0 or self.finder.is_doubled(use.package):
            return ()
        if any(one.kind == "directory" and one.destination.startswith("lib") for one in build.installed):
            return ()
        text = self.finder.script(use.package, start)
        if text.count(use.program) > len(own):  # something else is done with it
            return ()
        makers = (match[1].lower() for match in _MAKERS.finditer(text))
        return () if any(maker not in _KNOWN_MAKERS for maker in makers) else tuple(sorted(names))

    def _is_described(self, name: str) -> bool:
        """Whether some package describes a nodelet of this look-up name: what stands before the slash need not be that package (pluginlib)."""
        return any(
            plugin.name == name and plugin.base == _NODELET
            for build in self.builds.values()
            for plugin in build.plugins
        )

    def _is_library(self, use: ProgramUse, build: Build, start: str) -> bool:
        """Whether the package builds a library of this name, and nothing else of it: targets of CMake have one kind (add_library(7))."""
        targets = [target for target in build.targets if use.program in (target.name, target.output)]
        if not targets or any(target.kind != "library" or target.is_conditional for target in targets):
            return False
        if self.finder.steps < 0 or self.finder.is_doubled(use.package):
            return False
        text = self.finder.script(use.package, start)
        if any(match[1].lower() not in _KNOWN_MAKERS for match in _MAKERS.finditer(text)):
            return False
        if re.search(rf"(?i)\b(?:RENAME|OUTPUT_NAME)\s+\"?{re.escape(use.program)}\b", text):
            return False
        prefix = "" if start == "." else f"{start}/"
        return all(posixpath.basename(path) != use.program for path in self.finder.below(prefix))

    def _classes(self, build: Build, use: ProgramUse) -> set[str]:
        if use.kind == "nodelet":
            return {plugin.name for plugin in build.plugins if plugin.base == _NODELET}
        return {plugin.type for plugin in build.plugins if plugin.base in _LOADED or "NodeFactory" in plugin.base}

    def _may_be_made(self, use: ProgramUse, start: str) -> bool:
        """Whether the package may have it in a way that is not known: its build or a file names it, or makes names."""
        if self.finder.steps < 0 or self.finder.is_doubled(use.package):
            return True
        last = use.program.rpartition("::")[2].rpartition("/")[2]
        text = self.finder.script(use.package, start)
        if not text or may_make_program(text, last, is_file=use.kind == "executable"):
            return True
        if any(match[1].lower() not in _KNOWN_MAKERS for match in _MAKERS.finditer(text)):
            return True
        prefix = "" if start == "." else f"{start}/"
        stem = last.partition(".")[0]
        if use.kind == "executable":
            return self._has_file(last, stem, prefix)
        suffixes = (".cpp", ".cc", ".cxx", ".hpp", ".h", *((".xml",) if use.kind == "nodelet" else ()))
        paths = (p for p in self.finder.below(prefix) if p.endswith(suffixes) and ".launch" not in p)
        return any(last in self.finder.workspace.text(path) for path in paths)

    def _has_file(self, program: str, stem: str, prefix: str) -> bool:
        """Whether the package has a file of one of the names, or a Makefile with a rule that makes the program."""
        paths = list(self.finder.below(prefix))
        if any(posixpath.basename(path) in (program, stem) for path in paths):
            return True
        rule = re.compile(rf"^(?:[\w./-]+[ \t]+)*{re.escape(program)}[ \t]*:(?!=)", re.MULTILINE)
        made = (path for path in paths if posixpath.basename(path) in _MAKEFILES)
        return any(rule.search(self.finder.workspace.text(path)) for path in made)


def _files_of(build: Build) -> set[str]:
    """The programs that are no target: scripts, entry points, and files that are installed as such."""
    files = {posixpath.basename(path) for path in build.scripts} | {entry.name for entry in build.entry_points}
    return files | {one.name or posixpath.basename(one.path) for one in build.installed if one.kind == "program"}


def _running_module(build: Build, use: ProgramUse) -> tuple[str, ...]:
    """The console scripts, all of other names, that run the module of the package which is called like the program."""
    if use.kind != "executable":
        return ()
    module = use.program.removesuffix(".py")
    named = (entry.name for entry in build.entry_points if entry.path and entry.module.rpartition(".")[2] == module)
    return tuple(sorted(set(named)))


def _running(build: Build, library: str) -> tuple[str, ...]:
    """The programs of the package that are linked with *library*, or that a component of it is registered as."""
    programs = [target for target in build.targets if target.kind == "executable" and not target.is_test]
    classes = {plugin.type for plugin in build.plugins if plugin.library == library}
    linked = [
        program
        for program in programs
        if library in program.links or (program.component and program.component in classes)
    ]
    return tuple(sorted({target.output or target.name for target in linked}))[:3]
