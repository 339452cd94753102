# SPDX-License-Identifier: Apache-2.0
"""A value of a metric: what was measured, and of what."""

from __future__ import annotations

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Measurement:
    """*value* of *metric* (HAROS's name in kebab-case, as ``cyclomatic-complexity``).

    It belongs to the innermost of *package*, *path*, *class_name* and *function* that is not "". *line* is where that
    begins, from 1; 0 for files and packages. *path* is relative to the workspace root.
    """

    package: str
    path: str
    line: int
    class_name: str
    function: str
    metric: str
    value: float
