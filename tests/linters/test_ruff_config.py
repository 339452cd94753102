# SPDX-License-Identifier: Apache-2.0
"""Of ruff's settings what stays in the workspace is passed on, through copies; the rest is named."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import pytest
from linter_samples import MemoryStore, everything, workspace

from haros_ci.linters import ruff, ruff_config, settings_files
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.model.workspace import Problem
from haros_ci.results.result import Run

UNUSED = "import os\n"


def run(root: Path, files: Mapping[str, str], store: MemoryStore | None = None) -> Run:
    if ruff.locate(LintOptions()) is None:
        pytest.skip("ruff is not installed")
    space = workspace(root, files)
    (only,) = lint(space, [ruff], LintOptions(), MemoryStore() if store is None else store, everything)
    assert only.successful, only.notifications
    return only


def rules(done: Run) -> set[str]:
    return {result.rule for result in done.results}


def chain(root: Path, files: Mapping[str, str], path: str) -> tuple[list[ruff_config.ConfigFile], list[Problem]]:
    problems: list[Problem] = []
    return list(ruff_config.chain(workspace(root, files), path, problems)), problems


# -- what is followed ---------------------------------------------------------------------------------------------

FOLLOWED = [
    ({"ruff.toml": "extend = 'base.toml'\n", "base.toml": "x = 1\n"}, "ruff.toml", ["ruff.toml", "base.toml"]),
    ({"a/ruff.toml": "extend = '../b/x'\n", "b/x": "x = 1\n"}, "a/ruff.toml", ["a/ruff.toml", "b/x"]),
    ({"a/ruff.toml": "extend = './b/../b/x'\n", "a/b/x": "x = 1\n"}, "a/ruff.toml", ["a/ruff.toml", "a/b/x"]),
    (
        {"pyproject.toml": "[tool.ruff]\nextend = 'a/pyproject.toml'\n", "a/pyproject.toml": "[tool.ruff]\nx = 1\n"},
        "pyproject.toml",
        ["pyproject.toml", "a/pyproject.toml"],
    ),
    ({"ruff.toml": "line-length = 9\n"}, "ruff.toml", ["ruff.toml"]),
]
NOT_FOLLOWED = [
    ("extend = '/etc/passwd'", "outside the workspace"),
    ("extend = '../outside.toml'", "outside the workspace"),
    ("extend = 'a/../../outside.toml'", "outside the workspace"),
    ("extend = '~/ruff.toml'", "outside the workspace"),
    ("extend = '$HOME/ruff.toml'", "outside the workspace"),
    ("extend = '${X}'", "outside the workspace"),
    ("extend = 'linked.toml'", "no such file"),
    ("extend = 'gone.toml'", "no such file"),
    ("extend = 'ruff.toml'", "extends this one"),
    ("extend = ['a.toml']", "not a text"),
    ("extend = 3", "not a text"),
]


@pytest.mark.parametrize(("files", "start", "expected"), FOLLOWED)
def test_extend_is_followed_in_the_workspace(
    tmp_path: Path, files: dict[str, str], start: str, expected: list[str]
) -> None:
    links, problems = chain(tmp_path, files, start)
    assert [link.path for link in links] == expected and not problems


@pytest.mark.parametrize(("text", "why"), NOT_FOLLOWED)
def test_extend_that_leads_out_or_nowhere_is_named(tmp_path: Path, text: str, why: str) -> None:
    root = tmp_path / "ws"
    (tmp_path / "outside.toml").write_text("lint.ignore = ['F401']\n")
    done = run(root, {"ruff.toml": f"{text}\nlint.select = ['F401']\n", "a.py": UNUSED})
    assert rules(done) == {"F401"}
    (note,) = [n for n in done.notifications if n.path == "ruff.toml"]
    assert why in note.message and str(tmp_path) not in note.message


def test_a_link_is_no_file_of_the_workspace(tmp_path: Path) -> None:
    from haros_ci.workspace.discover import discover

    (tmp_path / "ws").mkdir()
    (tmp_path / "outside.toml").write_text("lint.ignore = ['F401']\n")
    (tmp_path / "ws" / "linked.toml").symlink_to(tmp_path / "outside.toml")
    (tmp_path / "ws" / "ruff.toml").write_text("extend = 'linked.toml'\n")
    problems: list[Problem] = []
    links = ruff_config.chain(discover(tmp_path / "ws", (".",)), "ruff.toml", problems)
    assert [link.path for link in links] == ["ruff.toml"] and "no such file" in problems[0].message


def test_circles_and_long_chains_end(tmp_path: Path) -> None:
    circle = {"ruff.toml": "extend = 'b.toml'\n", "b.toml": "extend = 'ruff.toml'\n"}
    links, problems = chain(tmp_path / "circle", circle, "ruff.toml")
    assert [link.path for link in links] == ["ruff.toml", "b.toml"]
    assert [problem.path for problem in problems] == ["b.toml"]
    long = {f"{n}.toml": f"extend = '{n + 1}.toml'\n" for n in range(50)}
    links, problems = chain(tmp_path / "long", long, "0.toml")
    assert len(links) == ruff_config.LONGEST_CHAIN and "extend each other" in problems[0].message


# -- what is passed on --------------------------------------------------------------------------------------------


def test_a_chain_means_the_same_as_in_place(tmp_path: Path) -> None:
    files = {
        "a/ruff.toml": "extend = '../shared.toml'\nlint.extend-select = ['D100']\n",
        "shared.toml": "extend = 'p/pyproject.toml'\n[lint]\nselect = ['F', 'UP007', 'UP045']\n[lint.per-file-ignores]\n"
        "'a/x.py' = ['F401']\n",
        "p/pyproject.toml": "[project]\nname = 'p'\nrequires-python = '>=3.12'\n[tool.black]\nx = 2024-01-01\n"
        "[tool.ruff]\nline-length = 300\n",
        "a/x.py": UNUSED,
        "a/y.py": "import os\nfrom typing import Optional\n\nX: Optional[int] = None\n",
        "z.py": UNUSED,
    }
    done = run(tmp_path, files)
    assert {(r.location.path, r.rule) for r in done.results} == {
        ("a/x.py", "D100"),
        ("a/y.py", "D100"),
        ("a/y.py", "F401"),
        ("a/y.py", "UP045"),  # of Python 3.10 and later, as the last file of the chain says
        ("z.py", "F401"),
    }
    assert not done.notifications


@pytest.mark.parametrize("text", ["fix = true\nunsafe-fixes = true\n", "fix-only = true\n", "show-fixes = true\n"])
def test_nothing_is_mended(tmp_path: Path, text: str) -> None:
    assert rules(run(tmp_path, {"ruff.toml": text, "a.py": UNUSED})) == {"F401"}
    assert (tmp_path / "a.py").read_text() == UNUSED


@pytest.mark.parametrize(
    "text",
    [
        "cache-dir = '../cache'\n",
        "output-format = 'sarif'\n",
        "required-version = '==0.0.1'\n",
        "respect-gitignore = true\n",
        "src = ['~/x', '$HOME', '/etc', '../..', 3]\n",
        "[analyze]\ndirection = 'sideways'\n",
        "not TOML [",
        "a" + ".a" * 5000 + " = 1\n",
        "x = 2024-01-01\n",
    ],
)
def test_what_leads_elsewhere_or_stops_ruff_is_left_out(tmp_path: Path, text: str) -> None:
    root = tmp_path / "ws"
    done = run(root, {"ruff.toml": text, "a.py": UNUSED, ".gitignore": "a.py\n"})
    assert rules(done) == {"F401"}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ws"]
    named = [n.message for n in done.notifications]
    expected = "`src`" if text.startswith("src") else "not valid TOML" if text.startswith(("not", "a.")) else None
    assert (len(named) == 1 and expected in named[0]) if expected else not named


VALUES: list[dict[str, Any]] = [
    {"a": 1, "b": -2.5, "c": True, "d": "x\ny\x7f\"'\\ü\u2028", "e": []},
    {"lint": {"select": ["A", "B"], "per-file-ignores": {"a b/*.py": ["E1"], "": []}}},
    {"deep": {"x": {"y": [{"z": [1, [2]]}]}}},
    {"with space": {"'": 1}},
]


@pytest.mark.parametrize("value", VALUES)
def test_a_document_is_read_as_it_was_written(value: dict[str, Any]) -> None:
    assert settings_files.tables(ruff_config.toml_text(value)) == value


@pytest.mark.parametrize("value", [math.inf, math.nan, None, object(), b"x"])
def test_what_ruff_has_no_use_for_is_not_written(value: object) -> None:
    assert ruff_config.toml_text({"a": value, "b": [value], "c": {"d": value}, "e": 1}) == '"e" = 1\n'


# -- what results depend on ---------------------------------------------------------------------------------------

FILES = {
    "a/ruff.toml": "extend = '../b.toml'\n",
    "b.toml": "extend = 'c.toml'\n",
    "c.toml": "lint.select = ['F401', 'I001', 'INP001']\n",
    "a/x.py": "import os\nimport helper\n",
    "y.py": UNUSED,
}


def keys(root: Path, files: Mapping[str, str]) -> dict[str, str]:
    store = MemoryStore()
    run(root, files, store)
    return {path: key for tool, path, key in store.values if tool == "ruff"}


@pytest.mark.parametrize(
    ("change", "renewed"),
    [
        ({"c.toml": "lint.select = []\n"}, {"a/x.py"}),
        ({"b.toml": ""}, {"a/x.py"}),
        ({"a/ruff.toml": "extend = '../c.toml'\n"}, {"a/x.py"}),
        ({"ruff.toml": "lint.ignore = ['F401']\n"}, {"y.py"}),
        ({"a/__init__.py": ""}, {"a/x.py", "y.py"}),
        ({"helper.py": ""}, {"a/x.py", "y.py"}),
        ({"d.toml": "lint.select = []\n"}, set()),
        ({"README.md": "x"}, set()),
        ({}, set()),
    ],
)
def test_files_of_the_chain_and_modules_are_in_the_key(
    tmp_path: Path, change: dict[str, str], renewed: set[str]
) -> None:
    before, after = keys(tmp_path / "before", FILES), keys(tmp_path / "after", {**FILES, **change})
    assert {path for path in before if before[path] != after[path]} == renewed


def test_the_execute_bit_is_in_the_key(tmp_path: Path) -> None:
    from dataclasses import replace

    def units(executables: Iterable[str] | None) -> list[str]:
        space = workspace(tmp_path, {"x.py": "#!/usr/bin/python3\n", "y.py": ""})
        space = replace(space, executables=None if executables is None else frozenset(executables))
        return [json.dumps([u.salt]) for u in ruff.plan(space, LintOptions(), MemoryStore())]

    none, one = units([]), units(["x.py"])
    assert none[0] != one[0] and none[1] == one[1]
