# SPDX-License-Identifier: Apache-2.0
"""Topics that nobody here connects to, and whose names are a slip of the one that other programs of ROS have for their type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import (
    TOPIC,
    Check,
    Decidability,
    End,
    Finding,
    Level,
    Project,
    WholeGraph,
    is_letter_slip,
    may_be,
    named_at,
)

#: The names of topics that drivers, robot_state_publisher, rviz, the navigation stacks and image_pipeline have, by type: their documentation at
#: wiki.ros.org and docs.ros.org. Names of less than five letters are too short: one letter makes another word of them.
NAMES = {
    "diagnostic_msgs/DiagnosticArray": ("diagnostics", "diagnostics_agg"),
    "geometry_msgs/PoseStamped": ("goal_pose", "clicked_pose"),
    "geometry_msgs/PoseWithCovarianceStamped": ("initialpose", "amcl_pose"),
    "geometry_msgs/PointStamped": ("clicked_point",),
    "geometry_msgs/PoseArray": ("particlecloud",),
    "geometry_msgs/Twist": ("cmd_vel",),
    "geometry_msgs/TwistStamped": ("cmd_vel",),
    "sensor_msgs/BatteryState": ("battery_state",),
    "sensor_msgs/CameraInfo": ("camera_info",),
    "sensor_msgs/Image": ("image_raw", "image_rect", "image_mono", "image_color", "image_rect_color"),
    "sensor_msgs/JointState": ("joint_states",),
    "std_msgs/String": ("robot_description",),
    "trajectory_msgs/JointTrajectory": ("joint_trajectory",),
    "visualization_msgs/Marker": ("visualization_marker",),
    "visualization_msgs/MarkerArray": ("visualization_marker_array",),
}


def check(project: Project) -> Iterator[Finding]:
    graph = WholeGraph(project.systems)
    for kind, other in (TOPIC, TOPIC[::-1]):
        for (item, name), ends in graph.ends.items():
            if item != kind or graph.of(other, name) or not any(end.in_source for end, _ in ends):
                continue
            usual = {convention for end, _ in ends for convention in _meant(end)}
            vague = (end for end in graph.vague.get(other, ()) if end.type in (None, ends[0][0].type))
            if len(usual) == 1 and not any(may_be(end.name, name) for end in vague):
                yield _finding(ends[0][0], usual.pop())


def _meant(end: End) -> Iterator[str]:
    """The usual names of which the end's is a slip. What differs in case, underscores, digits or a plural is another name as a rule."""
    package, _, rest = (end.type or "").partition("/")
    last = end.name.rpartition("/")[2]
    names = NAMES.get(f"{package}/{rest.rpartition('/')[2]}", ())
    if last not in names:
        yield from (name for name in names if is_letter_slip(last, name) and _bare(last) != _bare(name))


def _bare(name: str) -> str:
    return name.replace("_", "").lower().rstrip("s")


def _finding(end: End, name: str) -> Finding:
    usual = end.name[: end.name.rfind("/") + 1] + name
    return Finding(
        at=named_at(end),
        message=f"{end.word} {end.name} of {end.node} connects to nothing in this workspace, and its name is nearly the usual one for {end.type}: "
        f"did you mean {usual}?",
        about=(end.name,),
        apart=(end.name,),
    )


CHECK = Check(
    id="near-miss-convention",
    summary="Name of a topic that is nearly the usual one for its type.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    tags=("names",),
    project=check,
)
