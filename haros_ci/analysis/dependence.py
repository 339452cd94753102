# SPDX-License-Identifier: Apache-2.0
"""The dependence in the configurations of a workspace."""

from __future__ import annotations

from dataclasses import replace
from difflib import get_close_matches

from haros_ci.code.codebase import Codebase
from haros_ci.dependence.nodes import dependence_of
from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture
from haros_ci.model.dependence_edges import names, sliced
from haros_ci.timing import timed


@timed("dependence")
def with_dependence(
    found: Architecture,
    code: Codebase,
    affects: tuple[str, ...] = (),
    caused_by: tuple[str, ...] = (),
) -> Architecture:
    """*found* with the dependence in its configurations, whose programs are *code*.

    With slices of what each of *affects* reaches and what reaches each of *caused_by*; UserError for a name that no node is on.
    """
    made = [(one, dependence_of(one, code)) for one in found.configurations]
    asked = [*((name, True) for name in affects), *((name, False) for name in caused_by)]
    known = {name for _, dependence in made for name in names(dependence)}
    for name, _ in asked:
        if name not in known:
            near = get_close_matches(name, sorted(known), 3)
            advice = f"did you mean {' or '.join(near)}?" if near else "haros-ci model --dependence lists them"
            raise UserError(f"no node is on {name}", help=advice)
    every = (
        replace(one, dependence=replace(dependence, slices=tuple(sliced(dependence, *which) for which in asked)))
        for one, dependence in made
    )
    return replace(found, configurations=tuple(every))
