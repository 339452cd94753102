# SPDX-License-Identifier: Apache-2.0
"""The runner, with a made-up tool that does what the analysed files order it to."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from linter_samples import FakeLinter, MemoryStore, everything, workspace

from haros_ci.linters import cppcheck
from haros_ci.linters.execute import Task, execute
from haros_ci.linters.linter import Batch, Finding, LintOptions, Output, Program, Unit, When
from haros_ci.linters.process import Processes
from haros_ci.linters.run import lint
from haros_ci.linters.work import asked_for
from haros_ci.model.location import Location
from haros_ci.results.result import Result, Run
from haros_ci.results.rule import Level

CLEAN = {"a.py": "# say W1\n", "b.py": "x = 1\n", "d/c.py": "\n\n# say W2\n"}


def run(root: Path, files: dict[str, str], linter: FakeLinter | None = None, options: LintOptions | None = None) -> Run:
    (only,) = lint(
        workspace(root, files), [linter or FakeLinter()], options or LintOptions(), MemoryStore(), everything
    )
    return only


def said(run: Run) -> list[tuple[str, int | None, str]]:
    return [(r.location.path, r.location.line, r.rule) for r in run.results]


def test_results_are_sorted_and_the_version_recorded(tmp_path: Path) -> None:
    done = run(tmp_path, CLEAN)
    assert said(done) == [("a.py", 1, "W1"), ("d/c.py", 3, "W2")]
    assert (done.tool.name, done.tool.version, done.successful) == ("fake", "1.0", True)
    assert done.analysed == {"a.py", "b.py", "d/c.py"}
    assert done.notifications == ()


@pytest.mark.parametrize(
    ("order", "words"),
    [
        ("crash", "was ended by signal 11"),
        ("raise", "RuntimeError: out of ideas"),
        ("babble", "output cannot be parsed"),
        ("flood", "wrote more than it may"),
    ],
)
def test_one_bad_file_costs_only_itself(tmp_path: Path, order: str, words: str) -> None:
    done = run(tmp_path, {**CLEAN, "bad.py": f"# {order} \n", "z.py": "# say W3\n"})
    assert said(done) == [("a.py", 1, "W1"), ("d/c.py", 3, "W2"), ("z.py", 1, "W3")]
    assert not done.successful
    (note,) = done.notifications
    assert (note.level, note.tool, note.path) == (Level.ERROR, "fake", "bad.py")
    assert words in note.message and "bad.py" in note.message
    assert done.analysed == {"a.py", "b.py", "d/c.py", "z.py"}


def test_a_hanging_tool_is_stopped_and_others_go_on(tmp_path: Path) -> None:
    files = {**CLEAN, "bad.py": "# hang\n"}
    slow, other = FakeLinter("slow"), FakeLinter("other", LANGUAGES=frozenset({"cpp"}))
    space = workspace(tmp_path, {**files, "a.cpp": "# say C1\n"})
    options = LintOptions(timeouts={"slow": 0.2}, jobs=2)
    first, second = lint(space, [slow, other], options, MemoryStore(), everything)
    assert not first.successful and first.analysed == frozenset(CLEAN)
    assert said(first) == [("a.py", 1, "W1"), ("d/c.py", 3, "W2")], "healthy files of the batch keep their results"
    (note,) = first.notifications
    assert note.message == "slow was stopped after 0.2 s; without a result: bad.py" and note.path == "bad.py"
    assert second.successful and said(second) == [("a.cpp", 1, "C1")]


def test_files_on_which_a_tool_hangs_cost_a_bounded_time(tmp_path: Path) -> None:
    """A part of a batch has its share of the batch's time, but ten seconds at least."""
    files = {f"{n}.py": "# hang\n" for n in range(64)}
    space = workspace(tmp_path, files)
    task = Task(FakeLinter(), Program(("x",), "1"), LintOptions(timeout=640), space, tuple(map(Unit, space.files)))
    assert [task.timeout(n) for n in (64, 32, 16, 1)] == [640, 320, 160, 10]
    assert replace(task, options=LintOptions(timeout=4)).timeout(1) == 4


