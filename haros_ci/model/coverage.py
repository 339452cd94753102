# SPDX-License-Identifier: Apache-2.0
"""Call sites of ROS APIs in the code of a workspace, and what the model says of each."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.records import dataclass

#: What a file is for: the product, or tests and examples, which are counted separately.
PRODUCTION, TEST, EXAMPLE = AREAS = ("production", "test", "example")
#: An endpoint or parameter of the model; no API call at all; code that nothing reaches; missing in the model.
ENDPOINT, OTHER, UNREACHED, OPEN = STATES = ("endpoint", "other", "unreached", "open")
#: The share in production code below which the summary of a check mentions it.
ENOUGH = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """A call that looks like one of a ROS API: *line* and *column* are those of the called *name*, *call* its text.

    *package* is "" outside any package. *state* is one of ``STATES``; *reason* says why, in a few words that are the same for all
    sites of that kind, *detail* what is special about this one. *node_types* are those (``package/type``) that a call which is missing may
    belong to: they are incomplete.
    """

    path: str
    line: int
    column: int
    name: str
    call: str
    package: str
    area: str
    state: str
    reason: str = ""
    detail: str = ""
    node_types: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """How many sites there are, and how many of each state."""

    sites: int = 0
    endpoint: int = 0
    other: int = 0
    unreached: int = 0
    open: int = 0

    @property
    def accounted(self) -> int:
        return self.sites - self.open

    @property
    def share(self) -> float | None:
        """The part that is accounted for, from 0 to 1; None where there is no site."""
        return self.accounted / self.sites if self.sites else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Coverage:
    """All call sites of a workspace in the order of paths, lines and columns."""

    sites: tuple[Site, ...] = ()

    def packages(self) -> tuple[str, ...]:
        """The names of the packages that have a site, sorted; "" for what is outside any."""
        return tuple(sorted({site.package for site in self.sites}))

    def incomplete(self, area: str = PRODUCTION) -> dict[str, int]:
        """How many calls are missing that each node type may have, by node type, in the order of their names."""
        missing = [site for site in self.sites if site.area == area and site.state == OPEN]
        names = sorted({name for site in missing for name in site.node_types})
        return {name: sum(name in site.node_types for site in missing) for name in names}

    def counts(self, area: str = PRODUCTION, package: str | None = None) -> Counts:
        """The numbers of an area: of one package, or of all."""
        return counted(s for s in self.sites if s.area == area and package in (None, s.package))


def counted(sites: Iterable[Site]) -> Counts:
    """The numbers of *sites*."""
    states = [site.state for site in sites]
    return Counts(sites=len(states), **{state: states.count(state) for state in STATES})
