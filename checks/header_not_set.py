# SPDX-License-Identifier: Apache-2.0
"""Stamped messages that are published without a stamp and frame."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Project, regex, syntax
from haros_ci.api.code import Codebase, Routine, call_place, calls_of, dotted, is_dead, type_of, uses, variable

STAMPED = "Accel AccelWithCovariance Point Polygon Pose PoseWithCovariance Quaternion Transform Twist TwistWithCovariance Vector3 Wrench"
#: Messages of common_interfaces whose coordinates mean nothing without the frame that they are in.
FRAMED = frozenset(
    [f"geometry_msgs/{name}Stamped" for name in STAMPED.split()]
    + ["geometry_msgs/PoseArray", "nav_msgs/GridCells", "nav_msgs/OccupancyGrid", "nav_msgs/Odometry", "nav_msgs/Path"]
    + [f"sensor_msgs/{name}" for name in "Imu LaserScan MultiEchoLaserScan PointCloud PointCloud2 Range".split()]
    + ["visualization_msgs/Marker"]
)
#: Commands: who takes them knows the frame.
COMMANDS = frozenset(("geometry_msgs/TwistStamped",))
#: Others whose stamp or frame their readers need.
HEADED = FRAMED | frozenset(
    [f"sensor_msgs/{name}" for name in "Image CompressedImage CameraInfo JointState NavSatFix MagneticField".split()]
    + ["diagnostic_msgs/DiagnosticArray"]
)
#: Those of which only the stamp matters.
TIMED = frozenset(("diagnostic_msgs/DiagnosticArray",))
MAKERS = frozenset(("make_shared", "make_unique"))
#: What has to do with frames, and files that may say so.
_FRAMES = regex(
    r"\btf2?(?:_\w+)?\b|\b(?:Transform(?:Listener|Broadcaster)|(?:static_transform|robot_state)_publisher)\b"
    r"|\bmessage_filters\b|\bTimeSynchronizer\b"
)
_FILES = (".py", ".cpp", ".hpp", ".cc", ".cxx", ".h", ".launch", ".xml", ".yaml", ".yml", ".urdf", ".xacro")


class _Closed:
    """Whether all who subscribe to what a file publishes are in the workspace, and nothing there has to do with frames or RViz."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self._is_without: bool | None = None

    def has(self, path: str, kind: str) -> bool:
        """Whether it is so of the messages of type *kind* that the file at *path* publishes."""
        channels = [channel for system in self.project.systems for channel in system.topics]
        names = {
            channel.name
            for channel in channels
            if any(end.location.path == path and _message(end.type or "") == kind for end in channel.givers)
        }
        takers = [
            end
            for channel in channels
            for end in channel.takers
            if channel.name in names or ("?" in channel.name and end.type in (None, kind))
        ]
        is_here = bool(takers) and all(end.in_source and end.known for end in takers)
        return is_here and not any("?" in name for name in names) and self._is_without_frames()

    def _is_without_frames(self) -> bool:
        if self._is_without is None:
            names = self.project.workspace.names
            self._is_without = not any(
                path.endswith(".rviz") or (path.endswith(_FILES) and _FRAMES.search(self.project.text(path)))
                for path in names
            )
        return self._is_without


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen: set[tuple[int, str]] = set()
    closed = _Closed(project)
    for routine, call in calls_of(code, "publish"):
        if routine.is_test or call.receiver is None or len(call.args) != 1:
            continue
        name = _published(call.args[0])
        kind = _made_here(code, routine, name) if name else None
        if name is None or kind is None or kind not in HEADED:
            continue
        message = _missing(code, routine, name, kind) if (id(routine), name) not in seen else None
        if message and not is_dead(code, routine):
            seen.add((id(routine), name))
            yield Finding(
                at=call_place(routine, call),
                message=f"{name}, a {kind}, is published with {message}",
                about=(routine.title, name, kind),
                level=Level.NOTE if "without frame_id" in message or closed.has(routine.path, kind) else Level.WARNING,
            )


