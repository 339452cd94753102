# SPDX-License-Identifier: Apache-2.0
"""The rates of the configurations of a workspace."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from haros_ci.code.codebase import codebase
from haros_ci.index.index import Source
from haros_ci.model.architecture import Architecture
from haros_ci.model.workspace import Workspace
from haros_ci.rates.topics import rates_of
from haros_ci.timing import timed


@timed("rates")
def with_rates(found: Architecture, sources: Iterable[Source], workspace: Workspace) -> Architecture:
    """*found* with the rates of its configurations, of which *sources* are the programs."""
    ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}
    code = codebase(sources, workspace.text, ros)
    every = (replace(one, rates=rates_of(one, code)) for one in found.configurations)
    return replace(found, configurations=tuple(every))
