# SPDX-License-Identifier: Apache-2.0
"""What is found out about a property, as values that a process can send to another."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import Any

from haros_ci.records import dataclass


class Result(Enum):
    """The answers. Nothing but ``PROVED`` says that a property holds in all runs."""

    PROVED = "proved"
    NONE = "no counterexample"
    VIOLATED = "violated"
    VACUOUS = "vacuous"
    CONTRADICTORY = "axioms contradictory"
    UNDETERMINED = "undetermined"
    NOT_MODELLED = "not modelled"


@dataclass(frozen=True, slots=True)
class Step:
    """One event of a run at *time* (nanoseconds): *node* publishes on *topic*, or receives (*received*) what the event number *of* has published.

    *message* has the fields that properties ask for, *values* the same by their texts (``linear.x``, ``len(ranges)``); *role* is what the event is to the property (``trigger``, …), "" for nothing.
    """

    time: int
    node: str
    topic: str
    message: Mapping[str, Any]
    values: Mapping[str, Any]
    received: bool = False
    of: int = -1
    role: str = ""


@dataclass(frozen=True, slots=True)
class Run:
    """A counterexample: *steps* in order; from the number *loop* on they repeat every *period* nanoseconds (None: afterwards all is silent).

    *end* is a time by which all that is due is due; *at* is when the property is violated, None if that is never over.
    """

    steps: tuple[Step, ...]
    loop: int | None
    period: int
    end: int
    at: int | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Finding:
    """What is found out about the claim *number*.

    *depth* is up to how many events the search went, *is_whole* whether that is as far as was asked. *axioms* are the numbers of those that the
    answer rests on, *cone* of all that were used; *derivation* has the steps of a proof in words. *latency* is the greatest in nanoseconds at which
    the property still holds, as *of_latency* says it. *left* names axioms that were left out, with the reason.
    """

    number: int
    result: Result
    reason: str = ""
    depth: int = 0
    is_whole: bool = False
    run: Run | None = None
    axioms: tuple[int, ...] = ()
    cone: tuple[int, ...] = ()
    derivation: tuple[str, ...] = ()
    latency: int | None = None
    of_latency: str = ""
    left: tuple[tuple[int, str], ...] = ()
    topics: tuple[str, ...] = ()
