# SPDX-License-Identifier: Apache-2.0
"""Known ROS 2 nodes as they are started: exact endpoints, and what stays unknown."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest

from haros_ci.model.architecture import Endpoint, Qos, Unknown
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import load_known, load_user, parse
from haros_ci.systems.known.quality import PRESETS

RELIABLE = PRESETS["default"]
SENSOR = PRESETS["sensor_data"]
LATCHED = PRESETS["latched"]


def known(package: str, name: str) -> KnownNode:
    nodes = load_known(package, 2)
    assert nodes is not None
    return nodes[name]


def started(
    node: KnownNode,
    name: str = "/ns/node",
    arguments: str = "",
    remaps: Mapping[str, str] | None = None,
    parameters: Mapping[str, Any] | None = None,
    **more: Any,
) -> list[Endpoint]:
    held = {f"{name}:{key}": value for key, value in (parameters or {}).items()}
    ends = instantiate(
        node,
        name=name,
        namespace=name.rpartition("/")[0] or "/",
        arguments=tuple(arguments.split()),
        parameter=held.get,
        remap=lambda full: (remaps or {}).get(full, full),
        ros=2,
        **more,
    )
    return list(ends)


def topics(ends: list[Endpoint]) -> list[tuple[str, str, str | None]]:
    return [(end.kind, end.name, end.type) for end in ends if end.kind != "parameters"]


def told(end: Endpoint, field: str) -> list[str]:
    return [why.reason for why in end.unknowns if why.field == field]


def acme(text: str, ros: int | None = 2) -> KnownNode:
    entry = parse(text)
    assert isinstance(entry, dict)
    found, problems = load_user({"acme": {"a": {**entry, **({"ros": ros} if ros else {})}}}, "haros.yaml")
    assert problems == ()
    return found["acme"]["a"]


# --- nodes of the data


def test_robot_state_publisher() -> None:
    ends = started(
        known("robot_state_publisher", "robot_state_publisher"),
        "/r1/rsp",
        remaps={"/tf": "/r1/tf"},
        parameters={"robot_description": "<robot/>", "frame_prefix": Unknown("value", "no such file")},
    )
    assert topics(ends) == [
        ("publishers", "/r1/tf", "tf2_msgs/msg/TFMessage"),
        ("publishers", "/tf_static", "tf2_msgs/msg/TFMessage"),
        ("publishers", "/r1/robot_description", "std_msgs/msg/String"),
        ("subscribers", "/r1/joint_states", "sensor_msgs/msg/JointState"),
    ]
    assert [end.original_name for end in ends[:2]] == ["/tf", "/tf_static"]
    assert [end.qos for end in ends[:4]] == [
        Qos(history="keep_last", depth=100, reliability="reliable", durability="volatile"),
        LATCHED,
        LATCHED,
        SENSOR,
    ]
    assert [(end.name, end.type, end.value, end.effective, end.unknowns) for end in ends[4:]] == [
        ("/r1/rsp:robot_description", "str", "", "<robot/>", ()),
        ("/r1/rsp:publish_frequency", "double", 20.0, 20.0, ()),
        ("/r1/rsp:frame_prefix", "str", "", None, (Unknown("effective", "no such file"),)),
        ("/r1/rsp:ignore_timestamp", "bool", False, False, ()),
    ]


def test_parameter_bridge_arguments() -> None:
    ends = started(
        known("ros_gz_bridge", "parameter_bridge"),
        "/bridge",
        "/chatter@std_msgs/msg/String@gz.msgs.StringMsg /scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"
        " cmd_vel@geometry_msgs/Twist]gz.msgs.Twist /world/w/control@ros_gz_interfaces/srv/ControlWorld"
        " --ros-args -r /scan:=/other",
        remaps={"/scan": "/front/scan"},
    )
    assert topics(ends) == [
        ("publishers", "/chatter", "std_msgs/msg/String"),
        ("publishers", "/front/scan", "sensor_msgs/msg/LaserScan"),
        ("subscribers", "/chatter", "std_msgs/msg/String"),
        ("subscribers", "/cmd_vel", "geometry_msgs/msg/Twist"),
        ("servers", "/world/w/control", "ros_gz_interfaces/srv/ControlWorld"),
    ]
    assert {end.qos for end in ends if end.kind == "publishers"} == {RELIABLE}


def test_parameter_bridge_file() -> None:
    node = known("ros_gz_bridge", "parameter_bridge")
    items = [
        {
            "ros_topic_name": "scan",
            "gz_topic_name": "/lidar",
            "ros_type_name": "sensor_msgs/msg/LaserScan",
            "direction": "GZ_TO_ROS",
        },
        {"topic_name": "cmd_vel", "ros_type_name": "geometry_msgs/msg/Twist", "direction": "ROS_TO_GZ"},
        {"gz_topic_name": "/both", "ros_type_name": "std_msgs/msg/Bool"},
        {"service_name": "/s", "ros_type_name": "std_srvs/srv/Empty"},
    ]
    read = {"/b.yaml": items}
    ends = started(node, "/g/bridge", parameters={"config_file": "/b.yaml"}, file=read.get)
    assert topics(ends) == [
        ("publishers", "/g/scan", "sensor_msgs/msg/LaserScan"),
        ("publishers", "/both", "std_msgs/msg/Bool"),
        ("subscribers", "/g/cmd_vel", "geometry_msgs/msg/Twist"),
        ("subscribers", "/both", "std_msgs/msg/Bool"),
    ]
    ends = started(node, "/g/bridge", parameters={"config_file": "/b.yaml"})
    assert topics(ends) == [("publishers", "/g/?", None), ("subscribers", "/g/?", None)]
    assert told(ends[0], "name") == ["the file that ~config_file names could not be read"]


def test_an_unknown_argument_of_the_bridge() -> None:
    ends = started(known("ros_gz_bridge", "parameter_bridge"), "/b", "/a@std_msgs/msg/Bool[gz.msgs.Boolean ?")
    assert ("publishers", "/a", "std_msgs/msg/Bool") in topics(ends)
    assert [end.name for end in ends if end.kind == "servers"] == ["/?"]


def test_robot_localization_sources() -> None:
    ends = started(
        known("robot_localization", "ekf_node"),
        "/ekf",
        parameters={
            "odom0": "wheel/odom",
            "odom0_config": [True] * 15,
            "odom0_queue_size": 3,
            "imu0": "/imu/data",
            "imu0_config": [True] * 15,
            "pose0": "unused",
        },
    )
    found = [(end.name, end.type, end.qos and end.qos.depth) for end in ends if end.kind == "subscribers"]
    assert found == [
        ("/wheel/odom", "nav_msgs/msg/Odometry", 3),
        ("/imu/data", "sensor_msgs/msg/Imu", 10),
        ("/set_pose", "geometry_msgs/msg/PoseWithCovarianceStamped", 1),
        ("/tf", "tf2_msgs/msg/TFMessage", 100),
        ("/tf_static", "tf2_msgs/msg/TFMessage", 100),
    ]
    assert known("robot_localization", "ekf_node").node_name == "ekf_filter_node"


def test_amcl_topics_of_parameters() -> None:
    node = known("nav2_amcl", "nav2_amcl::AmclNode")
    assert node.lifecycle and node.type == "amcl"
    ends = started(node, "/r/amcl", parameters={"scan_topic": "front/scan", "map_topic": "/map"})
    found = [(end.name, end.qos) for end in ends if end.kind == "subscribers"][:3]
    assert found == [("/r/front/scan", SENSOR), ("/r/initialpose", Qos()), ("/map", LATCHED)]


def test_twist_mux_topics() -> None:
    node = known("twist_mux", "twist_mux")
    parameters = {"topics.nav.topic": "nav_vel", "topics.joy.topic": "/joy_vel", "locks.stop.topic": "estop"}
    ends = started(
        node, "/mux", parameters=parameters, below=lambda prefix: [key for key in parameters if key.startswith(prefix)]
    )
    assert [each for each in topics(ends) if each[0] == "subscribers"] == [
        ("subscribers", "/joy_vel", "geometry_msgs/msg/Twist"),
        ("subscribers", "/nav_vel", "geometry_msgs/msg/Twist"),
        ("subscribers", "/estop", "std_msgs/msg/Bool"),
    ]
    ends = [end for end in started(node, "/mux", parameters=parameters) if end.kind == "subscribers"]
    assert [end.name for end in ends] == ["/?", "/?"]


@pytest.mark.parametrize(
    ("node", "arguments", "parameters", "names"),
    [
        ("relay", "in out", {}, ["/ns/out", "/ns/in"]),
        ("relay", "", {"input_topic": "/a"}, ["/a_relay", "/a"]),
        ("relay", "", {"input_topic": "/a", "output_topic": "b"}, ["/ns/b", "/a"]),
        ("throttle", "messages in 2.0", {}, ["/ns/in_throttle", "/ns/in"]),
        ("throttle", "bytes in 100 1.0 out", {}, ["/ns/out", "/ns/in"]),
        ("drop", "in 1 2", {}, ["/ns/in_drop", "/ns/in"]),
        ("relay", "", {}, ["/ns/?_relay", "/ns/?"]),
    ],
)
def test_topic_tools(node: str, arguments: str, parameters: dict[str, str], names: list[str]) -> None:
    ends = started(known("topic_tools", node), arguments=arguments, parameters=parameters)
    assert [end.name for end in ends if end.kind in ("publishers", "subscribers")] == names


def test_a_spawner_is_a_client_of_the_manager() -> None:
    node = known("controller_manager", "spawner")
    ends = started(node, "/r/spawner", "joint_state_broadcaster --controller-manager /r/cm")
    assert [end.name for end in ends if end.kind == "clients"][:4] == [
        "/r/cm/list_controllers",
        "/r/cm/load_controller",
        "/r/cm/configure_controller",
        "/r/cm/switch_controller",
    ]
    assert started(node, "/r/spawner", "x")[0].name == "/r/controller_manager/list_controllers"


def test_a_controller() -> None:
    node = known("joint_state_broadcaster", "joint_state_broadcaster/JointStateBroadcaster")
    assert node.plugin and node.lifecycle
    assert [end.name for end in started(node, "/r/jsb") if end.kind == "publishers"] == [
        "/r/joint_states",
        "/r/dynamic_joint_states",
    ]
    ends = started(node, "/r/jsb", parameters={"use_local_topics": True})
    assert [end.name for end in ends if end.kind == "publishers"] == [
        "/r/jsb/joint_states",
        "/r/jsb/dynamic_joint_states",
    ]


def test_a_type_that_parameters_decide() -> None:
    node = known("nav2_velocity_smoother", "velocity_smoother")
    for value, expected in ((True, "TwistStamped"), (False, "Twist")):
        ends = started(node, "/vs", parameters={"enable_stamped_cmd_vel": value}, distribution="jazzy")
        assert topics(ends)[0] == ("publishers", "/cmd_vel_smoothed", f"geometry_msgs/msg/{expected}")
        assert ends[0].unknowns == ()
    ends = started(node, "/vs", distribution="kilted")
    assert topics(ends)[0] == ("publishers", "/cmd_vel_smoothed", "geometry_msgs/msg/TwistStamped")
    undecided = [end for end in started(node, "/vs") if end.name == "/cmd_vel_smoothed"]
    assert len(undecided) == 2 and all(told(end, "conditions") for end in undecided)


# --- quality of service


@pytest.mark.parametrize(
    ("written", "parameters", "qos"),
    [
        ("3", {}, Qos(history="keep_last", depth=3, reliability="reliable", durability="volatile")),
        ("sensor_data", {}, SENSOR),
        ("system_default", {}, Qos()),
        ("latched", {}, LATCHED),
        ("~depth|4", {}, Qos(history="keep_last", depth=4, reliability="reliable", durability="volatile")),
        ("~depth|4", {"depth": 9}, Qos(history="keep_last", depth=9, reliability="reliable", durability="volatile")),
        (
            "{preset: sensor_data, depth: 1}",
            {},
            Qos(history="keep_last", depth=1, reliability="best_effort", durability="volatile"),
        ),
        ("{preset: ~profile|default}", {"profile": "SENSOR_DATA"}, SENSOR),
        ("{history: keep_all}", {}, Qos(history="keep_all", reliability="reliable", durability="volatile")),
        (
            "{depth: 1, deadline: 0.5, liveliness: automatic, lease: 2}",
            {},
            Qos(
                history="keep_last",
                depth=1,
                reliability="reliable",
                durability="volatile",
                deadline=0.5,
                liveliness="automatic",
                lease=2,
            ),
        ),
    ],
)
def test_quality_of_service(written: str, parameters: dict[str, Any], qos: Qos) -> None:
    node = acme(f"publishers: [{{name: a, type: b/msg/C, qos: {written}}}]")
    (end,) = started(node, parameters=parameters)
    assert end.qos == qos and end.unknowns == ()


@pytest.mark.parametrize(
    ("written", "parameters", "qos", "reason"),
    [
        (
            "'{unknown:the device decides}'",
            {},
            Qos(history="?", depth="?", reliability="?", durability="?"),
            "the device decides",
        ),
        (
            "{depth: '{unknown:why}'}",
            {},
            Qos(history="keep_last", depth="?", reliability="reliable", durability="volatile"),
            "why",
        ),
        (
            "~depth|4",
            {"depth": "many"},
            Qos(history="keep_last", depth="?", reliability="reliable", durability="volatile"),
            "~depth is no depth that is known",
        ),
        (
            "~depth|4",
            {"depth": Unknown("value", "no file")},
            Qos(history="keep_last", depth="?", reliability="reliable", durability="volatile"),
            "no file",
        ),
        (
            "{depth: 2, reliability: ~how}",
            {"how": "perhaps"},
            Qos(history="keep_last", depth=2, reliability="?", durability="volatile"),
            "~how is no reliability that is known",
        ),
    ],
)
def test_unknown_quality_of_service(written: str, parameters: dict[str, Any], qos: Qos, reason: str) -> None:
    node = acme(f"publishers: [{{name: a, type: b/msg/C, qos: {written}}}]")
    (end,) = started(node, parameters=parameters)
    assert end.qos == qos and told(end, "qos") == [reason]


def test_without_quality_of_service() -> None:
    (end,) = started(acme("publishers: [{name: a, type: b/msg/C}]"))
    assert end.qos is None and told(end, "qos") == ["the data on this node does not tell it"]


@pytest.mark.parametrize(
    "written",
    [
        "fast",
        "-1",
        "true",
        "{}",
        "{deep: 1}",
        "{reliability: reliable}",
        "{depth: 1.5}",
        "{depth: 1, durability: latched}",
        "[1]",
    ],
)
def test_a_wrong_quality_of_service_is_said(written: str) -> None:
    data = {"acme": {"a": parse(f"{{ros: 2, publishers: [{{name: a, type: b/msg/C, qos: {written}}}]}}")}}
    found, problems = load_user(data, "haros.yaml")
    assert len(problems) == 1 and problems[0].message.startswith(
        "known_nodes.acme.a.publishers[0].qos: it cannot be read: "
    )
    assert found["acme"]["a"].endpoints == ()


# --- a project file


def test_an_entry_for_both_versions() -> None:
    node = acme(
        """
        publishers: [{name: a, type: b/C, queue_size: 3, latched: true}]
        subscribers: [{name: d, type: b/msg/D, queue_size: 2}]
        getters: [{name: "~rate", type: double}]
        parameters: [{name: rate, type: double, default: 1.0}]
        """,
        None,
    )
    assert node.ros is None
    two = started(node)
    assert [(end.kind, end.name, end.type) for end in two] == [
        ("publishers", "/ns/a", "b/msg/C"),
        ("subscribers", "/ns/d", "b/msg/D"),
        ("parameters", "/ns/node:rate", "double"),
    ]
    assert two[0].qos == Qos(history="keep_last", depth=3, reliability="reliable", durability="transient_local")
    one = started(node) and instantiate(
        node, name="/ns/n", namespace="/ns", arguments=(), parameter=lambda name: None, remap=lambda name: name
    )
    assert [(end.kind, end.name, end.type, end.queue_size, end.qos) for end in one] == [
        ("publishers", "/ns/a", "b/C", 3, None),
        ("subscribers", "/ns/d", "b/D", 2, None),
        ("getters", "/ns/n/rate", "double", None, None),
    ]


def test_a_component_goes_by_its_class() -> None:
    data = parse("{acme: {exe: {ros: 2, component: acme::Node}, 'acme::Other': {ros: 2}}}")
    assert isinstance(data, dict)
    found, problems = load_user(data, "haros.yaml")
    assert problems == ()
    assert {name: node.type for name, node in found["acme"].items()} == {
        "acme::Node": "exe",
        "acme::Other": "acme::Other",
        "exe": "exe",
    }
    assert found["acme"]["acme::Other"].component == "acme::Other"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{ros: 3}", ": ros must be 1 or 2; without it the entry is for both"),
        ("{ros: true}", ": ros must be 1 or 2; without it the entry is for both"),
        ("{ros: 1, lifecycle: true}", ".lifecycle: it is of ROS 2 only"),
        ("{ros: 2, component: 'a b'}", ".component: it is the class of the component, such as usb_cam::UsbCamNode"),
        ("{ros: 2, node_name: /a}", ".node_name: it is the name that the program gives its node"),
        (
            "{ros: 2, distributions: [noetic]}",
            ".distributions: it must be a list of some of: foxy, galactic, humble, iron, jazzy, kilted, rolling",
        ),
        (
            "{ros: 2, servers: [{name: x, type: b/msg/C}]}",
            ".servers[0].type: 'b/msg/C' is no type; write package/srv/Name, or {unknown:the reason}",
        ),
        (
            "{ros: 2, servers: [{name: x, type: b/C}]}",
            ".servers[0].type: 'b/C' is no type; write package/srv/Name, or {unknown:the reason}",
        ),
        (
            "{ros: 1, servers: [{name: x, type: b/srv/C}]}",
            ".servers[0].type: 'b/srv/C' is no type; write package/Name, or {unknown:the reason}",
        ),
        (
            "{ros: 2, parameters: [{name: x, type: float}]}",
            ".parameters[0].type: 'float' is no type; write one of bool, int, double, str, bytes, bool[], int[], double[], str[], or {unknown:the reason}",
        ),
    ],
)
def test_a_wrong_shape_is_said(text: str, message: str) -> None:
    _, problems = load_user({"acme": {"a": parse(text)}}, "haros.yaml")
    assert [problem.message for problem in problems] == [f"known_nodes.acme.a{message}"]


def test_parameters_of_items() -> None:
    node = acme(
        """
        subscribers:
          - {name: "{param:{item}.topic|x}", type: b/msg/C, qos: 1, each: "~sources", if: "~{item}.enabled|true"}
        """
    )
    ends = started(node, parameters={"sources": ["a", "b", "c"], "a.topic": "/t", "b.enabled": False})
    assert [end.name for end in ends] == ["/t", "/ns/x"]
    (end,) = started(node, parameters={"sources": Unknown("value", "no file")})
    assert end.name == "/ns/?" and told(end, "name") and told(end, "conditions")
    assert started(node) == []


@pytest.mark.parametrize("each", ["args:0 as x", "args:0 as {a}{b}", "args:0 as {a}@{a}", "file:~f#", "args:0 as "])
def test_a_wrong_list_is_said(each: str) -> None:
    entry = {"ros": 2, "servers": [{"name": "{item}", "type": "b/srv/C", "each": each}]}
    _, problems = load_user({"acme": {"a": entry}}, "haros.yaml")
    assert any(problem.message.startswith("known_nodes.acme.a.servers[0].each: ") for problem in problems)


def test_hostile_entries_do_not_raise() -> None:
    node = acme(
        """
        publishers:
          - {name: "{item.t}", type: "{item.ty}", qos: 1, each: "file:~f"}
          - {name: "{item.t}", type: "{item.ty}", qos: 1, each: "args:0 as {t}@{ty}"}
        """
    )
    files: dict[str, object] = {"/f": [None, 3, "x", {"t": 1, "ty": []}, {"t": "a b", "ty": "x y"}, ["t"]]}
    for end in started(node, arguments="@ a@b c@d/e/f/g ???@x/y", parameters={"f": "/f"}, file=files.get):
        assert end.name.startswith("/")
