# SPDX-License-Identifier: Apache-2.0
"""``--timings`` of any command."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import wraps
from typing import Any

import click

from haros_ci.timing import Clock, running

Flags = Mapping[str, Any]


@contextmanager
def timings(flags: Flags) -> Iterator[None]:
    """``--timings``: say on stderr where the time of what is done in here went."""
    clock = Clock() if flags.get("timings") else None
    with running(clock):
        yield
    if clock is not None:
        for line in clock.lines():
            click.echo(line, err=True)


def with_timings(command: Callable[[Flags], int]) -> Callable[[Flags], int]:
    """The *command*, saying where its time went if ``--timings`` is among its flags; ``--verbose`` stands for several of them."""

    @wraps(command)
    def call(flags: Flags) -> int:
        if flags.get("verbose"):
            flags = {**flags, "timings": True, "why": True, "statistics": True}
        with timings(flags):
            return command(flags)

    return call
