# SPDX-License-Identifier: Apache-2.0
"""The profile of the checks alone runs no linter, whatever the project file selects beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.settings import PathPolicy, Policy, Settings
from haros_ci.pipeline import lint_options
from haros_ci.registry import built_in

SELECTS = Policy(select=("cpplint:runtime/int",))
SELECTS_CHECKS = Policy(select=("global-name", "haros-ci:self-loop"))


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"policy": SELECTS},
        {"per_path": (PathPolicy(globs=("a",), policy=SELECTS),)},
        {"command_line": SELECTS_CHECKS},
    ],
)
def test_no_linter_runs(more: dict[str, object]) -> None:
    settings = Settings(root=Path("/ws"), profile="architecture", **more)  # type: ignore[arg-type]
    assert lint_options(settings, built_in()).disabled == frozenset(built_in().adapters)


@pytest.mark.parametrize(
    "more",
    [
        {"profile": "ros"},
        {"profile": "all"},
        {"profile": "architecture", "command_line": SELECTS},
        {"profile": "architecture", "command_line": Policy(select=("global-name", "pylint"))},
        {"profile": "architecture", "per_path": (PathPolicy(globs=("a",), policy=Policy(), profile="strict"),)},
    ],
)
def test_linters_run(more: dict[str, object]) -> None:
    assert lint_options(Settings(root=Path("/ws"), **more), built_in()).disabled == frozenset()  # type: ignore[arg-type]
