# SPDX-License-Identifier: Apache-2.0
"""Bytes as messages, by the definitions that a bag carries, with rosbags.

rosbags makes Python code of definitions, so only what its grammar lets through as plain names gets there: names of types are held to a pattern
first, and definitions have a limit. A definition that cannot be read makes the messages of its topic unreadable, not the bag.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from haros_ci.recordings.bag import MAGIC_ZSTD, unreadable
from haros_ci.recordings.packed import unpacked
from haros_ci.recordings.recording import Channel

Decoder = Callable[[bytes, int], Any]
_TYPE = re.compile(r"[A-Za-z]\w{0,200}(?:/msg)?/[A-Za-z]\w{0,200}", re.ASCII)
#: Signs of a definition, and lines of it.
LONGEST, MOST_LINES = 500_000, 20_000
_ARRAYS = (3, 4)
_NAME = 2


def decoder_of(channel: Channel) -> Decoder:
    """What makes a message, or an ``Unreadable``, of bytes and the number of the message."""
    try:
        store, name = _store(channel)
    except Exception as err:  # noqa: BLE001 (whatever a definition does to rosbags is a fault of the definition)
        why = str(err).splitlines()[0][:200] if str(err) else type(err).__name__
        return lambda raw, number: unreadable(number, channel, why)
    read = store.deserialize_ros1 if channel.encoding == "ros1" else store.deserialize_cdr

    def decode(raw: bytes, number: int) -> Any:
        try:
            return read(unpacked(raw, "zstd") if raw.startswith(MAGIC_ZSTD) else raw, name)
        except Exception as err:  # noqa: BLE001 (whatever bytes do to rosbags is a fault of the bytes)
            return unreadable(number, channel, f"it is no {channel.type} ({type(err).__name__})")

    return decode


def _store(channel: Channel) -> tuple[Any, str]:
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore  # type: ignore[import-not-found, import-untyped, unused-ignore]

    if channel.encoding not in ("ros1", "cdr"):
        raise ValueError(f"messages in {channel.encoding[:40]!r} are not read")
    if _TYPE.fullmatch(channel.type) is None:
        raise ValueError("its type has no name")
    package, _, rest = channel.type.partition("/")
    name = f"{package}/msg/{rest.rpartition('/')[2]}"
    if not channel.definition:
        if channel.encoding == "ros1" and channel.type != "std_msgs/Empty":
            raise ValueError(f"the bag does not say what a {channel.type} is")
        store = get_typestore(Stores.ROS1_NOETIC if channel.encoding == "ros1" else Stores.LATEST)
        if name not in store.fielddefs:
            raise ValueError(f"the bag does not say what a {channel.type} is")
        return store, name
    if len(channel.definition) > LONGEST or channel.definition.count("\n") > MOST_LINES:
        raise ValueError(f"the definition of {channel.type} is too long")
    types = get_types_from_msg(channel.definition, name)
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    if channel.encoding == "ros1" and _is_hollow(types):
        raise ValueError(f"{channel.type} has an array of messages without any field")
    store.get_msgdef(name)
    return store, name


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
