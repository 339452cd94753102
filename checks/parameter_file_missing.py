# SPDX-License-Identifier: Apache-2.0
"""Parameter files that a launch file gives to a node and that do not exist (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, FileUse, Finding, Level, ParameterFileUse, System


def check(system: System) -> Iterator[Finding]:
    similar = {use.location: use.similar for use in system.facts(FileUse) if use.kind == "parameters"}
    for use in system.facts(ParameterFileUse):
        if use.is_found is not False or use.ros != 2:
            continue
        meant = next(iter(similar.get(use.location, ())), None)
        yield Finding(
            at=use.location,
            message=(
                f"the parameter file {use.text} does not exist: launch says so in a warning, and starts "
                f"{use.node or '/'.join(use.program)} without these parameters"
                + (f"; did you mean {meant}?" if meant else "")
            ),
            about=(use.text, "/".join(use.program)),
            flow=tuple((place, "includes the next one") for place in use.included),
            presence=use.presence,
        )


CHECK = Check(
    id="parameter-file-missing",
    summary="The parameter files that nodes are given exist.",
    level=Level.ERROR,
    catalogue="P12",
    tags=("parameters", "launch"),
    run=check,
)
