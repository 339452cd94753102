# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --coverage``: which calls of ROS APIs the model accounts for."""

from __future__ import annotations

from haros_ci.analysis.architecture import api_rows, plugin_rows
from haros_ci.analysis.coverage import coverage_of
from haros_ci.config.settings import Settings
from haros_ci.model.workspace import Workspace
from haros_ci.systems.link import Linked


def content(made: Linked, workspace: Workspace, settings: Settings, format: str) -> bytes:
    """The coverage of what was *made*, as text or json."""
    rows = api_rows(settings.project.get("apis"), "", [], plugin_rows(settings))
    found = coverage_of(made, workspace, rows)
    if format == "json":
        from haros_ci.report.coverage_json import render
    else:
        from haros_ci.report.coverage_text import render
    return render(found).encode("utf-8", "backslashreplace")
