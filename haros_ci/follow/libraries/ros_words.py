# SPDX-License-Identifier: Apache-2.0
"""Words of a command line that ROS 2 takes for itself: those between ``--ros-args`` and ``--`` (design.ros2.org, "ROS command line arguments")."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import comprehensions
from haros_ci.values.abstract import Cell, Known, Opaque, Sequence, Value

#: The function of rclpy that takes these words away.
REMOVE = "rclpy.utilities.remove_ros_args"
#: What a word is that a launch adds, with the program that does so.
ADDED = "it is {}, which {} gives"
_BEGIN, _END = "--ros-args", "--"
_BEGIN_ADDED = ADDED.format(_BEGIN, "launch")


def _added(program: str, *words: str) -> tuple[Opaque, ...]:
    return tuple(Opaque(ADDED.format(word, program), None, syntax.Type("str")) for word in words)


#: Words that come behind those of the launch file (launch_ros/actions/node.py has ``--ros-args`` in each command).
BY_ROSLAUNCH, BY_LAUNCH = _added("roslaunch", "__name:=", "__log:="), _added("launch", _BEGIN, "-r")


def removed(words: Value | None) -> Value | None:
    """The list *words* without those that ROS 2 takes for itself; None if it is not known which words there are."""
    items = comprehensions.items(words) if words is not None else None
    if items is None:
        return None
    kept: list[Value] = []
    is_of_ros = False
    for item in items:
        text = item.of(str) if isinstance(item, Known) and issubclass(item.kind, str) else ""
        if text == _BEGIN or (isinstance(item, Opaque) and item.reason == _BEGIN_ADDED):
            is_of_ros = True
        elif is_of_ros and text == _END:
            is_of_ros = False
        elif not is_of_ros:
            kept.append(item)
    return Sequence(Cell(tuple(map(Cell, kept))))


def launched(items: list[Value] | None) -> list[str] | None:
    """The words of a launch file of a list that goes on with those that it adds; None if it is no such list, or not known."""
    own, end = (items[:-2], tuple(items[-2:])) if items else ([], ())
    words = [item.of(str) for item in own if isinstance(item, Known) and issubclass(item.kind, str)]
    return words if end in (BY_ROSLAUNCH, BY_LAUNCH) and len(words) == len(own) else None
