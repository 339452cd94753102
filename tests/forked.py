# SPDX-License-Identifier: Apache-2.0
"""Runs of the command, each in a process of its own that is forked from one which has all modules loaded: loading is half of a small run.

Not for tests of what is loaded and from where, of encodings that the environment sets, or of signals: these start the command itself.
"""

from __future__ import annotations

import atexit
import contextlib
import faulthandler
import gc
import importlib
import json
import os
import runpy
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import IO, Any

#: A workspace that makes a run load what most runs load.
SMALL = {
    "package.xml": "<package format='3'><name>p</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rclcpp</depend></package>",
    "CMakeLists.txt": "project(p)\nfind_package(rclcpp REQUIRED)\nadd_executable(n n.cpp)\n",
    "n.cpp": '#include <rclcpp/rclcpp.hpp>\nint main(int c, char **v) { rclcpp::init(c, v); auto n = rclcpp::Node::make_shared("n"); }\n',
    "n.py": "import rclpy\nrclpy.create_node('m')\n",
    "a.launch": "<launch><node pkg='p' exec='n' name='n'/></launch>\n",
    "b.launch.py": "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return LaunchDescription([])\n",
    "c.yaml": "n:\n  ros__parameters:\n    a: 1\n",
}

#: What processes load that a run forks itself.
BY_OTHERS = ("haros_ci.extract.cpp.read", "haros_ci.linters.catalogue.spelling", "haros_ci.results.scope_cpp")


class Server:
    """The process that has all modules loaded. One run at a time; ``run`` is like ``subprocess.run``."""

    def __init__(self) -> None:
        ask, self._asking = os.pipe()
        self.place = Path(tempfile.mkdtemp(prefix="haros-ci-forked-"))
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(os.fspath(self.place / "socket"))
        listener.listen(64)
        self._answers, answer = os.pipe()
        kept = {
            name: value for name, value in os.environ.items() if not name.startswith(("GITHUB_", "HAROS_CI_", "PYTHON"))
        }
        passed = (ask, answer, listener.fileno())
        command = [sys.executable, "-I", __file__, *map(str, passed)]
        self._process = subprocess.Popen(
            command, pass_fds=passed, env=kept, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
        )
        os.close(ask)
        os.close(answer)
        listener.close()
        self._reader = open(self._answers, "rb")
        atexit.register(self.close)

    def close(self) -> None:
        """End the process; it is waited for."""
        os.close(self._asking)
        self._process.wait()
        shutil.rmtree(self.place)

    def run(
        self, arguments: list[str], *, cwd: Path, env: Mapping[str, str], timeout: float, driver: Path | None = None
    ) -> subprocess.CompletedProcess[bytes]:
        """``haros-ci ARGUMENTS`` in *cwd* with the environment *env*, and what it has written; a *driver* is a script that runs in its place.

        Raises TimeoutExpired after *timeout* seconds.
        """
        with tempfile.TemporaryDirectory() as written:
            asked = {"arguments": arguments, "cwd": os.fspath(cwd), "env": dict(env), "to": written, "timeout": timeout}
            if driver is not None:
                asked["driver"] = os.fspath(driver)
            os.write(self._asking, json.dumps(asked).encode() + b"\n")
            code = json.loads(self._reader.readline())
            out, err = (Path(written, name).read_bytes() for name in ("out", "err"))
            if code is None:
                sys.stderr.write(err.decode("utf-8", "replace"))
                raise subprocess.TimeoutExpired(arguments, timeout, out, err)
            return subprocess.CompletedProcess(arguments, code, out, err)


@lru_cache(maxsize=1)
def server() -> Server:
    """The process from which the runs of this process are forked."""
    return Server()


