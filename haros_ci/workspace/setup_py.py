# SPDX-License-Identifier: Apache-2.0
"""setup.py with setuptools or catkin_pkg's generate_distutils_setup: what it installs, read, never run."""

from __future__ import annotations

import ast
import posixpath
from collections import deque
from collections.abc import Iterable
from typing import Any

from haros_ci.model.build import DATA_FILES, Distribution, EntryPoint, Installed, RefusedEntry
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.workspace.cmake_install import tidy
from haros_ci.workspace.python_values import (
    MISSING,
    dotted,
    is_constant,
    parse_python,
    summands,
    text_of,
    value_of,
)
from haros_ci.workspace.setup_cfg import (
    console_scripts,
    entry_points,
    package_directories,
    project_scripts,
    refused_entries,
)
from haros_ci.workspace.setup_entries import script_lines
from haros_ci.workspace.setup_filled import filled
from haros_ci.workspace.setup_packages import package_names
from haros_ci.workspace.tree import PathTree

MAX_GLOBS = 100
MAX_NESTED = 10
MAX_ITEMS = 1_000
_CALLS = ("setup", "setuptools.setup", "distutils.core.setup", "generate_distutils_setup", "dict")


@dataclass(frozen=True, slots=True)
class Setup:
    """What setup.py says. *roots* as in ``Build.python_roots``; *parameter_modules* have a name and a YAML file.

    *packages* are the import packages that ``packages=`` writes out; *are_packages_all* if it names no others.
    """

    roots: tuple[tuple[str, str], ...] = ()
    installed: tuple[Installed, ...] = ()
    entry_points: tuple[EntryPoint, ...] = ()
    refused_entries: tuple[RefusedEntry, ...] = ()
    parameter_modules: tuple[tuple[str, str, Location], ...] = ()
    problems: tuple[Problem, ...] = ()
    distribution: Distribution | None = None
    packages: tuple[tuple[str, Location], ...] = ()
    are_packages_all: bool = False


def read_setup(tree: PathTree, package: Package) -> Setup:
    """The setup.py of *package*. What is computed there is a problem if it hides scripts, else left out."""
    base = "" if package.path == "." else f"{package.path}/"
    path = f"{base}setup.py"
    module = parse_python(tree.workspace.text(path))
    if isinstance(module, str):
        return Setup(problems=(Problem(path, f"not Python that can be read ({module}); what it installs is missing"),))
    try:
        return _SetupReader(tree, package, path, module).setup()
    except RecursionError:
        return Setup(problems=(Problem(path, "nested too deeply to follow; what it installs is missing"),))


