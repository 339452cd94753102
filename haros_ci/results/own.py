# SPDX-License-Identifier: Apache-2.0
"""The rules that haros-ci reports under its own name, outside any check."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.results.result import Result
from haros_ci.results.rule import Level, Rule

TOOL = "haros-ci"

MALFORMED_MANIFEST = Rule(
    id="malformed-manifest",
    summary="A package.xml cannot be read, so nothing that depends on it can be built or checked.",
    level=Level.ERROR,
    help=(
        "catkin, colcon and this tool read a package's name and dependencies from package.xml (REP 127, 140, 149). "
        "A manifest that is not well-formed XML or lacks its name stops the build of the whole workspace. "
        "Correct the line that the message names."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only"),
    tags=("ros", "correctness"),
)

MALFORMED_LAUNCH = Rule(
    id="malformed-launch-file",
    summary="A launch file cannot be read, so nothing in it can be started or checked.",
    level=Level.ERROR,
    help=(
        "roslaunch and ros2 launch stop at a launch file that is not well-formed XML, and at every file that includes it. "
        "Correct the line that the message names: a tag that is not closed, a quote that is missing, a bare & or <."
    ),
    precision="very-high",
    profiles=("ros", "strict", "google", "bugs-only", "architecture"),
    tags=("ros", "correctness"),
)

UNUSED_SUPPRESSION = Rule(
    id="unused-suppression",
    summary="A haros suppression comment hides nothing.",
    level=Level.NOTE,
    help=(
        "The rule named in the comment does not report anything there any more. A comment that is left behind will "
        "hide the next, unrelated finding. Remove it."
    ),
    precision="high",
    profiles=("ros", "strict", "google"),
    tags=("maintainability",),
)

RULES = {rule.id: rule for rule in (MALFORMED_MANIFEST, MALFORMED_LAUNCH, UNUSED_SUPPRESSION)}


def launch_results(faults: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each launch file that is no XML, at the line that the parser names."""
    return tuple(
        Result(TOOL, MALFORMED_LAUNCH.id, MALFORMED_LAUNCH.level, fault.message, Location(fault.path, fault.line or 1))
        for fault in faults
    )


def manifest_results(faults: Iterable[Problem]) -> tuple[Result, ...]:
    """One result for each malformed manifest, at the line that the parser names."""
    return tuple(
        Result(TOOL, MALFORMED_MANIFEST.id, MALFORMED_MANIFEST.level, fault.message, Location(fault.path, fault.line or 1))
        for fault in faults
    )