@pytest.mark.parametrize(
    ("when", "options", "runs"),
    [
        (When.ALWAYS, LintOptions(), [False]),
        (When.INSTALLED, LintOptions(enabled=frozenset({"fake"})), [False]),
        (When.ASKED, LintOptions(enabled=frozenset({"fake"})), [False]),
        (When.INSTALLED, LintOptions(), []),
        (When.ASKED, LintOptions(), []),
        (When.ALWAYS, LintOptions(disabled=frozenset({"fake"})), []),
    ],
)
def test_a_missing_tool(tmp_path: Path, when: When, options: LintOptions, runs: list[bool]) -> None:
    linter = FakeLinter(WHEN=when, installed=False)
    done = lint(workspace(tmp_path, CLEAN), [linter], options, MemoryStore(), everything)
    assert [run.successful for run in done] == runs
    assert all("not installed" in run.notifications[0].message for run in done)


@pytest.mark.parametrize(
    ("when", "options", "runs"),
    [
        (When.ALWAYS, LintOptions(), True),
        (When.INSTALLED, LintOptions(), True),
        (When.ASKED, LintOptions(enabled=frozenset({"fake"})), True),
        (When.ASKED, LintOptions(), False),
        (When.INSTALLED, LintOptions(disabled=frozenset({"fake"})), False),
        (When.ASKED, LintOptions(disabled=frozenset({"fake"})), False),
    ],
)
def test_when_a_tool_runs(tmp_path: Path, when: When, options: LintOptions, runs: bool) -> None:
    done = lint(workspace(tmp_path, CLEAN), [FakeLinter(WHEN=when)], options, MemoryStore(), everything)
    assert [run.successful for run in done] == [True] * runs


def test_a_tool_that_cannot_start(tmp_path: Path) -> None:
    class Gone(FakeLinter):
        def command(self, program, batch):  # type: ignore[no-untyped-def]
            return replace(super().command(program, batch), argv=("/nonexistent/tool",))

    done = run(tmp_path, CLEAN, Gone())
    assert not done.successful and "could not be started" in done.notifications[0].message


def test_many_bad_files_cost_bounded_work(tmp_path: Path) -> None:
    linter = FakeLinter()
    done = run(tmp_path, {f"{i:02}.py": "# crash\n" for i in range(60)}, linter)
    assert not done.successful and not done.analysed
    assert len(linter.asked) <= 17
    named = {note.path for note in done.notifications}
    assert named, "single files are named"


def test_nothing_is_missing_where_a_copy_of_another_project_is_given_up(tmp_path: Path) -> None:
    made = workspace(tmp_path, {"a.py": "# refuse no\n", "3rd/b.py": "# refuse no\n"})
    made = replace(made, files=tuple(replace(f, third_party="3rd" if "3rd" in f.path else "") for f in made.files))
    (done,) = lint(made, [FakeLinter()], LintOptions(), MemoryStore(), everything)
    assert [note.path for note in done.notifications] == ["a.py"]


@pytest.mark.parametrize(
    ("copies", "expected"),
    [
        ((), {"own.cpp", "3rd/b.cpp"}),
        (("3rd/",), {"own.cpp"}),
        (("3rd/b.cpp",), {"own.cpp", "3rd/b.cpp"}),
        (("own",), {"3rd/b.cpp"}),
    ],
)
def test_a_source_of_a_copy_is_asked_about_for_headers_that_are_none(
    tmp_path: Path, copies: tuple[str, ...], expected: set[str]
) -> None:
    files = {
        "own.h": "int a;\n",
        "own.cpp": '#include "own.h"\n',
        "3rd/b.h": "int b;\n",
        "3rd/b.cpp": '#include "b.h"\n',
    }
    made = workspace(tmp_path, files)
    made = replace(
        made, files=tuple(replace(f, third_party="3rd" if f.path.startswith(copies) else "") for f in made.files)
    )
    asked = asked_for(cppcheck.plan(made, LintOptions(), MemoryStore()), made)
    assert {unit.file.path for unit in asked} == expected


