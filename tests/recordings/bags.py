# SPDX-License-Identifier: Apache-2.0
"""Small bags, written with rosbags; the tests that need them are skipped where it is not installed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

MS, SECOND = 1_000_000, 1_000_000_000
BEGIN = 1_000 * SECOND
LEVEL = "uint8 LOW=3\nuint8 data\nfloat32[] values\n"

#: Topic, value of ``data`` and time in milliseconds after the begin.
Row = tuple[str, int, int]


def demanded() -> None:
    """Skip where rosbags is missing."""
    pytest.importorskip("rosbags.rosbag1", reason="rosbags, of the extra [bags], is not installed")


def _store(ros: int, definition: str) -> Any:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if ros == 1 else Stores.LATEST)
    store.register(get_types_from_msg(definition, "demo/msg/Level"))
    return store


def _message(store: Any, value: int) -> Any:
    import numpy

    return store.types["demo/msg/Level"](data=value, values=numpy.array([value, 0.5], dtype=numpy.float32))


def ros1(path: Path, rows: list[Row], compression: str = "") -> Path:
    """A bag of ROS 1 with messages of demo/Level."""
    demanded()
    from rosbags.rosbag1 import Writer

    store = _store(1, LEVEL)
    writer = Writer(path)
    if compression:
        writer.set_compression(Writer.CompressionFormat[compression.upper()])
    with writer:
        made = {
            topic: writer.add_connection(topic, "demo/msg/Level", typestore=store)
            for topic in dict.fromkeys(row[0] for row in rows)
        }
        for topic, value, time in rows:
            raw = store.serialize_ros1(_message(store, value), "demo/msg/Level")
            writer.write(made[topic], BEGIN + time * MS, raw)
    return path


def ros2(path: Path, rows: list[Row], storage: str = "sqlite3", compression: str = "") -> Path:
    """A directory of a bag of ROS 2 with messages of demo/msg/Level; *compression* is none, file, message or storage (MCAP)."""
    demanded()
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    store = _store(2, LEVEL)
    writer = Writer(path, version=9, storage_plugin=StoragePlugin[storage.upper()])
    if compression:
        writer.set_compression(CompressionMode[compression.upper()], CompressionFormat.ZSTD)
    with writer:
        made = {
            topic: writer.add_connection(topic, "demo/msg/Level", typestore=store)
            for topic in dict.fromkeys(row[0] for row in rows)
        }
        for topic, value, time in rows:
            raw = store.serialize_cdr(_message(store, value), "demo/msg/Level")
            writer.write(made[topic], BEGIN + time * MS, raw)
    return path
