# SPDX-License-Identifier: Apache-2.0
"""Measuring while the systems are made: the same values, and nothing where nobody wants them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from commandline import write

from haros_ci.analysis.architectures import Architectures
from haros_ci.config.settings import Settings
from haros_ci.measuring.ahead import measured_meanwhile
from haros_ci.measuring.measures import measure
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

FILES = {
    "one/package.xml": "<package format='3'><name>one</name></package>",
    "one/a.cpp": "struct A { int f(int x) { return x ? 1 : 2; } };\n",
    "one/b.py": "def g(x):\n    return h(x) if x else 0\n",
}


@pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")
def test_what_is_measured_meanwhile_is_what_is_measured_afterwards(tmp_path: Path) -> None:
    workspace = discover(write(tmp_path, FILES), ())
    settings = Settings(root=tmp_path, jobs=2, is_measured=True)
    store = MemoryCache()
    made = Architectures(settings, store)
    with measured_meanwhile(workspace, made, is_head=True):
        made.of(workspace)
    store.stats.misses = 0
    found = measure(workspace, settings, store, sources=made.of(workspace).sources)
    assert store.stats.misses == 0
    assert found == measure(workspace, settings, MemoryCache()) and found.values and not found.failed


@pytest.mark.parametrize(
    ("change", "is_head", "is_made"),
    [
        ({"is_measured": False}, True, True),
        ({"jobs": 1}, True, True),
        ({}, False, True),
        ({}, True, False),
    ],
    ids=["no output wants values", "one process", "the base revision", "the systems are known"],
)
def test_nothing_is_measured(tmp_path: Path, change: dict[str, object], is_head: bool, is_made: bool) -> None:
    workspace = discover(write(tmp_path, FILES), ())
    store = MemoryCache()
    made = Architectures(Settings(root=tmp_path, **{"jobs": 2, "is_measured": True, **change}), store)  # type: ignore[arg-type]
    with measured_meanwhile(workspace, made, is_head=is_head):
        if is_made:
            made.of(workspace)
    assert not [group for group, _, _ in store._values if group.startswith("measured-") or group.endswith(" values")]
