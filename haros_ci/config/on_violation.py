# SPDX-License-Identifier: Apache-2.0
"""``on_violation`` under ``hpl`` of a configuration: what a generated monitor does when a property is violated.

It is ours, and says what happens on a robot, so that all that is odd in it is an error, in HAROS's file, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from haros_ci.config.shapes import File, kind
from haros_ci.config.suggestion import quoted, suggestion
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.regex import regex

KEY = "on_violation"
VERBS = ("publish", "call", "log")
KEYS = (*VERBS, "type", "message")
LEVELS = ("info", "warn", "error", "fatal")
#: Actions of one configuration, and values of one message.
MOST_ACTIONS, MOST_VALUES = 200, 2_000
FORM = "on_violation: {stops: [{publish: /motors/off, type: std_msgs/Empty}, {log: error}]}"
_NAME = regex(r"(?:/[A-Za-z_][A-Za-z0-9_]{0,100}){1,30}", re.ASCII)
_TYPE = regex(r"[A-Za-z]\w{0,100}/(?:(?:msg|srv)/)?[A-Za-z]\w{0,100}", re.ASCII)


def check_on_violation(file: File, configuration: YamlValue, what: str) -> None:
    """UserError at what is no list of actions; HAROS lets ``hpl`` be anything, so other keys of it are passed over."""
    hpl = configuration.data
    value = hpl.get(KEY) if isinstance(hpl, dict) else None
    if value is None or value.data is None:
        return
    if not isinstance(value.data, dict):
        raise file.error(
            value.line or value.key_line, f"'{KEY}' of {what} must be a map, not {kind(value)}", f"write {FORM}"
        )
    count = 0
    for name, item in value.data.items():
        if not isinstance(item.data, tuple):
            raise file.error(
                item.key_line, f"{quoted(str(name))} in '{KEY}' must have a list, not {kind(item)}", f"write {FORM}"
            )
        for action in item.data:
            count += 1
            _check_action(file, action, f"an action of {quoted(str(name))} in '{KEY}'")
    if count > MOST_ACTIONS:
        raise file.error(value.key_line, f"'{KEY}' of {what} has more than {MOST_ACTIONS} actions")


def _check_action(file: File, action: YamlValue, what: str) -> None:
    if not isinstance(action.data, dict):
        raise file.error(action.line, f"{what} must be a map, not {kind(action)}", f"write {FORM}")
    for key, item in action.data.items():
        if key not in KEYS:
            raise file.error(item.key_line, f"unknown key {quoted(str(key))} in {what}", suggestion(str(key), KEYS))
    verbs = [verb for verb in VERBS if verb in action.data]
    if len(verbs) != 1:
        raise file.error(action.line, f"{what} must have one of {', '.join(VERBS)}", f"write {FORM}")
    verb, value = verbs[0], action.data[verbs[0]]
    if verb == "log":
        if value.data not in LEVELS or len(action.data) > 1:
            raise file.error(value.key_line, f"'log' of {what} must be {', '.join(LEVELS)}, and alone", "log: error")
        return
    if not isinstance(value.data, str) or not _NAME.fullmatch(value.data):
        raise file.error(value.key_line, f"{quoted(verb)} of {what} must be a full name", f"{verb}: /motors/off")
    _check_message(file, action.data, what)


def _check_message(file: File, action: Mapping[Any, YamlValue], what: str) -> None:
    """UserError at a type or fields that are none."""
    given, message = action.get("type"), action.get("message")
    if given is not None and given.data is not None:
        if not isinstance(given.data, str) or not _TYPE.fullmatch(given.data):
            raise file.error(given.key_line, f"'type' of {what} must be a type", "type: std_msgs/Empty")
    if message is not None and message.data is not None:
        if not isinstance(message.data, dict) or message.size > MOST_VALUES:
            raise file.error(message.key_line, f"'message' of {what} must be a map of fields", "message: {data: true}")


def actions_in(project: Mapping[str, Any], configuration: str) -> dict[str, list[dict[str, Any]]]:
    """The actions of a *configuration* by the ids of properties ("*" for all), from a project file that was checked."""
    found: Any = project
    for key in ("configurations", configuration, "hpl", KEY):
        found = found.get(key) if isinstance(found, Mapping) else None
    if not isinstance(found, Mapping):
        return {}
    return {
        str(name): [{key: value for key, value in action.items() if value is not None} for action in actions]
        for name, actions in found.items()
    }
