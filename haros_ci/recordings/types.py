# SPDX-License-Identifier: Apache-2.0
"""Bytes as messages, by the definitions that a bag carries, with rosbags.

rosbags makes Python code of definitions, and runs it. So what it has read of a definition is checked first (``checked``): names are ASCII
identifiers, constants plain values, sizes numbers within a limit. A definition that cannot be read makes the messages of its topic unreadable,
not the bag.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from haros_ci.recordings.bag import MAGIC_ZSTD, unreadable
from haros_ci.recordings.packed import unpacked
from haros_ci.recordings.recording import LONGEST_DEFINITION, Channel
from haros_ci.regex import regex

Decoder = Callable[[bytes, int], Any]
_TYPE = regex(r"[A-Za-z]\w{0,200}(?:/msg)?/[A-Za-z]\w{0,200}", re.ASCII)
_NAME_OF_TYPE = regex(r"[A-Za-z]\w{0,200}(?:/[A-Za-z]\w{0,200}){0,3}", re.ASCII)
_NAME_OF_FIELD = regex(r"[A-Za-z]\w{0,200}", re.ASCII)
#: Lines of a definition.
MOST_LINES = 10_000
#: Fields of a definition with all that it uses; elements of an array of a fixed size, and signs of a bounded text.
MOST_FIELDS, LARGEST_ARRAY = 3_000, 10_000_000
#: Elements of all arrays of a fixed size of messages or texts: rosbags writes code for each of them.
MOST_WRITTEN_OUT = 2_000
_ARRAY, _SEQUENCE = 3, 4
_ARRAYS = (_ARRAY, _SEQUENCE)
_NAME = 2


def decoder_of(channel: Channel) -> Decoder:
    """What makes a message, or an ``Unreadable``, of bytes and the number of the message."""
    try:
        store, name, least = _store(channel)
    except Exception as err:  # noqa: BLE001 (whatever a definition does to rosbags is a fault of the definition)
        why = str(err).splitlines()[0][:200] if str(err) else type(err).__name__
        return lambda raw, number: unreadable(number, channel, why)
    read = store.deserialize_ros1 if channel.encoding == "ros1" else store.deserialize_cdr

    def decode(raw: bytes, number: int) -> Any:
        try:
            plain = unpacked(raw, "zstd") if raw.startswith(MAGIC_ZSTD) else raw
            if len(plain) < least:  # else arrays of a fixed size could cost more time than the message has bytes
                return unreadable(number, channel, f"it is shorter than a {channel.type}")
            return read(plain, name)
        except Exception as err:  # noqa: BLE001 (whatever bytes do to rosbags is a fault of the bytes)
            return unreadable(number, channel, f"it is no {channel.type} ({type(err).__name__})")

    return decode


def _store(channel: Channel) -> tuple[Any, str, int]:
    """rosbags' types for a channel, the name of its type there, and the bytes that a message has at least."""
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    if channel.encoding not in ("ros1", "cdr"):
        raise ValueError(f"messages in {channel.encoding[:40]!r} are not read")
    if _TYPE.fullmatch(channel.type) is None:
        raise ValueError("its type has no name")
    package, _, rest = channel.type.partition("/")
    name = f"{package}/msg/{rest.rpartition('/')[2]}"
    if channel.definition is None:
        store = get_typestore(Stores.LATEST)
        if channel.encoding == "ros1" or name not in store.fielddefs:
            raise ValueError(f"the bag does not say what a {channel.type} is")
        return store, name, least_bytes(store.fielddefs, name)
    if len(channel.definition) > LONGEST_DEFINITION or channel.definition.count("\n") > MOST_LINES:
        raise ValueError(f"the definition of {channel.type} is too long")
    types = get_types_from_msg(channel.definition, name)
    checked(types)
    store = get_typestore(Stores.EMPTY)
    known = {**store.fielddefs, **types}  # time and duration of ROS 1 are not defined in a bag
    for used in _unknown(known):
        raise ValueError(f"the bag does not say what a {used} is")
    least = least_bytes(known, name)
    store.register(types)
    if channel.encoding == "ros1" and _is_hollow(types):
        raise ValueError(f"{channel.type} has an array of messages without any field")
    store.get_msgdef(name)
    return store, name, least


