# SPDX-License-Identifier: Apache-2.0
"""The file of facts: a line of JSON that describes it, then sections, each compressed by itself and read when first asked.

A section is lines of a name, a tab and words. Written by tools/build_knowledge.py.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

#: Files of another version are not read.
VERSION = 1
FACTS = Path(__file__).with_name("facts.dat")
#: The names of modules of Python's own; written by tools/build_python_names.py.
PYTHON = Path(__file__).with_name("python.dat")


class Facts:
    """The sections of one file; a file that is not there or not to be understood has none."""

    def __init__(self, path: Path = FACTS) -> None:
        self._sections: dict[str, Mapping[str, str]] = {}
        try:
            data = path.read_bytes()
            head, _, self._body = data.partition(b"\n")
            about = json.loads(head)
        except (OSError, ValueError):
            about, self._body = {}, b""
        self.about: Mapping[str, Any] = about if isinstance(about, dict) and about.get("version") == VERSION else {}

    def section(self, name: str) -> Mapping[str, str]:
        """The rows of a section, words as one text."""
        if name not in self._sections:
            start, size = self.about.get("sections", {}).get(name, (0, 0))
            text = zlib.decompress(self._body[start : start + size]).decode() if size else ""
            rows = (line.split("\t", 1) for line in text.split("\n") if line)
            self._sections[name] = {row[0]: row[1] for row in rows}
        return self._sections[name]

    def words(self, section: str, name: str) -> frozenset[str] | None:
        """The words of a row, None if there is none."""
        row = self.section(section).get(name)
        return None if row is None else frozenset(row.split())


def write_facts(path: Path, about: Mapping[str, Any], sections: Mapping[str, Mapping[str, str]]) -> None:
    """Write *sections*, sorted, so that the same facts are the same bytes."""
    bodies: list[bytes] = []
    places: dict[str, tuple[int, int]] = {}
    for name, rows in sections.items():
        text = "".join(f"{key}\t{rows[key]}\n" for key in sorted(rows))
        body = zlib.compress(text.encode(), 9)
        places[name] = (sum(map(len, bodies)), len(body))
        bodies.append(body)
    head = json.dumps({"version": VERSION, **about, "sections": places}, separators=(",", ":"))
    path.write_bytes(head.encode() + b"\n" + b"".join(bodies))
