# SPDX-License-Identifier: Apache-2.0
"""``if`` and ``unless`` as presence conditions over the launch arguments, and what other arguments start and set."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from haros_ci.launch.ros1.scope import LoaderScope
from haros_ci.launch.ros1.state import RoslaunchBudgetExhausted, RoslaunchState
from haros_ci.model.architecture import Condition
from haros_ci.model.launch import LaunchElement
from haros_ci.model.presence import Presence, together
from haros_ci.substitutions.names import Text, derived, literal, unknown
from haros_ci.substitutions.presence import OTHER, Assumed, Question, elsewhere, is_elsewhere
from haros_ci.substitutions.types import boolean

Handler = Callable[[RoslaunchState, LoaderScope, LaunchElement, tuple[Condition, ...]], None]

#: Tags that start or set something for nodes.
STARTING = frozenset(("group", "include", "node", "test", "param", "rosparam"))
#: How many assumptions about args are made inside one another, and what the outermost may cost.
MAX_ASSUMPTIONS = 3
MAX_ASSUMED = 250_000


def perform(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, handler: Handler) -> None:
    """Let *handler* evaluate *tag* if its condition holds, or may hold; else with the nearest args under which it does."""
    if state.arguments is None:
        conditions = state.conditions(scope, tag)
        if conditions is not None:
            handler(state, scope, tag, conditions)
        return
    name = tag.get("name") if tag.tag == "arg" else None
    before = scope.args.get(name) or scope.unset.get(name) if name is not None else None
    conditions = state.conditions(scope, tag)
    if conditions is not None:
        with held(state, scope, tag):
            handler(state, scope, tag, conditions)
    elif tag.tag in STARTING:
        assume(state, scope, tag, lambda inner: handler(state, inner, tag, inner.conditions))
    if name is not None:
        if _is_conditional(tag):
            _guard(state, scope, tag, name, before)
        is_top = len(scope.chain) == 1 and scope.depth == 0 and not state.assumed
        if is_top and tag.get("value") is None and scope.declared.get(name) == tag.line:
            text = scope.args.get(name) or unknown(f"argument '{name}' is not set")
            declared = state.arguments.declare(name, text)
            if name in scope.args:
                scope.args[name] = declared
            else:
                scope.unset[name] = declared


@contextmanager
def held(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> Iterator[None]:
    """What is done under the condition of *tag*, which may hold, has its presence."""
    before = (state.presence, scope.presence)
    if state.arguments is not None and _is_conditional(tag):
        state.presence = scope.presence = _presence(state, scope, tag)
    try:
        yield
    finally:
        state.presence, scope.presence = before


def assume(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, work: Callable[[LoaderScope], None]) -> None:
    """Do *work*, in a scope of its own, with the nearest args under which the condition of *tag*, which does not hold, does.

    What it starts and sets are alternatives; all else is as before.
    """
    if state.arguments is None or state.assumptions >= MAX_ASSUMPTIONS:
        return
    try:
        requested = _question(state, scope, tag)
        found = requested.nearest(scope.presence) if requested is not None else None
    except RoslaunchBudgetExhausted:
        if state.is_spare:
            raise
        return
    if found is None:
        return
    is_outermost = not state.assumptions
    here = (state.assumed, state.presence, state.nodes, state.parameters, state.names)
    tables = (state.machines, state.arguments_shown, state.read, state.included, state.is_partial)
    inner = scope.isolated()
    state.assumed, state.presence = {**state.assumed, **found[0]}, found[1]
    inner.presence = found[1]
    state.nodes, state.parameters, state.names, state.machines = state.alternatives, {}, {}, dict(state.machines)
    state.arguments_shown, state.read, state.included = dict(tables[1]), set(state.read), set(state.included)
    state.assumptions += 1
    try:
        with _spare(state, MAX_ASSUMED):
            work(inner)
    except RoslaunchBudgetExhausted:
        if not is_outermost:
            raise
    finally:
        state.assumptions -= 1
        state.alternative_parameters += [
            parameter for together_ in state.parameters.values() for parameter in together_
        ]
        state.assumed, state.presence, state.nodes, state.parameters, state.names = here
        state.machines, state.arguments_shown, state.read, state.included, state.is_partial = tables


def _is_conditional(tag: LaunchElement) -> bool:
    return tag.get("if") is not None or tag.get("unless") is not None


@contextmanager
def _spare(state: RoslaunchState, most: int) -> Iterator[None]:
    """Spend of what is left for questions and assumptions, up to *most*."""
    if state.is_spare:
        yield
        return
    budget, share = state.budget, min(state.spare, most)
    state.budget, state.is_spare = share, True
    try:
        yield
    finally:
        state.spare -= share - state.budget
        state.budget, state.is_spare = budget, False


def _holds(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> bool | None:
    """Whether the condition of *tag* holds; None if that is not known."""
    conditions = [(name, raw) for name in ("if", "unless") if (raw := tag.get(name)) is not None]
    if len(conditions) != 1:
        return None
    statement, raw = conditions[0]
    return _truth(state.substituted(scope, tag, raw), statement)


def _truth(text: Text, statement: str) -> bool | None:
    try:
        return boolean(text.raw) == (statement == "if") if text.known else None
    except ValueError:
        return None


@contextmanager
def _asking(state: RoslaunchState, assumed: Assumed) -> Iterator[None]:
    before = (state.is_asking, state.assumed, state.compared)
    state.is_asking, state.assumed, state.compared = True, assumed, set()
    try:
        with _spare(state, state.spare):
            state.spend(4)
            yield
    finally:
        state.is_asking, state.assumed, state.compared = before


def _question(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> Question | None:
    """What may be asked about the condition of *tag*; None if no arg of the top level decides it."""
    arguments, outer = state.arguments, state.assumed
    assert arguments is not None
    around, state.reads = state.reads, {}
    try:
        with _asking(state, outer):
            _holds(state, scope, tag)
        reads = state.reads
    finally:
        state.reads = around
    origins = [text.origin for text in reads.values() if text.origin is not None]
    depends = {name for origin in origins for name in origin.arguments}
    if not depends:
        return None

    def ask(assumed: Assumed) -> bool | None:
        with _asking(state, {**outer, **assumed}):
            return _holds(state, scope, tag)

    def literals(name: str) -> frozenset[str]:
        with _asking(state, {**outer, name: literal(OTHER)}):
            _holds(state, scope, tag)
            return frozenset(state.compared)

    names = arguments.order(depends, (origin.argument for origin in origins if origin.argument is not None))
    for raw in (tag.get("if"), tag.get("unless")):
        if raw is not None and raw.startswith("$(arg ") and raw.count("$") == 1 and raw.endswith(")"):
            arguments.tested(next(iter(reads.values())))
    return Question(ask, arguments, names, {name: arguments.current(name, outer) for name in names}, literals)


def _presence(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement) -> Presence:
    try:
        requested = _question(state, scope, tag)
        if requested is None:
            return scope.presence
        own = requested.because({})[0] if requested.ask({}) else requested.needed()
        return together(scope.presence, own) or scope.presence
    except RoslaunchBudgetExhausted:
        if state.is_spare:
            raise
        return scope.presence


def _guard(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: str, before: Text | None) -> None:
    """Let the arg *name*, which *tag* has set or not, depend on the condition of *tag*; *before* it was set."""
    arguments, outer = state.arguments, state.assumed
    value, default = tag.get("value"), tag.get("default")
    raw = value if value is not None else default
    if arguments is None or raw is None:
        return
    statement, condition = next((item, tag.get(item) or "") for item in ("if", "unless") if tag.get(item) is not None)
    try:
        with _asking(state, outer):
            made, tested = state.substituted(scope, tag, raw), state.substituted(scope, tag, condition)
    except RoslaunchBudgetExhausted:
        if state.is_spare:
            raise
        return
    origins = [text.origin for text in (made, tested, before) if text is not None and text.origin is not None]
    if tested.origin is None:
        return

    def again(assumed: Assumed) -> Text | None:
        test = arguments.resolved(tested, assumed)
        old = arguments.resolved(before, assumed) if before is not None else None
        if old is not None and is_elsewhere(old):
            old = None
        holds = _truth(test, statement) if test is not None else None
        if holds is None:
            return unknown("it depends on a condition that is not decided")
        if not holds or (value is None and old is not None):
            return old
        return arguments.resolved(made, assumed)

    origin = derived(origins, again)
    now = scope.args.get(name)
    if now is not None:
        scope.args[name] = replace(now, origin=origin)
    else:
        scope.unset[name] = elsewhere(origin)
