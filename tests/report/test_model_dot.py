# SPDX-License-Identifier: Apache-2.0
"""The model as a GraphViz digraph."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from test_model_json import BASE, HOSTILE, ODOM, ROBOT, SAMPLE, VIEW

from haros_ci.model.architecture import Architecture
from haros_ci.report import model_dot

#: What a DOT lexer sees outside strings: graphviz.org/doc/info/lang.html.
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')


def test_the_whole_text() -> None:
    assert (
        model_dot.render(SAMPLE)
        == r"""digraph architecture {
  rankdir=LR;
  node [fontname=Helvetica];
  subgraph cluster_c0 {
    label="robot";
    c0n0 [label="/base\nbase/BaseNodelet", shape=box];
    c0n1 [label="/view\ntools/view", shape=box, style=dashed];
    c0t0 [label="/base/?\n?", shape=ellipse, color=red, fontcolor=red];
    c0t0 -> c0n0;
    c0t1 [label="/base/?\n?", shape=ellipse, style=dashed, color=red, fontcolor=red];
    c0t1 -> c0n1 [style=dashed];
    c0t2 [label="/odom\nnav_msgs/Odometry", shape=ellipse, style=dashed];
    c0n0 -> c0t2 [style=dashed];
    c0t2 -> c0n1 [style=dashed];
    c0s3 [label="/reset\nstd_srvs/Empty", shape=diamond, style=dashed];
    c0n1 -> c0s3 [style=dashed];
    c0a4 [label="/go\nnav/Go", shape=hexagon, style=dashed];
    c0n1 -> c0a4 [style=dashed];
  }
}
"""
    )


def test_servers_are_pointed_at_and_a_second_end_makes_no_second_edge() -> None:
    server = replace(ODOM, kind="servers", name="/reset", conditions=())
    node = replace(BASE, endpoints=(server, replace(server, conditions=ODOM.conditions)))
    text = model_dot.render(Architecture(configurations=(replace(ROBOT, nodes=(node,)),)))
    assert re.findall(r".* -> .*", text) == ["    c0s0 -> c0n0;"]


def test_a_type_that_one_end_does_not_know_is_marked() -> None:
    node = replace(BASE, endpoints=(ODOM, replace(ODOM, type=None)))
    text = model_dot.render(Architecture(configurations=(replace(ROBOT, nodes=(node,)),)))
    assert r'label="/odom\nnav_msgs/Odometry, ?"' in text


def test_configurations_do_not_share_names() -> None:
    text = model_dot.render(Architecture(configurations=(ROBOT, replace(ROBOT, name="b"))))
    assert 'subgraph cluster_c0 {\n    label="b"' in text and 'subgraph cluster_c1 {\n    label="robot"' in text
    assert "c1n0 [" in text


@pytest.mark.parametrize("name", [HOSTILE, "\\", "\\N", '"', "a\nb", '"]; x -> y; z [label="', "&lt;b&gt;", "<b>", ""])
def test_hostile_names_stay_in_their_string(name: str) -> None:
    end = replace(ODOM, name=name, type=name)
    node = replace(BASE, name=name, type=name, endpoints=(end,))
    text = model_dot.render(Architecture(configurations=(replace(ROBOT, name=name, nodes=(node, VIEW)),)))
    bare = STRING.sub("S", text)
    assert re.fullmatch(r"[A-Za-z0-9_ =;,{}\[\]\n>-]*", bare)
    assert len(bare.splitlines()) == 19 and bare.count("->") == 5
    assert "##[" not in text and "\x1b" not in text and "\u202e" not in text


def test_quoting() -> None:
    assert model_dot.quoted('a"b\\N&lt;\n') == '"a\\"b\\\\N&amp;lt;\ufffd"'
