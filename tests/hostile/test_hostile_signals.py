# SPDX-License-Identifier: Apache-2.0
"""Real signals to real runs, at several moments: the exit code says which, one line is printed, and nothing is left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from commandline import GIT, commit, haros, write

from haros_ci import cli
from haros_ci.interruption import Interrupted

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="/proc")

ENDING = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT]
MANIFEST = '<package format="3"><name>p</name><version>1.0.0</version><description>d</description></package>\n'
#: A linter that takes its time, and so does what it has started.
SLOW = """#!{python}
import subprocess, sys, time
if "--version" in sys.argv:
    print("{name} version 20914")
elif "child" not in sys.argv:
    subprocess.Popen([sys.executable, __file__, "child"])
    time.sleep(600)
else:
    time.sleep(600)
"""
LINE = '  ros::Publisher p{n} = n.advertise<std_msgs::String>("topic{n}", 1); if (argc == {n}) {{ ros::param::get("a{n}", argc); }}\n'
LINTER = ("check", "--isolated", "--select", "xmllint")
DEADLINE = 120


def sources(files: int, lines: int) -> dict[str, str]:
    """As many C++ files, each of them a program."""
    body = "".join(LINE.format(n=number) for number in range(lines))
    text = f"#include <ros/ros.h>\nint main(int argc, char** argv) {{\n  ros::NodeHandle n;\n{body}}}\n"
    built = "".join(f"add_executable(node{number} src/a{number}.cpp)\n" for number in range(files))
    return {
        "p/package.xml": MANIFEST,
        "p/CMakeLists.txt": f"project(p)\n{built}",
        **{f"p/src/a{number}.cpp": f"// {number}\n{text}" for number in range(files)},
    }


@dataclass(frozen=True)
class Place:
    """Where a run happens; its name is in every command line of it."""

    top: Path

    @property
    def root(self) -> Path:
        return self.top / "ws"

    def start(self, *arguments: str, **options: object) -> subprocess.Popen[bytes]:
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("GITHUB_", "HAROS_", "GIT_")) and k != "CI"}
        for name in ("tmp", "xdg", "bin"):
            (self.top / name).mkdir(exist_ok=True)
        more = {"TMPDIR": str(self.top / "tmp")}
        path = os.pathsep.join((str(self.top / "bin"), os.environ["PATH"]))
        options.setdefault("preexec_fn", as_by_default)
        return subprocess.Popen(
            [sys.executable, "-I", "-m", "haros_ci", *arguments, "--cache-dir", str(self.top / "xdg")],
            cwd=self.root,
            env={**kept, **GIT, **more, "PATH": path},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
            **options,  # type: ignore[call-overload]
        )

    def slow_linter(self, name: str = "xmllint") -> None:
        write(self.top, {f"bin/{name}": SLOW.format(python=sys.executable, name=name)})
        (self.top / "bin" / name).chmod(0o755)

    def processes(self) -> list[int]:
        """Those that run because of this place, without zombies."""
        found = []
        for name in filter(str.isdecimal, os.listdir("/proc")):
            try:
                line = Path("/proc", name, "cmdline").read_bytes()
                state = Path("/proc", name, "stat").read_text().rpartition(")")[2].split()[0]
            except OSError:
                continue
            if str(self.top).encode() in line and state != "Z" and int(name) != os.getpid():
                found.append(int(name))
        return found

    def left(self) -> list[str]:
        """Temporary files, and drafts in the cache and in the workspace."""
        drafts = [path for path in self.top.rglob("*") if path.name.startswith((".new-", ".haros-ci-"))]
        return [str(path.relative_to(self.top)) for path in (*(self.top / "tmp").rglob("*"), *drafts)]


def as_by_default() -> None:
    """The signals have their usual effect, also where the tests run under nohup."""
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


def wait(what: Callable[[], object], process: subprocess.Popen[bytes] | None = None) -> None:
    """Until *what* holds; fails if the run is over before."""
    end = time.monotonic() + DEADLINE
    while not what():
        assert process is None or process.poll() is None, "the run was over too soon"
        assert time.monotonic() < end, "it never came to that"
        time.sleep(0.01)


def workers(place: Place) -> bool:
    return len(place.processes()) > 1


def tool(place: Place) -> bool:
    """The linter and its child are at work."""
    return sum(b"bin/xmllint" in command_line(pid) for pid in place.processes()) >= 2


def command_line(pid: int) -> bytes:
    """What a process was started with; nothing of one that has ended since."""
    try:
        return Path("/proc", str(pid), "cmdline").read_bytes()
    except OSError:
        return b""


def base(place: Place) -> bool:
    return any(path.name.startswith("haros-ci-base-") for path in (place.top / "tmp").iterdir())


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


def ended(place: Place, process: subprocess.Popen[bytes], code: int, name: str) -> None:
    """The run is over as it should be, and another one finds nothing amiss."""
    out, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == code, err.decode()
    assert (out, err.decode()) == (b"", f"error: ended by {name} before the run was complete\n")
    wait(lambda: not place.processes())
    assert place.left() == []


@pytest.mark.parametrize(("jobs", "number"), [("1", signal.SIGTERM), *(("4", number) for number in ENDING)])
def test_while_a_linter_runs(place: Place, jobs: str, number: signal.Signals) -> None:
    write(place.root, {"p/package.xml": MANIFEST, "p/launch/a.launch": "<launch/>\n"})
    place.slow_linter()
    process = place.start(*LINTER, "-j", jobs)
    wait(lambda: tool(place), process)
    process.send_signal(number)
    ended(place, process, 128 + number, number.name)
    assert haros("check", "--isolated", cwd=place.root).returncode in (0, 1)


@pytest.mark.parametrize("number", ENDING)
def test_while_files_are_read_by_several_processes(place: Place, number: signal.Signals) -> None:
    write(place.root, sources(60, 120))
    process = place.start("model", "--isolated")
    wait(lambda: workers(place), process)
    process.send_signal(number)
    ended(place, process, 128 + number, number.name)


def test_a_terminal_sends_it_to_all_of_them(place: Place) -> None:
    write(place.root, sources(60, 120))
    process = place.start("model", "--isolated")
    wait(lambda: workers(place), process)
    os.killpg(process.pid, signal.SIGINT)
    ended(place, process, 130, "SIGINT")


def test_nobody_outlives_a_parent_that_was_killed(place: Place) -> None:
    write(place.root, sources(60, 120))
    process = place.start("model", "--isolated")
    wait(lambda: workers(place), process)
    process.kill()
    process.communicate(timeout=DEADLINE)
    wait(lambda: not place.processes())


@pytest.mark.parametrize("command", ["check", "diff"])
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_while_the_base_revision_is_read(place: Place, command: str, number: signal.Signals) -> None:
    write(place.root, sources(80, 60))
    commit(place.root)
    write(place.root, {f"p/src/a{n}.cpp": f"int a{n}();\n" for n in range(40)})
    words = {
        "check": ("check", "--isolated", "--profile", "architecture", "--baseline-rev", "HEAD"),
        "diff": ("diff", "HEAD", "--isolated"),
    }
    process = place.start(*words[command])
    wait(lambda: base(place), process)
    process.send_signal(number)
    ended(place, process, 128 + number, number.name)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT])
def test_while_it_waits_for_changes(place: Place, number: signal.Signals) -> None:
    write(place.root, {"p/package.xml": MANIFEST})
    process = place.start("check", "--isolated", "--profile", "architecture", "--watch")
    assert process.stderr is not None
    while b"Ctrl-C ends" not in process.stderr.readline():
        assert process.poll() is None
    process.send_signal(number)
    _, err = process.communicate(timeout=DEADLINE)
    assert (process.returncode, err.decode()) == (
        128 + number,
        f"error: ended by {number.name} before the run was complete\n",
    )
    assert place.left() == []


def test_more_signals_change_nothing(place: Place) -> None:
    write(place.root, {"p/package.xml": MANIFEST, "p/launch/a.launch": "<launch/>\n"})
    place.slow_linter()
    process = place.start(*LINTER)
    wait(lambda: tool(place), process)
    for _ in range(50):
        process.send_signal(signal.SIGTERM)
    ended(place, process, 143, "SIGTERM")


@pytest.mark.parametrize("number", ENDING)
def test_what_was_ignored_before_stays_ignored(place: Place, number: signal.Signals) -> None:
    """As nohup has it."""
    write(place.root, {"p/package.xml": MANIFEST, "p/launch/a.launch": "<launch/>\n"})
    place.slow_linter()
    process = place.start(*LINTER, preexec_fn=lambda: signal.signal(number, signal.SIG_IGN))
    wait(lambda: tool(place), process)
    process.send_signal(number)
    other = signal.SIGTERM if number != signal.SIGTERM else signal.SIGHUP
    process.send_signal(other)
    ended(place, process, 128 + other, other.name)


@pytest.mark.parametrize("after", range(0, 100, 20))
def test_at_any_moment(place: Place, after: int) -> None:
    """Also while modules are loaded, and while temporary files are made and removed."""
    write(place.root, sources(6, 4))
    commit(place.root)
    process = place.start("check", "--isolated", "--profile", "architecture", "--baseline-rev", "HEAD")
    time.sleep(after / 100)
    process.send_signal(signal.SIGTERM)
    out, err = process.communicate(timeout=DEADLINE)
    assert process.returncode in (143, -signal.SIGTERM, 0, 1), err.decode()
    assert "Traceback" not in err.decode() and "ignored" not in err.decode()
    wait(lambda: not place.processes())
    assert place.left() == []


# -- the pieces ---------------------------------------------------------------------------------------------------

PIECE = """
import os, signal, sys
from pathlib import Path
from haros_ci.interruption import Interrupted, held, listening
from haros_ci.scratch import scratch_directory
{code}
"""


def piece(code: str, tmp_path: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", PIECE.format(code=code)],
        env={**os.environ, "TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=DEADLINE,
    )


def test_a_signal_while_a_directory_is_removed(tmp_path: Path) -> None:
    code = """
