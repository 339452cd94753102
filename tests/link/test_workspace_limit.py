# SPDX-License-Identifier: Apache-2.0
"""The limit of steps for all programs of a workspace: what is beyond is named, and is the same however the model comes about."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from bench.one_truth import differences, model, ways

from haros_ci.systems import work
from haros_ci.workspace.cache import DiskCache, MemoryCache

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
WORKSPACES = sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())


def left_out(text: str) -> set[str]:
    """The nodes of a model that were left out, by configuration and name."""
    return {
        f"{configuration['name']} {node['name']}"
        for configuration in json.loads(text)["configurations"]
        for node in configuration["nodes"]
        if any(unknown["reason"] == work.TOO_MUCH for unknown in node["unknowns"])
    }


@pytest.mark.parametrize("limit", [0, 30, 60, 150])
@pytest.mark.parametrize("name", WORKSPACES)
def test_the_model_is_the_same_however_it_comes_about(
    name: str, limit: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(work, "OF_ALL", limit)
    (first, expected), *others = ways(EXAMPLES / name, tmp_path)
    for way, found in others:
        assert found == expected, f"{way} is not as {first}:\n" + "\n".join(differences(expected, found))


@pytest.mark.parametrize("name", WORKSPACES)
def test_more_steps_leave_fewer_nodes_out(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = model(EXAMPLES / name, MemoryCache(), 1)
    assert not left_out(whole)
    before: set[str] | None = None
    for limit in (0, 30, 60, 150, 3000):
        monkeypatch.setattr(work, "OF_ALL", limit)
        found = left_out(model(EXAMPLES / name, MemoryCache(), 1))
        assert before is None or found <= before
        before = found


def test_what_is_left_out_is_named_and_comes_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = EXAMPLES / "warehouse_ws"
    whole = model(root, DiskCache(tmp_path), 1)
    monkeypatch.setattr(work, "OF_ALL", 0)
    cache = DiskCache(tmp_path)
    cut = model(root, cache, 1)
    cache.flush()
    assert left_out(cut)
    assert [problem for problem in json.loads(cut)["problems"] if problem["message"] == work.TOO_MUCH]
    monkeypatch.undo()
    assert model(root, DiskCache(tmp_path), 2) == whole
