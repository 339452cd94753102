# SPDX-License-Identifier: Apache-2.0
"""The one rule of isort."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

DOCUMENTATION = "https://pycqa.github.io/isort/"
RULE = "unsorted-imports"
SUMMARY = "Imports stand in the order of isort."
ADVICE = "Run `isort` on the file: it moves imports and nothing else."
SUPPRESS = "`# isort: skip` on a line, or `# isort: skip_file` at the head"


def rules() -> dict[str, Rule]:
    """The one rule by its id."""
    return {RULE: _rule(RULE, SUMMARY)}


def invented(name: str) -> Rule:
    """There is no other; a log of ours may name one all the same."""
    return _rule(name, f"Isort says '{words(name)}' of nothing.")


def _rule(name: str, summary: str) -> Rule:
    return Rule(
        id=name,
        summary=summary,
        level=Level.NOTE,
        help=help_text(name, summary, ADVICE, SUPPRESS),
        help_uri=DOCUMENTATION,
        precision="very-high",
        profiles=profiles("R"),
        tags=tags_of("code-standards", "isort", "imports"),
    )
