# SPDX-License-Identifier: Apache-2.0
"""Traps for every hostile test, and the cache that they share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from hostile_kit import Outcome, Trap


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """It keeps runs short: the control file, which is always the same, is analysed once."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def trap(request: pytest.FixtureRequest, tmp_path: Path, cache: Path) -> Trap:
    """A module that says AFRESH looks at what is loaded, so its runs load all."""
    return Trap(tmp_path, cache, afresh=hasattr(request.module, "AFRESH"))


@pytest.fixture(scope="module")
def new_trap(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, cache: Path
) -> Callable[[], Trap]:
    """Makes a trap that several tests look at."""
    return lambda: Trap(tmp_path_factory.mktemp("trap"), cache, afresh=hasattr(request.module, "AFRESH"))


@pytest.fixture(scope="module")
def uncached(new_trap: Callable[[], Trap]) -> Outcome:
    """What is reported of the control without any cache."""
    trap = new_trap()
    trap.use_cheap_control()
    return trap.run("--no-cache")
