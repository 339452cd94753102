# SPDX-License-Identifier: Apache-2.0
"""How often the nodes of a system publish (docs/rates.md), and how long a callback sleeps each time."""

from __future__ import annotations

from functools import partial

from haros_ci.checking.system import End, System
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase
from haros_ci.dependence.filters import passed_on
from haros_ci.model.rates import Rate, Rates, total
from haros_ci.rates.sleeps import seconds
from haros_ci.rates.topics import rates_of
from haros_ci.rates.turns import turns

__all__ = ["Rate", "Rates", "published", "rates_in", "slept", "total"]


def rates_in(system: System, code: Codebase) -> Rates:
    """The rates of a *system*, whose programs are in *code*, worked out once."""
    key = ("rates of", id(system.raw))
    if key not in code.kept:
        code.kept[key] = system.raw, rates_of(system.raw, code, partial(passed_on, code))
    found: tuple[object, Rates] = code.kept[key]
    return found[1]


def published(system: System, code: Codebase, end: End) -> Rate | None:
    """How often the publisher *end* publishes, in hertz; None for one that the rates do not have."""
    every = [
        one
        for one in rates_in(system, code).published
        if (one.node, one.topic, one.location) == (end.node.name, end.name, end.raw.location)
    ]
    return every[0].rate if len(every) == 1 else None


def slept(code: Codebase, callback: Callback) -> float:
    """The seconds that each run of *callback* sleeps at the least; 0.0 where it may not."""
    found = 0.0
    for call in code.body(callback.routine).calls:
        if "sleep" not in call.name:
            continue
        time = seconds(code, callback.routine, call.whole)
        often = turns(code, callback.routine, call)
        if time is not None and not (often.is_sometimes or often.paced is not None or often.reason):
            found += time * often.times
    return found
