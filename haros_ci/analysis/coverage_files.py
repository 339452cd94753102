# SPDX-License-Identifier: Apache-2.0
"""What a workspace's files are for: which are built, which modules are imported only, which plug-ins anything loads."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet

from haros_ci.code.classes import absolute
from haros_ci.code.codebase import Codebase
from haros_ci.coverage.pieces import Piece, last_name
from haros_ci.coverage.reach import stem
from haros_ci.index.index import HEADERS, Source, is_test
from haros_ci.model.build import Build
from haros_ci.model.coverage import EXAMPLE, PRODUCTION, TEST
from haros_ci.model.package import Package
from haros_ci.model.unbuilt import is_whole
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Names of folders, inside a package, for code that shows how others are used.
_EXAMPLES = frozenset("example examples demo demos tutorial tutorials sample samples".split())
_TEST_FILE = regex(r"(?:test_\w+|\w+_tests?|conftest|\w+[._]gtest)\.\w+")
_TEST_PACKAGE = regex(r"(?:\w+_)?(?:tests?|testing)|test_\w+")
_LOADER = regex(r"\bClassLoader\s*<\s*([\w:]+)")
_PROGRAM = regex(r"^if[ \t(]+__name__\b|^#!", re.MULTILINE)
_SCRIPT = regex(r"\w{1,100}\.py\b")
#: What can say how C++ is compiled.
_BUILD_FILES = (
    "CMakeLists.txt",
    "Makefile",
    "GNUmakefile",
    "makefile",
    "meson.build",
    "BUILD",
    "BUILD.bazel",
    "setup.py",
    "SConstruct",
)
#: What registers a class with Gazebo.
_SIMULATED = regex(r"(?:GZ|IGN|IGNITION|GAZEBO)_(?:REGISTER_\w*PLUGIN|ADD_PLUGIN)")
#: Kinds of files that name plug-ins and classes which are to be loaded, and ends of names of others.
_NAMING = frozenset(("yaml", "launch", "xml", "shell"))
_DESCRIBING = (".world", ".sdf", ".urdf", ".xacro", ".gazebo", ".launch.py")
_NAMED = regex(r"(?:::|\.|/)(\w+)")
#: A name that may be looked up in a library that is loaded.
_LOOKED_UP = regex(r'"(\w{1,80})"')
#: Bases of plug-ins that are nodes themselves: one that nothing loads is in the model all the same.
_NODES = frozenset(("nodelet::Nodelet", "rclcpp_components::NodeFactory"))


@dataclass(frozen=True, slots=True)
class Plugin:
    """A class, *type*, that others load by a name: one of *words* stands where it is loaded, in files of configurations."""

    type: str
    base: str
    package: str
    words: frozenset[str]


@dataclass(frozen=True, slots=True)
class Plugins:
    """All plug-ins of a workspace, by the last parts of their types."""

    every: Mapping[str, tuple[Plugin, ...]]

    def of(self, piece: Piece, name: str, package: str | None) -> Plugin | None:
        """The plug-in called *name* that a method of *piece*, of a *package*, can be of; None if there is none."""
        found = self.every.get(name, ())
        function = piece.function
        if not found or function is None:
            return None
        ways = (
            lambda item: item.type == function.owner,
            lambda item: item.package == package,
            lambda item: name != piece.owner or len(found) == 1,
        )
        return next((plugin for fits in ways for plugin in found if fits(plugin)), None)


def plugins_of(code: Codebase, builds: Mapping[str, Build]) -> Plugins:
    """The classes that plug-in descriptions name, and those that macros of Gazebo register."""
    found: dict[str, list[Plugin]] = {}
    for package, build in sorted(builds.items()):
        for other_plugin in build.plugins:
            kind, base = other_plugin.type.strip().partition("<")[0], other_plugin.base.replace(" ", "")
            if base not in _NODES:
                words = frozenset((other_plugin.name.strip(), other_plugin.type.strip()))
                found.setdefault(last_name(kind), []).append(Plugin(kind, base, package, words))
    libraries = {path: target for build in builds.values() for target in build.targets for path in target.sources}
    for source in code.sources:
        for macro, arguments, _, _ in source.program.registered:
            if _SIMULATED.fullmatch(macro) and arguments:
                target = libraries.get(source.path)
                words = frozenset((target.output, target.name) if target is not None else ())
                kind = arguments[0].strip()
                plugin = Plugin(kind, "the simulator", source.package or "", words)
                found.setdefault(last_name(kind), []).append(plugin)
    return Plugins({name: tuple(item) for name, item in found.items()})


def loaded(workspace: Workspace, plugins: Plugins, texts: Mapping[str, str], classes: frozenset[str]) -> Iterator[str]:
    """The last parts of the names of classes and functions that the workspace may load by their names: those in its configurations."""
    bases = {last_name(base) for text in texts.values() if "ClassLoader" in text for base in _LOADER.findall(text)}
    waiting: list[tuple[str, str]] = []
    for name, found in plugins.every.items():
        if any(last_name(plugin.base) in bases for plugin in found):
            yield name
        else:
            waiting += [(word, name) for plugin in found for word in plugin.words if word]
    for path in sorted(path for path, text in texts.items() if "dlsym" in text):
        yield from _LOOKED_UP.findall(workspace.text(path))
    yield from _configured(workspace, waiting, classes)


def _configured(workspace: Workspace, waiting: list[tuple[str, str]], classes: frozenset[str]) -> Iterator[str]:
    """Which of *classes*, and of the names *waiting* for a word, the workspace's configurations name."""
    for file in workspace.files:
        if file.language not in _NAMING and not file.path.endswith(_DESCRIBING) or is_test(file.path):
            continue
        text = workspace.text(file.path)
        if "<class" in text and "base_class_type" in text:
            continue  # a description of plug-ins
        yield from classes.intersection(_NAMED.findall(text))
        yield from (name for word, name in waiting if word in text)


