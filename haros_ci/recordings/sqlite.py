# SPDX-License-Identifier: Apache-2.0
"""SQLite files of ROS 2 (rosbag2_storage_sqlite3), opened for reading alone; tables only, nothing that the file defines is evaluated."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from typing import BinaryIO
from urllib.parse import quote

from haros_ci.recordings.packed import LARGEST, LARGEST_FILE, unpack_file
from haros_ci.recordings.recording import LATEST, MOST_CHANNELS, Channel, Cut, Definitions
from haros_ci.scratch import scratch_directory


class SqliteFile:
    """A ``.db3`` file, packed as a whole or message by message, or not at all."""

    def __init__(self, path: Path, *, is_packed: bool = False) -> None:
        self.path = path
        self.file: BinaryIO | None = None
        self.is_packed = is_packed

    def raw(self, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        with ExitStack() as stack:
            path = self.path
            if self.is_packed:
                path = stack.enter_context(scratch_directory()) / "bag.db3"
                with path.open("wb") as file:
                    unpack_file(self.path, file, LARGEST_FILE)
            try:
                address = f"file:{quote(str(path.absolute()))}?mode=ro&immutable=1"
                database = stack.enter_context(closing(sqlite3.connect(address, uri=True)))
                yield from self.rows(database, channels)
            except (sqlite3.Error, OverflowError, UnicodeDecodeError) as err:
                raise Cut(f"the database is damaged: {err}") from None

    def rows(self, database: sqlite3.Connection, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages, in order of time."""
        database.execute("PRAGMA trusted_schema = OFF")
        database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST) if hasattr(database, "setlimit") else None
        tables = {
            name: str(sql)
            for name, sql in database.execute("SELECT name, sql FROM sqlite_master WHERE type = 'table'")
            if _is_plain(sql)
        }
        if not {"topics", "messages"} <= tables.keys():
            raise Cut("it has no tables of topics and messages")
        definitions = dict(self.definitions(database)) if "message_definitions" in tables else {}
        known: dict[int, Channel] = {}
        profiles = "offered_qos_profiles" if "offered_qos_profiles" in tables["topics"] else "''"
        query = f"SELECT id, name, type, serialization_format, {profiles} FROM topics"
        for key, topic, type, form, offered in database.execute(query):
            if len(known) >= MOST_CHANNELS:
                raise Cut("it has too many topics")
            definition = definitions.get(str(type))
            known[key] = channel = Channel(str(topic), str(type), definition, str(form), profiles=str(offered))
            channels.setdefault(channel.topic, set()).add(str(type))
        for key, time, content in database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp"):
            if (
                key not in known
                or not isinstance(time, int)
                or not 0 <= time < LATEST
                or not isinstance(content, bytes)
            ):
                raise Cut("a message has no topic, or no time")
            yield known[key], time, content

    def definitions(self, database: sqlite3.Connection) -> Iterator[tuple[str, str]]:
        """The definitions of types that the file has."""
        query = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions LIMIT ?"
        texts = Definitions()
        for type, encoding, text in database.execute(query, (MOST_CHANNELS,)):
            if encoding == "ros2msg":
                yield str(type), texts.kept(str(text))


def _is_plain(sql: object) -> bool:
    """Whether a table is one, with nothing that is calculated."""
    text = str(sql).upper()
    return text.startswith("CREATE TABLE") and "GENERATED" not in text and " AS" not in text
