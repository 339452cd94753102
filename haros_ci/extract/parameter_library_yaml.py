# SPDX-License-Identifier: Apache-2.0
"""The YAML of a parameter library as values with their places, within fixed limits and without constructing objects."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

MAX_CHARACTERS = 1_000_000
MAX_DEPTH = 50
MAX_ALIASES = 1_000
MAX_VALUES = 20_000
#: Characters of a number: those of YAML 1.1 in base 60 take quadratic time.
MAX_NUMBER = 100

Scalar = str | int | float | bool | None
_TAG = "tag:yaml.org,2002:"
_PLAIN = frozenset(_TAG + name for name in ("str", "int", "float", "bool", "null"))


@dataclass(frozen=True, slots=True)
class Value:
    """A scalar, list or map. *line* and *column*, 1-based, are those of its key, else its own; *size* counts values."""

    line: int
    column: int
    data: Scalar | tuple[Value, ...] | dict[Scalar, Value]
    size: int = 1


class YamlFault(Exception):
    """The text is not plain, bounded YAML: *message* says why and what to do, *line* where."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message = message
        self.line = line


def parse_yaml(text: str) -> Value | None:
    """The first document of *text*, None if it is empty; YamlFault for what is malformed or over a limit."""
    if len(text) > MAX_CHARACTERS:
        raise YamlFault(f"more than {MAX_CHARACTERS} characters; split it", 1)
    import yaml

    try:
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)(text)
        try:
            return _Builder(yaml, loader).document()
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        raise YamlFault(f"not valid YAML ({err.problem}); correct it", mark.line + 1 if mark else 1) from err
    except (yaml.YAMLError, UnicodeError) as err:
        raise YamlFault("not valid YAML: it holds a control character; remove it", 1) from err


class _Builder:
    """Makes values of parser events; recursion is bounded by MAX_DEPTH."""

    def __init__(self, yaml: Any, loader: Any) -> None:
        self.yaml = yaml
        self.loader = loader
        self.scalars = yaml.constructor.SafeConstructor()
        self.anchors: dict[str, Value | None] = {}
        self.aliases = 0
        self.values = 0

    def document(self) -> Value | None:
        self.loader.get_event()  # the stream's start
        if isinstance(self.loader.peek_event(), self.yaml.StreamEndEvent):
            return None
        self.loader.get_event()  # the document's start
        return self.value(0)

    def value(self, depth: int) -> Value:
        event = self.loader.get_event()
        line, column = event.start_mark.line + 1, event.start_mark.column + 1
        if isinstance(event, self.yaml.AliasEvent):
            return self.alias(event.anchor, line)
        if depth >= MAX_DEPTH:
            raise YamlFault(f"nested deeper than {MAX_DEPTH} levels; flatten it", line)
        self.count(1, line)
        if event.anchor is not None:
            self.anchors[event.anchor] = None
        if isinstance(event, self.yaml.ScalarEvent):
            made = Value(line, column, self.scalar(event, line))
        elif isinstance(event, self.yaml.SequenceStartEvent):
            items = []
            while not isinstance(self.loader.peek_event(), self.yaml.SequenceEndEvent):
                items.append(self.value(depth + 1))
            self.loader.get_event()
            made = Value(line, column, tuple(items), 1 + sum(item.size for item in items))
        else:
            entries = self.entries(depth)
            made = Value(line, column, entries, 1 + sum(item.size for item in entries.values()))
        if event.anchor is not None:
            self.anchors[event.anchor] = made
        return made

    def entries(self, depth: int) -> dict[Scalar, Value]:
        """A map's items, with the places of their keys; of a key that stands twice the last counts."""
        found: dict[Scalar, Value] = {}
        merged: dict[Scalar, Value] = {}
        while not isinstance(self.loader.peek_event(), self.yaml.MappingEndEvent):
            key = self.value(depth + 1)
            item = self.value(depth + 1)
            if isinstance(key.data, tuple | dict):
                raise YamlFault("a list or map is the key of a map; use a text", key.line)
            if key.data == "<<":
                parts = item.data if isinstance(item.data, tuple) else (item,)
                for part in reversed(parts):
                    merged.update(part.data if isinstance(part.data, dict) else {})
            else:
                found[key.data] = Value(key.line, key.column, item.data, item.size)
        self.loader.get_event()
        return {**merged, **found}

    def alias(self, name: str, line: int) -> Value:
        self.aliases += 1
        if self.aliases > MAX_ALIASES:
            raise YamlFault(f"more than {MAX_ALIASES} aliases; write the values out", line)
        known = self.anchors.get(name)
        if known is None:
            raise YamlFault(f"*{name[:60]} refers to nothing that is complete; define &{name[:60]} before it", line)
        self.count(known.size, line)
        return known

    def count(self, number: int, line: int) -> None:
        self.values += number
        if self.values > MAX_VALUES:
            raise YamlFault(f"more than {MAX_VALUES} values, aliases counted; split it", line)

    def scalar(self, event: Any, line: int) -> Scalar:
        """The value by YAML 1.1, as PyYAML resolves it; dates and the like stay text."""
        written = str(event.value)
        tag = event.tag
        if tag is None or tag == "!":
            tag = self.loader.resolve(self.yaml.ScalarNode, written, event.implicit)
        if tag not in _PLAIN:
            return written
        if tag == f"{_TAG}str":
            return written
        if len(written) > MAX_NUMBER:
            raise YamlFault("a number that is too long; shorten it", line)
        node = self.yaml.ScalarNode(tag, written, event.start_mark, event.end_mark)
        try:
            made = self.scalars.construct_object(node)
        except (ValueError, LookupError, ArithmeticError) as err:
            raise YamlFault(f"{written[:60]!r} is not of its type; correct it", line) from err
        return made if isinstance(made, str | int | float | bool) else None
