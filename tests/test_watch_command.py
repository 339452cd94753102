# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check --watch``, driven by a script of looks instead of a clock; and once as a process."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from commandline import write

from haros_ci import cli
from haros_ci.commands import watch as watch_command
from haros_ci.commands.watch import INTERVAL, QUIET, SHARE, Watch, follow, headline
from haros_ci.errors import UserError
from haros_ci.model.location import Location
from haros_ci.results.result import BaselineState, Report, Result, Run, Tool
from haros_ci.results.rule import Level

MANIFEST = """<package format="3">
  <name>lift</name><version>1.0.0</version><description>A lift.</description>
  <maintainer email="a@example.org">A</maintainer><license>Apache-2.0</license>
</package>
"""
BROKEN = "<launch>\n  <node\n"
FLAGS = ("check", ".", "--profile", "architecture", "--no-cache", "--watch")


class Script:
    """Looks in the order given, then Ctrl-C; what was checked and slept, and a clock that only looks and sleep move."""

    def __init__(self, looks: Iterable[str], *, seconds: float = 0.0) -> None:
        self.looks = [self.state(look) for look in looks]
        self.seconds, self.time = seconds, 0.0
        self.checked: list[tuple[tuple[str, str], ...]] = []
        self.slept: list[float] = []

    @staticmethod
    def state(look: str) -> dict[str, tuple[int, int, int, int]]:
        """``a1 b2``: two files and their times."""
        return {name[0]: (int(name[1:]), 0, 0, 0) for name in look.split()}

    def look(self) -> Any:
        if not self.looks:
            raise KeyboardInterrupt
        self.time += self.seconds
        return self.looks.pop(0)

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.time += seconds

    def run(self) -> list[tuple[tuple[str, str], ...]]:
        with pytest.raises(KeyboardInterrupt):
            follow(self.look, self.checked.append, self.sleep, lambda: self.time)
        return self.checked


@pytest.mark.parametrize(
    ("looks", "checked"),
    [
        (["a1"], [()]),
        (["a1", "a1", "a1"], [()]),
        (["a1", "a2", "a2", "a2"], [(), (("a", "changed"),)]),
        (["a1", "a2", "a2 b1", "b1", "b1"], [(), (("a", "gone"), ("b", "new"))]),
        (["a1", "a2", "a2", "a3", "a3", "a3"], [(), (("a", "changed"),), (("a", "changed"),)]),
        (["a1", "a2", "a1", "a1", "a1"], [()]),
        (["", "a1", "a1", "", ""], [(), (("a", "new"),), (("a", "gone"),)]),
    ],
    ids=["start", "nothing", "one", "several at once", "again", "taken back", "came and went"],
)
def test_a_run_for_each_change_at_rest(looks: list[str], checked: list[tuple[tuple[str, str], ...]]) -> None:
    assert Script(looks).run() == checked


def test_what_changes_during_a_run_is_seen_after_it() -> None:
    script = Script(["a1", "a2", "a2", "a2"])
    seen = []
    with pytest.raises(KeyboardInterrupt):
        follow(script.look, lambda changed: seen.append((changed, len(script.looks))), script.sleep, lambda: 0.0)
    assert seen == [((), 3), ((("a", "changed"),), 1)], "the look before the first run counts, not one after it"


def test_a_file_that_is_always_written_is_checked_all_the_same() -> None:
    script = Script(["a1", *(f"a{n}" for n in range(2, 40))])
    assert len(script.run()) >= 2


def test_looking_takes_a_tenth_of_the_time_at_most() -> None:
    script = Script(["a1"] * 4, seconds=2.0)
    script.run()
    assert script.slept == [SHARE * 2.0] * 3
    quick = Script(["a1"] * 4)
    quick.run()
    assert quick.slept == [INTERVAL] * 3
    changed = Script(["a1", "a2", "a2", "a2"])
    changed.run()
    assert changed.slept == [QUIET, INTERVAL]


