# SPDX-License-Identifier: Apache-2.0
"""The one rule of isort."""

from __future__ import annotations

from haros_ci.linters.catalogue.single import Single
from haros_ci.results.rule import Level

RULE = Single(
    tool="isort",
    name="unsorted-imports",
    summary="Imports not in isort's order.",
    advice="Run `isort` on the file: it moves imports and nothing else.",
    suppress="`# isort: skip` on a line, or `# isort: skip_file` at the head",
    address="https://pycqa.github.io/isort/",
    subject="imports",
    level=Level.NOTE,
    precision="very-high",
)

rules = RULE.rules
invented = RULE.invented