def test_a_file_given_up_is_a_notification(tmp_path: Path) -> None:
    done = run(tmp_path, {**CLEAN, "b.py": "\n# refuse\n"})
    (note,) = done.notifications
    assert (note.level, note.path, note.line) == (Level.WARNING, "b.py", 2)
    assert done.successful and "b.py" in done.analysed


def test_the_second_run_starts_nothing_and_says_the_same(tmp_path: Path) -> None:
    store, linter = MemoryStore(), FakeLinter()
    space = workspace(tmp_path, {**CLEAN, "b.py": "# refuse\n"})
    cold = lint(space, [linter], LintOptions(), store, everything)
    warm = lint(space, [linter], LintOptions(), store, everything)
    assert cold == warm and len(linter.asked) == 1


def test_the_cache_hits_in_another_directory(tmp_path: Path) -> None:
    store, linter = MemoryStore(), FakeLinter()
    lint(workspace(tmp_path / "one", CLEAN), [linter], LintOptions(), store, everything)
    shutil.rmtree(tmp_path / "one")
    lint(workspace(tmp_path / "two", CLEAN), [linter], LintOptions(), store, everything)
    assert linter.asked == [("a.py", "b.py", "d/c.py")]


@pytest.mark.parametrize(
    ("change", "again"),
    [
        ({}, set()),
        ({"b.py": "x = 2\n"}, {"a.py", "b.py"}),
        ({"settings.cfg": "new"}, {"d/c.py"}),
        ({"d/c.py": "# say W9\n"}, {"d/c.py"}),
        ({"unrelated.cfg": "new"}, set()),
    ],
)
def test_a_changed_dependency_renews_its_dependents(tmp_path: Path, change: dict[str, str], again: set[str]) -> None:
    store, needs = MemoryStore(), {"a.py": ("b.py",), "d/c.py": ("settings.cfg",)}
    files = {**CLEAN, "settings.cfg": "old", "unrelated.cfg": "old"}
    lint(workspace(tmp_path, files), [FakeLinter(needs=needs)], LintOptions(), store, everything)
    linter = FakeLinter(needs=needs)
    lint(workspace(tmp_path, {**files, **change}), [linter], LintOptions(), store, everything)
    assert {path for batch in linter.asked for path in batch} == again


@pytest.mark.parametrize("second", [FakeLinter(version="1.1"), FakeLinter(settings="other")])
def test_another_version_or_setting_renews_everything(tmp_path: Path, second: FakeLinter) -> None:
    store = MemoryStore()
    lint(workspace(tmp_path, CLEAN), [FakeLinter()], LintOptions(), store, everything)
    second.asked.clear()
    lint(workspace(tmp_path, CLEAN), [second], LintOptions(), store, everything)
    assert second.asked == [("a.py", "b.py", "d/c.py")]


def test_failures_are_not_cached(tmp_path: Path) -> None:
    store, linter = MemoryStore(), FakeLinter()
    space = workspace(tmp_path, {"a.py": "# say W1\n", "bad.py": "# crash\n"})
    for _ in range(2):
        (done,) = lint(space, [linter], LintOptions(), store, everything)
        assert not done.successful
    assert {path for _, path, _ in store.values} == {"a.py"}
    assert linter.asked[-1] == ("bad.py",)


