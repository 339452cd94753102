# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 1, version 2.0 (wiki.ros.org/Bags/Format/2.0), chunk by chunk: no index is needed, so that one which was cut off can be read, too."""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from haros_ci.errors import UserError
from haros_ci.recordings.jsonl import opened, share_of
from haros_ci.recordings.offered import Offer
from haros_ci.recordings.packed import LARGEST, unpacked
from haros_ci.recordings.recording import LONGEST_NAME, MOST_CHANNELS, Channel, Cut, Definitions, full_name, in_order

_MESSAGE, _BAG, _CHUNK, _CONNECTION = 2, 3, 5, 7
LARGEST_HEADER = 1 << 20
_U32 = struct.Struct("<I")
_TIME = struct.Struct("<II")
_VERSION = b"#ROSBAG V2.0\n"
_OF_CONNECTION = (b"type", b"message_definition")


class Ros1File:
    """A ``.bag`` file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.file: BinaryIO | None = None
        self.definitions = Definitions()
        self.channels: dict[int, Channel] = {}
        #: Where the index stands, behind all messages; 0 in a bag that was not closed, None if nothing says so.
        self.index: int | None = None

    def share(self) -> float | None:
        return share_of(self.file)

    def raw(self, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        with opened(self.path) as file:
            self.file = file
            if file.readline(32) != _VERSION:
                raise UserError(
                    f"{self.path}: is no bag of version 2.0",
                    help="rosbag fix or rosbag reindex makes one of older bags",
                )
            while (head := file.read(4)) != b"":
                header = _fields(_exactly(file, _size(head, LARGEST_HEADER)))
                size = _size(file.read(4), LARGEST)
                kind = header.get(b"op", b"\x00")[0]
                if kind == _CHUNK:
                    content = file.read(size)
                    is_whole = len(content) == size
                    form = header.get(b"compression", b"none").decode("latin-1")
                    inner = unpacked(content, form) if is_whole or form == "none" else b""
                    yield from in_order(self.chunk(inner, channels), is_whole)
                elif kind in (_MESSAGE, _CONNECTION):
                    yield from self.record(kind, header, _exactly(file, size), channels)
                else:
                    if kind == _BAG:
                        self.index = int.from_bytes(header.get(b"index_pos", b"")[:8], "little")
                    _pass_over(file, size)
            if self.index == 0:
                raise Cut("it was not closed")
            if self.index is not None and self.index > file.tell():
                raise Cut("it ends early")

    def chunk(self, content: bytes, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of a chunk as they stand there."""
        at, end = 0, len(content)
        while at < end:
            size = _size(content[at : at + 4], end)
            header = _fields(content[at + 4 : at + 4 + size])
            at += 4 + size
            size = _size(content[at : at + 4], end)
            at += 4
            if at + size > end:
                raise Cut("a chunk ends early")
            yield from self.record(header.get(b"op", b"\x00")[0], header, content[at : at + size], channels)
            at += size

    def record(
        self, kind: int, header: dict[bytes, bytes], content: bytes, channels: dict[str, set[str]]
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """What a record holds: a message, or the channel of others."""
        key = int.from_bytes(header.get(b"conn", b"")[:4], "little")
        if kind == _CONNECTION and key not in self.channels:
            if len(self.channels) >= MOST_CHANNELS:
                raise Cut("it has too many connections")
            connection = _fields(content)
            name = header.get(b"topic", b"").decode("utf-8", "replace")
            kind_of, definition = (connection.get(part, b"").decode("utf-8", "replace") for part in _OF_CONNECTION)
            known = self.definitions.kept(definition) if _OF_CONNECTION[1] in connection else None
            channel = Channel(name, kind_of, known, "ros1", _publisher(connection))
            self.channels[key] = channel
            channels.setdefault(channel.topic, set()).add(channel.type)
        elif kind == _MESSAGE:
            time = header.get(b"time", b"")
            if key not in self.channels or len(time) != _TIME.size:
                raise Cut("a message has no connection, or no time")
            seconds, rest = _TIME.unpack(time)
            yield self.channels[key], seconds * 1_000_000_000 + rest, content


def _publisher(connection: dict[bytes, bytes]) -> Offer | None:
    """The publisher of a connection: ``callerid`` and ``latching`` of its header (wiki.ros.org/ROS/TCPROS)."""
    node = connection.get(b"callerid", b"").decode("utf-8", "replace")
    return Offer(full_name(node), connection.get(b"latching") == b"1") if 0 < len(node) <= LONGEST_NAME else None


def _size(content: bytes, limit: int) -> int:
    if len(content) != 4:
        raise Cut("it ends early")
    size: int = _U32.unpack(content)[0]
    if size > limit:
        raise Cut(f"a record of {size} bytes is too large")
    return size


def _pass_over(file: BinaryIO, size: int) -> None:
    file.seek(size, 1)
    if size and file.tell() > os.fstat(file.fileno()).st_size:
        raise Cut("it ends early")


def _exactly(file: BinaryIO, size: int) -> bytes:
    content = file.read(size)
    if len(content) != size:
        raise Cut("it ends early")
    return content


def _fields(content: bytes) -> dict[bytes, bytes]:
    found: dict[bytes, bytes] = {}
    at = 0
    while at < len(content):
        size = _size(content[at : at + 4], len(content))
        name, sign, value = content[at + 4 : at + 4 + size].partition(b"=")
        if not sign:
            raise Cut("a header is damaged")
        found[name] = value if name != b"op" or value else b"\x00"
        at += 4 + size
    return found
