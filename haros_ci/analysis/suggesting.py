# SPDX-License-Identifier: Apache-2.0
"""Properties that the code of a workspace suggests."""

from __future__ import annotations

from haros_ci.analysis.dependence import with_dependence
from haros_ci.analysis.rates import with_rates
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.suggesting import suggestions
from haros_ci.code.codebase import Codebase
from haros_ci.model.architecture import Architecture

Suggested = dict[str, tuple[tuple[str, tuple[str, ...]], ...]]


def suggested(found: Architecture, code: Codebase) -> Suggested:
    """By configuration the properties, each with its evidence; names that HPL cannot have are left out."""
    whole = with_dependence(with_rates(found, code), code)
    return {
        one.name: tuple((made.text, made.evidence) for made in suggestions(one) if _is_readable(made.text))
        for one in whole.configurations
    }


def _is_readable(text: str) -> bool:
    try:
        parse_property(text)
    except HplFault:
        return False
    return True
