# SPDX-License-Identifier: Apache-2.0
"""Callbacks: functions that are given to subscriptions, timers, services, actions and clients, with their groups.

The calls are those of docs.ros.org (rclcpp, rclpy, roscpp, rospy, actionlib, message_filters); whatever function is among
their arguments is taken for a callback.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call, last_part
from haros_ci.code.calls import calls_of, function_meant
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.syntax import Expression

#: What the calls make, by the last part of their names; the number of arguments after the callback that come before the group.
CPP = {
    "create_subscription": "subscription",
    "create_generic_subscription": "subscription",
    "create_wall_timer": "timer",
    "create_timer": "timer",
    "create_service": "service",
    "create_server": "action",
    "add_on_set_parameters_callback": "parameters",
    "async_send_request": "response",
    "subscribe": "subscription",
    "advertiseService": "service",
    "createTimer": "timer",
    "createWallTimer": "timer",
    "createSteadyTimer": "timer",
    "registerCallback": "subscription",
}
PYTHON = {
    "create_subscription": "subscription",
    "create_timer": "timer",
    "create_service": "service",
    "add_on_set_parameters_callback": "parameters",
    "add_done_callback": "response",
    "Subscriber": "subscription",
    "Service": "service",
    "Timer": "timer",
    "registerCallback": "subscription",
    "ActionServer": "action",
}
#: What these names have to mean, where other libraries have them, too: the class of the receiver, or the dotted name.
CPP_OWNERS = {
    "subscribe": ("ros::NodeHandle", "image_transport::ImageTransport"),
    "createTimer": ("ros::NodeHandle",),
    "createWallTimer": ("ros::NodeHandle",),
    "createSteadyTimer": ("ros::NodeHandle",),
}
PYTHON_NAMES = {
    "Subscriber": ("rospy.Subscriber",),
    "Service": ("rospy.Service",),
    "Timer": ("rospy.Timer",),
    "ActionServer": ("rclpy.action.ActionServer", "rclpy.action.server.ActionServer"),
}
#: Functions that make a function of another one and arguments.
BINDERS = frozenset(("bind", "partial", "function", "bind_front"))
#: The node's own group: callbacks in it exclude each other.
DEFAULT = ""


@dataclass(frozen=True, slots=True, eq=False)
class Callback:
    """A function that an executor calls: *kind* is subscription, timer, service, action, response or parameters.

    *role* is the keyword or position of the argument. *group* is the callback group as ``Class.member`` or a local name,
    "" for the node's default one, None if it is not known. *maker* is the routine that registers it with *call*.
    """

    kind: str
    role: str
    routine: Routine
    maker: Routine
    call: Call
    ros: int | None
    group: str | None

    @property
    def location(self) -> Location:
        return Location(self.maker.path, self.call.line, self.call.column)


def callbacks(code: Codebase) -> tuple[Callback, ...]:
    """All callbacks of the workspace whose functions are known, by file."""
    if "callbacks" not in code.kept:
        code.kept["callbacks"] = tuple(_all(code))
    found: tuple[Callback, ...] = code.kept["callbacks"]
    return found


def _all(code: Codebase) -> Iterator[Callback]:
    for maker, call in calls_of(code, *sorted({*CPP, *PYTHON})):
        table = PYTHON if maker.is_python else CPP
        kind = table.get(call.name)
        if kind is None or not _is_meant(code, maker, call):
            continue
        ros = _ros(code, maker, call)
        for position, argument in enumerate(call.args):
            role, value = str(position), argument
            if isinstance(argument, syntax.Keyword):
                role, value = argument.name, argument.value
            for routine in given_function(code, maker, value):
                yield Callback(kind, role, routine, maker, call, ros, group_of(code, maker, call))


def _is_meant(code: Codebase, maker: Routine, call: Call) -> bool:
    if maker.is_python:
        names = PYTHON_NAMES.get(call.name)
        return names is None or kinds.dotted(code, maker, call.callee) in names
    owners = CPP_OWNERS.get(call.name)
    if owners is None:
        return True
    return call.receiver is not None and classes.pointed(kinds.type_of(code, maker, call.receiver)) in owners


def _ros(code: Codebase, maker: Routine, call: Call) -> int | None:
    if call.name.startswith(("create_", "add_on", "async_", "add_done", "ActionServer")):
        return 2
    if call.name in ("advertiseService", *CPP_OWNERS) or (maker.is_python and call.name in PYTHON_NAMES):
        return 1
    return code.ros_of(maker.source)


def given_function(code: Codebase, maker: Routine, value: Expression, depth: int = 4) -> tuple[Routine, ...]:
    """The workspace's function that *value* is: a lambda, a method, a bind of one; none if it is not known."""
    if depth <= 0:
        return ()
    if isinstance(value, syntax.Cast):
        return given_function(code, maker, value.value, depth - 1)
    if isinstance(value, syntax.Call):
        last = last_part(value.callee)
        return given_function(code, maker, value.arguments[0], depth - 1) if last in BINDERS and value.arguments else ()
    if isinstance(value, syntax.Name) and not maker.is_python:
        found = kinds.variable(code, maker, value.name)
        if isinstance(found, tuple) and len(found) == 2:
            where, local = found
            return given_function(code, where, local.value, depth - 1) if local.value is not None else ()
        if found is not None:
            return ()
    if isinstance(value, (syntax.Lambda, syntax.Name, syntax.Member, syntax.Address)):
        every = function_meant(code, maker, value)
        return every if len(every) == 1 else ()
    return ()