#: In place of Python: what is no run of the command is left to Python itself.
PYTHON = """#!/bin/sh
[ "$1" != -I ] || shift
if [ "$1 $2" = "-m haros_ci" ]; then shift 2; exec '{python}' -IS '{place}/ask.py' "$@"; fi
exec '{python}' -I "$@"
"""
#: It hands its streams, its directory and its environment to the process that has all modules loaded, and ends as the run does.
ASK = """
import json, os, socket, sys
server = socket.socket(socket.AF_UNIX)
server.connect({place!r} + "/socket")
socket.send_fds(server, [b"-"], [0, 1, 2])
server.sendall(json.dumps(dict(arguments=sys.argv[1:], cwd=os.getcwd(), env=dict(os.environ))).encode())
server.shutdown(socket.SHUT_WR)
code = server.recv(9)
os._exit(int(code) if code else 134)  # none of one that a signal has ended
"""


@lru_cache(maxsize=1)
def python() -> str:
    """A program that is called like Python with ``-I``: ``-m haros_ci ARGUMENTS`` is a forked run, which what forwards no signals may start."""
    place = server().place
    (place / "ask.py").write_text(ASK.format(place=os.fspath(place)))
    program = place / "python"
    program.write_text(PYTHON.format(python=sys.executable, place=place))
    program.chmod(0o755)
    return os.fspath(program)


def load() -> None:
    """The modules that a run loads, in the order in which it does: some that need one another bear no other. Then the tables of the program."""
    scratch = tempfile.mkdtemp()  # a TemporaryDirectory would be removed at the end of what is forked
    repository = Path(scratch, "small")
    repository.mkdir()
    for name, text in SMALL.items():
        (repository / name).write_text(text)
    who = {f"GIT_{role}_{key}": "a@example.org" for role in ("AUTHOR", "COMMITTER") for key in ("NAME", "EMAIL")}
    alone = {**os.environ, **who, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    for words in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "small"]):
        subprocess.run(["git", *words], cwd=repository, env=alone, check=True)
    (repository / "n.py").write_text(f"{SMALL['n.py']}print(nowhere)\n")
    outputs = [f"--output={name}={scratch}/{name}" for name in ("text", "json", "sarif", "github", "markdown")]
    asked = {
        "arguments": ["check", ".", f"--cache-dir={scratch}/cache", "--baseline-rev=HEAD", *outputs],
        "cwd": os.fspath(repository),
        "env": alone,
        "timeout": 120,
    }
    answered({**asked, "to": scratch, "modules": f"{scratch}/modules"}, ())
    names = Path(scratch, "modules").read_text().split("\n")
    shutil.rmtree(scratch)
    for name in names:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    fill()
    gc.freeze()


def fill() -> None:
    """Tables that are made of the program alone, once in a process: neither the environment nor a workspace changes them."""
    from haros_ci import own_sources, regex, registry
    from haros_ci.analysis import api_rows, architecture_codec, comparison
    from haros_ci.coverage import names, search
    from haros_ci.follow.ros import api_rows as calls
    from haros_ci.index import api_names
    from haros_ci.knowledge.knowledge import knowledge
    from haros_ci.linters import catalogue, gate
    from haros_ci.linters.catalogue import haros, spelling
    from haros_ci.model.architecture import Architecture
    from haros_ci.systems import keeping, node_types

    for name in BY_OTHERS:
        importlib.import_module(name)
    for name, packages in vars(own_sources).items():
        if name.startswith("OF_"):
            own_sources.digest(packages)
    for section in knowledge().facts.about["sections"]:
        knowledge().facts.section(section)
    for table in (comparison.call_rows, gate._names_of_python, haros._index, spelling._families):
        table()
    nothing = architecture_codec.encoded(Architecture())
    architecture_codec.decoded(nothing or b"", ())  # msgspec looks at each class once
    own_sources.program_digest()
    registry.check_rules()
    for tool in catalogue.TOOLS:
        catalogue.rules_of(tool)
    for rows in api_rows.api_rows(None, "", []).values():
        for make in (
            keeping.of_rows,
            node_types.by_call,
            calls.all_names,
            api_names.making_rows,
            api_names.called_back,
            names.names_of,
        ):
            make(rows)
        search.may_have("", names.names_of(rows))
    for made in gc.get_objects():
        if type(made) is type(regex.regex("")):
            made.fullmatch("" if isinstance(made.pattern, str) else b"")
        elif isinstance(made, type) and getattr(vars(made).get("__init__"), "__module__", "") == "haros_ci.records":
            with contextlib.suppress(TypeError, AttributeError):  # of None; it is compiled by then
                made.__init__(None)


