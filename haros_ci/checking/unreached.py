# SPDX-License-Identifier: Apache-2.0
"""Python modules of a package that lie aside, and that nothing which runs imports: what they need is missed by nobody."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from posixpath import basename, dirname, splitext

from haros_ci.checking.imports import imported_words, reached_from
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.started import started_programs
from haros_ci.checking.unstarted import is_unstarted
from haros_ci.model.former_names import is_archived
from haros_ci.regex import regex

#: Directories of what is not in use yet, beside those of what is no longer.
_ASIDE = regex(r"(?:older|prototypes?|experiments?)", re.IGNORECASE)
#: Of a package with more files nothing is said.
_MOST_FILES = 5_000


def unreached(package: ProjectPackage, paths: Iterable[str]) -> frozenset[str]:
    """Those of *paths*, Python files of *package*, that no entry point, install rule or launch file names and no file that is reached imports.

    They lie in a directory called ``old``, ``prototype`` and the like, or outside of the packages that setup.py names, or nothing of the
    workspace names them beside the programs that there are. Imports in comments do not count. A script lies aside by its directory alone.
    """
    used = {entry_point.path for entry_point in package.build.entry_points}
    used |= {installed.path for installed in package.build.installed if installed.kind != "directory"}
    candidates = {path for path in paths if path.endswith(".py") and path not in used}
    python = package.project.python_paths
    if not candidates or len(python) > _MOST_FILES:
        return frozenset()
    loose = {path for path in python if path not in used and _is_loose(package, path)}
    scripts = set(package.build.scripts)  # people start them by hand
    found = {path for path in candidates - loose - scripts if used and is_unstarted(package.project, path)}
    if not candidates & loose:
        return frozenset(found)
    started = started_programs(package)
    loose = {path for path in loose if basename(path) not in started}
    by_name: dict[str, list[str]] = {}
    for path in loose:
        by_name.setdefault(_name_of(path), []).append(path)
    imports = {path: frozenset(_imported(package, path, by_name)) for path in python}
    reached = reached_from(python - loose, imports)
    return frozenset(found | ((candidates & loose) - reached))


def _is_loose(package: ProjectPackage, path: str) -> bool:
    """Whether the file of *package* lies aside, or in no package that its setup.py names."""
    if not path.startswith(package.inside("")):
        return False
    inner = path[len(package.inside("")) :]
    if is_archived(inner) or any(_ASIDE.fullmatch(part) for part in inner.split("/")[:-1]):
        return True
    if path in package.build.scripts:
        return False
    named = {name for name, _ in package.build.python_packages}
    roots = dict(package.build.python_roots)
    if not named or not roots or "launch" in inner:
        return False
    for name in named:
        top, _, rest = name.partition(".")
        root = roots.get(top, roots.get("", ""))
        inside = (
            f"{root}/{name.replace('.', '/')}" if top not in roots else f"{root}/{rest.replace('.', '/')}".rstrip("/")
        )
        if dirname(path) == inside.removeprefix("./").removeprefix("/"):
            return False
    return any(path.startswith(f"{root}/") for root in roots.values() if root != ".")


def _imported(package: ProjectPackage, path: str, by_name: Mapping[str, list[str]]) -> Iterator[str]:
    """The files of *by_name* that the file at *path* imports: from its own directory, or with the name of theirs."""
    words = imported_words(package.project.text(path))
    for word in words & by_name.keys():
        for item in by_name[word]:
            folder = dirname(dirname(item) if basename(item) == "__init__.py" else item)
            if item != path and (folder in (dirname(path), package.path, "") or basename(folder) in words):
                yield item


def _name_of(path: str) -> str:
    return basename(dirname(path)) if basename(path) == "__init__.py" else splitext(basename(path))[0]
