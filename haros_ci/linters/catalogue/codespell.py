# SPDX-License-Identifier: Apache-2.0
"""The one rule of codespell."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

DOCUMENTATION = "https://github.com/codespell-project/codespell"
RULE = "misspelling"
SUMMARY = "Words are spelled as in the dictionary."
ADVICE = "Correct the word, or put it into `ignore-words-list` of `.codespellrc`."
SUPPRESS = "`codespell:ignore word` in a comment on the line"


def rules() -> dict[str, Rule]:
    """The one rule by its id."""
    return {RULE: _rule(RULE, SUMMARY)}


def invented(name: str) -> Rule:
    """There is no other; a log of ours may name one all the same."""
    return _rule(name, f"Codespell says '{words(name)}' of nothing.")


def _rule(name: str, summary: str) -> Rule:
    return Rule(
        id=name,
        summary=summary,
        level=Level.WARNING,
        help=help_text(name, summary, ADVICE, SUPPRESS),
        help_uri=DOCUMENTATION,
        precision="medium",
        profiles=profiles("R"),
        tags=tags_of("code-standards", "codespell", "spelling"),
    )
