# SPDX-License-Identifier: Apache-2.0
"""What types of C++ and Python are in ROS: messages, services, actions, and types of parameters."""

from __future__ import annotations

from haros_ci.index.types import INTEGERS, MAPS, REALS, ROS2_POINTERS, SEQUENCES, STRINGS, pointee
from haros_ci.syntax import Type

WRAPPERS = frozenset(
    f"{space}::{name}"
    for space, names in (
        ("ros", ("MessageEvent", "ServiceEvent")),
        ("message_filters", ("MessageEvent",)),
        ("std", ("reference_wrapper",)),
        ("boost", ("reference_wrapper",)),
    )
    for name in names
)
#: What an action is made of, by its name inside of ``Impl`` (rosidl_generator_cpp and rosidl_generator_py: action templates).
INSIDE_ACTIONS = {
    "SendGoalService": "_SendGoal",
    "GetResultService": "_GetResult",
    "FeedbackMessage": "_FeedbackMessage",
    "CancelGoalService": "action_msgs/srv/CancelGoal",
    "GoalStatusMessage": "action_msgs/msg/GoalStatusArray",
}
#: The ROS 2 parameter types of lists, by that of their elements (rcl_interfaces/msg/ParameterType).
_ARRAYS = {"bool": "bool[]", "int": "int[]", "double": "double[]", "str": "str[]"}
_BYTES = frozenset(("uint8_t", "std::uint8_t", "unsigned char", "std::byte"))
#: Members of traits and containers, which are not types by themselves.
DEPENDENT = frozenset(("type", "value_type", "element_type", "mapped_type", "key_type"))
#: What publishes as another message (pcl_ros, pcl_conversions and tf give them ros::message_traits).
SERIALISED = {
    "pcl/PointCloud": "sensor_msgs/PointCloud2",
    "pcl/PCLPointCloud2": "sensor_msgs/PointCloud2",
    "tf/tfMessage": "tf2_msgs/TFMessage",
}


def message_type(kind: Type | None) -> str | None:
    """``pkg/T`` of a message, service or action type, pointers and events looked through; None if it is no such type.

    Python's ``pkg.msg.T`` is the same; a service's ``::Request`` and ``::Response`` are the service.
    """
    if kind is None:
        return None
    kind = pointee(kind)
    while kind.name in WRAPPERS and (inner := kind.of(0)) is not None:
        kind = pointee(inner)
    name = kind.name
    if "." in name:
        parts = name.split(".")
        if len(parts) >= 3 and parts[-2].strip("_") in ("msg", "srv", "action"):
            return f"{parts[-3]}/{parts[-1].removeprefix('_')}"
        if len(parts) >= 4 and parts[-3] in ("msg", "srv", "action"):
            return f"{parts[-4]}/{parts[-1]}"
        return None
    parts = [part for part in name.split("::") if part]
    if parts and parts[-1] in ("Ptr", "ConstPtr", "SharedPtr", "ConstSharedPtr"):
        parts.pop()
    if len(parts) == 3 and parts[-1] in ("Request", "Response"):
        parts.pop()
    if len(parts) == 3 and parts[1] == "msg":
        parts.pop(1)
    if len(parts) != 2 or parts[1] in DEPENDENT or parts[0] in ("std", "boost", "ros", "ecl", "Eigen"):
        return None
    last = parts[1]
    for suffix in ("ConstPtr", "Ptr"):
        if last.endswith(suffix) and last != suffix:
            last = last.removesuffix(suffix)
            break
    found = f"{parts[0]}/{last.removesuffix('_')}"
    return SERIALISED.get(found, found)


def parameter_type(kind: Type | None) -> str | None:
    """The ROS 1 parameter type that a C++ or Python type stands for: bool, int, double, str or yaml; None if unknown."""
    if kind is None or not kind.name:
        return None
    name = kind.name.removeprefix("::")
    if name == "bool":
        return "bool"
    if name in STRINGS or (name == "char" and "*" in kind.marks):
        return "str"
    if name in REALS:
        return "double"
    if name in INTEGERS or set(name.split()) <= INTEGERS:
        return "int"
    if name in SEQUENCES or name in MAPS or name == "XmlRpc::XmlRpcValue" or name in ("list", "dict"):
        return "yaml"
    return name if name in ("int", "double", "str", "yaml") else None


