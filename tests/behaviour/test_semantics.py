# SPDX-License-Identifier: Apache-2.0
"""What follows of properties, held against random recordings: an oracle that shares no code with it reads docs/hpl.md, "Exact meaning"."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from itertools import product
from random import Random

from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import Compared, excluded, follows
from haros_ci.behaviour.deciding import Predicate
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.tree import Event, PatternKind, Property, ScopeKind

#: A message: time, topic, value of its field x.
Message = tuple[float, str, int]
MATCHES = {
    "": lambda x: True,
    "{x > 1}": lambda x: x > 1,
    "{x > 2}": lambda x: x > 2,
    "{x = 2}": lambda x: x == 2,
    "{not x > 1}": lambda x: x <= 1,
}
SCOPES = ("globally", "after /p", "until /q", "after /p until /q")
BOUNDS = ("", " within 1 s", " within 2 s")


def is_one(message: Message, events: tuple[Event, ...], text: str) -> bool:
    for event in events:
        predicate = text[event.at.offset : event.at.end].partition(" ")[2]
        if event.topic == message[1] and MATCHES[predicate](message[2]):
            return True
    return False


def openings(said: Property, text: str, trace: list[Message]) -> Iterator[tuple[float, list[Message]]]:
    """When the scope opens, and the messages in it."""
    scope = said.scope
    inside: list[Message] | None = [] if scope.kind in (ScopeKind.GLOBALLY, ScopeKind.UNTIL) else None
    begin, is_over = 0.0, False
    for message in trace:
        if is_over:
            break
        if inside is None:
            if is_one(message, scope.activator, text):
                begin, inside = message[0], []
        elif is_one(message, scope.terminator, text):
            yield begin, inside
            inside, is_over = None, scope.kind is ScopeKind.UNTIL
        else:
            inside.append(message)
    if inside is not None:
        yield begin, inside


def holds(said: Property, text: str, trace: list[Message]) -> bool:
    return all(_holds_in(said, text, begin, inside) for begin, inside in openings(said, text, trace))


def _holds_in(said: Property, text: str, begin: float, inside: list[Message]) -> bool:
    pattern = said.pattern
    bound = math.inf if pattern.bound is None else pattern.bound.seconds
    behaviour = [n for n, each in enumerate(inside) if is_one(each, pattern.behaviour, text)]
    trigger = [n for n, each in enumerate(inside) if is_one(each, pattern.trigger, text)]
    if pattern.kind in (PatternKind.NO, PatternKind.SOME):
        comes = any(inside[n][0] - begin < bound for n in behaviour)
        return comes is (pattern.kind is PatternKind.SOME)

    def near(first: int, second: int) -> bool:
        return first < second and inside[second][0] - inside[first][0] < bound

    if pattern.kind is PatternKind.CAUSES:
        return all(any(near(a, b) for b in behaviour) for a in trigger)
    if pattern.kind is PatternKind.REQUIRES:
        return all(any(near(a, b) for a in trigger) for b in behaviour)
    return not any(near(a, b) for a, b in product(trigger, behaviour))


def texts() -> list[str]:
    events = [f"{topic} {predicate}".strip() for topic, predicate in product(("/a", "/b"), MATCHES)] + [
        "(/a or /b {x > 1})"
    ]
    some = ("/a", "/a {x > 1}", "(/a or /b {x > 1})")
    patterns = [f"{word} {event}" for word, event in product(("some", "no"), events)]
    patterns += [
        f"{one} {word} {other}"
        for one, word, other in product(
            some, ("causes", "forbids", "requires"), ("/b", "/b {x > 1}", "/b {x = 2}", "/a {x > 2}")
        )
    ]
    return [f"{scope}: {pattern}{bound}" for scope, pattern, bound in product(SCOPES, patterns, BOUNDS)]


def traces(random: Random, count: int) -> list[list[Message]]:
    found = []
    for _ in range(count):
        time, trace = 0.0, []
        for _ in range(random.randrange(8)):
            time += random.choice((0.0, 0.5, 1.0, 1.5))
            trace.append((time, random.choice(("/a", "/a", "/b", "/b", "/p", "/q")), random.randrange(4)))
        found.append(trace)
    return found


def compared(text: str) -> Compared:
    return Compared(parse_property(text), lambda event: Predicate(event.predicate, Reader(None, event.alias)))


def test_what_follows_holds_in_every_recording() -> None:
    random = Random(5)
    every = texts()
    recordings = traces(random, 300)
    made = {text: compared(text) for text in every}

    @cache
    def kept(text: str) -> list[bool]:
        return [holds(made[text].stated, text, trace) for trace in recordings]

    seen = against = 0
    for one in random.sample(every, 100):
        for other in random.sample(every, 400):
            first, second = made[one], made[other]
            if follows(first, second):
                seen += one != other
                wrong = [trace for trace, a, b in zip(recordings, kept(one), kept(other)) if b and not a]
                assert not wrong, f"{one!r} does not follow from {other!r}: {wrong[0]}"
            if excluded(first, second) is not None:
                against += 1
                for trace, a, b in zip(recordings, kept(one), kept(other)):
                    if a and b:
                        assert _is_never_asked(first.stated, one, trace), f"{one!r} and {other!r} both hold: {trace}"
    assert seen > 100 and against > 20


def _is_never_asked(said: Property, text: str, trace: list[Message]) -> bool:
    """Whether the scope never opens, or the trigger never comes in it."""
    inside = [each for _, messages in openings(said, text, trace) for each in messages]
    if said.pattern.kind is PatternKind.SOME:
        return not list(openings(said, text, trace))
    return not any(is_one(each, said.pattern.trigger, text) for each in inside)
