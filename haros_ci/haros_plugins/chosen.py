# SPDX-License-Identifier: Apache-2.0
"""Which plug-ins of HAROS run: those named, or all that are installed, through HAROS's white and black lists."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from pkgutil import iter_modules

from haros_ci.errors import UserError
from haros_ci.haros_plugins.manifest import PREFIX, HarosPlugin, read
from haros_ci.plugins.place import keep_workspace_out

#: Instead of a name: every plug-in that is installed.
EVERY = f"{PREFIX}*"


@cache
def chosen(
    names: tuple[str, ...], white: tuple[str, ...], black: tuple[str, ...], root: Path
) -> tuple[HarosPlugin, ...]:
    """The plug-ins in order of their names; UserError for one that is named and cannot be had.

    *names* are of modules; with ``haros_plugin_*`` among them, or a whitelist, it is all that are installed. Of those the *white* list
    keeps only its own; else the *black* list takes away. In both the prefix may be missing.
    """
    named = {name for name in names if name != EVERY}
    white, black = tuple(map(_whole, white)), tuple(map(_whole, black))
    selected = set(named)
    if white or EVERY in names:
        found = installed(root)
        lost = sorted(set(white) - found)
        if lost:
            raise UserError(
                f"plug-in {lost[0]}: on the whitelist, and not installed", help="install it where haros-ci is installed"
            )
        if EVERY in names and not found:
            raise UserError(f"plug-in {EVERY}: none is installed", help="install them where haros-ci is installed")
        selected |= found & set(white) if white else found - set(black)
    if not white:
        selected -= set(black)
    return tuple(read(name, root) for name in sorted(selected))


def installed(root: Path) -> set[str]:
    """The names of all plug-ins that could be imported, the workspace at *root* left out."""
    keep_workspace_out(root)
    return {module.name for module in iter_modules(sys.path) if module.name.startswith(PREFIX)}


def is_of_haros(name: str) -> bool:
    """Whether *name* is that of a plug-in of HAROS, or stands for all of them."""
    return name.startswith(PREFIX)


def _whole(name: str) -> str:
    return name if name.startswith(PREFIX) else f"{PREFIX}{name}"


def split(names: Iterable[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Plug-ins of our own API, and those of HAROS."""
    names = tuple(names)
    return tuple(n for n in names if not is_of_haros(n)), tuple(n for n in names if is_of_haros(n))
