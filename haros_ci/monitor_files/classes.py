# SPDX-License-Identifier: Apache-2.0
"""One property as a class: its events, their predicates, and what others ask of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.behaviour.tree import Event, Expression, PatternKind
from haros_ci.monitor_files.literals import literal
from haros_ci.monitor_files.predicates import TooDeep, expression_text, predicate_parts
from haros_ci.monitoring.monitor import Monitor, words
from haros_ci.monitoring.predicates import key_of
from haros_ci.records import dataclass

BASES = {
    PatternKind.NO: "No",
    PatternKind.SOME: "Some",
    PatternKind.CAUSES: "Causes",
    PatternKind.FORBIDS: "Forbids",
    PatternKind.REQUIRES: "Requires",
}
#: Longer lines are taken apart.
_WIDTH = 110
_STEP = " " * 4


@dataclass(frozen=True, slots=True)
class Described:
    """A property with its *monitor*, and what is said of it: *title*, *text*, *owner*, *node*, and where it stands (() for nowhere)."""

    monitor: Monitor
    title: str
    text: str
    owner: str = ""
    node: str = ""
    is_axiom: bool = False
    place: tuple[str, int, int] | tuple[()] = ()


def class_text(name: str, described: Described) -> str:
    """The class called *name*; TooDeep where a predicate has too many parts within each other."""
    return "".join(f"{line}\n" for line in _lines(name, described))


def _lines(name: str, described: Described) -> Iterator[str]:
    monitor = described.monitor
    pattern = monitor.property.pattern
    yield f"class {name}({BASES[pattern.kind]}):"
    yield f"{_STEP}title = {literal(described.title)}"
    yield f"{_STEP}text = {literal(described.text)}"
    for key in ("owner", "node", "place"):
        if value := getattr(described, key):
            yield f"{_STEP}{key} = {literal(value)}"
    if described.is_axiom:
        yield f"{_STEP}is_axiom = True"
    if monitor.window is not None:
        yield f"{_STEP}window = {literal(monitor.window)}  # nanoseconds"
        yield f"{_STEP}within = {literal(monitor.within)}"
    yield f"{_STEP}promised = {literal(monitor.promised)}"
    if pattern.kind is PatternKind.REQUIRES:
        yield f"{_STEP}expected = {literal(words(map(monitor.name, pattern.trigger)))}"
    if getattr(monitor, "asks", False):
        yield f"{_STEP}asks = True"
    if monitor.unusable:
        yield f"{_STEP}unusable = {literal(monitor.unusable)}"
    yield ""
    yield f"{_STEP}def events(self) -> list[Event]:"
    yield f"{_STEP * 2}return ["
    for role, events in zip(("ACTIVATOR", "TERMINATOR", "TRIGGER", "BEHAVIOUR"), monitor.events):
        for event in events:
            yield from (f"{_STEP * 3}{line}" for line in _event(monitor, role, event))
    yield f"{_STEP * 2}]"


def _event(monitor: Monitor, role: str, event: Event) -> Iterator[str]:
    """An event in its role as a call, over several lines where it is long."""
    arguments = [*_arguments(monitor, role, event)]
    start = f"{role}, {literal(monitor.name(event))}"
    whole = f"Event({', '.join((start, *(' '.join(lines) for lines in arguments)))}),"
    if len(whole) <= _WIDTH:
        yield whole
        return
    yield "Event("
    yield f"{_STEP}{start},"
    for lines in arguments:
        yield from (f"{_STEP}{line}" for line in lines[:-1])
        yield f"{_STEP}{lines[-1]},"
    yield "),"


def _arguments(monitor: Monitor, role: str, event: Event) -> Iterator[list[str]]:
    """The arguments that are not the usual ones, as lines."""
    if event.predicate is not None:
        of_slots = monitor.is_kept_in_slots(role.lower())
        operator, operands = predicate_parts(event, monitor.constants, of_slots=of_slots)
        yield _test(operator, operands)
    asked, own = monitor.asked_of(event)
    if asked:
        yield [f"alias={literal(event.alias)}"]
        yield _getters("keeps", event, asked, monitor)
    if shown := [*own, *asked]:
        yield _getters("shows", event, shown, monitor)


def _test(operator: str, operands: list[str]) -> list[str]:
    line = f"lambda m, known: {f' {operator} '.join(operands)}"
    if len(line) <= _WIDTH - 20 or len(operands) == 1:
        return [line]
    first, *rest = operands
    return ["lambda m, known: (", f"{_STEP}{first}", *(f"{_STEP}{operator} {part}" for part in rest), ")"]


def _getters(name: str, event: Event, asked: Iterable[Expression], monitor: Monitor) -> list[str]:
    """What others ask of a message, or what is shown of it, by its name."""
    found = {key_of(part): expression_text(event, part, monitor.constants) for part in asked}
    entries = [f"{literal(key)}: lambda m: {text}" for key, text in found.items()]
    line = f"{name}={{{', '.join(entries)}}}"
    if len(line) <= _WIDTH - 20:
        return [line]
    return [f"{name}={{", *(f"{_STEP}{entry}," for entry in entries), "}"]


__all__ = ["Described", "TooDeep", "class_text"]
