# SPDX-License-Identifier: Apache-2.0
"""Rate objects of zero or fewer turns a second, and timers with a negative period."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        for pace in node.raw.paces:
            if pace.period is None or pace.is_conditional or pace.period > 0:
                continue
            if pace.kind == "rate":
                value = "zero" if pace.period == 0 else "negative"
                yield Finding(
                    at=pace.location,
                    message=(
                        f"the rate of a loop of {node.name} is {value}: the loop fails or runs without any limit; set a number of "
                        "turns a second that is greater than zero"
                    ),
                    about=(node,),
                )
            elif pace.period < 0:
                yield Finding(
                    at=pace.location,
                    message=f"the period of a timer of {node.name} is negative ({pace.period:g} s); set one that is not",
                    about=(node,),
                )


CHECK = Check(
    id="rate-not-positive",
    summary="Rate of zero or less, or timer with a negative period.",
    level=Level.WARNING,
    tags=("code", "parameters"),
    run=check,
)
