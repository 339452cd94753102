# SPDX-License-Identifier: Apache-2.0
"""Which tests are slow: what starts processes, analyses workspaces or tries bounds; the rest is what a contributor runs first."""

from __future__ import annotations

import pytest
from tiers import TESTS, is_slow


@pytest.mark.parametrize(
    "path",
    [
        "test_command.py",
        "test_checks.py",
        "test_action.py",
        "hostile/test_hostile_git.py",
        "link/test_follow_python.py",
        "extract/cpp/test_cpp_broken.py",
        "monitor_files/test_ros1.py",
    ],
)
def test_slow(path: str) -> None:
    assert is_slow(TESTS / path)


@pytest.mark.parametrize(
    "path",
    [
        "test_lint.py",
        "test_versions.py",
        "results/test_subjects.py",
        "report/test_diff_report.py",
        "extract/apis/test_ros2_tables.py",
        "config/test_selection.py",
    ],
)
def test_not_slow(path: str) -> None:
    assert not is_slow(TESTS / path)


def test_contributors_are_told_of_the_quick_ones_first() -> None:
    page = (TESTS.parent / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert page.index('pytest -m "not slow"') < page.index("pytest tests/link")
