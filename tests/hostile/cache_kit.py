# SPDX-License-Identifier: Apache-2.0
"""Ways to plant a cache, for the tests of it."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hostile_kit import Trap

UNWRITTEN = "warning: the cache cannot be written ("
EVIL = "\x1b[31m\n::error::planted##[error]<img src=x>@team ![x](http://x) [a](b) \u202e\ud800"


@dataclass(frozen=True)
class Case:
    """A cache directory or its contents, set up in *plant*; *says* stands on stderr, which is else empty."""

    name: str
    plant: Callable[[Trap], object]
    says: str = ""
    arguments: tuple[str, ...] = ()


def located(place: Callable[[Trap], Path]) -> Callable[[Trap], None]:
    def plant(t: Trap) -> None:
        t.cache = place(t)

    return plant


def linked(place: Callable[[Trap], Path], target: Callable[[Trap], Path | str]) -> Callable[[Trap], None]:
    """The cache directory is *place*, a link to *target*."""

    def plant(t: Trap) -> None:
        t.cache = place(t)
        t.cache.symlink_to(target(t))

    return plant


def each(spoil: Callable[[Trap, Path], object]) -> Callable[[Trap], None]:
    """A cache that was filled by a run; then every file of it is taken away and *spoil* puts something in its place."""

    def plant(t: Trap) -> None:
        t.use_filled_cache()
        for shard in sorted(t.cache.iterdir()):
            shard.unlink()
            spoil(t, shard)

    return plant


def shards(content: str | bytes) -> Callable[[Trap], None]:
    return each(lambda t, shard: shard.write_bytes(content if isinstance(content, bytes) else content.encode()))


def entries(text: str) -> Callable[[Trap], None]:
    return shards(f'{{"format": 1, "run": 1, "entries": {{{text}}}}}')


def doctored(change: Callable[[Any], object], group: str = "") -> Callable[[Trap], None]:
    """A cache whose every value of the *group* was changed in a way that leaves its keys right."""

    def plant(t: Trap) -> None:
        t.use_filled_cache()
        for shard in t.cache.glob(f"{group}*"):
            document = json.loads(shard.read_bytes())
            document["entries"] = {key: [run, change(value)] for key, (run, value) in document["entries"].items()}
            shard.write_text(json.dumps(document))

    return plant


def included(names: object) -> Callable[[Trap], None]:
    return doctored(lambda value: dict.fromkeys(value, names), "includes")


def truncated(t: Trap) -> None:
    t.use_filled_cache()
    for shard in t.cache.iterdir():
        os.truncate(shard, shard.stat().st_size // 2)


def sparse(size: int) -> Callable[[Trap, Path], None]:
    def spoil(t: Trap, shard: Path) -> None:
        shard.touch()
        os.truncate(shard, size)

    return spoil


def crowded(t: Trap) -> None:
    """Beside the shards lies a file of 4 TB that is named like one: over the cap, every shard is trimmed."""
    t.use_filled_cache()
    sparse(1 << 42)(t, t.cache / "zzz-0.json")


def directory(t: Trap, shard: Path) -> None:
    shard.mkdir()
    (shard / "x").touch()


def listening(t: Trap, shard: Path) -> None:
    here = os.open(shard.parent, os.O_RDONLY)  # the whole path can be too long for a socket
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(f"/proc/self/fd/{here}/{shard.name}")
    os.close(here)


class Payload:
    def __init__(self, command: str) -> None:
        self.command = command

    def __reduce__(self) -> tuple[Callable[[str], int], tuple[str]]:
        return os.system, (self.command,)


def programs(t: Trap) -> None:
    """What would run if the cache directory got on a search path."""
    t.use_filled_cache()
    for name in ("git", "cppcheck", "python3", "sh", "env"):
        (t.cache / name).write_text(f"#!/bin/sh\n{t.touch(name)}\n")
        (t.cache / name).chmod(0o755)
    for name in ("sitecustomize.py", "json.py", "haros_ci.py", "conftest.py", "__init__.py", ".new-x.py"):
        (t.cache / name).write_text(t.python(name))
    (t.cache / "x.pth").write_text(f"import os; {t.python('pth')}")
