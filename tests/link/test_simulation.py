# SPDX-License-Identifier: Apache-2.0
"""Gazebo in ROS 1: which endpoints the plug-ins of a spawned robot and of a world give to the simulator's node, and which they do not."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, Nothing, only, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Node

EMPTY = '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
WORLD = '<include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="world_name" value="$(find p)/worlds/w.world"/></include>'
PARAM = '<param name="robot_description" command="$(find xacro)/xacro $(find p)/urdf/rover.xacro"/>'
SPAWN = '<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model rover {}"/>'
ALL = EMPTY + PARAM + SPAWN.format("")
LASER = '<plugin name="scanner" filename="libgazebo_ros_laser.so">{}</plugin>'
#: The topics of the simulator itself.
OWN = {
    "/clock",
    "/gazebo/link_states",
    "/gazebo/model_states",
    "/gazebo/performance_metrics",
    "/gazebo/parameter_descriptions",
    "/gazebo/parameter_updates",
}


def sensor(plugin: str, kind: str = "ray") -> str:
    return f'<gazebo reference="head"><sensor type="{kind}" name="eye">{plugin}</sensor></gazebo>'


def simulator(launch: str, inner: str = "", files: dict[str, str] | None = None, name: str = "/gazebo") -> Node:
    """The simulator called *name* that *launch* starts, where a robot has the extensions *inner*."""
    robot = f'<robot name="rover" xmlns:xacro="http://ros.org/xacro"><link name="head"/>{inner}</robot>'
    texts = {
        "p/CMakeLists.txt": CMAKE.format("p") if "{}" in CMAKE else CMAKE,
        "p/launch/l.launch": f"<launch>{launch}</launch>",
        "p/urdf/rover.xacro": robot,
        **(files or {}),
    }
    found = architecture(workspace(texts), Settings(root=None), Nothing(), environment={}, known_nodes=True)  # type: ignore[arg-type]
    (node,) = (each for each in only(found).nodes if each.package == "gazebo_ros" and each.name == name)
    return node


def made(node: Node, kind: str = "publishers") -> list[tuple[str, str | None]]:
    """What plug-ins make."""
    return [(end.name, end.type) for end in node.endpoints if end.kind == kind and end.location is not None]


def lost(node: Node) -> list[str]:
    return [each.reason for each in node.unknowns if each.field == "endpoints"]


@pytest.mark.parametrize(
    ("inner", "expected"),
    [
        (sensor(LASER.format("<topicName>scan</topicName>")), [("/scan", "sensor_msgs/LaserScan")]),
        (sensor(LASER.replace("ros_laser", "ros_velodyne_laser").format("<topicName>cloud</topicName>")), [("/cloud", "sensor_msgs/PointCloud2")]),
        (sensor(LASER.replace("ros_laser", "ros_velodyne_gpu_laser").format("<robotNamespace>a</robotNamespace>")), [("/points", "sensor_msgs/PointCloud2")]),
        (sensor(LASER.format("")), [("/world", "sensor_msgs/LaserScan")]),
        (sensor(LASER.format("<robotNamespace>front</robotNamespace><topicName>scan</topicName>")), [("/front/scan", "sensor_msgs/LaserScan")]),
        (sensor(LASER.format("<robotNamespace/><topicName>scan</topicName>")), [("/rover/scan", "sensor_msgs/LaserScan")]),
        (sensor(LASER.format("<topicName>/abs/scan</topicName>")), [("/abs/scan", "sensor_msgs/LaserScan")]),
        (sensor('<plugin name="c" filename="/opt/x/libgazebo_ros_bumper.so"/>', "contact"), [("/bumper_states", "gazebo_msgs/ContactsState")]),
        ('<gazebo><plugin name="o" filename="libgazebo_ros_p3d.so"><bodyName>head</bodyName><topicName>truth</topicName></plugin></gazebo>', [("/truth", "nav_msgs/Odometry")]),
        ('<gazebo><plugin name="d" filename="libgazebo_ros_planar_move.so"><odometryTopic>o</odometryTopic></plugin></gazebo>', [("/tf", "tf2_msgs/TFMessage"), ("/o", "nav_msgs/Odometry")]),
    ],
)  # fmt: skip
def test_plugins_of_a_spawned_robot(inner: str, expected: list[tuple[str, str]]) -> None:
    node = simulator(ALL, inner)
    assert made(node) == expected
    assert lost(node) == []
    assert "/?" not in [end.name for end in node.endpoints]
    assert {end.location.path for end in node.endpoints if end.location is not None} == {"p/urdf/rover.xacro"}


def test_a_camera_is_below_its_name() -> None:
    plugin = '<plugin name="c" filename="libgazebo_ros_camera.so"><cameraName>mast</cameraName></plugin>'
    node = simulator(EMPTY + PARAM + SPAWN.format("-robot_namespace r1"), sensor(plugin, "camera"))
    assert made(node)[:2] == [
        ("/r1/mast/image_raw", "sensor_msgs/Image"),
        ("/r1/mast/camera_info", "sensor_msgs/CameraInfo"),
    ]
    assert ("/r1/mast/set_camera_info", "sensor_msgs/SetCameraInfo") in made(node, "servers")


def test_the_namespace_of_the_spawner_counts() -> None:
    launch = EMPTY + f'<group ns="r2">{PARAM}{SPAWN.format("")}</group>'
    assert made(simulator(launch, sensor(LASER.format("<topicName>scan</topicName>")))) == [
        ("/r2/scan", "sensor_msgs/LaserScan")
    ]


def test_arguments_of_xacro_count() -> None:
    inner = '<xacro:arg name="where" default="scan"/>' + sensor(LASER.format("<topicName>$(arg where)</topicName>"))
    launch = EMPTY + PARAM.replace(".xacro", ".xacro where:=near") + SPAWN.format("")
    assert made(simulator(launch, inner)) == [("/near", "sensor_msgs/LaserScan")]


MAZE = '<sdf version="1.6"><world name="default">{}</world></sdf>'
BOT = '<sdf version="1.6"><model name="bot"><link name="l"><sensor name="s" type="ray">{}</sensor></link></model></sdf>'


def test_a_world_brings_models_of_the_workspace() -> None:
    files = {
        "p/worlds/w.world": MAZE.format(
            "<include><uri>model://sun</uri></include><include><uri>model://bot</uri></include>"
        ),
        "p/models/bot/model.config": '<model><name>Bot</name><sdf version="1.4">old.sdf</sdf><sdf version="1.6">model.sdf</sdf></model>',
        "p/models/bot/model.sdf": BOT.format(LASER.format("<robotNamespace/><topicName>scan</topicName>")),
        "p/models/bot/old.sdf": BOT.format(LASER.format("<topicName>old</topicName>")),
    }
    node = simulator(WORLD, files=files)
    assert made(node) == [("/bot/scan", "sensor_msgs/LaserScan")]
    assert lost(node) == []


def test_models_that_include_others_many_times_come_to_an_end() -> None:
    many = "<include><uri>model://m1</uri></include>" * 20
    files = {"p/worlds/w.world": MAZE.format(many)}
    for number in range(1, 9):
        inner = many.replace("m1<", f"m{number + 1}<")
        files[f"p/models/m{number}/model.config"] = "<model><name>M</name></model>"
        files[f"p/models/m{number}/model.sdf"] = f'<sdf version="1.6"><model name="m">{inner}</model></sdf>'
    node = simulator(WORLD, files=files)
    assert "it has more plug-ins and models than are looked at" in lost(node)


def test_a_large_model_that_is_included_many_times_is_not_looked_through_each_time() -> None:
    files = {
        "p/worlds/w.world": MAZE.format("<include><uri>model://large</uri></include>" * 1_900),
        "p/models/large/model.config": "<model><name>L</name></model>",
        "p/models/large/model.sdf": f'<sdf version="1.6"><model name="l">{"<link/>" * 90_000}</model></sdf>',
    }
    assert lost(simulator(WORLD, files=files)) == ["it has more plug-ins and models than are looked at"]


def test_a_version_with_digits_that_are_no_number() -> None:
    files = {
        "p/worlds/w.world": MAZE.format("<include><uri>model://bot</uri></include>"),
        "p/models/bot/model.config": '<model><sdf version="1.6">model.sdf</sdf><sdf version="²">old.sdf</sdf></model>',
        "p/models/bot/model.sdf": BOT.format(LASER.format("<topicName>scan</topicName>")),
    }
    assert made(simulator(WORLD, files=files)) == [("/scan", "sensor_msgs/LaserScan")]


def test_a_namespace_with_braces_is_taken_as_it_is() -> None:
    inner = sensor(LASER.format("<robotNamespace>{model}{sensor}</robotNamespace><topicName>scan</topicName>"))
    assert made(simulator(ALL, inner)) == [("/{model}{sensor}/scan", "sensor_msgs/LaserScan")]


def test_a_spawned_file_counts() -> None:
    launch = EMPTY + SPAWN.replace("-urdf -param robot_description", "-sdf -file $(find p)/models/b.sdf").format("")
    node = simulator(
        launch, files={"p/models/b.sdf": BOT.format(LASER.format("<robotNamespace/><topicName>scan</topicName>"))}
    )
    assert made(node) == [("/rover/scan", "sensor_msgs/LaserScan")]


@pytest.mark.parametrize(
    ("launch", "inner"),
    [
        (EMPTY + PARAM, sensor(LASER.format(""))),  # nobody spawns it
        (PARAM + EMPTY + SPAWN.format("").replace("spawn_model", "other"), sensor(LASER.format(""))),
        (ALL, f"<!--{sensor(LASER.format(''))}-->"),
        (ALL, '<gazebo reference="head"><plugin name="s" filename="libgazebo_ros_p3d.so"><bodyName>b</bodyName><topicName>t</topicName></plugin></gazebo>'),
        (ALL, f"<gazebo>{LASER.format('')}</gazebo>"),  # a plug-in for sensors in a model
        (ALL, sensor('<plugin name="d" filename="libgazebo_ros_diff_drive.so"/>')),  # one for models in a sensor
        (ALL, '<gazebo><plugin name="o" filename="libgazebo_ros_p3d.so"><topicName>t</topicName></plugin></gazebo>'),  # no <bodyName>
        (ALL, '<gazebo><plugin name="o" filename="libgazebo_ros_template.so"/></gazebo>'),
        (ALL, '<gazebo><plugin name="o" filename="libLiftDragPlugin.so"/></gazebo>'),
        (ALL, f'<xacro:if value="false">{sensor(LASER.format(""))}</xacro:if>'),
        (ALL, f'<xacro:macro name="eye">{sensor(LASER.format(""))}</xacro:macro>'),
        (ALL, sensor(LASER.format("<topicName/>"))),  # an empty name: nothing is published
        (EMPTY, sensor(LASER.format(""))),
    ],
)  # fmt: skip
def test_what_brings_nothing(launch: str, inner: str) -> None:
    node = simulator(launch, inner)
    assert {end.name for end in node.endpoints if end.kind == "publishers"} == OWN
    assert lost(node) == []


@pytest.mark.parametrize(
    ("launch", "inner", "files", "reason"),
    [
        (ALL, '<gazebo><plugin name="x" filename="libacme_thing.so"/></gazebo>', {}, "what the plug-in libacme_thing.so makes is not known"),
        (ALL, '<xacro:include filename="$(find elsewhere)/a.xacro"/>', {}, "a part of p/urdf/rover.xacro includes, or depends on, what is not known"),
        (EMPTY + SPAWN.format(""), "", {}, "the parameter /robot_description that /spawn spawns is set by no launch file"),
        (EMPTY + PARAM.replace("rover.xacro", "none.xacro") + SPAWN.format(""), "", {}, "$(find p)/urdf/none.xacro is not in the workspace"),
        (EMPTY + SPAWN.replace("-urdf -param robot_description", "-sdf -stdin").format(""), "", {}, "what /spawn spawns is not known"),
        (WORLD, "", {}, "$(find p)/worlds/w.world is not in the workspace"),
        (WORLD, "", {"p/worlds/w.world": MAZE.format("<include><uri>model://bot</uri></include>")}, "the model bot is not in the workspace"),
        (WORLD, "", {"p/worlds/w.world": MAZE.format("<include><uri>model://bot</uri></include>"), "p/a/bot/model.config": "<model/>", "p/b/bot/model.config": "<model/>"}, "there are several models called bot: p/a/bot, p/b/bot"),
        (EMPTY + '<arg name="a"/>' + PARAM.replace("/>", ' if="$(arg a)"/>') + SPAWN.format(""), "", {}, "the parameter /robot_description that /spawn spawns is not known"),
        (EMPTY.replace("/>", '><arg name="extra_gazebo_args" value="-s libacme.so"/></include>'), "", {}, "what the plug-in acme makes is not known"),
    ],
)  # fmt: skip
def test_what_is_not_known_is_named(launch: str, inner: str, files: dict[str, str], reason: str) -> None:
    node = simulator(launch, inner, files)
    assert lost(node) == [reason]
    assert "/?" in [end.name for end in node.endpoints if end.kind == "publishers"]
    assert made(node) == []


def test_a_value_that_is_not_known_is_no_name() -> None:
    inner = '<xacro:arg name="where" default="scan"/>' + sensor(LASER.format("<topicName>$(arg where)</topicName>"))
    launch = '<arg name="a"/>' + EMPTY + PARAM.replace(".xacro", ".xacro where:=$(arg a)") + SPAWN.format("")
    node = simulator(launch, inner)
    assert made(node) == [("/?", "sensor_msgs/LaserScan")]


def test_a_spawner_under_a_condition() -> None:
    launch = '<arg name="a"/>' + EMPTY + PARAM + f'<group if="$(arg a)">{SPAWN.format("")}</group>'
    (end,) = (e for e in simulator(launch, sensor(LASER.format(""))).endpoints if e.location is not None)
    assert [each.condition for each in end.conditions] == ["$(arg a)"]


def test_a_condition_that_the_simulator_has_too_is_not_said_again() -> None:
    launch = f'<arg name="a"/>{PARAM}<group if="$(arg a)">{EMPTY}{SPAWN.format("")}</group>'
    node = simulator(launch, sensor(LASER.format("")))
    assert [each.condition for each in node.conditions] == ["$(arg a)"]
    assert [end.conditions for end in node.endpoints if end.location is not None] == [()]


@pytest.mark.parametrize("written", ["{}", "<xacro:if value='$(arg on)'>{}</xacro:if>"])
def test_a_description_under_a_condition_that_is_not_known(written: str) -> None:
    inner = written.format(sensor(LASER.format("")))
    if written == "{}":
        inner = inner.replace("<plugin", "<xacro:if value='$(arg on)'><plugin").replace(
            "</plugin>", "</plugin></xacro:if>"
        )
    launch = '<arg name="a"/>' + EMPTY + PARAM.replace(".xacro", ".xacro on:=$(arg a)") + SPAWN.format("")
    node = simulator(launch, '<xacro:arg name="on" default="true"/>' + inner)
    (end,) = (end for end in node.endpoints if end.location is not None)
    assert (end.name, [(each.field, each.reason) for each in end.unknowns]) == (
        "/world",
        [("conditions", "it stands in the description under a condition that is not known")],
    )


BRINGER = (
    '#include <ros/ros.h>\n#include <gazebo_msgs/SpawnModel.h>\nint main(int argc, char ** argv) {\nros::init(argc, argv, "n");\n'
    'ros::NodeHandle nh;\nros::ServiceClient c = nh.serviceClient<gazebo_msgs::SpawnModel>("/gazebo/spawn_urdf_model");\n}\n'
)


def test_a_node_that_can_bring_models() -> None:
    files = {"p/src/n.cpp": BRINGER, "p/CMakeLists.txt": CMAKE.format("p") + "add_executable(n src/n.cpp)\n"}
    assert lost(simulator(ALL + '<node pkg="p" type="n" name="bringer"/>', files=files)) == [
        "/bringer may bring models while it runs"
    ]


def test_several_simulators_and_the_one_that_a_spawner_names() -> None:
    other = '<node pkg="gazebo_ros" type="gzserver" name="second"/>'
    assert made(simulator(ALL + other, sensor(LASER.format("")))) == [("/world", "sensor_msgs/LaserScan")]
    assert made(simulator(ALL + other, sensor(LASER.format("")), name="/second")) == []
    to_second = EMPTY + PARAM + SPAWN.format("-gazebo_namespace /second") + other
    assert made(simulator(to_second, sensor(LASER.format("")))) == []


def test_the_simulator_is_known_where_its_package_is_in_the_workspace() -> None:
    files = {
        "gazebo_ros/CMakeLists.txt": CMAKE,
        "gazebo_ros/scripts/gzserver": "#!/bin/sh\n",
        "gazebo_ros/launch/empty_world.launch": '<launch><node pkg="gazebo_ros" type="gzserver" name="gazebo" args="worlds/empty.world"/></launch>',
    }
    node = simulator(ALL, sensor(LASER.format("")), files)
    assert made(node) == [("/world", "sensor_msgs/LaserScan")]
    assert ("/gazebo/pause_physics", "std_srvs/Empty") in [(end.name, end.type) for end in node.endpoints]


def test_a_plugin_of_a_world_has_services() -> None:
    world = (
        '<sdf version="1.6"><world name="w"><plugin name="a" filename="libgazebo_ros_link_attacher.so"/></world></sdf>'
    )
    node = simulator(WORLD, files={"p/worlds/w.world": world})
    assert made(node, "servers") == [
        (f"/link_attacher_node/{verb}", "gazebo_ros_link_attacher/Attach") for verb in ("attach", "detach")
    ]


@pytest.mark.parametrize(
    "inner",
    [
        sensor(LASER.replace("ros_laser", "ros_velodyne_laser").format("<topicName/>")),
        f"<gazebo>{LASER.replace('ros_laser', 'ros_velodyne_laser').format('')}</gazebo>",
        f"<gazebo>{LASER.replace('ros_laser', 'ros_link_attacher').format('')}</gazebo>",
    ],
)
def test_known_plugins_that_make_nothing_there(inner: str) -> None:
    node = simulator(ALL, inner)
    assert (made(node), made(node, "servers"), lost(node)) == ([], [], [])
