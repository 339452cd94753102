# SPDX-License-Identifier: Apache-2.0
"""Rules of the kind of DeRoS (Adam, Larsen, Jensen, Schultz: Rule-based dynamic safety monitoring for mobile robots, 2016) as properties.

``when EVENT [for TIME] do EVENT [within TIME]`` and ``when EVENT do not EVENT [for TIME | until EVENT]``. docs/hpl.md has the table of what each
of them is in HPL. What HPL cannot say is refused with the reason; places are those in the rule.
"""

from __future__ import annotations

from haros_ci.behaviour import dialect
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.parser import events, metadata_of, time_bound
from haros_ci.behaviour.scanner import LONGEST_PROPERTY, Scanner
from haros_ci.behaviour.tree import (
    Bound,
    Event,
    Pattern,
    PatternKind,
    Place,
    Property,
    Scope,
    ScopeKind,
    Unary,
    Variable,
    parts,
)

FORM = "for example when /bumper {pressed} do /wheels {speed = 0} within 100 ms"
#: Words of DeRoS and of common sense, and what is written here.
_WORDS = {"if": "write 'when'", "then": "write 'do'", "unless": "write 'when' with the condition negated"}


def parse_rule(text: str) -> Property:
    """The property that a rule is; HplFault at what is none, and at what HPL cannot say."""
    scanner = Scanner(text, LONGEST_PROPERTY)
    metadata = metadata_of(scanner)
    begin = scanner.at
    if not scanner.keyword("when"):
        raise scanner.fault("'when'", _WORDS.get(scanner.peek(), FORM))
    trigger = events(scanner)
    lasting = time_bound(scanner, "for")
    if not scanner.keyword("do"):
        raise scanner.fault("'do'" if lasting is not None else "'for' or 'do'", _before_do(scanner))
    is_forbidden = scanner.keyword("not") is not None
    action = events(scanner)
    scope, pattern = (_forbidding if is_forbidden else _demanding)(scanner, begin, trigger, lasting, action)
    if not scanner.is_at_end:
        raise scanner.fault("the end of the rule", _after_action(scanner))
    return Property(scanner.place(begin), scope, pattern, metadata)


def _forbidding(
    scanner: Scanner, begin: int, trigger: tuple[Event, ...], lasting: Bound | None, action: tuple[Event, ...]
) -> tuple[Scope, Pattern]:
    """``do not …``: never again, for a time, or until something else comes."""
    if lasting is not None:
        raise HplFault(
            "what is forbidden once a condition has lasted cannot be said in HPL",
            lasting.at,
            "leave 'for' out before 'do not', or forbid it as soon as the condition holds",
        )
    if scanner.keyword("until"):
        terminator = events(scanner)
        scope = Scope(scanner.place(begin), ScopeKind.AFTER_UNTIL, trigger, terminator)
        return scope, Pattern(scanner.place(begin), PatternKind.NO, action)
    bound = time_bound(scanner, "for")
    return _globally(scanner, begin), Pattern(scanner.place(begin), PatternKind.FORBIDS, action, trigger, bound)


def _demanding(
    scanner: Scanner, begin: int, trigger: tuple[Event, ...], lasting: Bound | None, action: tuple[Event, ...]
) -> tuple[Scope, Pattern]:
    """``do …``: it comes, or, where the condition has to last, the condition ends before."""
    at = scanner.at
    if time_bound(scanner, "for") is not None:
        raise HplFault(
            "how long an action goes on cannot be said in HPL",
            scanner.place(at),
            "leave 'for' out here, or forbid what ends it: when … do not … for 2 s",
        )
    bound = time_bound(scanner)
    if lasting is not None:
        if bound is None:
            raise HplFault(
                "a rule with 'for' needs the time within which the action comes afterwards",
                lasting.at,
                f"for example for {lasting.written} do … within 100 ms",
            )
        action = (*action, _end_of(trigger, action, lasting.at))
        bound = Bound(bound.at, f"{lasting.written} and {bound.written}", lasting.seconds + bound.seconds)
    return _globally(scanner, begin), Pattern(scanner.place(begin), PatternKind.CAUSES, action, trigger, bound)


def _end_of(trigger: tuple[Event, ...], action: tuple[Event, ...], at: Place) -> Event:
    """The event that the condition of the one trigger does not hold any more."""
    event = trigger[0]
    if len(trigger) > 1:
        raise HplFault("'for' is about one event, not about one of several", at, "write a rule for each")
    if event.predicate is None:
        raise HplFault("'for' needs a condition: nothing ends a message", at, "write when /topic {…} for …")
    if any(isinstance(part, Variable) and part.name == event.alias for part in parts(event.predicate)):
        raise HplFault("the condition of a rule with 'for' uses its own alias", event.at, "write its fields without it")
    if any(other.topic == event.topic for other in action):
        message = f"with 'for' the action is on another topic than {event.topic}, whose messages end the condition"
        raise HplFault(message, at, "leave 'for' out")
    return Event(event.at, event.topic, event.topic_at, predicate=Unary(event.predicate.at, "not", event.predicate))


def _globally(scanner: Scanner, begin: int) -> Scope:
    return Scope(scanner.place(begin, begin), ScopeKind.GLOBALLY)


def _before_do(scanner: Scanner) -> str:
    """Help where a rule does not go on to its action."""
    if scanner.peek() == "and":
        return (
            "HPL has no state of several topics: one event triggers a rule; open a scope with the other (after /b: …)"
        )
    if scanner.peek() == "within":
        return "'within' is for the action: when … do … within 100 ms"
    return _WORDS.get(scanner.peek()) or dialect.after_event(scanner)


def _after_action(scanner: Scanner) -> str:
    """Help where something stands behind a rule."""
    if scanner.peek() in ("and", "then") or scanner.next_text() in (",", "&"):
        return "a rule has one action: write a rule for each"
    if scanner.peek() in ("else", "otherwise"):
        return "write another rule, with the condition negated"
    if scanner.next_text() in (";", "."):
        return "leave it out"
    if scanner.peek() == "until":
        return "'until' is for what is forbidden: do not …"
    return dialect.after_event(scanner)
