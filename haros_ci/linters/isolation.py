# SPDX-License-Identifier: Apache-2.0
"""Starts a Python tool so that it can import nothing from the directories it looks at.

Run as a script in isolated mode: ``isolation.py DIRECTORY [--trusted] MODULE ARGUMENTS``. pylint puts the directories of the files
it checks at the head of sys.path and resolves names with the real import system; without this, ``import curses.x`` in a
checked file would execute a ``curses/__init__.py`` that lies beside it. ``--trusted`` is for users who trust the
workspace's configuration, whose plug-ins may lie in it.
"""

from __future__ import annotations

import atexit
import errno
import gc
import os
import runpy
import stat
import sys
from collections.abc import Iterable, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any


class TrustedFinder:
    """PathFinder over the directories that were on sys.path at the start, whatever is put there later."""

    trusted: tuple[str, ...] = ()

    @classmethod
    def find_spec(
        cls, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if path is None:
            return PathFinder.find_spec(name, cls.trusted, target)
        inside = [p for p in path if any(p == root or p.startswith(root + os.sep) for root in cls.trusted)]
        return PathFinder.find_spec(name, inside, target) if inside else None

    @classmethod
    def find_distributions(cls, context: Any = None) -> Iterable[Any]:
        """What importlib.metadata asks of finders; some modules look for their own version when they are imported."""
        from importlib.metadata import DistributionFinder

        selection = {"name": context.name} if context is not None else {}
        return PathFinder.find_distributions(DistributionFinder.Context(path=list(cls.trusted), **selection))

    @staticmethod
    def invalidate_caches() -> None:
        PathFinder.invalidate_caches()


def trust_only_the_present_path() -> None:
    """From here on, imports come from today's sys.path alone."""
    TrustedFinder.trusted = tuple(sys.path)
    finders: list[object] = sys.meta_path  # type: ignore[assignment]  # a protocol in typeshed
    finders[:] = [TrustedFinder if finder is PathFinder else finder for finder in finders]


def refuse_pipes() -> None:
    """A named pipe where a module is looked for would block the whole batch: opening one fails instead."""

    def hook(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open" and isinstance(arguments[0], (str, bytes)):
            try:
                mode = os.stat(arguments[0]).st_mode
            except OSError:
                return
            if stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode):
                raise OSError(errno.EINVAL, "not a regular file", arguments[0])

    sys.addaudithook(hook)


def refuse_ways_out() -> None:
    """Opening what lies by its name below the current directory, and by the symbolic links on the way elsewhere, fails.

    What lies where today's imports come from does not count.
    """
    root, ours = os.getcwd(), (*sys.path, sys.prefix)

    def hook(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open" and isinstance(arguments[0], (str, bytes)):
            name = os.path.abspath(os.fsdecode(arguments[0]))
            if not is_below(name, root) or any(is_below(name, place) for place in ours):
                return
            if not is_below(os.path.realpath(name), root):
                raise OSError(errno.EACCES, "a link that leads out of the workspace", arguments[0])

    sys.addaudithook(hook)


def is_below(path: str, directory: str) -> bool:
    """Whether an absolute *path* is *directory* or lies below it."""
    return path == directory or path.startswith(directory.rstrip(os.sep) + os.sep)


def without_collector() -> None:
    """Switch the garbage collector off for the rest of the process, and for its end, as commands/collector.py, which cannot be imported here.

    pylint keeps the trees of all modules that it has read, and the collector goes through them again and again: a third of the time, for a
    tenth of the memory. How many files a process reads is bounded (schedule.BATCH_FILES), and so is its memory (process.MEMORY_LIMIT).
    """
    gc.disable()
    atexit.register(gc.freeze)  # the interpreter collects once more while it ends, whether the collector is on or not


def main() -> None:
    without_collector()
    _, directory, module, *arguments = sys.argv
    if directory not in sys.path:
        sys.path.append(directory)
    if module == "--trusted":
        module, *arguments = arguments
    else:
        trust_only_the_present_path()
        refuse_ways_out()
    refuse_pipes()
    sys.argv = [module, *arguments]
    runpy.run_module(module, run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
