# SPDX-License-Identifier: Apache-2.0
"""Python packages and modules that programs of ament_python load, and that the list in ``packages=`` of setup.py leaves out."""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Iterator

from haros_ci.checking.branches import parsed
from haros_ci.checking.check import Finding
from haros_ci.checking.linked_builds import is_built_with_links
from haros_ci.checking.own_modules import MAX_FILES, MAX_TEXT, SEARCHING, outermost_imports, top_of
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.wording import listed, spelled_out
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.module_names import names_of
from haros_ci.results.rule import Level

#: What else may bring modules, in setup.py, and in the files beside it.
_BRINGING = regex(
    r"\b(?:package_dir|package_data|include_package_data|py_modules|cmdclass|ext_modules|site-packages|dist-packages|purelib|platlib"
    r"|get_python_lib|get_path|get_paths)\b|\bfind_(?:namespace_)?packages[ \t]*\(|\[['\"]packages['\"]\]|\blib/python|\bos\.system\b|\bsubprocess\b|\bshutil\b|\bexec\("
)
_BRINGING_BESIDE = regex(
    r"\bpackage[-_]d(?:ata|ir)\b|\bpy[-_]modules\b|\binclude[-_]package[-_]data\b|\[tool\.setuptools|\[options\.packages"
)
_REMARK = regex(r"#[^\n]*")
_WORD = regex(r"[\w-]+")
#: So many imports of a package are followed, each as often as programs come by it.
MAX_STEPS = 100_000
_REQUIREMENTS = regex(r"(?:^|/)requirements[^/]*\.txt$")


@dataclass(frozen=True, slots=True)
class _Left:
    """What loads a package or module that is left out: a *program*, by an import at *location*; None where the program is in it."""

    program: str
    location: Location | None


def unlisted_modules(package: ProjectPackage) -> Iterator[Finding]:
    """What the programs of *package* load as they start, and setup.py does not install: one finding for parts of packages that it
    names, and one for what lies beside these.

    Nothing where the list is not wholly known, or where something else may install the files.
    """
    build = package.build
    if package.ros != 2 or not build.are_python_packages_all or not build.python_packages or _may_be_brought(package):
        return
    loads = _Loads(package)
    for entry_point in build.entry_points:
        if entry_point.path and (folder := top_of(entry_point)) == package.inside(entry_point.module.partition(".")[0]):
            if len(package.project.sources.modules.get(folder.rpartition("/")[2], ())) < 2:
                loads.follow(entry_point.path, entry_point.name)
    if any(not package.project.exists(package.inside(name.replace(".", "/"))) for name in loads.listed):
        return  # another finding says so
    tops = {name.partition(".")[0] for name in loads.listed}
    inner = {name: left for name, left in loads.left.items() if name.partition(".")[0] in tops}
    outer = {name: left for name, left in loads.left.items() if name not in inner}
    if inner:
        yield _finding(package, inner, Level.NOTE if is_built_with_links(package.project) else Level.WARNING)
    if outer:
        yield _finding(package, outer, Level.ERROR)


def _may_be_brought(package: ProjectPackage) -> bool:
    """Whether something beside ``packages=`` may install modules."""
    text = package.project.text
    if _BRINGING.search(_REMARK.sub("", text(package.inside("setup.py")))) is not None:
        return True
    return any(_BRINGING_BESIDE.search(text(package.inside(name))) for name in ("setup.cfg", "pyproject.toml"))


def _finding(package: ProjectPackage, left: dict[str, _Left], level: Level) -> Finding:
    names = sorted(left)
    programs = list(dict.fromkeys(left[name].program for name in names))
    word, stop = ("program", "stops") if len(programs) == 1 else ("programs", "stop")
    # colcon links to the directories of the packages that are named, so to all that lies in these
    unless = ", except after colcon build --symlink-install" if level is not Level.ERROR else ""
    return Finding(
        at=package.build.python_packages[0][1],
        message=f"setup.py of package {package.name} does not install {listed(names)}, which packages= does not name: "
        f"{word} {listed(programs)} {stop} with ModuleNotFoundError{unless}; {_remedy(package, names)}",
        about=(package.name, "packages", *names),
        apart=tuple(names),
        level=level,
        related=tuple((place, f"imports {name}") for name in names[:10] if (place := left[name].location) is not None),
    )


def _remedy(package: ProjectPackage, names: list[str]) -> str:
    files, place = package.project.workspace.names, package.inside
    modules = [name for name in names if place(f"{name}.py") in files]
    if modules:
        return f"write py_modules={modules!r}, or move {listed([f'{name}.py' for name in modules])} into the Python package"
    quoted = spelled_out([repr(name) for name in names])
    parents = {name.rsplit(".", up)[0] for name in names for up in range(name.count(".") + 1)}
    if all(place(f"{name.replace('.', '/')}/__init__.py") in files for name in parents):
        return f"write packages=find_packages(exclude=['test']), or add {quoted} to the list"
    return f"add {quoted} to the list"


