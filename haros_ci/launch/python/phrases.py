# SPDX-License-Identifier: Apache-2.0
"""The phrases of an action's attributes, from the arguments of its constructor."""

from __future__ import annotations

import shlex
from typing import Any

from haros_ci.launch.python.paths import MARKER
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    Library,
    LibraryCall,
    Maybe,
    Rest,
    Unknown,
    Value,
    merged,
    mystery,
    phrase,
    why,
)
from haros_ci.model.launch_actions import Phrase, Substitution

#: What runs the launch file: as the program of a command line it is a Python, wherever it lies.
INTERPRETER = Library("sys.executable")


def phrases_of(
    bound: dict[str, Value], names: tuple[tuple[str, str], ...], call: LibraryCall
) -> tuple[tuple[str, Phrase], ...]:
    """The phrases of the parameters that are given, by their attributes' names; None is not given."""
    found = tuple((called, phrase(bound[name])) for name, called in names if bound.get(name) is not None)
    if call.unknown:
        missing = tuple(
            (called, (mystery(call.unknown, call.location),)) for name, called in names if name not in bound
        )
        return (*found, *missing)
    return found


def flag(value: Value) -> Phrase:
    """A bool as XML has it."""
    return (str(value).lower(),) if isinstance(value, bool) else phrase(value)


def words(run: ScriptEvaluation, value: Value, call: LibraryCall) -> Phrase:
    """The words of a command line, those with white space in quotes, with a blank between them."""
    if value is None:
        return ()
    if isinstance(value, str):
        return phrase(value)
    items = items_of(run, value, call.location)
    if isinstance(items, Unknown):
        return (mystery(items.reason, items.location or call.location),)
    parts: list[Any] = []
    for index, item in enumerate(items):
        parts.extend((" ",) if index else ())
        text = phrase(item if index or item != INTERPRETER else "python3")
        if not text or (len(text) == 1 and isinstance(text[0], str)):
            word = str(text[0]) if text else ""
            parts.append(shlex.quote(word) if not word or needs_quotes(word) else word)
        elif all(isinstance(part, Substitution) for part in text) and not isinstance(item, (Maybe, Rest)):
            parts.extend(("'", *text, "'"))  # the value is one word, also where it is empty or has blanks
        else:
            parts.extend(text)
    return merged(parts)


def needs_quotes(text: str) -> bool:
    """Whether a shell would part *text*; the blank of a marker is none."""
    return any(sign in MARKER.sub("", text) for sign in " \t\n'\"")


def pair_of(item: Value, call: LibraryCall) -> tuple[Phrase, Phrase]:
    """A pair of phrases; of one that is there on some way only, the second is not known."""
    if isinstance(item, Maybe) and isinstance(item.value, (list, tuple)) and len(item.value) == 2:
        return phrase(item.value[0]), (mystery(why(item), call.location),)
    if isinstance(item, (list, tuple)) and len(item) == 2:
        return phrase(item[0]), phrase(item[1])
    lost = (mystery(why(item), call.location),)
    return lost, lost
