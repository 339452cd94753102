# SPDX-License-Identifier: Apache-2.0
"""What a node is given from outside and passes on to a node that it makes itself (``parameter_overrides``)."""

from __future__ import annotations

import pickle

import pytest
from follow_kit import follow, only, ros2_files
from test_sharing import program, started

from haros_ci.values.abstract import Known, Opaque, Text
from haros_ci.values.given import Given, GivenText, Looks, looked_at

BODY = """bool sim = false;
get_parameter("use_sim_time", sim);
std::string frame = declare_parameter<std::string>("frame", "map");
rclcpp::NodeOptions inner;
inner.parameter_overrides({rclcpp::Parameter("use_sim_time", sim), rclcpp::Parameter("topic", frame)});
auto node = std::make_shared<rclcpp::Node>("inner", get_name(), inner);
auto topic = node->declare_parameter<std::string>("topic", "none");
node->create_publisher<String>(topic, 1);
"""


def test_each_node_passes_its_own_values_on() -> None:
    launch = started(
        "name='one', parameters=[{'use_sim_time': True, 'frame': 'a'}]",
        "name='two', parameters=[{'use_sim_time': False, 'frame': 'b'}]",
    )
    found = only(follow(ros2_files(program(BODY, ""), launch), 2))
    inner = {node.name: node for node in found.nodes if node.name.count("/") == 2}  # launch renames both
    made = {
        name: [e.name for e in node.endpoints if e.kind == "publishers" and not e.implicit]
        for name, node in inner.items()
    }
    assert made == {"/one/one": ["/one/a"], "/two/two": ["/two/b"]}
    pickle.dumps(found)


@pytest.mark.parametrize("data", [True, 3, "text", 2.5])
def test_what_is_given_is_carried_to_another_process_as_data(data: object) -> None:
    looks = Looks()
    value = Given(data, "mark" if isinstance(data, str) else None, ("cell",), looks)
    assert pickle.loads(pickle.dumps(value)) == Known(data) and not looks.seen
    assert looked_at(value) == Known(data) and looks.seen == {"cell"}


def test_a_text_with_what_is_given_in_it_is_carried_as_its_parts() -> None:
    looks = Looks()
    parts = ("a", Opaque("unknown"))
    value = GivenText(parts, Text(("m", Opaque("unknown"))), ("cell",), looks)
    assert pickle.loads(pickle.dumps(value)).parts == parts and not looks.seen
    assert looked_at(value) == Text(parts) and looks.seen == {"cell"}


def test_other_values_are_themselves() -> None:
    for value in (Known(1), Text(("a", Opaque("x"))), Opaque("x")):
        assert looked_at(value) is value
