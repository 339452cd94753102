# SPDX-License-Identifier: Apache-2.0
"""A workspace has one model: with facts just read and from the cache, followed and kept, with one process and with two."""

from __future__ import annotations

from pathlib import Path

import pytest
from bench.one_truth import differences, ways

from haros_ci.analysis.architecture import programs
from haros_ci.workspace.build import builds
from haros_ci.workspace.cache import DiskCache
from haros_ci.workspace.discover import discover

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
WORKSPACES = sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())


@pytest.mark.parametrize("name", WORKSPACES)
def test_the_model_is_the_same_however_it_comes_about(name: str, tmp_path: Path) -> None:
    (first, expected), *others = ways(EXAMPLES / name, tmp_path)
    assert len(others) >= 7
    for way, found in others:
        assert found == expected, f"{way} is not as {first}:\n" + "\n".join(differences(expected, found))


@pytest.mark.parametrize("name", WORKSPACES)
def test_facts_just_read_are_equal_to_those_of_the_cache(name: str, tmp_path: Path) -> None:
    workspace = discover(EXAMPLES / name, ())
    built = builds(workspace)
    cache = DiskCache(tmp_path)
    read = programs(workspace, built, cache, [], 2)
    assert cache.flush() is None
    again = DiskCache(tmp_path)
    kept = programs(workspace, built, again, [])
    assert again.stats.misses == 0
    assert [each.program for each in kept] == [each.program for each in read]
    assert [repr(each.program) for each in kept] == [repr(each.program) for each in read]
    assert {hash(each.program) for each in kept} == {hash(each.program) for each in read}
