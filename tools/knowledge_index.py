# SPDX-License-Identifier: Apache-2.0
"""Which packages distributions have, where their sources are, and what they need: the rosdistro index and the overlay for Nix."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from knowledge_git import commit, git, paths, texts

#: All that rosdistro has, oldest first: the bits of the section ``packages``.
DISTRIBUTIONS = (
    "groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic",
    "ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic", "humble", "iron", "jazzy", "kilted", "lyrical", "rolling",
)  # fmt: skip

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_LIST = re.compile(r"\bpropagated(?:Native)?BuildInputs = \[([^\]]*)\]")
_NAME = re.compile(r"/(?:release|rpm|debian)/\w+/([\w-]+)/|pname = \"ros-\w+?-([\w-]+)\"")


@dataclass(slots=True)
class Source:
    """A repository of one distribution: ``owner/name`` on GitHub, the branch, and a name or two of its packages."""

    repository: str
    branch: str
    distribution: str
    packages: frozenset[str] = frozenset()


@dataclass(slots=True)
class Index:
    """*packages*: names with their distributions. *repositories*: names of repositories that are no package's."""

    packages: dict[str, set[str]] = field(default_factory=dict)
    repositories: set[str] = field(default_factory=set)
    sources: list[Source] = field(default_factory=list)


def read_yaml(clone: Path, path: str) -> Any:
    return yaml.load(git(clone, "show", f"HEAD:{path}"), Loader=_LOADER) or {}


def read_index(rosdistro: Path) -> Index:
    """Of all distribution files. A repository that is not released counts as a repository only."""
    found = Index()
    for distribution in DISTRIBUTIONS:
        table = read_yaml(rosdistro, f"{distribution}/distribution.yaml")
        for name, row in (table.get("repositories") or {}).items():
            release = row.get("release") or {}
            if release:
                for package in release.get("packages") or [name]:
                    found.packages.setdefault(package, set()).add(distribution)
            found.repositories.add(name)
            for part in ("source", "doc"):
                url = str((row.get(part) or {}).get("url", ""))
                match = re.match(r"(?:https?://|git@|git://)github\.com[/:]([^/]+/[^/]+?)(?:\.git)?/?$", url)
                if match:
                    branch = str(row[part].get("version", ""))
                    packages = frozenset(release.get("packages") or [name])
                    found.sources.append(Source(match[1].lower(), branch, distribution, packages))
                    break
    found.repositories -= set(found.packages)
    return found


def overlay_rows(overlay: Path) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """``(distribution, package, names)`` for each package that the overlay has or had: what it brings along."""
    for distribution in DISTRIBUTIONS:
        folder = f"distros/{distribution}"
        revision = commit(overlay, "HEAD")
        if not git(overlay, "ls-tree", revision, f"{folder}/"):
            gone = git(overlay, "log", "-1", "--format=%H", "--", folder).strip()
            revision = commit(overlay, f"{gone}~1") if gone else ""
        if not revision:
            continue
        files = {p: o for p, o in paths(overlay, revision, f"{folder}/").items() if p.endswith("/default.nix")}
        for text in texts(overlay, files.values()):
            match = _NAME.search(text)
            if match:
                names = [name for row in _LIST.findall(text) for name in row.split()]
                yield distribution, match[1] or match[2], tuple(names)
