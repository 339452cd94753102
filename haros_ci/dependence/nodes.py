# SPDX-License-Identifier: Apache-2.0
"""The dependence in a node: its inputs and outputs, joined with callbacks and publish calls by their places."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.code.body import Call
from haros_ci.code.callbacks import Callback, callbacks
from haros_ci.code.calls import called
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.ways import place
from haros_ci.dependence.conditions import path_of, whens
from haros_ci.dependence.filters import passed_on
from haros_ci.dependence.search import Found, Way, search
from haros_ci.dependence.steps import Step, all_nodes, step_of
from haros_ci.model.architecture import Configuration, Endpoint, Node
from haros_ci.model.dependence import DIRECT, PERHAPS, STATE, Cause, Dependence, Input, NodeDependence, Output
from haros_ci.model.location import Location
from haros_ci.rates.publishers import ACTION_CALLS, CLIENT_CALLS, PUBLISHER_CALLS, Sending, publishing, without_code
from haros_ci.rates.turns import turns
from haros_ci.records import dataclass, field

#: What a node gets, by the kind of its endpoint, and what its callback is called.
INPUTS = {"subscribers": "subscription", "servers": "service", "action_servers": "action"}
OUTPUTS: dict[str, Sending] = {"publishers": PUBLISHER_CALLS, "clients": CLIENT_CALLS, "action_clients": ACTION_CALLS}
TRANSFORMS = ("/tf", "/tf_static")
RANKS = {DIRECT: 0, STATE: 1, PERHAPS: 2}


def dependence_of(configuration: Configuration, code: Codebase) -> Dependence:
    """The dependence in the nodes of a *configuration*, whose programs are in *code*."""
    return Dependence(tuple(node_dependence(node, code) for node in configuration.nodes))


def node_dependence(node: Node, code: Codebase) -> NodeDependence:
    """The dependence in one node."""
    return _Node(node, code).made()


@dataclass(slots=True)
class _Node:
    node: Node
    code: Codebase
    inputs: dict[Location, list[Input]] = field(default_factory=dict)
    #: Those that filters pass on, by where the callback is registered.
    behind: dict[Location, list[Input]] = field(default_factory=dict)

    def made(self) -> NodeDependence:
        for end in self.node.endpoints:
            if end.kind in INPUTS and not end.implicit and not end.is_ruled_out:
                self.input(INPUTS[end.kind], end.name, end.location, end)
        for pace in self.node.paces:
            if pace.kind == "timer":
                self.input("timer", "", pace.location, None)
        outputs = [
            self.output(end)
            for end in self.node.endpoints
            if end.kind in OUTPUTS and not end.implicit and not end.is_ruled_out
        ]
        every = tuple(one for group in self.inputs.values() for one in group)
        reason = next((why.reason for why in self.node.unknowns if why.field == "endpoints"), "")
        return NodeDependence(self.node.name, every, tuple(_order(outputs)), reason)

    def input(self, kind: str, name: str, location: Location | None, end: Endpoint | None) -> None:
        at = location or Location("")
        reason = "" if end is None else without_code(end, "receives")
        if location is None:
            reason = reason or "no code of the workspace receives it"
        elif not reason and not any(
            callback.location == location for callback in _callbacks(self.code).get(location.path, ())
        ):
            passed = passed_on(self.code, location) if kind == "subscription" else ()
            for callback in passed:
                self.behind.setdefault(callback.location, []).append(Input(kind, name, location))
            reason = "" if passed else "it is not seen which function receives it"
        made = Input(kind, name, location, reason)
        if made not in self.inputs.setdefault(at, []):
            self.inputs[at].append(made)

    def output(self, end: Endpoint) -> Output:
        calls, reason = self.calls(end)
        made: dict[tuple[str, str, Location], Cause] = {}
        is_start = False
        for routine, call in calls:
            step = step_of(self.code, routine, call.whole)
            if step is None:
                reason = reason or f"{routine.title} sends it in a way that is not understood"
                continue
            found = search(self.code, routine, step)
            is_start = is_start or found.is_start
            reason = reason or found.reason
            for cause in self.causes(found, routine, call):
                key = cause.kind, cause.name, cause.location
                if key not in made or _rank(cause) < _rank(made[key]):
                    made[key] = cause
        places = tuple(sorted((place(*one) for one in calls), key=lambda at: at.sort_key))
        causes = tuple(sorted(made.values(), key=lambda one: (_rank(one), one.kind, one.name, one.location.sort_key)))
        return Output(end.kind, end.name, end.location, places, causes, is_start, reason)

    def calls(self, end: Endpoint) -> tuple[tuple[tuple[Routine, Call], ...], str]:
        """The calls that send, and why there may be others."""
        reason = without_code(end, "sends")
        if reason or end.location is None:
            return (), reason
        same = [one for one in self.node.endpoints if one.kind == end.kind and one.location == end.location]
        found = publishing(self.code, end.location, OUTPUTS[end.kind])
        return found.calls, found.reason or ("one call makes several of them" if len(same) > 1 else "")

    def causes(self, found: Found, routine: Routine, call: Call) -> Iterator[Cause]:
        for way in found.ways.values():
            place = way.callback.location
            names = [(one.kind, one.name) for one in (*self.inputs.get(place, ()), *self.behind.get(place, ()))]
            if not names and way.callback.kind in ("response", "parameters"):
                names = [(way.callback.kind, "")]
            for kind, name in dict.fromkeys(names):
                yield self.cause(way, kind, name, routine, call)
        for title, reason in sorted(found.transforms.items()):
            for group in tuple(self.inputs.values()):
                for one in group:
                    if one.name in TRANSFORMS and one.location is not None:
                        how = PERHAPS if reason else STATE
                        yield Cause(one.kind, one.name, one.location, how, (title,), reason=reason)

    def cause(self, way: Way, kind: str, name: str, routine: Routine, call: Call) -> Cause:
        is_filtered = way.callback.call.name == "registerCallback"
        is_each = way.how == DIRECT and not is_filtered and _is_each(self.code, way, call)
        conditions = whens(self.code, self.node, way)
        path = path_of(self.code, way, (routine, call))
        return Cause(kind, name, way.callback.location, way.how, way.state, conditions, path, way.reason, is_each)


def _is_each(code: Codebase, way: Way, call: Call) -> bool:
    """Whether each run of the callback sends once, as far as conditions, loops and ways out tell."""
    if way.reason or way.chain[0][0] is not way.callback.routine:
        return False
    for (routine, step), (after, _) in zip(way.chain, (*way.chain[1:], (None, None)), strict=True):
        inner = call if after is None else _call_of(code, routine, step, after)
        if inner is None:
            return False
        found = turns(code, routine, inner)
        if found.is_sometimes or found.paced is not None or found.reason:
            return False
    return True


def _call_of(code: Codebase, routine: Routine, step: Step, target: Routine) -> Call | None:
    """The one call in a step that runs *target*."""
    inside = {id(node) for node in all_nodes(step.values)}
    found = [
        call
        for call in code.body(routine).calls
        if id(call.whole) in inside and target in called(code, routine, call.whole)
    ]
    return found[0] if len(found) == 1 else None


def _callbacks(code: Codebase) -> dict[str, list[Callback]]:
    if "callbacks by file" not in code.kept:
        made: dict[str, list[Callback]] = {}
        for callback in callbacks(code):
            made.setdefault(callback.maker.path, []).append(callback)
        code.kept["callbacks by file"] = made
    found: dict[str, list[Callback]] = code.kept["callbacks by file"]
    return found


def _rank(cause: Cause) -> tuple[int, int, int]:
    return RANKS[cause.how], len(cause.state), len(cause.conditions)


def _order(outputs: list[Output]) -> list[Output]:
    return sorted(outputs, key=lambda one: (one.kind, one.name, one.location.sort_key if one.location else ()))
