# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --coverage``: which calls of ROS APIs the model accounts for."""

from __future__ import annotations

from haros_ci.model.coverage import Coverage
from haros_ci.timing import timed


@timed("render")
def content(found: Coverage, format: str) -> bytes:
    """*found* as text or json."""
    if format == "json":
        from haros_ci.report.coverage_json import render
    else:
        from haros_ci.report.coverage_text import render
    return render(found).encode("utf-8", "backslashreplace")
