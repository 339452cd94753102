# SPDX-License-Identifier: Apache-2.0
"""Launch conditions as presence conditions over the launch arguments, and what is done under other arguments than given."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from haros_ci.launch.ros2.context import NAMESPACE, Context, LaunchBudgetExhausted
from haros_ci.launch.ros2.node import joined_namespace
from haros_ci.launch.ros2.settings import value_of
from haros_ci.model.launch_actions import Action, Phrase, Test
from haros_ci.model.presence import Presence, together
from haros_ci.substitutions.names import Text, derived, literal, unknown
from haros_ci.substitutions.presence import OTHER, Assumed, Question, elsewhere

#: Actions that start something, at once or later.
STARTING = frozenset(
    (
        "group",
        "include",
        "node",
        "lifecycle-node",
        "container",
        "component",
        "load",
        "executable",
        "event",
        "opaque",
        "list",
    )
)
#: Actions under conditions whose outcome is followed where the conditions are otherwise.
SETTING = ("let", "arg", "push-namespace")


@contextmanager
def asking(context: Context) -> Iterator[None]:
    """What is done is of no consequence but for spare steps."""
    before = (context.is_asking, context.rewritten, context.compared)
    context.is_asking, context.rewritten, context.compared = True, dict(context.rewritten), set()
    try:
        with spare(context, context.spare):
            context.spend(4)
            yield
    finally:
        context.is_asking, context.rewritten, context.compared = before


@contextmanager
def spare(context: Context, most: int) -> Iterator[None]:
    """Spend spare steps, *most* of them."""
    if context.is_spare:
        yield
        return
    steps, share = context.steps, min(context.spare, most)
    context.steps, context.is_spare = share, True
    try:
        yield
    finally:
        context.spare -= share - context.steps
        context.steps, context.is_spare = steps, False


def all_of(context: Context, tests: tuple[Test, ...]) -> bool | None:
    """Whether all *tests* hold; None if that is not known."""
    answers = [context.test(test) for test in tests]
    return False if False in answers else None if None in answers else True


def question(context: Context, tests: tuple[Test, ...]) -> Question | None:
    """What may be asked about *tests*; None if no launch argument decides them."""
    assert context.arguments is not None
    with asking(context):
        reads = context.reading((), tests)
    origins = [text.origin for text in reads.values() if text is not None and text.origin is not None]
    depends = {name for origin in origins for name in origin.arguments}
    if not depends:
        return None
    names = context.arguments.order(depends, (origin.argument for origin in origins if origin.argument is not None))
    outer = context.assumed

    def ask(assumed: Assumed) -> bool | None:
        with asking(context):
            context.assumed = {**outer, **assumed}
            try:
                return all_of(context, tests)
            finally:
                context.assumed = outer

    def literals(name: str) -> frozenset[str] | None:
        with asking(context):
            context.assumed = {**outer, name: literal(OTHER)}
            try:
                all_of(context, tests)
                found = frozenset(context.compared)
            finally:
                context.assumed = outer
        return None if None in found else frozenset(item for item in found if item is not None)

    with asking(context):
        now = {name: context.arguments.current(name, outer) for name in names}
    return Question(ask, context.arguments, names, now, literals)


def held(context: Context, tests: tuple[Test, ...]) -> Presence:
    """The presence of what is done under *tests*, which may hold."""
    if context.arguments is None or not tests:
        return context.presence
    try:
        requested = question(context, tests)
        if requested is None:
            return context.presence
        own = requested.because({})[0] if requested.ask({}) else requested.needed()
        return together(context.presence, own) or context.presence
    except LaunchBudgetExhausted:
        if context.is_spare:
            raise
        return context.presence


def otherwise(context: Context, tests: tuple[Test, ...]) -> tuple[dict[str, Text], Presence] | None:
    """The nearest launch arguments under which *tests*, which do not hold, would, and the presence that this has."""
    if context.arguments is None:
        return None
    try:
        requested = question(context, tests)
        return requested.nearest(context.presence) if requested is not None else None
    except LaunchBudgetExhausted:
        if context.is_spare:
            raise
        return None


def key_of(context: Context, action: Action) -> str | None:
    """The configuration that *action* sets under its tests; None if it is none that is followed, or it has none."""
    if context.arguments is None or not action.tests or action.kind not in SETTING:
        return None
    if action.kind == "push-namespace":
        return NAMESPACE
    name = action.get("name")
    try:
        with asking(context):
            text = context.text(name) if name is not None else unknown("it has no name")
    except LaunchBudgetExhausted:
        if context.is_spare:
            raise
        return None
    return text.raw if text.known else None


def stored(context: Context, key: str) -> Text | None:
    """What is set, or would be with other arguments."""
    return context.scope.configurations.get(key) or context.scope.unset.get(key)


def guard(context: Context, action: Action, key: str, before: Text | None) -> None:
    """Let the configuration *key*, which *action* has set or not, depend on the action's tests; *before* it was set."""
    phrases: list[Phrase] = [phrase for name, phrase in action.phrases if name in ("value", "default", "namespace")]
    try:
        with asking(context):
            reads = {**context.reading(phrases, action.tests), key: before}
    except LaunchBudgetExhausted:
        if context.is_spare:
            raise
        return
    origins = [text.origin for text in reads.values() if text is not None and text.origin is not None]
    if not origins:
        return
    path = context.path

    def again(assumed: Assumed) -> Text | None:
        around = context.swapped(reads, assumed, path)
        try:
            holds = all_of(context, action.tests)
            old = context.get(key)
            if holds is None:
                return unknown("it depends on a condition that is not decided")
            if not holds or (action.kind == "arg" and old is not None):
                return old
            if action.kind == "push-namespace":
                return joined_namespace(old, context.text(action.get("namespace") or ()))
            default = action.get("default")
            if action.kind == "arg":
                return None if default is None else context.text(default)
            return value_of(context, action)
        finally:
            context.restore(around)

    origin = derived(origins, again)
    scope = context.scope
    now = scope.configurations.get(key)
    if now is not None:
        scope.configurations[key] = Text(now.raw, now.reasons, origin)
    else:
        scope.unset[key] = elsewhere(origin)
