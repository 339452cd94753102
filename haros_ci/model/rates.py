# SPDX-License-Identifier: Apache-2.0
"""How often something happens: intervals in hertz, and the timers and rates that a node makes.

A rate is nominal: what the code asks for, where the work of a turn takes less time than its period, and nothing is lost.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import inf

from haros_ci.model.location import Location
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Rate:
    """From *low* to *high* times a second. *reason* says what is not known where *high* is infinite, "" otherwise."""

    low: float
    high: float
    reason: str = ""

    @property
    def is_exact(self) -> bool:
        return self.low == self.high

    @property
    def is_known(self) -> bool:
        """Whether it has an upper bound."""
        return self.high != inf

    def __str__(self) -> str:
        if self.is_exact:
            return f"{_number(self.low)} Hz"
        if self.is_known:
            return f"{_number(self.low)} to {_number(self.high)} Hz"
        least = f"at least {_number(self.low)} Hz" if self.low else "unknown"
        return f"{least} ({self.reason})" if self.reason else least


#: What happens once, or never.
NEVER = Rate(0.0, 0.0)


def unknown(reason: str, low: float = 0.0) -> Rate:
    """A rate without an upper bound, for a *reason*."""
    return Rate(low, inf, reason)


def exactly(hertz: float) -> Rate:
    """The rate of a timer: that many times a second."""
    return Rate(hertz, hertz)


def at_most(rate: Rate) -> Rate:
    """What happens in some of the cases in which *rate* does."""
    return Rate(0.0, rate.high, rate.reason)


def total(rates: Iterable[Rate]) -> Rate:
    """The sum: what happens as often as all of them together; the first reason counts."""
    low, high, reason = 0.0, 0.0, ""
    for rate in rates:
        low, high = low + rate.low, high + rate.high
        reason = reason or rate.reason
    return Rate(round(low, 9), high if high == inf else round(high, 9), reason)


def either(one: Rate, other: Rate) -> Rate:
    """The least interval that has both."""
    return Rate(min(one.low, other.low), max(one.high, other.high), one.reason or other.reason)


@dataclass(frozen=True, slots=True, kw_only=True)
class Pace:
    """A timer or a rate object that a node makes: *kind* is ``timer`` or ``rate``, *period* in seconds.

    *period* is None where it is not known, for a *reason*; it may be zero or negative, as the code says. *is_conditional* says that
    it may not be made, *is_repeated* that more than one is made by the same call.
    """

    kind: str
    location: Location
    period: float | None = None
    reason: str = ""
    is_conditional: bool = False
    is_repeated: bool = False

    @property
    def hertz(self) -> float | None:
        """Turns a second; None where that is not known, or no number."""
        return None if self.period is None or self.period <= 0 else 1.0 / self.period


@dataclass(frozen=True, slots=True)
class CallRate:
    """How often one call publishes."""

    location: Location
    rate: Rate


@dataclass(frozen=True, slots=True)
class TopicRate:
    """How often a *node* publishes on a *topic*, with its *calls*; *location* is where the publisher is made.

    *inputs* are the topics whose rates it inherits, by name.
    """

    node: str
    topic: str
    location: Location | None
    rate: Rate
    calls: tuple[CallRate, ...]
    inputs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Rates:
    """All rates of a configuration: by node and topic, and by topic the sum of all its publishers."""

    published: tuple[TopicRate, ...]
    topics: tuple[tuple[str, Rate], ...]


def _number(value: float) -> str:
    return f"{value:.6g}"
