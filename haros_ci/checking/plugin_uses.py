# SPDX-License-Identifier: Apache-2.0
"""Where parameters name plug-ins of pluginlib: in YAML files, and in what launch files set."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from haros_ci.checking.system import System
from haros_ci.model.location import Location

#: The look-up name of a plug-in: ``package/Class`` or ``space::Class``.
PLUGIN_NAME = r"[A-Za-z_]\w*(?:(?:::|/)[A-Za-z_]\w*)+"
_PAIR = re.compile(rf"""(?:^|[\s,{{\[])["']?([\w.]+)["']?\s*:\s*(["']?)({PLUGIN_NAME})\2\s*(?=[,}}\]]|\s#|$)""")
_ITEM = re.compile(rf"""^(\s*)-\s+(["']?)({PLUGIN_NAME})\2\s*(?:\s#.*)?$""")
_INLINE = re.compile(r"""^(\s*)(?:-\s+)?["']?([\w.]+)["']?\s*:\s*\[(.*)\]\s*(?:\s#.*)?$""")
_HEAD = re.compile(r"""^(\s*)(?:-\s+)?["']?([\w.]+)["']?\s*:\s*(?:#.*)?$""")
_WORD = re.compile(rf"""(?:^|,)\s*(["']?)({PLUGIN_NAME})\1\s*(?=,|$)""")
#: Keys whose values are look-up names: of navigation, moveit, costmaps, ros2_control.
_SURE = re.compile(
    r"(?:\w*_)?plugins?|base_(?:global|local)_planner|kinematics_solver|planning_plugins?|(?:request|response)_adapters|capabilities"
)
#: Keys whose values are look-up names at times.
_PERHAPS = re.compile(r"type|class|class_name|\w*_class")


@dataclass(frozen=True, slots=True)
class PluginUse:
    """A name where a plug-in's is given; *is_sure* if nothing else can stand there."""

    name: str
    location: Location
    key: str
    is_sure: bool


def plugins_in_parameters(systems: Iterable[System]) -> Iterator[PluginUse]:
    """Those that launch files themselves set in parameters."""
    for system in systems:
        for each in system.parameters:
            key = each.name.replace("/", ".").rpartition(".")[2]
            if each.origin is None and each.location is not None and isinstance(each.value, str):
                is_sure = _SURE.fullmatch(key) is not None
                if re.fullmatch(PLUGIN_NAME, each.value) and (is_sure or _PERHAPS.fullmatch(key)):
                    yield PluginUse(each.value, each.location, key, is_sure)


def plugins_in_yaml(path: str, text: str) -> Iterator[PluginUse]:
    """Values and items of lists on one line each, which look-up names are; a key's list is what is indented below it."""
    if "::" not in text and "/" not in text:
        return
    heads: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        place = Location(path, number)
        head, item, inline = _HEAD.match(line), _ITEM.match(line), _INLINE.match(line)
        if head is not None:
            indent = len(head[1])
            heads = [each for each in heads if each[0] < indent] + [(indent, head[2])]
        elif item is not None:
            above = [each for each in heads if each[0] <= len(item[1])]
            key = above[-1][1] if above else ""
            if _SURE.fullmatch(key.rpartition(".")[2]):
                yield PluginUse(item[3], place, key, True)
        elif inline is not None and "{" not in inline[3]:
            key = inline[2]
            if _SURE.fullmatch(key.rpartition(".")[2]):
                for match in _WORD.finditer(inline[3]):
                    yield PluginUse(match[2], place, key, True)
        else:
            for match in _PAIR.finditer(line):
                key = match[1].rpartition(".")[2]
                if _SURE.fullmatch(key) or _PERHAPS.fullmatch(key):
                    yield PluginUse(match[3], place, match[1], bool(_SURE.fullmatch(key)))
