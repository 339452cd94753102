# SPDX-License-Identifier: Apache-2.0
"""The model for people: counts, nodes, and how much is unknown."""

from __future__ import annotations

from dataclasses import replace

from interface_samples import BARE, LANE, SYSTEM
from test_model_json import BASE, CPP, HOSTILE, ODOM, ROBOT, SAMPLE, VAGUE, VIEW

from haros_ci.model.architecture import Architecture, Unknown
from haros_ci.model.location import Location
from haros_ci.report import model_text


def test_the_whole_text() -> None:
    assert (
        model_text.render(SAMPLE)
        == """configuration robot: 2 nodes, 3 topics, 1 service, 1 action, 1 parameter set
  launch base/launch/base.launch
    arg quiet:=false
  node /base base/BaseNodelet (nodelet): 1 publisher, 1 subscriber, 1 getter
  node /view tools/view [conditional]: 2 subscribers, 1 client, 1 action client
  unknown names: 2 of 7 (28.6%); unknown types: 2 of 7 (28.6%)
    2 names: the argument 'topic' is not constant (src/kobuki/base/src/odometry.cpp:80:9)
    2 types: the callback has no declared type (src/kobuki/base/src/odometry.cpp:80:5)
"""
    )


def test_gaps_leave_out_what_is_implicit() -> None:
    found = model_text.gaps(replace(ROBOT, nodes=(VIEW, replace(BASE, endpoints=(replace(VAGUE, implicit=True),)))))
    assert (found.endpoints, found.names, found.types) == (4, 1, 1)


def test_reasons_are_grouped_most_frequent_first_with_the_first_places() -> None:
    def end(line: int, reason: str) -> object:
        return replace(VAGUE, type="a/T", unknowns=(Unknown("name", reason, Location(CPP, line, 1)),))

    ends = (*(end(line, "read from a file") for line in (9, 3, 7, 5)), end(1, "built in a loop"))
    text = model_text.render(Architecture(configurations=(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),)),)))
    assert text.splitlines()[-3:] == [
        "  unknown names: 5 of 5 (100.0%); unknown types: 0 of 5 (0.0%)",
        f"    4 names: read from a file ({CPP}:3:1, {CPP}:5:1, {CPP}:7:1 and 1 more)",
        f"    1 name: built in a loop ({CPP}:1:1)",
    ]


def test_a_reason_without_a_line_stands_where_the_endpoint_does() -> None:
    ends = (
        replace(VAGUE, type="a/T", unknowns=(Unknown("name", "given elsewhere", Location("b.cpp")),)),
        replace(VAGUE, type="a/T", location=None, unknowns=(Unknown("name", "nowhere", Location("b.cpp")),)),
    )
    found = model_text.gaps(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),)))
    assert [(r.text, r.places) for r in found.reasons] == [
        ("given elsewhere", (Location(CPP, 80, 1),)),
        ("nowhere", (Location("b.cpp"),)),
    ]


def test_many_reasons_are_cut() -> None:
    ends = tuple(replace(VAGUE, type="a/T", unknowns=(Unknown("name", f"reason {n:02}"),)) for n in range(13))
    text = model_text.render(Architecture(configurations=(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),)),)))
    assert text.splitlines()[-2:] == [
        "    1 name: reason 09 (src/kobuki/base/src/odometry.cpp:80:1)",
        "    and 3 more reasons",
    ]


def test_an_unknown_without_a_reason_and_known_ones_with() -> None:
    ends = (replace(ODOM, type=None), replace(ODOM, unknowns=(Unknown("queue_size", "not constant"),)))
    found = model_text.gaps(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),)))
    assert [(r.field, r.text, r.count) for r in found.reasons] == [("type", "no reason given", 1)]


def test_no_endpoints_no_rate_and_no_configurations() -> None:
    text = model_text.render(Architecture(configurations=(replace(ROBOT, launch=(), arguments=(), nodes=()),)))
    assert text == "configuration robot: 0 nodes, 0 topics, 0 services, 0 actions, 1 parameter set\n"
    assert model_text.render(Architecture()) == "No configurations: no launch file and no node was found.\n"


def test_hostile_names_make_no_lines_commands_or_colors() -> None:
    end = replace(VAGUE, name=HOSTILE, unknowns=(Unknown("type", HOSTILE, Location(HOSTILE, 1)),))
    node = replace(BASE, name=HOSTILE, package=HOSTILE, endpoints=(end,))
    configuration = replace(
        ROBOT, name=HOSTILE, nodes=(node,), launch=(HOSTILE,), arguments=(("::error::a", "::error::b"),)
    )
    text = model_text.render(Architecture(configurations=(configuration,)))
    assert len(text.splitlines()) == 6
    assert not any(line.lstrip().startswith(("::", "##[")) for line in text.splitlines())
    assert "##[" not in text and not any(mark in text for mark in "\x1b\u202e\ud800\r")


def test_parameters_that_an_unreadable_file_may_set_are_no_number() -> None:
    may = replace(ROBOT.parameters[0], name="/base/?")
    empty = replace(ROBOT, launch=(), arguments=(), nodes=(), parameters=(*ROBOT.parameters, may))
    text = model_text.render(Architecture(configurations=(empty,)))
    assert text.endswith("0 actions, 1 parameter set, and more\n")


def test_ros_2_has_parameters_and_a_rate_of_unknown_qos() -> None:
    text = model_text.render(replace(SYSTEM, configurations=SYSTEM.configurations[:1]))
    assert text.splitlines()[2:] == [
        "  node /planning/lane lane/lane_node (lifecycle): 4 publishers, 4 subscribers, 1 server, 1 client, "
        "1 action server, 4 parameters",
        "  node /rviz rviz2/rviz2: 1 subscriber",
        "  unknown names: 1 of 16 (6.2%); unknown types: 1 of 16 (6.2%); unknown QoS: 2 of 9 (22.2%)",
        "    2 QoS: no reason given (src/lane/src/lane_node.cpp:12:3, src/lane/src/lane_node.cpp:14:3)",
        "    1 name: what read--file returns is not known (src/lane/src/lane_node.cpp:13:9)",
        "    1 type: a macro makes it (src/lane/src/lane_node.cpp:14:3)",
    ]


def test_a_declaration_without_a_type_is_unknown_only_if_it_says_so() -> None:
    def types(end: object) -> int:
        return model_text.gaps(replace(ROBOT, nodes=(replace(LANE, endpoints=(end,)),))).types

    assert types(replace(BARE, type=None)) == 0
    assert types(replace(BARE, type=None, unknowns=(Unknown("type", "x"),))) == 1
