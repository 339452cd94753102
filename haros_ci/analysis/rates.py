# SPDX-License-Identifier: Apache-2.0
"""The rates of the configurations of a workspace."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from haros_ci.code.codebase import Codebase
from haros_ci.dependence.filters import passed_on
from haros_ci.model.architecture import Architecture
from haros_ci.rates.topics import rates_of
from haros_ci.timing import timed


@timed("rates")
def with_rates(found: Architecture, code: Codebase) -> Architecture:
    """*found* with the rates of its configurations, whose programs are *code*."""
    every = (replace(one, rates=rates_of(one, code, partial(passed_on, code))) for one in found.configurations)
    return replace(found, configurations=tuple(every))
