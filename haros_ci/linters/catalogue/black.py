# SPDX-License-Identifier: Apache-2.0
"""The one rule of black."""

from __future__ import annotations

from haros_ci.linters.catalogue.single import Single
from haros_ci.results.rule import Level

RULE = Single(
    tool="black",
    name="would-reformat",
    summary="File not formatted by Black.",
    advice="Run `black` on the file: it changes the layout and nothing else.",
    suppress="`# fmt: skip` on a line, or `# fmt: off` before and `# fmt: on` after",
    address="https://black.readthedocs.io/en/stable/",
    subject="layout",
    level=Level.NOTE,
    precision="very-high",
)

rules = RULE.rules
invented = RULE.invented
