# SPDX-License-Identifier: Apache-2.0
"""Conditions of launch files that cannot change, or that compare a truth with another spelling of it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, regex
from haros_ci.api.launch import Comparison, ConditionUse, included_by

_TRUTHS = {"true": True, "false": False}
#: What authors write to switch a part of a launch file on or off by hand.
_SWITCHES = frozenset((*_TRUTHS, "1", "0"))
_CONDITION = regex(
    r"(?:\w+\.)*(?:If|Unless)Condition\(\s*(?:predicate_expression\s*=\s*)?(.{0,40}?)\s*(?:,\s*)?\)", re.DOTALL
)


def check(system: System) -> Iterator[Finding]:
    for use in system.facts(ConditionUse):
        if use.is_constant:
            yield Finding(
                at=use.location,
                message=f"the condition {use.statement}={use.text!r} is always the same; remove it, or test a launch argument",
                about=(use.text,),
                apart=(use.text,),
                flow=included_by(use),
                presence=use.presence,
                level=Level.NOTE if _is_switch(use.text) else None,
            )
        for comparison in use.comparisons:
            misspelling = _misspelt(comparison, use.ros)
            if misspelling:
                yield Finding(
                    at=use.location,
                    message=f"{comparison.left} {comparison.sign} {comparison.right!r} {misspelling}",
                    about=(use.text, comparison.left),
                    apart=(use.text, comparison.left),
                    flow=included_by(use),
                    presence=use.presence,
                )


def _is_switch(text: str) -> bool:
    """Whether a condition is a truth alone, in Python the only argument of IfCondition or UnlessCondition."""
    inside = _CONDITION.fullmatch(text.strip())
    return (inside[1] if inside is not None else text).strip(" []'\"").lower() in _SWITCHES


def _misspelt(comparison: Comparison, ros: int) -> str:
    """What is wrong with a comparison of a truth as text; "" if nothing is."""
    if comparison.right.lower() not in _TRUTHS:
        return ""
    if not comparison.is_quoted:
        if ros == 1 and any(value.lower() in _TRUTHS for value in comparison.values):
            return (
                "compares a boolean with text: roslaunch converts the argument to a boolean, so the two are never equal"
            )
        return ""
    truths = [value for value in comparison.values if value.lower() in _TRUTHS]
    if truths and len(truths) == len(comparison.values) and not any(value == comparison.right for value in truths):
        other = [value for value in truths if value[:1].isupper() != comparison.right[:1].isupper()]
        if len(other) == len(truths):
            return (
                f"is never equal to {' or '.join(map(repr, truths))}, the values that are passed: launch compares text, "
                "so upper and lower case count"
            )
    return ""


CHECK = Check(
    id="constant-launch-condition",
    summary="Launch condition that is always true or always false.",
    level=Level.WARNING,
    catalogue="L09",
    tags=("launch",),
    run=check,
)
