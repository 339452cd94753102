# SPDX-License-Identifier: Apache-2.0
"""What recordings say of properties, as ``haros-ci monitor --output json=FILE`` wrote it: data of unknown origin.

Anything that is not of the form of those files is refused with a UserError, and what is much is cut.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

from haros_ci.errors import UserError
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.records import dataclass

#: Properties of a file, messages of a violation, values of a message, and publishers of it that are shown.
MOST, MOST_MESSAGES, MOST_VALUES, MOST_PUBLISHERS = 2_000, 60, 20, 20
#: Recordings that are shown.
MOST_FILES = 50
VERDICTS = ("violated", "undecided", "never exercised", "held")
ROLES = ("activator", "trigger", "behaviour", "terminator")


@dataclass(frozen=True, slots=True)
class Recorded:
    """What one file says, its form known to be right."""

    document: Mapping[str, Any]


def recorded(text: str, name: str) -> Recorded:
    """The verdicts in *text*, which a file of this *name* holds; UserError if it has none."""
    try:
        document = json.loads(text, parse_constant=_no_number)
        _demand(isinstance(document, dict) and isinstance(document.get("recording"), dict))
        properties = document.get("properties")
        _demand(isinstance(properties, list) and all(_is_property(one) for one in properties))
    except (ValueError, RecursionError) as err:
        raise UserError(
            f"{name}: has no verdicts", help="give a file that haros-ci monitor --output json=FILE has written"
        ) from err
    return Recorded(document)


def verdicts(pool: Pool, every: Sequence[Recorded]) -> list[dict[str, Any]]:
    """A row for each recording: its name, configuration, clock, times, how many messages, and what it says of properties."""
    return [_recording(pool, one.document) for one in every[:MOST_FILES]]


def _recording(pool: Pool, document: Mapping[str, Any]) -> dict[str, Any]:
    recording = document["recording"]
    return {
        "name": _text(pool, recording.get("name")),
        "configuration": _text(pool, document.get("configuration")),
        "clock": _text(pool, document.get("clock")),
        "messages": _whole(recording.get("messages")),
        "begin": _number(recording.get("begin")),
        "end": _number(recording.get("end")),
        "more": max(0, len(document["properties"]) - MOST),
        "properties": [_property(pool, one) for one in document["properties"][:MOST]],
    }


def _property(pool: Pool, one: Mapping[str, Any]) -> tuple[Any, ...]:
    messages = [message for message in one["witnesses"] if _is_message(message)]
    return (
        VERDICTS.index(one["verdict"]),
        _text(pool, one.get("id")),
        _text(pool, one["text"]),
        _text(pool, one.get("node")),
        int(one.get("axiom") is True),
        _place(pool, one),
        _text(pool, one.get("reason")),
        _number(one.get("time")),
        tuple(_whole(one.get(key)) for key in ("scopes", "triggers", "behaviours")),
        [_message(pool, message) for message in messages[:MOST_MESSAGES]],
    )


def _message(pool: Pool, message: Mapping[str, Any]) -> tuple[Any, ...]:
    values = message.get("values")
    publishers = message.get("publishers")
    shown = list(values.items())[:MOST_VALUES] if isinstance(values, dict) else []
    known = [one for one in publishers if isinstance(one, dict)] if isinstance(publishers, list) else []
    return (
        ROLES.index(message["role"]),
        pool.text(message["topic"]),
        _whole(message.get("number")),
        _number(message.get("time")),
        tuple((pool.text(name), pool.text(_value(value))) for name, value in shown),
        tuple((_text(pool, one.get("node")), _place(pool, one)) for one in known[:MOST_PUBLISHERS]),
    )


def _value(value: Any) -> str:
    return json.dumps(value)[:200] if value is None or isinstance(value, (str, int, float)) else "…"


def _is_property(one: Any) -> bool:
    return (
        isinstance(one, dict)
        and one.get("verdict") in VERDICTS
        and isinstance(one.get("text"), str)
        and isinstance(one.get("witnesses"), list)
    )


def _is_message(one: Any) -> bool:
    return isinstance(one, dict) and one.get("role") in ROLES and isinstance(one.get("topic"), str)


def _place(pool: Pool, one: Mapping[str, Any]) -> int:
    path = one.get("path")
    return pool.row("places", (pool.text(path), _whole(one.get("line")), 0)) if isinstance(path, str) else NONE


def _text(pool: Pool, value: Any) -> int:
    return pool.text(value) if isinstance(value, str) else NONE


def _whole(value: Any) -> int:
    """A count, 0 for what is none."""
    return value if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 53 else 0


def _number(value: Any) -> float | None:
    """Seconds; None for what is no number that JSON holds."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return float(value) if is_number and abs(value) < 1e15 and math.isfinite(value) else None


def _no_number(word: str) -> float:
    raise ValueError(f"{word} is no number of JSON")


def _demand(holds: bool) -> None:
    if not holds:
        raise ValueError("another form")
