# SPDX-License-Identifier: Apache-2.0
"""The one rule of codespell."""

from __future__ import annotations

from haros_ci.linters.catalogue.single import Single
from haros_ci.results.rule import Level

RULE = Single(
    tool="codespell",
    name="misspelling",
    summary="Misspelt word.",
    advice="Correct the word, or put it into `ignore-words-list` of `.codespellrc`.",
    suppress="`codespell:ignore word` in a comment on the line",
    address="https://github.com/codespell-project/codespell",
    subject="spelling",
    level=Level.WARNING,
    precision="medium",
)

rules = RULE.rules
invented = RULE.invented
