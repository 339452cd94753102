# SPDX-License-Identifier: Apache-2.0
"""What the build of a package needs from other packages: what CMake does not go on without, and the headers of every build."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache

from haros_ci.checking.boost import HEADERS, brings_boost
from haros_ci.checking.includes import reached
from haros_ci.checking.outside_targets import builds_absent, downloads
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import Provisions, Sources, exists, first_provider, is_of_ros
from haros_ci.knowledge.knowledge import Knowledge
from haros_ci.model.build import CMakeCommand
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Commands that write files which may be headers.
_WRITING = (
    "configure_file",
    "generate_export_header",
    "add_custom_command",
    "file",
    "add_custom_target",
    "execute_process",
)
#: Commands that find a library of the system by pkg-config.
_PKG_CONFIG = ("pkg_check_modules", "pkg_search_module")
#: The end of names of packages that bring a library which the system may have, too.
_VENDOR = "_vendor"
#: Of a call so many lines are looked at.
MAX_LINES = 200
_QT = regex(r"Qt([456])")
_TESTING = regex(r"^[ \t]*(?:else)?if[ \t]*\([^)\n]*\b(?:CATKIN_ENABLE_TESTING|BUILD_TESTING)\b", re.I | re.M)


@dataclass(frozen=True, slots=True)
class Need:
    """One of *providers* has to be there for *what* at *location*."""

    providers: frozenset[str]
    location: Location
    what: str
    is_header: bool


#: Frameworks of tests, which ament and catkin find by themselves; packages that install a copy are not what is meant.
_FRAMEWORKS = frozenset(("gmock", "gtest"))


def lacking(package: ProjectPackage, needs: Iterable[Need], provisions: Provisions) -> frozenset[str]:
    """What *package* is advised to declare for *needs*: of each that no dependency brings, the package that brings it."""
    provided = provisions.of(package, tests=False)
    return frozenset(
        first_provider(need.providers, package) for need in needs if provisions.lacks(provided, need.providers)
    )


def needs_of(package: ProjectPackage, sources: Sources, *, tests: bool = False) -> tuple[Need, ...]:
    """What every build of *package* needs, or of its *tests*, whose providers are known; nothing if not CMake alone builds it."""
    return sources.once(("needs", package.path, tests), lambda: tuple(_needs(package, sources, tests)))


def _needs(package: ProjectPackage, sources: Sources, tests: bool) -> Iterator[Need]:
    if package.raw.is_metapackage or package.raw.build_type == "ament_python" or downloads(package):
        return
    yield from _found(package, sources, tests)
    yield from _included(package, sources, tests)


def _found(package: ProjectPackage, sources: Sources, tests: bool) -> Iterator[Need]:
    """The packages that CMake does not go on without."""
    project = package.project
    for command in package.commands("find_package"):
        if command.is_conditional or command.is_test is not tests or not command.arguments:
            continue
        for name in _required(command):
            if "$" in name or name == package.name or _brings_module(sources, name) or _is_own_build(name, command):
                continue
            if not tests and _may_be_for_tests(name, command, project.text(command.location.path)):
                continue
            names = project.knowledge.provider_of_cmake(name) or frozenset()
            if project.package(name) is not None:
                names |= {name}
            names |= _of_qt(name, project.knowledge) | (brings_boost(package) if name == "Boost" else frozenset())
            if exists(names, package):
                names |= _alike(name)
                yield Need(names, command.location, f"find_package({name})", False)


def _is_own_build(name: str, command: CMakeCommand) -> bool:
    """Whether the command wants the configuration of a build of one's own: that of protobuf and gRPC is in no package of the system."""
    return name.lower() in ("protobuf", "grpc") and bool({"CONFIG", "NO_MODULE"} & {*command.arguments})


def _of_qt(name: str, knowledge: Knowledge) -> frozenset[str]:
    """The keys of rosdep that bring Qt 4, 5 or 6, or a part of it, for find_package(Qt5) and find_package(Qt5Widgets)."""
    found = _QT.match(name)
    return (
        knowledge.keys_like(rf"(?:\w+-)*\w*q(?:t|ml){found[1]}|\w*q(?:t|ml)\w*{found[1]}")
        if found is not None
        else frozenset()
    )


def _may_be_for_tests(name: str, command: CMakeCommand, text: str) -> bool:
    """Whether *name* came to the command by a variable, and what stands before it asks whether tests are built."""
    lines, asks = _read(text)
    line = command.location.line or 1
    call = "".join(lines[line - 1 : line - 1 + MAX_LINES]).partition(")")[0]
    return name not in call and asks is not None and asks < line


@lru_cache(maxsize=8)
def _read(text: str) -> tuple[list[str], int | None]:
    """The lines of *text*, and the first that asks whether tests are built."""
    found = _TESTING.search(text)
    return text.splitlines(keepends=True), None if found is None else text.count("\n", 0, found.end()) + 1


