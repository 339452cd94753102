# SPDX-License-Identifier: Apache-2.0
"""The MD5 sum by which two ROS 1 nodes know that they mean the same message.

genmsg computes it over the text of a definition without comments: first all constants, then all fields, one a line; a nested message
stands for its own sum. The sum of a service is that of its request's text followed by its response's. Of an action actionlib's
genaction makes seven messages; the sum of the one that holds the others is the action's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from hashlib import md5 as digest

from haros_ci.interfaces.definitions import Definitions, field_type
from haros_ci.model.build import Interface, InterfaceField

#: The wrappers that genaction makes, each with what stands before the part of the user.
_HEAD = ("std_msgs/Header header",)
_WRAPPERS = (
    ("Goal", (*_HEAD, "actionlib_msgs/GoalID goal_id")),
    ("Result", (*_HEAD, "actionlib_msgs/GoalStatus status")),
    ("Feedback", (*_HEAD, "actionlib_msgs/GoalStatus status")),
)


def md5(interface: Interface, known: Definitions) -> str | None:
    """The MD5 sum of *interface* in ROS 1; None if it, or a message in it, is not known for certain."""
    key = (interface.kind, interface.name)
    if key not in known.hashes:
        known.hashes[key] = None  # a definition that contains itself has no sum
        known.hashes[key] = _md5(interface, known)
    return known.hashes[key]


def _md5(interface: Interface, known: Definitions) -> str | None:
    if not interface.is_whole:
        return None
    texts = [_text(section, known) for section in interface.sections]
    if None in texts:
        return None
    known_texts = [text for text in texts if text is not None]
    return _action(known_texts, known) if interface.kind == "action" else _sum(known_texts)


def action_messages(interface: Interface, known: Definitions) -> dict[str, str | None]:
    """The sums of the messages that genaction makes of an action, by their names' last part: ``Goal``, ``ActionGoal``, …"""
    texts = [_text(section, known) for section in interface.sections]
    made: dict[str, str | None] = {}
    for (part, _), text in zip(_WRAPPERS, texts):
        made[part] = None if text is None else _sum([text])
        made[f"Action{part}"] = None if text is None else _wrapped(part, text, known)
    made["Action"] = md5(interface, known)
    return made


def _action(texts: Sequence[str], known: Definitions) -> str | None:
    wrapped = [_wrapped(part, text, known) for (part, _), text in zip(_WRAPPERS, texts)]
    if None in wrapped:
        return None
    lines = [f"{made} action_{part.lower()}" for (part, _), made in zip(_WRAPPERS, wrapped)]
    return _sum(["\n".join(lines)])


def _wrapped(part: str, text: str, known: Definitions) -> str | None:
    lines = []
    for line in dict(_WRAPPERS)[part]:
        kind, name = line.split()
        of = _nested(kind, known)
        if of is None:
            return None
        lines.append(f"{of} {name}")
    return _sum(["\n".join((*lines, f"{_sum([text])} {part.lower()}"))])


def _text(fields: Iterable[InterfaceField], known: Definitions) -> str | None:
    constants, others = [], []
    for field in fields:
        if field.is_constant:
            constants.append(f"{field.type} {field.name}={field.value}")
            continue
        kind = field_type(field.type)
        if kind is None or kind.length or kind.form == "bounded" or field.value:
            return None  # not of ROS 1
        if not kind.is_nested:
            others.append(f"{field.type} {field.name}")
            continue
        of = _nested(kind.base, known)
        if of is None:
            return None
        others.append(f"{of} {field.name}")
    return "\n".join((*constants, *others)).strip()


def _nested(name: str, known: Definitions) -> str | None:
    found = known.find("msg", name)
    return None if found is None else md5(found, known)


def _sum(texts: Iterable[str]) -> str:
    made = digest(usedforsecurity=False)
    for text in texts:
        made.update(text.encode("utf-8", "surrogateescape"))
    return made.hexdigest()