@pytest.mark.parametrize(
    "planted",
    [
        "null",
        "[]",
        '{"rules": 1, "gave_up": []}',
        '{"rules": [["fake", "W1", [["warning"]]]], "gave_up": []}',
        '{"rules": [["fake", "W1", [["dire", "m", "a.py", 1, null, null, null]]]], "gave_up": []}',
        '{"rules": [["fake", "W1", [["warning", "m", "a.py", "1", null, null, null]]]], "gave_up": []}',
        '{"rules": [["fake", 7, [["warning", "m", "a.py", 1, null, null, null]]]], "gave_up": []}',
        '{"rules": [], "gave_up": [["m", true]]}',
    ],
)
def test_a_spoiled_cache_entry_is_a_miss(tmp_path: Path, planted: str) -> None:
    store, linter = MemoryStore(), FakeLinter()
    space = workspace(tmp_path, {"a.py": "# say W1\n"})
    (cold,) = lint(space, [linter], LintOptions(), store, everything)
    store.values = dict.fromkeys(store.values, planted)
    (warm,) = lint(space, [linter], LintOptions(), store, everything)
    assert warm == cold and len(linter.asked) == 2


def test_results_outside_the_workspace_are_dropped(tmp_path: Path) -> None:
    store = MemoryStore()
    space = workspace(tmp_path, {"a.py": "# say W1\n"})
    lint(space, [FakeLinter()], LintOptions(), store, everything)
    store.values = {key: text.replace("a.py", "../../etc/passwd") for key, text in store.values.items()}
    (warm,) = lint(space, [FakeLinter()], LintOptions(), store, everything)
    assert warm.results == ()


def test_unwanted_rules_are_left_out_but_known(tmp_path: Path) -> None:
    store, linter = MemoryStore(), FakeLinter()
    space = workspace(tmp_path, CLEAN)
    (some,) = lint(space, [linter], LintOptions(), store, lambda tool, rule, path: rule == "W2")
    (all_,) = lint(space, [linter], LintOptions(), store, everything)
    assert [r.rule for r in some.results] == ["W2"] and [r.rule for r in all_.results] == ["W1", "W2"]
    assert len(linter.asked) == 1


def test_targets_alone_are_analysed_and_reported(tmp_path: Path) -> None:
    linter = FakeLinter()
    space = workspace(tmp_path, CLEAN, targets=["d/c.py"])
    (done,) = lint(space, [linter], LintOptions(), MemoryStore(), everything)
    assert linter.asked == [("d/c.py",)] and done.analysed == {"d/c.py"} and said(done) == [("d/c.py", 3, "W2")]


def test_any_number_of_jobs_gives_the_same(tmp_path: Path) -> None:
    files = {f"{i}.py": f"# say W{i}\n# say V\n" for i in range(12)} | {"bad.py": "# crash\n"}
    seen = []
    for jobs in (1, 2, 5):
        linter = FakeLinter(BATCH_SECONDS=1e-5)
        (done,) = lint(workspace(tmp_path, files), [linter], LintOptions(jobs=jobs), MemoryStore(), everything)
        seen.append((done, sorted(linter.asked)))
    assert seen[0] == seen[1] == seen[2]
    assert len(seen[0][1]) > 3, "there is more than one batch to run"


HOSTILE_NAMES = [
    "-rf.py",
    "--init-hook=import os.py",
    "with space.py",
    "quote'\".py",
    "100%.py",
    "$(touch pwned).py",
    "`touch pwned`.py",
    ";touch pwned;.py",
    "::error file=x::boom.py",
    "ümläut-日本.py",
    "a*?[b].py",
    "@file.py",
    " leading.py",
]


