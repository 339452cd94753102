# SPDX-License-Identifier: Apache-2.0
"""Directories that hold a copy of another project: who has the copy does not mend its code."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

from haros_ci.model.former_names import is_not_used
from haros_ci.regex import regex
from haros_ci.workspace.library_trees import library_trees, releases

#: Names that a copy's directory has in C++ and Python projects, and those where pip and others install modules (``lib/python3/dist-packages``).
NAMES = frozenset(
    "third_party thirdparty third-party 3rdparty 3rd_party 3rd-party 3rd vendor vendored external externals extern deps"
    " external_lib external_libs external_library external_libraries site-packages dist-packages".split()
)
_LICENCE = regex(r"(?:licen[cs]e|copying|unlicense)(?:[-._][\w.-]+)?", re.IGNORECASE)
#: What people write behind the name of a package that they have kept and do not use: in English, Spanish and Portuguese, French, German, Italian, Chinese.
_BACKUP = regex(
    r"(.+?)[-_. (\[]{1,3}(?:backup|bak|old|orig|deprecated|obsolete|unused|not[-_ ]?used|copia|no[-_ ]us(?:ado|ada|ar)|sin[-_ ]usar|n[aã]o[-_ ]usad[oa]|obsoleto"
    r"|antiguo|inutilis[ée]|ancien|unbenutzt|veraltet|vecchio|备份|旧版|废弃|弃用|不用)[-_.]?\d{0,8}[)\]]?",
    re.IGNORECASE,
)
#: Directories that a package has by convention, and what stands at the root of a project.
_OF_PACKAGES = frozenset("src include scripts nodes launch".split())
_OF_A_PROJECT = regex(
    r"readme(?:\.\w+)?|cmakelists\.txt|(?:gnu)?makefile|setup\.py|pyproject\.toml|package\.json|configure(?:\.ac)?",
    re.IGNORECASE,
)
_CODE = (".py", ".js", ".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx")


class ThirdParty:
    """Which directories of a workspace hold copies, by the *names* of all its files and its *packages*, directory to name.

    A directory does if it is called so (``third_party``), or if it lies inside a package and has a licence of its own: a
    package has its licence at its root; a directory that a package has by convention (``src``), with code that is called like it, is its own. So does a package whose directory is a backup's by its name, or lies in one that is not used by its name, and one that is a release by its name and files, or the tree of a well-known library. A directory that a run is *requested* for, and those around it, are none for that run.
    """

    def __init__(self, names: Iterable[str], packages: Mapping[str, str], requested: Iterable[str] = ()) -> None:
        names = tuple(names)
        self._licensed = {_directory(name) for name in names if is_licence(name.rpartition("/")[2])}
        self._packages = frozenset(packages)
        self._licensed -= _own(names, self._licensed, packages)
        self._backups = {directory for directory, name in packages.items() if _is_backup(directory, name)}
        self._backups |= _not_used(packages)
        self._trees = library_trees(names, packages)
        self._copies = self._trees | releases(names, self._licensed, packages)
        self._known: dict[str, str] = {".": ""}
        for directory in requested:
            while directory not in self._known:
                self._known[directory] = ""
                directory = _directory(directory)

    def directory(self, path: str) -> str:
        """The outermost directory of the file at *path* that holds a copy; "" if none does."""
        return self._of(_directory(path))

    def _of(self, directory: str) -> str:
        way = []
        while directory not in self._known:  # a path may be deeper than Python's stack
            way.append(directory)
            directory = _directory(directory)
        for inside in reversed(way):
            self._known[inside] = self._known[directory] or (inside if self._is_one(inside) else "")
            directory = inside
        return self._known[directory]

    def is_tree(self, directory: str) -> bool:
        """Whether *directory* is the tree of a well-known library, by its files."""
        return directory in self._trees

    def _is_one(self, directory: str) -> bool:
        if directory.rpartition("/")[2].lower() in NAMES or directory in self._copies or directory in self._backups:
            return True
        return directory in self._licensed and directory not in self._packages and self._is_inside(directory)

    def _is_inside(self, directory: str) -> bool:
        while directory != "." and directory not in self._packages:
            directory = _directory(directory)
        return directory in self._packages


def _own(names: Iterable[str], licensed: Collection[str], packages: Mapping[str, str]) -> frozenset[str]:
    """Those of the *licensed* directories that are a package's own: by convention or by its name, with code that is called like it, and no project's root."""
    asked = {
        directory: packages[_directory(directory)]
        for directory in licensed
        if _directory(directory) in packages
        and directory.rpartition("/")[2] in (*_OF_PACKAGES, packages[_directory(directory)])
    }
    named: set[str] = set()
    rooted: set[str] = set()
    for path in names if asked else ():
        directory, base = _directory(path), path.rpartition("/")[2]
        if directory in asked:
            stem = base.rpartition(".")[0]
            is_named = stem == asked[directory] or stem.startswith(f"{asked[directory]}_")
            named.update({directory} if is_named and base.endswith(_CODE) else ())
            rooted.update({directory} if _OF_A_PROJECT.fullmatch(base) else ())
    return frozenset(named - rooted)


def _is_backup(directory: str, package: str) -> bool:
    """Whether the directory of *package* has its name with one of a backup behind it (``walker_backup``), or any name with one in brackets (``walk (unused)``)."""
    name = directory.rpartition("/")[2]
    found = _BACKUP.fullmatch(name)
    return found is not None and (
        found[1] == package or (name[-1] in ")]" and name[len(found[1]) :].lstrip()[0] in "([")
    )


def _not_used(packages: Iterable[str]) -> set[str]:
    """The directories around *packages* whose names say that they are not used: ``pkg_not_use``."""
    around: set[str] = set()
    for directory in packages:
        while (directory := _directory(directory)) not in around and directory != ".":
            around.add(directory)
    return {directory for directory in around if is_not_used(directory.rpartition("/")[2])}


def is_licence(name: str) -> bool:
    return _LICENCE.fullmatch(name) is not None and not name.lower().endswith(_CODE)


def around(path: str, directories: Collection[str]) -> str:
    """The one of *directories* that the file at *path* lies in; "" if none of them."""
    while "/" in path:
        path = path.rpartition("/")[0]
        if path in directories:
            return path
    return ""


def _directory(path: str) -> str:
    return path.rpartition("/")[0] or "."
