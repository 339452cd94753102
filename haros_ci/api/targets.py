# SPDX-License-Identifier: Apache-2.0
"""What is meant by names of CMake targets, libraries and dependencies that a package does not have."""

from __future__ import annotations

from haros_ci.checking.meant_targets import KEYWORDS_OF_CATKIN, is_slip_of_target, meant_targets, target_hint

__all__ = ["KEYWORDS_OF_CATKIN", "is_slip_of_target", "meant_targets", "target_hint"]
