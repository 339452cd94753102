# SPDX-License-Identifier: Apache-2.0
"""Which messages are sent in which order, so that a property is put to the test: the parts of a plan for each scope and pattern.

The order follows haros_plugin_pbt_gen 0.4 (before the activator, up to the trigger, after it, the terminator, and messages between that must not
match); here the terminator waits until every answer is there or too late, and ``requires`` and ``forbids`` have plans of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from haros_ci.behaviour.clauses import Clause, Clauses, Reader, TooMany
from haros_ci.behaviour.tree import Binary, Event, Expression, PatternKind, Property, ScopeKind, Variable, parts
from haros_ci.monitor_files.literals import literal
from haros_ci.records import dataclass, field
from haros_ci.test_files.conditions import Boundaries, Scalar, Strategies, both, boundaries
from haros_ci.test_files.suite import Suite, Tested
from haros_ci.test_files.types import Path, TooLarge, Types

#: Seconds: the longest pause before what must not come without a trigger, the longest wait that is chosen among the gaps, and how long an
#: example goes on after its last message where nothing tells when it is over.
LONGEST_PAUSE, LONGEST_GAP, HOLD, LONGEST_HOLD = 2.0, 0.2, 0.15, 1.0
GAPS = (0.0, 0.001, 0.01, 0.05)
#: Operands of ``or`` that are taken one by one.
MOST_APART = 6


@dataclass(slots=True)
class Sent:
    """The *lists* of inputs of the property *number*, as texts of Python by their names in the file, and which of them are *used*."""

    lists: dict[str, list[str]]
    number: int
    used: set[str] = field(default_factory=set)

    def __call__(self, role: str) -> str:
        """The list of this role as arguments of a call; "" where it has nothing."""
        name = f"{role}_{self.number}"
        if not self.lists.get(name):
            return ""
        self.used.add(name)
        return f"*{name}"


class Inputs:
    """Expressions for the messages that are sent in the tests of *suite*. *predicate* names the function of an event's predicate."""

    def __init__(self, suite: Suite, types: Types, predicates: Mapping[int, str]) -> None:
        self.suite = suite
        self.types = types
        self.predicates = predicates
        self.scenes = {
            key: scene for item in (*suite.properties, *suite.assumptions) for key, scene in item.scenes.items()
        }
        self.strategies: dict[str, Strategies] = {}
        self.left_out: list[str] = []
        self.banned: dict[str, list[Event]] = {}
        for item in suite.assumptions:
            scope, pattern = item.parsed.scope, item.parsed.pattern
            if scope.kind is ScopeKind.GLOBALLY and pattern.kind is PatternKind.NO and pattern.bound is None:
                for event in pattern.behaviour:
                    self.banned.setdefault(event.topic, []).append(event)
        near = self._near()
        for topic in suite.inputs:
            message = suite.messages.named(topic.type)
            try:
                if message is None:
                    raise TooLarge(f"the definition of {topic.type} is not known")
                types.function(message.name)
                self.strategies[topic.name] = Strategies(types, message, near.get(topic.name, {}))
            except TooLarge as err:
                self.left_out.append(f"nothing is sent on {topic.name}: {err}")

    def _near(self) -> Mapping[str, Boundaries]:
        found: dict[str, dict[Path, dict[Scalar, None]]] = {}
        for item in (*self.suite.properties, *self.suite.assumptions):
            for event in item.parsed.events:
                for path, values in boundaries(self.clauses(event) or ()).items():
                    found.setdefault(event.topic, {}).setdefault(path, {}).update(dict.fromkeys(values))
        return {topic: {path: tuple(values) for path, values in paths.items()} for topic, paths in found.items()}

    def clauses(self, event: Event, positive: bool = True) -> Clauses | None:
        """The alternatives of the predicate, or of its opposite; None if there are too many."""
        try:
            return Reader(self.scenes[id(event)], event.alias).clauses(event.predicate, positive)
        except TooMany:
            return None

    def apart(self, event: Event) -> Clauses | None:
        """The alternatives of the predicate, before them each operand of ``or`` alone, with none of the others: what one of them does is seen so."""
        whole, reader = self.clauses(event), Reader(self.scenes[id(event)], event.alias)
        operands = list(_operands(event.predicate)) if event.predicate is not None else []
        if whole is None or not 1 < len(operands) <= MOST_APART:
            return whole
        found: list[Clause] = []
        for one in operands:
            try:
                rest = [reader.clauses(other, False) for other in operands if other is not one]
                found += both(reader.clauses(one), *rest) or ()
            except TooMany:
                continue
        return tuple(dict.fromkeys((*found, *whole)))

    def matching(self, events: Iterable[Event]) -> Iterator[str]:
        """Inputs for messages that are one of *events*."""
        for event in events:
            strategies = self.strategies.get(event.topic)
            if strategies is None:
                continue
            allowed, filters = self._allowed(event.topic, ())
            is_free = asks_others(event)
            clauses = both(self.apart(event), allowed)
            own = self.predicates.get(id(event))
            text = strategies.those(clauses, [*([own] if own and not is_free else []), *filters])
            if text is None:
                continue
            if is_free and own:
                text = f"lambda seen: {text}.filter(lambda sent: {own}(sent, seen))"
            alias = f", {literal(event.alias)}" if event.alias is not None else ""
            yield f"Input({literal(event.topic)}, {text}{alias})"

    def other(self, avoided: Sequence[Event]) -> Iterator[str]:
        """Inputs on all open topics for messages that are none of *avoided*."""
        for topic, strategies in self.strategies.items():
            here = [event for event in avoided if event.topic == topic and not asks_others(event)]
            if any(event.predicate is None for event in here):
                continue
            clauses, filters = self._allowed(topic, here)
            text = strategies.any() if not filters else strategies.those(clauses, filters)
            if text is not None:
                yield f"Input({literal(topic)}, {text})"

    def _allowed(self, topic: str, avoided: Sequence[Event]) -> tuple[Clauses | None, list[str]]:
        """What messages on *topic* must be to be none of *avoided*, and nothing that an assumption excludes."""
        events = [*avoided, *(event for event in self.banned.get(topic, ()) if not asks_others(event))]
        filters = [f"no({self.predicates[id(event)]})" for event in events if id(event) in self.predicates]
        if any(event.predicate is None for event in events):
            return (), filters
        return both(*(self.clauses(event, False) for event in events)), filters

    def spacings(self) -> Iterator[str]:
        """Assumptions that say how soon one message may come after another."""
        for item in self.suite.assumptions:
            scope, pattern = item.parsed.scope, item.parsed.pattern
            if scope.kind is not ScopeKind.GLOBALLY or pattern.kind is not PatternKind.FORBIDS or pattern.bound is None:
                continue
            for first in pattern.trigger:
                for second in pattern.behaviour:
                    if first.topic in self.strategies and second.topic in self.strategies:
                        whose = [
                            self.predicates.get(id(event), "None") if not asks_others(event) else "None"
                            for event in (first, second)
                        ]
                        names = ", ".join(map(literal, (first.topic, second.topic, pattern.bound.seconds)))
                        yield f"Spacing({names}, {', '.join(whose)})"


