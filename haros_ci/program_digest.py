# SPDX-License-Identifier: Apache-2.0
"""Which program makes results: a digest of its own files, so that another one never takes what this one has kept."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from hashlib import blake2b
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from os import scandir

from haros_ci import __version__

#: The packages that are installed together.
PACKAGES = ("haros_ci", "haros_ci_checks")
#: Libraries by which files are read.
LIBRARIES = ("pyyaml", "tree-sitter", "tree-sitter-cpp", "google-re2")


@cache
def program_digest() -> str:
    """A digest of every module and table of haros-ci, of the libraries that it reads files with, and of Python, in hex."""
    digest = blake2b(digest_size=16)
    for part in (__version__, sys.version, *map(_version, LIBRARIES)):
        digest.update(f"{part}\0".encode())
    for package in PACKAGES:
        spec = find_spec(package)
        for directory in (spec and spec.submodule_search_locations) or ():
            for name in sorted(_files(directory)):
                with open(f"{directory}/{name}", "rb") as file:
                    content = file.read()
                digest.update(f"{package}/{name}\0{len(content)}\0".encode())
                digest.update(content)
    return digest.hexdigest()


def _files(directory: str, inside: str = "") -> Iterator[str]:
    """The files below *directory* that change what is found: no documentation, no compiled code."""
    with scandir(directory) as entries:
        for entry in entries:
            if entry.is_dir():
                if entry.name != "__pycache__":
                    yield from _files(entry.path, f"{inside}{entry.name}/")
            elif not entry.name.endswith((".pyc", ".md")):
                yield inside + entry.name


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        return ""
