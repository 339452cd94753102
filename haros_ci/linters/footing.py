# SPDX-License-Identifier: Apache-2.0
"""What a program needs of the machine to run at all: its own files, those of its interpreter, the system's libraries."""

from __future__ import annotations

import os
import sys
from functools import lru_cache
from pathlib import Path

#: Of the system: programs, libraries and their data; no settings but the dynamic linker's and the time zone.
SYSTEM = (
    *(f"{top}{name}" for top in ("/", "/usr/", "/usr/local/") for name in ("bin", "lib", "lib32", "lib64", "libexec")),
    *("/usr/share", "/usr/local/share", "/sbin", "/usr/sbin", "/nix/store", "/gnu/store"),
    *("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/alternatives", "/etc/localtime"),
    *("/dev/random", "/dev/urandom", "/dev/zero", "/dev/null", "/dev/full"),
    *("/proc/cpuinfo", "/proc/meminfo", "/proc/stat", "/proc/filesystems", "/proc/sys/vm/overcommit_memory"),
    *("/sys/devices/system/cpu", "/sys/kernel/mm/transparent_hugepage"),
)
#: Where compilers look for headers that are installed: for tools that read C++ as it is built.
HEADERS = ("/usr/include", "/usr/local/include", "/opt/ros", "/usr/share", "/usr/src/googletest", "/usr/src/gtest")
WRITTEN = ("/dev/null",)

#: What an installation in a directory of its own (a virtual environment, a Python, a user's base) has beside its ``bin``.
_PARTS = ("bin", "lib", "lib32", "lib64", "libexec", "pyvenv.cfg")
_LONGEST_SHEBANG = 1000


def of_program(argv: tuple[str, ...]) -> tuple[str, ...]:
    """The places that *argv* needs: of its program and of that program's interpreter, of our Python, and of the system."""
    return tuple(dict.fromkeys((*_of_file(argv[0], 0), *_of_python(), *SYSTEM)))


@lru_cache(maxsize=1)
def _of_python() -> tuple[str, ...]:
    """Our Python and everything that it imports from, this package included."""
    package = Path(__file__).resolve().parents[1]
    prefixes = dict.fromkeys((sys.prefix, sys.exec_prefix, sys.base_prefix, sys.base_exec_prefix))
    places = [part for prefix in prefixes for part in _installation(prefix)]
    entries = [entry for entry in sys.path if os.path.isabs(entry) and not _is_wide(entry)]
    return (*places, *entries, *_of_file(sys.executable, 0), str(package))


@lru_cache(maxsize=64)
def _of_file(path: str, depth: int) -> tuple[str, ...]:
    """A program, what its installation has beside it, and the same of the interpreter in its first line."""
    if not os.path.isabs(path) or depth > 3:
        return ()
    real = os.path.realpath(path)
    places = [path, real]
    for directory in dict.fromkeys((os.path.dirname(path), os.path.dirname(real))):
        if os.path.basename(directory) == "bin":
            prefix = os.path.dirname(directory)
            places += (*_installation(prefix), os.path.join(prefix, "share", os.path.basename(path)))
        elif not _is_wide(directory):
            places.append(directory)
    interpreter = _interpreter(real)
    return (*places, *(_of_file(interpreter, depth + 1) if interpreter else ()))


def _interpreter(path: str) -> str | None:
    try:
        with open(path, "rb") as stream:
            first = stream.readline(_LONGEST_SHEBANG)
    except OSError:
        return None
    words = os.fsdecode(first[2:]).split() if first.startswith(b"#!") else []
    return words[0] if words else None


def _installation(prefix: str) -> tuple[str, ...]:
    return tuple(os.path.join(prefix, part) for part in _PARTS)


def _is_wide(directory: str) -> bool:
    """Whether a directory holds far more than one program: the root, a home, a temporary directory, what is above us."""
    here = os.path.realpath(directory)
    return any((place + "/").startswith(here.rstrip("/") + "/") for place in _wide_places())


@lru_cache(maxsize=1)
def _wide_places() -> tuple[str, ...]:
    import tempfile

    homes = (os.path.expanduser("~"), tempfile.gettempdir(), os.getcwd())
    return tuple(dict.fromkeys(os.path.realpath(place) for place in homes))
