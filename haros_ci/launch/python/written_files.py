# SPDX-License-Identifier: Apache-2.0
"""Files that a launch file writes itself, so that nodes read them: what is in each, by its path."""

from __future__ import annotations

import json
import re
from math import isfinite

from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    Choice,
    LibraryCall,
    Maybe,
    Native,
    PartialText,
    PathValue,
    Rest,
    Unknown,
    Value,
    describe,
    merged,
    mystery,
    phrase,
)
from haros_ci.model.launch_actions import Action, Phrase
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

DEEPEST = 40
#: Files that one launch file may write.
MOST = 500
TEXT = (str, PartialText)


@dataclass(frozen=True, slots=True, eq=False)
class WrittenFile:
    """A file opened for writing, and what has been written into it."""

    path: Value
    location: Location
    parts: list[Value] = field(default_factory=list)


@dataclass(frozen=True, slots=True, eq=False)
class Dumped:
    """The text that ``yaml.dump`` or ``json.dumps`` makes of *data*, which is only of use in a file."""

    data: Value


@dataclass(frozen=True, slots=True, eq=False)
class Descriptor:
    """What ``os.fdopen`` takes of ``tempfile.mkstemp``."""

    path: Value


class _Lost(Exception):
    """What is written is not known."""


def opened_for_writing(run: ScriptEvaluation, path: Value, mode: Value, location: Location) -> Value:
    """``open(path, "w")``; what a file has before something is added to it is not known."""
    if len(run.written) >= MOST:
        return run.unknown("it writes more files than are looked at", location)
    made = WrittenFile(path, location)
    run.heap.born(made.parts)
    if not (isinstance(mode, str) and mode.startswith(("w", "x"))):
        made.parts.append(Rest("what is in a file that is written on", location))
    run.heap.touch(run.written)
    run.written.append(made)
    return made


def write(run: ScriptEvaluation, file: WrittenFile, value: Value, location: Location) -> None:
    run.heap.touch(file.parts)
    run.budget.take(1)
    file.parts.append(value)


def lose(run: ScriptEvaluation, call: LibraryCall, reason: str) -> None:
    """What something does with a file that it is given is not known."""
    for value in (*call.args, *call.keywords.values()):
        if isinstance(value, WrittenFile):
            write(run, value, Rest(reason, call.location), call.location)


def attribute_of(run: ScriptEvaluation, file: WrittenFile, name: str, place: Location) -> Value:
    """An attribute or a method of a file that is written."""
    if name == "name":
        return file.path
    if name == "write":
        return Native(name, lambda run, call: write(run, file, call.args[0], call.location))
    if name == "writelines":
        return Native(name, lambda run, call: _all(run, file, call))
    if name in ("flush", "close", "fileno"):
        return Native(name, lambda run, call: None)
    write(run, file, Rest(f"file.{name} is not followed", place), place)
    return run.unknown(f"file.{name} is not followed", place)


def _all(run: ScriptEvaluation, file: WrittenFile, call: LibraryCall) -> None:
    items = items_of(run, call.args[0], call.location)
    for item in [Rest(items.reason, call.location)] if isinstance(items, Unknown) else items:
        write(run, file, item, call.location)


