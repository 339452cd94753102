# SPDX-License-Identifier: Apache-2.0
"""A finding's own level: kept where the settings give none, never that of a linter."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.config.selection import Selection
from haros_ci.config.settings import Policy, Settings
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.pipeline import selected
from haros_ci.registry import check_rules
from haros_ci.results.result import Result
from haros_ci.results.rule import Level, Rule
from haros_ci.workspace.discover import discover

OURS = "duplicate-node-name"  # a warning, in ROS 1 an error


PLAIN = Policy()


def level_of(workspace: Workspace, tool: str, rule: str, level: Level, policy: Policy = PLAIN) -> Level | None:
    settings = Settings(root=workspace.root, policy=policy)
    other = Rule("theirs", "A linter's.", level=Level.WARNING, profiles=("ros",))
    selection = Selection(settings, lambda name: check_rules() if name == "haros-ci" else {"theirs": other})
    results = selected((Result(tool, rule, level, "said", Location("a.launch", 1)),), selection, workspace)
    return results[0].level if results else None


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return discover(tmp_path, (".",))


@pytest.mark.parametrize(
    ("level", "expected"), [(Level.ERROR, Level.ERROR), (Level.WARNING, Level.WARNING), (Level.NOTE, None)]
)
def test_a_finding_keeps_its_level(workspace: Workspace, level: Level, expected: Level | None) -> None:
    """A note is a hint, which the profile does not show."""
    assert level_of(workspace, "haros-ci", OURS, level) is expected


def test_a_hint_is_there_for_who_asks(workspace: Workspace) -> None:
    assert level_of(workspace, "haros-ci", OURS, Level.NOTE, Policy(select=(OURS,))) is Level.NOTE


def test_the_settings_beat_it(workspace: Workspace) -> None:
    policy = Policy(levels=((f"haros-ci:{OURS}", Level.NOTE),))
    assert level_of(workspace, "haros-ci", OURS, Level.ERROR, policy) is Level.NOTE


def test_a_linter_has_the_level_of_its_rule(workspace: Workspace) -> None:
    assert level_of(workspace, "cpplint", "theirs", Level.ERROR) is Level.WARNING


@pytest.mark.parametrize("tool", ["cppcheck", "pylint", "catkin_lint"])
def test_a_linter_that_weighs_its_findings_has_their_level(workspace: Workspace, tool: str) -> None:
    assert level_of(workspace, tool, "theirs", Level.ERROR) is Level.ERROR
    assert level_of(workspace, tool, "theirs", Level.NOTE, Policy(select=(f"{tool}:theirs",))) is Level.NOTE
