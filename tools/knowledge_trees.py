# SPDX-License-Identifier: Apache-2.0
"""What the packages of a repository provide, by the names of their files and a few manifests."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

from knowledge_git import git, paths, texts

from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.workspace.package_xml import parse_package
from haros_ci.workspace.plugins_xml import read_plugins

_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".inl", ".ipp", ".tpp", ".h.in", ".hpp.in", ".h.em", ".hpp.em")
#: From when on earlier releases are looked at.
SINCE = 2020
_NO_MODULES = {
    "test", "tests", "testing", "src", "source", "script", "scripts", "launch", "config", "cfg", "node", "nodes", "lib", "python", "utils", "util",
    "cmake", "doc", "docs", "example", "examples", "common", "tools", "resource", "urdf", "msg", "srv", "action", "setup", "data", "demo", "demos",
}  # fmt: skip
_PLUGIN_FOLDERS = re.compile(
    r"(^|/)(test|tests|launch|urdf|worlds?|models?|maps|robots|behavior_trees|meshes|config|params)/"
)
_FIND = re.compile(r"(?:^|/)Find(\w+)\.cmake$|(?:^|/)([\w-]+?)-?[Cc]onfig\.cmake(?:\.in)?$")
#: Dependencies that come with a package once it is released.
_BROUGHT = {"depend", "exec_depend", "run_depend", "build_export_depend", "buildtool_export_depend"}


@dataclass(slots=True)
class Tree:
    """All that one revision of a repository tells about its packages."""

    packages: dict[str, Package] = field(default_factory=dict)
    headers: set[tuple[str, str]] = field(default_factory=set)
    modules: set[tuple[str, str]] = field(default_factory=set)
    cmake: set[tuple[str, str]] = field(default_factory=set)
    interfaces: set[tuple[str, str, str]] = field(default_factory=set)
    plugins: set[tuple[str, str, str]] = field(default_factory=set)


def read_tree(clone: Path, revision: str, ros: int) -> Tree:
    """The packages at *revision*, conditions in their manifests decided for *ros* 1 or 2."""
    files = paths(clone, revision)
    tree = Tree()
    manifests = [path for path in files if path == "package.xml" or path.endswith("/package.xml")]
    where: dict[str, str] = {}
    for path, text in _texts_of(clone, {path: files[path] for path in manifests}):
        package = parse_package(path, text.encode(), environment={"ROS_VERSION": str(ros)})
        if not isinstance(package, Problem):
            tree.packages[package.name] = package
            where[package.path] = package.name
    descriptions = []
    for path in files:
        name, inner = _owner(path, where)
        if not name:
            continue
        _look(tree, name, inner)
        if path.endswith(".xml") and not inner.endswith("package.xml") and not _PLUGIN_FOLDERS.search(inner):
            descriptions.append((name, path))
    for (name, path), text in zip(descriptions, texts(clone, [files[p] for _, p in descriptions]), strict=True):
        if "<class" in text and "<library" in text:
            for each in read_plugins(path, text, name)[0]:
                tree.plugins |= {(each.name or each.type, each.base, name), (each.type, each.base, name)}
    return tree


def brought(package: Package) -> Iterator[str]:
    """What comes with *package*."""
    return (each.name for each in package.dependencies if each.kind in _BROUGHT)


def older(clone: Path) -> Iterator[Package]:
    """The packages as they were at the beginning of each quarter of a year since SINCE, on the main branch."""
    seen = set()
    for year in range(SINCE, date.today().year + 1):
        for day in (f"{year}-01-01", f"{year}-04-01", f"{year}-07-01", f"{year}-10-01"):
            revision = git(clone, "rev-list", "-1", f"--before={day}", "HEAD").strip()
            if not revision or revision in seen:
                continue
            seen.add(revision)
            manifests = {p: o for p, o in paths(clone, revision).items() if p.rpartition("/")[2] == "package.xml"}
            for path, text in _texts_of(clone, {p: o for p, o in manifests.items() if o not in seen}):
                package = parse_package(path, text.encode())
                if not isinstance(package, Problem):
                    yield package
            seen.update(manifests.values())


def _texts_of(clone: Path, files: dict[str, str]) -> Iterator[tuple[str, str]]:
    return zip(files, texts(clone, files.values()), strict=True)


def _owner(path: str, where: dict[str, str]) -> tuple[str, str]:
    """The package that *path* is in, and the path there."""
    folder = path.rpartition("/")[0]
    while True:
        name = where.get(folder or ".")
        if name is not None:
            return name, path[len(folder) + 1 :] if folder else path
        if not folder:
            return "", path
        folder = folder.rpartition("/")[0]


def _look(tree: Tree, name: str, inner: str) -> None:
    parts = inner.split("/")
    if (
        inner.endswith(_HEADERS)
        and "include" in parts[:-1]
        and not {"test", "tests"} & set(parts[: parts.index("include")])
    ):
        header = "/".join(parts[parts.index("include") + 1 :])
        tree.headers.add((re.sub(r"\.(in|em)$", "", header), name))
    elif parts[-1] == "__init__.py" and len(parts) in (2, 3):
        if len(parts) == 2 or parts[0] in ("src", "python", "scripts", "lib"):
            _module(tree, parts[-2], name)
    elif parts[-1].endswith(".py") and len(parts) == 2 and parts[0] == "src":
        _module(tree, parts[-1][:-3], name)
    elif parts[0] in ("msg", "srv", "action") and parts[-1].rpartition(".")[2] == parts[0]:
        tree.interfaces.add((name, parts[0], parts[-1].rpartition(".")[0]))
    else:
        match = _FIND.search(inner)
        if match and "test" not in parts:
            tree.cmake.add((match[1] or match[2], name))


def _module(tree: Tree, module: str, name: str) -> None:
    if module.isidentifier() and module.lower() not in _NO_MODULES:
        tree.modules.add((module, name))


def shortened(headers: Iterable[tuple[str, str]], known: Iterable[str]) -> dict[str, list[str]]:
    """Paths and beginnings of paths with their providers: as few as tell all of *headers*.

    A folder that all of whose headers have the same providers stands for them; one that is named after its only provider
    needs no row; a folder of several is said to be mixed by a row without providers.
    """
    providers: dict[str, set[str]] = {}
    for path, name in headers:
        providers.setdefault(path, set()).add(name)
    folders: dict[str, list[set[str]]] = {}
    for path, names in providers.items():
        folder = path
        while "/" in folder:
            folder = folder.rpartition("/")[0]
            folders.setdefault(folder, []).append(names)
    uniform = {f"{folder}/": rows[0] for folder, rows in folders.items() if all(row == rows[0] for row in rows)}
    found: dict[str, list[str]] = {}
    packages = set(known)
    for path, names in providers.items():
        parts = path.split("/")
        for depth in range(1, len(parts)):
            folder = "/".join(parts[:depth]) + "/"
            if folder in uniform:
                if depth > 1 or names != {parts[0]} or parts[0] not in packages:
                    found[folder] = sorted(names)
                break
            if depth == 1:
                found[folder] = []
        else:
            found[path] = sorted(names)
    return found
