# SPDX-License-Identifier: Apache-2.0
"""The table of a tool that has one rule."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Level, Rule, help_text, profiles, tags_of, words
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Single:
    """The rule *name* of *tool*, on under ``ros``; *suppress* says how the tool itself is silenced, *subject* is a tag."""

    tool: str
    name: str
    summary: str
    advice: str
    suppress: str
    address: str
    subject: str
    level: Level
    precision: str

    def rules(self) -> dict[str, Rule]:
        """The one rule by its id."""
        return {self.name: self._rule(self.name, self.summary)}

    def invented(self, name: str) -> Rule:
        """There is no other; a log of ours may name one all the same."""
        return self._rule(name, f"{self.tool.capitalize()} says '{words(name)}' of nothing.")

    def _rule(self, name: str, summary: str) -> Rule:
        return Rule(
            id=name,
            summary=summary,
            level=self.level,
            help=help_text(name, summary, self.advice, self.suppress),
            help_uri=self.address,
            precision=self.precision,
            profiles=profiles("R"),
            tags=tags_of("code-standards", self.tool, self.subject),
        )
