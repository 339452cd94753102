# SPDX-License-Identifier: Apache-2.0
"""Known nodes: what an entry becomes when a node is started, and what is said of an entry that has no form."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from typing import Any

import pytest

from haros_ci.model.architecture import Endpoint, Unknown
from haros_ci.model.location import Location
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.known.load import load_known, load_user, parse
from haros_ci.values.abstract import Cell, Known, Opaque, Sequence

HERE = Location("robot/launch/robot.launch", 7)


def node_of(text: str) -> KnownNode:
    found, problems = load_user({"acme": {"driver": parse(text)}}, "haros.yaml")
    assert problems == ()
    return found["acme"]["driver"]


def started(
    node: KnownNode,
    *arguments: str,
    name: str = "/ns/me",
    remaps: Mapping[str, str] | None = None,
    distribution: str | None = None,
    **parameters: Any,
) -> tuple[Endpoint, ...]:
    """*parameters* are private ones, with ``__`` for a slash; a leading ``_`` means one of the namespace."""
    namespace = name.rpartition("/")[0] or "/"
    values = {}
    for key, value in parameters.items():
        key = key.replace("__", "/")
        full = f"{namespace}/{key[1:]}" if key.startswith("_") else f"{name}/{key}"
        values[full.replace("//", "/")] = value
    return instantiate(
        node,
        name=name,
        namespace=namespace,
        arguments=arguments,
        parameter=values.get,
        remap=lambda full: (remaps or {}).get(full, full),
        distribution=distribution,
    )


def names(ends: tuple[Endpoint, ...], kind: str = "") -> list[str]:
    return [end.name for end in ends if end.kind == kind or not kind]


def reasons(end: Endpoint, field: str) -> list[str]:
    return [why.reason for why in end.unknowns if why.field == field]


def topic(name: str, **more: Any) -> KnownNode:
    return node_of(repr({"subscribers": [{"name": name, "type": "std_msgs/Bool", "queue_size": 1, **more}]}))


# --- names


@pytest.mark.parametrize(
    ("written", "resolved"),
    [
        ("scan", "/ns/scan"),
        ("~map", "/ns/me/map"),
        ("/tf", "/tf"),
        ("~", "/ns/me"),
        ("a/b", "/ns/a/b"),
        ("{param:~topic|scan}", "/ns/scan"),
        ("{param:~topic|/scan}", "/scan"),
        ("~{param:~topic|/map}", "/map"),
        ("~{param:~topic|map}", "/ns/me/map"),
        ("{arg:0|{param:~topic|deep}_x}", "/ns/deep_x"),
        ("{option:-ns|/gazebo}/spawn", "/gazebo/spawn"),
        ("{beside:image}/camera_info", "/ns/camera_info"),
        ("{beside:/image}/camera_info", "/camera_info"),
        ("{resolved:imu}/data", "/ns/imu/data"),
    ],
)
def test_names_without_anything_given(written: str, resolved: str) -> None:
    (end,) = started(topic(written))
    assert (end.name, end.original_name, end.unknowns) == (resolved, resolved, ())


def test_names_in_the_root_namespace() -> None:
    assert names(started(topic("scan"), name="/me")) == ["/scan"]
    assert names(started(topic("~scan"), name="/me")) == ["/me/scan"]


def test_an_endpoint_has_all_that_is_written() -> None:
    node = node_of("publishers: [{name: map, type: nav_msgs/OccupancyGrid, queue_size: 1, latched: true}]")
    assert started(node) == (
        Endpoint(
            kind="publishers",
            name="/ns/map",
            original_name="/ns/map",
            type="nav_msgs/OccupancyGrid",
            location=None,
            queue_size=1,
            latched=True,
            source="known-node",
        ),
    )


@pytest.mark.parametrize(
    ("written", "seen"),
    [
        ("tf/tfMessage", "tf2_msgs/TFMessage"),
        ("tf/msg/tfMessage", "tf2_msgs/TFMessage"),
        ("tf2_msgs/TFMessage", "tf2_msgs/TFMessage"),
        ("tf/FrameGraph", "tf/FrameGraph"),
    ],
)
def test_a_type_that_is_sent_as_another_one(written: str, seen: str) -> None:
    """As in code: who subscribes to ``tf2_msgs/TFMessage`` has what is published as ``tf/tfMessage`` (one md5 sum)."""
    (end,) = started(node_of(f"publishers: [{{name: /tf, type: {written}, queue_size: 100}}]"))
    assert end.type == seen


def test_a_name_is_remapped_once() -> None:
    (end,) = started(topic("scan"), remaps={"/ns/scan": "/laser", "/laser": "/no"})
    assert (end.name, end.original_name) == ("/laser", "/ns/scan")


def test_what_stands_beside_a_topic_follows_its_remapping() -> None:
    remaps = {"/ns/image": "/camera/image", "/camera/camera_info": "/info"}
    (end,) = started(topic("{beside:image}/camera_info"), remaps=remaps)
    assert (end.name, end.original_name) == ("/info", "/camera/camera_info")
    assert names(started(topic("{resolved:image}/compressed"), remaps=remaps)) == ["/camera/image/compressed"]


def test_parameters_in_names() -> None:
    node = topic("{param:~topic|scan}")
    assert names(started(node, topic="/front")) == ["/front"]
    assert names(started(node, topic="front")) == ["/ns/front"]
    assert names(started(topic("{param:topic|scan}"), _topic="front")) == ["/ns/front"]
    assert names(started(node, topic=Known("front"))) == ["/ns/front"]
    assert started(node, topic="") == ()


def test_the_nearest_parameter_is_found_upwards() -> None:
    node = node_of("getters: [{name: '{search:robot_description}', type: str}]")
    assert names(started(node, name="/a/b/me", _robot_description="x")) == ["/a/b/robot_description"]
    assert names(started(node, name="/me")) == ["/robot_description"]
    (end,) = started(node, name="/a/me")
    assert (end.name, reasons(end, "name")) == ("/a/?", ["robot_description is searched for, and set nowhere"])


# --- what is not known


def test_a_parameter_without_data_makes_an_unknown_name() -> None:
    node = topic("{param:~topic|scan}/raw")
    for value in (Unknown("value", "no such file", HERE), Opaque("no such file", HERE)):
        (end,) = started(node, topic=value)
        assert end.name == "/ns/?/raw"
        assert end.unknowns == (Unknown("name", "no such file", HERE),)


@pytest.mark.parametrize("value", [3, True, ["a"], {"a": 1}])
def test_a_parameter_that_is_no_text_makes_an_unknown_name(value: object) -> None:
    (end,) = started(topic("{param:~topic|scan}"), topic=value)
    assert (end.name, end.unknowns) == ("/ns/?", (Unknown("name", "~topic is no text"),))


def test_a_name_that_cannot_be_one_is_unknown() -> None:
    (end,) = started(topic("{arg:0}"), "-m")
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["'-m' is no ROS name"])
    (end,) = started(topic("{param:~topic}"), topic="$(arg x)")
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["'$(arg x)' is no ROS name"])


def test_an_unknown_name_is_not_remapped() -> None:
    (end,) = started(topic("{arg:0}"), remaps={"/ns/?": "/no"})
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["argument 1 on the command line is not given"])


def test_reasons_that_are_written_are_given() -> None:
    node = node_of("publishers: [{name: '{unknown:plug-ins decide}', type: '{unknown:they decide}', latched: false}]")
    (end,) = started(node)
    assert (end.name, end.type, end.latched, end.queue_size) == ("/ns/?", None, False, None)
    assert end.unknowns == (
        Unknown("name", "plug-ins decide"),
        Unknown("type", "they decide"),
        Unknown("queue_size", "the data on this node does not tell it"),
    )


def test_queue_and_latch_by_parameter() -> None:
    node = node_of("publishers: [{name: a, type: b/C, queue_size: '~size|5', latched: '~latch|true'}]")
    (end,) = started(node)
    assert (end.queue_size, end.latched, end.unknowns) == (5, True, ())
    (end,) = started(node, size=7, latch=False)
    assert (end.queue_size, end.latched, end.unknowns) == (7, False, ())
    (end,) = started(node, size="7", latch=Unknown("value", "no such file", HERE))
    assert (end.queue_size, end.latched) == (None, None)
    assert end.unknowns == (
        Unknown("queue_size", "~size is not a whole number"),
        Unknown("latched", "no such file", HERE),
    )


def test_defaults_of_getters() -> None:
    node = node_of(
        "getters: [{name: ~a, type: double, default: 0.5}, {name: ~b, type: yaml, default: [1]},"
        " {name: ~c, type: str}, {name: ~d, type: str, default: '{unknown:that of ~a}'}]"
    )
    found = started(node)
    assert [(end.name, end.type, end.value) for end in found] == [
        ("/ns/me/a", "double", 0.5),
        ("/ns/me/b", "yaml", [1]),
        ("/ns/me/c", "str", None),
        ("/ns/me/d", "str", None),
    ]
    assert [end.unknowns for end in found] == [(), (), (), (Unknown("value", "that of ~a"),)]


# --- arguments


def test_arguments_by_place() -> None:
    node = topic("{arg:1|{arg:0}_relay}")
    assert names(started(node, "in", "out")) == ["/ns/out"]
    assert names(started(node, "in")) == ["/ns/in_relay"]
    assert names(started(node, "/in", "a:=b", "_rate:=3", "__name:=x")) == ["/in_relay"]


def test_arguments_after_an_unknown_one_are_unknown() -> None:
    node = topic("{arg:1|{arg:0}_relay}")
    (end,) = started(node, "in", "?", "out")
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["an argument on the command line is not known"])
    (end,) = started(topic("{arg:0}"), "in", "?")
    assert (end.name, end.unknowns) == ("/ns/in", ())


@pytest.mark.parametrize("words", [("-ns", "/sim"), ("-ns=/sim",), ("--ns", "/sim"), ("-x", "1", "--ns=/sim", "-v")])
def test_options(words: tuple[str, ...]) -> None:
    assert names(started(topic("{option:-ns|/gazebo}/spawn"), *words)) == ["/sim/spawn"]


def test_an_unknown_argument_may_be_the_option() -> None:
    (end,) = started(topic("{option:-ns|/gazebo}/spawn"), "?")
    assert (end.name, reasons(end, "name")) == ("/ns/?/spawn", ["an argument on the command line is not known"])
    (end,) = started(topic("spawn", **{"if": "option:-urdf"}), "?")
    assert reasons(end, "conditions") == ["it depends on option -urdf: an argument on the command line is not known"]


# --- conditions


@pytest.mark.parametrize(
    ("condition", "parameters", "there"),
    [
        ("~on|true", {}, True),
        ("~on|true", {"on": False}, False),
        ("~on|false", {}, False),
        ("~on|false", {"on": True}, True),
        ("~on", {}, False),
        ("~on", {"on": True}, True),
        ("~frame", {"frame": "base"}, True),
        ("~frame", {"frame": ""}, False),
        ("~on", {"on": 0}, False),
        ("on|true", {"_on": False}, False),
        ("~mode|sync == sync", {}, True),
        ("~mode|sync == sync", {"mode": "async"}, False),
        ("~mode == sync", {}, False),
        ("~n|1 == 2", {"n": 2}, True),
        ("~n|1 == 2", {}, False),
    ],
)
def test_conditions_on_parameters(condition: str, parameters: dict[str, Any], there: bool) -> None:
    found = started(topic("a", **{"if": condition}), **parameters)
    assert (names(found), [end.unknowns for end in found]) == ((["/ns/a"], [()]) if there else ([], []))
    assert names(started(topic("a", unless=condition), **parameters)) == ([] if there else ["/ns/a"])


def test_conditions_on_the_command_line() -> None:
    manager = topic("~list", **{"if": "arg:0 == manager"})
    assert names(started(manager, "manager")) == ["/ns/me/list"]
    assert started(manager, "load", "a/B", "manager") == ()
    assert started(manager) == ()
    urdf = topic("spawn", **{"if": "option:-urdf"})
    assert names(started(urdf, "-param", "x", "-urdf")) == ["/ns/spawn"]
    assert started(urdf, "-sdf") == ()


def test_all_of_if_and_none_of_unless() -> None:
    both = topic("a", **{"if": ["~a", "~b"]})
    assert [len(started(both, a=a, b=b)) for a in (True, False) for b in (True, False)] == [1, 0, 0, 0]
    neither = topic("a", unless=["~a", "~b"])
    assert [len(started(neither, a=a, b=b)) for a in (True, False) for b in (True, False)] == [0, 0, 0, 1]


def test_an_undecided_condition_keeps_the_endpoint() -> None:
    (end,) = started(topic("a", **{"if": "~on|true"}), on=Unknown("value", "no such file", HERE))
    assert end.unknowns == (Unknown("conditions", "it depends on ~on: no such file", HERE),)
    (end,) = started(topic("a", unless="~on|true"), on="perhaps")
    assert end.unknowns == (Unknown("conditions", "it depends on ~on, which is neither true nor false"),)
    (end,) = started(topic("a", **{"if": "unknown:the device decides"}))
    assert end.unknowns == (Unknown("conditions", "the device decides"),)


def test_one_certain_no_beats_an_undecided_one() -> None:
    assert started(topic("a", **{"if": ["unknown:the device decides", "~on|false"]})) == ()


# --- lists


def test_each_item_of_a_parameter() -> None:
    node = topic("{item}/raw", each="~sources")
    assert started(node) == ()
    assert names(started(node, sources=["a", "/b"])) == ["/ns/a/raw", "/b/raw"]
    assert names(started(node, sources=Sequence(Cell((Cell(Known("a")),))))) == ["/ns/a/raw"]  # type: ignore[arg-type]
    assert names(started(topic("{item.topic}", each="~l"), l=[{"topic": "x"}, {"topic": "/y"}])) == ["/ns/x", "/y"]


def test_items_that_are_no_names() -> None:
    (end,) = started(topic("{item.topic}", each="~l"), l=[{"name": "x"}])
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["an item of the list has no topic"])
    (end,) = started(topic("{item}", each="~l"), l=[5])
    assert (end.name, reasons(end, "name")) == ("/ns/?", ["an item of the list is no text"])


def test_a_list_that_is_none() -> None:
    node = topic("{item}", each="~sources")
    (end,) = started(node, sources="a")
    assert (end.name, end.unknowns) == ("/ns/?", (Unknown("name", "~sources is no list"),))
    (end,) = started(node, sources=Opaque("no such file", HERE))
    assert (end.name, end.unknowns) == ("/ns/?", (Unknown("name", "no such file", HERE),))


def test_numbered_parameters() -> None:
    node = topic("{item}", each="~odom#")
    assert names(started(node, odom0="a", odom1="/b", odom3="no")) == ["/ns/a", "/b"]
    assert started(node, odom1="no") == ()
    (_, end) = started(node, odom0="a", odom1=Unknown("value", "no such file", HERE))
    assert (end.name, end.unknowns) == ("/ns/?", (Unknown("name", "no such file", HERE),))


def test_arguments_as_a_list() -> None:
    node = topic("{item}", each="args:1")
    assert names(started(node, "out", "a", "b")) == ["/ns/a", "/ns/b"]
    assert started(node, "out") == ()
    (first, rest) = started(node, "out", "a", "?", "b")
    assert (first.name, first.unknowns) == ("/ns/a", ())
    assert (rest.name, reasons(rest, "name")) == ("/ns/?", ["an argument on the command line is not known"])


def test_what_is_the_same_is_there_once() -> None:
    assert names(started(topic("{item}", each="~l"), l=["a", "a", "/ns/a"])) == ["/ns/a"]


# --- distributions


def test_distributions_of_an_endpoint() -> None:
    node = topic("a", distributions=["melodic", "noetic"])
    assert [end.unknowns for end in started(node, distribution="noetic")] == [()]
    assert started(node, distribution="kinetic") == ()
    assert [end.unknowns for end in started(node)] == [
        (Unknown("conditions", "it is only in ROS melodic, noetic"),),
    ]


def test_distributions_of_a_node() -> None:
    node = node_of("{distributions: [kinetic], subscribers: [{name: a, type: b/C, queue_size: 1}]}")
    assert names(started(node, distribution="kinetic")) == ["/ns/a"]
    assert names(started(node)) == ["/ns/a"]
    assert started(node, distribution="noetic") == ()


# --- our own data


def known(package: str, node: str) -> KnownNode:
    found = load_known(package)
    assert found is not None
    return found[node]


def test_map_server() -> None:
    found = started(known("map_server", "map_server"), "map.yaml", name="/map_server", distribution="melodic")
    assert [(end.kind, end.name, end.type, end.latched) for end in found] == [
        ("publishers", "/map", "nav_msgs/OccupancyGrid", True),
        ("publishers", "/map_metadata", "nav_msgs/MapMetaData", True),
        ("servers", "/static_map", "nav_msgs/GetMap", None),
        ("getters", "/map_server/frame_id", "str", None),
    ]


def test_amcl_takes_the_map_from_a_topic_or_a_service() -> None:
    amcl = known("amcl", "amcl")
    by_service = started(amcl, name="/amcl")
    assert "/static_map" in names(by_service, "clients") and "/map" not in names(by_service, "subscribers")
    by_topic = started(amcl, name="/amcl", use_map_topic=True)
    assert names(by_topic, "clients") == [] and "/map" in names(by_topic, "subscribers")
    remapped = started(amcl, name="/amcl", remaps={"/scan": "/base_scan"})
    assert "/base_scan" in names(remapped, "subscribers") and "/scan" not in names(remapped, "subscribers")


def test_topic_tools_and_their_arguments() -> None:
    mux = started(known("topic_tools", "mux"), "cmd_vel", "joy_vel", "nav_vel", name="/mux")
    assert names(mux, "subscribers") == ["/joy_vel", "/nav_vel"]
    assert names(mux, "publishers") == ["/cmd_vel", "/mux/selected"]
    assert names(mux, "servers") == ["/cmd_vel_select", "/mux/select", "/mux/add", "/mux/list", "/mux/delete"]
    throttle = known("topic_tools", "throttle")
    assert names(started(throttle, "messages", "scan", "1.0", name="/t")) == ["/scan_throttle", "/scan"]
    assert names(started(throttle, "bytes", "scan", "1024", "1", "slow", name="/t")) == ["/slow", "/scan"]


def test_the_inputs_of_a_localization_filter() -> None:
    found = started(
        known("robot_localization", "ekf_localization_node"), name="/ekf", odom0="odom", imu0="/imu/data", imu1="imu2"
    )
    assert [(end.name, end.type) for end in found if end.kind == "subscribers"][-3:] == [
        ("/odom", "nav_msgs/Odometry"),
        ("/imu/data", "sensor_msgs/Imu"),
        ("/imu2", "sensor_msgs/Imu"),
    ]


def test_a_nodelet_manager_and_its_loader() -> None:
    nodelet = known("nodelet", "nodelet")
    manager = started(nodelet, "manager", name="/m")
    assert names(manager, "servers") == ["/m/load_nodelet", "/m/unload_nodelet", "/m/list"]
    assert [end.name for end in manager if end.implicit] == ["/m/bond", "/m/bond"]
    loader = started(nodelet, "load", "a/B", "m", "--no-bond", name="/n")
    assert names(loader) == ["/m/load_nodelet", "/m/unload_nodelet"]
    assert names(started(nodelet, "standalone", "a/B", name="/n")) == []


def test_the_topics_of_a_camera_follow_its_image() -> None:
    found = started(known("usb_cam", "usb_cam_node"), name="/cam", remaps={"/cam/image_raw": "/front/image_raw"})
    assert names(found, "publishers") == ["/front/image_raw", "/front/camera_info"]


def test_packages_that_are_not_known() -> None:
    for package in ("acme", "", "../amcl", "amcl.yaml", "a/b", "a" * 1000, "."):
        assert load_known(package) is None


def test_the_file_of_one_package_is_read_when_it_is_asked_for() -> None:
    code = (
        "import sys, haros_ci.systems.known.load as load; before = 'yaml' in sys.modules; load.load_known('acme');"
        " print(before, 'yaml' in sys.modules); load.load_known('tf'); print('yaml' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.split() == ["False", "False", "True"]


# --- what a project file says


def said(text: str) -> list[str]:
    _, problems = load_user({"acme": parse(text)}, "haros.yaml")
    assert all(problem.path == "haros.yaml" for problem in problems)
    return [problem.message for problem in problems]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[a]", "known_nodes.acme: it must be a map of node types"),
        ("{a: 1}", "known_nodes.acme.a: it must be a map with lists such as publishers, not int"),
        (
            "{a b: {}}",
            "known_nodes.acme.a b: this is no node type: write the executable, or the look-up name of a nodelet",
        ),
        ("{a: {publisher: []}}", "known_nodes.acme.a: nothing is called 'publisher' here; did you mean 'publishers'?"),
        ("{a: {nodelet: true}}", "known_nodes.acme.a: a nodelet goes by its look-up name, such as acme/a"),
        ("{a: {nodelet: 1}}", "known_nodes.acme.a: nodelet must be true or false"),
        ("{a: {source: 1}}", "known_nodes.acme.a: source must be the address of a page"),
        ("{a: {publishers: {}}}", "known_nodes.acme.a.publishers: it must be a list of maps"),
        ("{a: {servers: [x]}}", "known_nodes.acme.a.servers[0]: it must be a map with a name and a type, not str"),
        ("{a: {servers: [{type: b/C}]}}", "known_nodes.acme.a.servers[0].name: it must be text, not NoneType"),
        ("{a: {servers: [{name: '', type: b/C}]}}", "known_nodes.acme.a.servers[0].name: it is empty"),
        ("{a: {servers: [{name: a b, type: b/C}]}}", "known_nodes.acme.a.servers[0].name: 'a b' is no ROS name"),
        (
            "{a: {servers: [{name: x}]}}",
            "known_nodes.acme.a.servers[0].type: 'None' is no type; write package/Name, or {unknown:the reason}",
        ),
        (
            "{a: {getters: [{name: x, type: string}]}}",
            "known_nodes.acme.a.getters[0].type: 'string' is no type; write one of bool, int, double, str, yaml,"
            " or {unknown:the reason}",
        ),
        (
            "{a: {servers: [{name: x, type: b/C, queue_size: 1}]}}",
            "known_nodes.acme.a.servers[0]: nothing is called 'queue_size' here; it can be one of: name, type, each,"
            " if, unless, implicit, distributions",
        ),
        (
            "{a: {publishers: [{name: x, type: b/C, queue_size: true}]}}",
            "known_nodes.acme.a.publishers[0].queue_size: it must be int, or a parameter such as ~queue_size|10",
        ),
        (
            "{a: {servers: [{name: x, type: b/C, if: '??'}]}}",
            "known_nodes.acme.a.servers[0].if: '??' cannot be read: a condition is written as ~parameter,"
            " ~parameter|default, ~parameter == word, arg:0 == word or option:-name",
        ),
        (
            "{a: {servers: [{name: x, type: b/C, each: 'args'}, {name: x, type: b/C, each: '~a b'}]}}",
            "known_nodes.acme.a.servers[1].each: '~a b' cannot be read: a list is written as ~parameter, ~parameter# or"
            " args:1",
        ),
        (
            "{a: {servers: [{name: '{item}', type: b/C}]}}",
            "known_nodes.acme.a.servers[0].name: {item} needs an 'each' that tells the list",
        ),
        (
            "{a: {servers: [{name: '{x', type: b/C}]}}",
            "known_nodes.acme.a.servers[0].name: '{x' cannot be read: there is a '{' without its '}'",
        ),
        (
            "{a: {servers: [{name: 'x}', type: b/C}]}}",
            "known_nodes.acme.a.servers[0].name: 'x}' cannot be read: there is a '}' without its '{'",
        ),
        (
            "{a: {servers: [{name: '{env:HOME}', type: b/C}]}}",
            "known_nodes.acme.a.servers[0].name: '{env:HOME}' cannot be read: {env:HOME} is none of {param}, {search},"
            " {arg}, {option}, {beside}, {resolved}, {unknown}, {item}",
        ),
        (
            "{a: {distributions: [humble]}}",
            "known_nodes.acme.a.distributions: it must be a list of some of: indigo, jade, kinetic, lunar, melodic,"
            " noetic",
        ),
        (
            "{a: {servers: [{name: x, type: b/C}, {name: x, type: b/C}]}}",
            "known_nodes.acme.a.servers[1]: it is there twice",
        ),
    ],
)
def test_a_wrong_shape_is_said(text: str, message: str) -> None:
    assert said(text) == [message]


def test_what_is_right_beside_what_is_wrong_is_kept() -> None:
    data = {
        "acme": {"a": {"servers": [{"name": "x", "type": "b/C"}, {"name": "y"}]}, "b": 1},
        "../evil": {"a": {}},
        7: {},
    }
    found, problems = load_user(data, "haros.yaml")
    assert {package: list(nodes) for package, nodes in found.items()} == {"acme": ["a"]}
    assert names(started(found["acme"]["a"])) == ["/ns/x"]
    assert [problem.message.partition(":")[0] for problem in problems] == [
        "known_nodes.acme.a.servers[1].type",
        "known_nodes.acme.b",
        "known_nodes",
        "known_nodes",
    ]


@pytest.mark.parametrize("data", [None, 1, "x", ["a"]])
def test_what_is_no_map_is_said(data: Any) -> None:
    found, (problem,) = load_user(data, "haros.yaml")
    assert (dict(found), problem.path, problem.message) == (
        {},
        "haros.yaml",
        "known_nodes must be a map of packages",
    )


def test_deep_and_long_texts_are_said() -> None:
    deep = "{arg:0|" * 50 + "x" + "}" * 50
    for name in (deep, "a" * 5000):
        _, (problem,) = load_user({"acme": {"a": {"servers": [{"name": name, "type": "b/C"}]}}}, "haros.yaml")
        assert problem.message.endswith("it is too long, or has too many braces in each other")


def test_the_problems_of_a_large_file_are_bounded() -> None:
    _, problems = load_user({"acme": {f"n{n}": 1 for n in range(5000)}}, "haros.yaml")
    assert len(problems) == 1000


def test_lists_that_are_too_long_are_cut_and_said() -> None:
    servers = [{"name": f"s{n}", "type": "b/C"} for n in range(1002)]
    found, (problem,) = load_user({"acme": {"a": {"servers": servers}}}, "haros.yaml")
    assert len(found["acme"]["a"].endpoints) == 1000
    assert problem.message == "known_nodes.acme.a.servers: only the first 1000 are read"


def test_nested_data_is_not_written_into_messages() -> None:
    nested: Any = "x"
    for _ in range(200):
        nested = [nested, nested]
    _, (problem,) = load_user({"acme": {"a": {"servers": [{"name": "x", "type": nested}]}}}, "haros.yaml")
    assert problem.message == (
        "known_nodes.acme.a.servers[0].type: 'list' is no type; write package/Name, or {unknown:the reason}"
    )
