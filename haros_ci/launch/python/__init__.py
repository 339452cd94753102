# SPDX-License-Identifier: Apache-2.0
"""The static interpreter of ROS 2 launch files in Python: their syntax alone, in a subset, within budgets.

It evaluates expressions itself, not by ``bounded_python``: they have places, statements change what they name, both sides of a
branch are taken, and texts keep which parts of them are unknown.
"""

from __future__ import annotations

from haros_ci.launch.python.heap import Budget
from haros_ci.launch.python.interpret import interpret

__all__ = ["Budget", "interpret"]
