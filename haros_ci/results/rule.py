# SPDX-License-Identifier: Apache-2.0
"""Rules and how bad a breach of one is."""

from __future__ import annotations

from enum import Enum

from haros_ci.records import dataclass


class Level(Enum):
    """SARIF §3.27.10, without ``none``."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"

    @property
    def rank(self) -> int:
        """0 for the worst level; sorts errors first."""
        return ("error", "warning", "note").index(self.value)

    def reaches(self, threshold: Level) -> bool:
        """Whether this level is as bad as *threshold* or worse."""
        return self.rank <= threshold.rank


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule of a tool (SARIF *reportingDescriptor*, §3.49).

    ``id`` is the tool's own, unchanged. ``profiles`` name the profiles that enable it; ``all`` enables every rule.
    ``aliases`` are further names that select, ignore and suppress it (HAROS and catalogue ids). ``precision`` is
    GitHub's scale: very-high, high, medium, low. ``security_severity`` is a numeric string 0.1–10.0 and only for
    rules tagged ``security``. ``catalogue`` is the rule's short id in the catalogue of ROS checks (``G06``), an alias, too.
    """

    id: str
    summary: str
    level: Level = Level.WARNING
    help: str = ""
    help_uri: str | None = None
    precision: str = "high"
    profiles: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    aliases: tuple[str, ...] = ()
    deprecated_ids: tuple[str, ...] = ()
    cwe: tuple[int, ...] = ()
    security_severity: str | None = None
    catalogue: str = ""