def answered(asked: dict[str, Any], ours: tuple[int, ...]) -> int | None:
    """The exit code of one run; None if its time was over."""
    pid = os.fork()
    if not pid:
        code = 1
        try:
            for descriptor in ours:
                os.close(descriptor)
            code = _inside(asked)
        finally:
            os._exit(code)
    signal.signal(signal.SIGALRM, lambda *_: os.kill(pid, signal.SIGABRT))  # it writes where it stands, and ends
    signal.setitimer(signal.ITIMER_REAL, asked["timeout"])
    status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    is_over = signal.getitimer(signal.ITIMER_REAL)[0] == 0
    signal.setitimer(signal.ITIMER_REAL, 0)
    return None if is_over and status == -signal.SIGABRT else status


def _inside(asked: dict[str, Any]) -> int:
    """In the process of the run: what ``python -m haros_ci`` does, and how Python ends."""
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    if "to" in asked:
        for descriptor, name in ((1, "out"), (2, "err")):
            opened = os.open(os.path.join(asked["to"], name), os.O_WRONLY | os.O_APPEND | os.O_CREAT)
            os.dup2(opened, descriptor)
            os.close(opened)
    else:  # what was opened on other files would still take them for such as can be gone back in
        sys.stdin, sys.stdout = open(0, closefd=False), open(1, "w", closefd=False)
        sys.stderr = open(2, "w", 1, errors="backslashreplace", closefd=False)
    faulthandler.enable(2)
    os.environ.clear()
    os.environ.update(asked["env"])
    os.chdir(asked["cwd"])
    sys.argv[:] = ["haros-ci", *asked["arguments"]]
    from haros_ci.cli import main

    code: object = 1
    try:
        code = main() if "driver" not in asked else runpy.run_path(asked["driver"], run_name="__main__") and 0
    except SystemExit as err:
        code = err.code
    except BaseException:
        sys.excepthook(*sys.exc_info())  # type: ignore[arg-type]
    if "modules" in asked:
        Path(asked["modules"]).write_text("\n".join(name for name in sys.modules if name != "__main__"))
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    return code if isinstance(code, int) else 0 if code is None else 1


def taken(connection: socket.socket, ours: tuple[int, ...]) -> None:
    """Begin the run that is asked for at *connection*, beside others; its streams are those of who asks."""
    if os.fork():
        connection.close()
        return
    code = 1
    try:
        for descriptor in ours:
            os.close(descriptor)
        _, streams, _, _ = socket.recv_fds(connection, 1, 3)
        for number, descriptor in enumerate(streams):
            os.dup2(descriptor, number)
            os.close(descriptor)
        with connection.makefile("rb") as stream:
            asked = json.load(stream)
        code = _inside(asked)
    finally:
        connection.sendall(str(code).encode())
        os._exit(0)


def serve(asking: IO[bytes], answer: int, listener: socket.socket) -> None:
    """Run after run, until nobody asks any more."""
    ours = (asking.fileno(), answer, listener.fileno())
    while True:
        ready, _, _ = select.select([asking, listener], [], [])
        with contextlib.suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        if listener in ready:
            taken(listener.accept()[0], ours)
        if asking in ready:
            line = asking.readline()
            if not line:
                return
            os.write(answer, json.dumps(answered(json.loads(line), ours)).encode() + b"\n")


if __name__ == "__main__":
    load()
    serve(open(int(sys.argv[1]), "rb"), int(sys.argv[2]), socket.socket(fileno=int(sys.argv[3])))
