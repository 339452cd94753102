# SPDX-License-Identifier: Apache-2.0
"""Descriptions of robots, and transforms."""

from __future__ import annotations

from haros_ci.checking.frame_texts import FrameUse, frames_in
from haros_ci.checking.robots import descriptions, is_by_itself, lead, malformed, other_reader, place_of, together
from haros_ci.checking.transforms import Broadcast, at_odds, broadcasts, called, listeners_of_tf, origin
from haros_ci.checking.unloaded import is_left_over
from haros_ci.model.robot import (
    Description,
    Fault,
    Joint,
    Mesh,
    Robot,
)
from haros_ci.model.robot import (
    Link as RobotLink,
)

__all__ = [
    "Broadcast",
    "Description",
    "Fault",
    "FrameUse",
    "Joint",
    "Mesh",
    "Robot",
    "RobotLink",
    "at_odds",
    "broadcasts",
    "called",
    "descriptions",
    "frames_in",
    "is_by_itself",
    "is_left_over",
    "lead",
    "listeners_of_tf",
    "malformed",
    "origin",
    "other_reader",
    "place_of",
    "together",
]
