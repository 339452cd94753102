# SPDX-License-Identifier: Apache-2.0
"""What a package gets by its manifest: what it declares, and what comes along with that."""

from __future__ import annotations

import sys
from collections.abc import Callable, Hashable, Iterator, Mapping
from functools import cached_property
from typing import TypeVar, cast

from haros_ci.checking.entries import paths_by_name
from haros_ci.checking.manifests import counted
from haros_ci.checking.package_names import is_of_system
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.records import dataclass
from haros_ci.regex import regex

T = TypeVar("T")

#: Modules that come with Python itself, wherever it is: not those that systems have as packages of their own, nor those of some versions alone.
OF_PYTHON = frozenset(sys.stdlib_module_names) - frozenset(
    "asynchat asyncore cgi crypt distutils ensurepip idlelib imp lib2to3 pipes smtpd telnetlib test tkinter tomllib turtle turtledemo venv".split()
)
_PYTHON = regex(r"(?:python3?|python2)-(.+?)(?:-pip)?$")
#: What is not there because another package needs it.
_OWN_ONLY = ("test_depend", "doc_depend")
#: What packages of messages are named, and what comes with each at least.
_SHOWN = 3
#: Packages that are looked at for what others bring, in all; a thousand packages that need each other have a million.
MAX_STEPS = 3_000_000
#: What one name says of all that a package gets, as in ``Provision``.
_OPEN, _OF_MESSAGES, _OF_A_SYSTEM = 1, 2, 4
#: Keys that bring what others bring parts of.
_WHOLE = frozenset(("libqt4-dev", "qtbase5-dev", "qt6-base-dev"))
#: Commands of CMake that look for what is installed.
_FINDS = ("find_package", "pkg_check_modules", "pkg_search_module")
#: Commands of CMake that build Python modules.
_MODULES: tuple[str, ...] = ("pybind11_add_module", "nanobind_add_module", "python_add_library", "cython_add_module")
_MODULES += ("swig_add_library", "ament_python_install_package", "ament_python_install_module")
#: The end of names of packages that bring a Find module, and the thing itself by another package.
_MODULE = "_cmake_module"
_INTERFACES = ("_msgs", "_interfaces", "_srvs")


@dataclass(frozen=True, slots=True)
class Provision:
    """*names* are packages and keys of rosdep that a package gets.

    There may be more where one of them is known nowhere: *is_open* says so. *may_be_interfaces*: what is known nowhere are packages of
    messages, which bring others of their like. *may_be_system*: one stands for packages that only some systems have.
    """

    names: frozenset[str]
    is_open: bool = False
    may_be_interfaces: bool = False
    may_be_system: bool = False


class Provisions:
    """Of all packages of *project*, each worked out once."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self._brought: dict[tuple[str, int | None], frozenset[str] | None] = {}
        self._left = MAX_STEPS
        self._steps_by_ros: dict[int | None, dict[str, tuple[frozenset[str], int]]] = {}
        self._named: dict[str, list[Package]] = {}
        for raw in project.workspace.packages:
            self._named.setdefault(raw.name, []).append(raw)

    def of(self, package: ProjectPackage, *, tests: bool = True) -> Provision:
        """All that *package* declares, of whatever kind, with what that brings along; without *tests* not what only these get."""
        declared = frozenset(one.name for one in counted(package)) if tests else _for_users(package)
        names = {package.name, *declared, *self._aside(package)}
        todo = list(names - {package.name})
        steps = self._steps_by_ros.setdefault(package.ros, {})
        marks = 0
        while todo:
            name = todo.pop()
            self._left -= 1
            if self._left < 0:
                return Provision(frozenset(names), is_open=True)
            step = steps.get(name)
            if step is None:
                step = steps[name] = self._step(name, package.ros)
            brought, says = step
            marks |= says
            new = brought - names
            names |= new
            todo += new
        names.update(*(_variants(name) for name in declared))
        return Provision(frozenset(names), bool(marks & _OPEN), bool(marks & _OF_MESSAGES), bool(marks & _OF_A_SYSTEM))

    def _step(self, name: str, ros: int | None) -> tuple[frozenset[str], int]:
        """What *name* brings to a package of *ros*, and what it says of the whole."""
        brought, says = self.brought(name, ros), 0
        if brought is None and name.endswith(_INTERFACES):
            says = _OF_MESSAGES
            brought = self.brought("std_msgs", ros)
        if brought is None and ("-" in name or is_of_system(name)):  # no package's name has one (REP 144), keys have
            says |= 0 if name.startswith("python") else _OF_A_SYSTEM
        elif brought is None:
            says |= 0 if name in OF_PYTHON else _OPEN  # what Python has brings nothing
        elif not self.project.knowledge.is_whole(name):
            says |= _OF_A_SYSTEM
        return brought or frozenset(), says

    def lacks(self, provision: Provision, providers: frozenset[str]) -> bool:
        """Whether none of *providers* is there for certain."""
        if provision.is_open or providers & provision.names:
            return False
        of_ros = [name for name in providers if is_of_ros(name, self.project)]
        if provision.may_be_system and not of_ros:
            return False
        return not (provision.may_be_interfaces and any(name.endswith(_INTERFACES) for name in of_ros))

    def brought(self, name: str, ros: int | None) -> frozenset[str] | None:
        """What comes along with *name*: by its manifest, if it is in the workspace; None if nobody knows it."""
        key = (name, ros)
        if key not in self._brought:
            inner = self.project.package(name)
            if inner is not None:
                self._brought[key] = frozenset(d.name for d in counted(inner) if d.kind not in _OWN_ONLY)
            else:
                self._brought[key] = self._known(name, ros)
        return self._brought[key]

    def closure(self, name: str, ros: int | None) -> frozenset[str]:
        """What comes with *name*, itself among it, in any distribution of *ros*."""
        found, todo = {name}, [name]
        while todo:
            new = (self.brought(todo.pop(), ros) or frozenset()) - found
            found |= new
            todo += new
        return frozenset(found)

    def _known(self, name: str, ros: int | None) -> frozenset[str] | None:
        knowledge = self.project.knowledge
        found = knowledge.depends(name, ros)
        if found is None and ros is not None:
            found = knowledge.depends(name)
        return found

    def _aside(self, package: ProjectPackage) -> Iterator[str]:
        """Packages of the workspace that are other versions of this one's manifest: of the same name, elsewhere."""
        for raw in self._named.get(package.name, ()):
            if raw.path != package.path:
                yield from (dependency.name for dependency in raw.dependencies)


