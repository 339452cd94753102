# SPDX-License-Identifier: Apache-2.0
"""The publish calls of a publisher: what holds the publisher, and whether every mention of that is seen."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call
from haros_ci.code.calls import function_meant
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.architecture import Endpoint
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import Part, everything

#: Methods of publishers that publish nothing (ros/publisher.h, rclcpp/publisher.hpp, rospy/topics.py, rclpy/publisher.py).
QUIET = frozenset(
    "getNumSubscribers getTopic isLatched shutdown get_subscription_count get_intra_process_subscription_count get_topic_name "
    "on_activate on_deactivate is_activated reset get_num_connections unregister assert_liveliness get_actual_qos "
    "wait_for_all_acked get_queue_size get get_gid".split()
)
#: Those that publish once for each call.
PUBLISH = frozenset(("publish", "sendTransform"))


@dataclass(frozen=True, slots=True)
class Sending:
    """How objects of a kind send: by the methods called *names*, or by being *called* themselves; *quiet* ones send nothing."""

    names: frozenset[str]
    quiet: frozenset[str]
    is_called: bool = False


PUBLISHER_CALLS = Sending(PUBLISH, QUIET)
#: ros/service_client.h, rclcpp/client.hpp, rospy/impl/tcpros_service.py, rclpy/client.py
CLIENT_CALLS = Sending(
    frozenset(("call", "async_send_request", "call_async")),
    frozenset(
        "exists waitForExistence isValid shutdown getService isPersistent wait_for_service service_is_ready get_service_name "
        "reset get close remove_pending_request prune_pending_requests destroy".split()
    ),
    True,
)
#: actionlib/client/simple_action_client.h, rclcpp_action/client.hpp, actionlib/simple_action_client.py, rclpy/action/client.py
ACTION_CALLS = Sending(
    frozenset(
        "sendGoal sendGoalAndWait async_send_goal send_goal send_goal_and_wait send_goal_async cancelGoal cancelAllGoals "
        "cancel_goal cancel_all_goals async_cancel_goal async_cancel_all_goals cancelGoalsAtAndBeforeTime stopTrackingGoal".split()
    ),
    frozenset(
        "waitForServer waitForResult getState getResult isServerConnected wait_for_server wait_for_result get_state get_result "
        "wait_for_action_server action_server_is_ready server_is_ready async_get_result reset get stop_tracking_goal".split()
    ),
)
#: Operators that only look whether a publisher is there.
TESTS = frozenset(("!", "==", "!=", "&&", "||", "is", "is not", "and", "or", "not"))


@dataclass(frozen=True, slots=True, eq=False)
class Publishing:
    """The *calls* that publish, with their routines; *reason* says why there may be others, "" if these are all.

    *is_shared*: a call may publish on another topic, as one call makes several publishers.
    """

    calls: tuple[tuple[Routine, Call], ...]
    reason: str = ""
    is_shared: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Holder:
    """What a publisher is kept in: a member of a class, or a variable of *routine* or its file; where its call stands."""

    routine: Routine
    name: str
    owner: classes.Owner | None
    is_local: bool


def without_code(end: Endpoint, does: str) -> str:
    """Why no call that *does* (sends, publishes, receives) something with *end* is looked for; "" if one is."""
    if end.source == "hint":
        return f"a hint of the project file says what it is: the code that {does} it is not looked for"
    if end.implicit or end.source not in ("source", "exact-tier") or end.location is None:
        return f"no code of the workspace {does} it"
    return ""


def publishing(code: Codebase, place: Location, sending: Sending = PUBLISHER_CALLS) -> Publishing:
    """The calls that send through the publisher, or client, that the call at *place* makes."""
    key = ("publishing", place)
    if key not in code.kept:
        code.kept[key] = _publishing(code, place, sending)
    found: Publishing = code.kept[key]
    return found


def _publishing(code: Codebase, place: Location, sending: Sending) -> Publishing:
    holders = list(_holders(code, place))
    if len(holders) != 1:
        return Publishing((), "it is not seen what the publisher is kept in")
    holder = holders[0]
    calls: list[tuple[Routine, Call]] = []
    reason = ""
    for routine in _routines(code, holder):
        found, why = _in_routine(code, routine, holder, place, sending)
        calls += found
        reason = reason or why
    if not calls and not reason:
        reason = "no call is seen to publish it"
    return Publishing(tuple(calls), reason)


def _holders(code: Codebase, place: Location) -> Iterator[Holder]:
    for routine in code.routines(place.path):
        body = code.body(routine)
        for target, operator, value, _ in body.sets:
            if operator == "=" and _is_at(value, place):
                holder = _holder(code, routine, target)
                if holder is not None:
                    yield holder
        for name, every in body.variables.items():
            for local in every:
                if local.value is not None and _is_at(local.value, place):
                    yield Holder(routine, name, None, True)


def _is_at(value: Expression, place: Location) -> bool:
    return isinstance(value, syntax.Call) and (value.line, value.column) == (place.line, place.column)


def _holder(code: Codebase, routine: Routine, target: Expression) -> Holder | None:
    if isinstance(target, syntax.Member) and isinstance(target.object, syntax.This):
        owner = classes.owner_of(code, routine)
        return Holder(routine, target.name, owner, False) if owner is not None else None
    if not isinstance(target, syntax.Name) or "::" in target.name:
        return None
    if routine.is_python:
        is_local = bool(routine.function.name) and not _is_global(routine, target.name)
        return Holder(routine, target.name, None, is_local)
    if kinds.is_local(code, routine, target.name):
        return Holder(routine, target.name, None, True)
    owner = classes.owner_of(code, routine)
    if owner is not None and classes.field_of(code, owner, target.name) is not None:
        return Holder(routine, target.name, owner, False)
    is_header = not routine.path.endswith((".cpp", ".cc", ".cxx", ".c"))
    return None if is_header else Holder(routine, target.name, None, False)


def _is_global(routine: Routine, name: str) -> bool:
    return any(
        isinstance(node, syntax.Global) and name in node.names for node in everything(routine.function.body or ())
    )


def _routines(code: Codebase, holder: Holder) -> Iterator[Routine]:
    """The routines that may mention the holder."""
    if holder.owner is not None:
        for path in sorted(code.mentioning(holder.name)):
            if (path.rpartition(".")[2] == "py") == holder.routine.is_python:
                yield from code.routines(path)
        return
    for routine in code.routines(holder.routine.path):
        if not holder.is_local or _is_within(routine, holder.routine):
            yield routine


def _is_within(routine: Routine, outer: Routine) -> bool:
    around: Routine | None = routine
    while around is not None:
        if around is outer:
            return True
        around = around.outer
    return False


def _mentions(code: Codebase, routine: Routine, holder: Holder, node: Expression) -> bool | None:
    """Whether *node* means the holder; None if there is no telling."""
    if holder.owner is None:
        if not isinstance(node, syntax.Name) or node.name != holder.name:
            return False
        if holder.is_local or routine.is_python:
            return True
        return not kinds.is_local(code, routine, holder.name)
    if isinstance(node, syntax.Name):
        if routine.is_python or node.name != holder.name or kinds.is_local(code, routine, node.name):
            return False
    elif not isinstance(node, syntax.Member) or node.name != holder.name:
        return False
    elif not isinstance(node.object, syntax.This):
        return _through(code, routine, holder.owner, node.object)
    own = classes.owner_of(code, routine)
    return own is not None and related(code, own, holder.owner)


def _through(code: Codebase, routine: Routine, owner: classes.Owner, value: Expression) -> bool | None:
    """Whether a member of *value* means that of the holder's class: never for certain, as it is another object's."""
    own = kinds.class_of(code, routine, value)
    if own is None and kinds.type_name(code, routine, value):
        return False
    return None if own is None or related(code, own, owner) else False


def related(code: Codebase, one: classes.Owner, other: classes.Owner) -> bool:
    """Whether one of two classes is the other, or a base of it."""
    if one[1] is other[1] or one[1].name == other[1].name:
        return True
    return one[1].name in classes.base_names(code, other) or other[1].name in classes.base_names(code, one)


def _in_routine(
    code: Codebase, routine: Routine, holder: Holder, place: Location, sending: Sending
) -> tuple[list[tuple[Routine, Call]], str]:
    """The publish calls of a routine, and why there may be others in it or through it."""
    parts = (*routine.function.inits, *(routine.function.body or ()))
    total = 0
    for node in everything(parts):
        if isinstance(node, (syntax.Name, syntax.Member)):
            found = _mentions(code, routine, holder, node)
            if found is None:
                return [], f"{routine.title} may use it through another object"
            total += found
    if not total:
        return [], ""

    def means(node: Expression) -> bool:
        while isinstance(node, (syntax.Dereference, syntax.Address)):
            node = node.value
        return bool(_mentions(code, routine, holder, node))

    calls, seen, reason = _called_on(code, routine, means, sending)
    for target, _, value, _ in code.body(routine).sets:
        if means(target):
            if not (_is_at(value, place) or isinstance(value, syntax.Null) or _is_empty(value)):
                return [], "the publisher is made in several places"
            seen += 1
    seen += _tested(parts, means)
    if reason or seen < total:
        return [], reason or f"{routine.title} gives the publisher to others"
    return calls, ""


def _called_on(
    code: Codebase, routine: Routine, means: Callable[[Expression], bool], sending: Sending
) -> tuple[list[tuple[Routine, Call]], int, str]:
    """The publish calls, the number of all calls on the publisher, and which call may do something else with it."""
    calls, seen, reason = [], 0, ""
    for call in code.body(routine).calls:
        if call.receiver is not None and means(call.receiver):
            if call.name in sending.names:
                calls.append((routine, call))
            elif call.name not in sending.quiet:
                reason = f"{routine.title} calls {call.name} on it"
            seen += 1
        elif sending.is_called and means(call.callee):
            calls.append((routine, call))
            seen += 1
        for position, value in enumerate(call.args):
            seen += means(value) and _only_looks(code, routine, call, position, sending)
    return calls, seen, reason


def _only_looks(code: Codebase, routine: Routine, call: Call, position: int, sending: Sending) -> bool:
    """Whether all functions of the workspace that a call may mean only ask the publisher that they are given at *position* for something."""
    every = [one for one in function_meant(code, routine, call.callee) if classes.accepts(one.function, call.args)]
    return bool(every) and all(_looks(code, one, position, sending) for one in every)


def _looks(code: Codebase, target: Routine, position: int, sending: Sending) -> bool:
    """Whether a function only calls quiet methods on its parameter at *position*."""
    if position >= len(target.function.parameters) or code.body(target).is_partial:
        return False
    only = syntax.Name(target.function.parameters[position].name)
    parts = (*target.function.inits, *(target.function.body or ()))
    seen = _tested(parts, lambda node: node == only)
    seen += sum(call.receiver == only and call.name in sending.quiet for call in code.body(target).calls)
    inner = code.body(target).inner or code.body(target).nested
    return not inner and seen == sum(node == only for node in everything(parts))


def _is_empty(value: Expression) -> bool:
    return isinstance(value, syntax.Name) and value.name in ("nullptr", "NULL", "None")


def _tested(parts: Part, means: Callable[[Expression], bool]) -> int:
    """The number of mentions that only ask whether a publisher is there."""
    found = 0
    for node in everything(parts):
        if isinstance(node, syntax.Operation) and node.operator in TESTS:
            plain = [operand for operand in node.operands if isinstance(operand, (syntax.Name, syntax.Member))]
            found += sum(map(means, plain))
        elif isinstance(node, (syntax.If, syntax.Loop)) and isinstance(node.test, (syntax.Name, syntax.Member)):
            found += means(node.test)
    return found