def _operands(expression: Expression) -> Iterator[Expression]:
    """The operands of ``or`` at the top of a predicate."""
    if isinstance(expression, Binary) and expression.operator == "or":
        yield from _operands(expression.left)
        yield from _operands(expression.right)
    else:
        yield expression


def asks_others(event: Event) -> bool:
    """Whether the predicate asks for values of other events."""
    bound = {part.variable for part in parts(event.predicate) if hasattr(part, "variable")}
    names = {part.name for part in parts(event.predicate) if isinstance(part, Variable)}
    return bool(names - bound - {event.alias})


def lists_of(item: Tested, inputs: Inputs) -> dict[str, list[str]]:
    """The lists of inputs that the plan of a property draws from, by role."""
    scope, pattern = item.parsed.scope, item.parsed.pattern
    avoided = (*scope.activator, *scope.terminator, *pattern.trigger)
    return {
        "ACTIVATORS": list(inputs.matching(scope.activator)),
        "TERMINATORS": list(inputs.matching(scope.terminator)),
        "TRIGGERS": list(inputs.matching(pattern.trigger)),
        "OTHERS": list(inputs.other(avoided)),
    }


def hold_of(parsed: Property) -> float:
    """How long an example goes on after its last message, in seconds; ``causes`` and ``some`` say themselves when they are over."""
    pattern = parsed.pattern
    if pattern.kind in (PatternKind.CAUSES, PatternKind.SOME):
        return 0.0
    if pattern.kind is PatternKind.REQUIRES or pattern.bound is None:
        return HOLD
    return min(pattern.bound.seconds, LONGEST_HOLD)