def is_hidden(kind: Type) -> bool:
    """Whether a type of C++, or that of a list's elements, is another name of one that is not known."""
    inner = kind.of(0) if kind.name in SEQUENCES else kind
    name = inner.name.removeprefix("const ") if inner is not None else ""
    is_known = name in ("", "auto") or name.startswith(("decltype", "rclcpp::")) or inner is None
    return not is_known and parameter_type(inner) is None


def data_type(value: object) -> str | None:
    """The ROS 1 parameter type of plain data."""
    for kind, name in ((bool, "bool"), (int, "int"), (float, "double"), (str, "str"), (list, "yaml"), (dict, "yaml")):
        if isinstance(value, kind):
            return name
    return None


def ros2_type(kind: Type | None) -> str | None:
    """``pkg/msg/T``, ``pkg/srv/T`` or ``pkg/action/T`` of an interface's C++ or Python type; None if it is no such type.

    Pointers, message events and type adapters are looked through; a service's ``::Request`` is the service.
    """
    if kind is None:
        return None
    kind = pointee(kind)
    while kind.name in WRAPPERS and (inner := kind.of(0)) is not None:
        kind = pointee(inner)
    name = kind.name
    if name.startswith("rclcpp::TypeAdapter") and (adapted := kind.of(1)) is not None:
        return ros2_type(adapted)
    if name.startswith("rclcpp::adapt_type") and (last := kind.of(len(kind.arguments) - 1)) is not None:
        return ros2_type(last)
    parts = [part for part in name.replace(".", "::").split("::") if part]
    for index in range(1, len(parts) - 1):
        if parts[index] in ("msg", "srv", "action"):
            rest = parts[index + 1 :]
            if rest[0].startswith("_") and len(rest) > 1:  # Python's pkg.msg._string.String
                rest = rest[1:]
            if parts[index] == "action" and rest[1:2] == ["Impl"]:
                return _of_action(f"{parts[index - 1]}/action/{rest[0]}", rest[2:])
            if rest[1:] and rest[1] not in ROS2_POINTERS | {"Request", "Response", "Goal", "Result", "Feedback"}:
                return None
            return f"{parts[index - 1]}/{parts[index]}/{rest[0].removesuffix('_')}"
    return None


def _of_action(action: str, inner: list[str]) -> str | None:
    """The interface behind an action's ``Impl::FeedbackMessage`` and its kin; None if it is none of these."""
    last = INSIDE_ACTIONS.get(inner[0]) if inner and set(inner[1:]) <= ROS2_POINTERS | {"Request", "Response"} else None
    return last if last is None or "/" in last else f"{action}{last}"


def ros2_parameter_type(kind: Type | None) -> str | None:
    """bool, int, double, str, bytes or a list of these (``int[]``) for a C++ or Python type; None if it is none of them."""
    if kind is None or not kind.name:
        return None
    kind = pointee(kind)
    if kind.name in SEQUENCES:
        inner = kind.of(0)
        if inner is not None and inner.name in _BYTES:
            return "bytes"
        return _ARRAYS.get(ros2_parameter_type(inner) or "")
    found = parameter_type(kind)
    if found == "yaml":
        return None
    return found if found is not None else kind.name if kind.name in ("bytes", *_ARRAYS.values()) else None


def ros2_data_type(value: object) -> str | None:
    """The ROS 2 parameter type of plain data; None for an empty or mixed list."""
    if isinstance(value, (list, tuple)):
        kinds = {data_type(item) for item in value}
        if kinds == {"int", "double"}:
            kinds = {"double"}
        return _ARRAYS.get(kinds.pop() or "") if len(kinds) == 1 else None
    if isinstance(value, bytes):
        return "bytes"
    found = data_type(value)
    return None if found == "yaml" else found