import shutil
really = os.unlink
def slow(*arguments, **options):
    signal.raise_signal(signal.SIGTERM)
    return really(*arguments, **options)
try:
    with listening(), scratch_directory() as directory:
        for name in "abc":
            Path(directory, name).touch()
        os.unlink = slow
except Interrupted as err:
    print(err.code)
"""
    done = piece(code, tmp_path)
    assert (done.stdout, done.stderr) == ("143\n", "")
    assert list(tmp_path.iterdir()) == []


def test_a_signal_while_a_directory_is_made(tmp_path: Path) -> None:
    code = """
really = os.mkdir
def made(*arguments, **options):
    really(*arguments, **options)
    signal.raise_signal(signal.SIGHUP)
os.mkdir = made
try:
    with listening(), scratch_directory() as directory:
        print("not reached")
except Interrupted as err:
    print(err.code)
"""
    done = piece(code, tmp_path)
    assert (done.stdout, done.stderr) == ("129\n", "")
    assert list(tmp_path.iterdir()) == []


def test_a_signal_in_a_finalizer_is_not_lost(tmp_path: Path) -> None:
    code = """
class Dropped:
    def __del__(self):
        signal.raise_signal(signal.SIGTERM)
try:
    with listening():
        Dropped()
        while True:
            pass
