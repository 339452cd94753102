# SPDX-License-Identifier: Apache-2.0
"""Every text of ours on a rule of a linter was held to the tool itself: text_sources.tsv names what was looked at, and of which text.

The tools that examples are run through: cppcheck, cpplint, flake8, pylint, ruff, shellcheck (test_example_pairs.py) and clang-tidy
(test_clang_tidy_pairs.py). Of mypy, vulture and yamllint a few rules have a text and no example of their own. ruff and clang-tidy come with no
extra of ours, so these tests skip their examples where they are not installed.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from every import every

from haros_ci.linters.catalogue import rules_of
from haros_ci.linters.catalogue.clang_tidy_texts import TEXTS
from haros_ci.linters.catalogue.examples import BY_RULE as EXAMPLES
from haros_ci.linters.catalogue.reasons import BY_RULE as REASONS

TABLE = Path(__file__).with_name("text_sources.tsv")
ROWS = [line.split("\t") for line in TABLE.read_text(encoding="utf-8").splitlines()[1:]]
RULES = sorted({*REASONS, *TEXTS, *EXAMPLES})


def test_every_text_has_a_row_and_every_row_a_text() -> None:
    assert [row[0] for row in ROWS] == RULES


@every(("rule", "digest", "source"), ROWS, ids=lambda row: row[0])
def test_the_text_is_the_one_that_was_held_to_its_source(rule: str, digest: str, source: str) -> None:
    """A changed text is held to the tool anew: then its row is ``rule, the digest that this test expects, what was looked at``."""
    assert digest == _digest(rule) and source.strip()


def test_a_rule_of_another_tool_with_the_same_id_has_its_own_words() -> None:
    ours, other = rules_of("pylint")["unreachable"], rules_of("mypy")["unreachable"]
    assert "sys.exit" in ours.help and "annotation" in other.help and "sys.exit" not in other.help


def _digest(rule: str) -> str:
    pair = EXAMPLES.get(rule)
    parts = (REASONS.get(rule, ""), *TEXTS.get(rule, ()), *((pair.bad, pair.good) if pair else ()))
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:8]
