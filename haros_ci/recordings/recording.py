# SPDX-License-Identifier: Apache-2.0
"""What every recording is: topics, and messages in the order in which they stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from haros_ci.errors import UserError
from haros_ci.recordings.offered import Offer
from haros_ci.records import dataclass

#: Topics and types of one recording, characters of their names, of one definition and of all.
MOST_CHANNELS, LONGEST_NAME, LONGEST_DEFINITION, MOST_TEXT = 10_000, 1_000, 300_000, 64 << 20
#: Nanoseconds since 1970 that are taken for a time.
LATEST = 1 << 62


class Cut(Exception):
    """Behind this place a recording cannot be read, and why."""


class Definitions:
    """What is kept of the definitions of a recording's types: packed, they are much smaller than here."""

    def __init__(self) -> None:
        self.left = MOST_TEXT

    def kept(self, text: str) -> str:
        """*text*, or so much of it that it is seen to be too long; Cut where there is too much in all."""
        text = text[: LONGEST_DEFINITION + 1]
        self.left -= len(text)
        if self.left < 0:
            raise Cut("the definitions of its types are too long")
        return text


@dataclass(frozen=True, slots=True)
class Unreadable:
    """A message that is there and cannot be had, and why."""

    reason: str


@dataclass(slots=True, eq=False)
class Channel:
    """A topic of a bag, as a full name, with its type (``pkg/T`` or ``pkg/msg/T``), the type's *definition* (None where the bag has none), and how messages are written.

    Of its publishers a bag of ROS 1 tells the *publisher*, one of ROS 2 the *profiles* that they offer, as text.
    """

    topic: str
    type: str
    definition: str | None
    encoding: str
    publisher: Offer | None = None
    profiles: str = ""
    decoder: Any = None
    count: int = 0

    def __post_init__(self) -> None:
        if max(len(self.topic), len(self.type), len(self.encoding)) > LONGEST_NAME:
            raise Cut(f"a topic or type has a name of more than {LONGEST_NAME:,} characters")
        self.topic = full_name(self.topic)


def full_name(topic: str) -> str:
    """A name without a slash in front is one below the root: what writes bags takes both."""
    return topic if topic.startswith("/") else f"/{topic}"


def in_order(messages: Iterator[tuple[Channel, int, bytes]], is_whole: bool) -> Iterator[tuple[Channel, int, bytes]]:
    """The messages of a chunk in order of time; where they are Cut, and of a chunk that is not whole, those before it come first."""
    found: list[tuple[Channel, int, bytes]] = []
    cut: Cut | None = None
    try:
        for message in messages:
            found.append(message)
    except Cut as err:
        cut = err
    yield from sorted(found, key=lambda item: item[1])
    if not is_whole:
        raise Cut("it ends early")
    if cut is not None:
        raise cut


class Recording:
    """Messages with their times. *first* and *last* are those of the messages so far, in nanoseconds; *count* is how many those are.

    ``topics`` are those that it has, with their types, and ``offers`` their publishers; *notes* are sentences about what could not be read.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.first: int | None = None
        self.last: int | None = None
        self.count = 0
        self.notes: list[str] = []
        #: What was first found to be damaged, "" if nothing was.
        self.damage = ""
        self.topics: dict[str, set[str]] = {}
        self.offers: dict[str, set[Offer]] = {}

    def messages(self, requested: frozenset[str]) -> Iterator[tuple[str, Any, int, int]]:
        """Topic, message, time and number, from 1, of the messages on the topics *requested*; a message can be ``Unreadable``."""
        raise NotImplementedError

    def times(self) -> Iterator[tuple[str, int]]:
        """Topic and time of each message, none of which is decoded; ``topics`` and ``offers`` are complete then."""
        raise NotImplementedError

    def share(self) -> float | None:
        """How much of it has been read, None if that is not known."""
        return None

    def demand_messages(self) -> None:
        """Once it has been read: UserError if nothing of it could be; a note if it has no messages."""
        if not self.count and self.damage:
            raise UserError(f"{self.name}: no message of it can be read: {self.damage}", help="name a whole recording")
        if not self.count:
            self.notes.append(f"{self.name} has no messages")

    def passed(self, time: int) -> int:
        """Count a message; its number."""
        if self.first is None:
            self.first = time
        self.last = time
        self.count += 1
        return self.count
