# SPDX-License-Identifier: Apache-2.0
"""Rules made of groups of rows whose letters also tell the tool's own severity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from haros_ci.linters.catalogue.group import Group, Level, Rule, help_text, level_of, profiles, tags_of
from haros_ci.records import dataclass, field

LEVELS: Mapping[str, Level] = MappingProxyType({"e": Level.ERROR, "w": Level.WARNING, "n": Level.NOTE})


@dataclass(frozen=True, slots=True)
class Table:
    """The rules of *tool*.

    The letters of a row are a profile's and a severity's (e, w, n). *address* gives the page of a rule, *suppress* says how
    the tool itself is silenced, *cwe* and *security* (a severity) are by rule, as are *aliases*.
    """

    tool: str
    suppress: str
    address: Callable[[str], str | None]
    groups: tuple[Group, ...]
    cwe: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    security: Mapping[str, str] = field(default_factory=dict)
    aliases: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def rules(self) -> dict[str, Rule]:
        """Every rule of the table by id."""
        return {
            identifier: self.rule(identifier, letters, summary, group)
            for group in self.groups
            for identifier, letters, summary in group.rows
        }

    def rule(self, identifier: str, letters: str, summary: str, group: Group) -> Rule:
        """One rule, in the table or not."""
        severity = self.security.get(identifier)
        security = ("security",) if severity else ()
        return Rule(
            id=identifier,
            summary=summary,
            level=level_of(letters, LEVELS[letters[1]]),
            help=help_text(identifier, summary, group.advice, self.suppress),
            help_uri=self.address(identifier),
            precision=group.precision,
            profiles=profiles(letters),
            tags=tags_of("code-standards", self.tool, *security, *group.tags),
            aliases=self.aliases.get(identifier, ()),
            cwe=self.cwe.get(identifier, ()),
            security_severity=severity,
        )


__all__ = ["Group", "Rule", "Table"]
