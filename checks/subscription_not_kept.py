# SPDX-License-Identifier: Apache-2.0
"""Subscriptions, services and timers of C++ that end with the function that makes them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, regex, syntax
from haros_ci.api.code import Call, Codebase, Routine, call_place, called, calls_of, is_node, own_method

#: What they are made by, and what that makes.
MADE = {
    "create_subscription": "subscription",
    "create_generic_subscription": "subscription",
    "create_service": "service",
    "create_wall_timer": "timer",
    "create_timer": "timer",
    "subscribe": "subscription",
    "advertiseService": "service",
    "createTimer": "timer",
    "createWallTimer": "timer",
    "createSteadyTimer": "timer",
}
#: Calls that keep a function running while callbacks are called elsewhere.
STAYS = regex(
    r"\b(\w*(spin|sleep|wait|run|exec|join|call\w*Available|getNumPublishers|get)\w*)\s*\(|\b(while|for|do)\b|\bgoto\b"
)
#: ``get()`` of a smart pointer returns at once; that of a future waits for the callback.
_POINTER = regex(r"(?<!future)(?<!Future)(?<!future_)(?<!result)\.get\(\)")


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for routine, call in calls_of(code, *sorted(MADE)):
        if routine.is_python or routine.is_test or routine.function.name == "main":
            continue
        if (
            not is_node(code, routine, call.receiver)
            or called(code, routine, call.whole)
            or own_method(code, routine, call)
            or _is_of_rosserial(code, routine, call)
        ):
            continue
        what = MADE[call.name]
        if call.is_bare:
            yield _finding(
                routine,
                call,
                what,
                (
                    f"the {what} that {call.name} returns is not stored: it is destroyed at once, and its callback is never "
                    "called"
                ),
            )
        else:
            name = _dropped(code, routine, call)
            if name:
                yield _finding(
                    routine,
                    call,
                    what,
                    (
                        f"the {what} is stored only in {name}, a local variable of {routine.title}: it is destroyed when the "
                        "function returns, and its callback is no longer called"
                    ),
                )


def _is_of_rosserial(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether the call hands over the one object that rosserial keeps a pointer to: ``node.subscribe(subscriber)`` (ros/node_handle.h).

    roscpp has such a call with options alone, of SubscribeOptions and the like.
    """
    options = code.mentioning("SubscribeOptions", "AdvertiseServiceOptions")
    is_one = len(call.args) == 1 and isinstance(call.args[0], (syntax.Name, syntax.Member))
    return is_one and call.name in ("subscribe", "advertiseService") and routine.path not in options


def _finding(routine: Routine, call: Call, what: str, message: str) -> Finding:
    return Finding(
        at=call_place(routine, call),
        message=f"{message}; store it in a member of the class",
        about=(routine.title, call.name, _topic(call)),
    )


def _topic(call: Call) -> str:
    return next((argument.value for argument in call.args if isinstance(argument, syntax.String)), "")


def _dropped(code: Codebase, routine: Routine, call: Call) -> str | None:
    """The local variable that alone keeps what a call makes, in a function that just goes on and returns."""
    for name, every in code.body(routine).variables.items():
        for variable in every:
            if variable.is_static or len(every) > 1:
                continue
            if variable.value is not call.whole or "&" in variable.type.marks:
                continue
            if routine.function.kind == "lambda" or any(place.kind == "loop" for place in variable.around):
                return None
            rest = code.lines(routine, variable.line)
            if len(re.findall(rf"\b{re.escape(name)}\b", rest)) != 1 or STAYS.search(_POINTER.sub(" ", rest)):
                return None
            return name
    return None


CHECK = Check(
    id="subscription-not-kept",
    summary="Subscription, service or timer destroyed when the function returns.",
    level=Level.ERROR,
    catalogue="C03",
    tags=("code",),
    project=check,
)
