# SPDX-License-Identifier: Apache-2.0
"""``access`` of the project file: which nodes may publish, subscribe to, call or serve what.

A rule that is not read as it was meant would let everybody through, so all that is odd in it is an error, in HAROS's file, too.
"""

from __future__ import annotations

import re

from haros_ci.config.shapes import File, kind
from haros_ci.config.suggestion import quoted, suggestion
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.model.access import VERBS, AccessRule
from haros_ci.regex import regex

GROUPS = "groups"
KEYS = (GROUPS, *VERBS)
MAX_RULES = 500
MAX_NODES = 500
MAX_PATTERN = 300
FORM = "access: {publish: {/cmd_vel: [/mux, robot/driver]}}"
_PART = r"[A-Za-z0-9_*][A-Za-z0-9_.*-]*"
_NAME = regex(rf"(?:/{_PART})+")
_NODE = regex(rf"(?:(?:/{_PART})+|{_PART}/{_PART})")
_GROUP = regex(r"[A-Za-z_][A-Za-z0-9_-]*")


def read_access(file: File, value: YamlValue | None) -> tuple[AccessRule, ...]:
    """The rules of ``access``, in their order, groups replaced by their members."""
    if value is None:
        return ()
    lists = _entries(file, value, "'access'")
    for key, item in lists.items():
        if key not in KEYS:
            raise file.error(item.key_line, f"unknown key {quoted(key)} in 'access'", suggestion(key, KEYS))
    groups: dict[str, tuple[str, ...]] = {}
    if GROUPS in lists:
        for name, item in _entries(file, lists[GROUPS], f"'{GROUPS}' of 'access'").items():
            if not _GROUP.fullmatch(name):
                raise file.error(
                    item.key_line, f"{quoted(name)} is no name of a group", "write drivers: [/left, /right]"
                )
            groups[name] = _nodes(file, item, f"the group {quoted(name)}", {})
    found: list[AccessRule] = []
    for verb in VERBS:
        if verb in lists:
            for name, item in _entries(file, lists[verb], f"{quoted(verb)} of 'access'").items():
                found.append(_rule(file, verb, name, item, groups))
    if len(found) > MAX_RULES:
        raise file.error(value.key_line, f"'access' has more than {MAX_RULES} names", "use wildcards")
    return tuple(found)


def _rule(file: File, verb: str, name: str, item: YamlValue, groups: dict[str, tuple[str, ...]]) -> AccessRule:
    if len(name) > MAX_PATTERN or not _is_pattern(_NAME, name):
        message = f"{quoted(name)} in {quoted(verb)} of 'access' is no full name"
        raise file.error(item.key_line, message, "write /cmd_vel, /robot/*/image or /robot/**")
    return AccessRule(verb, name, _nodes(file, item, quoted(name), groups), item.key_line)


def _nodes(file: File, value: YamlValue, what: str, groups: dict[str, tuple[str, ...]]) -> tuple[str, ...]:
    if not isinstance(value.data, tuple):
        raise file.error(
            value.line or value.key_line,
            f"{what} in 'access' must have a list, not {kind(value)}",
            f"write {FORM}, and [] for nobody",
        )
    found: list[str] = []
    for item in value.data:
        text = file.text(item, f"a node of {what} in 'access'").strip()
        if text.startswith("@"):
            if text[1:] not in groups:
                raise file.error(
                    item.line, f"there is no group {quoted(text[1:])} in 'access'", suggestion(text[1:], tuple(groups))
                )
            found += groups[text[1:]]
        elif len(text) <= MAX_PATTERN and _is_pattern(_NODE, text):
            found.append(text)
        else:
            message = f"{quoted(text)} of {what} in 'access' names no node"
            raise file.error(item.line, message, "write /full/name, package/executable or '@group'")
    if len(found) > MAX_NODES:
        raise file.error(value.line, f"{what} in 'access' has more than {MAX_NODES} nodes", "use wildcards")
    return tuple(dict.fromkeys(found))


def _is_pattern(form: re.Pattern[str], text: str) -> bool:
    """Whether *text* has the form, and ``**`` in it alone between slashes."""
    return form.fullmatch(text) is not None and all("**" not in part or part == "**" for part in text.split("/"))


def _entries(file: File, value: YamlValue, what: str) -> dict[str, YamlValue]:
    """A map with text keys; unlike ``File.map`` it keeps those without a value."""
    if value.data is None:
        return {}
    if not isinstance(value.data, dict):
        raise file.error(value.line, f"{what} must be a map, not {kind(value)}", f"write {FORM}")
    return {str(key): item for key, item in value.data.items()}
