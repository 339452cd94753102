# SPDX-License-Identifier: Apache-2.0
"""Where messages, services and actions are used by name: in other definitions, by #include and by import."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import Project
from haros_ci.checking.unbuilt import unbuilt
from haros_ci.checking.unreached import unreached
from haros_ci.model.build import Interface
from haros_ci.model.location import Location

_HEADERS = (".h", ".hh", ".hpp", ".hxx")


def interfaces_in_use(project: Project) -> dict[str, Location]:
    """A place where each interface is used by name: another definition, an include, an import; not where nothing builds or starts the code.

    Of two of one name, a message and a service, nobody knows here which is meant: they are left out.
    """
    found: dict[str, Location] = {}
    included, aside = _included(project), dict[str | None, frozenset[str]]()
    owners = {file.path: file.package for file in project.workspace.files}
    doubles = _doubles(project)
    loose: frozenset[str] | None = None
    of_built: frozenset[str] | None = None
    for name, path, line in _places(project):
        if name in found or name in doubles or (path.endswith(_HEADERS) and path.rpartition("/")[2] not in included):
            continue
        if not path.endswith(".py"):
            loose = unbuilt(project) if loose is None else loose
            if loose and path.endswith(_HEADERS):
                of_built = _included(project, loose) if of_built is None else of_built
            if path in loose or (
                of_built is not None and path.endswith(_HEADERS) and path.rpartition("/")[2] not in of_built
            ):
                continue
        if path.endswith(".py"):
            owner = owners.get(path)
            package = project.package(owner) if owner is not None else None
            if owner not in aside:
                aside[owner] = unreached(package, [file.path for file in package.files]) if package else frozenset()
            if path in aside[owner]:
                continue
        found[name] = Location(path, line if isinstance(line, int) else _line_with(project.text(path), line))
    return found


def _doubles(project: Project) -> frozenset[str]:
    """Names that interfaces of several kinds have."""
    kinds: dict[str, set[str]] = {}
    for package in project.packages:
        for interface in package.build.interfaces:
            kinds.setdefault(interface.name, set()).add(interface.kind)
    return frozenset(name for name, all_kinds in kinds.items() if len(all_kinds) > 1)


def _included(project: Project, without: frozenset[str] = frozenset()) -> frozenset[str]:
    """How the headers are called that a source of the workspace includes, or a header that one includes; not those of the sources *without*."""
    named: dict[str, set[str]] = {}
    for path, program in project.programs.items():
        if program.language != "python" and path not in without:
            names = {header.strip('<>"').rpartition("/")[2] for header in program.includes}
            named.setdefault(path.rpartition("/")[2] if path.endswith(_HEADERS) else "", set()).update(names)
    found: set[str] = set()
    todo = [""]
    while todo:
        new = named.get(todo.pop(), set()) - found
        found |= new
        todo += new
    return frozenset(found)


def _places(project: Project) -> Iterator[tuple[str, str, int | str]]:
    """Where interfaces are used by name: the name, the file, and the line or what stands in it."""
    generated = {
        interface.path
        for package in project.packages
        for interface in package.build.interfaces
        if interface.is_generated
    }
    for interface in project.interfaces.values():
        for section in interface.sections if interface.path in generated else ():
            for field in section:
                yield field.type.partition("[")[0], interface.path, field.line
    yield from _in_includes(project)
    yield from _in_imports(project)


def _in_includes(project: Project) -> Iterator[tuple[str, str, str]]:
    made = (interface for package in project.packages for interface in package.build.interfaces)
    by_header = {header: interface.name for interface in made for header in _headers(interface)}
    written = {name.partition("include/")[2] for name in project.workspace.names if "include/" in name}
    for path, program in sorted(project.programs.items()):
        for header in (include.strip('<>"') for include in program.includes):
            if header not in written and (name := by_header.get(header)) is not None:
                yield name, path, header


def _in_imports(project: Project) -> Iterator[tuple[str, str, str]]:
    modules = {
        interface.name.replace("/", f".{interface.kind}."): interface.name for interface in project.interfaces.values()
    }
    for path, program in sorted(project.programs.items()):
        for alias in program.aliases if program.language == "python" else ():
            if (name := modules.get(str(alias.type.name))) is not None:
                yield name, path, name.rpartition("/")[2]


def _headers(interface: Interface) -> tuple[str, ...]:
    """The headers that are generated of it, by ROS 1 and ROS 2."""
    package, _, name = interface.name.partition("/")
    snake = re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)).lower()
    return (f"{package}/{name}.h", f"{package}/{interface.kind}/{snake}.hpp", f"{package}/{interface.kind}/{snake}.h")


def _line_with(text: str, word: str) -> int:
    return next((number for number, line in enumerate(text.splitlines(), 1) if word in line), 1)
