# SPDX-License-Identifier: Apache-2.0
"""ROS 2 Python: BasicNavigator of nav2_simple_commander (its robot_navigator.py), where that is not in the workspace.

What Nav2 of ROS 2 Humble has is there for certain; later releases have added to it.
"""

from __future__ import annotations

from haros_ci.extract.apis.ros2_rclpy import NODE
from haros_ci.extract.apis.ros2_rclpy import SERVICES as SERVICE_QOS

NAVIGATOR = "nav2_simple_commander.robot_navigator.BasicNavigator"
NEWER = "only newer releases of nav2_simple_commander have it"
ACTIONS = (
    "NavigateThroughPoses NavigateToPose FollowWaypoints FollowPath ComputePathToPose ComputePathThroughPoses SmoothPath "
    "Spin AssistedTeleop"
)
NEWER_ACTIONS = "DriveOnHeading DockRobot UndockRobot ComputeRoute ComputeAndTrackRoute FollowObject"
#: Actions whose names are not their types in lower case.
NAMED_ACTIONS = (("backup", "BackUp", ""), ("follow_gps_waypoints", "FollowGPSWaypoints", NEWER))
SERVICES = (
    ("map_server/load_map", "LoadMap", ""),
    ("global_costmap/clear_entirely_global_costmap", "ClearEntireCostmap", ""),
    ("local_costmap/clear_entirely_local_costmap", "ClearEntireCostmap", ""),
    ("global_costmap/get_costmap", "GetCostmap", ""),
    ("local_costmap/get_costmap", "GetCostmap", ""),
    ("local_costmap/clear_costmap_except_region", "ClearCostmapExceptRegion", NEWER),
    ("local_costmap/clear_costmap_around_robot", "ClearCostmapAroundRobot", NEWER),
    ("local_costmap/clear_costmap_around_pose", "ClearCostmapAroundPose", NEWER),
    ("global_costmap/clear_costmap_around_pose", "ClearCostmapAroundPose", NEWER),
    ("collision_monitor/toggle", "Toggle", NEWER),
)


def lower(name: str) -> str:
    """``NavigateToPose`` as ``navigate_to_pose``."""
    return "".join(f"_{text.lower()}" if text.isupper() else text for text in name).lstrip("_")


def end(kind: str, name: str, type_: str, unsure: str) -> dict[str, object]:
    """An entry of the navigator's constructor."""
    made: dict[str, object] = {"kind": kind, "name": name, "type": type_, "namespace": "{this}"}
    made |= {"qos": SERVICE_QOS} if kind == "clients" else {}
    return made | ({"unsure": unsure} if unsure else {})


MAKES: list[dict[str, object]] = [
    {"kind": "node", "name": "{0|node_name?basic_navigator}", "namespace": "{1|namespace}"},
    *(end("action_clients", lower(name), f"nav2_msgs/action/{name}", "") for name in ACTIONS.split()),
    *(end("action_clients", lower(name), f"nav2_msgs/action/{name}", NEWER) for name in NEWER_ACTIONS.split()),
    *(end("action_clients", name, f"nav2_msgs/action/{kind}", why) for name, kind, why in NAMED_ACTIONS),
    *(end("clients", name, f"nav2_msgs/srv/{kind}", why) for name, kind, why in SERVICES),
    {
        "kind": "publishers",
        "name": "initialpose",
        "type": "geometry_msgs/msg/PoseWithCovarianceStamped",
        "qos": 10,
        "namespace": "{this}",
    },
    {
        "kind": "subscribers",
        "name": "amcl_pose",
        "type": "geometry_msgs/msg/PoseWithCovarianceStamped",
        "qos": "nav2::qos::LatchedPublisherQoS",
        "namespace": "{this}",
    },
]
STATE = "lifecycle_msgs/srv/GetState"

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    {"class": NAVIGATOR, "bases": [NODE]},
    {"call": NAVIGATOR, "makes": MAKES},
    # It asks the localizer and the navigator for their states; robot_localization has none.
    {"call": f"{NAVIGATOR}.waitUntilNav2Active", "args": [0],
     "makes": [{"kind": "clients", "name": "amcl/get_state", "type": STATE, "qos": SERVICE_QOS},
               {"kind": "clients", "name": "bt_navigator/get_state", "type": STATE, "qos": SERVICE_QOS}]},
    {"call": f"{NAVIGATOR}.waitUntilNav2Active",
     "makes": [{"kind": "clients", "name": "{1|localizer?amcl}/get_state", "type": STATE, "qos": SERVICE_QOS,
                "unsure": "the state of robot_localization is not asked for"},
               {"kind": "clients", "name": "{0|navigator?bt_navigator}/get_state", "type": STATE, "qos": SERVICE_QOS}]},
    {"call": f"{NAVIGATOR}.lifecycleStartup", "unseen": "it calls all managers of lifecycle nodes that it finds"},
    {"call": f"{NAVIGATOR}.lifecycleShutdown", "unseen": "it calls all managers of lifecycle nodes that it finds"},
)
# fmt: on
