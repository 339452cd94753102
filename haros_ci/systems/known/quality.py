# SPDX-License-Identifier: Apache-2.0
"""The quality of service of a known ROS 2 endpoint: how the data writes it, and what a start makes of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from haros_ci.model.architecture import Qos, Unknown
from haros_ci.systems.known import text
from haros_ci.systems.known.entry import KnownEndpoint, Policies, Why
from haros_ci.systems.known.start import Start

_RELIABLE = Qos(history="keep_last", depth=10, reliability="reliable", durability="volatile")
#: The profiles of rmw/qos_profiles.h and rclcpp/qos.hpp; ``latched`` is what ROS 1 calls so.
PRESETS = {
    "default": _RELIABLE,
    "sensor_data": replace(_RELIABLE, depth=5, reliability="best_effort"),
    "system_default": Qos(),
    "services_default": _RELIABLE,
    "parameters": replace(_RELIABLE, depth=1000),
    "parameter_events": replace(_RELIABLE, depth=1000),
    "clock": replace(_RELIABLE, depth=1, reliability="best_effort"),
    "latched": replace(_RELIABLE, depth=1, durability="transient_local"),
}
#: The words of each policy; the others are numbers.
WORDS = {
    "preset": tuple(PRESETS),
    "history": ("keep_last", "keep_all"),
    "reliability": ("reliable", "best_effort", "best_available"),
    "durability": ("volatile", "transient_local", "best_available"),
    "liveliness": ("automatic", "manual_by_topic"),
}
POLICIES = (*WORDS, "depth", "deadline", "lifespan", "lease")
_LARGEST = 2**31


def policies(value: object) -> Policies:
    """*value* as it is written: a depth, a preset's name, ``{unknown:why}`` or a map. Raises ValueError."""
    if isinstance(value, Mapping):
        unknown = [str(key)[:40] for key in value if key not in POLICIES]
        if unknown or not value:
            raise ValueError(f"its keys are some of {', '.join(POLICIES)}")
        if "preset" not in value and value.get("history") != "keep_all" and "depth" not in value:
            raise ValueError("it needs a depth, a preset or history: keep_all")
        return tuple((key, _policy(key, value[key])) for key in POLICIES if key in value)
    if isinstance(value, int) or (isinstance(value, str) and value.startswith("~")):
        return (("depth", _policy("depth", value)),)
    return (("preset", _policy("preset", value)),)


def _policy(key: str, value: object) -> str | int | float | text.Test | Why:
    if isinstance(value, str):
        if value.startswith("{unknown:") and value.endswith("}"):
            return Why(value[len("{unknown:") : -1])
        if value.startswith("~"):
            return text.test(value)
        if value in WORDS.get(key, ()):
            return value
    elif (
        key not in WORDS and (type(value) is int or (type(value) is float and key != "depth")) and 0 <= value < _LARGEST
    ):
        return value
    allowed = ", ".join(WORDS[key]) if key in WORDS else "a whole number" if key == "depth" else "seconds"
    raise ValueError(f"{key} is one of {allowed}, or ~parameter|default, or {{unknown:the reason}}")


def quality(
    known: KnownEndpoint, start: Start, queue: int | None, latched: bool | None
) -> tuple[Qos | None, list[Unknown]]:
    """What *known* has when it is started so, and what of it is not known; else what a ROS 1 entry says of it."""
    if known.qos is None:
        if queue is None:
            return None, [Unknown("qos", "the data on this node does not tell it")]
        return replace(_RELIABLE, depth=queue, durability="transient_local" if latched else "volatile"), []
    qos = _RELIABLE
    unknowns: list[Unknown] = []
    for key, written in known.qos:
        value = _value(key, written, start)
        if isinstance(value, Unknown):
            unknowns.append(value)
            if key == "preset":
                qos = replace(qos, history="?", depth="?", reliability="?", durability="?")
            else:
                qos = replace(qos, **{key: "?"})
        elif key == "preset":
            qos = PRESETS[str(value)]
        else:
            qos = replace(qos, **{key: value})
    if qos.history == "keep_all" and isinstance(qos.depth, int):
        qos = replace(qos, depth=None)
    return qos, unknowns


def _value(key: str, provided: object, start: Start) -> Any:
    if isinstance(provided, Why):
        return Unknown("qos", provided.reason)
    if not isinstance(provided, text.Test):
        return provided
    value = start.value(provided.about)
    if value is None and provided.default is not None:
        value = text.literal(provided.default)
    if isinstance(value, Unknown):
        return replace(value, field="qos")
    if key in WORDS and isinstance(value, str) and value.lower() in WORDS[key]:
        return value.lower()
    if key not in WORDS and isinstance(value, int) and not isinstance(value, bool) and 0 <= value < _LARGEST:
        return value
    return Unknown("qos", f"{provided.about} is no {key} that is known")
