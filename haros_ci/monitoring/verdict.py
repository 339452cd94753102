# SPDX-License-Identifier: Apache-2.0
"""What a recording says of a property."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import Any

from haros_ci.records import dataclass


class Verdict(Enum):
    """The four answers."""

    HELD = "held"
    VIOLATED = "violated"
    NEVER_EXERCISED = "never exercised"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class Witness:
    """A message that a verdict rests on: its *role* (``activator``, ``trigger``, ``behaviour`` or ``terminator``), its *number* in the recording, from 1,
    its *time* in seconds, and the *values* that the property asks of it."""

    role: str
    topic: str
    number: int
    time: float
    values: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Outcome:
    """The *verdict* with its *reason*, and for a violation its *time* in seconds and its messages in order.

    *scopes*, *triggers* and *behaviours* say how often the scope opened, and how many messages in it were triggers, or behaviour. Of a property
    that is violated what comes behind is not counted. *faults* is how many predicates asked a message for what it does not have, of
    *faulty_topic* first; they are false.
    """

    verdict: Verdict
    reason: str
    time: float | None = None
    witnesses: tuple[Witness, ...] = ()
    scopes: int = 0
    triggers: int = 0
    behaviours: int = 0
    faults: int = 0
    faulty_topic: str = ""
