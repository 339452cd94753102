# SPDX-License-Identifier: Apache-2.0
"""The architecture as an SQLite database, for queries by anyone; the tables are described at ``TABLES``."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable
from dataclasses import astuple
from pathlib import Path
from typing import Any

from haros_ci.model.architecture import Architecture, Condition, Configuration, Node, Unknown
from haros_ci.model.location import Location
from haros_ci.model.rates import Rate, Rates
from haros_ci.report.channels import endpoints_of, nodes_of, parameters_of
from haros_ci.report.model_json import Places, plain
from haros_ci.scratch import scratch_directory

#: The tables. A *value* or *effective* is JSON text, null if there is none or it is unknown; booleans are 0 and 1. A
#: policy of *qos* is null where it is the default, and ``?`` where it is unknown. A condition or an unknown belongs to
#: one node, endpoint or parameter: the other two columns are null. Positions count from 0, conditions outermost first.
#: With --rates ``rates`` has how often nodes publish, in hertz, and ``topic_rates`` the sums; *high* is null where there is no bound.
#: What ``CHANNELS`` connects is found by grouping endpoints that are not *ruled_out* by configuration and name.
TABLES = """
CREATE TABLE packages (id INTEGER PRIMARY KEY, name TEXT NOT NULL, path TEXT NOT NULL, version TEXT NOT NULL,
  format INTEGER NOT NULL, build_type TEXT NOT NULL, ros INTEGER, is_metapackage INTEGER NOT NULL);
CREATE TABLE locations (id INTEGER PRIMARY KEY, package TEXT, file TEXT NOT NULL, path TEXT NOT NULL, line INTEGER,
  "column" INTEGER);
CREATE TABLE configurations (id INTEGER PRIMARY KEY, name TEXT NOT NULL, user_data TEXT);
CREATE TABLE launch_files (configuration INTEGER NOT NULL REFERENCES configurations, position INTEGER NOT NULL,
  path TEXT NOT NULL, PRIMARY KEY (configuration, position));
CREATE TABLE launch_arguments (configuration INTEGER NOT NULL REFERENCES configurations, position INTEGER NOT NULL,
  name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (configuration, position));
CREATE TABLE nodes (id INTEGER PRIMARY KEY, configuration INTEGER NOT NULL REFERENCES configurations,
  name TEXT NOT NULL, kind TEXT NOT NULL, package TEXT NOT NULL, type TEXT NOT NULL, class TEXT, container TEXT,
  process TEXT, args TEXT NOT NULL, location INTEGER REFERENCES locations, source TEXT NOT NULL, ros INTEGER NOT NULL);
CREATE TABLE remaps (node INTEGER NOT NULL REFERENCES nodes, position INTEGER NOT NULL, original TEXT NOT NULL,
  target TEXT NOT NULL, PRIMARY KEY (node, position));
CREATE TABLE endpoints (id INTEGER PRIMARY KEY, node INTEGER NOT NULL REFERENCES nodes, kind TEXT NOT NULL,
  name TEXT NOT NULL, original_name TEXT NOT NULL, type TEXT, queue_size INTEGER, latched INTEGER, value TEXT,
  implicit INTEGER NOT NULL, location INTEGER REFERENCES locations, source TEXT NOT NULL, effective TEXT,
  read_only INTEGER, minimum REAL, maximum REAL, step REAL, ruled_out INTEGER NOT NULL);
CREATE TABLE qos (endpoint INTEGER PRIMARY KEY REFERENCES endpoints, history TEXT, depth, reliability TEXT,
  durability TEXT, deadline, lifespan, liveliness TEXT, lease);
CREATE TABLE parameters (id INTEGER PRIMARY KEY, configuration INTEGER NOT NULL REFERENCES configurations,
  name TEXT NOT NULL, type TEXT, value TEXT, location INTEGER REFERENCES locations,
  origin INTEGER REFERENCES locations, source TEXT NOT NULL);
CREATE TABLE conditions (id INTEGER PRIMARY KEY, node INTEGER REFERENCES nodes, endpoint INTEGER REFERENCES endpoints,
  parameter INTEGER REFERENCES parameters, position INTEGER NOT NULL, statement TEXT NOT NULL,
  condition TEXT NOT NULL, location INTEGER NOT NULL REFERENCES locations);
CREATE TABLE unknowns (id INTEGER PRIMARY KEY, node INTEGER REFERENCES nodes, endpoint INTEGER REFERENCES endpoints,
  parameter INTEGER REFERENCES parameters, field TEXT NOT NULL, reason TEXT NOT NULL,
  location INTEGER REFERENCES locations);
CREATE TABLE rates (id INTEGER PRIMARY KEY, configuration INTEGER NOT NULL REFERENCES configurations,
  node TEXT NOT NULL, topic TEXT NOT NULL, low REAL NOT NULL, high REAL, reason TEXT NOT NULL,
  location INTEGER REFERENCES locations);
CREATE TABLE topic_rates (configuration INTEGER NOT NULL REFERENCES configurations, topic TEXT NOT NULL,
  low REAL NOT NULL, high REAL, reason TEXT NOT NULL, PRIMARY KEY (configuration, topic));