@dataclass(slots=True)
class _Loads:
    """The files of *package* that its programs load, and what of these is in no package that setup.py names, by its dotted name."""

    package: ProjectPackage
    left: dict[str, _Left] = field(default_factory=dict)
    listed: frozenset[str] = frozenset()
    read: dict[str, tuple[tuple[str, Location], ...]] = field(default_factory=dict)
    own: dict[str, bool] = field(default_factory=dict)
    done: set[str] = field(default_factory=set)
    steps: int = 0
    words: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        files = [self.package.inside(name) for name in ("setup.py", "setup.cfg", "package.xml", "pyproject.toml")]
        files += (name for name in self.package.project.workspace.names if _REQUIREMENTS.search(name))
        self.words = frozenset(word for name in files for word in _WORD.findall(self.package.project.text(name)))
        self.listed = frozenset(name.replace("/", ".") for name, _ in self.package.build.python_packages)
        self.own |= {name.partition(".")[0]: True for name in self.listed}

    def follow(self, path: str, program: str) -> None:
        """Take down what the *program* in the file at *path* lacks; nothing of it if a file that it loads changes where Python searches."""
        if path in self.done:
            return
        left: dict[str, _Left] = {}
        todo: deque[tuple[str, Location | None]] = deque([(path, None)])
        seen = {path}
        while todo:
            file, location = todo.popleft()
            if self.steps > MAX_STEPS:
                return
            name = self._holder(file)
            if name not in self.listed:
                if not self._is_installed(file):
                    left.setdefault(name, _Left(program, location))
            elif SEARCHING.search(self.package.project.text(file)) is not None:
                return
            imported = self._imported(file)
            self.steps += len(imported)
            for other, place in imported:
                if other not in seen and other not in self.done and len(seen) < MAX_FILES:
                    seen.add(other)
                    todo.append((other, place))
        self.done |= seen
        for name, one in left.items():
            self.left.setdefault(name, one)

    def _imported(self, path: str) -> tuple[tuple[str, Location], ...]:
        """The files of the package that the one at *path* loads, each once, with the import."""
        if path not in self.read:
            text = self.package.project.text(path)
            tree = parsed(text) if len(text) <= MAX_TEXT else None
            folder = self.package.inside(self._inner(path).partition("/")[0])
            found: dict[str, Location] = {}
            for module, names, line in outermost_imports(tree, path, folder) if tree is not None else ():
                for other in self._loaded(module, names):
                    found.setdefault(other, Location(path, line))
            self.read[path] = tuple(found.items())
        return self.read[path]

    def _inner(self, path: str) -> str:
        return path[len(self.package.inside("")) :]

    def _holder(self, path: str) -> str:
        """The dotted name of the package that the file lies in; of a module in none its own."""
        inner = self._inner(path)
        return (inner.rpartition("/")[0] or inner.removesuffix(".py")).replace("/", ".")

    def _is_installed(self, path: str) -> bool:
        """Whether ``data_files`` or ``scripts`` puts the file where Python may search."""
        installed = self.package.build.installed
        return any(one.path == path and not one.destination.startswith("share") for one in installed)

    def _loaded(self, module: str, names: tuple[str, ...]) -> Iterator[str]:
        """The files of the package that ``from module import names`` runs, as far as they are there."""
        there = self.package.project.workspace.names
        parts = module.split(".")
        if parts[0] and parts[0] not in self.own:
            self.own[parts[0]] = self._is_own(parts[0])
        if not parts[0] or not self.own[parts[0]]:
            return
        place = self.package.inside("")[:-1]
        for part in parts:
            place = f"{place}/{part}".removeprefix("/")
            init = f"{place}/__init__.py"
            if init in there:
                yield init
            elif f"{place}.py" in there:
                yield f"{place}.py"
                return
        known = names_of(self.package.project.text(f"{place}/__init__.py")) or frozenset()
        for name in names:
            for file in (f"{place}/{name}/__init__.py", f"{place}/{name}.py"):
                if name not in known and file in there:
                    yield file

    def _is_own(self, top: str) -> bool:
        """Whether the module called *top* is a file or directory of this package, and nothing else can be meant."""
        package, project = self.package, self.package.project
        there, sources = project.workspace.names, project.sources
        if package.inside(f"{top}.py") not in there and package.inside(f"{top}/__init__.py") not in there:
            return False
        if top in sys.stdlib_module_names or project.package(top) is not None or top in sources.built_modules:
            return False
        if project.knowledge.provider_of_module(top) or sources.modules.get(top, frozenset()) - {package.name}:
            return False
        return top not in self.words
