# SPDX-License-Identifier: Apache-2.0
"""What a recording says of the publishers of a topic: the node and its latching (ROS 1), the quality of service that they offer (ROS 2).

The profiles are those of rosbag2_storage/qos.cpp: a list in YAML, policies as numbers of rmw/types.h before version 9 and as words since then.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.bounded_yaml import YamlFault, YamlLimits, data
from haros_ci.model.architecture import Qos
from haros_ci.records import dataclass

_LIMITS = YamlLimits(100_000, 6, 20_000, 0)
#: rmw/types.h; what is the system's default, or unknown, says nothing.
_RELIABILITY = {1: "reliable", 2: "best_effort"}
_DURABILITY = {1: "transient_local", 2: "volatile"}
_LIVELINESS = {1: "automatic", 3: "manual_by_topic"}
#: Seconds that a time without end has at the least: RMW_DURATION_INFINITE, and what implementations wrote before it.
_ENDLESS = 0x7FFFFFFF


@dataclass(frozen=True, slots=True)
class Offer:
    """A publisher: its node's name and whether it latches, None where the recording does not say; *qos* without history, which DDS does not tell."""

    node: str | None = None
    is_latched: bool | None = None
    qos: Qos | None = None


def offers(profiles: str) -> tuple[Offer, ...]:
    """The publishers that a text of profiles is about; none where it cannot be read."""
    try:
        read = data(profiles, _LIMITS)
    except (YamlFault, ValueError):
        return ()
    return tuple(_offers(read)) if isinstance(read, list) else ()


def _offers(read: list[Any]) -> Iterator[Offer]:
    for item in read:
        if isinstance(item, Mapping):
            qos = Qos(
                reliability=_word(item.get("reliability"), _RELIABILITY),
                durability=_word(item.get("durability"), _DURABILITY),
                deadline=_seconds(item.get("deadline")),
                lifespan=_seconds(item.get("lifespan")),
                liveliness=_word(item.get("liveliness"), _LIVELINESS),
                lease=_seconds(item.get("liveliness_lease_duration")),
            )
            yield Offer(qos=qos)


def _word(value: object, words: Mapping[int, str]) -> str | None:
    if isinstance(value, int):
        return words.get(value)
    return value if isinstance(value, str) and value in words.values() else None


def _seconds(value: object) -> float | None:
    """A time in seconds; None without one, and for one without end."""
    if not isinstance(value, Mapping):
        return None
    whole, rest = value.get("sec"), value.get("nsec")
    if not isinstance(whole, int) or not isinstance(rest, int) or not (0 <= whole < _ENDLESS and 0 <= rest < 1 << 33):
        return None
    return whole + rest / 1e9 or None
