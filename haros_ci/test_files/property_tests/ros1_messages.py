# SPDX-License-Identifier: Apache-2.0
"""Messages of ROS 1 as dicts, and back."""

from __future__ import annotations

from typing import Any

from haros_ci.test_files.property_tests.trials import NotReady


def class_of(kind: str) -> Any:
    """The class of ``pkg/T``."""
    from roslib.message import get_message_class

    found = get_message_class(kind)
    if found is None:
        raise NotReady(f"there are no Python classes for {kind}; build the workspace and source its setup file")
    return found


def filled(kind: Any, values: dict[str, Any]) -> Any:
    """A message of the class *kind* with these values."""
    made = kind()
    for name, written in zip(made.__slots__, made._slot_types):
        setattr(made, name, _value(written, values[name]))
    return made


def _value(written: str, value: Any) -> Any:
    base, bracket, _ = written.partition("[")
    if bracket:
        if base in ("uint8", "char"):
            return bytes(value)
        return [_value(base, item) for item in value]
    if base in ("time", "duration"):
        import genpy

        return (genpy.Time if base == "time" else genpy.Duration)(value["secs"], value["nsecs"])
    if isinstance(value, dict):
        return filled(class_of("std_msgs/Header" if base == "Header" else base), value)
    return value


def plain(message: Any) -> Any:
    """A message as dicts, lists and plain values."""
    if hasattr(message, "_slot_types"):
        return {name: plain(getattr(message, name)) for name in message.__slots__}
    if hasattr(message, "nsecs"):
        return {"secs": message.secs, "nsecs": message.nsecs}
    if isinstance(message, (list, tuple, bytes)):
        return [plain(item) for item in message]
    return message
