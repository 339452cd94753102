# SPDX-License-Identifier: Apache-2.0
"""Tools that fail in every way: the run says so, is never green, and the other tools' findings are there."""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from hostile_kit import CONTROL_FINDING, Trap, assert_harmless, assert_the_rest_is_analysed

#: A tool made of a shell command, put beside the real ones before the command line is run. ``{}`` are the files.
DRIVER = """
import json, sys
from types import SimpleNamespace
from haros_ci import registry
from haros_ci.linters.linter import Command, Finding, Program, When
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

def parse(output, batch):
    for said in json.loads(output.stdout):
        path, line, message = (*said, "A fake finding.")[:3]
        yield Finding(path, Result("fake", "x", Level.WARNING, message, Location(path, line)))

registry.LINTERS = (*registry.LINTERS, SimpleNamespace(
    NAME="fake", LANGUAGES=frozenset({{"python"}}), WHEN=When.ALWAYS, COST=1.0, {trusted}
    locate=lambda options: {program},
    fingerprint=lambda workspace, options: {script!r},
    dependencies=lambda workspace, file: (),
    command=lambda program, batch: Command((*program.argv, "fake", *(file.path for file in batch.files))),
    parse=parse,
))
from haros_ci.cli import main
sys.exit(main())
"""


def driver(t: Trap, script: str, program: str = "") -> Path:
    """A made-up tool; one that has something to do outside the workspace is not confined."""
    trusted = "TRUSTED=True," if "SEEN" in script or str(t.place) in script else ""
    path = t.place / "driver.py"
    script = script.replace("PYTHON", sys.executable).replace("SEEN", str(t.place / "seen"))
    path.write_text(
        DRIVER.format(script=script, trusted=trusted, program=program or f"Program(('/bin/sh', '-c', {script!r}), '1')")
    )
    return path


@dataclass(frozen=True)
class Case:
    """A shell script in place of a tool; *says* stands in a notification."""

    name: str
    script: str
    says: str
    program: str = ""
    settings: str = ""


def saying(name: str, *findings: str) -> Case:
    """A tool that is content; *findings* are what follows the path in each."""
    said = ", ".join(f'["control.py", {finding}]' for finding in findings)
    return Case(name, f"echo '[{said}]'", "fake failed: ")


CASES = [
    Case("missing", "", "fake is not installed, so nothing was checked with it", "None"),
    Case("unstartable", "", "fake could not be started", "Program(('/no/such/program',), '1')"),
    Case("not a program", "", "fake could not be started", "Program(('/etc/passwd',), '1')"),
    Case("silent", "exit 0", "fake failed: "),
    Case("an exit code", "exit 1", "fake failed: "),
    Case("last words", "echo 'no licence left' >&2; exit 70", "fake failed: no licence left"),
    Case(
        "a trace",
        "echo 'Traceback (most recent call last):' >&2; echo 'ValueError: odd' >&2; exit 1",
        "fake failed: ValueError: odd",
    ),
    Case(
        "hostile last words",
        r"printf '\033]52;c;x\007\342\200\256::error::pwned##[error]x' >&2; exit 1",
        "fake failed: ",
    ),
    Case("a signal", "kill -SEGV $$", "fake failed: was ended by signal 11"),
    Case("aborted", "kill -ABRT $$", "fake failed: was ended by signal 6"),
    Case("garbage", "head -c 100000 /dev/urandom", "fake failed: "),
    Case("half an answer", """printf '[["control.py", 2'""", "fake failed: "),
    Case("another shape", "echo '{\"a\": [1]}'", "fake failed: "),
    Case("an answer for another file", """echo '[["../outside/secret.py", 1]]'""", "fake failed: "),
    saying("a message that is none", '2, {"text": 1}'),
    saying("line zero", "0"),
    saying("a negative line", "2", "-1"),
    saying("a line that is a text", '"2"', "3"),
    saying("a line that is a list", "[1]"),
    saying("a line that is a fraction", "1.5"),
    saying("a line beyond all numbers", "1e999", "NaN"),
    Case("deep nesting", "PYTHON -c 'print(\"[\" * 200000)'", "fake failed: "),
    Case("no end", "exec yes", "fake failed: "),
    Case("no end of complaints", "exec yes >&2", "fake failed: "),
    Case("100 MB", "exec head -c 100000000 /dev/zero", "fake failed: "),
    Case("hanging", "sleep 1000", "fake was stopped after 0.5 s", settings="linters: {fake: {timeout: 0.5}}\n"),
    Case(
        "deaf",
        "trap '' TERM INT; sleep 1000; sleep 1000",
        "fake was stopped after 0.5 s",
        settings="linters: {fake: {timeout: 0.5}}\n",
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_tool_that_fails(case: Case, trap: Trap) -> None:
    trap.write("haros.yaml", case.settings)
    outcome = trap.run("--profile=all", driver=driver(trap, case.script, case.program))
    assert outcome.code == 3, outcome.stderr
    assert outcome.says(case.says), outcome.notes()
    assert (
        "1 tool failed" in outcome.formats["text"]
        and "::error title=haros-ci::fake failed" in outcome.formats["github"]
    )
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
    succeeded = {
        run["tool"]["driver"]["name"]: run["invocations"][0]["executionSuccessful"] for run in outcome.sarif["runs"]
    }
    assert succeeded.pop("fake") is False and all(succeeded.values())


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (("--allow-tool-failure=fake",), 1),
        (("--allow-tool-failure=fake", "--fail-on=never"), 0),
        (("--allow-tool-failure=pylint",), 3),
        (("--fail-on=never",), 3),
    ],
)
def test_forgiven(arguments: tuple[str, ...], code: int, trap: Trap) -> None:
    """Forgiveness is by name, and hides nothing."""
    outcome = trap.run(*arguments, driver=driver(trap, "exit 1"))
    assert outcome.code == code
    assert outcome.says("fake failed: ") and "1 tool failed" in outcome.formats["text"]
    assert CONTROL_FINDING in outcome.findings()