def built(code: Codebase, builds: Mapping[str, Build], workspace: Workspace) -> tuple[frozenset[str], frozenset[str]]:
    """The files that targets are made of, of others and of tests; Python is in both. All where a build is not known as a whole.

    C++ of a package without a build file is in no target.
    """
    packages = workspace.packages
    known = {package.name for package in packages if package.name in builds and is_whole(builds[package.name], package)}
    known |= {package.name for package in packages if _has_no_build_file(package, workspace.names)}
    sides: list[set[str]] = [set(), set()]
    for build in builds.values():
        for target in build.targets:
            sides[target.is_test].update((*target.sources, *target.conditional_sources))
    for source in code.sources:
        is_header = source.path.endswith(HEADERS)
        is_unknown = source.package not in known and not is_header and source.path not in sides[1]
        if source.separator == "." or is_unknown:
            sides[0].add(source.path)
    for side in sides:
        for path in tuple(side):
            if path in code.cpp.sources:
                side |= code.cpp.reach(path)
    return frozenset(sides[0]), frozenset(sides[1])


def _has_no_build_file(package: Package, names: AbstractSet[str]) -> bool:
    """Whether nothing can compile C++ of the package by itself: among the *names* of all files, as far as they are known, is no build file of it."""
    inside = "" if package.path == "." else f"{package.path}/"
    return bool(names) and not any(f"{inside}{name}" in names for name in _BUILD_FILES)


def imported(code: Codebase, builds: Mapping[str, Build], workspace: Workspace) -> frozenset[str]:
    """The Python files that run only if something imports them.

    One that could be run as a program is among them where ``ros2 run`` finds none of its name and no launch file or script names it.
    """
    scripts, programs = _programs(builds)
    left = [source for source in code.sources if source.separator == "." and source.path not in programs]
    started = {source.path for source in left if source.path in scripts or _PROGRAM.search(workspace.text(source.path))}
    by_hand = {
        path for path in started if code.by_path[path].package in builds and code.ros_of(code.by_path[path]) == 2
    }
    if by_hand:
        by_hand -= _named(workspace, by_hand)
    return frozenset(source.path for source in left if source.path not in started or source.path in by_hand)


def _programs(builds: Mapping[str, Build]) -> tuple[set[str], set[str]]:
    """The Python files that build files name as scripts, and those that are entry points or installed as programs."""
    scripts = {path for build in builds.values() for path in build.scripts}
    programs = {entry.path for build in builds.values() for entry in build.entry_points}
    programs |= {item.path for build in builds.values() for item in build.installed if item.kind == "program"}
    return scripts, programs


def _named(workspace: Workspace, paths: Iterable[str]) -> set[str]:
    """Those of *paths* whose last part stands in a launch file or shell script."""
    waiting = {path: posixpath.basename(path) for path in paths}
    found: set[str] = set()
    for file in workspace.files:
        if file.language in ("launch", "shell") or file.path.endswith((".launch.py", "_launch.py")):
            words = set(_SCRIPT.findall(workspace.text(file.path)))
            found |= {path for path, name in waiting.items() if name in words and path != file.path}
    return found


def area_of(path: str, package: Package | None, is_of_test: bool) -> str:
    name = posixpath.basename(path)
    if is_of_test or is_test(path) or _TEST_FILE.fullmatch(name):
        return TEST
    if package is None:
        return PRODUCTION
    if _TEST_PACKAGE.fullmatch(package.name):
        return TEST
    inside = path if package.path == "." else path[len(package.path) + 1 :]
    return EXAMPLE if _EXAMPLES.intersection(inside.split("/")[:-1]) else PRODUCTION


def copies(workspace: Workspace) -> dict[str, str]:
    """The files of other projects' libraries inside of packages, each with the directory that holds the copy."""
    homes = {package.name: package.path for package in workspace.packages}
    return {
        file.path: file.third_party
        for file in workspace.files
        if file.third_party
        and (home := homes.get(file.package or "", ".")) != file.third_party
        and not home.startswith(f"{file.third_party}/")
    }


def shadowed(code: Codebase, modules: frozenset[str]) -> frozenset[str]:
    """The files among *modules* that no file imports under their own dotted name, where others share its last part.

    By names alone, an import of one would count for the other, too.
    """
    by_last: dict[str, list[Source]] = {}
    targets: set[str] = set()
    for source in code.sources:
        if source.separator == ".":
            by_last.setdefault(stem(source.path), []).append(source)
            targets |= {absolute(source, alias.type.name).removesuffix(".*") for alias in source.program.aliases}
    every = targets | {target.rpartition(".")[0] for target in targets}
    return frozenset(
        source.path
        for alike in by_last.values()
        if len(alike) > 1
        for source in alike
        if source.module and source.path in modules and source.module not in every
    )
