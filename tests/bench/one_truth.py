# SPDX-License-Identifier: Apache-2.0
"""Whether a workspace has one model, however it comes about: ``python tests/bench/one_truth.py CHECKOUT...``

The facts of its files are read afresh, or come from the cache; what was followed is kept from the last run, or is not; one process or two
do the work. The model as JSON has to be the same bytes each time. Exit code 1 where it is not, with the first lines that differ.
"""

from __future__ import annotations

import gc
import resource
import sys
from collections.abc import Iterator
from itertools import islice, zip_longest
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.workspace import Store
from haros_ci.report.model_json import render
from haros_ci.workspace.cache import DiskCache, MemoryCache
from haros_ci.workspace.discover import discover

SHOWN = 5


class FactsOnly:
    """A store that has the facts of files, and never what was followed."""

    def __init__(self, store: Store) -> None:
        self._store = store

    def get(self, group: str, path: str, key: str) -> object | None:
        return None if group == "linked" else self._store.get(group, path, key)

    def put(self, group: str, path: str, key: str, value: object) -> None:
        if group != "linked":
            self._store.put(group, path, key, value)

    def get_text(self, group: str, path: str, key: str) -> str | None:
        return self._store.get_text(group, path, key)

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self._store.put_text(group, path, key, text)


def model(root: Path, store: Any, processes: int) -> str:
    """The model as ``haros-ci model --format json`` has it, problems included."""
    settings = Settings(root=root)
    found = architecture(discover(root, ()), settings, store, environment={}, processes=processes)
    return render(found)


def ways(root: Path, directory: Path) -> Iterator[tuple[str, str]]:
    """The model by each way to it, with a name for the way."""
    yield "cold, one process", model(root, MemoryCache(), 1)
    yield "cold, two processes", model(root, MemoryCache(), 2)
    cache = DiskCache(directory)
    yield "cold, with a cache", model(root, FactsOnly(cache), 2)
    cache.flush()
    for processes in (1, 2):
        yield f"facts from the cache, {processes} at once", model(root, FactsOnly(DiskCache(directory)), processes)
    cache = DiskCache(directory)
    yield "first followed", model(root, cache, 2)
    cache.flush()
    for processes in (1, 2):
        yield f"all from the cache, {processes} at once", model(root, DiskCache(directory), processes)


def differences(one: str, other: str) -> Iterator[str]:
    """The lines that differ, before and after."""
    for number, (before, after) in enumerate(zip_longest(one.splitlines(), other.splitlines(), fillvalue=""), start=1):
        if before != after:
            yield f"  line {number}\n    {before[:200]}\n    {after[:200]}"


def main(arguments: list[str]) -> int:
    gc.disable()
    code = 0
    for name in arguments:
        root = Path(name).resolve()
        first: str | None = None
        with TemporaryDirectory() as directory:
            start = used()
            for way, found in ways(root, Path(directory)):
                seconds, start = used() - start, used()
                if first is None:
                    first = found
                is_same = found == first
                print(
                    f"{name}: {way}: {len(found)} characters, {'the same' if is_same else 'OTHER'}, {seconds:.1f} s",
                    flush=True,
                )
                if not is_same:
                    code = 1
                    print("\n".join(islice(differences(first, found), SHOWN)))
    return code


def used() -> float:
    """CPU seconds of this process and of those that it has started."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime for each in both)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
