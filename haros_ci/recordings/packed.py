# SPDX-License-Identifier: Apache-2.0
"""Compressed data, unpacked up to a limit."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, BinaryIO

from haros_ci.recordings.jsonl import opened
from haros_ci.recordings.recording import Cut

#: Bytes of one chunk or message, unpacked.
LARGEST = 256 << 20
#: Bytes of one file, unpacked.
LARGEST_FILE = 64 << 30
_PIECE = 1 << 20


def unpacked(content: bytes, form: str, limit: int = LARGEST) -> bytes:
    """*content*, which is of the *form* none, bz2, lz4 or zstd; Cut if it is more than *limit* bytes, or damaged."""
    if form in ("", "none"):
        return content
    made = decompressor(form)
    try:
        found: bytes = made.decompress(content, limit + 1)
    except (OSError, EOFError, RuntimeError, ValueError, _zstd_error()) as err:
        raise Cut(f"{form} data is damaged: {err}") from None
    if len(found) > limit:
        raise Cut(f"{form} data is more than {limit >> 20} MB when unpacked")
    if not made.eof:
        raise Cut(f"{form} data ends early")
    return found


def decompressor(form: str) -> Any:
    """An object that unpacks piece by piece; Cut for a form that is not known."""
    if form == "bz2":
        import bz2

        return bz2.BZ2Decompressor()
    if form == "lz4":
        import lz4.frame

        return lz4.frame.LZ4FrameDecompressor()
    if form == "zstd":
        return _zstd().ZstdDecompressor()
    raise Cut(f"compression {form[:40]!r} is not known")


def _zstd() -> Any:
    if sys.version_info >= (3, 14):
        from compression import zstd
    else:
        from backports import zstd
    return zstd


def _zstd_error() -> type[Exception]:
    found: type[Exception] = _zstd().ZstdError
    return found


def unpack_file(path: Path, to: BinaryIO, limit: int) -> Cut | None:
    """Write what the zstd file *path* holds, up to where it ends early or is damaged, which is returned; Cut at *limit* bytes."""
    with Unpacking(path) as packed:
        written = 0
        while piece := packed.read(_PIECE):
            written += len(piece)
            if written > limit:
                raise Cut(f"it is more than {limit >> 20} MB when unpacked")
            to.write(piece)
    return packed.damage


class Unpacking:
    """A zstd file, *packed*, that is unpacked as it is read. It ends where it is damaged, and *damage* says so."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damage: Cut | None = None

    def __enter__(self) -> Unpacking:
        self.packed = opened(self.path)
        self.file = _zstd().open(self.packed, "rb")
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()
        self.packed.close()

    def read(self, size: int) -> bytes:
        """The next *size* bytes, less at the end."""
        found = bytearray()
        while len(found) < size and self.damage is None:
            try:
                piece = self.file.read1(size - len(found))
            except (OSError, EOFError, _zstd_error()) as err:
                self.damage = Cut(f"zstd data is damaged: {err}")
                break
            if not piece:
                break
            found += piece
        return bytes(found)
