# SPDX-License-Identifier: Apache-2.0
"""The model as an SQLite database: rows as written, whole, and safe from any name."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from interface_samples import LANE, SYSTEM
from interface_samples import RATE as DECLARED
from test_model_json import BASE, HOSTILE, ODOM, PUBLISH_TF, RATE, ROBOT, SAMPLE, VAGUE

from haros_ci.model.architecture import Architecture
from haros_ci.report import model_sqlite


def rows(architecture: Architecture, path: Path, query: str) -> list[tuple[Any, ...]]:
    path.write_bytes(model_sqlite.render(architecture))
    database = sqlite3.connect(path)
    try:
        assert database.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        assert database.execute("PRAGMA foreign_key_check").fetchall() == []
        return database.execute(query).fetchall()
    finally:
        database.close()


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("SELECT name, user_data FROM configurations", [("robot", '{"plugin": [1, {"a": null}]}')]),
        ("SELECT configuration, position, path FROM launch_files", [(1, 0, "base/launch/base.launch")]),
        ("SELECT name, value FROM launch_arguments", [("quiet", "false")]),
        (
            "SELECT id, configuration, name, kind, package, type, class, container, args, source FROM nodes LIMIT 1",
            [
                (
                    1,
                    1,
                    "/base",
                    "nodelet",
                    "base",
                    "BaseNodelet",
                    "base::BaseNodelet",
                    "/manager",
                    "load base/BaseNodelet manager",
                    "launch",
                )
            ],
        ),
        ("SELECT node, original, target FROM remaps", [(1, "/base/odom", "/odom")]),
        (
            "SELECT e.kind, e.name, e.type, queue_size, latched, value, l.file, l.line FROM endpoints e"
            " LEFT JOIN locations l ON l.id = e.location WHERE node = 1 ORDER BY e.id",
            [
                ("publishers", "/odom", "nav_msgs/Odometry", 50, 0, None, "src/odometry.cpp", 76),
                ("subscribers", "/base/?", None, None, None, None, "src/odometry.cpp", 80),
                ("getters", "/base/rate", "double", None, None, "16.5", "src/odometry.cpp", 90),
            ],
        ),
        ("SELECT name, implicit, source FROM endpoints WHERE implicit", [("/rosout", 1, "known-node")]),
        (
            "SELECT node, endpoint, parameter, position, statement, condition FROM conditions ORDER BY id",
            [(None, 1, None, 0, "if", "x == 0"), (2, None, None, 0, "unless", "$(arg quiet)")],
        ),
        (
            "SELECT endpoint, field, reason FROM unknowns WHERE endpoint = 2 ORDER BY field",
            [
                (2, "name", "the argument 'topic' is not constant"),
                (2, "queue_size", "read from a file"),
                (2, "type", "the callback has no declared type"),
            ],
        ),
        (
            "SELECT p.name, type, value, l.line, o.file, source FROM parameters p"
            " JOIN locations l ON l.id = p.location JOIN locations o ON o.id = p.origin",
            [("/base/publish_tf", "bool", "true", 10, "param/base.yaml", "launch")],
        ),
        ("SELECT name, path, ros FROM packages WHERE name = 'base'", [("base", "src/kobuki/base", 1)]),
        ("SELECT path, line FROM problems", [("src/x.launch", 3)]),
        ('SELECT count(*) - count(DISTINCT path || line || "column") FROM locations', [(0,)]),
    ],
)
def test_rows(tmp_path: Path, query: str, expected: list[tuple[Any, ...]]) -> None:
    assert rows(SAMPLE, tmp_path / "m.sqlite", query) == expected


def test_ros_2(tmp_path: Path) -> None:
    path = tmp_path / "m.sqlite"
    assert rows(SYSTEM, path, "SELECT name, ros FROM nodes ORDER BY name") == [
        ("/base", 1),
        ("/planning/lane", 2),
        ("/rviz", 2),
    ]
    of = "FROM qos JOIN endpoints ON id = endpoint WHERE name IN ('/planning/path', '/vehicle/status') ORDER BY depth"
    assert rows(SYSTEM, path, f"SELECT history, depth, reliability, durability, deadline, lease {of}") == [
        ("keep_last", 1, "reliable", "transient_local", 0.5, None),
        (None, "?", "?", None, None, None),
    ]
    limited = replace(DECLARED, range=(1.0, 30.0, None))
    found = Architecture(configurations=(replace(ROBOT, nodes=(replace(LANE, endpoints=(limited,)),)),))
    query = "SELECT kind, name, value, effective, read_only, minimum, maximum, step FROM endpoints"
    assert rows(found, path, query) == [("parameters", "/planning/lane:rate", "10.0", "20.0", 1, 1.0, 30.0, None)]


def test_the_bytes_are_the_same_for_any_order_and_way() -> None:
    turned = replace(SAMPLE, configurations=(replace(ROBOT, nodes=ROBOT.nodes[::-1]),))
    assert model_sqlite.render(turned) == model_sqlite.render(SAMPLE)
    assert model_sqlite.render(SAMPLE)[:15] == b"SQLite format 3"


def test_without_serialize_the_bytes_come_through_a_file(tmp_path: Path) -> None:
    database = model_sqlite._filled(SAMPLE)
    path = tmp_path / "m.sqlite"
    path.write_bytes(model_sqlite._through_a_file(database))
    database.close()
    again = sqlite3.connect(path)
    assert again.execute("SELECT count(*) FROM endpoints").fetchone() == (8,)
    again.close()


@pytest.mark.parametrize("name", ["'; DROP TABLE nodes; --", "a\x00b", '"', "\n::error::", "\u202e", "é"])
def test_hostile_names_are_data(tmp_path: Path, name: str) -> None:
    node = replace(BASE, name=name, endpoints=(replace(ODOM, name=name),))
    architecture = Architecture(configurations=(replace(ROBOT, name=name, nodes=(node,)),))
    query = "SELECT c.name, n.name, e.name FROM configurations c, nodes n, endpoints e"
    assert rows(architecture, tmp_path / "m.sqlite", query) == [(name, name, name)]


def test_what_sqlite_cannot_hold(tmp_path: Path) -> None:
    ends = (replace(ODOM, name=HOSTILE, queue_size=2**80), replace(RATE, value=2**80), replace(VAGUE, latched=None))
    architecture = Architecture(
        configurations=(replace(ROBOT, nodes=(replace(BASE, endpoints=ends),), parameters=(PUBLISH_TF,)),)
    )
    found = rows(architecture, tmp_path / "m.sqlite", "SELECT name, queue_size, value FROM endpoints ORDER BY id")
    assert found[0] == (HOSTILE.replace("\ud800", "?"), None, None)
    assert found[2] == ("/base/rate", None, str(2**80))


def test_a_file_that_is_there_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "m.sqlite"
    path.write_text("x" * 1_000_000)
    assert rows(Architecture(), path, "SELECT count(*) FROM nodes") == [(0,)]