def checked(types: Any) -> None:
    """ValueError if anything in *types*, as rosbags has read them, is more than a plain name, value or size."""
    for name, (constants, fields) in types.items():
        _identifier(_NAME_OF_TYPE, name)
        for constant, kind, value in constants:
            _identifier(_NAME_OF_FIELD, constant)
            _identifier(_NAME_OF_FIELD, kind)
            if value.__class__ not in (bool, int, float, str):
                raise ValueError("a constant is no plain value")
        for field, kind in fields:
            _identifier(_NAME_OF_FIELD, field)
            _check_kind(kind)
    every = [kind for _, fields in types.values() for _, kind in fields]
    if len(every) > MOST_FIELDS:
        raise ValueError(f"it has more than {MOST_FIELDS:,} fields")
    if sum(inner[1] for sort, inner in every if sort == _ARRAY and _is_written_out(inner[0])) > MOST_WRITTEN_OUT:
        raise ValueError(f"its arrays of a fixed size have more than {MOST_WRITTEN_OUT:,} messages or texts")


def _is_written_out(kind: Any) -> bool:
    sort, inner = kind
    return sort == _NAME or inner[0] in ("string", "wstring")


def _check_kind(kind: Any) -> None:
    """A kind is (base, (name, size)), (name, type), (array or sequence, (kind, size))."""
    sort, inner = kind
    if sort == _NAME:
        _identifier(_NAME_OF_TYPE, inner)
        return
    if sort in _ARRAYS:
        _check_kind(inner[0])
    else:
        _identifier(_NAME_OF_FIELD, inner[0])
    size = inner[1]
    if size.__class__ is not int or not 0 <= size <= LARGEST_ARRAY:
        raise ValueError(f"an array has more than {LARGEST_ARRAY:,} elements")


def _identifier(pattern: re.Pattern[str], name: object) -> None:
    if name.__class__ is not str or pattern.fullmatch(str(name)) is None:
        raise ValueError(f"{str(name)[:40]!r} is no name")


def least_bytes(types: Any, name: str, known: dict[str, int | None] | None = None) -> int:
    """The bytes that a message of the type *name* has at least. ValueError for a type that contains itself, or is larger than a message may be."""
    known = {} if known is None else known
    if name not in known:
        known[name] = None
        known[name] = sum(_least_of(types, kind, known) for _, kind in types[name][1])
    found = known[name]
    if found is None or found > LARGEST_ARRAY:
        raise ValueError(
            f"{name} contains itself" if found is None else f"{name} has more than {LARGEST_ARRAY:,} values"
        )
    return found


def _least_of(types: Any, kind: Any, known: dict[str, int | None]) -> int:
    sort, inner = kind
    if sort == _NAME:
        return least_bytes(types, inner, known)
    if sort == _ARRAY:
        return int(inner[1]) * _least_of(types, inner[0], known)
    return 1


def _unknown(types: Any) -> list[str]:
    """The types that fields have and that are not among *types*."""
    named = []
    for _, fields in types.values():
        for _, (kind, inner) in fields:
            inner_kind, inner_name = inner[0] if kind in _ARRAYS else (kind, inner)
            if inner_kind == _NAME and inner_name not in types:
                named.append(str(inner_name))
    return named


def _is_hollow(types: Any) -> bool:
    """Whether there is an array whose items have no bytes: its length could be anything."""
    hollow: set[str] = set()
    before = -1
    while len(hollow) > before:
        before = len(hollow)
        for name, (_, fields) in types.items():
            if all(kind == _NAME and inner in hollow for _, (kind, inner) in fields):
                hollow.add(name)
    return any(
        kind in _ARRAYS and inner[0][0] == _NAME and inner[0][1] in hollow
        for _, fields in types.values()
        for _, (kind, inner) in fields
    )
