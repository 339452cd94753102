# SPDX-License-Identifier: Apache-2.0
"""The pages of a SQLite file (sqlite.org/fileformat2.html) one by one, for files that end early: SQLite opens none whose last pages are missing.

Only tables are read, as far as their pages are there, within limits: a page is looked at once, and the rows have no more bytes than the file twice.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from haros_ci.recordings.recording import Cut

#: A row: its number, and its values: None, numbers, texts and bytes.
Row = tuple[int, list[object]]
_HEAD = 100
_INTERIOR, _LEAF = 0x05, 0x0D
_CODINGS = {1: "utf-8", 2: "utf-16-le", 3: "utf-16-be"}
_WIDTHS = (0, 1, 2, 3, 4, 6, 8)
_U16, _U32, _REAL = struct.Struct(">H"), struct.Struct(">I"), struct.Struct(">d")


def ends_early(path: Path) -> bool:
    """Whether a SQLite file is shorter than its head says."""
    with path.open("rb") as file:
        head = file.read(_HEAD)
        return len(head) < _HEAD or _promised(head) * _size(head) > os.fstat(file.fileno()).st_size


def _size(head: bytes) -> int:
    size = int(_U16.unpack_from(head, 16)[0])
    return 1 << 16 if size == 1 else size


def _promised(head: bytes) -> int:
    """The pages that a file has by its head; 0 if that does not say."""
    return int(_U32.unpack_from(head, 28)[0]) if head[24:28] == head[92:96] else 0


class Pages:
    """A SQLite file that may end early. Cut where it is none."""

    def __init__(self, file: BinaryIO) -> None:
        head = file.read(_HEAD)
        if len(head) < _HEAD:
            raise Cut("it ends early")
        self.file = file
        self.size = _size(head)
        self.usable = self.size - head[20]
        self.coding = _CODINGS.get(_U32.unpack_from(head, 56)[0], "")
        if self.size < 512 or self.size & (self.size - 1) or self.usable < 480 or not self.coding:
            raise Cut("its head is damaged")
        self.bytes = file.seek(0, os.SEEK_END)
        self.count = self.bytes // self.size
        self.promised = max(_promised(head), self.count)
        self.left = 2 * self.bytes
        self.seen: set[int] = set()
        #: The page that ``others`` is at.
        self.at = 0

    def tables(self) -> dict[str, tuple[int, str]]:
        """The first page of each table, and the text that made it."""
        found = {}
        for _, row in self.rows(1):
            if len(row) == 5 and row[0] == "table" and isinstance(row[3], int):
                found[str(row[1])] = row[3], str(row[4])
        return found

    def rows(self, root: int) -> Iterator[Row]:
        """The rows of a table, by its first page, in their order; Cut where a page of it is not there."""
        waiting = [root]
        while waiting:
            number = waiting.pop()
            page, start = self.page(number)
            if number in self.seen or len(page) <= start or page[start] not in (_INTERIOR, _LEAF):
                raise Cut("a table ends early")
            self.seen.add(number)
            if page[start] == _LEAF:
                yield from self.leaf(page, start)
            else:
                cells = (_U32.unpack_from(page, at)[0] for at in _cells(page, start, 12) if at + 4 <= len(page))
                waiting += reversed([*cells, _U32.unpack_from(page, start + 8)[0]])

    def others(self) -> Iterator[Row]:
        """The rows of all pages that no call has looked at so far, in the order of the file."""
        for number in range(1, self.count + 1):
            self.at = number
            if number not in self.seen:
                page, start = self.page(number)
                if len(page) > start and page[start] == _LEAF:
                    yield from self.leaf(page, start)

    def page(self, number: int) -> tuple[bytes, int]:
        """A page, and where its own content begins."""
        if not 0 < number <= self.count:
            return b"", 0
        self.file.seek((number - 1) * self.size)
        return self.file.read(self.size), _HEAD if number == 1 else 0

    def leaf(self, page: bytes, start: int) -> Iterator[Row]:
        """The rows of a page that are whole."""
        for at in _cells(page, start, 8):
            if (row := self.row(page, at)) is not None:
                yield row

    def row(self, page: bytes, at: int) -> Row | None:
        """The row at a place of a page; None if a part of it is missing, or it is none."""
        try:
            size, at = _number(page, at)
            number, at = _number(page, at)
            content = self.content(page, at, size)
            return None if content is None else (number, self.values(content))
        except (IndexError, struct.error, UnicodeDecodeError):
            return None

    def content(self, page: bytes, at: int, size: int) -> bytes | None:
        """The *size* bytes of a row that begins at a place of a page and may go on in pages of its own."""
        if size > self.bytes:
            return None
        self.left -= size
        if self.left < 0:
            raise Cut("its pages are damaged")
        here = self._here(size)
        found = bytearray(page[at : at + here])
        after = _U32.unpack_from(page, at + here)[0] if here < size else 0
        while len(found) < size:
            more, _ = self.page(after)
            if not more:
                return None
            after = _U32.unpack_from(more)[0]
            found += more[4 : min(self.usable, 4 + size - len(found))]
        return bytes(found) if len(found) == size else None

    def _here(self, size: int) -> int:
        """How much of a row of *size* bytes lies on its first page."""
        most = self.usable - 35
        if size <= most:
            return size
        least = (self.usable - 12) * 32 // 255 - 23
        fitting = least + (size - least) % (self.usable - 4)
        return fitting if fitting <= most else least

    def values(self, content: bytes) -> list[object]:
        """What a row holds."""
        end, at = _number(content, 0)
        kinds = []
        while at < end:
            kind, at = _number(content, at)
            kinds.append(kind)
        found: list[object] = []
        for kind in kinds:
            value, at = self.value(content, at, kind)
            found.append(value)
        return found

    def value(self, content: bytes, at: int, kind: int) -> tuple[object, int]:
        """The value of a *kind* at a place, and where it ends; IndexError if it does not lie in *content*."""
        size = _WIDTHS[kind] if kind < 7 else 8 if kind == 7 else 0 if kind < 12 else (kind - 12) // 2
        if at + size > len(content):
            raise IndexError
        raw = content[at : at + size]
        if kind >= 12:
            return raw.decode(self.coding) if kind % 2 else raw, at + size
        if kind in (0, 7):
            return _REAL.unpack(raw)[0] if kind else None, at + size
        return kind - 8 if kind > 7 else int.from_bytes(raw, "big", signed=True), at + size


def _cells(page: bytes, start: int, head: int) -> Iterator[int]:
    """Where the cells of a page are."""
    count = _U16.unpack_from(page, start + 3)[0] if len(page) >= start + 8 else 0
    for at in range(start + head, min(start + head + 2 * count, len(page) - 1), 2):
        yield int(_U16.unpack_from(page, at)[0])


def _number(content: bytes, at: int) -> tuple[int, int]:
    """The whole number of one to nine bytes at a place, and where it ends."""
    found = 0
    for count in range(9):
        byte = content[at + count]
        if count == 8:
            return (found << 8) | byte, at + 9
        found = (found << 7) | (byte & 0x7F)
        if byte < 0x80:
            return found, at + count + 1
    raise IndexError
