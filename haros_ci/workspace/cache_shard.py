# SPDX-License-Identifier: Apache-2.0
"""One file of the cache: its entries, each with the run that used it last."""

from __future__ import annotations

import json
from typing import Any

from haros_ci.regex import regex

FORMAT = 1
_FRAME = 100  # bytes of a shard around its entries
_HEAD = regex(rf'\{{"format":{FORMAT},"run":([0-9]{{1,15}}),"entries":\{{\n')
_TAIL = "\n}}\n"
_KEY = regex(r'("(?:[^"\\]|\\.)*"):\[')
_LAST_RUN = regex(r"\[([0-9]{1,15}),")


class CacheFile:
    """One file: ``{"format": 1, "run": N, "entries": {"KEY PATH": [N, VALUE]}}``, N counting the runs that wrote it.

    Each entry has a line of its own, and is text until it is asked for: a cache of many workspaces costs each of them
    what it uses.
    """

    def __init__(self, data: bytes) -> None:
        self.is_changed = False
        self._run, self._entries = _parse(data)
        self._used: set[str] = set()

    def get(self, entry: str) -> object | None:
        found = self._entries.get(entry)
        if isinstance(found, str):
            found = self._entries[entry] = _loaded(found)
        if not isinstance(found, list) or len(found) != 2:
            return None
        self._used.add(entry)
        value: object = found[1]
        return value

    def put(self, entry: str, value: object) -> None:
        self._entries[entry] = [0, value]
        self._used.add(entry)
        self.is_changed = True

    def get_text(self, entry: str) -> str | None:
        """The value's text; whether it is JSON is for its reader to find out."""
        found = self._entries.get(entry)
        if isinstance(found, str):
            head = _LAST_RUN.match(found)
            if head is None or found[-1] != "]":
                return None
            self._used.add(entry)
            return found[head.end() : -1]
        value = self.get(entry)
        try:
            return None if value is None else json.dumps(value, allow_nan=False)
        except (ValueError, RecursionError):
            return None

    def put_text(self, entry: str, text: str) -> None:
        self._entries[entry] = f"[0,{text}]"
        self._used.add(entry)
        self.is_changed = True

    def document(self, limit: int) -> str:
        """The file's text, of at most *limit* bytes: the entries that were not used for the longest are left out."""
        rows = []
        for entry, found in self._entries.items():
            if isinstance(found, str):
                written = _LAST_RUN.match(found)
                if written is not None:
                    last = self._run + 1 if entry in self._used else int(written[1])
                    rows.append((last, entry, f"{json.dumps(entry)}:[{last},{found[written.end() :]}"))
            elif isinstance(found, list) and len(found) == 2 and isinstance(found[0], int):
                last = self._run + 1 if entry in self._used else found[0]
                try:
                    value = json.dumps(found[1], separators=(",", ":"), allow_nan=False)
                except (ValueError, RecursionError):  # 1e999 can be read, and is not JSON
                    continue
                rows.append((last, entry, f"{json.dumps(entry)}:[{last},{value}]"))
        rows.sort(key=lambda row: (-row[0], row[1]))
        room = limit - _FRAME
        kept = []
        for _, entry, text in rows:
            room -= len(text) + 2
            if room < 0:
                break
            kept.append((entry, text))
        self.is_changed = False
        body = ",\n".join(text for _, text in sorted(kept))
        return f'{{"format":{FORMAT},"run":{self._run + 1},"entries":{{\n{body}\n}}}}\n'


def _parse(data: bytes) -> tuple[int, dict[str, Any]]:
    """Run count and entries of a shard, (0, {}) if it is not one; the entries are text where each has its line."""
    by_line = _lines(data)
    if by_line is not None:
        return by_line
    document = _loaded(data) if data else None
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        return 0, {}
    run, entries = document.get("run"), document.get("entries")
    if not isinstance(run, int) or not 0 <= run < 1 << 53 or not isinstance(entries, dict):
        return 0, {}
    return run, entries


def _lines(data: bytes) -> tuple[int, dict[str, Any]] | None:
    """Run count and entries of a shard as ``document`` lays it out, None for any other."""
    if not data.isascii():  # the lines are written again as they are
        return None
    text = data.decode("ascii")
    head = _HEAD.match(text)
    if head is None or not text.endswith(_TAIL, head.end()):
        return None
    entries = {}
    for line in filter(None, text[head.end() : -len(_TAIL)].split(",\n")):
        key = _KEY.match(line)
        entry = _loaded(key[1]) if key is not None and line[-1] == "]" else None
        if key is None or not isinstance(entry, str):
            return None
        entries[entry] = line[key.end() - 1 :]
    return int(head[1]), entries


def _loaded(text: str | bytes) -> Any:
    """The value of a JSON text, None if the text is not JSON."""
    try:
        return json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError):
        return None


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is not JSON")
