# SPDX-License-Identifier: Apache-2.0
"""``haros-ci check - --stdin-filename FILE``: the findings of a buffer, in the place of a file."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import forked
import pytest
from commandline import cache_home, write
from test_command import BAD, DEFAULT_TOOLS, GOOD, MANIFEST

from haros_ci.commands.standard_input import settled
from haros_ci.errors import UserError

NODE = '#include "arm/limits.hpp"\nint half(int all)\n{\n  return all / PARTS;\n}\n'


def check(text: str | bytes, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("GITHUB_", "HAROS_"))}
    command = [forked.python(), "-m", "haros_ci", "check", *arguments]
    data = text.encode() if isinstance(text, str) else text
    done = subprocess.run(
        command, cwd=cwd, input=data, capture_output=True, env={**kept, "XDG_CACHE_HOME": cache_home()}, check=False
    )
    return subprocess.CompletedProcess(command, done.returncode, done.stdout.decode(), done.stderr.decode())


@pytest.fixture
def lift(tmp_path: Path) -> Path:
    return write(tmp_path / "lift", {"package.xml": MANIFEST, "lift/doors.py": GOOD, **DEFAULT_TOOLS})


def test_the_buffer_counts_and_not_the_file(lift: Path) -> None:
    done = check(BAD, "-", "--stdin-filename", "lift/doors.py", "--quiet", cwd=lift)
    assert done.returncode == 1
    assert done.stdout.startswith("lift/doors.py:4:1: warning: Dangerous default value [] as argument.")
    assert "def close(doors=[]):" in done.stdout, "the line is the buffer's"
    assert done.stderr == ""
    assert (lift / "lift/doors.py").read_text() == GOOD


@pytest.mark.parametrize(
    ("place", "name"),
    [(".", "lift/doors.py"), ("lift", "doors.py"), (".", "./lift/../lift/doors.py"), (".", "ABSOLUTE")],
)
def test_a_good_buffer_of_a_bad_file(lift: Path, place: str, name: str) -> None:
    write(lift, {"lift/doors.py": BAD})
    name = name.replace("ABSOLUTE", str(lift / "lift/doors.py"))
    done = check(GOOD, "-", "--stdin-filename", name, cwd=lift / place)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "reporting on 1 file" in done.stdout


def test_a_file_that_is_not_on_disk_yet(lift: Path) -> None:
    done = check(BAD, "-", "--stdin-filename", "lift/gates.py", "--output", "json", cwd=lift)
    assert done.returncode == 1
    assert [result["path"] for result in json.loads(done.stdout)["results"]] == ["lift/gates.py"]
    assert not (lift / "lift/gates.py").exists()


def test_a_script_without_an_ending(lift: Path) -> None:
    done = check("#!/usr/bin/env python3\n" + BAD, "-", "--stdin-filename", "lift/open", "--quiet", cwd=lift)
    assert done.stdout.startswith("lift/open:5:1: warning: Dangerous default value")


def test_other_files_have_what_is_on_disk(tmp_path: Path) -> None:
    write(
        tmp_path,
        {"package.xml": MANIFEST, "include/arm/limits.hpp": "#define PARTS 0\n", "src/half.cpp": "", **DEFAULT_TOOLS},
    )
    done = check(NODE, "-", "--stdin-filename", "src/half.cpp", "--select", "zerodiv", "--quiet", cwd=tmp_path)
    assert "src/half.cpp:4" in done.stdout and "[cppcheck:zerodiv]" in done.stdout, done.stdout + done.stderr
    done = check("#define PARTS 2\n", "-", "--stdin-filename", "include/arm/limits.hpp", "--quiet", cwd=tmp_path)
    assert done.returncode == 0, "findings in other files are not reported"


def test_the_systems_with_the_buffer_in_its_place(tmp_path: Path) -> None:
    write(tmp_path, {"package.xml": MANIFEST, "launch/up.launch": "<launch/>\n"})
    done = check(
        "<launch><node\n", "-", "--stdin-filename", "launch/up.launch", "--profile", "architecture", cwd=tmp_path
    )
    assert "launch/up.launch:" in done.stdout and "[haros-ci:malformed-launch-file]" in done.stdout


def test_a_baseline_file_holds(lift: Path) -> None:
    write(lift, {"lift/doors.py": BAD})
    command = [forked.python(), "-m", "haros_ci", "baseline", "create", "--no-cache"]
    subprocess.run(command, cwd=lift, capture_output=True, check=True)
    done = check("# Doors.\n" + BAD, "-", "--stdin-filename", "lift/doors.py", cwd=lift)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("text", "arguments", "message"),
    [
        ("", ["-"], "- needs a name"),
        ("", ["--stdin-filename", "lift/doors.py"], "--stdin-filename is for standard input"),
        ("", ["-", ".", "--stdin-filename", "lift/doors.py"], "- is the only path of a run"),
        ("", ["-", "--stdin-filename", "lift"], "no file can have this name"),
        ("", ["-", "--stdin-filename", "lost/doors.py"], "no file can have this name"),
        ("x" * 2_000_001, ["-", "--stdin-filename", "lift/doors.py"], "standard input has more than 2000000 bytes"),
        ("", ["-", "--stdin-filename", "link.py"], "a symbolic link out of the workspace"),
    ],
)  # fmt: skip
def test_mistakes_are_said_in_a_line(lift: Path, text: str, arguments: list[str], message: str) -> None:
    (lift / "link.py").symlink_to("/etc/hostname")
    done = check(text, *arguments, cwd=lift)
    assert done.returncode == 2
    assert done.stdout == ""
    error, help = done.stderr.splitlines()
    assert error.startswith("error: ") and message in error
    assert help.startswith("help: ")


@pytest.mark.parametrize("option", ["fix", "diff", "watch", "shard", "trust_config", "baseline_rev"])
def test_what_needs_files_on_disk_is_refused(option: str) -> None:
    with pytest.raises(UserError, match=f"--{option.replace('_', '-')} does not go with -"):
        settled({"paths": ("-",), "stdin_filename": "a.py", option: "1"})


@pytest.mark.parametrize(
    "data", [b"", b"\0", b"\xff\xfe", b"\xef\xbb\xbfx = 1\n", b"\xe9 = 1\n", b"x" * 6000, b"def f(:\n", b"\r\r\n"]
)
def test_any_bytes(lift: Path, data: bytes) -> None:
    done = check(data, "-", "--stdin-filename", "lift/doors.py", cwd=lift)
    assert done.returncode in (0, 1), done.stderr
    assert "Traceback" not in done.stderr


def test_a_closed_standard_input(lift: Path) -> None:
    command = [sys.executable, "-m", "haros_ci", "check", "-", "--stdin-filename", "lift/doors.py"]
    done = subprocess.run(["sh", "-c", 'exec "$@" <&-', "sh", *command], cwd=lift, capture_output=True, check=False)
    assert done.returncode in (0, 2), done.stderr
    assert b"Traceback" not in done.stderr
