# SPDX-License-Identifier: Apache-2.0
"""Whole projects of others that lie beside a workspace's packages: a library, a SLAM system, the driver of a device.

They have no package.xml, so that no manifest says whose they are. Their licence does, or the first comments of their files.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

from haros_ci.model.copyright_owners import owner_lines, owners_of, words
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.workspace.generated import leading_comment
from haros_ci.workspace.selection import parents
from haros_ci.workspace.single_copies import OF_ROS
from haros_ci.workspace.third_party import is_licence

#: Characters of a licence or a file that are looked at for owners.
_MOST = 8_192
#: Files of a directory, and of the packages, whose first comments are looked at.
_MOST_FILES = 200
#: Of so many files of such a project one may use ROS: an example.
_FEW = 10
#: What a project has at its top, beside its licence.
_TOP = regex(
    r"readme(?:[._-]\w{1,10}){0,2}|cmakelists\.txt|setup\.py|pyproject\.toml|makefile|configure(?:\.ac)?",
    re.IGNORECASE,
)
#: Where a Python project says who writes it, and how.
_MANIFESTS = ("setup.py", "setup.cfg", "pyproject.toml")
_AUTHOR = regex(r"\bauthors?\b[ \t]*=[ \t\[{(]*(?:name[ \t]*=[ \t]*)?([^\n]{1,200})")
#: Who owns the texts of licences, and what templates of licences have in the place of an owner.
_OF_LICENCES = regex(r"\s*(?:(?:the )?(?:free|apache) software foundation|[\[{]|your? )", re.IGNORECASE)


def foreign_projects(workspace: Workspace, people: Mapping[str, frozenset[str]]) -> frozenset[str]:
    """The outermost directories beside the packages of *workspace* that hold a whole project of somebody else.

    Such a directory has a licence, and a README or a file of a build, at its top, and no package in it or around it. Hardly anything in it
    uses ROS. Its owner, as the licence says, or else the first comments of its code, is named by no manifest (*people* are theirs, by the
    directory of the package), by no licence around it, and by no first comment of the packages' code. Where manifests name nobody there is none,
    nor where a manifest of Python at its top names somebody else than its owner as the author.
    """
    licences = _licences(workspace) if any(people.values()) else {}
    inside: dict[str, list[SourceFile]] = {directory: [] for directory in _candidates(workspace, licences)}
    for file in workspace.files if inside else ():
        if _is_code(file):
            for outer in parents(file.path):
                if outer in inside:
                    inside[outer].append(file)
    own = _own_words(workspace, people) if inside else frozenset()
    found: set[str] = set()
    for directory, files in inside.items():
        owners = _named(_texts(workspace, licences[directory])) or _named(_heads(workspace, files))
        above = (name for outer in (*parents(directory), "") for name in licences.get(outer, ()))
        if files and owners and owners.isdisjoint(own | _named(_texts(workspace, above))):
            if not _is_of_ros(workspace, files) and not _is_by_another(workspace, directory, owners):
                found.add(directory)
    return frozenset(found)


def _licences(workspace: Workspace) -> dict[str, list[str]]:
    """The licences of the workspace, by their directories."""
    found: dict[str, list[str]] = {}
    for name in sorted(workspace.names):
        if is_licence(posixpath.basename(name)):
            found.setdefault(posixpath.dirname(name), []).append(name)
    return found


def _candidates(workspace: Workspace, licences: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """The outermost directories with *licences* outside of packages and without any, that have what else a project has at its top."""
    packages = {package.path for package in workspace.packages}
    if "." in packages or not licences:
        return
    taken = packages | {directory for package in packages for directory in parents(package)}
    tops = {posixpath.dirname(name) for name in workspace.names if _TOP.fullmatch(posixpath.basename(name))}
    found: set[str] = set()
    for directory in sorted(licences.keys() & tops - taken - {""}):
        if not any(outer in packages or outer in found for outer in parents(directory)):
            found.add(directory)
            yield directory


def _named(texts: Iterable[str]) -> frozenset[str]:
    """The words of the owners that *texts* name in their copyright lines, without those of licences themselves."""
    found: set[str] = set()
    for text in texts:
        found |= owners_of(line for line in owner_lines(text) if _OF_LICENCES.match(line) is None)
    return frozenset(found)


def _own_words(workspace: Workspace, people: Mapping[str, frozenset[str]]) -> frozenset[str]:
    """The words of whoever has a part in the packages: in manifests, and in first comments."""
    found = {word for named in people.values() for text in named for word in words(text)}
    return frozenset(found | _named(_heads(workspace, (file for file in workspace.files if file.package is not None))))


def _texts(workspace: Workspace, names: Iterable[str]) -> Iterator[str]:
    return (workspace.text(name)[:_MOST] for name in names)


def _heads(workspace: Workspace, files: Iterable[SourceFile]) -> Iterator[str]:
    """The first comments of the first of *files* that are code."""
    for file in islice(filter(_is_code, files), _MOST_FILES):
        yield leading_comment(file.language, workspace.text(file.path)[:_MOST].encode("utf-8", "replace"))


def _is_by_another(workspace: Workspace, directory: str, owners: frozenset[str]) -> bool:
    """Whether a manifest of Python at the top of *directory* names an author who is none of its *owners*: somebody goes on with their work."""
    for name in _MANIFESTS:
        author = _AUTHOR.search(workspace.text(f"{directory}/{name}"))
        if author is not None and words(author[1]) and owners.isdisjoint(words(author[1])):
            return True
    return False


def _is_of_ros(workspace: Workspace, files: Sequence[SourceFile]) -> bool:
    using = sum(OF_ROS.search(workspace.text(file.path)) is not None for file in files)
    return using * _FEW > len(files)


def _is_code(file: SourceFile) -> bool:
    return file.language in ("cpp", "python") and not file.third_party
