# SPDX-License-Identifier: Apache-2.0
"""Interfaces of a project: what a change did to them, and who uses one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cached_property

from haros_ci.changes.interfaces import Defined, InterfaceChange, interface_changes
from haros_ci.checking.entries import paths_by_name
from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC
from haros_ci.checking.project import Project
from haros_ci.checking.system import End
from haros_ci.interfaces.references import Reference, of_import, of_include, references_to
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

_KINDS = {kind: made for kinds, made in ((TOPIC, "msg"), (SERVICE, "srv"), (ACTION, "action")) for kind in kinds}
_DIRECTIVE = regex(r"\s*#\s*(if(?:n?def)?|el\w+|endif|include|import)\b\s*(\w*)")
_DEFINE = regex(r"\s*#\s*define\s+(\w+)")
#: In this many lines of a file an import is looked for.
MAX_LINES = 100_000


@dataclass(frozen=True, slots=True)
class User:
    """One place that uses an interface, and *how* in words."""

    location: Location
    how: str


def defined_in(project: Project) -> tuple[Defined, ...]:
    """All interfaces of *project*, with the ROS version of their packages."""
    return tuple((interface, package.ros) for package in project.packages for interface in package.build.interfaces)


def changes_of(project: Project) -> tuple[InterfaceChange, ...]:
    """What changed in the interfaces since the base revision; nothing without one."""
    return () if project.base is None else interface_changes(defined_in(project.base), defined_in(project))


class InterfaceUsers:
    """Who uses which interface of *project*."""

    def __init__(self, project: Project) -> None:
        self.project = project

    def of(self, kind: str, name: str) -> Iterator[User]:
        """Every end of a topic, service or action of the type ``pkg/T``, then every file of code that names it."""
        package, _, short = name.partition("/")
        owner = self.project.package(package)
        yield from self._ends.get((kind, name), {}).values()
        for reference in sorted(references_to(package, kind, short, owner.ros if owner else None), key=str):
            for path, written in self.named.get(reference, ()):
                how = "imports it" if "/" not in written else "includes it"
                yield User(location_of(self.project, path, written), how)

    @cached_property
    def named(self) -> Mapping[Reference, tuple[tuple[str, str], ...]]:
        """Which files of code name an interface, and how: by #include, or by an import at module level, as written."""
        made: dict[Reference, list[tuple[str, str]]] = {}
        for path, program in self.project.programs.items():
            if program.language == "python":
                named = {str(alias.type.name): of_import(str(alias.type.name)) for alias in program.aliases}
            else:
                named = {written: of_include(written.strip('"<>')) for written in program.includes}
            for written, reference in named.items():
                if reference is not None:
                    made.setdefault(reference, []).append((path, written))
        return {reference: tuple(found) for reference, found in made.items()}

    @cached_property
    def _ends(self) -> Mapping[tuple[str, str], dict[tuple[Location, str], User]]:
        made: dict[tuple[str, str], dict[tuple[Location, str], User]] = {}
        for system in self.project.systems:
            for end in system.ends:
                kind = _KINDS.get(end.kind)
                if end.type is not None and kind is not None and not end.implicit and end.in_source:
                    of = made.setdefault((kind, short_name(end.type)), {})
                    of.setdefault((end.location, end.kind), User(end.location, _described(end)))
        return made


def _described(end: End) -> str:
    return f"{end.node.name}: {end.word} {end.name}"


def short_name(type: str) -> str:
    """``pkg/T`` of ``pkg/msg/T``."""
    package, _, rest = type.partition("/")
    return f"{package}/{rest.rpartition('/')[2]}"


def is_written_here(project: Project, written: str) -> bool:
    """Whether the workspace itself has the header that is included, or a module in the place of the generated one: people may have written what it means."""
    name = written.strip('"<>')
    names = project.workspace.names
    if "/" in name:
        return any(f"/{path}".endswith(f"/{name}") for path in paths_by_name(names).get(name.rpartition("/")[2], ()))
    module = name.rpartition(".")[0].replace(".", "/")
    return any(path.endswith((f"{module}.py", f"{module}/__init__.py")) for path in names)


def location_of(project: Project, path: str, written: str) -> Location:
    """Where the file *path* has the include or import *written*; the whole file if it is not found."""
    found = next(_places(project, path, written), None)
    return Location(path) if found is None else found[0]


def always_at(project: Project, path: str, written: str) -> Location | None:
    """Where the file *path* has the include or import *written* under no condition; None if it has one, or it is not found."""
    return next((location for location, is_conditional in _places(project, path, written) if not is_conditional), None)


def _places(project: Project, path: str, written: str) -> Iterator[tuple[Location, bool]]:
    """Each place, and whether a condition stands around it."""
    lines = project.text(path).split("\n")[:MAX_LINES]
    return _includes(path, lines, written) if written[:1] in ('"', "<") else _imports(path, lines, written)


def _includes(path: str, lines: list[str], written: str) -> Iterator[tuple[Location, bool]]:
    pattern = re.compile(rf"\s*#\s*(?:include|import)\s*{re.escape(written)}")
    open_ifs: list[bool] = []  # whether each is a condition, and no guard against a second inclusion
    for number, line in enumerate(lines, 1):
        directive = _DIRECTIVE.match(line)
        if directive is None:
            continue
        if directive[1].startswith("if"):
            guard = _DEFINE.match(lines[number]) if directive[1] == "ifndef" and number < len(lines) else None
            open_ifs.append(guard is None or guard[1] != directive[2])
        elif directive[1] == "endif":
            del open_ifs[-1:]
        elif directive[1].startswith("el"):
            open_ifs[-1:] = [True]
        elif pattern.match(line):
            yield Location(path, number, len(line) - len(line.lstrip()) + 1), any(open_ifs)


def _imports(path: str, lines: list[str], written: str) -> Iterator[tuple[Location, bool]]:
    module, _, name = written.rpartition(".")
    begin = re.compile(rf"(\s*)from\s+{re.escape(module)}\s+import\b")
    here = re.compile(rf"\b{re.escape(name)}\b")
    is_open = in_parentheses = is_inner = False
    for number, line in enumerate(lines, 1):
        start = begin.match(line)
        if not (start or is_open):
            continue
        code = line.partition("#")[0]
        if start is not None:
            is_inner, in_parentheses = bool(start[1]), "(" in code
        found = here.search(code, start.end() if start else 0)
        if found is not None:
            yield Location(path, number, found.start() + 1), is_inner
        is_open = (in_parentheses and ")" not in code) or code.rstrip().endswith("\\")