def _alike(name: str) -> frozenset[str]:
    """How packages are called that bring CMake's package *name*, if it has one of its own."""
    plain = name.lower()
    return frozenset(
        (f"{plain}_vendor", f"lib{plain}-dev", f"{plain}-dev", f"lib{plain}", plain, f"{plain}_cmake_module")
    )


def _required(command: CMakeCommand) -> Iterator[str]:
    words = command.arguments
    if "REQUIRED" not in words:
        return
    if words[0] != "catkin":
        yield words[0]
        return
    yield "catkin"
    yield from command.after("COMPONENTS", "REQUIRED", "QUIET", "OPTIONAL_COMPONENTS")


def _brings_module(sources: Sources, name: str) -> bool:
    """Whether the workspace has ``FindName.cmake`` or ``NameConfig.cmake`` for CMake to find."""
    ends = (f"Find{name}.cmake", f"{name}Config.cmake", f"{name}-config.cmake", f"{name}Config.cmake.in")
    return not sources.file_names.isdisjoint(ends)


def _included(package: ProjectPackage, sources: Sources, tests: bool) -> Iterator[Need]:
    """The headers that every build includes, from elsewhere, and whose providers are known."""
    libraries: dict[str, frozenset[str]] = {}
    lent, made, is_hidden = _lent(package), _made(package), builds_absent(package)
    for include in reached(package, sources, tests=tests):
        header = include.header
        if header not in libraries:
            names = _providers(header, package, sources)
            libraries[header] = names | brings_boost(package) if HEADERS in names else names
        names = libraries[header]
        if _may_be_of_a_part(header, names, package):
            continue
        if is_hidden and not any(is_of_ros(name, package.project) for name in names):
            continue
        if _is_of_the_system(names, package):
            continue
        if header.rpartition("/")[2] not in made and not names & lent and exists(names, package):
            yield Need(names, include.location, f"#include <{header}>", True)


def _may_be_of_a_part(header: str, names: frozenset[str], package: ProjectPackage) -> bool:
    """Whether a declared package ``<top>_lib`` may bring ``<top>/a.h``: nothing but the directory's name speaks for the package *top*."""
    top, project = header.partition("/")[0], package.project
    if names != {top} or top in package.declared or project.package(top) is not None:
        return False
    if project.knowledge.lists_header(header) or project.knowledge.has_interfaces(top):
        return False
    return any(item.startswith((f"{top}_", f"{top}-")) for item in package.declared)


def _is_of_the_system(names: frozenset[str], package: ProjectPackage) -> bool:
    """Whether the library that packages ``X_vendor`` alone are known to bring is declared as ``X``, or found by pkg-config as ``X``."""
    stems = frozenset(name.removesuffix(_VENDOR) for name in names if name.endswith(_VENDOR))
    if not stems:
        return False
    found = {
        re.split(r"[<>=]", word)[0] for command in package.commands(*_PKG_CONFIG) for word in command.arguments[1:]
    }
    return not stems.isdisjoint(package.declared) or (len(stems) == len(names) and not stems.isdisjoint(found))


def _keepers(header: str, package: ProjectPackage, sources: Sources, is_known: bool) -> set[str]:
    """The packages of the workspace with the *header*. Of a known library not those that keep a copy of it for themselves."""
    own = {*package.declared, package.name}
    found = sources.ending(header)
    return {name for path, name in found if not is_known or name in own or path not in sources.copies}


def _providers(header: str, package: ProjectPackage, sources: Sources) -> frozenset[str]:
    project = package.project
    top, slash, _ = header.partition("/")
    if top in _FRAMEWORKS:
        return frozenset()
    if not slash or top == package.name:
        known = project.knowledge.provider_of_header(header) if not slash else None
        return known or frozenset()
    known = project.knowledge.provider_of_header(header) or frozenset()
    names = _keepers(header, package, sources, bool(known))
    other = project.package(top)
    if other is not None and (other.build.interfaces or other.build.configs or other.build.parameter_libraries):
        names.add(top)  # it generates headers
    elif other is not None and not names:
        return frozenset()
    return frozenset(names | known)


def _made(package: ProjectPackage) -> frozenset[str]:
    """The names of files that CMake writes."""
    words = (word for command in package.commands(*_WRITING) for word in command.arguments)
    return frozenset(word.rpartition("/")[2].removesuffix(".in") for word in words)


def _lent(package: ProjectPackage) -> frozenset[str]:
    """The packages of the workspace whose folders CMake names as places of headers."""
    found = set()
    for command in package.commands("include_directories", "target_include_directories"):
        for word in command.arguments:
            place = command.place(word) if "/" in word or word == ".." else None
            for other in package.project.packages if place is not None else ():
                if other is not package and (place == other.path or str(place).startswith(f"{other.path}/")):
                    found.add(other.name)
    return frozenset(found)
