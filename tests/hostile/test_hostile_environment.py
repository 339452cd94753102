# SPDX-License-Identifier: Apache-2.0
"""What the machine lacks or the user's shell has set is a sentence and an exit code, never a trace: real runs in bad places."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path

import forked as fork
import pytest
from commandline import haros, write

from haros_ci.config.yaml_lines import parse
from haros_ci.errors import UserError

MANIFEST = '<package format="3"><name>p</name><version>1.0.0</version><description>d</description></package>\n'
QUICK = "--isolated --profile architecture"
COMMANDS = {
    "version": "--version",
    "help": "check --help",
    "rules": "rules",
    "check": f"check {QUICK}",
    "json": f"check {QUICK} --output json",
    "model": "model --isolated",
}


@pytest.fixture
def root(tmp_path: Path) -> Path:
    return write(tmp_path / "ws", {"p/package.xml": MANIFEST, "p/a.py": "x = 1\n"})


def run(root: Path, shell: str, *, loaded: bool = False, **more: str) -> subprocess.CompletedProcess[str]:
    """*shell* in a POSIX shell, with HAROS for the command; *loaded*, what it starts is forked and has the shell's streams, directory and
    environment, but neither its limits nor an end of Python."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("GITHUB_", "HAROS_", "PYTHON")) and k != "CI"}
    kept |= {"XDG_CACHE_HOME": str(root.parent / "xdg"), **more}
    haros = f"{shlex.quote(fork.python() if loaded else sys.executable)} -I -m haros_ci"
    argv = ["bash", "-c", shell.replace("HAROS", haros)]
    return subprocess.run(argv, cwd=root, env=kept, capture_output=True, text=True, errors="replace", timeout=300)


def forked(root: Path, arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
    """``haros-ci ARGUMENTS``, where neither streams nor limits nor the start of Python are at stake: a tenth of the time."""
    return haros(*arguments.split(), cwd=root, **more)


def fine(done: subprocess.CompletedProcess[str], *codes: int) -> None:
    said = done.stdout + done.stderr
    assert done.returncode in codes, said
    assert not [word for word in ("Traceback", "internal error", "Exception ignored") if word in said], said


#: How Python itself starts and ends with such a stdout: with little to write, with a document, and with more than a buffer holds.
STARTED = [("version", ">/dev/full"), ("check", ">/dev/full"), ("help", ">&-"), ("rules", ">&-"), ("json", ">&-")]
UNWRITABLE = [*((*row, False) for row in STARTED), *((command, ">/dev/full", True) for command in COMMANDS)]


@pytest.mark.parametrize(("command", "stream", "loaded"), UNWRITABLE)
def test_a_stdout_that_cannot_be_written(root: Path, command: str, stream: str, loaded: bool) -> None:
    done = run(root, f"HAROS {COMMANDS[command]} {stream}", loaded=loaded)
    fine(done, 3)
    assert done.stderr.count("error: stdout cannot be written: ") == 1


@pytest.mark.parametrize(("command", "loaded"), [("check", False), ("rules", False), *((c, True) for c in COMMANDS)])
def test_a_reader_that_has_gone(root: Path, command: str, loaded: bool) -> None:
    done = run(root, f"HAROS {COMMANDS[command]} | true; exit ${{PIPESTATUS[0]}}", loaded=loaded)
    fine(done, 0, 1, 3)
    assert "error" not in done.stderr


@pytest.mark.parametrize(
    ("command", "stream"), [("check", "2>&-"), ("check", "<&-"), ("check", "<&- 2>&-"), ("model", "<&- 2>&-")]
)
def test_other_streams_that_are_closed(root: Path, command: str, stream: str) -> None:
    fine(run(root, f"HAROS {COMMANDS[command]} {stream}"), 0, 1)


@pytest.mark.parametrize("columns", ["abc", "-5", "0", "1", "9" * 30, "²", "1e3", " "])
def test_any_number_of_columns(root: Path, columns: str) -> None:
    fine(forked(root, COMMANDS["check"], COLUMNS=columns), 0, 1)


@pytest.mark.parametrize("command", ["check", "json", "model", "rules"])
def test_a_current_directory_that_is_gone(root: Path, command: str) -> None:
    done = run(root, f"mkdir gone && cd gone && rmdir ../gone && HAROS {COMMANDS[command]}")
    fine(done, 0, 2)
    assert done.returncode == 0 or "the current directory does not exist any more" in done.stderr


@pytest.mark.parametrize(
    ("command", "limit"), [*(("check", limit) for limit in ("-n 8", "-n 20", "-f 1", "-f 0")), ("model", "-n 20")]
)
def test_little_of_everything(root: Path, limit: str, command: str) -> None:
    fine(run(root, f"ulimit {limit}; HAROS {COMMANDS[command]}"), 0, 1, 2, 3)


def test_no_room_for_an_output(root: Path) -> None:
    done = run(root, f"HAROS check {QUICK} --output json=/dev/full --output sarif=out.sarif")
    fine(done, 3)
    assert "/dev/full: cannot be written: No space left on device" in done.stderr
    assert (root / "out.sarif").stat().st_size > 0


@pytest.mark.parametrize("pointer", [b"gitdir: a\0b\n", b"gitdir: " + b"x" * 5000 + b"\n", b"gitdir: \xff\n"])
@pytest.mark.parametrize("command", [COMMANDS["check"], f"check {QUICK} --baseline-rev HEAD", "diff HEAD --isolated"])
def test_a_git_file_that_leads_nowhere(root: Path, pointer: bytes, command: str) -> None:
    write(root, {".git": pointer})
    fine(forked(root, command), 0, 1, 2, 3)


@pytest.mark.parametrize("coding", ["ascii", "utf-16", "latin-1:strict"])
def test_any_encoding_of_streams(root: Path, coding: str) -> None:
    (root / "p" / "é.launch").write_text("<launch>")
    fine(run(root, f"HAROS {COMMANDS['check']}".replace(" -I", ""), PYTHONIOENCODING=coding, LC_ALL="C"), 0, 1)


# -- settings -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("max-file-size: 1" + "0" * 90, "too large a number of bytes"),
        ("linters: {cppcheck: {timeout: 1.0e+300}}", "too large a number of seconds"),
        ("linters: {cppcheck: {timeout: .inf}}", "too large a number of seconds"),
        ("linters: {cppcheck: {timeout: .nan}}", "must be above 0"),
        ("linters: {cppcheck: {timeout: 1" + "0" * 90 + "}}", "too large a number of seconds"),
        ('exclude: ["a\\0b"]', "holds NUL or half a character"),
        ('"a\\0b": 1', "holds NUL or half a character"),
    ],
)
def test_numbers_and_texts_that_nothing_can_hold(root: Path, line: str, said: str) -> None:
    write(root, {".haros-ci.yaml": f"# ours\n{line}\n"})
    done = forked(root, "check --profile architecture")
    fine(done, 2)
    assert ".haros-ci.yaml:2: " in done.stderr and said in done.stderr


@pytest.mark.parametrize("text", ["a: b", "a: 'é'", 'a: "\\t"', "a: 1_000_000", 'a: "\\U0001F916"'])
def test_texts_that_are_fine(text: str) -> None:
    assert parse(text.encode(), "x").top is not None


def test_a_lone_half_of_a_character_is_refused() -> None:
    with pytest.raises(UserError, match="x:1: "):
        parse(b'a: "\\ud800"', "x")
