# SPDX-License-Identifier: Apache-2.0
"""A workspace that wants a program of its own started, or findings of its own accepted: the real command, start to finish."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, git, haros, write

PACKAGE = (
    '<?xml version="1.0"?>\n<package format="3">\n  <name>{name}</name>\n  <version>1.0.0</version>\n  <description>x</description>\n'
    '  <maintainer email="a@example.org">A</maintainer>\n  <license>Apache-2.0</license>\n</package>\n'
)
#: Leaves a mark beside it whenever it is started, and finds "bad" in the files that it gets.
SCRIPT = f"""#!{sys.executable} -IS
import os, sys
open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "started"), "w").close()
found = 0
for path in sys.argv[1:]:
    if not path.startswith("-"):
        for number, line in enumerate(open(path), 1):
            if "bad" in line:
                found = 1
                print(f"{{path}}:{{number}}:1: warning: a bad word [bad-word]")
sys.exit(found)
"""
OFF = "  cppcheck: false\n  cpplint: false\n  pylint: false\n  lizard: false\n  radon: false\n  ruff: false\n  catkin_lint: false\n"
FILE = f"linters:\n{OFF}  bad-words:\n    exec: [bad-words, '{{files}}']\n    files: ['*.words']\n"


@pytest.fixture
def ws(tmp_path: Path) -> Path:
    root = write(
        tmp_path / "ws",
        {
            "src/arm/package.xml": PACKAGE.format(name="arm"),
            "src/leg/package.xml": PACKAGE.format(name="leg"),
            "src/arm/a.words": "good\nbad\n",
            "src/leg/-b.words": "bad\n",
            ".haros-ci.yaml": FILE,
        },
    )
    tool = write(tmp_path / "bin", {"bad-words": SCRIPT}) / "bad-words"
    tool.chmod(0o755)
    return root


def check(ws: Path, *arguments: str) -> tuple[int, dict[str, Any], str]:
    path = f"{ws.parent / 'bin'}{os.pathsep}{os.environ['PATH']}"
    done = haros("check", ".", "--output", "json", *arguments, cwd=ws, PATH=path)
    return done.returncode, json.loads(done.stdout) if done.stdout else {}, done.stderr


def found(report: dict[str, Any]) -> list[tuple[str, str, str, bool]]:
    return [
        (r["path"], r["rule"], r["level"], bool(r["suppressions"]))
        for r in report["results"]
        if r["tool"] == "bad-words"
    ]


def started(ws: Path) -> bool:
    return (ws.parent / "bin" / "started").exists()


def notes(report: dict[str, Any]) -> str:
    return " ".join(note["message"] for note in report["notifications"])


BOTH = [("src/arm/a.words", "bad-word", "warning", False), ("src/leg/-b.words", "bad-word", "warning", False)]


def test_without_trust_nothing_starts(ws: Path) -> None:
    code, report, _ = check(ws)
    assert (code, found(report), started(ws)) == (0, [], False)
    assert ".haros-ci.yaml:9: linter 'bad-words' starts a program, so it is run only with --trust-config" in notes(
        report
    )


@pytest.mark.parametrize(
    "arguments", [["--select", "bad-words", "--profile", "all"], ["--isolated", "--profile", "architecture"]]
)
def test_no_other_flag_is_trust(ws: Path, arguments: list[str]) -> None:
    code, report, _ = check(ws, *arguments)
    assert not started(ws) and found(report) == [] and code == 0


def test_with_trust_it_runs_as_any_linter(ws: Path) -> None:
    code, report, _ = check(ws, "--trust-config", "--cache-dir", str(ws.parent / "cache"))
    assert started(ws) and (code, found(report)) == (1, BOTH)
    assert check(ws, "--trust-config", "--cache-dir", str(ws.parent / "cache"))[1] == report


def test_a_missing_one_is_no_success(ws: Path) -> None:
    (ws.parent / "bin" / "bad-words").unlink()
    code, report, _ = check(ws, "--trust-config")
    assert code == 3 and "bad-words is not installed" in notes(report)
    assert check(ws)[0] == 0


def test_a_program_in_the_workspace_is_not_found_on_path(ws: Path) -> None:
    (ws.parent / "bin" / "bad-words").rename(ws / "bad-words")
    done = haros(
        "check",
        ".",
        "--output",
        "json",
        "--trust-config",
        cwd=ws,
        PATH=f"{ws}{os.pathsep}.{os.pathsep}{os.environ['PATH']}",
    )
    assert done.returncode == 3 and not (ws / "started").exists()


def test_a_change_brings_no_tool_and_no_exception(ws: Path) -> None:
    """Base: no tool. Head: one, and an exception for all else. Neither takes effect, trusted or not."""
    head = (ws / ".haros-ci.yaml").read_text()
    write(ws, {".haros-ci.yaml": f"linters:\n{OFF}", "src/arm/package.xml": PACKAGE.format(name="arm")})
    commit(ws)
    broken = PACKAGE.format(name="arm").replace("a@example.org", "nobody")
    write(ws, {".haros-ci.yaml": head + "exceptions: [{rules: ['*']}]\n", "src/arm/package.xml": broken})
    commit(ws)
    code, report, _ = check(ws, "--baseline-rev", "HEAD~1", "--trust-config")
    assert not started(ws) and "differs from the base revision" in notes(report)
    assert code == 1 and [r["suppressions"] for r in report["results"] if r["state"] == "new"] == [[]]


def test_against_a_base_only_what_is_new(ws: Path) -> None:
    commit(ws)
    write(ws, {"src/arm/a.words": "good\nbad\nworse\nbad\n"})
    commit(ws)
    code, report, _ = check(ws, "--baseline-rev", "HEAD~1", "--trust-config")
    states = [(r["path"], r["line"], r["state"]) for r in report["results"] if r["tool"] == "bad-words"]
    assert code == 1 and states == [
        ("src/arm/a.words", 2, "unchanged"),
        ("src/arm/a.words", 4, "new"),
        ("src/leg/-b.words", 1, "unchanged"),
    ]
    assert git(ws, "status", "--porcelain") == ""


def test_exceptions_levels_and_packages(ws: Path) -> None:
    text = FILE + (
        "levels: {bad-words: error}\n"
        "per-package: {leg: {levels: {bad-words: note}}}\n"
        "exceptions: [{packages: [arm], rules: [bad-words], message: 'bad w.rd$', reason: it is the arm}]\n"
    )
    write(ws, {".haros-ci.yaml": text})
    code, report, _ = check(ws, "--trust-config")
    assert (code, found(report)) == (
        0,
        [("src/arm/a.words", "bad-word", "error", True), ("src/leg/-b.words", "bad-word", "note", False)],
    )
    (accepted,) = [r["suppressions"] for r in report["results"] if r["suppressions"]]
    assert accepted == [{"kind": "external", "justification": "it is the arm"}]
    assert report["counts"]["suppressed"] == 1 and "exception" not in notes(report)
    log = ws.parent / "log.sarif"
    assert check(ws, "--trust-config", "--output", f"sarif={log}")[0] == 0
    (run,) = [r for r in json.loads(log.read_text())["runs"] if r["tool"]["driver"]["name"] == "bad-words"]
    assert [result.get("suppressions") for result in run["results"]] == [
        [{"kind": "external", "justification": "it is the arm."}],
        [],
    ]


@pytest.mark.parametrize("name", ["cppcheck", "user"])
def test_a_name_that_is_taken(ws: Path, name: str) -> None:
    write(ws, {".haros-ci.yaml": f"linters:\n  {name}:\n    exec: [x]\n    files: [a]\n"})
    code, _, stderr = check(ws)
    assert code == 2 and f".haros-ci.yaml:2: haros-ci has a tool named '{name}' already" in stderr


def test_the_checks_alone_need_no_tool(ws: Path) -> None:
    code, _, _ = check(ws, "--trust-config", "--profile", "architecture")
    assert code == 0 and not started(ws)