def _for_users(package: ProjectPackage) -> frozenset[str]:
    return frozenset(dependency.name for dependency in counted(package) if dependency.kind not in _OWN_ONLY)


def _variants(name: str) -> Iterator[str]:
    """The keys for one Python library: of either Python, from either index of packages."""
    match = _PYTHON.match(name)
    if match is not None:
        yield from (f"{python}-{match[1]}{end}" for python in ("python", "python3") for end in ("", "-pip"))


def is_of_ros(name: str, project: Project) -> bool:
    """Whether *name* is a package of the workspace or of a distribution, not one of the system."""
    return project.package(name) is not None or bool(project.knowledge.is_package(name))


def exists(names: frozenset[str], package: ProjectPackage) -> bool:
    """Whether the ROS that *package* is of has any of *names* today; one that only the other ROS has is a name's accident.

    One that only distributions long gone have cannot be declared any more.
    """
    project = package.project
    return any(
        project.package(name) is not None
        or (project.knowledge.is_current(name, package.ros) and not _is_gone(name, package))
        for name in names
    )


def is_to_be_had_today(name: str, package: ProjectPackage) -> bool:
    """Whether the workspace has *name*, or a distribution of the ROS of *package* that is not long gone, or rosdep (knowledge.is_current)."""
    return package.project.package(name) is not None or package.project.knowledge.is_current(name, package.ros)


def _is_gone(key: str, package: ProjectPackage) -> bool:
    """Whether rosdep's *key* is of Python 2, which no system has that ROS 2 runs on; of pip it is of any Python."""
    return package.ros == 2 and key.startswith("python-") and not key.endswith("-pip")


def first_provider(names: frozenset[str], package: ProjectPackage) -> str:
    """Of *names* the one to declare: a package of the same ROS, else a key of rosdep, the shortest of each.

    Before them comes what CMake asks the system for by that name (``pkg_check_modules(YAML yaml-cpp)``).
    Of keys for Python those come first that are of one Python with what the package declares, or else the other packages of the workspace.
    """
    project = package.project
    usable = [name for name in names if _is_name(name, project)]
    families, there = _families(package), frozenset(name for name in usable if exists(frozenset((name,)), package))
    return min(
        usable,
        key=lambda n: (
            n not in there,
            not is_to_be_had_today(n, package),
            _is_idle_module(n, package),
            not _is_asked_for(n, package),
            not is_of_ros(n, project),
            _has_its_own(n, names),
            _is_part(n, there),
            bool(families) and _family(n) not in {"", *families},
            n.endswith(_MODULE),
            n.endswith("-pip"),
            n.startswith("python-"),
            n not in _WHOLE,
            len(n),
            n,
        ),
    )


def _is_part(name: str, names: frozenset[str]) -> bool:
    """Whether *name* is the key of a part of what another of *names* is the key of, of whichever Python: python-qt5-bindings-quick, python3-pyqt5.qtwebengine."""
    bare = _bare(name)
    return not name.endswith("-pip") and any(bare.startswith((f"{_bare(n)}-", f"{_bare(n)}.")) for n in names)


def _bare(key: str) -> str:
    return key.removeprefix(f"{_family(key)}-") if _family(key) else key


