# SPDX-License-Identifier: Apache-2.0
"""Random properties and recordings, and what a property says of one: every statement of docs/hpl.md as a sentence about the whole recording."""

from __future__ import annotations

import operator
import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

SCOPES = ("globally", "after", "until", "after-until")
PATTERNS = ("some", "no", "causes", "forbids", "requires")
TOPICS = ("/a", "/b", "/c", "/d")
SIGNS = {"=": operator.eq, "!=": operator.ne, "<": operator.lt, ">": operator.gt, "<=": operator.le}

#: Topic, data and time in milliseconds.
Trace = tuple[tuple[str, int, int], ...]


@dataclass(frozen=True)
class Told:
    """An event: its data, compared with *value*, or with the data of the event *of*."""

    topic: str
    alias: str = ""
    sign: str = ""
    value: int = 0
    of: str = ""

    def matches(self, topic: str, data: int, known: Mapping[str, int]) -> bool:
        if topic != self.topic:
            return False
        if not self.sign:
            return True
        if self.of:
            return self.of in known and SIGNS[self.sign](data, known[self.of])
        return SIGNS[self.sign](data, self.value)

    def __str__(self) -> str:
        alias = f" as {self.alias}" if self.alias else ""
        right = f"@{self.of}.data" if self.of else str(self.value)
        return f"{self.topic}{alias}" + (f" {{data {self.sign} {right}}}" if self.sign else "")


Events = tuple[Told, ...]


@dataclass(frozen=True)
class Drawn:
    """A property; *bound* is in milliseconds."""

    scope: str
    pattern: str
    activator: Events
    terminator: Events
    trigger: Events
    behaviour: Events
    bound: int | None

    def __str__(self) -> str:
        first, second = _text(self.trigger), _text(self.behaviour)
        scope = {
            "globally": "globally",
            "after": f"after {_text(self.activator)}",
            "until": f"until {_text(self.terminator)}",
            "after-until": f"after {_text(self.activator)} until {_text(self.terminator)}",
        }[self.scope]
        if self.pattern in ("some", "no"):
            said = f"{self.pattern} {second}"
        elif self.pattern == "requires":
            said = f"{second} requires {first}"
        else:
            said = f"{first} {self.pattern} {second}"
        return f"{scope}: {said}" + (f" within {self.bound} ms" if self.bound is not None else "")


def _text(events: Events) -> str:
    return str(events[0]) if len(events) == 1 else f"({' or '.join(map(str, events))})"


def drawn(draw: random.Random, pattern: str, scope: str, *, may_overlap: bool = True) -> Drawn:
    """A random property. Without *may_overlap* no message can be trigger and behaviour of it."""
    opened = draw.choice(("", "P")) if scope.startswith("after") else ""
    activator = _events(draw, (), opened) if opened or scope.startswith("after") else ()
    known = (opened,) if opened and activator[0].alias else ()
    terminator = _events(draw, known) if scope in ("until", "after-until") else ()
    first_alias = draw.choice(("", "M"))
    first = _events(draw, known, first_alias)
    inner = (*known, first_alias) if first_alias and len(first) == 1 else known
    topics = TOPICS if may_overlap else tuple(topic for topic in TOPICS if topic not in {each.topic for each in first})
    second = _events(draw, inner, topics=topics)
    trigger, behaviour = (second, first) if pattern == "requires" else (first, second)
    if pattern in ("some", "no"):
        trigger, behaviour = (), _events(draw, known)
    bound = draw.choice((None, 1, 2, 5, 10, 20))
    return Drawn(scope, pattern, activator, terminator, trigger, behaviour, bound)


def _events(draw: random.Random, known: tuple[str, ...], alias: str = "", topics: tuple[str, ...] = TOPICS) -> Events:
    count = 1 if alias else draw.choice((1, 1, 1, 2))
    return tuple(_event(draw, topic, known, alias) for topic in draw.sample(topics, min(count, len(topics))))


def _event(draw: random.Random, topic: str, known: tuple[str, ...], alias: str) -> Told:
    kind = draw.choice(("all", "value", "other") if known else ("all", "value"))
    sign = "" if kind == "all" else draw.choice(tuple(SIGNS))
    return Told(topic, alias, sign, draw.randrange(4), draw.choice(known) if kind == "other" else "")


def traced(draw: random.Random, length: int = 12) -> Trace:
    """A random recording; times can be equal, and begin at 0."""
    time = 0
    found = []
    for _ in range(draw.randrange(length + 1)):
        found.append((draw.choice(TOPICS), draw.randrange(4), time))
        time += draw.choice((0, 1, 1, 2, 5, 10))
    return tuple(found)