class _SetupReader:
    def __init__(self, tree: PathTree, package: Package, path: str, module: ast.Module) -> None:
        self.tree = tree
        self.package = package
        self.path = path
        self.names: dict[str, Any] = {}
        self.given: dict[str, ast.expr] = {}
        self.calls: dict[str, str] = {}
        self.problems: list[Problem] = []
        self.refused: tuple[RefusedEntry, ...] = ()
        self.globs = 0
        self.looked = 0
        self.nodes: dict[str, list[ast.expr]] = {}
        self.filled = filled(module)
        self.parameter_modules: list[tuple[str, str, Location]] = []
        statements = deque(module.body)
        while statements:
            node = statements.popleft()
            if isinstance(node, (ast.If, ast.Try, ast.With)) or (
                isinstance(node, ast.FunctionDef) and node.name == "main"
            ):
                statements.extendleft(reversed(node.body))
            elif isinstance(node, (ast.Import, ast.ImportFrom)):
                self.calls.update({item.asname: item.name for item in node.names if item.asname is not None})
            elif isinstance(node, ast.Assign):
                self.assign(node)
            elif isinstance(node, ast.AugAssign) and dotted(node.target) in self.nodes:
                self.nodes[dotted(node.target)].append(node.value)
            elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
                self.keywords(node.value)
                self.grown(node.value)
                self.generated(node.value)

    def assign(self, node: ast.Assign) -> None:
        target = node.targets[0]
        if isinstance(node.value, ast.Call) and self.is_setup(node.value):
            self.keywords(node.value)
        elif isinstance(target, ast.Subscript) and isinstance(target.slice, ast.Constant):
            if isinstance(target.slice.value, str):
                self.given[target.slice.value] = node.value
        elif name := dotted(target):
            if isinstance(node.value, ast.Dict):
                self.entries(node.value)
            self.names[name] = self.value(node.value)
            known = self.nodes.get(name, [])
            is_given = isinstance(node.value, ast.Call) and any(dotted(item) == name for item in node.value.args)
            parts = [*known, node.value] if is_given else summands(node.value)  # a function that adds to its list
            self.nodes[name] = [p for part in parts for p in (known if dotted(part) == name else [part])][:MAX_ITEMS]

    def grown(self, call: ast.Call) -> None:
        """``name.append(item)`` and ``name.extend(items)``."""
        name, _, method = dotted(call.func).rpartition(".")
        if name not in self.nodes or len(call.args) != 1:
            return
        if len(self.nodes[name]) >= MAX_ITEMS:
            return
        if method == "append":
            self.nodes[name].append(ast.copy_location(ast.List(elts=[call.args[0]], ctx=ast.Load()), call))
        elif method == "extend":
            self.nodes[name].append(call.args[0])

    def generated(self, call: ast.Call) -> None:
        """generate_parameter_module(module_name, yaml_file, ...) of generate_parameter_library_py."""
        first, _, rest = dotted(call.func).partition(".")
        if f"{self.calls.get(first, first)}.{rest}".rstrip(".").rpartition(".")[2] != "generate_parameter_module":
            return
        keywords = {keyword.arg: keyword.value for keyword in call.keywords}
        keywords |= dict(zip(("module_name", "yaml_file"), call.args, strict=False))
        name, path = (self.value(keywords[key]) if key in keywords else MISSING for key in ("module_name", "yaml_file"))
        inner = self.inner(path) if isinstance(path, str) else None
        where = Location(self.path, call.lineno, call.col_offset + 1)
        if not isinstance(name, str) or inner is None:
            self.problem(call, "a parameter module")
        elif not self.tree.is_file(inner):
            message = f"{name}: the parameters in {path} are not among the files; they are missing"
            self.problems.append(Problem(self.path, message, call.lineno))
        else:
            self.parameter_modules.append((name, inner, where))

    def is_setup(self, call: ast.Call) -> bool:
        """Whether a call gives what is installed: setup(), what it unpacks, an update of it."""
        first, _, rest = dotted(call.func).partition(".")
        name = f"{self.calls.get(first, first)}.{rest}".rstrip(".").rpartition(".")[2]
        return name in _CALLS or (name == "update" and bool(rest))

    def keywords(self, call: ast.Call, depth: int = 0) -> None:
        """What a call says, calls and dictionaries that it is given or unpacks included: ``setup(**dict(a(b=c), d=e))``."""
        if not self.is_setup(call) or depth > MAX_NESTED:
            return
        for inner in (*call.args, *(keyword.value for keyword in call.keywords if keyword.arg is None)):
            if isinstance(inner, ast.Call):
                self.keywords(inner, depth + 1)
            elif isinstance(inner, ast.Dict):
                self.entries(inner, depth + 1)
        for keyword in call.keywords:
            if keyword.arg is not None:
                self.given[keyword.arg] = keyword.value

    def entries(self, node: ast.Dict, depth: int = 0) -> None:
        for key, value in zip(node.keys, node.values, strict=True):
            if isinstance(key, ast.Constant) and key.value in ("scripts", "package_dir", "entry_points", "data_files"):
                self.given[str(key.value)] = value
            elif key is None and isinstance(value, ast.Call):
                self.keywords(value, depth + 1)

    def value(self, node: ast.expr) -> Any:
        """As value_of, with os.path.join() of strings."""
        if isinstance(node, ast.Call) and dotted(node.func) in ("os.path.join", "path.join", "join"):
            return text_of([self.value(argument) for argument in node.args], lambda parts: posixpath.join(*parts))
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
            made = text_of([self.value(node.left), self.value(node.right)])
            return value_of(node, self.names) if made is MISSING else made
        return value_of(node, self.names)

    def problem(self, node: ast.expr, what: str) -> None:
        message = f"{what} is computed when setup.py runs; what it names is missing here"
        self.problems.append(Problem(self.path, message, node.lineno))

    def inner(self, word: str) -> str | None:
        """The root-relative path of one relative to setup.py; None if it leads elsewhere."""
        path = posixpath.normpath(posixpath.join(self.package.path, word))
        return None if path.startswith(("/", "../")) or path == ".." else path

    def setup(self) -> Setup:
        roots = self.roots()
        installed = (*self.scripts(), *self.data_files())
        entry_points = (*self.entry_points(roots), *self.configured(roots))
        rest = (self.refused, tuple(self.parameter_modules), tuple(self.problems), self.distribution())
        return Setup(
            roots, installed, entry_points, *rest, *package_names(self.given.get("packages"), self.value, self.path)
        )

    def distribution(self) -> Distribution | None:
        node = self.given.get("name")
        name = None if node is None else self.value(node)
        return (
            Distribution(name=name, location=Location(self.path, node.lineno))
            if node and isinstance(name, str)
            else None
        )

    def roots(self) -> tuple[tuple[str, str], ...]:
        node = self.given.get("package_dir")
        value = self.package_dir() if node is None else self.value(node)
        if not isinstance(value, dict):
            if node is not None:
                self.problem(node, "package_dir")
            return ()
        pairs = [(k, self.inner(v)) for k, v in value.items() if isinstance(k, str) and isinstance(v, str)]
        found = {name: path for name, path in pairs if path is not None}
        if "" not in found and not found:
            found[""] = self.package.path
        return tuple(sorted(found.items()))

    def package_dir(self) -> dict[str, str]:
        """``package_dir`` of the setup.cfg beside setup.py."""
        return package_directories(self.tree.workspace.text(f"{self.path.removesuffix('setup.py')}setup.cfg"))

    def scripts(self) -> list[Installed]:
        node = self.given.get("scripts")
        if node is None:
            return []
        found = [path for word in self.files(node, "scripts") if (path := self.inner(word)) is not None]
        directory = f"lib/{self.package.name}" if self.package.ros == 2 else "bin"
        return [self.put(path, "program", directory, node) for path in found]

    def data_files(self) -> list[Installed]:
        """``data_files=[(directory, [file, glob(...)])]``."""
        node = self.given.get("data_files")
        found: list[Installed] = []
        for pair in [] if node is None else self.elements(node):
            if isinstance(pair, (ast.Call, ast.Name)) and self.package.ros != 1:
                self.problem(pair, DATA_FILES)
            if not isinstance(pair, (ast.Tuple, ast.List)) or len(pair.elts) != 2:
                continue
            destination = self.value(pair.elts[0])
            if not isinstance(destination, str):
                self.problem(pair, f"a destination in {DATA_FILES}")
                continue
            paths = [self.inner(word) for word in self.files(pair.elts[1], f"a list in {DATA_FILES}")]
            kind = "program" if destination.strip("/") == f"lib/{self.package.name}" else "file"
            destination = tidy(destination.lstrip("/"))
            found += [self.put(path, kind, destination, pair, keeps_mode=True) for path in paths if path is not None]
        return found

    def elements(self, node: ast.expr, depth: int = 0) -> list[ast.expr]:
        """The items of a list that is written out, in one piece or in parts; a problem where it is computed."""
        self.looked += 1
        if isinstance(node, (ast.List, ast.Tuple)):
            items = [[item] if not isinstance(item, ast.Starred) else self.starred(item, depth) for item in node.elts]
            return [item for entry in items for item in entry]
        parts = summands(node) if isinstance(node, ast.BinOp) else self.nodes.get(dotted(node), [])
        if parts in ([], [node]) or depth > MAX_NESTED or self.looked > MAX_ITEMS:
            if self.package.ros != 1:
                self.problem(node, DATA_FILES)
            return []
        if dotted(node) in self.filled and self.package.ros != 1:
            self.problem(node, DATA_FILES)
        return [item for part in parts for item in self.elements(part, depth + 1)]

    def starred(self, node: ast.Starred, depth: int) -> list[ast.expr]:
        """The items of ``*list``; a problem where it is a call or another value that is computed."""
        return self.elements(node.value, depth + 1) if depth <= MAX_NESTED else []

    def put(self, path: str, kind: str, destination: str, node: ast.expr, *, keeps_mode: bool = False) -> Installed:
        return Installed(
            path=path,
            kind=kind,
            package=self.package.name,
            destination=destination,
            location=Location(self.path, node.lineno, node.col_offset + 1),
            name=path.rpartition("/")[2],
            keeps_mode=keeps_mode,
        )

    def files(self, node: ast.expr, what: str, depth: int = 0) -> list[str]:
        """The paths, relative to setup.py, that a list, glob() or a sum of such names."""
        if isinstance(node, (ast.List, ast.Tuple)) and depth < 5:
            return [path for item in node.elts for path in self.files(item, what, depth + 1)]
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add) and depth < 5 and self.value(node) is MISSING:
            return [*self.files(node.left, what, depth + 1), *self.files(node.right, what, depth + 1)]
        if isinstance(node, ast.Call) and dotted(node.func) in ("glob", "glob.glob", "glob.iglob") and node.args:
            pattern = self.value(node.args[0])
            deep = any(k.arg == "recursive" and is_constant(k.value, True) for k in node.keywords)
            deep = deep and isinstance(pattern, str) and "/**/" in pattern
            inner = self.inner(pattern.replace("/**/", "/") if deep else pattern) if isinstance(pattern, str) else None
            self.globs += 1
            if inner is not None and self.globs <= MAX_GLOBS:
                found = self.tree.glob(inner, recurse=deep, directories=False)
                return [posixpath.relpath(path, self.package.path) for path in found]
        value = self.value(node)
        if isinstance(value, str):
            return [value]
        if dotted(node) in self.filled:
            self.problem(node, what)
        if isinstance(value, list) and all(isinstance(item, str) for item in value):
            return value
        self.problem(node, what)
        return []

    def entry_points(self, roots: tuple[tuple[str, str], ...]) -> tuple[EntryPoint, ...]:
        node = self.given.get("entry_points")
        lines = [] if node is None else script_lines(node, self.value, self.nodes)
        if node is not None and (lines is None or dotted(node) in self.filled):
            self.problem(node, "entry_points")
        unknown = [place for text, place in lines or () if text is MISSING]
        if node is not None and unknown:
            message = f"{len(unknown)} of the entry points {'is' if len(unknown) == 1 else 'are'} computed when setup.py runs; what is named there is missing here"
            self.problems.append(Problem(self.path, message, unknown[0][0]))
        return self.taken(lines or (), self.path, roots)

    def taken(
        self, lines: Iterable[tuple[Any, tuple[int, int]]], path: str, roots: tuple[tuple[str, str], ...]
    ) -> tuple[EntryPoint, ...]:
        """The programs that *lines* of *path* make; from which none is made is kept, too."""
        lines = tuple(lines)
        self.refused += refused_entries(lines, path)
        return entry_points(self.tree, self.package, lines, path, roots)

    def configured(self, roots: tuple[tuple[str, str], ...]) -> tuple[EntryPoint, ...]:
        """The console scripts of the setup.cfg and pyproject.toml beside setup.py, which count where setup() is given none."""
        if "entry_points" in self.given:
            return ()
        found: tuple[EntryPoint, ...] = ()
        for name, read in (("setup.cfg", console_scripts), ("pyproject.toml", project_scripts)):
            path = f"{self.path.removesuffix('setup.py')}{name}"
            lines = read(self.tree.workspace.text(path))
            found += self.taken(((text, (line, column)) for text, line, column in lines), path, roots)
        return found
