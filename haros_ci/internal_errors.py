# SPDX-License-Identifier: Apache-2.0
"""A sentence and an exit code for what the machine refuses (3) or has lost (2), and for faults of our own."""

from __future__ import annotations

import errno
import os

import click

from haros_ci.report.escape import terminal
from haros_ci.streams import STREAMS, silence
from haros_ci.writing import remedy, write

USAGE, TROUBLE = 2, 3
TEMPORARY = "make room in TMPDIR (or /tmp, /var/tmp), or let TMPDIR name another place"
DEBUG = "set HAROS_CI_DEBUG=1 for the trace"


def described(err: Exception) -> tuple[int, str, str]:
    """The exit code for *err*, which nobody has caught, and what to say of it."""
    if isinstance(err, MemoryError):
        return TROUBLE, "error: there is not enough memory", f"help: {remedy(errno.ENOMEM)}"
    if isinstance(err, OSError):
        if not _is_here():
            return USAGE, "error: the current directory does not exist any more", "help: change to one that exists"
        why = terminal(err.strerror or str(err))
        if (stream := _stream(err)) is not None:
            silence()
            closed = "it is closed" if err.errno == errno.EBADF else why
            return TROUBLE, f"error: {stream} cannot be written: {closed}", f"help: {STREAMS}"
        where = f"{terminal(os.fsdecode(err.filename))}: " if isinstance(err.filename, (str, bytes)) else ""
        advice = TEMPORARY if "temporary director" in why else remedy(err.errno) or DEBUG
        return TROUBLE, f"error: {where}{why}", f"help: {advice}"
    text = terminal(str(err))[:500]
    if isinstance(err, ImportError):
        return (
            TROUBLE,
            f"error: a part of haros-ci cannot be loaded: {text}",
            "help: install it anew, or allow more memory",
        )
    if isinstance(err, RuntimeError) and "start new thread" in text:
        return TROUBLE, f"error: no thread can be started: {text}", f"help: {remedy(errno.EAGAIN)}"
    message = f"internal error: {type(err).__name__}: {text}"
    return TROUBLE, message, "help: this is a fault of haros-ci; set HAROS_CI_DEBUG=1 for the trace and report it"


def _is_here() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def _stream(err: OSError) -> str | None:
    """The stream that could not be written, if *err* comes from writing one: such errors name no file."""
    trace = err.__traceback__
    while trace is not None:
        code, names = trace.tb_frame.f_code, trace.tb_frame.f_locals
        if code is click.echo.__code__:
            return "stderr" if names.get("err") else "stdout"
        if code is write.__code__ and names.get("path") is None:
            return "stdout"
        trace = trace.tb_next
    return None
