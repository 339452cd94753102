# SPDX-License-Identifier: Apache-2.0
"""A check, and what it says."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import Enum
from typing import Union

from haros_ci.checking.project import Project
from haros_ci.checking.system import Channel, End, System, SystemNode
from haros_ci.model.location import Location
from haros_ci.model.presence import ALWAYS, Presence
from haros_ci.records import dataclass
from haros_ci.results.fix import Fix
from haros_ci.results.rule import Level, Rule

#: What plug-ins are written against (docs/plugins.md): the first number changes when something is taken away.
API_VERSION = (2, 0)
#: What a finding may be about: an end, a node, a topic or service, or a name.
About = Union[End, SystemNode, Channel, str]
#: A further place, and what is to be seen there.
Place = tuple[Location, str]


class Status(Enum):
    """STABLE runs by default: nine of ten findings on real systems are true. PREVIEW has to be selected."""

    STABLE = "stable"
    PREVIEW = "preview"


class Decidability(Enum):
    """How sure a finding is: EXACT from sources, CLOSED_WORLD if the configuration is all there is, HEURISTIC by likeness."""

    EXACT = "exact"
    CLOSED_WORLD = "closed-world"
    HEURISTIC = "heuristic"


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """What is wrong, *at* the place where the fix goes.

    *about* are the entities and names that the finding is about: they identify the finding after lines, files or launch
    arguments have changed, by them it is known when it can happen at all. *related* are the other ends, *flow* the places that lead
    to it, in order. *level* replaces the check's own. *presence* is a condition besides those of the entities. *apart* are names that
    tell several findings at one place apart, where the related places do not. *fixes* mend it, where an edit is certain to.
    """

    at: Location
    message: str
    about: tuple[About, ...]
    related: tuple[Place, ...] = ()
    flow: tuple[Place, ...] = ()
    level: Level | None = None
    presence: Presence = ALWAYS
    apart: tuple[str, ...] = ()
    fixes: tuple[Fix, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """One check: *run* looks at one system, or *project* at the whole workspace. Its page, ``checks/<id>.md`` with underscores, is its help and its test.

    *catalogue* is its short id in the catalogue of ROS checks (``G06``); *aliases* are further names, HAROS's for example. *profiles*
    says where it is on if not where its *status* says: stable ones in all but ``google``, of them errors in ``bugs-only``, too.
    *of_refused*: it looks at launch files that launch refuses as a whole, too; all others are silent there.
    """

    id: str
    summary: str
    level: Level
    run: Callable[[System], Iterable[Finding]] | None = None
    project: Callable[[Project], Iterable[Finding]] | None = None
    decidability: Decidability = Decidability.EXACT
    status: Status = Status.STABLE
    catalogue: str = ""
    aliases: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    profiles: tuple[str, ...] | None = None
    of_refused: bool = False

    def rule(self, page: str, help_uri: str | None) -> Rule:
        """The rule of its results; *page* is the text of its page."""
        return Rule(
            id=self.id,
            summary=self.summary,
            level=self.level,
            help=page,
            help_uri=help_uri,
            precision=_PRECISION[self.decidability],
            profiles=self.profiles if self.profiles is not None else self._profiles(),
            tags=("ros", "architecture", self.status.value, self.decidability.value, *self.tags),
            aliases=(*((self.catalogue,) if self.catalogue else ()), *self.aliases),
            catalogue=self.catalogue,
        )

    def _profiles(self) -> tuple[str, ...]:
        if self.status is Status.PREVIEW:
            return ()
        return ("ros", "strict", "architecture", *(("bugs-only",) if self.level is Level.ERROR else ()))


_PRECISION = {
    Decidability.EXACT: "very-high",
    Decidability.CLOSED_WORLD: "high",
    Decidability.HEURISTIC: "medium",
}
