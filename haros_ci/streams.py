# SPDX-License-Identifier: Apache-2.0
"""stdin, stdout and stderr as the command finds them: closed, full, without a reader, or in another encoding."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress

TROUBLE = 3
STREAMS = "redirect it to where there is room, or give each format a file: --output FORMAT=FILE"


def prepare_streams() -> None:
    """UTF-8 on both outputs, and something in the place of streams that are closed (``>&-``).

    Else the next file that is opened would get their number, and whatever a library or a child writes to stdout. What is written to a
    closed stdout fails, what is written to a closed stderr is nobody's.
    """
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        stream = getattr(sys, name)
        if stream is None:
            with suppress(OSError):
                descriptor = os.open(os.devnull, os.O_RDONLY if number < 2 else os.O_WRONLY)
                if descriptor != number:
                    os.close(descriptor)
                else:
                    mode = "w" if number else "r"
                    made = open(number, mode, encoding="utf-8", errors="backslashreplace", closefd=False)  # noqa: SIM115 - the caller closes it
                    setattr(sys, name, made)
        elif number and stream is getattr(sys, f"__{name}__") and isinstance(stream, io.TextIOWrapper):
            if (stream.encoding.lower(), stream.errors) != ("utf-8", "backslashreplace"):
                stream.reconfigure(encoding="utf-8", errors="backslashreplace")


def write_to_stderr(*lines: str) -> None:
    """Lines on stderr, if anybody can read them."""
    import click

    with suppress(OSError, ValueError):
        for line in lines:
            click.echo(line, err=True)


def flushed(code: int) -> int:
    """*code* if all that was written to stdout has got there, else 3, and a sentence; the interpreter has nothing to add."""
    if sys.stdout is None:
        return code
    try:
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        pass
    except (OSError, ValueError) as err:
        closed = "it is closed" if getattr(err, "errno", None) == 9 else getattr(err, "strerror", None) or str(err)
        write_to_stderr(f"error: stdout cannot be written: {closed}", f"help: {STREAMS}")
    silence()
    return TROUBLE


def silence() -> None:
    """What waits for a stdout that cannot be written goes nowhere, else the interpreter would try again at its end, and complain."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
        sys.stdout.flush()
