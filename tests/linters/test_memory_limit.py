# SPDX-License-Identifier: Apache-2.0
"""What a tool may have of memory: not more than it may write to, however much address space it reserves."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from haros_ci.linters.linter import Command
from haros_ci.linters.process import Processes

#: The limit is set from outside, a moment after the start.
WAIT = """
import mmap, resource, time
while resource.getrlimit(resource.RLIMIT_DATA)[0] == resource.RLIM_INFINITY:
    time.sleep(0.01)
"""
GREEDY = WAIT + "try:\n    bytearray(9_000_000_000)\n    print('had')\nexcept MemoryError:\n    print('refused')"
#: As the run-time systems of Haskell, Java and JavaScript do.
RESERVING = WAIT + (
    "mmap.mmap(-1, 2**40, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | 0x4000, prot=0)\nbytearray(1_000_000)\nprint('had')"
)


@pytest.mark.skipif(sys.platform != "linux", reason="limits are set by prlimit")
@pytest.mark.parametrize(
    ("program", "said"), [(GREEDY, b"refused\n"), (RESERVING, b"had\n")], ids=["greedy", "reserving"]
)
def test_memory(tmp_path: Path, program: str, said: bytes) -> None:
    command = Command((sys.executable, "-IS", "-c", program))
    output = Processes().run(command, root=tmp_path, scratch=tmp_path / "scratch", timeout=20)
    assert (output.stdout, output.code) == (said, 0), output.stderr