def plan_of(parsed: Property, name: Sent) -> list[str]:
    """The parts of the plan, each an expression; those that would send nothing are left out."""
    inner = _inner(parsed, name)
    rest = _sent("between(0, 2, {})", name("OTHERS"), name("TRIGGERS"))
    opening = _sent("one({})", name("ACTIVATORS"))
    closing = _sent("one({})", name("TERMINATORS"))
    wait = "settled()" if hold_of(parsed) == 0 else f"pause({literal(hold_of(parsed))})"
    again = _group("perhaps", opening, *inner) if opening else ""
    end = _group("perhaps", wait, closing, rest, again) if closing else ""
    before = _sent("between(0, 1, {})", name("OTHERS"))
    match parsed.scope.kind:
        case ScopeKind.GLOBALLY:
            return inner
        case ScopeKind.AFTER:
            return _kept((before, opening, *inner))
        case ScopeKind.UNTIL:
            return _kept((*inner, _group("perhaps", wait, closing, rest) if closing else ""))
        case _:
            return _kept((before, opening, *inner, end))


def _inner(parsed: Property, name: Sent) -> list[str]:
    """What happens while the scope is open."""
    others, triggers = name("OTHERS"), name("TRIGGERS")
    few = _sent("between(0, 2, {})", others)
    match parsed.pattern.kind:
        case PatternKind.NO:
            return _kept((_sent("between(1, 3, {})", others),))
        case PatternKind.SOME:
            return _kept((few, "settled()"))
        case PatternKind.CAUSES:
            some = _sent("between(1, 2, {})", triggers) or _sent("between(1, 4, {})", others)
            return _kept((few, some, few, "settled()"))
        case PatternKind.FORBIDS:
            return _kept((few, _sent("between(1, 2, {})", triggers), _sent("between(0, 3, {})", others)))
        case _:
            return _of_requires(parsed, others, triggers)


def _of_requires(parsed: Property, others: str, triggers: str) -> list[str]:
    """Nothing that allows the behaviour; something that does; and something that no longer does."""
    bound = parsed.pattern.bound
    without, cause = _sent("between(1, 3, {})", others), _sent("one({})", triggers)
    ways = _kept((without, _group("in_order", cause, _sent("between(0, 2, {})", others)) if cause else ""))
    if cause and without and bound is not None and bound.seconds <= LONGEST_PAUSE:
        ways.append(_group("in_order", cause, f"pause({literal(bound.seconds)})", without))
    return ways if len(ways) < 2 else [_group("either", *ways)]


def _sent(form: str, *lists: str) -> str:
    """What sends messages of these lists; "" where none has any."""
    there = _kept(lists)
    return form.format(", ".join(there)) if there else ""


def _group(name: str, *texts: str) -> str:
    return f"{name}({', '.join(_kept(texts))})"


def _kept(texts: Iterable[str]) -> list[str]:
    return [text for text in texts if text]


def gaps_of(parsed: Property) -> tuple[float, ...]:
    """Seconds between messages; half of a short bound is among them."""
    bound = parsed.pattern.bound
    half = bound.seconds / 2 if bound is not None else 0.0
    return (*GAPS, half) if half not in GAPS and half <= LONGEST_GAP else GAPS
