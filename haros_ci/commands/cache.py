# SPDX-License-Identifier: Apache-2.0
"""``haros-ci cache``: where it lies, how large it is, and clearing it."""

from __future__ import annotations

from pathlib import Path

import click

from haros_ci.commands.common import cache_dir
from haros_ci.workspace.cache import DiskCache


def cache(action: str, directory: str | None) -> int:
    """``haros-ci cache dir|stats|clear``."""
    place = cache_dir({"cache_dir": directory}, Path.cwd())
    assert place is not None
    match action:
        case "dir":
            click.echo(place)
        case "stats":
            click.echo(f"{place}: {DiskCache(place).size() / 1e6:.1f} MB")
        case _:
            DiskCache(place).clear()
    return 0
