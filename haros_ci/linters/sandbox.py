# SPDX-License-Identifier: Apache-2.0
"""A sandbox that the kernel enforces for the processes of tools: which files they can open, and that they have no network.

Linux only, without privileges: Landlock (kernel documentation, "Landlock: unprivileged access control") for files, TCP and
signals, a seccomp filter for all other sockets. Both hold for the thread that asks for them and for all that it starts, so a
process is started from a short-lived thread of its own, and the rest of the program stays as it is.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
import threading
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TypeVar

from haros_ci.records import dataclass

T = TypeVar("T")

# -- the kernel's interface: include/uapi/linux/landlock.h, prctl.h, seccomp.h, filter.h, audit.h

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446  # the same numbers on every architecture
_VERSION_FLAG, _PATH_BENEATH = 1, 1
_EXECUTE, _WRITE_FILE, _READ_FILE, _READ_DIR, _TRUNCATE, _IOCTL = 1 << 0, 1 << 1, 1 << 2, 1 << 3, 1 << 14, 1 << 15
_OF_FILES = _EXECUTE | _WRITE_FILE | _READ_FILE | _TRUNCATE | _IOCTL
#: The first rights of each version of the interface: so many of the bits are known to it.
_KNOWN_RIGHTS = {1: 13, 2: 14, 3: 15, 4: 15, 5: 16}
_MAKE_DEVICES = 1 << 6 | 1 << 11  # character and block
_NETWORK_VERSION, _SCOPE_VERSION = 4, 6
_NO_NEW_PRIVILEGES, _SET_SECCOMP, _FILTER = 38, 22, 2
_ALLOW, _REFUSE = 0x7FFF0000, 0x00050000 | 1  # EPERM
_LOAD, _JUMP_IF_EQUAL, _JUMP_IF_ABOVE, _RETURN = 0x20, 0x15, 0x35, 0x06
_X32 = 0x40000000
_AF_UNIX, _NO_FAMILY = 1, 0xFFFFFFFF

#: The audit number of each architecture, and its numbers of: socket, ptrace, process_vm_readv, process_vm_writev, add_key,
#: request_key, keyctl. What follows is the same everywhere: io_uring_setup (its rings open sockets, too), pidfd_getfd.
_CALLS = {
    "x86_64": (0xC000003E, (41, 101, 310, 311, 248, 249, 250)),
    "aarch64": (0xC00000B7, (198, 117, 270, 271, 217, 218, 219)),
}
_CALLS_EVERYWHERE = (425, 438)


@dataclass(frozen=True, slots=True)
class Protection:
    """What the kernel of this machine can enforce: that files outside cannot be opened, and that there is no network."""

    files: bool
    network: bool


@dataclass(frozen=True, slots=True)
class Confinement:
    """Absolute paths of files and directories, with all that is below: those that can be read and run, and those written.

    With *talks* the processes may talk to each other by sockets of the local machine.
    """

    reads: tuple[str, ...]
    writes: tuple[str, ...] = ()
    talks: bool = False


@lru_cache(maxsize=1)
def protection() -> Protection:
    """What can be enforced here; nothing where the environment variable HAROS_CI_SANDBOX is ``off``."""
    if not sys.platform.startswith("linux") or os.environ.get("HAROS_CI_SANDBOX") == "off":
        return Protection(False, False)
    version = _version()
    return Protection(version > 0, _calls() is not None and _has_seccomp())


def state(trusted: bool = False) -> str:
    """How linters are confined on this machine, a word of results/confined.py; not at all in a workspace that is *trusted*."""
    if trusted:
        return "trusted"
    found = protection()
    if found.files:
        return "files-network" if found.network else "files"
    switched_off = sys.platform.startswith("linux") and os.environ.get("HAROS_CI_SANDBOX") == "off"
    return "off" if switched_off else "none"


def confined(start: Callable[[], T], confinement: Confinement | None) -> T:
    """What *start* returns, called where all processes that it starts are confined; as it is where nothing can be enforced.

    Raises what *start* raises, and OSError if the kernel refuses what it has offered.
    """
    can = protection()
    if confinement is None or not (can.files or can.network):
        return start()
    made: list[T] = []
    raised: list[BaseException] = []

    def inside() -> None:
        try:
            _restrict(confinement, can)
            made.append(start())
        except BaseException as err:
            raised.append(err)

    thread = threading.Thread(target=inside, name="haros-ci-sandbox")
    thread.start()
    thread.join()
    if raised:
        raise raised[0]
    return made[0]


def _restrict(confinement: Confinement, can: Protection) -> None:
    libc = _libc()
    _checked(libc.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0))
    if can.files:
        ruleset = _ruleset(confinement)
        try:
            _checked(libc.syscall(_RESTRICT_SELF, ruleset, 0))
        finally:
            os.close(ruleset)
    if can.network:
        program = _program(confinement.talks)
        instructions = ctypes.create_string_buffer(program, len(program))
        header = struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(instructions))
        _checked(libc.prctl(_SET_SECCOMP, _FILTER, ctypes.c_char_p(header), 0, 0))


def _ruleset(confinement: Confinement) -> int:
    """A descriptor of the rules. Paths that are not there need none."""
    libc = _libc()
    version = _version()
    handled = (1 << _KNOWN_RIGHTS.get(version, 16)) - 1
    network = 3 if version >= _NETWORK_VERSION else 0  # bind and connect with TCP
    scopes = 3 if version >= _SCOPE_VERSION else 0  # abstract sockets and signals
    fields = [handled, network, scopes][: 1 + (version >= _NETWORK_VERSION) + (version >= _SCOPE_VERSION)]
    attributes = struct.pack(f"{len(fields)}Q", *fields)
    ruleset: int = _checked(libc.syscall(_CREATE_RULESET, attributes, len(attributes), 0))
    reading = _EXECUTE | _READ_FILE | _READ_DIR
    try:
        for paths, rights in ((confinement.reads, reading), (confinement.writes, handled & ~_MAKE_DEVICES)):
            for path in dict.fromkeys(paths):
                _allow(libc, ruleset, path, rights & handled)
    except BaseException:
        os.close(ruleset)
        raise
    return ruleset


def _allow(libc: ctypes.CDLL, ruleset: int, path: str, rights: int) -> None:
    try:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not os.path.isdir(path):
            rights &= _OF_FILES
        _checked(libc.syscall(_ADD_RULE, ruleset, _PATH_BENEATH, struct.pack("=Qi", rights, place), 0))
    finally:
        os.close(place)


@lru_cache(maxsize=2)
def _program(talks: bool) -> bytes:
    """The filter: no sockets (but local ones), no other process's memory, no keys, and no calls of another architecture."""
    calls = _calls()
    assert calls is not None
    architecture, (socket, *others) = calls
    refused = (*others, *_CALLS_EVERYWHERE)
    steps: list[tuple[int, int, str, str]] = [(_LOAD, 4, "", "")]  # seccomp_data.arch
    steps.append((_JUMP_IF_EQUAL, architecture, "", "refuse"))
    steps.append((_LOAD, 0, "", ""))  # seccomp_data.nr
    steps.append((_JUMP_IF_ABOVE, _X32, "refuse", ""))
    steps += [(_JUMP_IF_EQUAL, number, "refuse", "") for number in refused]
    steps.append((_JUMP_IF_EQUAL, socket, "", "allow"))
    steps.append((_LOAD, 16, "", ""))  # the lower half of its first argument, the family
    steps.append((_JUMP_IF_EQUAL, _AF_UNIX if talks else _NO_FAMILY, "allow", "refuse"))
    ends = {"refuse": len(steps), "allow": len(steps) + 1}
    code = [
        struct.pack("HBBI", step, *(ends[to] - at - 1 if to else 0 for to in (yes, no)), value)
        for at, (step, value, yes, no) in enumerate(steps)
    ]
    return b"".join((*code, struct.pack("HBBI", _RETURN, 0, 0, _REFUSE), struct.pack("HBBI", _RETURN, 0, 0, _ALLOW)))


def _calls() -> tuple[int, tuple[int, ...]] | None:
    if struct.calcsize("P") != 8:
        return None
    return _CALLS.get(os.uname().machine)


def _has_seccomp() -> bool:
    return int(_libc().prctl(21, 0, 0, 0, 0)) >= 0  # PR_GET_SECCOMP


@lru_cache(maxsize=1)
def _version() -> int:
    """The version of Landlock's interface, 0 where the kernel has none or it is switched off."""
    try:
        return max(0, int(_libc().syscall(_CREATE_RULESET, None, 0, _VERSION_FLAG)))
    except (AttributeError, OSError):
        return 0


@lru_cache(maxsize=1)
def _libc() -> ctypes.CDLL:
    libc = ctypes.CDLL(None, use_errno=True)
    libc.syscall.restype = ctypes.c_long
    return libc


def _checked(result: int) -> int:
    if result < 0:
        code = ctypes.get_errno()
        raise OSError(code, f"the sandbox cannot be entered: {os.strerror(code)}")
    return result


def existing(paths: Iterable[str]) -> tuple[str, ...]:
    """Those of *paths* that are there."""
    return tuple(path for path in dict.fromkeys(paths) if os.path.exists(path))
