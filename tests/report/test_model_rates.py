# SPDX-License-Identifier: Apache-2.0
"""Rates in the pictures and the database of a model."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from pathlib import Path

import pytest

from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.model.rates import Rate, Rates, TopicRate, exactly, unknown
from haros_ci.report import model_dot, model_mermaid, model_sqlite
from haros_ci.report.model_rates import known_rates

ENDS = tuple(
    Endpoint(kind=kind, name=name, original_name=name, type="std_msgs/String", location=None)
    for kind, name in (("publishers", "/a"), ("publishers", "/b"), ("subscribers", "/a"))
)
NODE = Node(name="/n", kind="node", package="p", type="n", endpoints=ENDS)
RATES = Rates(
    (
        TopicRate("/n", "/a", None, exactly(20.0), ()),
        TopicRate("/n", "/b", None, unknown("it is not seen"), ()),
    ),
    (("/a", exactly(20.0)), ("/b", unknown("it is not seen"))),
)
PLAIN = Configuration(name="c", nodes=(NODE,))
TIMED = replace(PLAIN, rates=RATES)


def architecture(configuration: Configuration) -> Architecture:
    return Architecture(configurations=(configuration,))


def test_a_bound_is_the_label_of_the_edge_of_the_publisher() -> None:
    text = model_dot.render(architecture(TIMED))
    assert [line.split("label=")[1] for line in text.splitlines() if "->" in line and "label" in line] == ['"20 Hz"];']
    assert '-->|"#50;0 Hz"| ' in model_mermaid.render(architecture(TIMED))


def test_without_rates_the_pictures_are_as_they_were() -> None:
    assert "Hz" not in model_dot.render(architecture(PLAIN)) + model_mermaid.render(architecture(PLAIN))
    assert known_rates(PLAIN) == {}


def test_several_publishers_of_one_node_are_one_edge() -> None:
    twice = Rates((TopicRate("/n", "/a", None, exactly(20.0), ()), TopicRate("/n", "/a", None, Rate(0.0, 5.0), ())), ())
    assert known_rates(replace(PLAIN, rates=twice)) == {("/n", "/a"): "20 to 25 Hz"}


@pytest.mark.parametrize(("configuration", "count"), [(PLAIN, 0), (TIMED, 2)])
def test_the_database_has_them(configuration: Configuration, count: int, tmp_path: Path) -> None:
    path = tmp_path / "model.sqlite"
    path.write_bytes(model_sqlite.render(architecture(configuration)))
    database = sqlite3.connect(path)
    rows = database.execute("SELECT node, topic, low, high, reason FROM rates").fetchall()
    assert len(rows) == count == len(database.execute("SELECT * FROM topic_rates").fetchall())
    assert not count or rows == [("/n", "/a", 20.0, 20.0, ""), ("/n", "/b", 0.0, None, "it is not seen")]
    database.close()
