# SPDX-License-Identifier: Apache-2.0
"""The ROS 1 Python table: every row loads, none hides another, and each documented call is there."""

from __future__ import annotations

import pytest
from every import every

from haros_ci.extract.apis.rospy import ROWS
from haros_ci.model.api import Row, load_row

COVERED = {
    "rospy.Publisher": {"publishers"},
    "rospy.Subscriber": {"subscribers"},
    "rospy.Service": {"servers"},
    "rospy.ServiceProxy": {"clients"},
    "rospy.get_param": {"getters"},
    "rospy.get_param_cached": {"getters"},
    "rospy.set_param": {"setters"},
    "rospy.has_param": {"getters"},
    "rospy.delete_param": {"setters"},
    "rospy.search_param": {"getters"},
    "rospy.wait_for_message": {"subscribers"},
    "rospy.wait_for_service": set(),
    "rospy.init_node": {"node"},
    "rospy.Timer": {"timer"},
    "rospy.Rate": {"rate"},
    "rospy.resolve_name": set(),
    "rospy.names.resolve_name": set(),
    "rospy.get_name": set(),
    "rospy.get_namespace": set(),
    "message_filters.Subscriber": {"subscribers"},
    "message_filters.SimpleFilter.registerCallback": set(),
    "actionlib.SimpleActionServer": {"action_servers"},
    "actionlib.simple_action_server.SimpleActionServer": {"action_servers"},
    "actionlib.ActionServer": {"action_servers"},
    "actionlib.action_server.ActionServer": {"action_servers"},
    "actionlib.SimpleActionClient": {"action_clients"},
    "actionlib.simple_action_client.SimpleActionClient": {"action_clients"},
    "actionlib.ActionClient": {"action_clients"},
    "actionlib.action_client.ActionClient": {"action_clients"},
    "smach_ros.ServiceState": {"clients"},
    "smach_ros.SimpleActionState": {"action_clients"},
    "smach_ros.MonitorState": {"subscribers"},
    "smach_ros.IntrospectionServer": set(),
    "smach_ros.IntrospectionServer.start": {"publishers", "subscribers"},
    "smach_ros.introspection.IntrospectionServer.start": {"publishers", "subscribers"},
    "smach_ros.ActionServerWrapper": {"action_servers"},
    "tf.TransformBroadcaster": {"publishers"},
    "tf.TransformListener": {"subscribers"},
    "tf2_ros.TransformBroadcaster": {"publishers"},
    "tf2_ros.StaticTransformBroadcaster": {"publishers"},
    "tf2_ros.TransformListener": {"subscribers"},
    "tf2_ros.Buffer": {"servers"},
    "tf2_ros.BufferClient": {"action_clients"},
    "dynamic_reconfigure.server.Server": {"servers", "publishers", "getters", "setters"},
    "dynamic_reconfigure.client.Client": {"clients", "subscribers"},
    "diagnostic_updater.Updater": {"publishers", "getters"},
    "interactive_markers.interactive_marker_server.InteractiveMarkerServer": {"publishers", "subscribers"},
}
BASES = {
    "message_filters.Subscriber": ("message_filters.SimpleFilter",),
    "message_filters.Cache": ("message_filters.SimpleFilter",),
    "message_filters.TimeSynchronizer": ("message_filters.SimpleFilter",),
    "message_filters.ApproximateTimeSynchronizer": ("message_filters.TimeSynchronizer",),
}


def loaded(call: str) -> list[Row]:
    return [load_row(row) for row in ROWS if row.get("call") == call]


@every("row", ROWS)
def test_every_row_loads(row: dict[str, object]) -> None:
    assert load_row(row).call


def test_no_two_rows_answer_the_same_call() -> None:
    keys = [(row.call, row.is_class, row.args, row.when) for row in map(load_row, ROWS)]
    assert len(keys) == len(set(keys))


def test_a_row_for_any_arguments_is_the_last_of_its_call() -> None:
    rows = [row for row in map(load_row, ROWS) if not row.is_class]
    for index, row in enumerate(rows):
        if not row.args and not row.when:
            assert row.call not in {later.call for later in rows[index + 1 :]}


@pytest.mark.parametrize("call", COVERED)
def test_each_call_makes_its_kinds(call: str) -> None:
    rows = loaded(call)
    assert rows
    assert {entry.kind for row in rows for entry in row.makes} == COVERED[call]


@pytest.mark.parametrize("name", BASES)
def test_filters_inherit_their_callbacks(name: str) -> None:
    assert [load_row(row).bases for row in ROWS if row.get("class") == name] == [BASES[name]]


@pytest.mark.parametrize(
    ("call", "key", "parts"),
    [
        ("rospy.Publisher", "name", ((("0", "name"), None),)),
        ("rospy.Publisher", "type", ((("typename(1|data_class)",), None),)),
        ("rospy.Publisher", "queue_size", ((("6", "queue_size"), None),)),
        ("rospy.Publisher", "latched", ((("4", "latch"), "false"),)),
        ("rospy.Subscriber", "queue_size", ((("4", "queue_size"), None),)),
        ("rospy.init_node", "anonymous", ((("2", "anonymous"), "false"),)),
        ("message_filters.Subscriber", "queue_size", ((("queue_size",), None),)),
        ("tf2_ros.StaticTransformBroadcaster", "latched", ("true",)),
        ("tf2_ros.TransformBroadcaster", "queue_size", ("100",)),
        ("tf.TransformBroadcaster", "queue_size", ((("0", "queue_size"), "100"),)),
        ("dynamic_reconfigure.client.Client", "name", ((("0", "name"), None), "/set_parameters")),
    ],
)
def test_arguments_by_position_and_keyword(call: str, key: str, parts: tuple[object, ...]) -> None:
    assert loaded(call)[0].makes[0].values[key].parts == parts


@pytest.mark.parametrize(
    ("call", "returns"),
    [
        ("rospy.resolve_name", "resolve(0|name)"),
        ("rospy.names.resolve_name", "resolve(0|name)"),
        ("rospy.remap_name", "remap(0|name)"),
        ("rosgraph.names.canonicalize_name", "canonical(0|name)"),
        ("rospy.search_param", "searched(0|param_name)"),
    ],
)
def test_names_are_given_as_rospy_gives_them(call: str, returns: str) -> None:
    (row,) = loaded(call)
    assert row.returns is not None
    assert row.returns.parts == (((returns,), None),)


def test_listeners_say_no_queue_size_unless_it_is_given() -> None:
    assert [set(entry.values) for entry in loaded("tf.TransformListener")[0].makes] == [{"name", "type"}] * 2


def test_a_buffer_with_a_flag_of_unknown_value_makes_nothing() -> None:
    last = loaded("tf2_ros.Buffer")[-1]
    assert (last.args, last.when, last.makes) == ((), (), ())


def test_a_server_reads_and_sets_each_parameter_of_its_config() -> None:
    for row in loaded("dynamic_reconfigure.server.Server"):
        assert [entry.kind for entry in row.makes if entry.each == "config(0)"] == ["getters", "setters"]


@pytest.mark.parametrize("call", ["image_transport.Publisher", "cv_bridge.CvBridge", "rospy.names.ns_join"])
def test_calls_without_a_row(call: str) -> None:
    assert loaded(call) == []
