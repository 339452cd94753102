# SPDX-License-Identifier: Apache-2.0
"""Python classes that read an attribute or call a method of ``self`` that nothing sets or defines."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, Project
from haros_ci.api.code import Unset, unset_attributes


def check(project: Project) -> Iterator[Finding]:
    for each in unset_attributes(project):
        yield Finding(
            at=each.location,
            message=f"{each.owner} reads self.{each.name}, but nothing sets or defines it: the line raises "
            f"AttributeError{_like(each)}",
            about=(each.owner, each.name),
            apart=(each.owner, each.name),
        )


def _like(each: Unset) -> str:
    if any(each.name == parameter.name for parameter in each.routine.function.parameters):
        return f"; write {each.name}, the parameter of {each.routine.function.name.rpartition('.')[2]}()"
    found = get_close_matches(each.name, sorted(each.known), 1, 0.75)
    return f"; did you mean self.{found[0]}?" if found else "; set it in __init__()"


CHECK = Check(
    id="undefined-attribute",
    summary="Attribute of self that nothing sets.",
    level=Level.ERROR,
    tags=("python",),
    project=check,
)
