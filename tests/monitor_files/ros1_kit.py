# SPDX-License-Identifier: Apache-2.0
"""ROS 1 of the distribution: a master of its own on a free port of the loopback interface; whatever is started is ended."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

#: Set where tests must not be skipped.
DEMANDED = "HAROS_CI_ROS1"
#: The Python for which the distribution has rospy.
PYTHON = "/usr/bin/python3"
PATIENCE = 60.0
_NEEDED = "import genpy, roslib.message, rosgraph, rosmaster, rospy, std_msgs.msg, roscpp.srv"


def missing() -> str:
    """What keeps ROS 1 from being started, "" for nothing."""
    try:
        done = subprocess.run(
            [PYTHON, "-c", _NEEDED], capture_output=True, text=True, env=environment({}), timeout=PATIENCE
        )
    except OSError as err:
        return f"{PYTHON}: {err.strerror}"
    return "" if done.returncode == 0 else f"not installed: {done.stderr.strip().splitlines()[-1]}"


def environment(more: Mapping[str, str]) -> dict[str, str]:
    """The environment without what belongs to the tests, or to a ROS that is set up in the shell."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "ROS", "VIRTUAL"))}
    return {**kept, **more}


def demand() -> None:
    """Skip the test with the reason where ROS 1 is not there, or fail it where it is demanded."""
    why = missing()
    if why and os.environ.get(DEMANDED):
        pytest.fail(why)
    if why:
        pytest.skip(why)


class Ros1:
    """A master, and what runs beside it."""

    def __init__(self, directory: Path) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.env = environment({
            "ROS_MASTER_URI": f"http://127.0.0.1:{self.port}",
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(directory / "ros"),
            "ROS_LOG_DIR": str(directory / "log"),
        })  # fmt: skip
        self.directory = directory
        self.started: list[subprocess.Popen[str]] = []

    def start(self, *words: str) -> subprocess.Popen[str]:
        """A process of its own session, under the distribution's Python."""
        process = subprocess.Popen(
            [PYTHON, *words], env=self.env, cwd=self.directory, text=True, start_new_session=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip
        self.started.append(process)
        return process

    def wait_for_master(self) -> None:
        end = time.monotonic() + PATIENCE
        while True:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", self.port)) == 0:
                    return
            assert time.monotonic() < end and self.started[0].poll() is None, "no master"
            time.sleep(0.01)

    def close(self) -> None:
        """End every process that was started here, by its id."""
        for process in reversed(self.started):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                try:
                    process.communicate(timeout=10)
                except subprocess.TimeoutExpired:
                    process.kill()
            process.communicate()


@contextmanager
def ros1(directory: Path) -> Iterator[Ros1]:
    """A running master."""
    system = Ros1(directory)
    try:
        system.start("/usr/bin/rosmaster", "--core", "-p", str(system.port))
        system.wait_for_master()
        yield system
    finally:
        system.close()


def line_of(process: subprocess.Popen[str]) -> Any:
    """The next line of JSON that a process writes."""
    assert process.stdout is not None
    line = process.stdout.readline()
    assert line, process.communicate()[1]
    return json.loads(line)
