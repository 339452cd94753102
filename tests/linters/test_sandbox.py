# SPDX-License-Identifier: Apache-2.0
"""What a confined process can and cannot do, and that no process outlives us."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from haros_ci.linters import footing, sandbox
from haros_ci.linters.linter import Command
from haros_ci.linters.process import Processes, Unstartable
from haros_ci.linters.sandbox import Confinement

ON = pytest.mark.skipif(not sandbox.protection().files, reason="this kernel has no Landlock, or it is switched off")


def tried(code: str, tmp_path: Path, talks: bool = False) -> str:
    """What *code* prints in a confined process; ``refused`` where it raised OSError."""
    view, own = tmp_path / "view", tmp_path / "own"
    for directory in (view, own):
        directory.mkdir(exist_ok=True)
    (view / "a.txt").write_text("inside\n")
    (tmp_path / "secret").write_text("outside\n")
    (view / "link").unlink(missing_ok=True)
    (view / "link").symlink_to(tmp_path / "secret")
    program = f"import os, socket, subprocess, sys\ntry:\n    {code}\nexcept OSError:\n    print('refused')\n"
    argv = (sys.executable, "-I", "-c", program)
    confinement = Confinement((str(view), *footing.of_program(argv)), (str(own), *footing.WRITTEN), talks)
    output = Processes().run(Command(argv), root=view, scratch=own, timeout=60, confinement=confinement)
    assert output.stderr == b"", output.stderr
    return output.stdout.decode().strip()


REFUSED = [
    "print(open('../secret').read())",
    "print(open('link').read())",
    "print(open('/etc/passwd').read())",
    "print(os.listdir('..'))",
    "print(os.listdir('/home'), os.listdir('/root'))",
    "print(open(f'/proc/{os.getppid()}/environ').read())",
    "print(open('/proc/self/environ').read())",
    "print(open('a.txt', 'w'))",
    "print(open('../new', 'w'))",
    "os.unlink('a.txt'); print('gone')",
    "os.rename('a.txt', '../own/a.txt'); print('moved')",
    "os.symlink('/etc', 'here'); print('linked')",
    "print(socket.socket())",
    "print(socket.socket(socket.AF_INET6, socket.SOCK_DGRAM))",
    "print(socket.socket(socket.AF_UNIX))",
    "print(subprocess.run(['/bin/cat', '../secret'], check=False, capture_output=True).stdout or 'refused')",
    "os.kill(os.getppid(), 0); print('reached')",
]
ALLOWED = [
    ("print(open('a.txt').read())", "inside"),
    ("print(os.listdir('.') == sorted(os.listdir('.')) or 'listed')", ""),
    ("open('../own/x', 'w').write('1'); print(open('../own/x').read())", "1"),
    ("os.mkdir('../own/d'); os.rmdir('../own/d'); print('made')", "made"),
    ("open('/dev/null', 'w').write('x'); print('said')", "said"),
    ("import json, decimal, zoneinfo; print(json.dumps(1))", "1"),
    ("print(len(open('/dev/urandom', 'rb').read(3)))", "3"),
    ("a, b = socket.socketpair(); a.send(b'x'); print(b.recv(1).decode())", "x"),
    ("print(subprocess.run(['/bin/sh', '-c', 'echo fine'], capture_output=True, check=True).stdout.decode())", "fine"),
    ("import threading; t = threading.Thread(target=print, args=('thread',)); t.start(); t.join()", "thread"),
]


@ON
@pytest.mark.parametrize("code", REFUSED)
def test_it_cannot(code: str, tmp_path: Path) -> None:
    assert tried(code, tmp_path) == "refused"


@ON
@pytest.mark.parametrize(("code", "printed"), ALLOWED)
def test_it_can(code: str, printed: str, tmp_path: Path) -> None:
    said = tried(code, tmp_path)
    assert said == printed if printed else said != "refused"


@ON
def test_local_sockets_where_they_are_asked_for(tmp_path: Path) -> None:
    assert tried("print(socket.socket(socket.AF_UNIX).family.name)", tmp_path, talks=True) == "AF_UNIX"
    assert tried("print(socket.socket())", tmp_path, talks=True) == "refused"


@ON
def test_we_ourselves_stay_as_we_are(tmp_path: Path) -> None:
    tried("print(1)", tmp_path)
    assert (tmp_path / "secret").read_text() == "outside\n"
    subprocess.run([sys.executable, "-c", "import socket; socket.socket()"], check=True)


def test_a_program_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(Unstartable, match="No such file"):
        Processes().run(
            Command(("/no/such/program",)), root=tmp_path, scratch=tmp_path, timeout=5, confinement=Confinement(())
        )


PARENT = """
import sys
from pathlib import Path
from haros_ci.linters.linter import Command
from haros_ci.linters.process import Processes
place = Path(sys.argv[1])
script = f"sleep 1000 & echo $! > {place}/child; echo $$ > {place}/leader; sleep 1000"
Processes().run(Command(("/bin/sh", "-c", script)), root=place, scratch=place / "scratch", timeout=1000)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the kernel of Linux does it")
def test_a_tool_does_not_outlive_us_even_if_we_are_killed(tmp_path: Path) -> None:
    parent = subprocess.Popen([sys.executable, "-c", PARENT, str(tmp_path)])
    until(lambda: (tmp_path / "leader").exists() and (tmp_path / "leader").read_text().strip() != "")
    pids = [int((tmp_path / name).read_text()) for name in ("leader", "child")]
    assert all(map(is_running, pids))
    until(lambda: is_tied(pids[0]))  # which the parent sees to when the process has begun
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    until(lambda: not any(map(is_running, pids)))


def is_tied(process: int) -> bool:
    """Whether a process has a file that sends it a signal when something happens to it (``O_ASYNC``; proc(5), fdinfo)."""
    infos = [info.read_text() for info in Path(f"/proc/{process}/fdinfo").iterdir()]
    return any(int(info.partition("flags:")[2].split()[0], 8) & os.O_ASYNC for info in infos)


def is_running(process: int) -> bool:
    """Whether a process is there and no mere zombie."""
    try:
        status = Path(f"/proc/{process}/stat").read_text()
    except OSError:
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


def until(holds: object) -> None:
    for _ in range(12_000):  # a machine with much other work is slow
        if holds():  # type: ignore[operator]
            return
        time.sleep(0.01)
    raise AssertionError("it has not come to that in 120 s")


@pytest.mark.parametrize("path", ["/", "/tmp", os.path.expanduser("~"), os.getcwd(), "/home/.."])
def test_what_holds_far_more_than_a_program_is_not_given(path: str) -> None:
    footing._wide_places.cache_clear()  # a test before may have worked in another directory
    assert footing._is_wide(path)
    program = os.path.join(path, "some-program")
    assert not {path, os.path.realpath(path)} & set(footing._of_file(program, 0))
