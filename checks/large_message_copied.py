# SPDX-License-Identifier: Apache-2.0
"""Large messages that components and nodelets copy when they publish them."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, syntax
from haros_ci.api.code import Call, Codebase, Routine, call_place, calls_of, is_local, ros_type, type_name, type_of

LARGE = frozenset(
    f"sensor_msgs/{name}"
    for name in "Image CompressedImage PointCloud PointCloud2 LaserScan MultiEchoLaserScan".split()
) | frozenset(("nav_msgs/OccupancyGrid", "stereo_msgs/DisparityImage"))
PUBLISHERS = frozenset(("rclcpp::Publisher", "ros::Publisher", "rclcpp_lifecycle::LifecyclePublisher"))
POINTERS = frozenset(("std::shared_ptr", "boost::shared_ptr", "std::unique_ptr"))
MACROS = frozenset(("RCLCPP_COMPONENTS_REGISTER_NODE", "PLUGINLIB_EXPORT_CLASS", "PLUGINLIB_DECLARE_CLASS"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    owners = _components(code)
    for routine, call in calls_of(code, "publish"):
        if (
            routine.is_python
            or routine.is_test
            or routine.owner not in owners
            or call.receiver is None
            or len(call.args) != 1
        ):
            continue
        if type_name(code, routine, call.receiver) not in PUBLISHERS:
            continue
        kind = _copied(code, routine, call, owners[routine.owner] == 1)
        if kind in LARGE:
            yield Finding(
                at=call_place(routine, call),
                message=f"a {kind} is copied when it is published, although nodes in the same process could share it; "
                + (
                    "publish a shared_ptr to it"
                    if owners[routine.owner] == 1
                    else "create it with std::make_unique, and publish it with std::move"
                ),
                about=(routine.title, kind or ""),
            )


def _components(code: Codebase) -> dict[str, int]:
    """The classes that are components (2) or nodelets (1)."""
    found: dict[str, int] = {}
    for source in code.sources:
        for macro, args, _, _ in source.program.registered:
            if macro not in MACROS or not args:
                continue
            if macro == "RCLCPP_COMPONENTS_REGISTER_NODE":
                found[args[0].strip().removeprefix("::")] = 2
            elif any("nodelet::Nodelet" in argument for argument in args):
                found[
                    "::".join(argument.strip() for argument in args[:-1])
                    if macro == "PLUGINLIB_DECLARE_CLASS"
                    else args[0].strip()
                ] = 1
    return found


def _copied(code: Codebase, routine: Routine, call: Call, is_shared: bool) -> str | None:
    """The type of the message if it is given by value or as what a pointer points to; None for a pointer itself.

    Where a message *is_shared* to be published, any pointer to it will do; else it has to be one that is made here, to be given away.
    """
    value = call.args[0]
    inner = value.value if isinstance(value, syntax.Dereference) else value
    if not isinstance(inner, (syntax.Name, syntax.Member)):
        return None
    is_own = isinstance(inner, syntax.Name) and is_local(code, routine, inner.name)
    if not isinstance(value, syntax.Dereference) and not is_own:  # a member has to stay
        return None
    if not is_shared and not is_own:
        return None
    kind = type_of(code, routine, inner)
    if not is_shared and inner.name in {parameter.name for parameter in routine.function.parameters}:
        if kind is None or kind.name != "std::unique_ptr":  # others hold it, too
            return None
    if kind is None or "*" in kind.marks:
        return None
    if kind.name in POINTERS:
        if not isinstance(value, syntax.Dereference) or not kind.arguments:
            return None
        kind = kind.of(0)
    elif isinstance(value, syntax.Dereference):
        return None
    return ros_type(kind.name) if kind is not None else None


CHECK = Check(
    id="large-message-copied",
    summary="Large message copied when a component or nodelet publishes it.",
    level=Level.NOTE,
    catalogue="C15",
    profiles=("strict",),
    tags=("code", "performance"),
    project=check,
)
