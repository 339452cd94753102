# SPDX-License-Identifier: Apache-2.0
"""Where files for a while go: to memory if they are few, and nobody names another place."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from haros_ci import scratch
from haros_ci.scratch import IN_MEMORY, place_in_memory, scratch_directory


@pytest.fixture
def memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A directory in place of /dev/shm, with much room."""
    monkeypatch.setattr(scratch, "MEMORY", str(tmp_path))
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.delenv(name, raising=False)
    return str(tmp_path)


def test_a_small_workspace_goes_to_memory(memory: str) -> None:
    assert place_in_memory(1 << 20) == memory
    with scratch_directory("x-", place_in_memory(1 << 20)) as made:
        assert made.parent == Path(memory).resolve() and made.stat().st_mode & 0o777 == 0o700
    assert os.listdir(memory) == []


def test_a_large_one_does_not(memory: str) -> None:
    assert place_in_memory(IN_MEMORY + 1) is None


@pytest.mark.parametrize("name", ["TMPDIR", "TEMP", "TMP"])
def test_the_user_names_another_place(name: str, memory: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(name, "/var/tmp")
    assert place_in_memory(1) is None


def test_there_is_none(memory: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scratch, "MEMORY", f"{memory}/none")
    assert place_in_memory(1) is None


def test_it_is_nearly_full(memory: str, monkeypatch: pytest.MonkeyPatch) -> None:
    free = os.statvfs(memory)
    few = os.statvfs_result((*free[:4], (20 << 20) // free.f_frsize, *free[5:10]))
    monkeypatch.setattr(os, "statvfs", lambda path: few)
    assert place_in_memory(1 << 20) == memory and place_in_memory(2 << 20) is None


def test_it_may_not_be_written(memory: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    assert place_in_memory(1) is None
