# SPDX-License-Identifier: Apache-2.0
"""Plans: which messages are sent when. A plan is made of parts, one after the other, as the scope and pattern of a property need them."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from hypothesis import strategies as st

Strategy = Any
if TYPE_CHECKING:  # Python 3.8 does not evaluate these
    #: Messages of a plan by the alias of their event.
    Seen = dict[str, Any]
    Predicate = Callable[[Any], bool]
    #: What makes steps: it is given ``draw``, the gaps to choose from and the messages seen so far.
    Part = Callable[[Callable[[Strategy], Any], Sequence[float], Seen], list["Step"]]

#: Seconds between two messages; the first is the simplest. Every second plan has none that is longer than ``QUICK``: bursts are worth as much
#: as pauses, and most of the time of examples would be spent in these.
GAPS = (0.0, 0.001, 0.01, 0.05)
QUICK = 0.01
#: Where the topics on which nothing is sent stand among the messages that were seen; no alias is empty.
SILENT = ""


class Step(NamedTuple):
    """*after* so many seconds send *message* on *topic* (None: nothing is sent). With *settled* only once nothing is awaited any more."""

    topic: str | None
    message: Any
    after: float = 0.0
    settled: bool = False


class Input(NamedTuple):
    """Messages that are sent on *topic*: a strategy, or what makes one of the messages *seen* before, by alias."""

    topic: str
    messages: Any
    alias: str | None = None

    def strategy(self, seen: Seen) -> Strategy:
        return self.messages(seen) if callable(self.messages) else self.messages


class Spacing(NamedTuple):
    """An assumption on rates: after *first* (that *first_is* holds of) no *second* (that *second_is* holds of) within *seconds*."""

    first: str
    second: str
    seconds: float
    first_is: Predicate | None = None
    second_is: Predicate | None = None


def between(least: int, most: int, *inputs: Input) -> Part:
    """*least* to *most* messages of any of *inputs*."""

    def part(draw: Callable[[Strategy], Any], gaps: Sequence[float], seen: Seen) -> list[Step]:
        here = [item for item in inputs if item.topic not in seen.get(SILENT, ())]
        if not here:
            return []
        return [_sent(draw, gaps, seen, here) for _ in range(draw(st.integers(least, most)))]

    return part


def one(*inputs: Input) -> Part:
    """One message of one of *inputs*."""
    return between(1, 1, *inputs)


def _sent(draw: Callable[[Strategy], Any], gaps: Sequence[float], seen: Seen, inputs: Sequence[Input]) -> Step:
    chosen = inputs[0] if len(inputs) == 1 else draw(st.sampled_from(list(inputs)))
    message = draw(chosen.strategy(seen))
    if chosen.alias is not None:
        seen[chosen.alias] = message
    return Step(chosen.topic, message, draw(st.sampled_from(list(gaps))))


def settled() -> Part:
    """Wait until nothing is awaited: every trigger is answered, or too late to be."""
    return lambda draw, gaps, seen: [Step(None, None, 0.0, True)]


def pause(seconds: float) -> Part:
    """Send nothing for so long."""
    return lambda draw, gaps, seen: [Step(None, None, seconds)]


def either(*parts: Part) -> Part:
    """One of *parts*."""
    return lambda draw, gaps, seen: parts[draw(st.integers(0, len(parts) - 1))](draw, gaps, seen)


def perhaps(*parts: Part) -> Part:
    """*parts* one after the other, or nothing."""

    def part(draw: Callable[[Strategy], Any], gaps: Sequence[float], seen: Seen) -> list[Step]:
        if not draw(st.booleans()):
            return []
        return [step for inner in parts for step in inner(draw, gaps, seen)]

    return part


def in_order(*parts: Part) -> Part:
    """*parts* one after the other."""
    return lambda draw, gaps, seen: [step for inner in parts for step in inner(draw, gaps, seen)]


def plans(
    *parts: Part, gaps: Sequence[float] = GAPS, spacings: Sequence[Spacing] = (), silent: Sequence[str] = ()
) -> Strategy:
    """Plans of *parts*; messages come no sooner after each other than the *spacings* allow, and none on topics that are *silent*."""

    def drawn(draw: Callable[[Strategy], Any]) -> tuple[Step, ...]:
        seen: Seen = {SILENT: silent}
        quick = [gap for gap in gaps if gap <= QUICK]
        chosen = gaps if not quick or draw(st.booleans()) else quick
        steps = [step for part in parts for step in part(draw, chosen, seen)]
        return spaced(steps, spacings)

    return st.composite(drawn)()


def spaced(steps: Sequence[Step], spacings: Sequence[Spacing]) -> tuple[Step, ...]:
    """*steps*, each as much later as the *spacings* ask for. What is waited for until something is settled counts as no time."""
    found: list[Step] = []
    now = 0.0
    sent: list[tuple[float, Step]] = []
    for step in steps:
        earliest = max([now + step.after, *(_earliest(step, past, at, spacings) for at, past in sent)])
        found.append(step._replace(after=round(earliest - now, 9)) if earliest > now + step.after else step)
        now = earliest
        if step.topic is not None:
            sent.append((now, step))
    return tuple(found)


def _earliest(step: Step, past: Step, at: float, spacings: Sequence[Spacing]) -> float:
    """When *step* may be sent after *past*, which is sent *at* that time. Windows are half-open; a millisecond keeps clocks apart."""
    found = 0.0
    for spacing in spacings:
        if spacing.first == past.topic and spacing.second == step.topic:
            if _holds(spacing.first_is, past.message) and _holds(spacing.second_is, step.message):
                found = max(found, at + spacing.seconds + 0.001)
    return found


def _holds(predicate: Predicate | None, message: Any) -> bool:
    return predicate is None or predicate(message)


def as_json(plan: Sequence[Step]) -> list[Any]:
    """A plan as plain data."""
    return [[step.topic, copy.deepcopy(step.message), step.after, step.settled] for step in plan]
