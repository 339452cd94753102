# SPDX-License-Identifier: Apache-2.0
"""Copies of files for tools that look around themselves: beside a copy lies nothing that we did not put there.

Copies hold the text as it was decoded, in UTF-8 and without a byte-order mark, so that a tool's columns are those of
the text. Newlines stay as they stand.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from posixpath import basename

from haros_ci.linters.linter import Batch

#: Bytes of a path from the root that fit below a scratch directory of any depth.
LONGEST = 1500


def tree(batch: Batch) -> Path:
    """The directory that the copies lie in."""
    return batch.scratch / "tree"


def names(batch: Batch) -> dict[str, str]:
    """For each copy's name (``./0/go.sh``) the path that it is a copy of: each file has a directory of its own."""
    return {f"./{number}/{basename(file.path)}": file.path for number, file in enumerate(batch.files)}


def lay(batch: Batch, copied: Mapping[str, str]) -> None:
    """Writes the copies: *copied* gives the path for each name below the tree."""
    for name, path in copied.items():
        put(batch, name, batch.workspace.text(path))


def put(batch: Batch, name: str, text: str) -> None:
    """Writes *text* to the file *name* below the tree."""
    place = tree(batch) / name
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_bytes(text.encode("utf-8", "replace"))
