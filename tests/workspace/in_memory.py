# SPDX-License-Identifier: Apache-2.0
"""Workspaces that are nowhere but in a dictionary of texts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from haros_ci.model.build import Build, Target
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.build import build_of
from haros_ci.workspace.language import language_of
from haros_ci.workspace.package_xml import parse_package

MANIFEST = '<package format="2"><name>{}</name><version>1.0.0</version></package>'


@dataclass(frozen=True)
class Texts:
    texts: Mapping[str, str]

    def text(self, path: str) -> str:
        return self.texts.get(path, "")


def workspace_of(texts: Mapping[str, str]) -> Workspace:
    """The workspace with these files, packages where a package.xml is."""
    packages = []
    for path, text in sorted(texts.items()):
        if path.rpartition("/")[2] == "package.xml":
            package = parse_package(path, text.encode())
            assert isinstance(package, Package)
            packages.append(package)
    files = []
    for path, text in sorted(texts.items()):
        name = path.rpartition("/")[2]
        language = language_of(name) or ("python" if text.startswith("#!") else None)
        if language is not None:
            owners = [p for p in packages if p.path == "." or path.startswith(f"{p.path}/")]
            owner = max(owners, key=lambda p: len(p.path)).name if owners else None
            files.append(SourceFile(path=path, language=language, size=len(text), digest="", package=owner))
    return Workspace(root=Path("/nowhere"), packages=tuple(packages), files=tuple(files), reader=Texts(texts))


def built(cmake: str, *paths: str, **texts: str) -> Build:
    """The build of a package ``arm`` in ``arm`` with that CMakeLists.txt, empty files at *paths*, and *texts*.

    In the names of *texts*, ``__`` stands for a slash and the last ``_`` for a dot.
    """
    files = {"arm/package.xml": MANIFEST.format("arm"), "arm/CMakeLists.txt": cmake}
    files |= {f"arm/{path}": "// code\n" for path in paths}
    for name, text in texts.items():
        stem, _, suffix = name.rpartition("_")
        files[f"arm/{stem.replace('__', '/')}.{suffix}"] = text
    workspace = workspace_of(files)
    return build_of(workspace, workspace.packages[0])


def names(build: Build) -> list[str]:
    return [target.name for target in build.targets]


def only(build: Build) -> Target:
    assert len(build.targets) == 1, names(build)
    return build.targets[0]


def value(cmake: str, *paths: str, **texts: str) -> list[str]:
    """The elements of the variable ``OUT`` after *cmake*, as the links of a target."""
    build = built(f"{cmake}\nadd_executable(out a.cpp)\ntarget_link_libraries(out ${{OUT}})", "a.cpp", *paths, **texts)
    return list(next(target for target in build.targets if target.name == "out").links)


def messages(build: Build) -> list[tuple[int | None, str]]:
    return [(problem.line, problem.message) for problem in build.problems]


def verdict(condition: str, before: str = "", *paths: str) -> bool | None:
    """Whether ``if(condition)`` holds; None if both branches are taken."""
    text = f"{before}\nif({condition})\nadd_library(yes a.cpp)\nelse()\nadd_library(no a.cpp)\nendif()"
    found = set(names(built(text, "a.cpp", *paths))) & {"yes", "no"}
    return None if found == {"yes", "no"} else {frozenset({"yes"}): True, frozenset({"no"}): False}[frozenset(found)]
