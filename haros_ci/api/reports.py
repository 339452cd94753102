# SPDX-License-Identifier: Apache-2.0
"""Renderers: the report that they get, and how its texts are escaped for each sink (docs/plugins.md)."""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.report.escape import markdown, markdown_code, multiline, terminal, workflow_data, workflow_property
from haros_ci.report.model_compact import expand as expand_model
from haros_ci.results.fix import Edit, Fix
from haros_ci.results.result import (
    Baseline,
    BaselineState,
    Coverage,
    Notification,
    Provenance,
    Related,
    Report,
    Result,
    Run,
    Suppression,
    Tool,
    is_open,
)
from haros_ci.results.rule import Level, Rule

__all__ = [
    "Baseline",
    "BaselineState",
    "Coverage",
    "Edit",
    "Fix",
    "Level",
    "Location",
    "Notification",
    "Provenance",
    "Related",
    "Report",
    "Result",
    "Rule",
    "Run",
    "Suppression",
    "Tool",
    "expand_model",
    "is_open",
    "markdown",
    "markdown_code",
    "multiline",
    "terminal",
    "workflow_data",
    "workflow_property",
]
