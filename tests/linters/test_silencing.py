# SPDX-License-Identifier: Apache-2.0
"""What two texts of one settings file switch off, tool by tool; and the page that has the table."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters import silencing
from haros_ci.linters.settings_changes import notes
from haros_ci.workspace.tool_settings import TOOL_SETTINGS

ROOT = Path(__file__).resolve().parents[2]
SOURCES = {"a.py": "", "p/b.cpp": ""}
NOTHING = "is known to be turned off"


def said(place: Path, before: Mapping[str, str], after: Mapping[str, str]) -> dict[str, str]:
    base = workspace(place / "base", {**SOURCES, **before})
    head = workspace(place / "head", {**SOURCES, **after})
    return {note.path: note.message for note in notes(head, base)}


def off(message: str) -> list[str]:
    return message.partition("turns off: ")[2].rstrip(".").split(", ") if "turns off: " in message else []


#: File, text before, text after, what the change turns off.
FIRES = [
    ("pylintrc", "[M]\ndisable=a\n", "[M]\ndisable=a,b\n", ["pylint:b"]),
    ("pylintrc", "[M]\nenable=c\n", "[M]\n", ["pylint:c"]),
    ("pylintrc", "[M]\n", "[M]\nmax-line-length=300\n", ["pylint up to `max-line-length` 300 (before: 100)"]),
    ("pylintrc", "[M]\nmax-args=2\n", "[M]\n", ["pylint up to `max-args` 5 (before: 2)"]),
    ("pyproject.toml", "", "[tool.pylint.x]\nignored-modules = ['numpy']\n", ["pylint as `ignored-modules` says: numpy"]),
    ("setup.cfg", "[flake8]\nselect=E,F\n", "[flake8]\nselect=E\n", ["flake8:F"]),
    ("tox.ini", "", "[flake8]\nselect=E\n", ["flake8:* but E"]),
    (".flake8", "[flake8]\nmax-complexity=9\n", "[flake8]\n", ["flake8 above `max-complexity` 9 (now without a limit)"]),
    (".flake8", "[flake8]\nextend-select=D\n", "", ["flake8:D"]),
    ("ruff.toml", "lint.select=['F','D']\n", "", ["ruff:D (unless it is on by default)", "ruff:F (unless it is on by default)"]),
    ("ruff.toml", "line-length = 80\n", "line-length = 400\n", ["ruff up to `line-length` 400 (before: 80)"]),
    (".bandit", "", "[bandit]\ntests: B101\n", ["bandit:* but B101"]),
    ("pyproject.toml", "[tool.black]\n", "[tool.black]\nforce-exclude='x'\n", ["black as `force-exclude` says: x"]),
    ("mypy.ini", "[mypy]\nstrict=True\n", "[mypy]\n", ["mypy without `strict`"]),
    ("pyproject.toml", "", "[[tool.mypy.overrides]]\nmodule='x'\nignore_errors=true\n", ["mypy as `[x] ignore-errors` says: true"]),
    (".isort.cfg", "[settings]\n", "[settings]\nskip_glob=*\n", ["isort as `skip-glob` says: *"]),
    (".codespellrc", "[codespell]\n", "[codespell]\nskip=*.py\n", ["codespell as `skip` says: *.py"]),
    ("pyproject.toml", "", "[tool.vulture]\nmin_confidence=100\n", ["vulture up to `min-confidence` 100 (before: 80)"]),
    (".yamllint", "extends: default\n", "extends: relaxed\n", ["yamllint as `extends` says: relaxed"]),
    (".yamllint", "extends: default\n", "extends: default\nignore: |\n  *.yaml\n", ["yamllint as `ignore` says: *.yaml"]),
    (".yamllint", "", "extends: default\nrules: {line-length: {max: 999}}\n", ["yamllint up to `line-length.max` 999 (before: 80)"]),
    (".hadolint.yaml", "", "ignored: [DL3006]\n", ["hadolint:DL3006"]),
    (".hadolint.yaml", "", "override: {style: [DL3006]}\n", ["hadolint as `override.style` says: DL3006"]),
    (".shellcheckrc", "enable=all\n", "disable=SC1,SC2\n", ["shellcheck:SC1", "shellcheck:SC2", "shellcheck:all"]),
    ("p/CPPLINT.cfg", "", "filter=-build,+build/include\n", ["cpplint:build"]),
    ("p/CPPLINT.cfg", "", "filter=-\n", ["cpplint:*"]),
    (".cmakelintrc", "", "filter=-a,-b\nlinelength=999\n", ["cmakelint up to `linelength` 999 (before: 140)", "cmakelint:a", "cmakelint:b"]),
    ("cmake-format.json", "{}", '{"lint": {"disabled_codes": ["C1"], "max_branches": 99}}', ["cmake-lint up to `max-branches` 99 (before: 12)", "cmake-lint:C1"]),
    (".clang-format", "BasedOnStyle: LLVM\n", "SortIncludes: Never\n", ["clang-format as `SortIncludes` says: Never"]),
    ("p/.clang-format-ignore", "", "# x\n*.h\n", ["clang-format as `a line` says: *.h"]),
]  # fmt: skip
#: Changes that turn nothing off: a note that says so.
HARMLESS = [
    ("pylintrc", "[M]\ndisable=a,b\n", "[M]\ndisable=a\n"),
    ("pylintrc", "", "[M]\nmax-line-length=80\n"),
    ("pylintrc", "[M]\nmax-args=9\n", ""),
    ("pylintrc", "[M]\ndisable=a\n", "# comment\n[M]\ndisable = a\n"),
    ("setup.cfg", "[flake8]\nselect=E\n", "[flake8]\nselect=E,F\n"),
    ("setup.cfg", "[flake8]\nselect=E\n", "[flake8]\n"),
    (".flake8", "[flake8]\n", "[flake8]\nmax-complexity=9\n"),
    ("ruff.toml", "lint.ignore=['F401']\n", "lint.ignore=[]\n"),
    ("mypy.ini", "[mypy]\n", "[mypy]\nstrict=True\n"),
    (".bandit", "[bandit]\ntests: B1\n", "[bandit]\n"),
    ("p/CPPLINT.cfg", "filter=-a\n", "filter=-a,+a\n"),
    (".hadolint.yaml", "ignored: [DL1]\n", "ignored: []\n"),
    (".shellcheckrc", "disable=SC1\n", "enable=all\n"),
    (".yamllint", "rules: {colons: disable}\n", "extends: default\n"),
    (".clang-format", "", "BasedOnStyle: LLVM\n"),
    (".clang-format", "DisableFormat: true\n", "BasedOnStyle: Google\n"),
]
#: Changes that are none of a linter's settings: no note.
QUIET = [
    ("pyproject.toml", "[project]\nversion='1'\n", "[project]\nversion='2'\n[tool.other]\nskip=['x']\n"),
    ("pyproject.toml", "[tool.black]\nline-length=9\n", "[project]\n\n[tool.black]\nline-length = 9\n"),
    ("setup.cfg", "[metadata]\nname=a\n", "[metadata]\nname=b\n[other]\nignore=E1\n"),
    ("tox.ini", "", "[tox]\n"),
    (".flake8", "", "# nothing\n"),
    ("mypy.ini", "", "[other]\n"),
    ("elsewhere/pylintrc", "", "[M]\ndisable=all\n"),
    ("base.toml", "", "lint.ignore=['F401']\n"),
    ("p/readme.txt", "a", "b"),
    (".clang-tidy", "", "Checks: '-*'\n"),
    ("pylintrc", "[M]\ndisable=a\n", "[M]\ndisable=a\n"),
]


@pytest.mark.parametrize(("name", "before", "after", "expected"), FIRES)
def test_what_is_turned_off_is_named(tmp_path: Path, name: str, before: str, after: str, expected: list[str]) -> None:
    message = said(tmp_path, {name: before}, {name: after})[name]
    assert off(message) == expected


@pytest.mark.parametrize(("name", "before", "after"), HARMLESS)
def test_what_turns_nothing_off_says_so(tmp_path: Path, name: str, before: str, after: str) -> None:
    told = said(tmp_path, {name: before}, {name: after})
    assert list(told) == [name] and NOTHING in told[name]


@pytest.mark.parametrize(("name", "before", "after"), QUIET)
def test_what_is_no_setting_of_a_linter_is_not_told(tmp_path: Path, name: str, before: str, after: str) -> None:
    assert said(tmp_path, {name: before}, {name: after}) == {}


def test_a_nearer_file_takes_away_what_the_further_one_switches_on(tmp_path: Path) -> None:
    far = {"pylintrc": "[M]\nenable=strict-one\nmax-line-length=80\n"}
    told = said(tmp_path, far, {**far, "p/pylintrc": "[M]\n", "p/x.py": ""})
    assert list(told) == ["p/pylintrc"]
    assert off(told["p/pylintrc"]) == ["pylint up to `max-line-length` 100 (before: 80)", "pylint:strict-one"]


def test_files_that_settings_name_are_told(tmp_path: Path) -> None:
    before = {"ruff.toml": "extend='x/b.toml'\n", "x/b.toml": "", ".yamllint": "extends: x/y\nignore-from-file: x/z\n"}
    before |= {"x/y": "extends: default\n", "x/z": ""}
    after = {**before, "x/b.toml": "lint.ignore=['F401']\n", "x/y": "extends: relaxed\n", "x/z": "*.yaml\n"}
    told = said(tmp_path, before, after)
    assert set(told) == {"x/b.toml", "x/y", "x/z"}
    assert off(told["x/b.toml"]) == ["ruff:F401"]
    assert "yamllint as `ignore` says: *.yaml" in off(told["x/z"])


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("pylintrc", "no section\n"),
        ("pyproject.toml", "[tool.black\n"),
        (".yamllint", "a: [\n"),
        (".yamllint", "extends: ../out\n"),
        (".hadolint.yaml", "[]\n"),
        (".flake8", "[flake8]\nx\n[flake8\n"),
        ("cmake-format.json", "{"),
    ],
)
def test_what_cannot_be_read_is_said(tmp_path: Path, name: str, text: str) -> None:
    told = said(tmp_path, {}, {name: text})
    assert "cannot be read, so the rules that they turn off are unknown" in told[name]


# -- the table ----------------------------------------------------------------------------------------------------


def test_the_page_has_the_table() -> None:
    text = (ROOT / "docs" / "silencing.md").read_text(encoding="utf-8")
    assert silencing.page() in text, (
        "write the table anew: python -c 'from haros_ci.linters import silencing; print(silencing.page())'"
    )


def test_every_settings_file_of_the_table_is_read_at_the_base() -> None:
    names = {name for row in silencing.SETTINGS for name in row.files}
    assert names <= set(TOOL_SETTINGS)


@pytest.mark.parametrize("row", silencing.TABLE, ids=lambda row: f"{row.tool}-{row.files[0][:20]}")
def test_every_row_names_a_test_that_is_there(row: silencing.SilencingRow) -> None:
    path, _, name = row.test.partition("::")
    assert path.startswith(("tests/", "docs/"))
    file = ROOT / path.partition(" ")[0]
    assert file.is_file()
    assert not name or re.search(rf"^def {re.escape(name.partition('[')[0])}\(", file.read_text(), re.MULTILINE)
