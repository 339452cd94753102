# SPDX-License-Identifier: Apache-2.0
"""Calls of ROS libraries without an argument that they require (rclpy/node.py, tf2_ros, launch_ros/actions, rospy, rclcpp/node.hpp)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, regex, syntax
from haros_ci.api.code import (
    Call,
    Codebase,
    Routine,
    base_names,
    calls_of,
    dotted,
    last_part,
    own_method,
    owner_of,
    type_name,
    weighed,
)

#: By ROS: the required parameters of what is imported, by its module's first part and its own name, in their order.
_FUNCTIONS = {
    2: {
        "rclpy.ActionServer": ("node", "action_type", "action_name", "execute_callback"),
        "rclpy.ActionClient": ("node", "action_type", "action_name"),
        "rclpy.create_node": ("node_name",),
        "rclpy.spin": ("node",),
        "tf2_ros.TransformListener": ("buffer", "node"),
        "tf2_ros.TransformBroadcaster": ("node",),
        "tf2_ros.StaticTransformBroadcaster": ("node",),
        "launch.ExecuteProcess": ("cmd",),
        "launch.IncludeLaunchDescription": ("launch_description_source",),
        "launch.SetEnvironmentVariable": ("name", "value"),
        "launch.DeclareLaunchArgument": ("name",),
        "launch.TimerAction": ("period", "actions"),
        "launch.LaunchConfiguration": ("variable_name",),
        "launch_ros.Node": ("executable",),
        "launch_ros.LifecycleNode": ("name", "namespace", "executable"),
        "launch_ros.ComposableNodeContainer": ("name", "namespace", "executable"),
        "launch_ros.ComposableNode": ("package", "plugin"),
        "launch_ros.FindPackageShare": ("package",),
        "launch_ros.SetParameter": ("name", "value"),
        "launch_ros.PushRosNamespace": ("namespace",),
    },
    1: {
        "rospy.Publisher": ("name", "data_class"),
        "rospy.Subscriber": ("name", "data_class"),
        "rospy.Service": ("name", "service_class", "handler"),
        "rospy.ServiceProxy": ("name", "service_class"),
        "rospy.Timer": ("period", "callback"),
        "rospy.init_node": ("name",),
        "actionlib.SimpleActionClient": ("ns", "ActionSpec"),
        "actionlib.SimpleActionServer": ("name", "ActionSpec"),
        "tf2_ros.TransformListener": ("buffer",),
    },
}
#: What takes keywords only before others: launch's classes are called by keywords, whose places nobody counts.
_BY_KEYWORD = frozenset(
    ("ExecuteProcess", "TimerAction", "Node", "LifecycleNode", "ComposableNodeContainer", "ComposableNode")
)
_METHODS = {
    "create_publisher": ("msg_type", "topic", "qos_profile"),
    "create_lifecycle_publisher": ("msg_type", "topic", "qos_profile"),
    "create_subscription": ("msg_type", "topic", "callback", "qos_profile"),
    "create_service": ("srv_type", "srv_name", "callback"),
    "create_client": ("srv_type", "srv_name"),
    "create_timer": ("timer_period_sec", "callback"),
}
_NODES = frozenset(
    ("rclpy.node.Node", "rclpy.Node", "rclpy.lifecycle.Node", "rclpy.lifecycle.LifecycleNode", "rclpy.create_node")
)
#: Types of Python, which rclpy takes for no message.
_BUILT_IN = frozenset(("bool", "bytes", "dict", "float", "int", "list", "object", "str"))
_MODULE = regex(r"(?:[a-z_0-9]+\.)+")
_TYPE = regex(r"[a-z]\w*\.(?:msg|srv)\.\w+")
#: The keywords that launch_ros had for the same before Foxy; deprecated-launch-keyword tells of them.
_OLD = ("node_name", "node_namespace", "node_executable", "package_name", "node_plugin")


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))


def _found(project: Project) -> Iterator[Finding]:
    code = project.code
    names = {key.rpartition(".")[2] for table in _FUNCTIONS.values() for key in table}
    for routine, call in calls_of(code, *sorted(names)):
        if routine.is_python:
            yield from _of_function(code, routine, call)
    for routine, call in calls_of(code, *sorted(_METHODS)):
        if code.ros_of(routine.source) == 2:
            yield from _of_method(code, routine, call) if routine.is_python else _of_cpp(code, routine, call)


def _of_function(code: Codebase, routine: Routine, call: Call) -> Iterator[Finding]:
    name = dotted(code, routine, call.callee)
    head, last = name.partition(".")[0], name.rpartition(".")[2]
    required = _FUNCTIONS.get(code.ros_of(routine.source) or 0, {}).get(f"{head}.{last}")
    if required is not None and _MODULE.fullmatch(name.removesuffix(last)) is not None:
        yield from _lacking(routine, call, last, required)


def _of_method(code: Codebase, routine: Routine, call: Call) -> Iterator[Finding]:
    receiver, required = call.receiver, _METHODS[call.name]
    if receiver is None or own_method(code, routine, call):
        return
    if isinstance(receiver, syntax.This):
        owner = owner_of(code, routine)
        is_node = owner is not None and bool(_NODES & base_names(code, owner))
    else:
        is_node = type_name(code, routine, receiver) in _NODES
    first = call.argument(0, required[0])
    name = dotted(code, routine, first) if first is not None else ""
    if name in _BUILT_IN:  # no message: the node is a stand-in of a test
        return
    is_typed = _TYPE.fullmatch(name) is not None
    if is_node or (is_typed and not _is_defined(code, call.name)):
        yield from _lacking(routine, call, call.name, required)


def _topic(argument: syntax.Expression) -> str:
    return argument.value if isinstance(argument, syntax.String) else syntax.name_of(argument)


def _is_defined(code: Codebase, name: str, separator: str = ".") -> bool:
    """Whether the workspace has a function or method of that name, in Python or (``::``) in C++."""
    key = ("is defined", name, separator)
    if key not in code.kept:
        code.kept[key] = any(
            function.name.rpartition(separator)[2] == name
            for source in code.sources
            if source.separator == separator
            for function in source.program.functions
        )
    return bool(code.kept[key])


def _lacking(routine: Routine, call: Call, name: str, required: tuple[str, ...]) -> Iterator[Finding]:
    if any(isinstance(argument, (syntax.Star, syntax.DoubleStar)) for argument in call.args):
        return
    keywords = {argument.name for argument in call.args if isinstance(argument, syntax.Keyword)}
    plain = sum(not isinstance(argument, syntax.Keyword) for argument in call.args)
    if keywords & {*_OLD} or (name in _BY_KEYWORD and plain):
        return
    lacking = [item for at, item in enumerate(required) if at >= plain and item not in keywords]
    if not lacking:
        return
    since = {
        "qos_profile": " (required since ROS 2 Dashing)",
        "namespace": " (required since ROS 2 Galactic)" if name == "LifecycleNode" else "",
    }.get(lacking[-1], "")
    one = "the argument" if len(lacking) == 1 else "the arguments"
    yield Finding(
        at=Location(routine.path, call.line, call.column),
        message=f"{name}() is called without {one} {' and '.join(lacking)}{since}: Python raises TypeError; pass "
        f"{'it' if len(lacking) == 1 else 'them'}",
        about=(routine.title, name, *lacking),
        apart=(routine.title, name, *lacking),
    )


def _of_cpp(code: Codebase, routine: Routine, call: Call) -> Iterator[Finding]:
    """rclcpp's calls without a depth: they were removed after Dashing."""
    is_subscription = call.name == "create_subscription"
    if call.name not in ("create_subscription", "create_publisher") or not call.templates or call.receiver is None:
        return
    kind = call.templates[0]
    if (
        len(call.args) != (2 if is_subscription else 1)
        or not isinstance(kind, syntax.Type)
        or "::msg::" not in kind.name
    ):
        return
    if own_method(code, routine, call) or _is_defined(code, call.name, "::"):
        return
    argument = call.args[-1]
    is_callback = isinstance(argument, syntax.Lambda) or (
        isinstance(argument, syntax.Call) and last_part(argument.callee) == "bind"
    )
    if not isinstance(argument, syntax.String) if not is_subscription else not is_callback:
        return
    where = "between the topic and the callback" if is_subscription else "after the topic"
    yield Finding(
        at=Location(routine.path, call.line, call.column),
        message=f"{call.name}() is called without a quality of service: this does not compile since ROS 2 Foxy; pass a queue "
        f"size or rclcpp::QoS {where}",
        about=(routine.title, call.name, "qos"),
        apart=(routine.title, call.name, _topic(call.args[0])),
    )


CHECK = Check(
    id="missing-argument",
    summary="Call of a ROS library without a required argument.",
    level=Level.ERROR,
    tags=("python", "cpp"),
    project=check,
)
