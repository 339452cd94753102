# SPDX-License-Identifier: Apache-2.0
"""README and the first pages say what is so: their copies of files, their commands and their output are held against the real ones."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from every import every

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def fences(page: str, marker: str) -> list[tuple[str, str]]:
    """(argument, text of the fence below it) for each ``<!-- marker: argument -->`` of the page."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"<!-- {marker}: (.+?) -->\n```\w*\n(.*?)```", text, re.S)


def test_the_readme_is_short() -> None:
    assert len(README.splitlines()) <= 100


@pytest.mark.parametrize(
    ("page", "names"),
    [
        ("README.md", ["docs/workflows/pre-commit-config.yaml"]),
        ("docs/ci.md", ["docs/workflows/haros-ci.yml"]),
    ],
)
def test_copied_files_are_copies(page: str, names: list[str]) -> None:
    copies = fences(page, "file")
    assert [name for name, _ in copies] == names
    for name, text in copies:
        assert text == (ROOT / name).read_text(encoding="utf-8"), name


def test_the_picture_is_real_output(tmp_path: Path) -> None:
    ((_, text),) = fences("docs/first-steps.md", "output")
    shutil.copytree(ROOT / "examples" / "warehouse_ws", tmp_path / "ws")
    command = [sys.executable, "-m", "haros_ci", "check", "src/map_keeper", "--no-cache"]
    done = subprocess.run(command, cwd=tmp_path / "ws", capture_output=True, text=True, timeout=120)
    assert done.returncode == 1, done.stderr
    of_this_machine = re.compile(r"with .*?\.$|^  Linters run .*$", re.M)  # versions, and whether there is a sandbox
    assert of_this_machine.sub("@", done.stdout) == of_this_machine.sub("@", text)


def test_ci_runs_the_test_command_of_the_readme() -> None:
    command = "pip install --quiet -e '.[test]' && python -m pytest -n auto --dist loadscope"
    assert f"```sh\n{command}\n```" in README
    assert f"\n{command}\n" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")


@every("page", sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]), ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8")):
        assert target.startswith("http") or (page.parent / target).exists(), target
