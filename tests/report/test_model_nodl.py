# SPDX-License-Identifier: Apache-2.0
"""Node types as NoDL: names in the node's own words, the grammar of its schema, and nothing that is not known."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import pytest
from interface_samples import BASE, CPP, LANE, ODOM, PACKAGES, PATH, RESET, STATUS, SYSTEM, VAGUE, end
from test_model_json import HOSTILE

from haros_ci.commands.interface_files import put
from haros_ci.model.architecture import Architecture, Configuration, Node, Unknown
from haros_ci.model.location import Location
from haros_ci.report import model_interface_table, model_nodl
from haros_ci.report.node_interface import interfaces, own_name

WHY = "what read- -file returns is not known"  # XML has no two hyphens in a comment
#: Element: its attributes, all required, with the values that they may have (v1.xsd of nodl_python).
SERVER = ("server", "client", "both")
GRAMMAR = {
    "action": {"name": None, "type": None, "role": SERVER},
    "parameter": {"name": None, "type": None},
    "service": {"name": None, "type": None, "role": SERVER},
    "topic": {"name": None, "type": None, "role": ("publisher", "subscription", "both")},
}


def valid(text: str) -> ElementTree.Element:
    """The document, if it is as the schema has it."""
    root = ElementTree.fromstring(text)
    assert root.tag == "interface" and root.attrib == {"version": "1"} and len(root) > 0
    for node in root:
        assert node.tag == "node" and set(node.attrib) == {"name", "executable"} and len(node) > 0
        for item in node:
            assert set(item.attrib) == set(GRAMMAR[item.tag]) and len(item) == 0
            for key, allowed in GRAMMAR[item.tag].items():
                assert item.attrib[key] and (allowed is None or item.attrib[key] in allowed)
    return root


def of(*nodes: Node) -> Architecture:
    return Architecture(
        configurations=tuple(Configuration(name=str(n), nodes=(x,)) for n, x in enumerate(nodes)), packages=PACKAGES
    )


def test_a_document() -> None:
    text = model_nodl.render(SYSTEM)
    valid(text)
    assert (
        text
        == f"""<?xml version="1.0" encoding="UTF-8"?>
<interface version="1">
  <!-- package base -->
  <node name="base" executable="base_node">
    <parameter name="robot" type="string" />
    <parameter name="~/rate" type="int" />
    <topic name="odom" type="nav_msgs/msg/Odometry" role="publisher" />
    <topic name="~/cmd" type="geometry_msgs/msg/Twist" role="subscription" />
    <service name="stop" type="std_srvs/srv/Empty" role="server" />
  </node>
  <!-- package lane -->
  <node name="lane" executable="lane_node">
    <action name="~/go" type="nav2_msgs/action/Wait" role="server" />
    <parameter name="limits" type="double[]" />
    <parameter name="map.frame" type="string" />
    <parameter name="rate" type="double" />
    <parameter name="width" type="double" />
    <topic name="/tf" type="tf2_msgs/msg/TFMessage" role="publisher" />
    <topic name="/vehicle/status" type="lane_msgs/msg/Status" role="subscription" />
    <topic name="echo" type="std_msgs/msg/Empty" role="both" />
    <topic name="odom" type="nav_msgs/msg/Odometry" role="subscription" />
    <topic name="~/output/path" type="nav_msgs/msg/Path" role="publisher" />
    <service name="ask" type="std_srvs/srv/SetBool" role="client" />
    <service name="~/reset" type="std_srvs/srv/Trigger" role="server" />
    <!-- left out: topic name=~/debug/? type=std_msgs/msg/String role=publisher: {WHY} ({CPP}:13:9) -->
    <!-- left out: topic name=hint type=? role=subscription: a macro makes it ({CPP}:14:3) -->
  </node>
