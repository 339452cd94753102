# SPDX-License-Identifier: Apache-2.0
"""What checks of launch files have in common: who owns a file, how launch gets to a place in it."""

from __future__ import annotations

from haros_ci.checking.system import System
from haros_ci.model.launch_facts import LaunchFact
from haros_ci.model.location import Location
from haros_ci.model.package import Package


def owner(system: System, location: Location) -> Package | None:
    """The innermost package that the file at *location* lies in."""
    path = location.path
    found = [each for each in system.packages.values() if each.path == "." or path.startswith(each.path + "/")]
    return max(found, key=lambda each: len(each.path), default=None)


def included_by(fact: LaunchFact) -> tuple[tuple[Location, str], ...]:
    """The includes that lead to *fact*, and its own place, as a flow; () if the launched file itself says it."""
    if not fact.included:
        return ()
    return (*((place, "includes a launch file") for place in fact.included), (fact.location, "which says this"))


def meant(similar: tuple[str, ...]) -> str:
    """A hint at what may be meant: ``; did you mean 'x'?``."""
    return f"; did you mean {similar[0]!r}?" if similar else ""
