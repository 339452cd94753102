# SPDX-License-Identifier: Apache-2.0
"""The static interpreter of ROS 2 launch files in Python: their syntax alone, in a subset, within budgets."""

from __future__ import annotations

from haros_ci.launch.python.heap import Budget
from haros_ci.launch.python.interpret import interpret

__all__ = ["Budget", "interpret"]