def group_of(code: Codebase, maker: Routine, call: Call) -> str | None:
    """The callback group that a call puts what it makes into: "" for the default one, None if it is not known."""
    if maker.is_python:
        named = (
            argument
            for argument in call.args
            if isinstance(argument, syntax.Keyword) and argument.name == "callback_group"
        )
        argument = next((keyword.value for keyword in named), None)
        if argument is None:
            return (
                None
                if any(isinstance(argument, (syntax.DoubleStar, syntax.Star)) for argument in call.args)
                else DEFAULT
            )
        return group_name(code, maker, argument)
    counts = {"create_wall_timer": 2, "create_timer": 2, "create_service": 3, "create_client": 2}
    if call.name in counts:
        if call.receiver is None and not _is_method(code, maker, call):
            return None
        count = counts[call.name]
        return DEFAULT if len(call.args) <= count else group_name(code, maker, call.args[count])
    if call.name in ("create_subscription", "create_generic_subscription"):
        if len(call.args) <= 3:
            return DEFAULT
        options = call.args[3]
        if not isinstance(options, syntax.Name):
            return None
        groups = [
            value
            for target, _, value, _ in code.body(maker).sets
            if isinstance(target, syntax.Member) and target.name == "callback_group" and target.object == options
        ]
        local = kinds.variable(code, maker, options.name)
        is_own = isinstance(local, tuple) and len(local) == 2 and local[1].init is None
        if not groups:
            return DEFAULT if is_own else None
        return group_name(code, maker, groups[0]) if len(groups) == 1 else None
    return DEFAULT if call.name in ("add_on_set_parameters_callback",) else None


def _is_method(code: Codebase, maker: Routine, call: Call) -> bool:
    """Whether ``create_timer(...)`` is the node's own, not the library's function of that name."""
    return (
        isinstance(call.callee, syntax.Name)
        and "::" not in call.callee.name
        and classes.owner_of(code, maker) is not None
    )


def group_name(code: Codebase, maker: Routine, value: Expression) -> str | None:
    """A name for a group that is a member or local variable; None for anything else. The default one's name is ""."""
    if isinstance(value, syntax.Null) or (isinstance(value, syntax.Name) and value.name == "nullptr"):
        return DEFAULT
    if isinstance(value, syntax.Member) and isinstance(value.object, syntax.This):
        return f"{maker.owner}.{value.name}"
    if isinstance(value, syntax.Name) and "::" not in value.name:
        if kinds.is_local(code, maker, value.name) or maker.is_python:
            return f"{maker.path}:{maker.function.line}:{value.name}"
        return f"{maker.owner}.{value.name}"
    return None


def groups_made(code: Codebase) -> dict[str, str]:
    """How the groups of members were made: ``mutually exclusive`` or ``reentrant``, by their names."""
    if "groups" not in code.kept:
        found: dict[str, set[str]] = {}
        words = ("create_callback_group", "MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup")
        for path in sorted(code.mentioning(*words)):
            for routine in code.routines(path):
                for target, _, value, _ in code.body(routine).sets:
                    kind = _group_kind(value)
                    name = group_name(code, routine, target) if kind else None
                    if name:
                        found.setdefault(name, set()).add(kind)
                for name, every in code.body(routine).variables.items():
                    for variable in every:
                        kind = _group_kind(variable.assigned) if variable.assigned is not None else ""
                        if kind:
                            found.setdefault(f"{routine.path}:{routine.function.line}:{name}", set()).add(kind)
        code.kept["groups"] = {name: kinds_.pop() for name, kinds_ in found.items() if len(kinds_) == 1}
    made: dict[str, str] = code.kept["groups"]
    return made


def _group_kind(value: Expression) -> str:
    if not isinstance(value, syntax.Call):
        return ""
    text = repr(value.arguments if syntax.name_of(value.callee) == "create_callback_group" else value.callee)
    if "MutuallyExclusive" in text:
        return "mutually exclusive"
    return "reentrant" if "Reentrant" in text else ""


def excludes(code: Codebase, group: str | None, other: str | None) -> bool:
    """Whether two callbacks in these groups of one node surely never run at the same time."""
    if group is None or group != other:
        return False
    return group == DEFAULT or groups_made(code).get(group) == "mutually exclusive"