def test_a_failure_is_not_remembered(trap: Trap) -> None:
    """What a tool could not say is asked again, and then reported."""
    path = driver(trap, """if [ -e SEEN ]; then echo '[["control.py", 2]]'; else touch SEEN; exit 1; fi""")
    assert trap.run(driver=path).code == 3
    outcome = trap.run("--profile=all", driver=path)
    assert outcome.code == 1 and (CONTROL_FINDING[0], 2, "x") in outcome.findings()


def test_one_file_that_a_tool_chokes_on(trap: Trap) -> None:
    """It costs itself; the tool's findings in the other files of the same process are there."""
    for name in "abcdefgh":
        trap.write(f"{name}.py", '"""Fine."""\n')
    script = """import sys, json
if "e.py" in sys.argv: sys.exit("choked")
print(json.dumps([[name, 1] for name in sys.argv[1:]]))"""
    trap.write("../script.py", script)
    outcome = trap.run("--profile=all", driver=driver(trap, f'PYTHON -I {trap.place}/script.py "$@"'))
    assert outcome.code == 3
    assert outcome.says("fake failed: choked; without a result: e.py")
    assert {path for path, _, rule in outcome.findings() if rule == "x"} == {
        f"{name}.py" for name in [*"abcdfgh", "control"]
    }
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)


HOSTILE = r"\u001b]52;c;x\u0007\n::error::pwned##[error]<img src=x>@team ![x](http://x) \u202e\ud800"


def test_a_tool_with_hostile_words(trap: Trap) -> None:
    """Neither the version that it tells nor its messages are obeyed by what shows them."""
    version = json.loads(f'"{HOSTILE}"')
    said = f"""echo '[["control.py", 2, "{HOSTILE}"]]'""".replace("\\", "\\\\")
    program = f"Program(('/bin/sh', '-c', {said!r}), {'1.' + version!r})"
    outcome = trap.run("--profile=all", driver=driver(trap, said, program))
    assert outcome.code == 1 and (CONTROL_FINDING[0], 2, "x") in outcome.findings(), outcome.notes()
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)


def test_a_daemon_that_goes_away(trap: Trap) -> None:
    """A child in a session of its own, which keeps every stream open, does not hold the run up."""
    trap.write(
        "../daemon.py",
        "import os, sys, time\nos.setsid()\n"
        "print(os.getpid(), file=open(sys.argv[1], 'w'), flush=True)\ntime.sleep(1000)\n",
    )
    script = f"PYTHON -I {trap.place}/daemon.py SEEN &"
    outcome = trap.run(driver=driver(trap, f"{script}\nwhile ! [ -s SEEN ]; do :; done; echo '[]'"))
    os.kill(int((trap.place / "seen").read_text()), signal.SIGKILL)
    assert outcome.code == 1
    assert_the_rest_is_analysed(outcome)


def test_a_child_that_stays_behind(trap: Trap) -> None:
    """What a tool leaves running in its group is ended with it."""
    outcome = trap.run(driver=driver(trap, "sleep 1000 & echo $! > SEEN; echo '[]'"))
    assert outcome.code == 1
    child = int((trap.place / "seen").read_text())
    for _ in range(1_000):  # the kernel takes a moment to take it away
        if not is_running(child):
            break
        time.sleep(0.01)
    assert not is_running(child)
    assert_the_rest_is_analysed(outcome)


def is_running(process: int) -> bool:
    """Whether a process is there and no mere zombie."""
    try:
        status = Path(f"/proc/{process}/stat").read_text()
    except FileNotFoundError:
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


BOMBS = {
    "parentheses.cpp": b"int x =\n" + b"(\n" * 20_000 + b"1" + b")\n" * 20_000 + b";\n",
    "braces.cpp": b"void f() {\n" + b"{\n" * 20_000 + b"}\n" * 20_000 + b"}\n",
    "macros.cpp": b"#define A0 x\n"
    + b"".join(b"#define A%d A%d A%d\n" % (n + 1, n, n) for n in range(60))
    + b"int A60;\n",
    "circle.cpp": b'#include "circle.hpp"\n',
    "circle.hpp": b'#include "circle.cpp"\nint x;\n',
    "lines.cpp": b"int x;\n" * 100_000,
}


def test_files_that_no_tool_gets_through(trap: Trap) -> None:
    """Sources on which real tools run for hours: they are stopped, each is named, and the rest is not held up."""
    for name, data in BOMBS.items():
        trap.write(name, data)
    tools = ("cppcheck", "cpplint", "lizard", "radon")
    trap.write("haros.yaml", f"linters: {{{', '.join(f'{tool}: {{timeout: 0.3}}' for tool in tools)}}}\n")
    outcome = trap.run()
    assert outcome.code == 3
    for tool in ("cppcheck", "cpplint"):
        assert outcome.says(f"{tool} was stopped after 0.3 s; without a result: "), outcome.notes()
    assert_harmless(trap, outcome)
    assert_the_rest_is_analysed(outcome)
