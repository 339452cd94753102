# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node declares twice: the second time throws."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from haros_ci.api import NO_SYSTEMS, Check, End, Finding, Level, System, line_of


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        if node.ros != 2 or not node.known or system.name.endswith(NO_SYSTEMS):
            continue
        for key, ends in node.names.declared.items():
            if "?" in key or key in node.names.set or len(ends) < 2:
                continue
            certain = [end for end in ends if not (end.implicit or end.conditions or is_doubtful(end))]
            for first, second in combinations(certain, 2):
                if first.raw.location is not None and second.raw.location not in (None, first.raw.location):
                    yield Finding(
                        at=second.location,
                        message=f"{node.type} declares the parameter {key} twice: the second call throws "
                        f"ParameterAlreadyDeclaredException; the first declaration is at {line_of(first.location)}; remove one",
                        about=(first, second, key),
                        related=((first.location, "first declaration"),),
                    )


def is_doubtful(end: End) -> bool:
    """Whether it is not known that this very parameter is declared; what its default is does not matter."""
    return any(unknown.field in ("name", "presence", "conditions") for unknown in end.raw.unknowns)


CHECK = Check(
    id="parameter-declared-twice",
    summary="Parameter declared twice by one node.",
    level=Level.ERROR,
    tags=("parameters",),
    run=check,
)
