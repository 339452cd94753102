# SPDX-License-Identifier: Apache-2.0
"""The predicates of events, as the monitors have them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

#: What reading a value can raise; a predicate is false then.
FAULTS = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError)


def holds(monitor: Callable[[], Any], role: str, topic: str) -> Callable[..., bool]:
    """Whether a message is the event of this *role* on *topic*. Messages *seen* before are given by alias, where its predicate asks for them."""
    made = monitor()
    event = made.roles[topic][role]

    def test(message: Any, seen: Mapping[str, Any] | None = None) -> bool:
        known = {} if not seen else {alias: _kept(made, alias, earlier) for alias, earlier in seen.items() if alias}
        return bool(made.matches(event, message, known))

    return test


def _kept(made: Any, alias: str, message: Any) -> dict[str, Any]:
    """What the monitor keeps of the message called *alias*."""
    found: dict[str, Any] = {}
    for roles in made.roles.values():
        for event in roles.values():
            if event.alias == alias:
                for key, getter in (event.keeps or {}).items():
                    try:
                        found[key] = getter(message)
                    except FAULTS:
                        pass
    return found
