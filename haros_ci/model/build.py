# SPDX-License-Identifier: Apache-2.0
"""What a package builds, installs and declares, beside its manifest."""

from __future__ import annotations

import posixpath
from typing import Any

from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field

#: What the problems of a setup.py say whose list of installed files is not known.
DATA_FILES = "data_files"


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """An executable or library of CMake: *name* is the target's, *prefix* + *output* + *suffix* that of the file.

    *kind*: executable, library (static, shared, module), object, interface, alias, imported. *sources* are relative to
    the workspace root, those in *conditional_sources* there in some builds only. *links* are other targets or names of
    libraries as evaluated, targets of other packages as ``package::target``; what only a build knows stays as
    ``${catkin_LIBRARIES}``. *is_conditional* if a construct
    that could not be decided stands around it, *is_test* if it is made for tests. *component* is the class that an
    executable of rclcpp_components_register_node runs.
    """

    name: str
    package: str
    kind: str
    output: str
    location: Location
    sources: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    is_installed: bool = False
    is_conditional: bool = False
    is_test: bool = False
    conditional_sources: tuple[str, ...] = ()
    prefix: str = ""
    suffix: str = ""
    component: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Installed:
    """What CMake or setup.py installs: root-relative *path*, *kind* program, file or directory.

    *destination*, below the install prefix (``lib/pkg``, ``share/pkg/launch``), is the directory that a file is put
    into under *name*, or that a directory becomes. A program with *keeps_mode* is executable if its source is.
    """

    path: str
    kind: str
    package: str
    destination: str
    location: Location
    name: str = ""
    keeps_mode: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class EntryPoint:
    """A console script of setup.py, ``name = module:function``; *path* is the module's file, "" if it is not here."""

    name: str
    module: str
    function: str
    path: str
    package: str
    location: Location


