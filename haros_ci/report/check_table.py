# SPDX-License-Identifier: Apache-2.0
"""The table of the checks of the architecture, as docs/checks.md has it."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.results.rule import Rule

HEAD = """# Checks of the architecture

Written by `haros-ci rules --checks`. A *stable* check runs by default where a profile has it; a *preview* one is turned on with
`--select ID`. *Exact* findings follow from the sources, *closed-world* ones need `closed: true` in the configuration, *heuristic*
ones go by likeness. `haros-ci explain ID` shows a check's page; the catalogue's short id is an alias.

| Check | Alias | Level | Sure | Status | Profiles | Defect |
|---|---|---|---|---|---|---|
"""


def render(rules: Iterable[Rule]) -> str:
    """Markdown: a row for each of *rules*, by id."""
    return HEAD + "".join(_row(rule) for rule in sorted(rules, key=lambda rule: rule.id))


def _row(rule: Rule) -> str:
    sure = next((tag for tag in rule.tags if tag in ("exact", "closed-world", "heuristic")), "")
    status = "preview" if "preview" in rule.tags else "stable"
    page = rule.id.replace("-", "_")
    cells = (
        f"[{rule.id}](../checks/{page}.md)",
        ", ".join(rule.aliases),
        rule.level.value,
        sure,
        status,
        ", ".join(rule.profiles) or "-",
        rule.summary,
    )
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |\n"
