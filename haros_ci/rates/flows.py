# SPDX-License-Identifier: Apache-2.0
"""How often a node's publish calls run: as numbers, and as shares of the rates of the topics that it subscribes to."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from math import inf

from haros_ci import syntax
from haros_ci.code.body import Call
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.architecture import Endpoint, Node
from haros_ci.model.location import Location
from haros_ci.model.rates import NEVER, Pace, Rate, at_most, either, exactly, total, unknown
from haros_ci.rates.publishers import Publishing, publishing, without_code
from haros_ci.rates.runs import TRANSITION, Runs, runs
from haros_ci.rates.threads import is_joined
from haros_ci.rates.turns import Paced, turns
from haros_ci.rates.written import Written
from haros_ci.records import dataclass, field

#: Calls inside calls, from a callback to where something is published.
DEPTH = 8
#: Why the rate of what answers others is not known, by the kind of its callback.
ASKED = {
    "service": "it runs when a service is called",
    "action": "it runs when a goal comes",
    "response": "it runs when a response comes",
    "parameters": "it runs when parameters are set",
    "transition": TRANSITION,
}

#: From where a subscription is made to the callbacks that filters pass its messages on to.
Filters = Callable[[Location], tuple[Callback, ...]]


@dataclass(frozen=True, slots=True)
class Flow:
    """A rate of its own, and for each topic how often it happens for each message, from the least to the most."""

    own: Rate = NEVER
    topics: tuple[tuple[str, float, float], ...] = ()

    def sometimes(self) -> Flow:
        """The same where it does not happen each time."""
        return Flow(at_most(self.own), tuple((name, 0.0, high) for name, _, high in self.topics))

    def times(self, number: int) -> Flow:
        """The same where it happens that many times instead of once."""
        topics = tuple((name, low * number, high * number) for name, low, high in self.topics)
        return Flow(scaled(self.own, number, number), topics)


@dataclass(frozen=True, slots=True)
class PublishCall:
    """A call that publishes on the *topic* of a node, and how often it does."""

    location: Location
    topic: str
    flow: Flow


@dataclass(frozen=True, slots=True)
class _Context:
    """How often a function runs; *is_once*: where a program or thread begins, and nowhere else.

    *is_alone*: it does not run twice at the same time for one object.
    """

    flow: Flow
    is_once: bool = False
    is_alone: bool = False


@dataclass(slots=True)
class NodeFlows:
    """What is known of one node: the rates of its functions are asked for once."""

    code: Codebase
    node: Node
    #: What the code says where the interpreter does not come by.
    written: Written
    #: The callbacks that filters pass on to what the subscription made at a place receives.
    filtered: Filters = lambda location: ()
    #: The topics that nodes of the configuration publish.
    published: frozenset[str] = frozenset()
    _known: dict[int, _Context] = field(default_factory=dict)
    _active: set[int] = field(default_factory=set)
    #: Functions at which a search has stopped: what it says is for where it began alone.
    _stops: int = 0

    def calls(self, end: Endpoint) -> tuple[tuple[PublishCall, ...], str]:
        """The publish calls of a publisher, and why there may be others; "" if these are all."""
        found, reason = self._publishing(end)
        calls = []
        for routine, call in found.calls:
            flow = self.of_call(routine, call)
            flow = flow.sometimes() if found.is_shared else flow
            calls.append(PublishCall(Location(routine.path, call.line, call.column), end.name, flow))
        return tuple(calls), reason

    def _publishing(self, end: Endpoint) -> tuple[Publishing, str]:
        reason = without_code(end, "publishes")
        if reason or end.location is None:
            return Publishing(()), reason
        found = publishing(self.code, end.location)
        same = [other for other in self.node.endpoints if other.kind == end.kind and other.location == end.location]
        return replace(found, is_shared=len(same) > 1), found.reason

    def of_call(self, routine: Routine, call: Call, depth: int = 0) -> Flow:
        """How often a call in *routine* runs."""
        found = turns(self.code, routine, call)
        if found.reason:
            return Flow(unknown(found.reason))
        context = self.of_routine(routine, depth)
        if found.paced is not None:
            flow = self._paced(found.paced, context)
        elif runs(self.code, routine).is_made and depth == 0:
            flow = Flow(unknown("it runs whenever an object is made"))
        else:
            flow = context.flow
        flow = flow.times(found.times)
        return flow.sometimes() if found.is_sometimes else flow

    def _paced(self, paced: Paced, context: _Context) -> Flow:
        every = self._paces("rate", paced.made) if paced.made is not None else []
        if paced.hertz and not every:
            rate = exactly(round(paced.hertz, 9))
            rate = rate if paced.made is not None else at_most(rate)
        elif every or paced.made is None:
            rate = self._of_paces(every, "the node is not seen to make the rate of the loop")
        else:
            rate = self.written.rate(paced.made)
        if context.is_once:
            return Flow(rate if paced.is_endless else at_most(rate))
        if context.is_alone:
            return Flow(at_most(rate))
        if context.flow.own.reason in ASKED.values() or context.flow.topics or context.flow.own.is_known:
            return Flow(at_most(rate))
        return Flow(unknown(context.flow.own.reason or "it is not known how many such loops run"))

    def _paces(self, kind: str, place: Location) -> list[Pace]:
        found = [pace for pace in self.node.paces if pace.kind == kind and pace.location.path == place.path]
        return [
            pace for pace in found if pace.location.line == place.line and place.column in (None, pace.location.column)
        ]

    def _of_paces(self, every: Iterable[Pace], missing: str) -> Rate:
        result: Rate | None = None
        for pace in every:
            if pace.is_repeated and pace.kind == "timer":
                return unknown("one call makes several timers")
            if pace.hertz is None:
                return unknown(pace.reason or "its period is not greater than zero")
            rate = exactly(round(pace.hertz, 9))
            rate = at_most(rate) if pace.is_conditional and pace.kind == "timer" else rate
            result = rate if result is None else either(result, rate)
        return unknown(missing) if result is None else result

    def of_routine(self, routine: Routine, depth: int = 0) -> _Context:
        """How often a function runs."""
        key = id(routine)
        if key in self._known:
            return self._known[key]
        if depth > DEPTH or key in self._active:
            self._stops += 1
            return _Context(Flow(unknown("functions call each other in a circle, or too deeply to be looked at")))
        self._active.add(key)
        stops = self._stops
        try:
            found = self._of_runs(routine, runs(self.code, routine), depth)
        finally:
            self._active.discard(key)
        if depth == 0 or stops == self._stops:
            self._known[key] = found
        return found

    def _of_runs(self, routine: Routine, found: Runs, depth: int) -> _Context:
        if found.reason:
            return _Context(Flow(unknown(found.reason)))
        flows = [self._of_callback(callback) for callback in found.callbacks]
        is_once = not (flows or found.perhaps or found.asked)
        for where, call in found.calls:
            is_once = is_once and self._runs_once(where, call, depth)
            flows.append(self.of_call(where, call, depth + 1))
        flows += [self.of_call(where, call, depth + 1).sometimes() for where, call in found.perhaps]
        flows += [Flow(unknown(ASKED[kind])) for kind in found.asked]
        for where, call in found.threads:
            if not self._runs_once(where, call, depth):
                is_alone = not flows and len(found.threads) == 1 and is_joined(self.code, where, call)
                return _Context(
                    Flow(unknown("a thread begins with it whenever something else happens")), is_alone=is_alone
                )
        if len(self._mains(routine, found, depth)) + len(found.threads) > 1:
            return _Context(Flow(unknown("several programs, or threads, run it")))
        return _Context(add(flows), is_once)

    def _runs_once(self, where: Routine, call: Call, depth: int) -> bool:
        """Whether a call runs once in the program, or never."""
        placed = turns(self.code, where, call)
        is_plain = placed.paced is None and not placed.reason and placed.times == 1
        return is_plain and self.of_routine(where, depth + 1).is_once

    def _mains(self, routine: Routine, found: Runs, depth: int) -> set[str]:
        """The files of programs that begin with *routine*, or call it where they begin."""
        mains = {routine.path} if found.begins and not found.is_made else set()
        for where, _ in found.calls:
            if runs(self.code, where).begins and self.of_routine(where, depth + 1).is_once:
                mains.add(where.path)
        return mains

    def _of_callback(self, callback: Callback) -> Flow:
        place = callback.location
        if callback.kind in ASKED:
            return Flow(unknown(ASKED[callback.kind]))
        if callback.kind == "timer":
            every = self._paces("timer", place)
            rate = self._of_paces(every, "") if every else self.written.timer(callback)
            if len(every) == 1 and every[0].period is None and not every[0].is_repeated:
                again = self.written.timer(callback)
                rate = again if again.is_known else rate
            if _is_oneshot(callback):
                return Flow(unknown("the timer fires once each time that it is started"))
            why = self._is_changed(callback)
            if why == "setPeriod":
                return Flow(unknown("the period of the timer is set again"))
            return Flow(at_most(rate) if why else rate)
        ends = [end for end in self.node.endpoints if end.kind == "subscribers" and end.location == place]
        if not ends:
            return self._filtered(callback)
        if any("?" in end.name for end in ends):
            return Flow(unknown("the name of the topic is not known"))
        return Flow(NEVER, tuple((end.name, 0.0 if end.conditions or end.is_ruled_out else 1.0, 1.0) for end in ends))

    def _filtered(self, callback: Callback) -> Flow:
        """What filters pass on: at most as often as any one of the topics that they join (message_filters, sync policies)."""
        ends = ((end.name, end.location) for end in self.node.endpoints if end.kind == "subscribers")
        known = [(name, place) for name, place in ends if place is not None and "?" not in name]
        names = sorted({name for name, place in known if any(_is_same(one, callback) for one in self.filtered(place))})
        if not names or callback.maker.path in self.code.mentioning("LatestTime"):
            return Flow(unknown("the node is not seen to make the subscription"))
        chosen = next((name for name in names if name in self.published), names[0])
        return Flow(NEVER, ((chosen, 0.0, 1.0),))

    def _is_changed(self, callback: Callback) -> str:
        """The name of a call that stops a timer, or sets its period, in the file that makes it; "" without one."""
        words = {"setPeriod", "cancel", "stop", "shutdown"}
        for other in self.code.routines(callback.maker.path):
            for call in self.code.body(other).calls:
                if call.name in words and "timer" in _text(call.receiver).lower():
                    return call.name
        return ""


def _is_same(one: Callback, other: Callback) -> bool:
    return one.location == other.location and one.routine is other.routine


def _text(expression: syntax.Expression | None) -> str:
    while isinstance(expression, (syntax.Dereference, syntax.Address)):
        expression = expression.value
    return expression.name if isinstance(expression, (syntax.Name, syntax.Member)) else ""


def _is_oneshot(callback: Callback) -> bool:
    """Whether a timer fires once, or waits to be started (ros/node_handle.h, rospy/timer.py)."""
    plain = [value for value in callback.call.args if not isinstance(value, syntax.Keyword)]
    keywords = {value.name for value in callback.call.args if isinstance(value, syntax.Keyword)}
    if keywords & {"oneshot", "autostart"}:
        return True
    flags = plain[2:] if callback.ros == 1 else []
    return any(not isinstance(value, syntax.This) and not _is_false(value) for value in flags)


def _is_false(value: syntax.Expression) -> bool:
    return isinstance(value, syntax.Boolean) and not value.value


def add(flows: Iterable[Flow]) -> Flow:
    """The flow of what happens as often as all of *flows* together."""
    every = list(flows)
    topics: dict[str, tuple[float, float]] = {}
    for flow in every:
        for name, low, high in flow.topics:
            before = topics.get(name, (0.0, 0.0))
            topics[name] = before[0] + low, before[1] + high
    return Flow(total(flow.own for flow in every), tuple((name, *pair) for name, pair in sorted(topics.items())))


def scaled(rate: Rate, low: float, high: float) -> Rate:
    """What happens from *low* to *high* times for each time that *rate* says."""
    if rate.high == 0 or high == 0:
        return NEVER
    return Rate(rate.low * low, inf if inf in (rate.high, high) else rate.high * high, rate.reason)
