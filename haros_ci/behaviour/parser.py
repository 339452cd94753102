# SPDX-License-Identifier: Apache-2.0
"""HPL texts as properties (hpl-specs 1.4, ``grammars/properties.lark``); HplFault at what is none.

More than hpl-specs reads, as its documentation has it: comments, metadata of any key, rates as time bounds (``within 10 hz`` is 0.1 s).
"""

from __future__ import annotations

from haros_ci.behaviour import dialect
from haros_ci.behaviour.expressions import Expressions, unquoted
from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.scanner import LONGEST_FILE, LONGEST_PROPERTY, Scanner
from haros_ci.behaviour.tree import (
    Bound,
    Event,
    Expression,
    Metadata,
    Pattern,
    PatternKind,
    Place,
    Property,
    Scope,
    ScopeKind,
)

#: Events of one disjunction, metadata of one property, and properties of one file.
MOST_EVENTS = 100
MOST_METADATA = 50
MOST_PROPERTIES = 2_000
#: Seconds of a bound.
LONGEST_TIME = 1_000_000_000_000

KNOWN_METADATA = ("id", "title", "description")
_PATTERNS = ("causes", "forbids", "requires")


def parse_property(text: str) -> Property:
    """The one property that *text* is."""
    scanner = Scanner(text, LONGEST_PROPERTY)
    found = _property(scanner)
    if not scanner.is_at_end:
        raise scanner.fault("the end of the property", dialect.after_event(scanner))
    return found


def parse_file(text: str) -> tuple[Property, ...]:
    """The properties of a whole file; () if it is empty."""
    found, faults = read_file(text)
    if faults:
        raise faults[0]
    return found


def read_file(text: str) -> tuple[tuple[Property, ...], tuple[HplFault, ...]]:
    """The properties of a file as far as they can be read; after a fault reading goes on at the next scope or metadata that begins a line."""
    found: list[Property] = []
    faults: list[HplFault] = []
    try:
        scanner = Scanner(text, LONGEST_FILE)
    except HplFault as fault:
        return (), (fault,)
    while not scanner.is_at_end:
        if len(found) + len(faults) >= MOST_PROPERTIES:
            faults.append(HplFault(f"more than {MOST_PROPERTIES} properties in one file", scanner.here(), "split it"))
            break
        begin = scanner.at
        try:
            found.append(_property(scanner))
        except HplFault as fault:
            faults.append(fault)
            _recover(scanner, begin)
    return tuple(found), tuple(faults)


def _recover(scanner: Scanner, begin: int) -> None:
    """Go on behind the property that begins at *begin* and has a fault: where the next line begins with a scope or with metadata."""
    scanner.inside = 0
    row = scanner.place(begin).line
    is_behind = False  # whether the scope of the property at fault has been seen
    while row < len(scanner.lines) + 1:
        start = scanner.lines[row - 1] if row > scanner.place(begin).line else begin
        end = scanner.lines[row] if row < len(scanner.lines) else len(scanner.text)
        line = scanner.text[start:end].strip()
        is_scope = line.startswith(("globally", "after ", "until "))
        if is_behind and (is_scope or (line.startswith("#") and ":" in line)):
            scanner.at = start
            scanner.skip()
            return
        is_behind = is_behind or is_scope or not line.startswith("#")
        row += 1
    scanner.at = len(scanner.text)


def _property(scanner: Scanner) -> Property:
    metadata = metadata_of(scanner)
    begin = scanner.at
    scope = _scope(scanner)
    if not scanner.sign(":"):
        raise scanner.fault("':' after the scope", dialect.after_event(scanner))
    pattern = _pattern(scanner)
    return Property(scanner.place(begin), scope, pattern, metadata)


def metadata_of(scanner: Scanner) -> tuple[Metadata, ...]:
    """The metadata before a property."""
    found: list[Metadata] = []
    while scanner.is_sign("#"):
        begin = scanner.at
        other = scanner.other_metadata()
        if other is not None:
            value = unquoted(other[1]) if other[1].startswith('"') else other[1].rstrip()
            metadata = Metadata(scanner.place(begin), other[0], value, scanner.place(begin))
        else:
            metadata = _known_metadata(scanner, begin)
        if any(one.key == metadata.key for one in found) and metadata.key in KNOWN_METADATA:
            raise HplFault(f"a second {metadata.key!r} of one property", metadata.at, "keep one of them")
        found.append(metadata)
        if len(found) > MOST_METADATA:
            raise HplFault(f"more than {MOST_METADATA} entries of metadata", metadata.at, "leave some out")
    return tuple(found)


