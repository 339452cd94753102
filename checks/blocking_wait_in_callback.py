# SPDX-License-Identifier: Apache-2.0
"""Callbacks that wait for what only another callback of the same executor can bring."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, syntax
from haros_ci.api.code import (
    Call,
    Codebase,
    Place,
    Reached,
    Routine,
    call_place,
    client_made,
    dotted,
    excludes,
    in_callbacks,
    node_name,
    variable,
)

SPINS = frozenset(("spin", "spin_some", "spin_all", "spin_once", "spin_until_future_complete"))
WAITS = frozenset(("get", "wait", "wait_for", "wait_until"))
#: The functions of rclpy that spin a node, and what two of them leave behind (rclpy/__init__.py).
OF_RCLPY = frozenset(("spin", "spin_once", "spin_until_future_complete"))
REMOVED = (
    "spins its own node: when rclpy.{}() returns it takes the node from its executor, so that none of its callbacks "
    "runs any more; await the future in an async callback, or add a callback with add_done_callback()"
)
KINDS = frozenset(("subscription", "timer", "service", "response", "parameters"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen: set[int] = set()
    words = ("spin", "async_send_request", "call_async", ".call(")
    paths = code.mentioning(*words)
    for reached in in_callbacks(code):
        if reached.callback.ros != 2 or reached.callback.kind not in KINDS or reached.routine.path not in paths:
            continue
        for call in code.body(reached.routine).calls:
            if id(call) not in seen and (
                message := _python(code, reached, call) if reached.routine.is_python else _cpp(code, reached, call)
            ):
                seen.add(id(call))
                title = reached.callback.routine.title
                yield Finding(
                    at=call_place(reached.routine, call),
                    message=f"{title} is the callback of a {_kind(reached)}, and {message}",
                    about=(title, reached.routine.title, call.name),
                    flow=reached.flow(call, "it waits here"),
                )


def _kind(reached: Reached) -> str:
    names = {"response": "client's response", "parameters": "change of parameters"}
    return names.get(reached.callback.kind, reached.callback.kind)


STUCK = (
    "waits here for a service response whose client is in the same mutually exclusive callback group: the "
    "executor cannot take the response while this callback runs ({}); "
)
_FOR_EVER = "deadlock"
_FOR_A_TIME = "it waits until the timeout ends, each time, and has no response then"
#: The waits of std::future that end by themselves.
_LIMITED = frozenset(("wait_for", "wait_until"))


def _cpp(code: Codebase, reached: Reached, call: Call) -> str | None:
    routine = reached.routine
    if (
        call.name in SPINS
        and isinstance(call.callee, syntax.Name)
        and call.callee.name == f"rclcpp::{call.name}"
        and call.args
    ):
        if _is_spun(code, reached, call.args[0]):
            return (
                'spins its own node, which an executor already spins: this throws std::runtime_error ("Node has already '
                f'been added to an executor"); pass a callback to {_request(code, routine, call)}, or make the call from a '
                "separate node"
            )
    if call.name == "add_node" and call.args and call.receiver is not None and isinstance(call.receiver, syntax.Name):
        local = variable(code, routine, call.receiver.name)
        is_new = isinstance(local, tuple) and len(local) == 2 and local[0] is routine
        if is_new and _is_spun(code, reached, call.args[0]) and not code.mentioning("remove_node") & {routine.path}:
            return (
                "adds its own node to a second executor: this throws std::runtime_error, because the node already "
                "belongs to an executor; use a separate node"
            )
    if call.name in WAITS and call.receiver is not None and not _polls(call) and not _is_awaited(code, routine, call):
        client = _awaited(code, routine, call.receiver)
        made = client_made(code, routine, client) if client is not None else None
        if (
            made is not None
            and made.node == _node(code, reached)
            and excludes(code, made.group, reached.callback.group)
        ):
            how = _FOR_A_TIME if call.name in _LIMITED else _FOR_EVER
            return (
                STUCK.format(how) + "pass a callback to async_send_request, or give the client its own callback group"
            )
    return None


def _request(code: Codebase, routine: Routine, call: Call) -> str:
    """The method that made the future which *call* waits for; those of requests of services where that is not seen."""
    for argument in call.args[1:2]:
        made: syntax.Expression | None = argument
        if isinstance(made, syntax.Name):
            local = variable(code, routine, made.name)
            made = local[1].value if isinstance(local, tuple) and len(local) == 2 else None
        for _ in range(2):  # ``request.future`` and ``client->async_send_request(…).future``
            made = made.object if isinstance(made, syntax.Member) else made
        callee = made.callee if isinstance(made, syntax.Call) else None
        if isinstance(callee, syntax.Member) and callee.name.startswith("async_"):
            return callee.name
    return "async_send_request"


def _node(code: Codebase, reached: Reached) -> str | None:
    """The node that the callback is of, for code of the same class."""
    made = reached.callback
    return node_name(code, made.maker, made.call.receiver) if made.maker.owner == reached.routine.owner else None


def _is_spun(code: Codebase, reached: Reached, node: syntax.Expression) -> bool:
    """Whether *node* is the one whose executor runs the callback."""
    own = _node(code, reached)
    return own is not None and own == node_name(code, reached.routine, node)


def _polls(call: Call) -> bool:
    """Whether it waits no time at all."""
    if call.name != "wait_for" or not call.args:
        return False
    inner = call.args[0]
    while isinstance(inner, syntax.Call) and len(inner.arguments) == 1:
        inner = inner.arguments[0]
    return bool(isinstance(inner, syntax.Number) and inner.value == 0)


def _is_awaited(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether something before the call has waited for the future already, or has asked whether it is ready."""
    future = _whole(call.receiver)
    return any(
        (other_call.line, other_call.column) < (call.line, call.column)
        and not (other_call.is_bare and _polls(other_call))
        and (
            (other_call.name in WAITS and _whole(other_call.receiver) == future)
            or (other_call.name == "spin_until_future_complete" and future in map(_whole, other_call.args))
        )
        for other_call in code.body(routine).calls
    )


