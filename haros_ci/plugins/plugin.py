# SPDX-License-Identifier: Apache-2.0
"""What a plug-in offers, once it has been checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from haros_ci.checking.check import Check
from haros_ci.linters.linter import Linter
from haros_ci.model.api import Row
from haros_ci.records import dataclass, field
from haros_ci.results.result import Report
from haros_ci.results.rule import Rule

#: A report as text in a format of the plug-in's own.
Renderer = Callable[[Report], str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plugin:
    """A plug-in by the *name* of its module. *digest* is of all its files: with it goes what was kept of an earlier state.

    *pages* are the texts of its checks' pages by id, *rules* those of its linters by the linter's name.
    """

    name: str
    version: str = ""
    digest: str = ""
    linters: tuple[Linter, ...] = ()
    checks: tuple[Check, ...] = ()
    pages: Mapping[str, str] = field(default_factory=dict)
    rules: Mapping[str, Mapping[str, Rule]] = field(default_factory=dict)
    rows: tuple[Row, ...] = ()
    renderers: Mapping[str, Renderer] = field(default_factory=dict)

    def check_rules(self) -> dict[str, Rule]:
        """The rules of its checks by id."""
        return {check.id: check.rule(self.pages[check.id], None) for check in self.checks}
