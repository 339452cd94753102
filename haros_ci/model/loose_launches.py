# SPDX-License-Identifier: Apache-2.0
"""Launch files in a directory without a package.xml that stands beside packages and whose nodes they start, or that a command starts: people launch them by their paths."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from haros_ci.model.former_names import is_archived
from haros_ci.model.package import Package, SourceFile
from haros_ci.regex import regex

#: What says in XML, Python and YAML whose nodes are started, or whose launch file is included.
_STARTED = regex(
    r"""\bpkg\s{0,9}=\s{0,9}["']([\w-]{1,99})["']"""
    r"""|<include\b[^<>]{0,400}?\$\(find(?:-pkg-share)?\s{1,9}([\w-]{1,99})\)"""
    r"""|\bpackage\s{0,9}=\s{0,9}["']([\w-]{1,99})["']"""
    r"""|\b(?:get_package_share_(?:directory|path)|FindPackageShare)\(\s{0,9}["']([\w-]{1,99})["']"""
    r"""|\bpkg\s{0,9}:\s{0,9}["']?([\w-]{1,99})"""
)
#: Directories of tests and of what only shows how to write a launch file.
_ASIDE = frozenset("doc docs documentation example examples sample samples template templates test tests".split())


def is_beside_packages(path: str, packages: Iterable[Package]) -> bool:
    """Whether the directory around that of the file at *path*, which is in no package, has packages in it or below."""
    around = path.rpartition("/")[0].rpartition("/")[0]
    return not is_aside(path) and any(not around or package.path.startswith(f"{around}/") for package in packages)


def starts_any(text: str, names: Collection[str]) -> bool:
    """Whether the *text* of a launch file names one of these packages where it says whose nodes or launch files it starts."""
    return any(name in names for match in _STARTED.finditer(text) for name in match.groups() if name)


def is_aside(path: str) -> bool:
    """Whether the file at *path* is in a directory of tests, examples or what is no longer used."""
    return is_archived(path) or not _ASIDE.isdisjoint(path.lower().split("/")[:-1])


def is_loose_launch(file: SourceFile, packages: Collection[Package], text: str, *, is_commanded: bool = False) -> bool:
    """Whether a *file* with that *text* is such a launch file, if it is one at all; one that *is_commanded* may lie anywhere."""
    if file.package is not None or file.third_party:
        return False
    if not is_commanded and not is_beside_packages(file.path, packages):
        return False
    return starts_any(text, {package.name for package in packages})
