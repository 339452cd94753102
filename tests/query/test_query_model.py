# SPDX-License-Identifier: Apache-2.0
"""The model as queries see it: HAROS's names of entities and attributes, and what is ours."""

from __future__ import annotations

from dataclasses import replace

import pytest
from query_worlds import BASE, WALKER, about, end, robot_with, scene

from haros_ci.model.location import Location


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("nodes/id", ["'/walker'", "'/base'"]),
        ("nodes[self.type == 'walker/walker_node']", ["NodeInstance walk:/walker"]),
        ("nodes/publishers[self.queue_size == 0]/topic_name", ["'/cmd_vel'"]),
        ("nodes/publishers[self.rosname.is_global]/topic_name", ["'/tf'"]),
        ("nodes/subscribers[self.rosname.is_private]/rosname/given", ["'~bumper'"]),
        ("nodes/publishers[self.topic_name == '/cmd_vel']/rosname/full", ["'/vel'"]),
        ("nodes/publishers[self.rosname == '/vel']/topic/id", ["'/cmd_vel'"]),
        ("nodes/remaps/key", ["'/vel'"]),
        ("nodes/remaps[self.value == '/cmd_vel']/key", ["'/vel'"]),
        ("topics/id", ["'/cmd_vel'", "'/tf'", "'/walker/bumper'", "'/scan'", "'/base/?'"]),
        ("topics[len(self.types) > 1]", ["Topic('/cmd_vel', geometry_msgs/Twist)"]),
        ("topics[len(self.publishers) > 1]", []),
        ("topics[self.is_disconnected]/id", ["'/tf'", "'/walker/bumper'", "'/scan'"]),
        ("topics[self.conditional]/id", ["'/walker/bumper'"]),
        ("topics/subscribers/conditions/condition", ["'is_fast'"]),
        ("topics/subscribers[len(self.conditions) > 0]/conditions/statement", ["'if'"]),
        ("topics[self.type == '?']/id", ["'/scan'"]),
        ("topics[self.unresolved]", ["Topic('/base/?', std_msgs/String)", "Topic('/base/?', std_msgs/String)"]),
        ("topics[self.name == 'scan']/namespace", ["'/'"]),
        ("topics[self.type == 'std_msgs/Empty']", ["Topic('/walker/bumper', std_msgs/Empty)"]),
        ("services/server", ["Service(/walker, /walker/stop, std_srvs/Empty)"]),
        ("services/clients[self.rosname.is_global]", ["Client(/base, /walker/stop, std_srvs/Empty)"]),
        ("services[self.is_disconnected]", []),
        ("parameters/id", ["'/walker/speed'", "'/speed_now'"]),
        ("parameters[self.value == 1.5]/reads", ["Read(/walker, /walker/speed, double)"]),
        ("parameters/writes[is_rosglobal(self.rosname)]/param_name", ["'/speed_now'"]),
        ("parameters[self.node_scope]/id", ["'/walker/speed'"]),
        ("parameters/reads/value", ["0.5"]),
        ("nodes/publishers[self.source == 'hint']/topic_name", ["'/tf'"]),
        ("nodes/publishers[self.location2.line == 10]/location2/file", ["'src/walker.cpp'"]),
        ("nodes/publishers/source_location[self.line == 10]/package/name", ["'walker'"]),
        ("nodes/publishers/source_location[self.line == 10]/file/language", ["'cpp'"]),
        ("nodes[self.rt_outlinks[1].id == '/base']/id", ["'/walker'"]),
        ("nodes/node/node_name", ["'walker/walker_node'", "'base/BaseNodelet'"]),
        ("nodes/node[self.is_nodelet]/nodelet_class", ["'BaseNodelet'"]),
        ("nodes/launch/name", ["'walk.launch'"]),
        ("config/name", ["'walk'"]),
        ("config/launch_commands", ["['roslaunch', 'walker walk.launch']"]),
        ("config/roslaunch/name", ["'walk.launch'"]),
        ("return len(nodes), len(topics), nodes.get('/base').id", ["[2, 6, '/base']"]),
        (
            "return config.get_remaps(), config.get_collisions(), config.get_unresolved(), config.get_conditional()",
            ["[1, 1, 2, 1]"],
        ),
        ("nodes['/tf' in topics and not '/nope' in topics]/id", ["'/walker'", "'/base'"]),
        ("return topics.counter['/base/?'], len(topics.unresolved)", ["[2, 2]"]),
        ("nodes[0 == 1]", []),
        ("actions", []),
    ],
)
def test_a_configuration_has_what_haros_shows(text: str, found: list[str]) -> None:
    assert about(text) == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("nodes/publishers[self.qos.reliability == 'best_effort']/topic_name", ["'/chat'"]),
        ("nodes/publishers[self.queue_size == 5]/topic_name", ["'/chat'"]),
        ("nodes/publishers[self.latched]/topic_name", ["'/chat'"]),
        ("nodes/publishers[self.queue_size == 1]", []),
        ("nodes/publishers[self.qos.history == 'keep_all']/qos/depth", ["1"]),
        ("actions/servers", ["ActionServer(/talker, /move, demo/action/Move)"]),
        ("nodes/action_servers/action_name", ["'/move'"]),
        ("nodes/declarations[self.read_only]/param_name", ["'/talker:rate'"]),
        ("nodes/declarations[self.value != self.effective]/effective", ["10"]),
        ("nodes/declarations[self.range[1] == 9]/value", ["5"]),
        ("nodes/kind", ["'component'"]),
        ("config/launch_commands", ["['ros2 launch', 'walker talk.launch.py']"]),
    ],
)
def test_ros_2_has_more(text: str, found: list[str]) -> None:
    assert about(text, name="talk") == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("packages/name", ["'walker'", "'base'"]),
        ("files[self.language == 'msg']/name", ["'Step.msg'"]),
        (
            "files[self.package.name == 'walker']/full_name",
            ["'launch/walk.launch'", "'src/walker.cpp'", "'msg/Step.msg'"],
        ),
        ("packages[self.file_count > 2 and self.lines > 80]", ["package:walker"]),
        ("packages/nodes/id", ["'node:walker/walker_node'", "'node:walker/ns::Talker'", "'node:base/BaseNodelet'"]),
        ("nodes/advertise[self.name.startswith('/')]/full_name", ["'/tf'"]),
        ("nodes/advertise[self.queue_size == 100]", ["AdvertiseCall(/tf, , tf2_msgs/TFMessage)"]),
        ("nodes/subscribe[self.control_depth == 1]/name", ["'~bumper'"]),
        ("nodes/read_param/default_value", ["0.5"]),
        ("nodes/service/namespace", ["'~'"]),
        ("nodes/client/namespace", ["''"]),
        ("nodes/instances/id", ["'/walker'", "'/base'", "'/talker'"]),
        ("configs/name", ["'walk'", "'talk'"]),
        ("configs/nodes/publishers[self.queue_size == 0]/node/id", ["'/walker'"]),
    ],
)
def test_global_queries_see_packages_files_and_types_of_nodes(text: str, found: list[str]) -> None:
    assert about(text, "global") == found