def _some(events: Events, message: tuple[str, int, int], known: Mapping[str, int]) -> Told | None:
    return next((each for each in events if each.matches(message[0], message[1], known)), None)


def openings(property: Drawn, trace: Trace) -> Iterator[tuple[int, int, int, dict[str, int]]]:
    """Of each opening of the scope the number of the first message in it, of the first one behind, its time, and what is known."""
    at, known, begin = 0, {}, 0
    while True:
        if property.activator:
            found = next((n for n in range(at, len(trace)) if _some(property.activator, trace[n], {})), None)
            if found is None:
                return
            event = _some(property.activator, trace[found], {})
            assert event is not None
            known = {event.alias: trace[found][1]} if event.alias else {}
            at, begin = found + 1, trace[found][2]
        close = next((n for n in range(at, len(trace)) if _some(property.terminator, trace[n], known)), len(trace))
        yield at, close, begin, known
        if close == len(trace) or not property.activator:
            return
        at = close + 1


def verdict(property: Drawn, trace: Trace) -> tuple[str, int | None]:
    """``held``, ``violated``, ``undecided`` or ``never exercised``, and the time of the first violation."""
    end = trace[-1][2] if trace else 0
    times: list[int] = []
    used = is_open = False
    for first, close, begin, known in openings(property, trace):
        inner = range(first, close)
        closed = trace[close][2] if close < len(trace) else None
        for said in _STATEMENTS[property.pattern](property, trace, inner, begin, closed, end, known):
            used = True
            if said == "open":
                is_open = True
            elif isinstance(said, int):
                times.append(said)
    if times:
        return "violated", min(times)
    return ("undecided" if is_open else "held" if used else "never exercised"), None


def _near(property: Drawn, since: int, time: int) -> bool:
    return property.bound is None or time - since < property.bound


def _due(property: Drawn, since: int, closed: int | None, end: int) -> object:
    """What it means that nothing came in the window since then."""
    last = end if closed is None else closed
    if property.bound is not None and last - since >= property.bound:
        return since + property.bound
    return "open" if closed is None else closed


def _no(property, trace, inner, begin, closed, end, known):  # type: ignore[no-untyped-def]
    for n in inner:
        if not _near(property, begin, trace[n][2]):
            continue
        if _some(property.behaviour, trace[n], known):
            yield trace[n][2]
        elif any(trace[n][0] == each.topic for each in property.behaviour):
            yield "heard"
    if any(not each.sign for each in property.behaviour):
        yield "nothing is asked of it"


def _exists(property, trace, inner, begin, closed, end, known):  # type: ignore[no-untyped-def]
    if any(_some(property.behaviour, trace[n], known) and _near(property, begin, trace[n][2]) for n in inner):
        yield "it came"
    else:
        yield _due(property, begin, closed, end)


def _causes(property, trace, inner, begin, closed, end, known):  # type: ignore[no-untyped-def]
    for n in inner:
        if event := _some(property.trigger, trace[n], known):
            more = {**known, event.alias: trace[n][1]}
            later = range(n + 1, inner.stop)
            if any(
                _some(property.behaviour, trace[m], more) and _near(property, trace[n][2], trace[m][2]) for m in later
            ):
                yield "answered"
            else:
                yield _due(property, trace[n][2], closed, end)


def _forbids(property, trace, inner, begin, closed, end, known):  # type: ignore[no-untyped-def]
    for n in inner:
        if event := _some(property.trigger, trace[n], known):
            yield "triggered"
            more = {**known, event.alias: trace[n][1]}
            for m in range(n + 1, inner.stop):
                if _some(property.behaviour, trace[m], more) and _near(property, trace[n][2], trace[m][2]):
                    yield trace[m][2]


def _requires(property, trace, inner, begin, closed, end, known):  # type: ignore[no-untyped-def]
    for n in inner:
        if event := _some(property.behaviour, trace[n], known):
            more = {**known, event.alias: trace[n][1]}
            earlier = range(inner.start, n)
            if any(
                _some(property.trigger, trace[m], more) and _near(property, trace[m][2], trace[n][2]) for m in earlier
            ):
                yield "founded"
            else:
                yield trace[n][2]


_STATEMENTS = {"no": _no, "some": _exists, "causes": _causes, "forbids": _forbids, "requires": _requires}
