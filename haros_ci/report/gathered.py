# SPDX-License-Identifier: Apache-2.0
"""Files that tools could not analyse, for a person: each file once, and one reason of many files once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from haros_ci.model.workspace import LATIN_1
from haros_ci.results.result import Notification, Result

#: So many files are named for one reason.
NAMED = 5
_SKIPPED = "skipped: "
#: Rules on the syntax of a whole file.
_OF_SYNTAX = frozenset(("pylint:syntax-error", "ruff:invalid-syntax", "flake8:E999"))
_GAVE_UP = " could not analyse this file: "


def gathered(notes: Iterable[Notification], results: Iterable[Result] = ()) -> tuple[Notification, ...]:
    """*notes* in their order, in which several tools that could not analyse a file are one note, with the first one's reason; so are several
    files that the same tools could not analyse for the same reason (a header that all of them include, Python 2), and files that are skipped for
    the same one. Left out is what one of the *results*, on the syntax of that line, says already.
    """
    wrong = {(one.location.path, one.location.line) for one in results if one.full_id in _OF_SYNTAX}
    by_file: dict[object, list[Notification]] = {}
    for note in notes:
        is_of_file = note.tool and note.path and note.message.startswith(f"{note.tool}{_GAVE_UP}")
        if is_of_file and (note.path, note.line) in wrong:
            continue
        if is_of_file:
            key: object = (note.path, note.level)
        else:
            key = (note.message, note.level) if _is_of_many(note) else id(note)
        by_file.setdefault(key, []).append(note)
    by_reason: dict[object, list[Notification]] = {}
    for group in by_file.values():
        first = group[0]
        tools = list(dict.fromkeys(note.tool or "" for note in group))
        reason = first.message.partition(_GAVE_UP)[2]
        if reason and not _is_of_many(first):
            by_reason.setdefault((tuple(tools), reason, first.level), []).append(first)
        else:
            by_reason[id(first)] = group
    return tuple(_one(key, group) for key, group in by_reason.items())


def _is_of_many(note: Notification) -> bool:
    """Whether it says of a file what it would say of others in the same words: how it is read, or why it is not."""
    is_of_input = note.tool is None and note.path is not None and not note.configuration
    return is_of_input and (note.message == LATIN_1 or note.message.startswith(_SKIPPED))


def _of_many(reason: str) -> str:
    """*reason* in the plural: "they are Python 2"."""
    return f"they are {reason[6:]}" if reason.startswith("it is ") else reason


def _one(key: object, group: list[Notification]) -> Notification:
    first = group[0]
    if _is_of_many(first) and len(group) > 1:
        what = f"skipped ({first.message.removeprefix(_SKIPPED)})"
        if first.message == LATIN_1:
            what = "not UTF-8, and are read as Latin-1; save them as UTF-8"
        return replace(first, path=None, line=None, message=f"{len(group)} files are {what}: {_named(group)}")
    if not isinstance(key, tuple):
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
