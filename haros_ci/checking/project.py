# SPDX-License-Identifier: Apache-2.0
"""What a check of packages sees: the whole workspace, with what each package declares, builds, installs and contains."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from operator import itemgetter
from typing import TYPE_CHECKING, Protocol

from haros_ci.changes.revision import Revision, changes_of
from haros_ci.checking.cmake import CMake
from haros_ci.checking.cpp_texts import CppTexts
from haros_ci.checking.entries import below, entries_of
from haros_ci.checking.system import System
from haros_ci.knowledge.knowledge import Knowledge
from haros_ci.knowledge.knowledge import knowledge as packaged
from haros_ci.model.access import AccessRule
from haros_ci.model.build import Build, CMakeCommand, Interface
from haros_ci.model.changes import Changes
from haros_ci.model.element import Element
from haros_ci.model.launch_facts import CommandUse
from haros_ci.model.location import Location
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.robot import Description
from haros_ci.model.submodules import absent, is_below, submodules
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.syntax import Program

if TYPE_CHECKING:
    from haros_ci.behaviour.declared import Stated
    from haros_ci.checking.included import IncludedHeaders
    from haros_ci.checking.properties import Properties
    from haros_ci.checking.provision import Sources
    from haros_ci.code.codebase import Codebase


class Robots(Protocol):
    """What reads robot descriptions; the implementation lives in the robot room."""

    def of_files(self) -> Iterable[Description]: ...

    def of_command(self, command: str, location: Location | None = None) -> Description | None: ...

    @property
    def problems(self) -> Iterable[Problem]: ...


class ProjectPackage:
    """A package with its manifest, its build and its files."""

    def __init__(self, raw: Package, build: Build, files: tuple[SourceFile, ...], project: Project) -> None:
        self.raw = raw
        self.build = build
        #: Its own files, those of packages inside it left out, sorted by path.
        self.files = files
        self.project = project

    @property
    def name(self) -> str:
        return self.raw.name

    @property
    def path(self) -> str:
        """Its directory, relative to the workspace root; ``.`` for the root itself."""
        return self.raw.path

    @property
    def ros(self) -> int | None:
        """1 or 2; None where the manifest does not tell."""
        return self.raw.ros

    @property
    def manifest_path(self) -> str:
        return self.inside("package.xml")

    @property
    def cmake_path(self) -> str:
        return self.inside("CMakeLists.txt")

    @cached_property
    def manifest(self) -> Element | None:
        """The root of its package.xml; None if it is malformed (then malformed-manifest is reported)."""
        return self.project.element(self.manifest_path)

    @cached_property
    def cmake(self) -> CMake:
        """What its CMake makes, links, installs and exports."""
        return CMake(self)

    @cached_property
    def included(self) -> IncludedHeaders:
        """The headers that its targets include."""
        from haros_ci.checking.included import IncludedHeaders

        return IncludedHeaders(self)

    @cached_property
    def declared(self) -> frozenset[str]:
        """The names that its manifest depends on, of whatever kind."""
        return frozenset(dependency.name for dependency in self.raw.dependencies)

    def inside(self, path: str) -> str:
        """The root-relative path of *path* in the package."""
        return path if self.path == "." else f"{self.path}/{path}"

    def has(self, path: str) -> bool:
        """Whether there is a file of this path in the package, analysed or not."""
        return self.inside(path) in self.project.workspace.names

    def commands(self, *names: str) -> tuple[CMakeCommand, ...]:
        """The commands of its CMake with one of *names*, in the order in which they run."""
        found = [command for name in dict.fromkeys(names) for command in self._commands.get(name, ())]
        return tuple(command for _, command in (sorted(found, key=itemgetter(0)) if len(names) > 1 else found))

    @cached_property
    def _commands(self) -> dict[str, list[tuple[int, CMakeCommand]]]:
        """The commands by their names, each with its place among all."""
        found: dict[str, list[tuple[int, CMakeCommand]]] = {}
        for number, command in enumerate(self.build.commands):
            found.setdefault(command.name, []).append((number, command))
        return found

    def at(self, *tags: str) -> Location:
        """The first element of the manifest with one of *tags*, else its root."""
        root = self.manifest
        found = next(root.all(*tags), root) if root is not None else None
        return Location(self.manifest_path, found.line if found is not None else 1)

    def __str__(self) -> str:
        return self.name


class Project:
    """All packages of a workspace, their code and launch configurations.

    Of packages with one name the first by path counts, as everywhere. *base* is the same at the base revision, None if none was given; it
    is made when it is asked for. *renames* maps paths of the base to those that the files have now.
    """

    def __init__(
        self,
        workspace: Workspace,
        builds: Mapping[str, Build],
        programs: Mapping[str, Program],
        systems: Sequence[System] = (),
        *,
        read_xml: Callable[[str], Element | None] = lambda path: None,
        base: Project | Callable[[], Project | None] | None = None,
        renames: Mapping[str, str] | None = None,
        revision: Revision | None = None,
        robots: Robots | None = None,
        code: Callable[[], Codebase] | None = None,
        knowledge: Knowledge | None = None,
        project_file: str = "",
        stated: Sequence[Stated] | None = None,
        access: Sequence[AccessRule] = (),
        cpp_texts: CppTexts | None = None,
    ) -> None:
        self.workspace = workspace
        self._cpp_texts = cpp_texts or CppTexts(workspace.text, workspace.text)
        #: The text of a file for what it includes (``checking.includes``) and for nothing else.
        self.glance = self._cpp_texts.glance
        #: The path of the project file; "" if there is none in the workspace.
        self.project_file = project_file
        self._stated = stated
        #: Who may publish, subscribe to, call or serve what, as the project file that counts has it.
        self.access = tuple(access)
        self.programs = programs
        #: The configurations that launch takes; what it refuses is one finding each, and shows nothing of the workspace.
        self.systems = tuple(system for system in systems if not system.is_refused)
        self.renames = renames or {}
        self._base = base
        #: Whether its systems and code are those of the base revision, but for the lines that things stand on.
        self.is_as_before = False
        self._revision = revision
        #: What is known of packages that are not in the workspace.
        self.knowledge = packaged() if knowledge is None else knowledge
        self._read_xml = read_xml
        self._robots = robots
        self._code = code
        self._elements: dict[str, Element | None] = {}
        files: dict[str, list[SourceFile]] = {}
        for file in workspace.files:
            if file.package is not None:
                files.setdefault(file.package, []).append(file)
        found: dict[str, ProjectPackage] = {}
        for raw in workspace.packages:
            if raw.name not in found:
                own = tuple(f for f in files.get(raw.name, ()) if raw.path == "." or f.path.startswith(f"{raw.path}/"))
                found[raw.name] = ProjectPackage(raw, builds.get(raw.name, Build(package=raw.name)), own, self)
        self._packages = found

    @cached_property
    def base(self) -> Project | None:
        """The same workspace at the base revision; None if none was given, or it cannot be had."""
        return self._base() if callable(self._base) else self._base

    @cached_property
    def sources(self) -> Sources:
        """Which packages have a header or a module, and what they need of others."""
        from haros_ci.checking.provision import Sources

        return Sources(self)

    @cached_property
    def manifests(self) -> Mapping[str, Package]:
        """What the manifests of the packages say, by their names."""
        return {name: package.raw for name, package in self._packages.items()}

    @cached_property
    def changes(self) -> Changes:
        """What is otherwise than at the base revision; nothing without one."""
        base, here = None if self.is_as_before else self.base, self._revision
        if base is None or here is None or base._revision is None:
            return Changes()
        return changes_of(base._revision, here, self.renames)

    def without_changes(self) -> Project:
        """Itself, where the change leaves systems and code as they were: checks of changes have nothing to look at, and no base is made for them."""
        self.is_as_before = True
        return self

    @property
    def packages(self) -> tuple[ProjectPackage, ...]:
        """By path."""
        return tuple(self._packages.values())

    @cached_property
    def roots(self) -> frozenset[str]:
        """The paths of its packages."""
        return frozenset(package.path for package in self.packages)

    def package(self, name: str) -> ProjectPackage | None:
        return self._packages.get(name)

    @cached_property
    def directories(self) -> frozenset[str]:
        """The directories that have a file in them, at whatever depth."""
        return frozenset(folder or "." for folder in entries_of(self.workspace.names))

    def below(self, folder: str) -> Sequence[str]:
        """The paths of all files in the root-relative directory *folder* or deeper, in order; ``"."`` is the root."""
        return below(self.workspace.names, folder)

    @cached_property
    def python_paths(self) -> frozenset[str]:
        """The paths of all Python files."""
        return frozenset(file.path for file in self.workspace.files if file.path.endswith(".py"))

    @cached_property
    def submodules(self) -> tuple[str, ...]:
        """The directories that git fills from other repositories (gitmodules(5))."""
        return submodules(self.workspace)

    @cached_property
    def absent(self) -> frozenset[str]:
        """Those of the submodules that are not checked out."""
        return absent(self.workspace)

    def is_absent(self, path: str) -> bool:
        """Whether the root-relative *path* is in a submodule that is not checked out: nobody here can tell what is there."""
        return is_below(path, self.absent)

    def exists(self, path: str) -> bool:
        """Whether there is a file or a directory of this root-relative path."""
        return path in self.workspace.names or path in self.directories

    @cached_property
    def interfaces(self) -> Mapping[tuple[str, str], Interface]:
        """The msg, srv and action definitions by name (``pkg/T``) and kind (``msg``)."""
        return {
            (interface.name, interface.kind): interface
            for package in self.packages
            for interface in package.build.interfaces
        }

    @cached_property
    def descriptions(self) -> tuple[Description, ...]:
        """The robots that the workspace describes: each whole file as it is, and what launch files have xacro make of it."""
        if self._robots is None:
            return ()
        found = list(self._robots.of_files())
        uses = {use.text: use for system in self.systems for use in reversed(system.facts(CommandUse))}
        for text, use in sorted(uses.items()):
            made = self._robots.of_command(text, use.location)
            if made is not None:
                found.append(made)
        return tuple(found)

    def described(self, command: str) -> Description | None:
        """The robot that a launch file's *command* makes."""
        return None if self._robots is None else self._robots.of_command(command)

    @property
    def problems(self) -> tuple[Problem, ...]:
        """What could not be read to its end for the checks that have run."""
        return () if self._robots is None else tuple(self._robots.problems)

    @cached_property
    def properties(self) -> Properties | None:
        """What is stated in HPL, in the project file if nothing else is given; None if nothing is."""
        if self._stated is None and (not self.project_file or "hpl" not in self.text(self.project_file)):
            return None
        from haros_ci.checking.properties import Properties, stated_in

        stated = stated_in(self) if self._stated is None else tuple(self._stated)
        return Properties(self, stated) if stated else None

    @cached_property
    def code(self) -> Codebase:
        """The call graph over the programs; without any where none was given."""
        from haros_ci.checking.unbuilt import unbuilt
        from haros_ci.code.codebase import codebase

        if self._code is None:
            return codebase((), self.text)
        code = self._code()
        code.unbuilt = unbuilt(self)
        return code

    def text(self, path: str) -> str:
        """The text of a file of the workspace; "" if it is not there or not text."""
        return self.workspace.text(path)

    def has_word(self, path: str, *words: str) -> bool:
        """Whether one of *words* stands in the text of a file, as a part of it at least.

        For who goes through all files of code: what is asked so is not asked again after a change elsewhere (``checking.unseen``).
        """
        self._cpp_texts.words.update(words)
        text = self.glance(path)
        return any(word in text for word in words)

    def text_with(self, path: str, *words: str) -> str:
        """The text of a file that has one of *words*; else ""."""
        return self._cpp_texts.read(path) if self.has_word(path, *words) else ""

    def element(self, path: str) -> Element | None:
        """The root element of an XML file of the workspace; None for any other file."""
        if path not in self._elements:
            self._elements[path] = self._read_xml(path)
        return self._elements[path]
