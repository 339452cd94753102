# SPDX-License-Identifier: Apache-2.0
"""A small ROS 2 and a ROS 1 system, written down as values, for the tests of interfaces and what documents them."""

from __future__ import annotations

from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node, Parameter, Qos, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import Package

CPP = "src/lane/src/lane_node.cpp"
OLD = Location("src/base/src/base.cpp", 1, 3)


def end(kind: str, name: str, type: str | None, line: int = 1, **more: object) -> Endpoint:
    given = {"original_name": name, "location": Location(CPP, line, 3), **more}
    return Endpoint(kind=kind, name=name, type=type, **given)  # type: ignore[arg-type]


RELIABLE = Qos(history="keep_last", depth=1, reliability="reliable", durability="transient_local", deadline=0.5)
PATH = end(
    "publishers", "/planning/path", "nav_msgs/msg/Path", 10, original_name="/planning/lane/output/path", qos=RELIABLE
)
ODOM = end("subscribers", "/odom", "nav_msgs/msg/Odometry", 11, original_name="/planning/odom", qos=Qos(depth=10))
STATUS = end("subscribers", "/vehicle/status", "lane_msgs/msg/Status", 12, qos=Qos(reliability="?", depth="?"))
VAGUE = end(
    "publishers",
    "/planning/lane/debug/?",
    "std_msgs/msg/String",
    13,
    qos=Qos(),
    unknowns=(Unknown("name", "what read--file returns is not known", Location(CPP, 13, 9)),),
)
UNTYPED = end("subscribers", "/planning/hint", None, 14, unknowns=(Unknown("type", "a macro makes it"),))
RESET = end("servers", "/planning/lane/reset", "std_srvs/srv/Trigger", 15)
ASK = end("clients", "/planning/ask", "std_srvs/srv/SetBool", 16)
GO = end("action_servers", "/planning/lane/go", "nav2_msgs/action/Wait", 17)
ECHO = (
    end("publishers", "/planning/echo", "std_msgs/msg/Empty", 18, qos=Qos(history="keep_all")),
    end("subscribers", "/planning/echo", "std_msgs/msg/Empty", 19, qos=Qos(depth=5)),
)
RATE = end("parameters", "/planning/lane:rate", "double", 20, value=10.0, effective=20.0, read_only=True)
FRAME = end("parameters", "/planning/lane:map.frame", "str", 21, value="map", range=(None, None, None))
LIMITS = end("parameters", "/planning/lane:limits", "double[]", 22, value=(1.0, 2.5))
BARE = end("parameters", "/planning/lane:width", "double", 23, effective=3.5)
ROSOUT = end("publishers", "/rosout", "rcl_interfaces/msg/Log", 24, implicit=True)
TF = end("publishers", "/tf", "tf2_msgs/msg/TFMessage", 25, qos=Qos(depth=100))
LANE = Node(
    name="/planning/lane",
    kind="lifecycle",
    package="lane",
    type="lane_node",
    ros=2,
    endpoints=(*(PATH, ODOM, STATUS, VAGUE, UNTYPED, RESET, ASK, GO, *ECHO, RATE, FRAME, LIMITS, BARE, ROSOUT, TF),),
)
BASE = Node(
    name="/base",
    kind="node",
    package="base",
    type="base_node",
    endpoints=(
        end("publishers", "/odom", "nav_msgs/Odometry", queue_size=50, latched=True, location=OLD),
        end("subscribers", "/base/cmd", "geometry_msgs/Twist", queue_size=None, location=OLD),
        end("servers", "/stop", "std_srvs/Empty", location=OLD),
        end("getters", "/base/rate", "int", value=10, location=OLD),
        end("getters", "/base/rate", None, location=OLD),
        end("getters", "/robot", "str", location=OLD),
        end("setters", "/base/last", "int", value=1, location=OLD),
    ),
)
OUTSIDE = Node(name="/rviz", kind="node", package="rviz2", type="rviz2", ros=2, endpoints=(ODOM,))
PACKAGES = (Package("lane", "src/lane", ros=2), Package("base", "src/base", ros=1))
SYSTEM = Architecture(
    configurations=(
        Configuration(
            name="robot",
            nodes=(LANE, OUTSIDE),
            arguments=(("use_sim", "false"),),
            parameters=(Parameter(name="/planning/lane:plugin.gain", type="double", value=1.0),),
        ),
        Configuration(name="old", nodes=(BASE,)),
    ),
    packages=PACKAGES,
)
