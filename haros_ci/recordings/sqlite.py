# SPDX-License-Identifier: Apache-2.0
"""SQLite files of ROS 2 (rosbag2_storage_sqlite3), opened for reading alone; tables only, nothing that the file defines is evaluated.

Of a file that ends early, which SQLite does not open, the messages are those of the pages that are there (``sqlite_pages``).
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from urllib.parse import quote

from haros_ci.recordings.jsonl import opened
from haros_ci.recordings.packed import LARGEST, LARGEST_FILE, unpack_file
from haros_ci.recordings.recording import LATEST, MOST_CHANNELS, Channel, Cut, Definitions
from haros_ci.recordings.sqlite_pages import Pages, ends_early
from haros_ci.scratch import scratch_directory


class SqliteFile:
    """A ``.db3`` file, packed as a whole or message by message, or not at all."""

    def __init__(self, path: Path, *, is_packed: bool = False) -> None:
        self.path = path
        self.is_packed = is_packed
        #: The messages that were read, and how many there may be; pages, where SQLite does not open the file.
        self.read = self.most = 0

    def share(self) -> float | None:
        return min(self.read / self.most, 1.0) if self.most > 0 else None

    def raw(self, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        with ExitStack() as stack:
            path = self.path
            damage: Cut | None = None
            if self.is_packed:
                path = stack.enter_context(scratch_directory()) / "bag.db3"
                with path.open("wb") as file:
                    damage = unpack_file(self.path, file, LARGEST_FILE)
            if ends_early(path):
                yield from self.rest(path, channels)
            else:
                yield from self.whole(path, channels)
        if damage is not None:
            raise damage
        if (log := self.path.with_name(f"{self.path.name}-wal")).is_file() and log.lstat().st_size:
            raise Cut(f"what follows is in {log.name}, which is not read")

    def whole(self, path: Path, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of a file that SQLite opens; of one that is damaged, and of which it reads no message, those of its pages."""
        count = 0
        try:
            address = f"file:{quote(str(path.absolute()))}?mode=ro&immutable=1"
            with closing(sqlite3.connect(address, uri=True)) as database:
                for message in self.rows(database, channels):
                    count += 1
                    yield message
        except (sqlite3.Error, OverflowError, UnicodeDecodeError) as err:
            damage = Cut(f"the database is damaged: {err}")
        else:
            return
        if not count:
            yield from self.rest(path, channels, damage)
        raise damage

    def rest(
        self, path: Path, channels: dict[str, set[str]], damage: Cut | None = None
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of the pages that are there, in their order, up to one that is missing; Cut then, with *damage* or that the file ends early."""
        with opened(path) as file:
            try:
                pages = Pages(file)
                self.most = pages.count
                known = topics_of(pages, channels)
            except Cut as cut:
                raise damage or cut from None
            before: int | None = None
            for number, row in pages.others():
                channel = known.get(row[1]) if len(row) == 4 and isinstance(row[1], int) else None
                if channel is None or not (isinstance(row[2], int) and isinstance(row[3], bytes)):
                    continue
                if (
                    before is not None and number != before + 1
                ):  # rosbag2 numbers them one by one, in the order of the file
                    break
                before, self.read = number, pages.at
                if 0 <= row[2] < LATEST:
                    yield channel, row[2], row[3]
        raise damage or Cut(f"it ends early, after {pages.count:,} of {pages.promised:,} pages of the database")

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
        self.most = _last(database)
        for key, time, content in database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp"):
            if (
                key not in known
                or not isinstance(time, int)
                or not 0 <= time < LATEST
                or not isinstance(content, bytes)
            ):
                raise Cut("a message has no topic, or no time")
            self.read += 1
            yield known[key], time, content

    def definitions(self, database: sqlite3.Connection) -> Iterator[tuple[str, str]]:
        """The definitions of types that the file has."""
        query = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions LIMIT ?"
        texts = Definitions()
        for type, encoding, text in database.execute(query, (MOST_CHANNELS,)):
            if encoding == "ros2msg":
                yield str(type), texts.kept(str(text))


def _last(database: sqlite3.Connection) -> int:
    """The number of the last message, which is how many there are; 0 if that is not known."""
    try:
        ((last,),) = database.execute("SELECT MAX(rowid) FROM messages").fetchall()
    except sqlite3.Error:
        return 0
    return last if isinstance(last, int) else 0


def topics_of(pages: Pages, channels: dict[str, set[str]]) -> dict[int, Channel]:
    """The topics by their numbers: columns are in the order in which rosbag2 makes them. Cut without a table of topics."""
    tables = {name: page for name, (page, sql) in pages.tables().items() if _is_plain(sql)}
    if not {"topics", "messages"} <= tables.keys():
        raise Cut("it has no tables of topics and messages")
    texts = Definitions()
    definitions: dict[str, str] = {}
    for _, row in pages.rows(tables["message_definitions"]) if "message_definitions" in tables else ():
        if len(row) >= 4 and row[2] == "ros2msg" and len(definitions) < MOST_CHANNELS:
            definitions[str(row[1])] = texts.kept(str(row[3]))
    known: dict[int, Channel] = {}
    for key, row in pages.rows(tables["topics"]):
        if len(row) < 4:
            raise Cut("its table of topics is damaged")
        if len(known) >= MOST_CHANNELS:
            raise Cut("it has too many topics")
        topic, type, form, profiles = (*map(str, row[1:5]), "")[:4]
        known[key] = channel = Channel(topic, type, definitions.get(type), form, profiles=profiles)
        channels.setdefault(channel.topic, set()).add(type)
    return known


def _is_plain(sql: object) -> bool:
    """Whether a table is one, with nothing that is calculated."""
    text = str(sql).upper()
    return text.startswith("CREATE TABLE") and "GENERATED" not in text and " AS" not in text
