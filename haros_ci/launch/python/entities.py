# SPDX-License-Identifier: Apache-2.0
"""The actions that a value stands for where launch wants a launch description, an action or a list of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    Bound,
    Choice,
    Context,
    LaunchObject,
    LibraryCall,
    Maybe,
    ScriptFunction,
    Unknown,
    Value,
    describe,
    why,
)
from haros_ci.model.launch_actions import Action, Test
from haros_ci.model.location import Location

DESCRIPTION = "launch.LaunchDescription"
HARMLESS_KINDS = ("shutdown", "log")


def description(place: Location, entities: list[Value]) -> LaunchObject:
    """A LaunchDescription object."""
    return LaunchObject(DESCRIPTION, place, {"entities": entities})


def unknown_action(reason: str, place: Location, tests: tuple[Test, ...] = ()) -> Action:
    return Action(kind="?", location=place, reason=reason or "it is not known", tests=tests)


def actions_of(run: ScriptEvaluation, value: Value, place: Location, depth: int = 0) -> tuple[Action, ...]:
    """The actions in order; what is not known is an action ``?``."""
    run.budget.step()
    if value is None:
        return ()
    if depth > 30:
        return (unknown_action("the actions are nested too deep", place),)
    if isinstance(value, Maybe):
        return tuple(under(action, value.tests) for action in actions_of(run, value.value, place, depth + 1))
    if isinstance(value, Choice):
        return tuple(
            under(action, tests) for tests, item in value.options for action in actions_of(run, item, place, depth + 1)
        )
    if isinstance(value, Unknown):
        return (unknown_action(value.reason, value.location or place),)
    if isinstance(value, (list, tuple)):
        return tuple(action for item in value for action in actions_of(run, item, place, depth + 1))
    if isinstance(value, LaunchObject) and (value.action is not None or "entities" in value.fields):
        return made_actions(run, value, depth)
    return (
        unknown_action(
            f"{describe(value)} stands where an action belongs, and what it starts is not known",
            getattr(value, "location", None) or place,
        ),
    )


def doubted(run: ScriptEvaluation, actions: tuple[Action, ...], place: Location) -> tuple[Action, ...]:
    """*actions*, all of them under what launch_ros must accept for any of them to be done."""
    if not run.doubts or not actions:
        return actions
    return (Action(kind="list", location=place, children=actions, tests=tuple(run.doubts.values())),)


def under(action: Action, tests: tuple[Test, ...]) -> Action:
    """*action*, if *tests* hold as well."""
    return replace(action, tests=(*tests, *action.tests)) if tests else action


def made_actions(run: ScriptEvaluation, value: LaunchObject, depth: int) -> tuple[Action, ...]:
    if value.action is None:
        children = actions_of(run, value.fields["entities"], value.location, depth + 1)
        return (Action(kind="list", location=value.location, children=children),)
    action = value.action
    if "children" in value.fields:
        action = replace(action, children=actions_of(run, value.fields["children"], value.location, depth + 1))
    if "components" in value.fields:
        action = replace(action, children=components(run, value.fields["components"], value.location))
    later = deferred_actions(run, value.fields.get("on_exit"), value.location, depth + 1)
    if all(item.kind in HARMLESS_KINDS for item in later):
        return (action,)
    return (
        action,
        Action(kind="event", location=value.location, children=later, deferred="on_exit", tests=action.tests),
    )


def deferred_actions(run: ScriptEvaluation, value: Value, place: Location, depth: int) -> tuple[Action, ...]:
    """What an event handler does: actions, or a function of the event and the context that gives some."""
    if isinstance(value, (ScriptFunction, Bound)):
        lost: Any = Unknown("what an event carries is not known", place)
        value = run.apply(value, (lost, Unknown("the context of an event is not known", place)), place)
    return actions_of(run, value, place, depth + 1)


def call_opaque(run: ScriptEvaluation, call: LibraryCall, context: Context) -> tuple[Action, ...]:
    """The actions that an OpaqueFunction returns in *context*."""
    bound = call.bind("function * args kwargs")
    provided = bound.get("args")
    args = tuple(provided) if isinstance(provided, (list, tuple)) else ()
    keywords = bound.get("kwargs")
    if not (provided is None or isinstance(provided, (list, tuple))) or not (
        keywords is None or isinstance(keywords, dict)
    ):
        return (unknown_action("the arguments of an OpaqueFunction are not known", call.location),)
    value = run.call(
        run,
        bound.get("function"),
        LibraryCall(
            name="OpaqueFunction",
            location=call.location,
            args=(context, *args),
            keywords={key: item for key, item in (keywords or {}).items() if isinstance(key, str)},
        ),
    )
    if isinstance(value, LaunchObject) and "entities" in value.fields:
        value = value.fields["entities"]
    return actions_of(run, value, call.location)


def components(run: ScriptEvaluation, value: Value, place: Location) -> tuple[Action, ...]:
    """The composable nodes of a list; one that is not known is an action ``?``."""
    if value is None:
        return ()
    if isinstance(value, LaunchObject) and value.action is not None:
        value = [value]
    items = items_of(run, value, place)
    if isinstance(items, Unknown):
        return (Action(kind="?", location=items.location or place, reason=items.reason),)
    return tuple(action for item in items for action in component_actions(item, place))


def component_actions(item: Value, place: Location) -> tuple[Action, ...]:
    if isinstance(item, Maybe):
        return tuple(under(action, item.tests) for action in component_actions(item.value, place))
    if isinstance(item, Choice):
        return tuple(under(action, tests) for tests, one in item.options for action in component_actions(one, place))
    if isinstance(item, LaunchObject) and item.action is not None and item.action.kind == "component":
        return (item.action,)
    if isinstance(item, (list, tuple)):
        return tuple(action for one in item for action in component_actions(one, place))
    if item is None:
        return ()
    return (Action(kind="?", location=getattr(item, "location", None) or place, reason=why(item)),)
