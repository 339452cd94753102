# SPDX-License-Identifier: Apache-2.0
"""Adapters of linters: what they get, what they give, and how a program is found (docs/plugins.md)."""

from __future__ import annotations

from haros_ci.linters.installed import binary
from haros_ci.linters.linter import (
    Batch,
    Command,
    Finding,
    GaveUp,
    Level,
    Linter,
    LintOptions,
    Output,
    Program,
    Related,
    Result,
    Unit,
    When,
)
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.rule import Rule

__all__ = [
    "Batch",
    "Command",
    "Finding",
    "GaveUp",
    "Level",
    "LintOptions",
    "Linter",
    "Location",
    "Output",
    "Program",
    "Related",
    "Result",
    "Rule",
    "SourceFile",
    "Store",
    "Unit",
    "When",
    "Workspace",
    "binary",
]
