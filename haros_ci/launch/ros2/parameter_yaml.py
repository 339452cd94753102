# SPDX-License-Identifier: Apache-2.0
"""Parameter files as trees of scalars that know their lines, within fixed limits, and what ROS 2 makes of a scalar.

A node's process reads them with rcl_yaml_param_parser, launch reads those of composable nodes with PyYAML: the two
differ in what is a number and what is a boolean.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any, Union

from haros_ci.bounded_yaml import MAX_NUMBER, MERGE, TAG, YamlFault, YamlLimits, nodes, scalar_value
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK, Text

MAX_DEPTH = 50
MAX_VALUES = 50_000
LIMITS = YamlLimits(depth=MAX_DEPTH)
#: Scalars of which it is remembered what they mean: many nodes get the same file.
REMEMBERED = 1 << 14

_TRUE = frozenset(("Y", "y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"))
_FALSE = frozenset(("N", "n", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"))
_INTEGER = regex(r"[+-]?(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)\Z")
_FLOAT = regex(r"[+-]?([0-9]+(?:\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?\Z")
_NO_NUMBER = regex(r"[+-]?\.?(nan|inf|infinity)\Z", re.IGNORECASE)
_INT64 = range(-(2**63), 2**63)


@dataclass(frozen=True, slots=True)
class Scalar:
    """A scalar as written: *is_plain* without quotes, *tag* as PyYAML resolves it; *reasons* of its unknown parts."""

    text: str
    line: int
    is_plain: bool = True
    tag: str = "str"
    reasons: tuple[str, ...] = ()


@dataclass(slots=True)
class Map:
    """A map with the lines of its keys."""

    entries: dict[str, Tree]
    line: int


@dataclass(slots=True)
class Items:
    items: list[Tree]
    line: int


Tree = Union[Scalar, Map, Items]


def read_trees(text: Text) -> tuple[Tree, ...]:
    """The documents of *text*; YamlFault for what is not YAML or over a limit. Unknown parts stay inside scalars."""
    reader = _Trees(text)
    return tuple(reader.tree(node, 0) for node in nodes(text.raw, LIMITS))


@dataclass(slots=True)
class _Trees:
    text: Text
    values: int = 0

    def tree(self, node: Any, depth: int) -> Tree:
        self.values += 1
        line = node.start_mark.line + 1
        if depth > MAX_DEPTH or self.values > MAX_VALUES:
            raise YamlFault("an alias contains itself, or there are too many values; write them out", line)
        if node.id == "scalar":
            return self.scalar(node, line)
        if node.id == "sequence":
            return Items([self.tree(item, depth + 1) for item in node.value], line)
        found: dict[str, Tree] = {}
        merged: dict[str, Tree] = {}
        for key, value in node.value:
            made = self.tree(value, depth + 1)
            if key.id != "scalar":
                continue
            if key.tag == MERGE:
                for part in made.items if isinstance(made, Items) else [made]:
                    if isinstance(part, Map):
                        merged = {**part.entries, **merged}
                continue
            if isinstance(made, Scalar):
                made = Scalar(made.text, key.start_mark.line + 1, made.is_plain, made.tag, made.reasons)
            found[str(key.value)] = made
        return Map({**merged, **found}, line)

    def scalar(self, node: Any, line: int) -> Scalar:
        reasons: tuple[str, ...] = ()
        if MARK in node.value:
            first = self.text.raw.count(MARK, 0, node.start_mark.index)
            reasons = self.text.reasons[first : first + node.value.count(MARK)] or ("part of it is not known",)
        return Scalar(node.value, line, node.style in (None, ""), node.tag.removeprefix(TAG), reasons)


@lru_cache(maxsize=REMEMBERED)
def rcl_value(scalar: Scalar) -> tuple[str | None, Any, str]:
    """Type, value and, where it is not known, the reason, as rcl_yaml_param_parser reads *scalar* (``get_value``).

    Plain words of YAML 1.1 such as ``y`` and ``on`` are booleans; numbers are what C's strtoll (base 0) and strtod
    take; all else is text, ``null`` and ``~`` too.
    """
    if scalar.reasons:
        return (None if scalar.is_plain else "str"), None, _joined(scalar.reasons)
    text = scalar.text
    if not scalar.is_plain:
        return "str", text, ""
    if text in _TRUE or text in _FALSE:
        return "bool", text in _TRUE, ""
    if len(text) <= MAX_NUMBER:
        if _INTEGER.match(text):
            number = _integer(text)
            if number in _INT64:
                return "int", number, ""
        if _FLOAT.match(text):
            value = float(text)
            return ("double", value, "") if math.isfinite(value) else ("double", None, f"'{text}' is too large")
        if _NO_NUMBER.match(text):
            return "double", None, f"'{text}' is no number that can be shown"
    return "str", text, ""


@lru_cache(maxsize=REMEMBERED)
def python_value(scalar: Scalar) -> tuple[str | None, Any, str]:
    """Type, value and, where the value is not known, the reason, as PyYAML's ``safe_load`` reads *scalar*."""
    if scalar.reasons:
        return (None if scalar.is_plain else "str"), None, _joined(scalar.reasons)
    if scalar.tag not in ("int", "float", "bool", "null") or len(scalar.text) > MAX_NUMBER:
        return "str", scalar.text, ""
    if scalar.tag == "null":
        return None, None, "it has no value (null)"
    try:
        value = scalar_value(scalar.tag, scalar.text)
    except ValueError:
        return None, None, f"'{scalar.text}' is no {scalar.tag}"
    if isinstance(value, float) and not math.isfinite(value):
        return "double", None, f"'{scalar.text}' is no number that can be shown"
    return type_of(value), value, ""


def size_of(tree: Tree) -> int:
    """How many values *tree* consists of."""
    if isinstance(tree, Map):
        return 1 + sum(size_of(value) for value in tree.entries.values())
    return 1 + sum(size_of(item) for item in tree.items) if isinstance(tree, Items) else 1


def type_of(value: Any) -> str | None:
    """The parameter type of a plain scalar."""
    return {bool: "bool", int: "int", float: "double", str: "str"}.get(type(value))


def dumped(value: Any, line: int) -> Scalar:
    """A plain value as ``yaml.dump`` writes it: text in quotes only where PyYAML would take it for something else."""
    if isinstance(value, bool):
        return Scalar("true" if value else "false", line, tag="bool")
    if isinstance(value, int):
        return Scalar(str(value), line, tag="int")
    if isinstance(value, float):
        return Scalar(repr(value), line, tag="float")
    if value is None:
        return Scalar("null", line, tag="null")
    text = str(value)
    import yaml

    resolver: Any = yaml.resolver.Resolver()  # its methods have no types
    tag = resolver.resolve(yaml.ScalarNode, text, (True, False))
    plain = tag == TAG + "str" and re.fullmatch(r"[A-Za-z0-9_.+-]+", text) is not None and not text.startswith("-.")
    return Scalar(text, line, is_plain=plain)


def _integer(text: str) -> int:
    sign, digits = (-1, text[1:]) if text[0] == "-" else (1, text.lstrip("+"))
    base = 16 if digits[:2] in ("0x", "0X") else 8 if len(digits) > 1 and digits[0] == "0" else 10
    return sign * int(digits, base)


def _joined(reasons: tuple[str, ...]) -> str:
    return "; ".join(dict.fromkeys(reasons))
