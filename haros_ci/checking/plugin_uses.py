# SPDX-License-Identifier: Apache-2.0
"""Where parameters name plug-ins of pluginlib: in YAML files, and in what launch files set."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from haros_ci.bounded_yaml import YamlFault, YamlLimits, nodes
from haros_ci.checking.system import System
from haros_ci.model.architecture import Parameter
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

if TYPE_CHECKING:
    import yaml

#: The look-up name of a plug-in: ``package/Class`` or ``space::Class``.
PLUGIN_NAME = r"[A-Za-z_]\w*(?:(?:::|/)[A-Za-z_]\w*)+"
_PAIR = regex(rf"""(?:^|[\s,{{\[])["']?([\w.]+)["']?\s*:\s*(["']?)({PLUGIN_NAME})\2\s*(?=[,}}\]]|\s#|$)""")
_ITEM = regex(rf"""^(\s*)-\s+(["']?)({PLUGIN_NAME})\2\s*(?:\s#.*)?$""")
_INLINE = regex(r"""^(\s*)(?:-\s+)?["']?([\w.]+)["']?\s*:\s*\[(.*)\]\s*(?:\s#.*)?$""")
_HEAD = regex(r"""^(\s*)(?:-\s+)?["']?([\w.]+)["']?\s*:\s*(?:#.*)?$""")
_WORD = regex(rf"""(?:^|,)\s*(["']?)({PLUGIN_NAME})\1\s*(?=,|$)""")
#: Keys whose values are look-up names: of navigation, moveit, costmaps, ros2_control.
_SURE = regex(
    r"(?:\w*_)?plugins?|base_(?:global|local)_planner|kinematics_solver|planning_plugins?|(?:request|response)_adapters|capabilities"
)
#: Keys whose values are look-up names at times.
_PERHAPS = regex(r"type|class|class_name|\w*_class")

#: Keys whose values are the names of sections, each with a plug-in, and names as they may be.
_IDS = regex(r"(?:\w*_)?plugins?|\w+_plugin_(?:ids?|names?|types?)")
_ID = regex(r"[A-Za-z_][\w.-]*")
_LIMITS = YamlLimits(characters=500_000, depth=50, values=50_000, aliases=100)


@dataclass(frozen=True, slots=True)
class PluginUse:
    """A name where a plug-in's is given; *is_sure* if nothing else can stand there."""

    name: str
    location: Location
    key: str
    is_sure: bool


def plugins_in_parameters(
    systems: Iterable[System],
    is_selected: Callable[[System, Parameter, str], bool] = lambda system, parameter, key: True,
) -> Iterator[PluginUse]:
    """Plug-in names that launch files set in parameters for which *is_selected* (system, parameter, last part of its name) is true."""
    for system in systems:
        for parameter in system.parameters:
            key = parameter.name.replace("/", ".").rpartition(".")[2]
            if parameter.origin is None and parameter.location is not None and isinstance(parameter.value, str):
                is_sure = _SURE.fullmatch(key) is not None
                is_named = re.fullmatch(PLUGIN_NAME, parameter.value) and (is_sure or _PERHAPS.fullmatch(key))
                if is_named and is_selected(system, parameter, key):
                    yield PluginUse(parameter.value, parameter.location, key, is_sure)


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
            heads = [head for head in heads if head[0] < indent] + [(indent, head[2])]
        elif item is not None:
            above = [head for head in heads if head[0] <= len(item[1])]
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


@dataclass(frozen=True, slots=True)
class Unlisted:
    """A *section* for a plug-in that the lists beside it do not name; *key* is the first of these, on *line*."""

    section: str
    key: str
    line: int


def unlisted_plugins(text: str) -> Mapping[int, Unlisted]:
    """By the lines of their plug-ins the sections that no list of names beside them has, where there is one: nothing loads them."""
    import yaml

    found: dict[int, Unlisted] = {}
    try:
        waiting = list(nodes(text, _LIMITS)) if "plugin" in text else []
    except YamlFault:
        return {}
    seen: set[int] = set()
    while waiting:
        node = waiting.pop()
        if id(node) in seen or isinstance(node.value, str):
            continue
        seen.add(id(node))
        if isinstance(node, yaml.SequenceNode):
            waiting += node.value
            continue
        pairs = [(key.value, key, value) for key, value in node.value if isinstance(key.value, str)]
        waiting += [value for _, _, value in pairs]
        names, lists = _named(pairs)
        for section, _, value in pairs if lists else ():
            held = value.value if isinstance(value, yaml.MappingNode) else []
            plugins = [item for key, item in held if key.value == "plugin"]
            if plugins and section not in names:
                found[plugins[0].start_mark.line + 1] = Unlisted(section, lists[0][0], lists[0][1])
    return found


def _named(pairs: list[tuple[str, yaml.Node, yaml.Node]]) -> tuple[set[str], list[tuple[str, int]]]:
    """The names that the lists among *pairs* have, and these lists with their lines; none if one has what is no name."""
    import yaml

    names: set[str] = set()
    lists: list[tuple[str, int]] = []
    for text, key, value in pairs:
        if _IDS.fullmatch(text) and not isinstance(value, yaml.MappingNode):
            items = value.value if isinstance(value, yaml.SequenceNode) else [value]
            if not all(isinstance(item.value, str) and _ID.fullmatch(item.value) for item in items):
                return set(), []
            names |= {item.value for item in items}
            if isinstance(value, yaml.SequenceNode) and items:
                lists.append((text, key.start_mark.line + 1))
    return names, lists
