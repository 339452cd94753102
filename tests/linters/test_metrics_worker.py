# SPDX-License-Identifier: Apache-2.0
"""The measuring processes as they run: one bad file is a problem, the rest is measured, nothing outside is read."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from haros_ci.linters import lizard, metrics_worker, radon
from haros_ci.linters.linter import LintOptions

ADAPTERS = [pytest.param(lizard, "ok.cpp", id="lizard"), pytest.param(radon, "ok.py", id="radon")]
GOOD = {"ok.cpp": "void f() {}\n", "ok.py": "def f(): pass\n"}


def run(adapter: ModuleType, root: Path, *paths: str) -> dict[str, dict[str, Any]]:
    program = adapter.locate(LintOptions())
    assert program is not None and program.version
    request = json.dumps({"root": str(root), "files": paths}).encode()
    done = subprocess.run(program.argv, input=request, capture_output=True, check=True, cwd=root, timeout=120)
    assert done.stderr == b""
    return {answer["path"]: answer for answer in map(json.loads, done.stdout.splitlines())}


@pytest.mark.parametrize(("adapter", "name"), ADAPTERS)
def test_a_bad_file_does_not_stop_the_rest(adapter: ModuleType, name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(GOOD[name])
    (tmp_path / "empty").write_bytes(b"")
    (tmp_path / "binary").write_bytes(b"\0\1\2")
    (tmp_path / "directory").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / name)
    (tmp_path / "outside").symlink_to("/etc")
    odd = "a\nb ::error \x1b[31m --option"
    (tmp_path / odd).write_text(GOOD[name])
    names = [
        "missing",
        "binary",
        "directory",
        "link",
        "outside/passwd",
        "../" + tmp_path.name + "/../passwd",
        "empty",
        odd,
        name,
    ]
    answers = run(adapter, tmp_path, *names)
    assert list(answers) == names
    assert [n for n in names if "problem" not in answers[n]] == ["empty", odd, name]
    assert [f["name"] for f in answers[name]["functions"]] == ["f"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
@pytest.mark.parametrize(("adapter", "name"), ADAPTERS)
def test_a_pipe_does_not_block(adapter: ModuleType, name: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / name)
    assert "problem" in run(adapter, tmp_path, name)[name]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("python2.py", 'print "hello"\n'),
        ("syntax.py", "def f(:\n"),
        ("brackets.py", "(" * 5_000 + ")" * 5_000 + "\n"),
        ("minus.py", "x = " + "-" * 100_000 + "1\n"),
    ],
)
def test_what_python_refuses_is_a_problem(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / "ok.py").write_text(GOOD["ok.py"])
    answers = run(radon, tmp_path, name, "ok.py")
    assert answers[name]["problem"]
    assert "problem" not in answers["ok.py"]


def test_deep_nesting_is_measured_or_a_problem(tmp_path: Path) -> None:
    chain = "if x: pass\n" + "elif x: pass\n" * 3_000
    (tmp_path / "chain.py").write_text(chain)
    (tmp_path / "ok.py").write_text(GOOD["ok.py"])
    answers = run(radon, tmp_path, "chain.py", "ok.py")
    assert "problem" not in answers["ok.py"]
    assert answers["chain.py"].keys() & {"problem", "file"}


@pytest.mark.parametrize(("adapter", "name"), ADAPTERS)
def test_nothing_of_the_workspace_is_imported(adapter: ModuleType, name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(GOOD[name])
    for module in ("lizard", "radon", "json", "ast", "lizard_ext", "pathspec", "sitecustomize", "haros_ci"):
        (tmp_path / f"{module}.py").write_text("raise SystemExit('imported')\n")
    assert "problem" not in run(adapter, tmp_path, name)[name]


def test_a_file_that_takes_too_long_is_a_problem(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def endless(source: bytes) -> dict[str, Any]:
        while True:
            pass

    (tmp_path / "a").write_text("x")
    monkeypatch.setattr(metrics_worker, "CPU_LIMIT", 0.01)
    assert "not measured" in metrics_worker._answer(endless, str(tmp_path), "a")["problem"]


def test_a_small_file_has_little_time_and_a_large_one_no_more_than_the_limit() -> None:
    times = [metrics_worker.seconds_for(size) for size in (0, 100_000, 2_000_000)]
    assert times == [4, 10, metrics_worker.CPU_LIMIT]


@pytest.mark.parametrize("error", [RecursionError, MemoryError, IndexError, UnicodeDecodeError])
def test_a_failing_parser_is_a_problem(error: type[Exception], tmp_path: Path) -> None:
    def failing(source: bytes) -> dict[str, Any]:
        raise error("utf-8", b"", 0, 1, "") if error is UnicodeDecodeError else error

    (tmp_path / "a").write_text("x")
    assert metrics_worker._answer(failing, str(tmp_path), "a")["problem"]


@pytest.mark.parametrize(
    ("volume", "complexity", "lines", "ratio", "index"),
    [
        (0, 0, 0, 0, 100),
        (1, 1, 1, 0, (171 - 0.23) * 100 / 171),
        (8000, 50, 400, 0.0, 9.2),
        (8000, 50, 400, 0.25, 34.4),
        (1e9, 1000, 10_000, 0.0, 0),
    ],
)
def test_maintainability(volume: float, complexity: int, lines: int, ratio: float, index: float) -> None:
    assert metrics_worker.maintainability(volume, complexity, lines, ratio) == pytest.approx(index, abs=0.1)


def test_the_workers_are_quick_to_refuse_nonsense() -> None:
    program = lizard.locate(LintOptions())
    assert program is not None
    done = subprocess.run(program.argv, input=b"nonsense", capture_output=True, timeout=60)
    assert done.returncode != 0 and done.stdout == b""
    assert sys.executable == program.argv[0]
