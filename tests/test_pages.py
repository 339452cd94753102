# SPDX-License-Identifier: Apache-2.0
"""The documentation as a whole: generated pages are up to date, and every page can be found."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
sys.path.append(str(ROOT / "tools"))

from build_rule_pages import cell, pages  # noqa: E402

from haros_ci.registry import built_in  # noqa: E402


def test_the_rule_pages_are_those_of_the_catalogue() -> None:
    made = pages(built_in())
    kept = {path.name: path.read_text(encoding="utf-8") for path in (DOCS / "rules").glob("*.md")}
    assert kept == made, "python tools/build_rule_pages.py"


def test_a_cell_is_one_cell() -> None:
    assert cell("a | b\n<c> *d* [e](f)") == "a \\| b \\<c\\> \\*d\\* \\[e\\](f)"


def test_every_page_is_in_the_index() -> None:
    index = (DOCS / "README.md").read_text(encoding="utf-8")
    named = set(re.findall(r"\]\(([^)#:]+)", index))
    assert {path.name for path in DOCS.glob("*.md")} - {"README.md"} <= named
    assert all((DOCS / target).exists() for target in named)