def _known_metadata(scanner: Scanner, begin: int) -> Metadata:
    scanner.sign("#")
    key = scanner.keyword(*KNOWN_METADATA) or ""
    scanner.sign(":")
    at = scanner.at
    if key == "id":
        value = scanner.word()
        if value is None:
            raise scanner.fault("a name, of letters, digits and _", "for example # id: stops_in_time")
    else:
        text = scanner.quoted()
        if text is None:
            raise scanner.fault("a text in double quotes", f'for example # {key}: "…"')
        value = unquoted(text)
    return Metadata(scanner.place(begin), key, value, scanner.place(at))


def _scope(scanner: Scanner) -> Scope:
    begin = scanner.at
    if scanner.keyword("globally"):
        return Scope(scanner.place(begin), ScopeKind.GLOBALLY)
    if scanner.keyword("until"):
        terminator = events(scanner)
        return Scope(scanner.place(begin), ScopeKind.UNTIL, (), terminator)
    if not scanner.keyword("after"):
        raise scanner.fault("'globally', 'after' or 'until'", dialect.scope(scanner))
    activator = events(scanner)
    if scanner.keyword("until"):
        terminator = events(scanner)
        return Scope(scanner.place(begin), ScopeKind.AFTER_UNTIL, activator, terminator)
    return Scope(scanner.place(begin), ScopeKind.AFTER, activator)


def _pattern(scanner: Scanner) -> Pattern:
    begin = scanner.at
    word = scanner.keyword("some", "no")
    first = events(scanner)
    if word is not None:
        bound = time_bound(scanner)
        return Pattern(scanner.place(begin), PatternKind(word), first, (), bound)
    word = scanner.keyword(*_PATTERNS)
    if word is None:
        raise scanner.fault("'causes', 'forbids' or 'requires'", dialect.after_event(scanner))
    second, kind = events(scanner), PatternKind(word)
    bound = time_bound(scanner)
    behaviour, trigger = (first, second) if kind is PatternKind.REQUIRES else (second, first)
    return Pattern(scanner.place(begin), kind, behaviour, trigger, bound)


def events(scanner: Scanner) -> tuple[Event, ...]:
    """One event, or several in parentheses."""
    if not scanner.is_sign("("):
        return (_event(scanner),)
    begin = scanner.here()
    scanner.inside += 1
    scanner.sign("(")
    found = [_event(scanner)]
    while scanner.keyword("or"):
        if len(found) >= MOST_EVENTS:
            raise HplFault(f"more than {MOST_EVENTS} events in one disjunction", begin, "leave some out")
        found.append(_event(scanner))
    if not scanner.is_sign(")"):
        raise scanner.fault("'or' or ')'", dialect.after_event(scanner))
    if len(found) == 1:
        raise scanner.fault("'or' and another event", "one event alone has no parentheses")
    scanner.inside -= 1
    scanner.sign(")")
    return tuple(found)


def _event(scanner: Scanner) -> Event:
    begin = scanner.at
    topic = scanner.topic()
    if topic is None:
        raise scanner.fault("a topic", dialect.topic(scanner))
    topic_at = scanner.place(begin)
    alias: str | None = None
    alias_at: Place | None = None
    if scanner.keyword("as"):
        at = scanner.at
        alias = scanner.word()
        if alias is None:
            raise scanner.fault("a name after 'as'", "for example /topic as A")
        alias_at = scanner.place(at)
    predicate: Expression | None = None
    if scanner.is_sign("{"):
        scanner.inside += 1
        scanner.sign("{")
        if scanner.is_sign("}"):
            raise scanner.fault("a condition", "leave the empty braces out")
        predicate = Expressions(scanner).condition()
        if not scanner.is_sign("}"):
            raise scanner.fault("'}' or an operator", dialect.in_predicate(scanner))
        scanner.inside -= 1
        scanner.sign("}")
    return Event(scanner.place(begin), topic, topic_at, alias, alias_at, predicate)


def time_bound(scanner: Scanner, word: str = "within") -> Bound | None:
    """A time after *word*; None if that does not come next."""
    begin = scanner.at
    if not scanner.keyword(word):
        return None
    number = scanner.number()
    if number is None:
        help_ = "a time is not negative" if scanner.is_sign("-") else f"for example {word} 100 ms"
        raise scanner.fault("a number", help_)
    unit = scanner.keyword(*dialect.UNITS)
    if unit is None:
        raise scanner.fault("a unit: s, ms or hz", dialect.unit(scanner))
    at, amount = scanner.place(begin), float(number)
    if unit == "hz" and not amount:
        raise HplFault("a rate of 0 is no time", at, "write a rate above 0, or leave the bound out")
    seconds = 1 / amount if unit == "hz" else amount / 1000 if unit == "ms" else amount
    if seconds > LONGEST_TIME:
        raise HplFault(f"a time of more than {LONGEST_TIME:,} s", at, "leave the bound out")
    return Bound(at, f"{number} {unit}", seconds)
