# SPDX-License-Identifier: Apache-2.0
"""Modules of its own package that a program of Python imports when it starts, and that Python does not find there."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.checking.appearing import may_appear
from haros_ci.checking.branches import parsed
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import Sources
from haros_ci.model.build import EntryPoint
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.module_names import EXTENSIONS, names_of

#: What lets Python find modules elsewhere, or makes them while it runs.
SEARCHING = regex(
    r"\bsys\.(?:path|modules|meta_path)\b|\b__path__\b|\bimportlib\b|\baddsitedir\b|\bextend_path\b|\bos\.chdir\b"
)
#: What the build makes in a package of Python: interfaces, reconfigurations and extensions.
_MADE = frozenset(("msg", "srv", "action", "cfg", "parameters"))
#: What Python takes for no module, nor a build makes one of.
_DATA = (
    ".pyi",
    ".txt",
    ".md",
    ".rst",
    ".yaml",
    ".yml",
    ".json",
    ".csv",
    ".xml",
    ".png",
    ".jpg",
    ".svg",
    ".html",
    ".ipynb",
    ".bak",
    ".orig",
)
#: Longer files are not looked at, nor more files of one program.
MAX_TEXT = 300_000
MAX_FILES = 500


@dataclass(frozen=True, slots=True)
class LostImport:
    """The import of a *module*, or of a *name* in it, at *location*; *instead* is what to write, "" where nothing of that name is there."""

    module: str
    location: Location
    instead: str
    name: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """The module, and the name if it is one."""
        return (self.module, self.name) if self.name else (self.module,)

    def sentence(self) -> str:
        """What the program does, and what to write instead."""
        if self.name:
            remedy = f"write {self.instead}" if self.instead else "define it there, or remove the import"
            return f"it imports {self.name} from {self.module}, which has no such name; {remedy}"
        return f"it imports {self.module}, which " + (
            f"is {self.instead}; write that name" if self.instead else "does not exist"
        )


@dataclass(slots=True)
class OwnModules:
    """The modules of *package* that programs of it load, each file looked at once."""

    package: ProjectPackage
    sources: Sources
    seen: set[str] = field(default_factory=set)

    def lost(self, entry_point: EntryPoint) -> Iterator[LostImport]:
        """What stops the program: imports that stand at the outermost level of its module, and of modules of the package that this imports so.

        Nothing where a file changes where Python searches, or where what is missing may be made or installed in another way.
        """
        folder = top_of(entry_point)
        if folder is not None and len(self.sources.modules.get(_name(folder), ())) < 2:
            yield from self._lost(entry_point.path, folder)

    def lost_by_script(self, path: str) -> Iterator[LostImport]:
        """The same of the script at *path*, where the package has one Python package, and nothing beside the script has its name.

        Python searches the directory of a script first.
        """
        folders = set(self._folders())
        folder = folders.pop() if len(folders) == 1 else None
        if folder is None or path.startswith(f"{folder}/") or len(self.sources.modules.get(_name(folder), ())) != 1:
            return
        beside = f"{path.rpartition('/')[0]}/{_name(folder)}".removeprefix("/")
        if beside == folder or not self._is_there(beside):
            yield from (lost for lost in self._lost(path, folder) if not lost.instead or lost.name)

    def _folders(self) -> Iterator[str]:
        """The directories of the outermost Python packages that the package installs."""
        names = self.package.project.workspace.names
        for name, directory in self.package.build.python_roots:
            if name:
                yield directory
            else:
                start = "" if directory == "." else f"{directory}/"
                tops = {
                    file.path.removeprefix(start).partition("/")[0]
                    for file in self.package.files
                    if file.path.startswith(start)
                }
                yield from (f"{start}{top}" for top in tops if f"{start}{top}/__init__.py" in names)

    def _is_there(self, place: str) -> bool:
        return f"{place}.py" in self.package.project.workspace.names or self._is_folder(place)

    def _lost(self, path: str, folder: str) -> Iterator[LostImport]:
        """What the file at *path*, and the modules below *folder* that it loads, import in vain."""
        todo = [path]
        while todo and len(self.seen) < MAX_FILES:
            path = todo.pop(0)
            text = self.package.project.text(path)
            tree = parsed(text) if path not in self.seen and len(text) <= MAX_TEXT else None
            self.seen.add(path)
            if SEARCHING.search(text) is not None:
                return
            for module, names, line in outermost_imports(tree, path, folder) if tree is not None else ():
                location = Location(path, line)
                if module.partition(".")[0] == _name(folder):
                    found, is_lost = self._found(module, folder)
                    todo += found
                    if is_lost:
                        yield LostImport(module, location, "")
                    elif found and names:
                        place = "/".join((folder, *module.split(".")[1:]))
                        if found[-1] in (f"{place}.py", f"{place}/__init__.py"):
                            yield from self._lost_names(module, names, found[-1], location)
                elif (beside := self._beside(module, path)) is not None:
                    yield LostImport(module, location, f"{_dotted(beside, folder)}")

    def _found(self, module: str, folder: str) -> tuple[list[str], bool]:
        """The files that ``import`` of *module* loads, and whether the last one is not there."""
        project, found, place = self.package.project, [], folder
        if f"{folder}/__init__.py" in project.workspace.names:
            found.append(f"{folder}/__init__.py")
        for part in module.split(".")[1:]:
            names = re.compile(rf"\b{part}\b")
            beside = f"{place}/__init__.py"
            place = f"{place}/{part}"
            files = [name for name in (f"{place}/__init__.py", f"{place}.py") if name in project.workspace.names]
            found += files
            if not files and not self._is_folder(place):
                return found, part not in _MADE and not names.search(project.text(beside)) and not self._may_come(place)
        return found, False

    def _lost_names(self, module: str, names: tuple[str, ...], file: str, location: Location) -> Iterator[LostImport]:
        """The *names* that neither the module in *file* has, nor a module below it."""
        place = file.removesuffix("/__init__.py").removesuffix(".py")
        text = self.package.project.text(file)
        known = names_of(text) if len(text) <= MAX_TEXT else None
        if known is None:
            return
        for name in names:
            below = f"{place}/{name}"
            if name in known or name.startswith("__") or name in _MADE or self._is_folder(below):
                continue
            if not self._may_come(below):
                alike = get_close_matches(name, sorted(known), 1, 0.75)
                yield LostImport(module, location, alike[0] if alike else "", name)

    def _is_folder(self, place: str) -> bool:
        """Whether a directory, or a module in another form than text, is at *place*."""
        inside, other = f"{place}/", f"{place}."
        return any(
            name.startswith(inside) or (name.startswith(other) and not name.endswith(_DATA))
            for name in self.package.project.workspace.names
        )

    def _may_come(self, place: str) -> bool:
        name = place.rpartition("/")[2]
        build = "".join(
            self.package.project.text(self.package.inside(file)) for file in ("CMakeLists.txt", "setup.py", "setup.cfg")
        )
        return (
            name.startswith("_")
            or self._builds_extensions(build)
            or may_appear(self.package, f"{place}.py", ())
            or self.package.project.is_absent(place)
            or re.search(rf"(?<![\w.]){name}\b(?!:)", build) is not None
            or any(library.name == name for library in self.package.build.parameter_libraries)
        )

    def _builds_extensions(self, build: str) -> bool:
        """Whether the package compiles modules for Python: the text of its *build* says so, or a command of CMake in any of its directories."""
        lines = (f"{command.name}({' '.join(command.arguments)[:1000]})" for command in self.package.build.commands)
        made = self.sources.once(
            ("extensions", self.package.name), lambda: any(map(EXTENSIONS.search, (build, *lines)))
        )
        return bool(made)

    def _beside(self, module: str, path: str) -> str | None:
        """The file beside the one at *path* that ``import module`` is meant to load: Python does not search there for a program of setuptools."""
        project, folder = self.package.project, path.rpartition("/")[0]
        file = f"{folder}/{module}.py"
        if "." in module or file not in project.workspace.names or module in sys.stdlib_module_names:
            return None
        if project.package(module) is not None or project.knowledge.provider_of_module(module):
            return None
        if (
            module in self.sources.modules
            or module in self.sources.built_modules
            or self._may_come(f"{folder}/{module}")
        ):
            return None
        installed = {thing.path for thing in self.package.build.installed if not thing.destination.startswith("share")}
        return None if file in installed or folder in installed else file


def top_of(entry_point: EntryPoint) -> str | None:
    """The directory of the outermost package that the module is in; None if it is in none."""
    parts = entry_point.module.split(".")
    tail = "/".join(parts[1:])
    for end in (f"/{tail}.py", f"/{tail}/__init__.py"):
        if len(parts) > 1 and entry_point.path.endswith(f"/{parts[0]}{end}"):
            return entry_point.path.removesuffix(end)
        if len(parts) > 1 and entry_point.path == f"{parts[0]}{end}":
            return parts[0]
    return None


def _name(folder: str) -> str:
    return folder.rpartition("/")[2]


def _dotted(file: str, folder: str) -> str:
    inner = file.removeprefix(folder).removesuffix(".py").replace("/", ".")
    return f"{_name(folder)}{inner}"


def outermost_imports(tree: ast.Module, path: str, folder: str) -> Iterator[tuple[str, tuple[str, ...], int]]:
    """The modules that the outermost statements import, by their whole names, with the names taken from them and the lines; relative ones resolved in *folder*."""
    inner = path.removeprefix(folder).split("/")[1:-1] if path.startswith(f"{folder}/") else None
    for statement in tree.body:
        if isinstance(statement, ast.Import):
            yield from ((alias.name, (), statement.lineno) for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom):
            names = tuple(alias.name for alias in statement.names if alias.name != "*")
            module = (statement.module,) if statement.module else ()
            if statement.level == 0:
                yield ".".join(module), names, statement.lineno
            elif inner is not None and statement.level <= len(inner) + 1:
                above = inner[: len(inner) + 1 - statement.level]
                yield ".".join((_name(folder), *above, *module)), names, statement.lineno
