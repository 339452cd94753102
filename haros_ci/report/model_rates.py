# SPDX-License-Identifier: Apache-2.0
"""The rates of a configuration, for JSON and for a person at a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from haros_ci.model.architecture import Configuration
from haros_ci.model.location import Location
from haros_ci.model.rates import Rate, Rates, total
from haros_ci.report.escape import terminal


def rates_of(rates: Rates, place: Callable[[Location | None], dict[str, Any] | None]) -> dict[str, Any]:
    """*rates* as JSON holds them, in hertz; an upper bound that is not known is null, with its reason."""
    return {
        "published": [
            {
                "node": one.node,
                "topic": one.topic,
                **_rate(one.rate),
                "inputs": [terminal(name) for name in one.inputs],
                "location": place(one.location),
                "calls": [{**_rate(call.rate), "location": place(call.location)} for call in one.calls],
            }
            for one in rates.published
        ],
        "topics": [{"name": name, **_rate(rate)} for name, rate in rates.topics],
    }


def _rate(rate: Rate) -> dict[str, Any]:
    return {"low": rate.low, "high": rate.high if rate.is_known else None, "reason": terminal(rate.reason) or None}


def known_rates(configuration: Configuration) -> dict[tuple[str, str], str]:
    """By node and topic the rate at which it publishes there, in words, where that has a bound; {} without rates."""
    every: dict[tuple[str, str], list[Rate]] = {}
    for one in configuration.rates.published if configuration.rates is not None else ():
        every.setdefault((one.node, one.topic), []).append(one.rate)
    sums = {key: total(found) for key, found in every.items()}
    return {key: str(rate) for key, rate in sums.items() if rate.is_known}


def lines(rates: Rates) -> Iterator[str]:
    """A line for what each node publishes, and for each topic of several nodes one for their sum."""
    yield "  rates:"
    for one in rates.published:
        yield f"    {terminal(one.node)} publishes {terminal(one.topic)}: {terminal(str(one.rate))}"
    several = [one.topic for one in rates.published]
    for name, rate in rates.topics:
        if several.count(name) > 1:
            yield f"    {terminal(name)} in all: {terminal(str(rate))}"