def test_headline() -> None:
    assert headline((("a.py", "changed"),)) == "\n--- 1 file changed: a.py"
    many = tuple((f"{n}.py", "new") for n in range(7))
    assert headline(many).endswith("4.py (new), and 2 more") and "7 files" in headline(many)
    assert "\x1b" not in headline((("a\x1b[2J\n::error::x", "changed"),))[1:]


# -- what a run says


def finding(tool: str, line: int, **more: Any) -> Result:
    return Result(tool, "r", Level.WARNING, f"m{line}", Location("a.py", line), **more)


def report(*results: Result, failed: str = "") -> Report:
    tools = sorted({"t", "u", *(r.tool for r in results)})
    return Report(
        tuple(Run(Tool(t), results=tuple(r for r in results if r.tool == t), successful=t != failed) for t in tools)
    )


def compared(watch: Watch, now: Report) -> tuple[list[str], list[str]]:
    new, gone = watch._compared(now)
    return [f"{r.tool}{r.message}" for r in new], [f"{r.tool}{r.message}" for r in gone]


@pytest.fixture
def watch() -> Watch:
    settings: Any = SimpleNamespace()
    return Watch({}, settings, {}, ())


def test_new_and_gone(watch: Watch) -> None:
    assert compared(watch, report(finding("t", 1), finding("t", 2))) == (["tm1", "tm2"], [])
    assert compared(watch, report(finding("t", 2), finding("u", 3))) == (["um3"], ["tm1"])
    assert compared(watch, report(finding("t", 2), finding("u", 3))) == ([], [])
    assert compared(watch, report()) == ([], ["tm2", "um3"])


def test_what_is_known_or_suppressed_is_not_new(watch: Watch) -> None:
    assert compared(watch, report(finding("t", 1, state=BaselineState.UNCHANGED))) == ([], [])


def test_findings_of_a_tool_that_failed_are_not_gone(watch: Watch) -> None:
    compared(watch, report(finding("t", 1), finding("u", 2)))
    assert compared(watch, report(finding("u", 2), failed="t")) == ([], [])
    assert compared(watch, report(finding("u", 2))) == ([], ["tm1"])
    compared(watch, report(finding("t", 1)))
    assert compared(watch, report(failed="t")) == ([], [])
    assert compared(watch, report(finding("t", 1))) == ([], []), "it has been there all the time"


# -- the command


