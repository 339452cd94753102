# SPDX-License-Identifier: Apache-2.0
"""Which directory the paths of a run are relative to."""

from __future__ import annotations

import os
from pathlib import Path

from haros_ci.errors import UserError
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """``root`` is what every path in the output is relative to; ``paths`` are the arguments, POSIX-style, relative to
    it; the search for a project file begins at ``start`` and ends at ``root``.
    """

    root: Path
    paths: tuple[str, ...]
    start: Path


def locate(arguments: tuple[str, ...], cwd: Path, *, may_be_new: bool = False) -> Place:
    """The place of a run on *arguments* (none: *cwd*).

    GitHub wants paths relative to the repository, so the root is the git work tree that holds all arguments; outside
    git it is *cwd* if that holds them, else the directory above all that is named. Symbolic links are resolved; UserError
    for one that leads out of the work tree, or a file out of *cwd*: a change could bring it along; and for a path that does not
    exist, unless it *may_be_new*.
    """
    here = Path(os.path.realpath(cwd))
    tree = work_tree(here)
    named = [_real(argument, here, tree, may_be_new) for argument in arguments or (".",)]
    above = Path(os.path.commonpath(named))
    if not above.is_dir():
        above = above.parent
    root = work_tree(above) or (here if above.is_relative_to(here) else above)
    return Place(root, tuple(path.relative_to(root).as_posix() for path in named), above)


def _real(argument: str, here: Path, tree: Path | None, may_be_new: bool) -> Path:
    """Where *argument* leads to; *tree* is the work tree that *here* lies in."""
    path = Path(os.path.realpath(here / argument))
    if not may_be_new and not path.exists():
        raise UserError(f"{argument}: no such file or directory", help="name files or directories of the workspace")
    inside = Path(os.path.abspath(here / argument)).is_relative_to(tree or here)
    if inside and not path.is_relative_to(tree or here) and (tree is not None or not path.is_dir()):
        raise UserError(
            f"{argument}: a symbolic link out of the workspace", help="name what it leads to if you mean it"
        )
    return path


def work_tree(directory: Path) -> Path | None:
    """The top of the git work tree that *directory* lies in, found without a process; None outside git."""
    for candidate in (directory, *directory.parents):
        if (candidate / ".git").exists():
            return candidate
    return None