def _has_its_own(name: str, names: frozenset[str]) -> bool:
    """Whether Python has a package of its own among *names*, which *name*, of C++ alone since then, does not bring: tf2_ros_py for tf2_ros, from Galactic on."""
    return f"{name}_py" in names


def _is_idle_module(name: str, package: ProjectPackage) -> bool:
    """Whether the package *name* brings a Find module that CMake finds after that package alone, and CMake does not name it."""
    return name.endswith(_MODULE) and not any(name in command.arguments for command in package.build.commands)


def _is_asked_for(name: str, package: ProjectPackage) -> bool:
    """Whether CMake looks for a library of the system called *name*, which is no name of a ROS package."""
    return "-" in name and any(name in command.arguments for command in package.commands(*_FINDS))


def _families(package: ProjectPackage) -> frozenset[str]:
    """The Python, ``python`` or ``python3``, of the keys that *package* declares; if it has none, those of the whole workspace."""
    own = frozenset(filter(None, map(_family, package.declared)))
    return own or package.project.sources.families


def _family(key: str) -> str:
    return key.partition("-")[0] if _PYTHON.match(key) else ""


def others_of(names: frozenset[str], name: str, package: ProjectPackage) -> list[str]:
    """A few of *names* beside *name* that the package could declare as well."""
    if name in _WHOLE:
        return []
    usable = [n for n in names if n != name and _is_name(n, package.project) and exists(frozenset((n,)), package)]
    usable = [n for n in usable if is_to_be_had_today(n, package) and not _is_idle_module(n, package)]
    usable = [n for n in usable if not _has_its_own(n, names)]
    return sorted(usable, key=lambda n: (n.startswith("python-"), len(n), n))[:_SHOWN]


def last_dependency(package: ProjectPackage) -> Location:
    """Where another dependency goes: behind those that there are."""
    lines = [dependency.line for dependency in package.raw.dependencies if dependency.line is not None]
    return Location(package.manifest_path, max(lines, default=1))


def _is_name(name: str, project: Project) -> bool:
    return is_of_ros(name, project) or project.knowledge.is_key(name)


class Sources:
    """Which packages of the workspace have a header, by the end of its path, or a Python module."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self._made: dict[Hashable, object] = {}

    def once(self, key: Hashable, make: Callable[[], T]) -> T:
        """What *make* gives, made once: several checks ask for the same of a package."""
        if key not in self._made:
            self._made[key] = make()
        return cast(T, self._made[key])

    @cached_property
    def _by_name(self) -> Mapping[str, list[tuple[str, str]]]:
        found: dict[str, list[tuple[str, str]]] = {}
        for package in self.project.packages:
            for file in package.files:
                if file.language == "cpp":
                    found.setdefault(file.path.rpartition("/")[2], []).append((file.path, package.name))
        return found

    @cached_property
    def families(self) -> frozenset[str]:
        """The Python, ``python`` or ``python3``, of the keys that the packages of the workspace declare."""
        dependencies = (one.name for package in self.project.workspace.packages for one in package.dependencies)
        return frozenset(filter(None, map(_family, dependencies)))

    @cached_property
    def file_names(self) -> frozenset[str]:
        """The names of all files of the workspace, without their folders."""
        return frozenset(paths_by_name(self.project.workspace.names))

    @cached_property
    def modules(self) -> Mapping[str, frozenset[str]]:
        """Which packages of the workspace install a top-level Python module, by its name."""
        found: dict[str, set[str]] = {}
        for package in self.project.packages:
            for root, directory in package.build.python_roots:
                for name in {root.partition(".")[0]} if root else _below(package, directory):
                    found.setdefault(name, set()).add(package.name)
        return {name: frozenset(names) for name, names in found.items()}

    @cached_property
    def built_modules(self) -> Mapping[str, frozenset[str]]:
        """Which packages of the workspace have a command of CMake that builds a Python module, by its name."""
        found: dict[str, set[str]] = {}
        for package in self.project.packages:
            for command in package.commands(*_MODULES):
                for name in command.arguments[:1]:
                    found.setdefault(name, set()).add(package.name)
        return {name: frozenset(names) for name, names in found.items()}

    @cached_property
    def copies(self) -> frozenset[str]:
        """The files that are copies of a library of one file."""
        files = (file for package in self.project.packages for file in package.files)
        return frozenset(file.path for file in files if file.third_party == file.path)

    def ending(self, header: str) -> list[tuple[str, str]]:
        """The files, with their packages, that ``#include <header>`` may mean."""
        end = f"/{header}"
        return [
            (path, package)
            for path, package in self._by_name.get(header.rpartition("/")[2], ())
            if path.endswith(end) or path == header
        ]


def _below(package: ProjectPackage, directory: str) -> set[str]:
    base = "" if directory == "." else f"{directory}/"
    inner = (f.path[len(base) :] for f in package.files if f.path.startswith(base) and f.path.endswith(".py"))
    return {path.partition("/")[0].removesuffix(".py") for path in inner}
