# SPDX-License-Identifier: Apache-2.0
"""MCAP files (mcap.dev/spec) from their beginning to their end: no summary is needed, so that one which was cut off can be read, too."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO
from zlib import crc32

from haros_ci.recordings.jsonl import opened, share_of
from haros_ci.recordings.packed import LARGEST, Unpacking, unpacked
from haros_ci.recordings.recording import LATEST, LONGEST_NAME, MOST_CHANNELS, Channel, Cut, Definitions, in_order

_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _END_OF_DATA = 3, 4, 5, 6, 15
_U16, _U32 = struct.Struct("<H"), struct.Struct("<I")
_HEAD = struct.Struct("<BQ")
_OF_MESSAGE = struct.Struct("<HIQQ")
#: Where the name of a chunk's compression stands, and the largest piece that is passed over at once.
_OF_CHUNK = 28
_PIECE = 1 << 20


class McapFile:
    """An ``.mcap`` file."""

    def __init__(self, path: Path, *, is_packed: bool = False) -> None:
        self.path = path
        self.file: BinaryIO | None = None
        self.definitions = Definitions()
        self.is_packed = is_packed
        self.schemas: dict[int, tuple[str, str, str | None]] = {}
        self.channels: dict[int, Channel] = {}

    def share(self) -> float | None:
        return share_of(self.file)

    def raw(self, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        try:
            with Unpacking(self.path) if self.is_packed else opened(self.path) as file:
                self.file = file.packed if isinstance(file, Unpacking) else file
                file.read(8)
                yield from self.records(file, channels)
        except (OSError, EOFError) as err:
            raise Cut(str(err)) from None

    def records(
        self, file: BinaryIO | Unpacking, channels: dict[str, set[str]]
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of the data section."""
        while True:
            head = file.read(_HEAD.size)
            if len(head) != _HEAD.size:
                raise Cut("it ends early")
            kind, size = _HEAD.unpack(head)
            if kind == _END_OF_DATA:
                return
            if kind not in (_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK):
                _pass_over(file, size)
                continue
            if size > LARGEST:
                raise Cut(f"a record of {size} bytes is too large")
            content = file.read(size)
            is_whole = len(content) == size
            if kind == _CHUNK:
                yield from in_order(self.chunk(content, channels, is_whole=is_whole), is_whole)
            elif is_whole:
                yield from self.record(kind, content, channels)
            if not is_whole:
                raise Cut("it ends early")

    def chunk(
        self, content: bytes, channels: dict[str, set[str]], *, is_whole: bool = True
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of a chunk as they stand there; of one that is not whole those that are there."""
        form, at = _text(content, _OF_CHUNK)
        if len(content) < at + 8 or (form and not is_whole):
            raise Cut("a chunk ends early")
        inner = unpacked(content[at + 8 :], form)
        sum_ = _U32.unpack_from(content, _OF_CHUNK - 4)[0]
        if is_whole and sum_ and crc32(inner) != sum_:
            raise Cut("a chunk is damaged")
        at = 0
        while at < len(inner):
            if at + _HEAD.size > len(inner):
                raise Cut("a chunk ends early")
            kind, size = _HEAD.unpack_from(inner, at)
            at += _HEAD.size
            if at + size > len(inner):
                raise Cut("a chunk ends early")
            yield from self.record(kind, inner[at : at + size], channels)
            at += size

    def record(self, kind: int, content: bytes, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        """What a record holds: a message, or the channel or the type of others."""
        try:
            if kind == _MESSAGE:
                key, _, time, _ = _OF_MESSAGE.unpack_from(content)
                if key not in self.channels or time > LATEST:
                    raise Cut("a message has no channel, or no time")
                yield self.channels[key], time, content[_OF_MESSAGE.size :]
            elif kind == _SCHEMA:
                self.schema(content)
            elif kind == _CHANNEL:
                self.channel(content, channels)
        except struct.error:
            raise Cut("a record is damaged") from None

    def schema(self, content: bytes) -> None:
        """Take the definition of a type."""
        name, at = _text(content, 2)
        encoding, at = _text(content, at)
        definition, _ = _text(content, at)
        if len(self.schemas) >= MOST_CHANNELS:
            raise Cut("it has too many types")
        if max(len(name), len(encoding)) > LONGEST_NAME:
            raise Cut(f"a type has a name of more than {LONGEST_NAME:,} characters")
        kept = self.definitions.kept(definition)
        self.schemas[_U16.unpack_from(content)[0]] = name, encoding, kept if encoding else None

    def channel(self, content: bytes, channels: dict[str, set[str]]) -> None:
        """Take a topic."""
        key, schema = _U16.unpack_from(content)[0], _U16.unpack_from(content, 2)[0]
        if key in self.channels:
            return
        topic, at = _text(content, 4)
        written, at = _text(content, at)
        name, encoding, definition = self.schemas.get(schema, ("", "", None))
        known = encoding if encoding not in ("ros2msg", "ros1msg", "") else written
        self.channels[key] = channel = Channel(topic, name, definition, known, profiles=_profiles(content, at))
        channels.setdefault(channel.topic, set()).add(name)


def _profiles(content: bytes, at: int) -> str:
    """What the map at a place has of the quality of service (rosbag2_storage_mcap: ``offered_qos_profiles``); "" if it has nothing."""
    end = min(at + 4 + (_U32.unpack_from(content, at)[0] if len(content) >= at + 4 else 0), len(content))
    at += 4
    while at < end:
        key, at = _text(content, at)
        value, at = _text(content, at)
        if key == "offered_qos_profiles":
            return value
    return ""


def _text(content: bytes, at: int) -> tuple[str, int]:
    """The text at a place, and where it ends."""
    end = at + 4 + (_U32.unpack_from(content, at)[0] if len(content) >= at + 4 else 0)
    if end > len(content):
        raise Cut("a record is damaged")
    return content[at + 4 : end].decode("utf-8", "replace"), end


def _pass_over(file: BinaryIO | Unpacking, size: int) -> None:
    while size > 0:
        read = len(file.read(min(size, _PIECE)))
        if not read:
            raise Cut("it ends early")
        size -= read
