# SPDX-License-Identifier: Apache-2.0
"""Whatever happens to a run of tests, none of the processes that it has started is left, nor what these have started."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from haros_ci.test_files.property_tests.processes import Processes

ROOT = Path(__file__).resolve().parents[2]
#: Starts a process that starts another one and heeds no gentle signal, writes what they are, and ends as it is told to.
SCRIPT = """\
import os, sys, time
from haros_ci.test_files.property_tests.processes import Processes

STUBBORN = "trap '' INT TERM; sleep 1000 & echo $! > $0.child; echo ready > $0; wait; wait; wait"
processes = Processes()
first = processes.start("stubborn", ["sh", "-c", STUBBORN, sys.argv[1]], os.environ, os.devnull)
second = processes.start("gentle", ["sleep", "1000"], os.environ, os.devnull)
while not os.path.exists(sys.argv[1]):
    time.sleep(0.01)
with open(sys.argv[1] + ".child") as file:
    print(first.pid, second.pid, file.read().strip(), flush=True)
{end}
"""
WAIT = "time.sleep(1000)"


def is_there(pid: int) -> bool:
    """Whether a process runs; one that has ended and is not waited for does not."""
    try:
        status = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
    except OSError:
        return False
    return status.rpartition(")")[2].split()[0] not in ("Z", "X")


def all_gone(pids: list[int]) -> bool:
    """Whether none of them runs, once the keeper had its moment."""
    for _ in range(500):
        if not any(map(is_there, pids)):
            return True
        subprocess.run(["sleep", "0.01"], check=True)
    return False


#: How a run of tests ends: what the script does at its end, and the signal that it gets.
ENDS: dict[str, tuple[str, int | None]] = {
    "at its end": ("", None),
    "by an exception": ("raise ValueError", None),
    "by sys.exit": ("sys.exit(3)", None),
    "by SIGINT": (WAIT, signal.SIGINT),
    "by SIGTERM": (WAIT, signal.SIGTERM),
    "by SIGKILL": (WAIT, signal.SIGKILL),
    "by os._exit": ("os._exit(1)", None),
}


@pytest.fixture(scope="module")
def ended(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[list[int], bool]]:
    """For all ends, which take their seconds at the same time: the processes that were started, and whether all of them ran before the signal."""
    scratch = tmp_path_factory.mktemp("ready")
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    runs = {
        name: subprocess.Popen(
            [sys.executable, "-c", SCRIPT.format(end=end), str(scratch / f"ready{number}")],
            env=env,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        for number, (name, (end, _)) in enumerate(ENDS.items())
    }
    found = {}
    for name, run in runs.items():
        assert run.stdout is not None
        pids = [int(word) for word in run.stdout.readline().split()]
        found[name] = (pids, all(map(is_there, pids)))
        if (sent := ENDS[name][1]) is not None:
            run.send_signal(sent)
    for run in runs.values():
        with run:
            run.wait()
    return found


@pytest.mark.parametrize("name", ENDS)
def test_none_is_left(ended: dict[str, tuple[list[int], bool]], name: str) -> None:
    pids, all_ran = ended[name]
    assert len(pids) == 3 and (all_ran or ENDS[name][1] is None)
    assert all_gone(pids)


def test_what_ended_by_itself_is_named(tmp_path: Path) -> None:
    processes = Processes()
    log = tmp_path / "log"
    for name, command in (("a", "exit 3"), ("b", "kill -SEGV $$"), ("c", "exit 0")):
        os.waitid(
            os.P_PID, processes.start(name, ["sh", "-c", command], os.environ, str(log)).pid, os.WEXITED | os.WNOWAIT
        )
    long = processes.start("d", ["sleep", "1000"], os.environ, str(log))
    try:
        assert processes.ended() == [
            "a ended with exit code 3",
            "b ended with signal SIGSEGV",
            "c ended with exit code 0",
        ]
        processes.end(["a", "d"])
        assert list(processes.running) == ["b", "c"] and not is_there(long.pid)
    finally:
        processes.end_all()
    assert processes.ended() == [] and not processes.running


def test_what_it_prints_is_kept(tmp_path: Path) -> None:
    processes = Processes()
    log = tmp_path / "log"
    os.waitid(
        os.P_PID,
        processes.start("a", ["sh", "-c", "echo out; echo err >&2"], os.environ, str(log)).pid,
        os.WEXITED | os.WNOWAIT,
    )
    processes.end_all()
    assert sorted(log.read_text().split()) == ["err", "out"]
