# SPDX-License-Identifier: Apache-2.0
"""A tool that says which file it is at, and does not get on: that file is left out, with what includes it; the others are analysed."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest
from linter_samples import FakeLinter, MemoryStore, everything, workspace

from haros_ci.linters import process, pylint
from haros_ci.linters.linter import Batch, Command, Finding, LintOptions, Output, Program
from haros_ci.linters.run import lint
from haros_ci.model.location import Location
from haros_ci.results.result import Result, Run
from haros_ci.results.rule import Level

TOOL = """
import pathlib, sys, time
for path in sys.argv[1:]:
    print(f"Checking {path} ...", flush=True)
    text = pathlib.Path(path).read_text()
    if "slow" in text:
        for _ in range(8):
            time.sleep(0.2)
            print(f"Checking {path}: CONFIGURATION...", flush=True)
    if "hang" in text:
        time.sleep(600)
    print(f"found {path}", file=sys.stderr)
"""


class Telling(FakeLinter):
    def command(self, program: Program, batch: Batch) -> Command:
        made = super().command(program, batch)
        paths = tuple(f"{batch.workspace.root}/{file.path}" for file in batch.files)
        argv = (sys.executable, "-I", "-c", TOOL, *paths)
        return replace(made, argv=argv, progress=re.compile(rb"^Checking (.+?) \.\.\.$", re.MULTILINE))

    def parse(self, output: Output, batch: Batch) -> Iterable[Finding]:
        for file in batch.files:
            if output.stderr.decode().count(f"/{file.path}\n"):
                yield Finding(file.path, Result(self.NAME, "W", Level.WARNING, "W found", Location(file.path, 1)))


def run(root: Path, files: dict[str, str], needs: dict[str, tuple[str, ...]]) -> tuple[Run, Telling]:
    linter = Telling(needs=needs)
    (only,) = lint(workspace(root, files), [linter], LintOptions(), MemoryStore(), everything)
    return only, linter


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "STALL", 1.0)
    monkeypatch.setattr(process, "_IMPATIENCE", (1,))


def test_one_file_is_left_out_and_the_others_are_analysed(tmp_path: Path) -> None:
    done, linter = run(tmp_path, {"a.py": "", "b.py": "hang", "c.py": "", "d.py": "slow"}, {})
    assert [result.location.path for result in done.results] == ["a.py", "c.py", "d.py"]
    (note,) = done.notifications
    assert note.message == "fake was stopped after 1 s with b.py; without a result: b.py" and note.path == "b.py"
    assert linter.asked == [("a.py", "b.py", "c.py", "d.py"), ("a.py", "c.py", "d.py")]


def test_what_includes_it_is_not_tried(tmp_path: Path) -> None:
    files = {"a.py": "", "b.py": "hang", "c.py": "hang", "d.py": ""}
    done, linter = run(tmp_path, files, {"c.py": ("b.py",)})
    assert [result.location.path for result in done.results] == ["a.py", "d.py"]
    assert ("a.py",) in linter.asked and sum("b.py" in paths or "c.py" in paths for paths in linter.asked) == 1
    (note,) = done.notifications
    assert note.message == "fake was stopped after 1 s with b.py; without a result: b.py, c.py"


def test_after_two_files_what_shares_a_header_with_both_is_not_tried(tmp_path: Path) -> None:
    files = {"a.py": "hang", "b.py": "hang", "c.py": "hang", "d.py": "", "e.py": ""}
    needs = {"a.py": ("x.py", "y.py"), "b.py": ("x.py",), "c.py": ("x.py",), "d.py": ("y.py",)}
    done, linter = run(tmp_path, files, needs)
    assert [result.location.path for result in done.results] == ["d.py", "e.py"]
    assert len(linter.asked) == 3
    assert sorted(note.message.partition(": ")[2] for note in done.notifications) == ["a.py", "b.py, c.py"]


def test_the_search_ends(tmp_path: Path) -> None:
    done, linter = run(tmp_path, {f"f{number}.py": "hang" for number in range(8)}, {})
    assert done.results == () and len(linter.asked) == 4
    lost = sorted(note.message.partition(": ")[2] for note in done.notifications)
    assert lost == ["f0.py", "f1.py", "f2.py", "f3.py, f4.py, f5.py and 2 more"]


def test_the_more_files_stall_the_less_time_the_next_one_has(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "_IMPATIENCE", (1, 3, 6, 12))
    done, _ = run(tmp_path, {f"f{number}.py": "hang" for number in range(4)}, {})
    times = [
        message.partition(" after ")[2].partition(" s ")[0] for message in sorted(n.message for n in done.notifications)
    ]
    assert sorted(map(float, times)) == pytest.approx([1 / 12, 1 / 6, 1 / 3, 1], rel=0.01)


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("AST for src/a.py", "src/a.py"),
        ("AST for ./a b.py", "a b.py"),
        ("src/a.py (1 of 2)", "src/a.py"),
        ("./src/a (12 of 240)", "src/a"),
        ("AST for a (1 of 2)", "a"),
        ("Get ASTs.", None),
        ("Linting 2 modules.", None),
        ("The Zen of Python, by Tim Peters", None),
        ("a.py (1 of 2).", None),
        ("{", None),
        ("", None),
    ],
)
def test_what_pylint_is_at(line: str, name: str | None) -> None:
    found = pylint.PROGRESS.findall(f"\n{line}\n".encode())
    assert found == ([] if name is None else [name.encode()])


def test_pylint_says_what_it_is_at(tmp_path: Path) -> None:
    """The installed one: the file at which it stops is the last that it names."""
    space = workspace(tmp_path, {"a.py": "x = y\n", "No files to lint: exiting.py": "z = y\n"})
    program = pylint.locate(LintOptions())
    assert program is not None
    (tmp_path / "scratch").mkdir()
    batch = Batch(space, space.files, LintOptions(), tmp_path / "scratch")
    command = pylint.command(program, batch)
    done = subprocess.run(command.argv, cwd=tmp_path, capture_output=True, check=False)
    assert command.progress is not None and set(command.progress.findall(done.stdout)) == {
        b"a.py",
        b"No files to lint: exiting.py",
    }
    found = [
        item
        for item in pylint.parse(Output(done.stdout, done.stderr, done.returncode), batch)
        if isinstance(item, Finding)
    ]
    assert {item.unit for item in found if item.result.rule == "undefined-variable"} == {
        file.path for file in space.files
    }


def test_a_tool_that_names_no_file_has_the_time_of_its_batch(tmp_path: Path) -> None:
    linter = Silent()
    (done,) = lint(workspace(tmp_path, {"a.py": "slow"}), [linter], LintOptions(), MemoryStore(), everything)
    assert [result.location.path for result in done.results] == ["a.py"]


class Silent(Telling):
    def command(self, program: Program, batch: Batch) -> Command:
        return replace(super().command(program, batch), progress=re.compile(rb"^at (.+)$", re.MULTILINE))


def test_a_tool_that_has_lost_enough_time_is_not_started_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "LOST", 0.5)
    done, linter = run(tmp_path, {f"f{number}.py": "hang" for number in range(3)}, {})
    assert len(linter.asked) == 2
    assert sorted(note.message for note in done.notifications) == [
        "fake could not be started (it has been stopped for 0.5 s in all); without a result: f1.py, f2.py",
        "fake was stopped after 1 s with f0.py; without a result: f0.py",
    ]
