# SPDX-License-Identifier: Apache-2.0
"""Every check has a page, and says of the page's examples what the page says: the page is its help and its test."""

from __future__ import annotations

from pathlib import Path

import pytest
from every import every

from haros_ci.api.testing import faults, faults_of_page
from haros_ci.checking.check import Check
from haros_ci.checking.page import SECTIONS, Page, read_page
from haros_ci.commands.new_check import new_check
from haros_ci.errors import UserError
from haros_ci.registry import check_rules, checks, page_of
from haros_ci.report.check_table import render

ROOT = Path(__file__).resolve().parent.parent
PAGES: dict[str, Page] = {check.id: read_page(page_of(check)) for check in checks()}


@pytest.mark.parametrize("check", checks(), ids=lambda check: check.id)
def test_a_page_is_true(check: Check, tmp_path: Path) -> None:
    wrong = {
        f"example {number}, {'bad' if example.is_bad else 'good'}": found
        for number, example in enumerate(PAGES[check.id].examples, 1)
        if (found := faults(check, example, tmp_path / str(number)))
    }
    assert not wrong


@every("check", checks(), ids=lambda check: check.id)
def test_a_page_is_whole(check: Check) -> None:
    assert not faults_of_page(check, page_of(check))


def test_names_are_the_ids() -> None:
    modules = sorted(path.stem for path in (ROOT / "checks").glob("*.py") if path.stem != "__init__")
    pages = sorted(path.stem for path in (ROOT / "checks").glob("*.md"))
    assert [check.id.replace("-", "_") for check in checks()] == modules == pages


def test_ids_and_aliases_are_unique() -> None:
    names = [name for rule in check_rules().values() for name in (rule.id, *rule.aliases)]
    assert len(names) == len(set(names))


def test_the_table_of_the_docs_is_current() -> None:
    assert (ROOT / "docs" / "checks.md").read_text(encoding="utf-8") == render(check_rules().values())


def test_a_new_check_fails_until_it_is_written(tmp_path: Path) -> None:
    (tmp_path / "checks").mkdir()
    (tmp_path / "checks" / "__init__.py").touch()
    module, page = new_check("odd-topic", tmp_path)
    compile(module.read_text(encoding="utf-8"), str(module), "exec")
    read = read_page(page.read_text(encoding="utf-8"))
    assert (read.title, read.sections) == ("odd-topic", SECTIONS)
    assert [example.expected for example in read.examples] == [(("talker.py", 7),), ()]
    for name, said in (("odd-topic", "there already"), ("Odd", "no name of a check"), ("topic", "no name of a check")):
        with pytest.raises(UserError, match=said):
            new_check(name, tmp_path)
    with pytest.raises(UserError, match="no checks in"):
        new_check("other-topic", tmp_path / "checks")


@every("check", checks(), ids=lambda check: check.id)
def test_a_check_looks_at_one_thing(check: Check) -> None:
    assert (check.run is None) != (check.project is None)
