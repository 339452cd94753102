# SPDX-License-Identifier: Apache-2.0
"""What shows that a launch file is kept for distributions up to ROS 2 Foxy: its path, and what the pages above it say."""

from __future__ import annotations

import ast
import re
from functools import lru_cache

from haros_ci.checking.branches import Span, is_in, parsed
from haros_ci.checking.system import System
from haros_ci.model.location import Location
from haros_ci.regex import regex

_NAMES = r"(?:ardent|bouncy|crystal|dashing|elo?quent|elequent|foxy)"
#: A file or directory that is called after one is not for a later one, and neither is one that is called old.
_PATH = regex(
    rf"(?:^|[/_.-])(?:{_NAMES}|old|legacy|deprecated|obsolete|archived?|pre_?galactic)(?=$|[/_.-])", re.IGNORECASE
)
_OLD = regex(rf"\b{_NAMES}\b|\bold(?:er)? (?:ros ?2? )?(?:version|release|distribution|distro)s?\b", re.IGNORECASE)
_NEW_NAMES = r"(?:galactic|humble|iron|jazzy|kilted|lyrical|rolling)"
_NEW = regex(rf"\b{_NEW_NAMES}\b", re.IGNORECASE)
#: A branch for a later distribution; it may be called after it.
_BRANCH = regex(r"\bbranch|\bcheckout\b|\s-b\s|/tree/", re.IGNORECASE)
_PAGE = regex(r"(?:readme[^/]*|dockerfile[^/]*|\.travis\.yml|\.gitlab-ci\.yml|\.github/workflows/[^/]+\.ya?ml)", re.I)
#: Of one page so much is read.
_MAX = 200_000


def is_called_old(path: str) -> bool:
    """Whether the name of the file or of a directory above it is that of a distribution up to Foxy, or says that it is old."""
    return _PATH.search(path) is not None


def told_of(path: str, system: System) -> str:
    """What the README files, Dockerfiles and workflows beside and above the file at *path* say of the distributions it is for.

    ``file``: one has the file's name in a line with an old distribution and no later one. ``branch``: one speaks of old distributions and
    tells to take another branch for a later one. ``old``: they name old distributions alone. "" if they say none of these.
    """
    workspace = system.workspace
    if workspace is None:
        return ""
    pages = [workspace.text(page)[:_MAX] for page in _pages(path, frozenset(workspace.names))]
    name = path.rpartition("/")[2]
    lines = [line for page in pages for line in page.splitlines()]
    if any(name in line and _OLD.search(line) and not _NEW.search(line) for line in lines):
        return "file"
    is_old = any(_OLD.search(page) for page in pages)
    if is_old and any(_NEW.search(line) and _BRANCH.search(line) for line in lines):
        return "branch"
    return "old" if is_old and not any(_NEW.search(page) for page in pages) else ""


def is_tried(text: str, location: Location) -> bool:
    """Whether the line of *location* in the Python file *text* is in a ``try`` with a handler, or in the handler: the other one is the other way."""
    return is_in(_tries(text), location)


@lru_cache(maxsize=64)
def _tries(text: str) -> tuple[Span, ...]:
    tree = parsed(text) if "except" in text else None
    if tree is None:
        return ()
    tries = (node for node in ast.walk(tree) if isinstance(node, ast.Try) and node.handlers)
    return tuple((node.lineno, node.end_lineno or node.lineno) for node in tries)


@lru_cache(maxsize=256)
def _pages(path: str, names: frozenset[str]) -> tuple[str, ...]:
    parts = path.split("/")[:-1]
    above = {"/".join(parts[:depth]) for depth in range(len(parts) + 1)}
    found = []
    for name in names:
        folder, _, base = name.rpartition("/")
        if folder.endswith(".github/workflows"):
            folder, base = folder.removesuffix(".github/workflows").rstrip("/"), f".github/workflows/{base}"
        if folder in above and _PAGE.fullmatch(base):
            found.append(name)
    return tuple(sorted(found))