def _published(node: syntax.Expression) -> str | None:
    """The variable that is published: ``a``, ``*a``, ``std::move(a)``."""
    while True:
        if isinstance(node, syntax.Dereference):
            node = node.value
        elif isinstance(node, syntax.Call) and node.callee == syntax.Name("std::move") and node.arguments:
            node = node.arguments[0]
        else:
            return node.name if isinstance(node, syntax.Name) else None


def _made_here(code: Codebase, routine: Routine, name: str) -> str | None:
    """The message type of a local variable that is made empty in the routine itself."""
    if routine.is_python:
        values = [value for target, operator, value, _ in code.body(routine).sets if target == syntax.Name(name)]
        if (
            len(values) != 1
            or not isinstance(values[0], syntax.Call)
            or values[0].arguments
            or any(p.name == name for p in routine.function.parameters)
        ):
            return None
        return _message(dotted(code, routine, values[0].callee))
    found = variable(code, routine, name)
    if not (isinstance(found, tuple) and len(found) == 2) or found[0] is not routine or found[1].is_static:
        return None
    init = found[1].init
    is_empty = init is None or (isinstance(init, (syntax.Braces, syntax.Parentheses)) and not init.arguments)
    if isinstance(init, syntax.Equals):
        value = init.value
        made = value.callee if isinstance(value, syntax.Call) and not value.arguments else None
        is_empty = isinstance(made, syntax.Name)
        if isinstance(made, syntax.Name) and made.name.rpartition("::")[2] not in MAKERS:
            is_empty = made.name != "" and _message(made.name) is not None
    if not is_empty or any(mark in found[1].type.marks for mark in "&*"):
        return None
    kind = type_of(code, routine, syntax.Name(name))
    while (
        kind is not None and kind.name in ("std::shared_ptr", "boost::shared_ptr", "std::unique_ptr") and kind.arguments
    ):
        if init is None:  # a pointer to nothing
            return None
        kind = kind.of(0)
    return _message(kind.name) if kind is not None else None


def _message(name: str) -> str | None:
    parts = [part for part in re.split(r"\.|::|/", name) if part]
    if len(parts) == 3 and parts[1] == "msg":
        parts.pop(1)
    return "/".join(parts) if len(parts) == 2 else None


def _missing(code: Codebase, routine: Routine, name: str, kind: str) -> str | None:
    """What of the header is never set; None if it is set, or may be."""
    set_parts: set[str] = set()
    filled = False
    declared = 0
    for use in uses(code, routine, name):
        if not use.path:
            if use.role == "set" and routine.is_python:
                declared += 1
                continue
            is_published = (
                use.role == "argument"
                and use.call is not None
                and isinstance(use.call.callee, syntax.Member)
                and use.call.callee.name == "publish"
            )
            if not is_published:
                return None
            continue
        if use.path[0] != "header":
            filled = filled or use.role != "read"
            if use.path[0] == "action" and kind.endswith("/Marker"):
                return None
        elif use.role != "read":
            set_parts.add(use.path[1] if len(use.path) > 1 else "header")
    if not filled or "header" in set_parts or declared > 1:
        return None
    if not set_parts and kind in TIMED:
        return (
            "a header without stamp: subscribers do not know the time of the data; set header.stamp before publishing"
        )
    if not set_parts:
        return (
            "an empty header: stamp and frame_id are never set, so subscribers know neither time nor frame of the "
            "data; set both before publishing"
        )
    if "frame_id" not in set_parts and kind in FRAMED - COMMANDS:
        return (
            "a header without frame_id: subscribers do not know the coordinate frame; set header.frame_id before "
            "publishing"
        )
    return None


CHECK = Check(
    id="header-not-set",
    summary="Stamped message published without stamp or frame_id.",
    level=Level.WARNING,
    profiles=("strict",),
    catalogue="C08",
    decidability=Decidability.EXACT,
    tags=("code", "messages"),
    project=check,
)