def dump(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``yaml.dump(data, file)``, ``json.dump(data, file)``, ``yaml.dump(data)``."""
    bound = call.bind("data stream" if call.name.startswith("yaml") else "obj fp")
    data, stream = bound.get(next(iter(bound), "data")), bound.get("stream", bound.get("fp"))
    if isinstance(stream, WrittenFile):
        write(run, stream, Dumped(data), call.location)
        return None
    if stream is not None:
        return run.unknown(f"what {call.name} gives is not followed", call.location)
    return Dumped(data)


def temporary(run: ScriptEvaluation, call: LibraryCall) -> str:
    """A path that is chosen when the file is launched; it begins with a mark of its own."""
    run.temporaries += 1
    file = re.sub(r"[^\w.-]", ".", call.location.path)
    return f"$(temporary-{run.temporaries}-{file})"


def named_temporary(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``tempfile.NamedTemporaryFile``."""
    return opened_for_writing(run, temporary(run, call), call.bind("mode").get("mode", "w+b"), call.location)


def temporary_pair(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``tempfile.mkstemp``: a descriptor and a path."""
    path = temporary(run, call)
    return (Descriptor(path), path)


def of_descriptor(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``os.fdopen``."""
    bound = call.bind("fd mode")
    given, mode = bound.get("fd"), bound.get("mode", "r")
    if not isinstance(given, Descriptor):
        return run.unknown("which file is opened is not known", call.location)
    return opened_for_writing(run, given.path, mode, call.location)


def write_descriptor(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``os.write`` and ``os.close``, of which nothing is followed."""
    for value in call.args:
        if isinstance(value, Descriptor) and call.name == "os.write":
            made = opened_for_writing(run, value.path, "a", call.location)
            return None if isinstance(made, WrittenFile) else made
    return None


def written_text(run: ScriptEvaluation, path: PathValue, call: LibraryCall) -> Value:
    """``Path.write_text``."""
    made = opened_for_writing(run, path, "w", call.location)
    if isinstance(made, WrittenFile):
        write(run, made, call.bind("data").get("data"), call.location)
    return None


def actions(run: ScriptEvaluation) -> tuple[Action, ...]:
    """What is known of the files that have been written so far, before anything else is done."""
    return tuple(_action(run, item) for item in run.written)


def _action(run: ScriptEvaluation, item: Value) -> Action:
    file = item.value if isinstance(item, Maybe) else item
    if not isinstance(file, WrittenFile):
        place = item.location if isinstance(item, Rest) else None
        return Action(kind="log", location=place or Location("."))
    path, reason = phrase(file.path), ""
    content: Phrase = ()
    try:
        if isinstance(item, Maybe) and sum(_is_of(other, path) for other in run.written) > 1:
            raise _Lost("it is written under a condition that is not known")
        content = merged(piece for part in file.parts for piece in _pieces(run, part))
    except _Lost as err:
        reason = str(err)
    if not content:
        reason = reason or "nothing that is followed is written into it"
    return Action(kind="written", location=file.location, phrases=(("path", path), ("content", content)), reason=reason)


def _is_of(item: Value, path: Phrase) -> bool:
    file = item.value if isinstance(item, Maybe) else item
    return isinstance(file, WrittenFile) and phrase(file.path) == path


def _pieces(run: ScriptEvaluation, part: Value) -> Phrase:
    if isinstance(part, Dumped):
        return (*_json(run, part.data, 0), "\n")
    if isinstance(part, TEXT):
        return phrase(part)
    raise _Lost(getattr(part, "reason", "") or describe(part))


def _json(run: ScriptEvaluation, value: Value, depth: int) -> Phrase:
    """*value* as JSON, which YAML reads as the same; what is not known in it is a part that is not known."""
    run.budget.step()
    if depth > DEEPEST:
        raise _Lost("the data is nested too deep")
    if isinstance(value, dict):
        found: list[Phrase] = []
        for key, item in value.items():
            if not isinstance(key, (str, int)):
                raise _Lost(getattr(key, "reason", "") or "a key is not known")
            found.append((json.dumps(str(key)), ": ", *_json(run, item, depth + 1)))
        return ("{", *_joined(found), "}")
    if isinstance(value, (list, tuple)):
        if any(isinstance(item, (Rest, Maybe)) for item in value):
            raise _Lost("the items of a list are not known")
        return ("[", *_joined([_json(run, item, depth + 1) for item in value]), "]")
    if isinstance(value, float):
        return (_real(value),)
    if value is None or isinstance(value, (bool, int, str)):
        return (json.dumps(value),)
    if isinstance(value, PartialText):
        return ('"', *(json.dumps(part)[1:-1] if isinstance(part, str) else part for part in value.phrase), '"')
    if isinstance(value, (Unknown, Choice)):
        return (mystery(value.reason, value.location),)
    raise _Lost(f"{describe(value)} cannot be written")


def _real(value: float) -> str:
    text = repr(value) if isfinite(value) else {"inf": ".inf", "-inf": "-.inf"}.get(repr(value), ".nan")
    mantissa, mark, exponent = text.partition("e")
    return f"{mantissa}.0e{exponent}" if mark and "." not in mantissa else text


def _joined(items: list[Phrase]) -> Phrase:
    return tuple(piece for number, item in enumerate(items) for piece in ((", ", *item) if number else item))


#: What may be done with a file that is written, and is followed.
WRITING = frozenset(("yaml.dump", "yaml.safe_dump", "json.dump"))
SUMMARIES = {
    **dict.fromkeys(WRITING, dump),
    "tempfile.mkdtemp": temporary,
    "tempfile.mktemp": temporary,
    "tempfile.mkstemp": temporary_pair,
    "tempfile.NamedTemporaryFile": named_temporary,
    "os.fdopen": of_descriptor,
    "os.write": write_descriptor,
    "os.close": write_descriptor,
}