def test_package_queries_see_one_package_after_the_other() -> None:
    assert about("package/name", "package") == ["'walker'"]
    assert about("files/name", "package") == ["'walk.launch'", "'walker.cpp'", "'Step.msg'"]
    assert about("nodes/name", "package") == ["'walker_node'", "'ns::Talker'"]


def test_a_pattern_leaves_unknown_parts_open() -> None:
    assert about("topics[self.unresolved]/rosname/pattern") == ["'/base/(.+?)$'"]


def test_several_servers_are_all_there_and_server_is_the_last() -> None:
    stop = end("servers", "/walker/stop", "/walker/stop", 50, "std_srvs/Empty")
    robot = robot_with(WALKER, replace(BASE, endpoints=(stop,)))
    assert about("services[len(self.servers) > 1]/server/node/id", robot=robot) == ["'/base'"]


def test_nodes_of_one_name_are_equal_but_not_those_without_a_known_one() -> None:
    again = replace(WALKER, location=Location("src/walker/launch/walk.launch", 9, 3))
    assert about("nodes", robot=robot_with(WALKER, again)) == ["NodeInstance walk:/walker"]
    unknown = replace(WALKER, name="/?")
    assert len(about("nodes", robot=robot_with(unknown, unknown))) == 2


def test_what_is_implicit_is_no_part_of_a_query() -> None:
    assert about("topics[self.id == '/rosout']") == []


def test_every_variable_of_a_scope_is_there() -> None:
    assert {"config", "nodes", "topics", "services", "parameters"} <= scene().keys()
    assert {"files", "packages", "nodes", "configs"} == scene("global").keys()
    assert {"package", "files", "nodes"} == scene("package").keys()
