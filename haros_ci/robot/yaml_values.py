# SPDX-License-Identifier: Apache-2.0
"""YAML files that a description loads (xacro.load_yaml), as plain values: safe tags and xacro's units only, aliases bounded."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import yaml

from haros_ci.bounded_yaml import MAX_NUMBER, MERGE, TAG, YamlFault, YamlLimits, nodes, scalar_value
from haros_ci.robot.unknown import UNKNOWN

MAX_NODES = 50_000
MAX_DEPTH = 60
LIMITS = YamlLimits(characters=500_000, depth=MAX_DEPTH, values=MAX_NODES)
#: The tags that xacro adds for units, with what they are multiplied by.
UNITS = {
    "!radians": 1.0,
    "!degrees": math.pi / 180.0,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}


class YamlDict(dict[Any, Any]):
    """A mapping whose keys can be had with a dot, as xacro wraps them."""


class _YamlTooLarge(Exception):
    pass


def yaml_value(text: str, number: Callable[[str], object]) -> object:
    """The value of the first document of *text*; UNKNOWN if it cannot be read. *number* evaluates what stands after a unit."""
    try:
        documents = list(nodes(text, LIMITS))
        if len(documents) > 1:
            return UNKNOWN
        return _YamlReader(number).value(documents[0], 0) if documents else None
    except (YamlFault, yaml.YAMLError, _YamlTooLarge, RecursionError, ValueError, OverflowError):
        return UNKNOWN


class _YamlReader:
    def __init__(self, number: Callable[[str], object]) -> None:
        self.number = number
        self.left = MAX_NODES

    def value(self, node: yaml.Node, depth: int) -> object:
        self.left -= 1
        if self.left < 0 or depth > MAX_DEPTH:
            raise _YamlTooLarge
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node)
        if isinstance(node, yaml.SequenceNode):
            return [self.value(child, depth + 1) for child in node.value]
        return self._mapping(node, depth) if isinstance(node, yaml.MappingNode) else UNKNOWN

    def _mapping(self, node: yaml.MappingNode, depth: int) -> object:
        found = YamlDict()
        merged = YamlDict()
        for key, child in node.value:
            if key.tag == MERGE:
                for item in child.value if isinstance(child, yaml.SequenceNode) else (child,):
                    values = self.value(item, depth + 1)
                    if isinstance(values, YamlDict):
                        merged = YamlDict({**values, **merged})
                continue
            name = self.value(key, depth + 1)
            if not isinstance(name, (str, int, float, bool, type(None))):
                return UNKNOWN
            found[name] = self.value(child, depth + 1)
        return YamlDict({**merged, **found})

    def _scalar(self, node: yaml.ScalarNode) -> object:
        if node.tag in UNITS:
            value = self.number(node.value)
            if isinstance(value, (int, float)):
                return float(value) * UNITS[node.tag]
            return UNKNOWN
        if node.tag == TAG + "str":
            return str(node.value)
        kind = node.tag.removeprefix(TAG)
        if kind not in ("int", "float", "bool", "null") or len(node.value) > MAX_NUMBER:
            return UNKNOWN
        return scalar_value(kind, node.value)