CREATE TABLE problems (id INTEGER PRIMARY KEY, path TEXT NOT NULL, line INTEGER, message TEXT NOT NULL);
"""
_LARGEST = 2**63


def render(architecture: Architecture) -> bytes:
    """The database file; the same bytes for the same architecture from one release of SQLite."""
    database = _filled(architecture)
    try:
        if hasattr(database, "serialize"):  # Python 3.11
            return bytes(database.serialize())
        return _through_a_file(database)
    finally:
        database.close()


def _through_a_file(database: sqlite3.Connection) -> bytes:
    with scratch_directory() as folder:
        file = Path(folder, "model.sqlite")
        copy = sqlite3.connect(file)
        try:
            database.backup(copy)
        finally:
            copy.close()
        return file.read_bytes()


def _filled(architecture: Architecture) -> sqlite3.Connection:
    database = sqlite3.connect(":memory:")
    database.executescript(TABLES)
    table = _Tables(database, Places(architecture.packages))
    for package in sorted(architecture.packages, key=lambda item: (item.name, item.path)):
        about = (package.name, package.path, package.version, package.format, package.build_type, package.ros)
        table.add("packages", None, *about, package.is_metapackage)
    for configuration in sorted(architecture.configurations, key=lambda item: item.name):
        _configuration(table, configuration)
    for problem in sorted(architecture.problems, key=lambda item: (item.path, item.line or 0, item.message)):
        table.add("problems", None, problem.path, problem.line, problem.message)
    database.commit()
    return database


def _configuration(table: _Tables, configuration: Configuration) -> None:
    key = table.add("configurations", None, configuration.name, _value(configuration.user_data))
    for position, path in enumerate(configuration.launch):
        table.add("launch_files", key, position, path)
    for position, (name, value) in enumerate(configuration.arguments):
        table.add("launch_arguments", key, position, name, str(plain(value)))
    for node in nodes_of(configuration):
        _node(table, key, node)
    for item in parameters_of(configuration):
        places = table.place(item.location), table.place(item.origin)
        added = table.add("parameters", None, key, item.name, item.type, _value(item.value), *places, item.source)
        table.about((None, None, added), item.conditions, item.unknowns)
    if configuration.rates is not None:
        _rates(table, key, configuration.rates)


def _rates(table: _Tables, configuration: int, rates: Rates) -> None:
    for one in rates.published:
        named = (one.node, one.topic, *_hertz(one.rate))
        table.add("rates", None, configuration, *named, table.place(one.location))
    for topic, rate in rates.topics:
        table.add("topic_rates", configuration, topic, *_hertz(rate))


def _hertz(rate: Rate) -> tuple[float, float | None, str]:
    return rate.low, rate.high if rate.is_known else None, rate.reason


def _node(table: _Tables, configuration: int, node: Node) -> None:
    process = (node.class_name, node.container, node.process, node.arguments)
    kind = (node.name, node.kind, node.package, node.type)
    key = table.add("nodes", None, configuration, *kind, *process, table.place(node.location), node.source, node.ros)
    for position, (original, target) in enumerate(node.remaps):
        table.add("remaps", key, position, original, target)
    table.about((key, None, None), node.conditions, node.unknowns)
    for end in endpoints_of(node):
        about = (end.kind, end.name, end.original_name, end.type, end.queue_size, end.latched, _value(end.value))
        declared = (_value(end.effective), end.read_only, *(end.range or (None, None, None)), end.is_ruled_out)
        added = table.add(
            "endpoints", None, key, *about, end.implicit, table.place(end.location), end.source, *declared
        )
        if end.qos is not None:
            table.add("qos", added, *astuple(end.qos))
        table.about((None, added, None), end.conditions, end.unknowns)


class _Tables:
    """Rows on their way into the database; each location stands there once."""

    __slots__ = ("_database", "_known", "_places")

    def __init__(self, database: sqlite3.Connection, places: Places) -> None:
        self._database = database
        self._places = places
        self._known: dict[tuple[str, int | None, int | None], int] = {}

    def add(self, table: str, *row: Any) -> int:
        marks = ", ".join("?" * len(row))
        done = self._database.execute(f"INSERT INTO {table} VALUES ({marks})", tuple(map(_cell, row)))
        return done.lastrowid or 0

    def place(self, location: Location | None) -> int | None:
        if location is None:
            return None
        key = (location.path, location.line, location.column)
        if key not in self._known:
            self._known[key] = self.add("locations", None, *self._places.split(location.path), *key)
        return self._known[key]

    def about(
        self,
        owner: tuple[int | None, int | None, int | None],
        conditions: Iterable[Condition],
        unknowns: Iterable[Unknown],
    ) -> None:
        for position, item in enumerate(conditions):
            self.add("conditions", None, *owner, position, item.statement, item.condition, self.place(item.location))
        for why in unknowns:
            self.add("unknowns", None, *owner, why.field, why.reason, self.place(why.location))


def _value(value: object) -> str | None:
    return None if value is None else json.dumps(plain(value), ensure_ascii=True, allow_nan=False)


def _cell(value: Any) -> Any:
    """*value* as SQLite holds it: lone surrogates become question marks, integers past 64 bits null."""
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode("utf-8")
    return None if isinstance(value, int) and not -_LARGEST <= value < _LARGEST else value
