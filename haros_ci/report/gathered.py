# SPDX-License-Identifier: Apache-2.0
"""Files that tools could not analyse, for a person: each file once, and one reason of many files once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from haros_ci.model.workspace import LATIN_1
from haros_ci.results.result import Notification

#: So many files are named for one reason.
NAMED = 5
_GAVE_UP = " could not analyse this file: "


def gathered(notes: Iterable[Notification]) -> tuple[Notification, ...]:
    """*notes* in their order, in which several tools that could not analyse a file are one note, with the first one's reason; so are several
    files that the same tools could not analyse for the same reason (a header that all of them include, Python 2).
    """
    by_file: dict[object, list[Notification]] = {}
    for note in notes:
        if note.message == LATIN_1 and note.path:
            by_file.setdefault((LATIN_1, note.level), []).append(note)
            continue
        is_of_file = note.tool and note.path and note.message.startswith(f"{note.tool}{_GAVE_UP}")
        by_file.setdefault((note.path, note.level) if is_of_file else id(note), []).append(note)
    by_reason: dict[object, list[Notification]] = {}
    for group in by_file.values():
        first = group[0]
        tools = list(dict.fromkeys(note.tool or "" for note in group))
        reason = first.message.partition(_GAVE_UP)[2]
        if first.message == LATIN_1:
            by_reason[LATIN_1, first.level] = group
        elif reason:
            by_reason.setdefault((tuple(tools), reason, first.level), []).append(first)
        else:
            by_reason[id(first)] = group
    return tuple(_one(key, group) for key, group in by_reason.items())


def _of_many(reason: str) -> str:
    """*reason* in the plural: "they are Python 2"."""
    return f"they are {reason[6:]}" if reason.startswith("it is ") else reason


def _one(key: object, group: list[Notification]) -> Notification:
    first = group[0]
    if first.message == LATIN_1 and len(group) > 1:
        message = f"{len(group)} files are not UTF-8, and are read as Latin-1; save them as UTF-8: {_named(group)}"
        return replace(first, path=None, line=None, message=message)
    if first.message == LATIN_1 or not isinstance(key, tuple):
        return first
    tools, reason, _ = key
    who = tools[0] if len(tools) == 1 else f"{', '.join(tools[:-1])} and {tools[-1]}"
    if len(group) == 1:
        return first if len(tools) == 1 else replace(first, tool=None, message=f"{who}{_GAVE_UP}{reason}")
    message = f"{who} could not analyse {len(group)} files: {_of_many(reason.rstrip('.'))}: {_named(group)}"
    return replace(first, tool=tools[0] if len(tools) == 1 else None, path=None, line=None, message=message)


def _named(group: list[Notification]) -> str:
    places = [f"{note.path}:{note.line}" if note.line else f"{note.path}" for note in group]
    more = f" and {len(places) - NAMED} more" if len(places) > NAMED else ""
    return f"{', '.join(places[:NAMED])}{more}"
