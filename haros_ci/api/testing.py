# SPDX-License-Identifier: Apache-2.0
"""The tests of a check: its page says what it finds in small workspaces, and here it is held to it (docs/plugins.md).

In a plug-in's tests, with pytest::

    @pytest.mark.parametrize("example", examples_of(PAGE), ids=lambda example: example.title)
    def test_the_page_is_true(example, tmp_path):
        assert not faults(CHECK, example, tmp_path)
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.architectures import project_of
from haros_ci.api import Check
from haros_ci.checking.page import SECTIONS, Example, filled, read_page
from haros_ci.checking.run import run_checks, run_on_project
from haros_ci.checking.system import System, systems
from haros_ci.config.load import FILE_NAMES, load
from haros_ci.config.settings import Settings
from haros_ci.model.workspace import Workspace
from haros_ci.results.fix import Edit, applied
from haros_ci.results.result import Result
from haros_ci.systems.link import Linked
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

__all__ = ["Example", "examples_of", "faults", "faults_of_page", "filled", "mended", "read", "said"]


def examples_of(page: str) -> tuple[Example, ...]:
    """The small workspaces in the text of a check's page, the bad ones first."""
    return read_page(page).examples


def faults_of_page(check: Check, text: str) -> tuple[str, ...]:
    """What the page of *check* lacks: its title, its sections in order, marks in all bad examples, enough good ones."""
    page = read_page(text)
    bad = [example for example in page.examples if example.is_bad]
    good = [example for example in page.examples if not example.is_bad]
    found = [
        (page.title != check.id, f"its title is not {check.id}"),
        (page.sections != SECTIONS, f"its sections are not {', '.join(SECTIONS)}"),
        (not bad or not all(example.expected for example in bad), f"a bad example has no 'expect: {check.id}'"),
        (any(example.expected for example in good), "a good example expects a finding"),
        (not (len(good) > len(bad) or len(good) > 2), "the good examples are not the longer list"),
    ]
    return tuple(fault for is_so, fault in found if is_so)


def faults(check: Check, example: Example, directory: Path, plugins: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Where *check* says anything else than *example*, or offers a fix that does not mend it; files go into *directory*.

    *plugins* are modules whose API rows are known besides.
    """
    results = said(check, example, directory, plugins)
    found = [(r.location.path, r.location.line) for r in results]
    wrong = [f"{r.location}: reported, not expected: {r.message}" for r in results if _at(r) not in example.expected]
    wrong += [f"{path}:{line}: expected, not reported" for path, line in example.expected if (path, line) not in found]
    wrong += [
        f"{path}:{line}: reported {found.count((path, line))} times, expected {example.expected.count((path, line))} times"
        for path, line in sorted({*found} & {*example.expected})
        if found.count((path, line)) != example.expected.count((path, line))
    ]
    wrong += [f"{r.location}: it is about nothing: fill in 'about'" for r in results if not r.subject]
    if any(result.fixes for result in results):
        after = sorted(r.message for r in said(check, mended(example, results), directory / "mended", plugins))
        if after != sorted(r.message for r in results if not r.fixes):
            wrong.append(f"after the first fixes it still says, or says besides: {after}")
    return tuple(wrong)


def _at(result: Result) -> tuple[str, int | None]:
    return result.location.path, result.location.line


def said(check: Check, example: Example, directory: Path, plugins: tuple[str, ...] = ()) -> tuple[Result, ...]:
    """What *check* says of *example*; a project file in it is read."""
    base = None
    if example.base is not None:
        workspace, made, all_systems = read(example.base, directory / "base", plugins=plugins)
        base = project_of(made, workspace, all_systems)
    workspace, made, all_systems = read(example.files, directory / "head", example.executables, plugins)
    outcome = run_checks((check,), all_systems, "haros-ci")
    file = project_file_of(example.files)
    counts = directory / ("head" if example.base is None else "base")
    access = load(counts).access if file else ()
    project = project_of(made, workspace, all_systems, base, project_file=file, access=access)
    once = run_on_project((check,), project, "haros-ci")
    for problem in (*outcome.notifications, *once.notifications):
        raise AssertionError(problem.message)
    return (*outcome.results, *once.results)


def read(
    files: Mapping[str, str], root: Path, executables: Container[str] = (), plugins: tuple[str, ...] = ()
) -> tuple[Workspace, Linked, tuple[System, ...]]:
    """*files*, written below *root*, with what is made of them."""
    for path, text in files.items():
        place = root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
        if path in executables:
            place.chmod(0o755)
    settings = replace(load(root) if project_file_of(files) else Settings(root=root), plugins=plugins)
    workspace = discover(root, (".",))
    made = varied(workspace, settings, MemoryCache(), alternatives=False)
    return workspace, made, tuple(systems(made.architecture, workspace))


def project_file_of(files: Container[str]) -> str:
    """The project file among *files*; "" if there is none."""
    return next((name for name in FILE_NAMES if name in files), "")


def mended(example: Example, results: Iterable[Result]) -> Example:
    """*example* after the first fix of each of *results*."""
    edits = [edit for result in results if result.fixes for edit in result.fixes[0].edits]
    files = {path: applied(text, edits_of(path, edits)) for path, text in example.files.items()}
    executables = example.executables | {edit.path for edit in edits if edit.is_executable}
    return replace(example, files=files, executables=executables)


def edits_of(path: str, edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits of the text at *path*, once each, as several findings may offer the same one."""
    return tuple(dict.fromkeys(edit for edit in edits if edit.path == path and not edit.is_executable))