except Interrupted as err:
    print(err.code)
"""
    done = piece(code, tmp_path)
    assert (done.stdout, done.stderr) == ("143\n", "")


def test_handlers_are_the_commands_alone(tmp_path: Path) -> None:
    """Who imports a module, or runs the command in its own process, keeps what it has."""
    code = """
import haros_ci.cli
before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
print(before == [signal.default_int_handler, signal.SIG_DFL, signal.SIG_DFL])
haros_ci.cli.main(["completion", "fish"])
print([signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)] == before)
import threading
thread = threading.Thread(target=haros_ci.cli.main, args=(["cache", "dir"],))
thread.start(); thread.join()
"""
    done = piece(code, tmp_path)
    assert done.stdout.splitlines()[0] == "True" and done.stdout.splitlines()[-2] == "True"
    assert done.stderr == ""


def test_a_handler_of_somebody_else_stays(tmp_path: Path) -> None:
    code = """
signal.signal(signal.SIGTERM, lambda *_: print("theirs", flush=True))
with listening():
    signal.raise_signal(signal.SIGTERM)
"""
    assert piece(code, tmp_path).stdout == "theirs\n"


def test_a_signal_in_what_is_held_comes_after_it(tmp_path: Path) -> None:
    code = """
try:
    with listening():
        with held():
            with held():
                signal.raise_signal(signal.SIGTERM)
            print("still here")
        print("not reached")
except Interrupted as err:
    print(err.name)
"""
    assert piece(code, tmp_path).stdout == "still here\nSIGTERM\n"


class _Ends:
    """What ends a run by a signal while a class is made: Python before 3.12 makes a RuntimeError of it."""

    def __init__(self, error: BaseException) -> None:
        self.error = error

    def __call__(self, argv: list[str]) -> int:
        raise RuntimeError("Error calling __set_name__") from self.error


@pytest.mark.parametrize(
    ("error", "code"), [(KeyboardInterrupt(), 130), (Interrupted(signal.SIGTERM), 143), (ValueError(), 3)]
)
def test_a_signal_while_a_class_is_made_is_no_fault(
    error: BaseException, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cli, "_invoked", _Ends(error))
    assert cli.main([]) == code