@pytest.mark.parametrize("name", HOSTILE_NAMES)
def test_names_are_only_names(tmp_path: Path, name: str) -> None:
    done = run(tmp_path, {name: "# say W1\n"})
    assert said(done) == [(name, 1, "W1")] and done.successful
    assert [p.name for p in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("name", ["new\nline.py", "esc\x1b[2J.py", "bidi\u202e.py", "bell\x07.py"])
def test_unprintable_names_are_not_handed_out(tmp_path: Path, name: str) -> None:
    linter = FakeLinter()
    done = run(tmp_path, {name: "# say W1\n", "a.py": "# say W1\n"}, linter)
    assert linter.asked == [("a.py",)] and done.successful
    assert [(note.path, note.level) for note in done.notifications] == [(name, Level.WARNING)]


def test_nothing_of_our_environment_reaches_a_tool(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setenv("GITHUB_TOKEN", "secret")
    monkeypatch.setenv("PATH", f".:{tmp_path}/bin::/usr/bin")
    done = run(tmp_path, {"a.py": "# environment\n"})
    names = {result.rule for result in done.results}.pop().split()
    assert set(names) <= {"HOME", "LANG", "LC_ALL", "PATH", "TMPDIR", "LC_CTYPE"}


def test_progress_counts_files(tmp_path: Path) -> None:
    told: list[str] = []
    lint(workspace(tmp_path, CLEAN), [FakeLinter()], LintOptions(), MemoryStore(), everything, told.append)
    assert told == ["3/3 fake"]


@dataclass
class Beside(FakeLinter):
    """Reads the same output as another adapter, under a name of its own."""

    NAME: str = "fake beside"


@pytest.mark.parametrize(
    ("files", "asked_again"),
    [
        ({"a.py": "# say W1\n", "b.py": ""}, []),
        ({"a.py": "# say W1\n", "b.py": "# refuse\n"}, [("b.py",)]),
        ({"a.py": "# crash\n"}, [("a.py",)]),
    ],
)
def test_an_adapter_beside_another_starts_no_second_process(
    tmp_path: Path, files: dict[str, str], asked_again: list[tuple[str, ...]]
) -> None:
    store, linter, beside = MemoryStore(), FakeLinter(), Beside()
    space = workspace(tmp_path, files)
    lint(space, [linter], LintOptions(beside={"fake": beside}), store, everything)
    (found,) = lint(space, [beside], LintOptions(), store, everything)
    (alone,) = lint(space, [Beside()], LintOptions(), MemoryStore(), everything)
    assert beside.asked == asked_again and found == alone


@pytest.mark.parametrize("other", [Beside(version="2.0"), Beside(settings="strict")])
def test_an_adapter_beside_another_with_another_program_asks_for_itself(tmp_path: Path, other: Beside) -> None:
    store = MemoryStore()
    space = workspace(tmp_path, {"a.py": "# say W1\n"})
    lint(space, [FakeLinter()], LintOptions(beside={"fake": Beside()}), store, everything)
    lint(space, [other], LintOptions(), store, everything)
    assert other.asked == [("a.py",)]


def test_nothing_is_kept_for_an_adapter_that_nobody_wants(tmp_path: Path) -> None:
    store = MemoryStore()
    lint(workspace(tmp_path, {"a.py": ""}), [FakeLinter()], LintOptions(), store, everything)
    assert {name for name, _, _ in store.values} == {"fake"}


def test_a_run_that_is_abandoned_does_not_read_on(tmp_path: Path) -> None:
    """What a tool has said of a hostile file may take minutes to be weighed, in a thread that no signal reaches."""
    processes = Processes()
    read: list[int] = []

    class Slow(FakeLinter):
        def parse(self, output: Output, batch: Batch) -> Iterable[Finding]:
            for line in range(1, 100):
                read.append(line)
                processes.stop()
                yield Finding("a.py", Result(self.NAME, "W1", Level.WARNING, "W1 found", Location("a.py", line)))

    space, linter = workspace(tmp_path, {"a.py": ""}), Slow()
    program = linter.locate(LintOptions())
    assert program is not None
    task = Task(linter, program, LintOptions(), space, (Unit(space.files[0]),))
    done = execute(task, processes, tmp_path / "scratch")
    assert read == [1] and done.answers == ()
    assert done.failures == (("fake could not be started (the run was abandoned); without a result: a.py", ("a.py",)),)