</interface>
"""
    )


def test_one_package_only() -> None:
    root = valid(model_nodl.render(SYSTEM, "base"))
    assert [node.get("name") for node in root] == ["base"]


@pytest.mark.parametrize(
    ("node", "name", "expected"),
    [
        ("/ns/lane", "/ns/lane/x", "~/x"),
        ("/ns/lane", "/ns/x", "x"),
        ("/ns/lane", "/ns/lanes", "lanes"),
        ("/ns/lane", "/nsx/x", "/nsx/x"),
        ("/ns/lane", "/x", "/x"),
        ("/lane", "/x", "x"),
        ("/lane", "/lane/x/y", "~/x/y"),
        ("/lane", "/lane:a.b", "~/a.b"),
        ("/?/lane", "/?/lane/x", "~/x"),
        ("/?/lane", "/?/x", "x"),
        ("/?/lane", "/x", "/x"),
        ("/lane", "?", "?"),
    ],
)
def test_own_names(node: str, name: str, expected: str) -> None:
    assert own_name(node, name) == expected


def test_another_namespace_tells_absolute_from_relative() -> None:
    here = replace(
        LANE, name="/lane", endpoints=(end("publishers", "/map", "a/msg/B"), end("publishers", "/x", "a/msg/B"))
    )
    there = replace(
        LANE, name="/ns/lane", endpoints=(end("publishers", "/map", "a/msg/B"), end("publishers", "/ns/x", "a/msg/B"))
    )
    root = valid(model_nodl.render(of(here, there)))
    assert [item.get("name") for item in root[0]] == ["/map", "x"]
    (alone,) = valid(model_nodl.render(of(here)))
    assert [item.get("name") for item in alone] == ["map", "x"]


def test_several_names_of_one_type() -> None:
    text = model_nodl.render(
        of(LANE, replace(LANE, name="/b/lane"), replace(LANE, name="/b/left"), replace(LANE, name="/?"))
    )
    root = valid(text)
    assert [node.get("name") for node in root] == ["lane"]
    assert "<!-- also runs as left -->" in text


@pytest.mark.parametrize(
    ("node", "comments"),
    [
        (replace(LANE, endpoints=()), ["left out: lane_node: no entry is known"]),
        (replace(LANE, name="/?"), ["left out: lane_node: the node's name is not known"]),
        (
            replace(LANE, endpoints=(replace(VAGUE, unknowns=()),), unknowns=(Unknown("endpoints", "no source"),)),
            [
                "left out: lane_node: no entry is known",
                "left out: topic name=~/debug/? type=std_msgs/msg/String role=publisher",
                "there may be more: no source",
            ],
        ),
    ],
)
def test_what_no_node_can_be_written_of_is_a_comment(node: Node, comments: list[str]) -> None:
    text = model_nodl.render(of(node))
    assert "<node" not in text
    assert [line.strip() for line in text.splitlines() if "<!--" in line][1 : len(comments) + 1] == [
        f"<!-- {comment} -->" for comment in comments
    ]


def test_classes_of_libraries_are_no_nodes() -> None:
    brought = (
        replace(RESET, name="/?/reset", original_name="/?/reset"),
        replace(STATUS, original_name="/vehicle/status"),
    )
    part = replace(LANE, name="/?", kind="library", type="lane::Tool", endpoints=brought)
    text = model_nodl.render(of(part))
    assert "<node" not in text
    assert [line.strip() for line in text.splitlines() if "<!--" in line][1:] == [
        "<!-- left out: lane::Tool: a class of a library, for the node of whoever uses it -->",
        "<!-- left out: topic name=vehicle/status type=lane_msgs/msg/Status role=subscription -->",
        "<!-- left out: service name=~/reset type=std_srvs/srv/Trigger role=server -->",
    ]


def test_nothing_at_all() -> None:
    text = (
        '<?xml version="1.0" encoding="UTF-8"?>\n<interface version="1">\n  <!-- no node was found -->\n</interface>\n'
    )
    assert model_nodl.render(Architecture()) == text


def test_components_stand_with_their_class_and_nodes_of_other_packages_do_not_stand_at_all() -> None:
    part = replace(LANE, kind="component", type="lane::LaneNode")
    outside = replace(BASE, package="joy")
    root = valid(model_nodl.render(of(part, outside)))
    assert [node.get("executable") for node in root] == ["lane::LaneNode"]


@pytest.mark.parametrize("name", [HOSTILE, "/a--->b", "/\ufffe\x00", '"/><node name="x', "&lt;!-- -- --&gt;--", "/x-"])
def test_hostile_names_are_text(name: str) -> None:
    ends = (
        replace(PATH, original_name=name, type=name),
        replace(ODOM, original_name=f"{name}?", unknowns=(Unknown("name", name),)),
    )
    root = valid(model_nodl.render(of(replace(LANE, name=f"/ns/{name}x", type=f"{name}x", endpoints=ends), LANE)))
    assert len(root) == 2 or len(root) == 1


def test_order_does_not_depend_on_the_order_of_input() -> None:
    turned = replace(SYSTEM, configurations=SYSTEM.configurations[::-1], packages=PACKAGES[::-1])
    turned = replace(
        turned,
        configurations=tuple(
            replace(item, nodes=tuple(replace(n, endpoints=n.endpoints[::-1]) for n in item.nodes[::-1]))
            for item in turned.configurations
        ),
    )
    assert model_nodl.render(turned) == model_nodl.render(SYSTEM)


def beside(name: str, source: str = "source") -> Node:
    """A node that the process of ``/lane`` makes beside it."""
    made = replace(
        LANE, name=name, process="/lane", source=source, endpoints=(end("publishers", f"{name}/x", "a/msg/B"),)
    )
    return replace(made, location=Location("src/lane/src/b.cpp", 3))


def test_nodes_of_one_process_stand_by_themselves() -> None:
    main = replace(LANE, name="/lane", process="/lane", endpoints=(end("publishers", "/y", "a/msg/B"),))
    found = of(main, beside("/costmap"), beside("/transform_listener_impl_?"))
    text = model_nodl.render(found)
    root = valid(text)
    assert [(node.get("name"), node.get("executable"), [item.get("name") for item in node]) for node in root] == [
        ("lane", "lane_node", ["y", "~/x"]),  # what the library makes for itself is the first node's
        ("costmap", "lane_node", ["~/x"]),
    ]
    assert "also runs as" not in text
    assert "### `lane_node`: `costmap`" in model_interface_table.render(found, "lane")
    launched = beside("/costmap", source="launch")
    assert len(valid(model_nodl.render(of(main, launched)))) == 1


def test_what_every_plugin_makes_at_once_counts_where_nothing_else_is_seen() -> None:
    every = replace(LANE, name="/lane", endpoints=(end("publishers", "/all", "a/msg/B"),))
    one = replace(LANE, name="/lane", endpoints=(end("publishers", "/one", "a/msg/B"),))
    loaded = Configuration(name="lane/lane_node (plug-ins)", nodes=(every,))
    plain = Configuration(name="z", nodes=(one,))

    def names(*configurations: Configuration) -> list[str]:
        found = Architecture(configurations=configurations, packages=PACKAGES)
        return [entry.name for item in interfaces(found) for entry in item.entries]

    assert names(loaded) == ["all"]
    assert names(loaded, plain) == ["one"]


def test_two_nodes_of_one_name_in_a_process_are_one() -> None:
    main = replace(LANE, name="/lane", process="/lane", endpoints=(end("publishers", "/y", "a/msg/B"),))
    again = replace(
        beside("/costmap"), location=Location("src/lane/src/b.cpp", 9), endpoints=(end("publishers", "/z", "a/msg/B"),)
    )
    same = replace(beside("/lane"), endpoints=(end("publishers", "/w", "a/msg/B"),))
    root = valid(model_nodl.render(of(main, beside("/costmap"), again, same)))
    assert [(node.get("name"), [item.get("name") for item in node]) for node in root] == [
        ("lane", ["w", "y"]),
        ("costmap", ["z", "~/x"]),
    ]


def test_a_document_without_a_node_is_not_valid() -> None:
    assert model_nodl.is_valid(SYSTEM, "lane")
    assert not model_nodl.is_valid(of(replace(LANE, endpoints=())), "lane")


def test_a_package_without_a_document_gets_no_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blank = replace(BASE, endpoints=())
    put(of(LANE, blank), "nodl", tmp_path, Path("/nowhere"))
    assert [path.name for path in tmp_path.iterdir()] == ["lane.nodl.xml"]
    assert capsys.readouterr().err == "note: no file for base: none of its nodes is known well enough for NoDL\n"
