# SPDX-License-Identifier: Apache-2.0
"""The one rule of black."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

DOCUMENTATION = "https://black.readthedocs.io/en/stable/"
RULE = "would-reformat"
SUMMARY = "A file is laid out as Black lays it out."
ADVICE = "Run `black` on the file: it changes the layout and nothing else."
SUPPRESS = "`# fmt: skip` on a line, or `# fmt: off` before and `# fmt: on` after"


def rules() -> dict[str, Rule]:
    """The one rule by its id."""
    return {RULE: _rule(RULE, SUMMARY)}


def invented(name: str) -> Rule:
    """There is no other; a log of ours may name one all the same."""
    return _rule(name, f"Black says '{words(name)}' of nothing.")


def _rule(name: str, summary: str) -> Rule:
    return Rule(
        id=name,
        summary=summary,
        level=Level.NOTE,
        help=help_text(name, summary, ADVICE, SUPPRESS),
        help_uri=DOCUMENTATION,
        precision="very-high",
        profiles=profiles("R"),
        tags=tags_of("code-standards", "black", "layout"),
    )