@pytest.fixture
def lift(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = write(
        tmp_path / "lift", {"package.xml": MANIFEST, "launch/a.launch": BROKEN, "launch/b.launch": "<launch/>"}
    )
    monkeypatch.chdir(root)
    return root


def run(lift: Path, monkeypatch: pytest.MonkeyPatch, *steps: Any, arguments: tuple[str, ...] = ()) -> int:
    """The command; each wait takes the next of *steps*, the last is Ctrl-C."""
    left = list(steps)

    def sleep(seconds: float) -> None:
        if seconds == QUIET:
            return
        if not left:
            raise KeyboardInterrupt
        write(lift, left.pop(0))

    monkeypatch.setattr(watch_command, "sleep", sleep)
    code = cli.haros_ci.main([*FLAGS, *arguments], standalone_mode=False)
    assert isinstance(code, int)
    return code


def test_runs_say_what_changed(lift: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    steps = ({"launch/b.launch": BROKEN}, {"launch/a.launch": "<launch/>\n"})
    assert run(lift, monkeypatch, *steps) == 130
    out, err = capfd.readouterr()
    first, second, third = out.split("\n--- ")
    assert "launch/a.launch:2: error: " in first and "1 finding: 1 error" in first and "since" not in first
    assert second.startswith("1 file changed: launch/b.launch\nlaunch/b.launch:2: error: ")
    assert "2 findings: 2 errors\nsince the last run: 1 new, 0 gone\n" in second and "a.launch" not in second
    assert third.startswith("1 file changed: launch/a.launch\ngone: launch/a.launch:2: error: ")
    assert "since the last run: 0 new, 1 gone" in third
    assert err.count("watching 3 files; Ctrl-C ends") == 3 and err.endswith("\nstopped\n")
    assert "\x1b" not in out + err


def test_files_are_written_anew_and_start_no_run(
    lift: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    outputs = ("--output", "junit=out.xml", "--output", "text")
    assert run(lift, monkeypatch, {}, {"launch/a.launch": "<launch/>"}, {}, arguments=outputs) == 130
    assert "<failure" not in (lift / "out.xml").read_text()
    assert capfd.readouterr().out.count("since the last run") == 1


def test_a_mistake_in_the_project_file_is_waited_on(
    lift: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    steps = ({".haros-ci.yaml": "profile: rosy\n"}, {".haros-ci.yaml": "exclude: [launch/]\n"})
    assert run(lift, monkeypatch, *steps) == 130
    out, err = capfd.readouterr()
    assert "error: .haros-ci.yaml:1: 'profile' cannot be 'rosy'" in err
    assert "gone: launch/a.launch" in out.split("\n--- ")[2]


def test_a_directory_that_is_away_is_waited_for(
    lift: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    away = lift.with_name("away")
    moves = [lambda: (lift / "launch").rename(away), lambda: away.rename(lift / "launch")]

    def sleep(seconds: float) -> None:
        if not moves:
            raise KeyboardInterrupt
        moves.pop(0)()

    monkeypatch.setattr(watch_command, "sleep", sleep)
    assert cli.haros_ci.main([*FLAGS[:1], "launch", *FLAGS[2:]], standalone_mode=False) == 130
    assert "stopped" in capfd.readouterr().err


@pytest.mark.parametrize(
    "arguments",
    [
        ("--fix",), ("--diff",), ("--show-settings",), ("--statistics",), ("--shard", "1/2"),
        ("--output", "json"), ("--output", "text", "--output", "github"), ("--output", "markdown"),
    ],
    ids=" ".join,
)  # fmt: skip
def test_what_does_not_go_together(lift: Path, arguments: tuple[str, ...]) -> None:
    with pytest.raises(UserError, match="--watch"):
        cli.haros_ci.main([*FLAGS, *arguments], standalone_mode=False)


def test_a_mistake_at_the_start_ends_it(lift: Path) -> None:
    write(lift, {".haros-ci.yaml": "profile: rosy\n"})
    with pytest.raises(UserError, match="rosy"):
        cli.haros_ci.main(list(FLAGS), standalone_mode=False)


def test_the_real_thing_sees_a_file_and_ends_at_ctrl_c(lift: Path) -> None:
    code = "import sys; from haros_ci.cli import main; sys.exit(main(sys.argv[1:]))"
    where = str(Path(cli.__file__).resolve().parent.parent)
    path = os.pathsep.join(p for p in (where, os.environ.get("PYTHONPATH", "")) if p)
    process = subprocess.Popen(
        [sys.executable, "-c", code, *FLAGS], cwd=lift, env={**os.environ, "PYTHONPATH": path},
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
    )  # fmt: skip
    try:
        assert "watching 3 files" in read_until(process, "Ctrl-C ends\n")
        write(lift, {"launch/b.launch": BROKEN})
        said = read_until(process, "Ctrl-C ends\n")
        assert "--- 1 file changed: launch/b.launch" in said and "since the last run: 1 new, 0 gone" in said
        os.killpg(process.pid, signal.SIGINT)
        rest, _ = process.communicate(timeout=60)
    finally:
        process.kill()
        process.wait()
    assert (process.returncode, rest.decode()) == (130, "\nstopped\n")


def read_until(process: subprocess.Popen[bytes], end: str) -> str:
    """What the process writes up to *end*; fails instead of waiting for ever."""
    assert process.stdout is not None
    said, deadline = b"", time.monotonic() + 60
    while not said.endswith(end.encode()):
        ready, _, _ = select.select([process.stdout], [], [], max(0.0, deadline - time.monotonic()))
        assert ready, said
        got = os.read(process.stdout.fileno(), 65_536)
        assert got, said
        said += got
    return said.decode()
