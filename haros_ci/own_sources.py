# SPDX-License-Identifier: Apache-2.0
"""The digest of haros-ci's own sources, as part of cache keys: entries made by other code are never used."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from functools import cache
from hashlib import blake2b
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec

from haros_ci import __version__

_HERE = os.path.dirname(os.path.abspath(__file__))
#: The packages that facts of C++ and Python files are made by, themselves and those in them.
OF_FACTS = ("extract/cpp", "extract/python", "syntax")
#: Those that measure them.
OF_MEASURES = (*OF_FACTS, "measuring")
#: The packages that follow nodes: what is evaluated afresh in each run, as launch files are, has its own.
OF_FOLLOWED = (
    *OF_FACTS,
    *(
        "bounded_python",
        "bounded_yaml",
        "follow",
        "follow/libraries",
        "follow/ros",
        "graph",
        "index",
        "keeping",
        "model",
    ),
    *("substitutions", "systems", "values"),
)
#: The packages that linters are run by, and that what they find is kept as.
OF_LINTERS = ("bounded_python", "linters", "linters/catalogue", "model", "results")
#: The packages that are installed together, for what depends on all of the program.
INSTALLED = ("haros_ci", "haros_ci_checks")
#: Libraries by which files are read, and what is kept of them.
LIBRARIES = ("pyyaml", "tree-sitter", "tree-sitter-cpp", "google-re2", "msgspec")


@cache
def digest(packages: tuple[str, ...]) -> str:
    """A short digest of the files right in these *packages*, of the version, of the libraries, and of Python."""
    return _digest((package, os.path.join(_HERE, *package.split("/")), False) for package in packages)


@cache
def program_digest() -> str:
    """A digest of every module and table of haros-ci, wherever in it, of the version, of the libraries, and of Python."""
    specs = ((name, find_spec(name)) for name in INSTALLED)
    places = ((name, (spec and spec.submodule_search_locations) or ()) for name, spec in specs)
    return _digest((name, folder, True) for name, folders in places for folder in folders)


def _digest(folders: Iterator[tuple[str, str, bool]]) -> str:
    """Of *folders*: what each is called, where it is, and whether those in it count, too."""
    found = blake2b(digest_size=16)
    for part in (__version__, sys.version, *map(_version, LIBRARIES)):
        found.update(f"{part}\0".encode())
    for name, folder, is_deep in folders:
        for path in sorted(_files(folder, is_deep)):
            with open(os.path.join(folder, path), "rb") as file:
                data = file.read()
            found.update(f"{name}/{path}\0{len(data)}\0".encode())
            found.update(data)
    return found.hexdigest()


def _files(folder: str, is_deep: bool, inside: str = "") -> Iterator[str]:
    """The files in *folder* that change what is found: no documentation, no compiled code."""
    try:
        entries = list(os.scandir(folder))
    except OSError:  # not installed as files: the version alone tells
        return
    for entry in entries:
        if not entry.is_dir():
            if not entry.name.endswith((".pyc", ".md")):
                yield inside + entry.name
        elif is_deep and entry.name != "__pycache__":
            yield from _files(entry.path, is_deep, f"{inside}{entry.name}/")


@cache
def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        return ""
