# SPDX-License-Identifier: Apache-2.0
"""Every check has a page, and says of the page's examples what the page says: the page is its help and its test."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.architecture import varied
from haros_ci.checking.check import Check
from haros_ci.checking.page import SECTIONS, Example, Page, read_page
from haros_ci.checking.run import run_checks, run_on_project
from haros_ci.checking.system import System, systems
from haros_ci.config.load import load
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.inspection import project_of
from haros_ci.link.link import Linked
from haros_ci.model.workspace import Workspace
from haros_ci.new_check import new_check
from haros_ci.registry import check_rules, checks, page_of
from haros_ci.report.check_table import render
from haros_ci.results.fix import Edit, applied
from haros_ci.results.result import Result
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

ROOT = Path(__file__).resolve().parent.parent
PAGES: dict[str, Page] = {check.id: read_page(page_of(check)) for check in checks()}
EXAMPLES = [
    pytest.param(check, example, id=f"{check.id}-{'bad' if example.is_bad else 'good'}-{number}")
    for check in checks()
    for number, example in enumerate(PAGES[check.id].examples, 1)
]


def said(check: Check, example: Example, tmp_path: Path) -> tuple[Result, ...]:
    """What *check* says of *example*; a project file in it is read."""
    base = None
    if example.base is not None:
        workspace, made, all_systems = read(example.base, tmp_path / "base")
        base = project_of(made, workspace, all_systems)
    workspace, made, all_systems = read(example.files, tmp_path / "head", example.executables)
    outcome = run_checks((check,), all_systems, "haros-ci")
    once = run_on_project((check,), project_of(made, workspace, all_systems, base), "haros-ci")
    assert not outcome.notifications and not once.notifications
    return (*outcome.results, *once.results)


def read(
    files: Mapping[str, str], root: Path, executables: Container[str] = ()
) -> tuple[Workspace, Linked, tuple[System, ...]]:
    """*files*, written below *root*, with what is made of them."""
    for path, text in files.items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
        if path in executables:
            place.chmod(0o755)
    project = next((name for name in (".haros-ci.yaml", "haros.yaml") if name in files), None)
    settings = load(root) if project else Settings(root=root)
    workspace = discover(root, (".",))
    made = varied(workspace, settings, MemoryCache(), alternatives=False)
    return workspace, made, tuple(systems(made.architecture, workspace))


@pytest.mark.parametrize(("check", "example"), EXAMPLES)
def test_a_page_is_true(check: Check, example: Example, tmp_path: Path) -> None:
    results = said(check, example, tmp_path)
    assert [(r.location.path, r.location.line) for r in results] == list(example.expected), [r.message for r in results]
    assert all(result.rule == check.id and result.subject for result in results)
    if any(result.fixes for result in results):
        after = said(check, mended(example, results), tmp_path / "mended")
        assert sorted(r.message for r in after) == sorted(r.message for r in results if not r.fixes)


def mended(example: Example, results: Iterable[Result]) -> Example:
    """*example* after the first fix of each of *results*."""
    edits = [edit for result in results if result.fixes for edit in result.fixes[0].edits]
    files = {path: applied(text, edits_of(path, edits)) for path, text in example.files.items()}
    executables = example.executables | {edit.path for edit in edits if edit.is_executable}
    return replace(example, files=files, executables=executables)


def edits_of(path: str, edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits of the text at *path*, once each, as several findings may offer the same one."""
    return tuple(dict.fromkeys(edit for edit in edits if edit.path == path and not edit.is_executable))


@pytest.mark.parametrize("check", checks(), ids=lambda check: check.id)
def test_a_page_is_whole(check: Check) -> None:
    page = PAGES[check.id]
    assert page.title == check.id
    assert page.sections == SECTIONS
    bad = [example for example in page.examples if example.is_bad]
    good = [example for example in page.examples if not example.is_bad]
    assert bad and all(example.expected for example in bad)
    assert len(good) > len(bad) or len(good) > 2, "the quiet list is the longer one"
    assert not any(example.expected for example in good)


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


@pytest.mark.parametrize("check", checks(), ids=lambda check: check.id)
def test_a_check_looks_at_one_thing(check: Check) -> None:
    assert (check.run is None) != (check.project is None)
