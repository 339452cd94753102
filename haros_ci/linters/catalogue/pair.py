# SPDX-License-Identifier: Apache-2.0
"""A bad and a good example of one rule."""

from __future__ import annotations

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Pair:
    """Two pieces of code in one *language*: with the defect, and without it."""

    bad: str
    good: str
    language: str = "python"