@dataclass(frozen=True, slots=True)
class RefusedEntry:
    """A line of console scripts from which no program can be made: *text* is not ``name = module:function``."""

    text: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class Distribution:
    """The name that setup.py gives what it installs."""

    name: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class PluginClass:
    """A ``<class>`` of a plug-in description: look-up *name*, C++ *type*, *base*, *library* (path as written).

    A component that CMake registers has the base ``rclcpp_components::NodeFactory`` and the target's name as library.
    """

    name: str
    type: str
    base: str
    library: str
    package: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigParameter:
    """One ``gen.add(...)`` of a .cfg. *type* is bool, int, double or str; groups are dotted into *group*.

    Values that were not given, or cannot be read off the text, are None.
    """

    name: str
    type: str
    default: Any
    minimum: Any
    maximum: Any
    location: Location
    group: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigFile:
    """A .cfg file: *name* is the generated class without ``Config`` (third argument of ``gen.generate``)."""

    name: str
    package: str
    path: str
    parameters: tuple[ConfigParameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterLibrary:
    """What generate_parameter_library makes of the YAML at *path*.

    *language* cpp: a header ``name.hpp`` and an interface target *name*; python: the module ``package.name``.
    """

    name: str
    package: str
    path: str
    language: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceField:
    """A field or constant: *type* as written with the package completed (``std_msgs/Header``, ``float64[3]``).

    *written* is the type and *value* the constant's or default value as they stand in the file, without a comment.
    """

    name: str
    type: str
    line: int
    default: Any = None
    is_constant: bool = False
    written: str = ""
    value: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """A msg, srv or action definition; *sections* has 1, 2 or 3 parts. *name* is ``pkg/T``.

    *is_generated* is False where the package's CMake generates interfaces, but not this one. *is_whole* is False where a part of the
    definition could not be read, or is not read (.idl).
    """

    name: str
    kind: str
    path: str
    sections: tuple[tuple[InterfaceField, ...], ...] = ()
    is_generated: bool = True
    is_whole: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class CMakeCommand:
    """One command as it was followed, *name* in lower case, its *arguments* evaluated; flow and variables are none.

    What only a build knows stays in the arguments as ``${NAME}``. Places in the workspace begin with ``${ROOT}/``, those of the build tree
    with ``${BUILD}/``; *directory* is the root-relative directory that relative ones count from. *is_conditional* if a
    construct that could not be decided stands around it; *under* are the numbers of these branches, -1 among them where the arguments
    themselves are not certain. *is_test* if it runs for tests only. A command inside a
    function stands where the function is called.
    """

    name: str
    arguments: tuple[str, ...]
    location: Location
    directory: str
    is_conditional: bool = False
    is_test: bool = False
    under: tuple[int, ...] = field(default=(), compare=False)

    def place(self, word: str) -> str | None:
        """The root-relative path that *word* means; None if it is not known, or not in the workspace."""
        if word == "${ROOT}" or word.startswith("${ROOT}/"):
            path = posixpath.normpath(word[len("${ROOT}/") :] or ".")
        elif "${" in word or word.startswith("/"):
            return None
        else:
            path = posixpath.normpath(f"{self.directory}/{word}")
        return None if path.startswith("..") or "${" in path else path

    def after(self, keyword: str, *keywords: str) -> tuple[str, ...]:
        """The arguments that follow *keyword*, each time that it is given, up to the next of *keywords*; () without it.

        A list in quotes counts as its elements: cmake_parse_arguments and find_package() split it.
        """
        found: list[str] = []
        is_after = False
        for word in self.arguments:
            if word == keyword or word in keywords:
                is_after = word == keyword
            elif is_after:
                found += (part for part in word.split(";") if part) if ";" in word and "$<" not in word else (word,)
        return tuple(found)


#: Stands in a written file for a value that is not known.
NOT_KNOWN = "\ue001"


@dataclass(frozen=True, slots=True, kw_only=True)
class WrittenFile:
    """XML that CMake writes of the file *template*: its *text*, found at the root-relative *path* once the package is built."""

    path: str
    template: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Build:
    """All of one package.

    *scripts* are Python files that are installed as programs or begin with a shebang. *python_roots* are pairs of an
    import root (``""`` for all, or a top-level name) and the root-relative directory that it stands for. *defined* are
    the macros that the build defines for C++, *flags* what CMAKE_CXX_FLAGS is, *are_flags_known* False where that depends on
    what only a build knows. *python_packages* are the import packages that setup.py names, *are_python_packages_all* if one list in
    the call names all of them. *script_directories* are ``(develop or install, directory, line)`` of setup.cfg: where its
    programs are put. *commands* are those of CMake in the order in which they run. *written* are files that it makes of templates.
    """

    package: str
    targets: tuple[Target, ...] = ()
    installed: tuple[Installed, ...] = ()
    plugins: tuple[PluginClass, ...] = ()
    configs: tuple[ConfigFile, ...] = ()
    interfaces: tuple[Interface, ...] = ()
    entry_points: tuple[EntryPoint, ...] = ()
    refused_entries: tuple[RefusedEntry, ...] = ()
    scripts: tuple[str, ...] = ()
    python_roots: tuple[tuple[str, str], ...] = ()
    defined: tuple[str, ...] = ()
    flags: str = ""
    are_flags_known: bool = True
    parameter_libraries: tuple[ParameterLibrary, ...] = ()
    problems: tuple[Problem, ...] = ()
    commands: tuple[CMakeCommand, ...] = ()
    distribution: Distribution | None = None
    python_packages: tuple[tuple[str, Location], ...] = ()
    are_python_packages_all: bool = False
    script_directories: tuple[tuple[str, str, int], ...] = ()
    written: tuple[WrittenFile, ...] = ()

    @property
    def computes_data_files(self) -> bool:
        """Whether setup.py installs more than is known, as it makes a part of its ``data_files`` when it runs."""
        return any(DATA_FILES in problem.message for problem in self.problems if problem.path.endswith("setup.py"))

    def programs(self) -> set[str]:
        """The names by which ``rosrun`` and ``ros2 run`` start what the package builds or installs."""
        names = {target.output or target.name for target in self.targets if target.kind == "executable"}
        names |= {entry_point.name for entry_point in self.entry_points}
        names |= {posixpath.basename(path) for path in self.scripts}
        programs = (installed for installed in self.installed if installed.kind == "program")
        return names | {installed.name or posixpath.basename(installed.path) for installed in programs}
