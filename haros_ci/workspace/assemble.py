# SPDX-License-Identifier: Apache-2.0
"""From the contents of files to a Workspace, wherever the contents come from."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.content import examine
from haros_ci.workspace.files import TextReader
from haros_ci.workspace.package_xml import parse_package, settled, supports_both


@dataclass(frozen=True, slots=True)
class Content:
    """The bytes of one file."""

    path: str
    language: str
    data: bytes


@dataclass(frozen=True, slots=True)
class Alias:
    """A symbolic link at *path*, and what it leads to."""

    path: str
    target: str


def assemble(
    root: Path,
    contents: Iterable[Content | Alias | Problem],
    *,
    listed: Iterable[str],
    problems: Iterable[Problem],
    targets: frozenset[str] | None,
    context: Iterable[Content],
    max_file_size: int,
    name: str | None = None,
    names: Iterable[str] | None = None,
    executables: Iterable[str] | None = None,
    elsewhere: Path | None = None,
) -> Workspace:
    """Hash and examine *contents* one by one (they may be a generator), parse manifests, sort everything.

    *listed* are all paths that may be asked for as text, those that are not analysed (tools' settings) included.
    *context* are manifests of packages that the files lie in, but that are not to be analysed themselves. A nameless
    package at the root takes *name*, by default the root's own. *names* are the paths of all files, by default *listed*,
    *executables* those whose execute bit is set, None if nobody knows.
    Files that are not *listed* lie below *elsewhere*, by default the root.
    """
    from hashlib import sha256

    name = name or root.name
    listed = tuple(listed)
    found = list(problems)
    files: list[SourceFile] = []
    links: dict[str, str] = {}
    packages: dict[str, tuple[Package, Problem | None]] = {}
    undecided: dict[str, Content] = {}
    for manifest in context:
        packages[_directory(manifest.path)] = (_package(manifest, name)[0], None)
    for content in contents:
        if isinstance(content, Problem):
            found.append(content)
            continue
        if isinstance(content, Alias):
            links[content.path] = content.target
            continue
        usable, problem = examine(content.path, content.language, content.data)
        if problem is not None:
            found.append(problem)
        if content.path.rpartition("/")[2] == "package.xml":
            directory = _directory(content.path)
            packages[directory] = _package(content, name)
            if supports_both(packages[directory][0]):
                undecided[directory] = content
        if usable:
            files.append(
                SourceFile(
                    path=content.path,
                    language=content.language,
                    size=len(content.data),
                    digest=sha256(content.data).hexdigest(),
                    lines=content.data.count(b"\n"),
                    has_directive=b"haros:" in content.data,
                )
            )
    others = [package for package, _ in packages.values()]
    for directory, manifest in undecided.items():
        package, fault = packages[directory]
        packages[directory] = settled(package, manifest.path, manifest.data, others), fault
    found += _doubles(package for package, _ in packages.values())
    owners = {directory: package.name for directory, (package, _) in packages.items()}
    return Workspace(
        root=root,
        packages=tuple(sorted((package for package, _ in packages.values()), key=lambda p: (p.path, p.name))),
        files=_owned(sorted(files, key=lambda file: file.path), owners),
        reader=TextReader(root, listed, max_file_size, elsewhere),
        targets=None if targets is None else targets & {file.path for file in files},
        problems=_sorted(found),
        faults=_sorted(fault for _, fault in packages.values() if fault is not None),
        links=tuple(sorted(links.items())),
        names=frozenset(listed if names is None else names),
        executables=None if executables is None else frozenset(executables),
    )


def _package(content: Content, root_name: str) -> tuple[Package, Problem | None]:
    """The package of a manifest; of a malformed one the directory, under its own name, and the fault."""
    package = parse_package(content.path, content.data)
    if isinstance(package, Package):
        return package, None
    directory = _directory(content.path)
    return Package(name=root_name if directory == "." else directory.rpartition("/")[2], path=directory), package


def _owned(files: Iterable[SourceFile], owners: dict[str, str]) -> tuple[SourceFile, ...]:
    """The files with the name of the innermost package around them."""
    known: dict[str, str | None] = {".": None, **owners}
    made = []
    for file in files:
        directory = start = _directory(file.path)
        while directory not in known:
            directory = _directory(directory)
        known[start] = known[directory]
        made.append(replace(file, package=known[directory]))
    return tuple(made)


def _doubles(packages: Iterable[Package]) -> Iterable[Problem]:
    """A problem for each further package of a name; colcon and catkin refuse them."""
    first: dict[str, str] = {}
    for package in sorted(packages, key=lambda p: p.path):
        if package.name in first:
            message = f"the package name {package.name!r} is also that of {first[package.name]}; rename or exclude one"
            yield Problem(package.path, message)
        first.setdefault(package.name, package.path)


def _sorted(problems: Iterable[Problem]) -> tuple[Problem, ...]:
    return tuple(sorted(set(problems), key=lambda p: (p.path, p.line or 0, p.message)))


def _directory(path: str) -> str:
    return path.rpartition("/")[0] or "."