def _whole(future: syntax.Expression | None) -> syntax.Expression | None:
    """A future itself: ``result`` of ``result.future``."""
    return future.object if isinstance(future, syntax.Member) and future.name == "future" else future


def _awaited(code: Codebase, routine: Routine, future: syntax.Expression) -> syntax.Expression | None:
    """The client of the request that a future is of: ``client->async_send_request(...)``, through a local variable."""
    if isinstance(future, syntax.Member) and future.name == "future":
        future = future.object
    if isinstance(future, syntax.Name):
        local = variable(code, routine, future.name)
        if not (isinstance(local, tuple) and len(local) == 2) or local[1].value is None:
            return None
        future = local[1].value
    return (
        _client(future, "async_send_request")
        if isinstance(future, syntax.Call) and len(future.arguments) == 1
        else None
    )


def _client(call: syntax.Expression, method: str) -> syntax.Expression | None:
    """What *method* is called on; None for other calls."""
    callee = call.callee if isinstance(call, syntax.Call) else None
    return callee.object if isinstance(callee, syntax.Member) and callee.name == method else None


def _python(code: Codebase, reached: Reached, call: Call) -> str | None:
    routine = reached.routine
    client = None
    if call.name == "call" and call.receiver is not None:
        client = call.receiver
    elif call.name in OF_RCLPY and dotted(code, routine, call.callee) == f"rclpy.{call.name}":
        if not call.args or not _is_spun(code, reached, call.args[0]):
            return None
        if call.name == "spin":
            return (
                "spins its own node: the call never returns, and no other callback of its group runs; remove the call"
            )
        client = _requested(code, routine, call.args[1]) if len(call.args) > 1 else None
    made = client_made(code, routine, client) if client is not None else None
    if made is not None and made.node == _node(code, reached) and excludes(code, made.group, reached.callback.group):
        return (
            STUCK.format(_FOR_A_TIME if _ends_by_itself(call) else _FOR_EVER)
            + "await call_async, or give the client its own callback group and spin with a MultiThreadedExecutor"
        )
    if call.name not in ("spin_once", "spin_until_future_complete"):
        return None
    if routine.path not in code.mentioning("rclpy.spin(", ".spin()"):
        return None  # a loop of spin_once() adds the node again each time
    if call.name == "spin_once" and any(_is_endless(place) for place in call.around):
        return None  # so does a loop in the callback that never ends
    is_given = call.argument(2 if call.name == "spin_until_future_complete" else 1, "executor") is not None
    is_given = is_given or any(isinstance(argument, (syntax.Star, syntax.DoubleStar)) for argument in call.args)
    return None if is_given else REMOVED.format(call.name)


def _ends_by_itself(call: Call) -> bool:
    """Whether a wait of rclpy has a timeout (Client.call() and spin_until_future_complete(): None waits for ever)."""
    limit = call.argument(3 if call.name == "spin_until_future_complete" else 1, "timeout_sec")
    return limit is not None and not isinstance(limit, syntax.Null)


def _is_endless(place: Place) -> bool:
    """Whether a loop ends with ROS alone."""
    text = place.statement.text if isinstance(place.statement, syntax.Loop) else ""
    return re.sub(r"\s", "", text) in ("rclpy.ok()", "True", "1")


def _requested(code: Codebase, routine: Routine, future: syntax.Expression) -> syntax.Expression | None:
    """The client of ``client.call_async(...)`` that a future is from."""
    if isinstance(future, (syntax.Name, syntax.Member)):
        values = [value for target, _, value, _ in code.body(routine).sets if target == future]
        future = values[0] if len(values) == 1 else future
    return _client(future, "call_async")


CHECK = Check(
    id="blocking-wait-in-callback",
    summary="Callback that waits for another callback of the same callback group.",
    level=Level.ERROR,
    catalogue="C01",
    tags=("code",),
    project=check,
)
