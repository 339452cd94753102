# SPDX-License-Identifier: Apache-2.0
"""Packages of others that a team put into its repository whole and hardly touched: by the history of the checkout, and by what stands in and beside their manifests."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.workspace.imported import Imports, imports

#: Commits that change files of one of the other packages: a team works there.
WORKED_ON = 3
_WORD = regex(r"[^\W\d_]{2,}")
#: Words of names and addresses that anybody has.
_ANYBODY = frozenset("com org net edu gov mail gmail info dev the ros robot robotics support team user root".split())
#: Where anybody has an address.
_FREE = regex(
    r"(?:g(?:oogle)?mail|hotmail|outlook|live|yahoo|icloud|me|qq|163|126|foxmail|sina|aol|gmx|web|mail|naver|daum|hanmail|proton(?:mail)?|yandex|todo|users\.noreply\.github)"
    r"\.[\w.]{2,8}"
)
_SECOND = frozenset("ac co com edu gov go ne net or org".split())
_OWNER = regex(r"<url\b[^<>]{0,100}>\s*https?://(?:www\.)?(?:github|gitlab)\.com/([\w.-]{1,100})/")
#: A page of the package's own; templates name those of MoveIt.
_PAGE = regex(r"<url\b[^<>]{0,100}>\s*https?://(?![^<>\s]{0,100}moveit)[\w-]{1,100}\.[^<>\s]{2,300}\s*<")
_LICENCE = regex(r"(?:licen[cs]e|copying)(?:\.\w{2,4})?", re.IGNORECASE)
_README = regex(r"readme(?:[._-]\w{2,5}){0,2}", re.IGNORECASE)
#: What stands at the top of a repository besides, and of released packages.
_OF_RELEASES = regex(
    r"(?:changelog|contributing)(?:\.(?:rst|md))?|\.travis\.yml|\.github|\.gitlab-ci\.yml", re.IGNORECASE
)


def imported(
    workspace: Workspace, people: Mapping[str, frozenset[str]], manifest: Callable[[Package], str]
) -> Mapping[str, frozenset[str]]:
    """The directories of packages that have come in one commit, have hardly been changed since, and are by others than who commits, each with its changed files.

    Their manifests name *people* (by directory), none of whom, and nobody of whose organisation, has written a commit or is named by a package that has
    been changed more, and none of their pages is of an owner that such a package's page has; and one of them, or another of these packages that names
    one of the same people, names a page, or stands as a repository does: with its list of changes, or with a licence and a README. Some other
    package is worked on. Without history (none at all, a shallow clone, a very long one) there is none.
    """
    manifests = {package.path: manifest(package) for package in workspace.packages if package.path != "."}
    if len({people[path] for path in manifests} - {frozenset()}) < 2:
        return {}
    known = imports(Path(workspace.root), manifests)
    if not known.unchanged or max((known.changes.get(path, 0) for path in manifests), default=0) < WORKED_ON:
        return {}
    others = _by_others(known, people, manifests)
    sure = [path for path in others if _PAGE.search(manifests[path]) or _is_whole(path, others, workspace)]
    named = frozenset[str]().union(*(people[path] for path in sure))
    return {path: known.unchanged[path] for path in sorted(others) if not named.isdisjoint(people[path])}


def _by_others(known: Imports, people: Mapping[str, frozenset[str]], manifests: Mapping[str, str]) -> frozenset[str]:
    """The unchanged packages of which neither the people nor the owners of pages are of the team."""
    own = manifests.keys() - known.unchanged.keys()
    authors = frozenset(word.lower() for word in known.authors)
    team = frozenset[str]().union(*map(_marks, (authors, *(people[path] for path in own))))
    owners = frozenset(owner for path in own for owner in _owners(manifests[path]))
    return frozenset(
        path
        for path in manifests.keys() & known.unchanged.keys()
        if any(map(_is_somebody, people[path]))
        and team.isdisjoint(_marks(people[path]))
        and owners.isdisjoint(_owners(manifests[path]))
    )


def _is_somebody(word: str) -> bool:
    """Whether a name or address tells who somebody is: one word is the user of a computer, as wizards write it."""
    return "@" in word or len(_WORD.findall(word)) > 1


def _marks(words: Iterable[str]) -> frozenset[str]:
    """What tells who somebody is: the words of names and of the first parts of addresses, and where an address is, if not everybody has one there."""
    return frozenset(mark for word in words for mark in _of(word))


def _of(word: str) -> Iterator[str]:
    who, _, where = word.partition("@")
    parts = _WORD.findall(who)
    yield from (part for part in parts if len(part) > 2 and part not in _ANYBODY)
    if len(parts) == 2:  # "Eva Kant" is evakant and kanteva
        yield from (parts[0] + parts[1], parts[1] + parts[0])
    if where and not _FREE.fullmatch(where):
        labels = where.split(".")
        yield "@" + ".".join(labels[-3 if len(labels) > 2 and labels[-2] in _SECOND else -2 :])


def _owners(text: str) -> Iterator[str]:
    return (owner.lower() for owner in _OWNER.findall(text))


def _is_whole(directory: str, others: frozenset[str], workspace: Workspace) -> bool:
    """Whether *directory*, or one around it that has packages of *others* alone, is as the top of a repository."""
    while directory:
        inside = [package.path for package in workspace.packages if f"{package.path}/".startswith(f"{directory}/")]
        if not others.issuperset(inside):
            return False
        if _is_top({name[len(directory) + 1 :] for name in workspace.names if name.startswith(f"{directory}/")}):
            return True
        directory = directory.rpartition("/")[0]
    return False


def _is_top(names: Iterable[str]) -> bool:
    """Whether a directory with files of these *names* below it has what stands at the top of a repository."""
    here = {name.partition("/")[0] if name.startswith(".github/") else name for name in names}
    has = [any(map(pattern.fullmatch, here)) for pattern in (_OF_RELEASES, _LICENCE, _README)]
    return has[0] or (has[1] and has[2])
