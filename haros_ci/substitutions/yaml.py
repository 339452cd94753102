# SPDX-License-Identifier: Apache-2.0
"""YAML of ``<rosparam>`` as values that know their lines, within fixed limits; nothing is constructed but plain data.

As rosparam reads it (wiki rosparam, "YAML format"): YAML 1.1, ``deg(...)``, ``rad(...)``, ``!degrees``, ``!radians``.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field, replace
from typing import Any

from haros_ci.substitutions.expression import Scopes, Undecided, Wrong, compute
from haros_ci.substitutions.names import MARK, Text, quoted, unknown

MAX_DEPTH = 50
MAX_ALIASES = 1_000
MAX_VALUES = 50_000
MAX_CHARACTERS = 1_000_000
MAX_NUMBER = 100

_TAG = "tag:yaml.org,2002:"
_SCALARS = {_TAG + name for name in ("str", "int", "float", "bool", "null", "timestamp", "value", "binary")}
_MERGE = _TAG + "merge"
_ANGLE = re.compile(r"(deg|rad)\([^)]*\)\Z")
_ANGLES = {"!degrees": "deg", "!radians": "rad"}


class YamlError(Exception):
    """Not YAML that roslaunch can load, or refused; *line* is 1-based."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.line = line


@dataclass(frozen=True, slots=True)
class Opaque:
    """A scalar whose value is not known: *type* is its parameter type if known, *unknown* its text."""

    reason: str
    type: str | None = None
    shown: str | None = None
    unknown: Text | None = None


@dataclass(frozen=True, slots=True)
class YamlValue:
    """A scalar, list or map; *line* is the line that says it, that of its key inside a map. *size* counts values."""

    line: int
    data: Any
    size: int = 1


def read_yaml(text: Text) -> YamlValue:
    """The one document in *text*, None as data if it is empty; YamlError for what roslaunch or a limit refuses."""
    if len(text.raw) > MAX_CHARACTERS:
        raise YamlError(f"more than {MAX_CHARACTERS} characters; split it", 1)
    import yaml

    try:
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)(text.raw)
        try:
            return _Composer(yaml, loader, text).document()
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        raise YamlError(f"not valid YAML: {err.problem}; correct it", mark.line + 1 if mark else 1) from err
    except yaml.YAMLError as err:
        raise YamlError("not valid YAML: it holds a control character; remove it", 1) from err


def plain(data: Any) -> object:
    """*data* as bare lists, maps and scalars. Opaque parts must have been excluded."""
    if isinstance(data, dict):
        return {str(key): plain(item.data) for key, item in data.items()}
    return [plain(item.data) for item in data] if isinstance(data, tuple) else data


def parts(value: YamlValue) -> list[Any]:
    """*value*'s data and those of everything in it, keys included."""
    found: list[Any] = []
    todo = [value.data]
    while todo:
        data = todo.pop()
        found.append(data)
        if isinstance(data, dict):
            todo.extend((*data.keys(), *(item.data for item in data.values())))
        elif isinstance(data, tuple):
            todo.extend(item.data for item in data)
    return found


@dataclass(slots=True)
class _Composer:
    """Makes values of the events of one document; recursion is bounded by MAX_DEPTH."""

    yaml: Any
    loader: Any
    text: Text
    anchors: dict[str, YamlValue | None] = field(default_factory=dict)
    aliases: int = 0
    values: int = 0

    def document(self) -> YamlValue:
        self.loader.get_event()
        if isinstance(self.loader.peek_event(), self.yaml.StreamEndEvent):
            return YamlValue(1, None)
        self.loader.get_event()
        top = self.value(0)
        self.loader.get_event()
        after = self.loader.get_event()
        if not isinstance(after, self.yaml.StreamEndEvent):
            raise self.error(after, "a second document begins here; keep one")
        return top

    def value(self, depth: int) -> YamlValue:
        event = self.loader.get_event()
        if isinstance(event, self.yaml.AliasEvent):
            return self.alias(event)
        if depth >= MAX_DEPTH:
            raise self.error(event, f"nested deeper than {MAX_DEPTH} levels; flatten it")
        if event.anchor is not None:
            self.anchors[event.anchor] = None
        if isinstance(event, self.yaml.ScalarEvent):
            made = YamlValue(event.start_mark.line + 1, self.scalar(event))
        elif isinstance(event, self.yaml.SequenceStartEvent):
            made = self.sequence(event, depth)
        else:
            made = self.mapping(event, depth)
        self.count(event, 1)
        if event.anchor is not None:
            self.anchors[event.anchor] = made
        return made

    def alias(self, event: Any) -> YamlValue:
        self.aliases += 1
        if self.aliases > MAX_ALIASES:
            raise self.error(event, f"more than {MAX_ALIASES} aliases; write the values out")
        target = self.anchors.get(event.anchor)
        if target is None:
            problem = "contains itself" if event.anchor in self.anchors else "is not defined above"
            raise self.error(event, f"alias {quoted(event.anchor)} {problem}; write the value out")
        self.count(event, target.size)
        return replace(target, line=event.start_mark.line + 1)

    def sequence(self, event: Any, depth: int) -> YamlValue:
        self.check_tag(event, "seq")
        items: list[YamlValue] = []
        while not isinstance(self.loader.peek_event(), self.yaml.SequenceEndEvent):
            items.append(self.value(depth + 1))
        self.loader.get_event()
        return YamlValue(event.start_mark.line + 1, tuple(items), 1 + sum(item.size for item in items))

    def mapping(self, event: Any, depth: int) -> YamlValue:
        self.check_tag(event, "map")
        own: dict[Any, YamlValue] = {}
        merged: list[dict[Any, YamlValue]] = []
        while not isinstance(key_event := self.loader.peek_event(), self.yaml.MappingEndEvent):
            line = key_event.start_mark.line + 1
            is_merge = isinstance(key_event, self.yaml.ScalarEvent) and self.tag(key_event) == _MERGE
            key = self.value(depth + 1).data
            item = self.value(depth + 1)
            if is_merge:
                merged.extend(self.merged(key_event, item))
            elif isinstance(key, (dict, tuple)):
                raise self.error(key_event, "a list or map cannot be a key; use text")
            else:
                own[key] = replace(item, line=line)
        self.loader.get_event()
        entries: dict[Any, YamlValue] = {}
        for base in reversed(merged):
            entries.update(base)
        entries.update(own)
        return YamlValue(event.start_mark.line + 1, entries, 1 + sum(1 + item.size for item in entries.values()))

    def merged(self, event: Any, item: YamlValue) -> list[dict[Any, YamlValue]]:
        maps = [part.data for part in item.data] if isinstance(item.data, tuple) else [item.data]
        if not all(isinstance(part, dict) for part in maps):
            raise self.error(event, "'<<' merges maps only; give it an alias of a map")
        return maps

    def scalar(self, event: Any) -> Any:
        tag = self.tag(event)
        if MARK in event.value:
            return self.unknown(event, tag)
        angle = _ANGLES.get(tag)
        if angle is not None:
            return self.angle(event, angle)
        if tag not in _SCALARS and tag != _MERGE:
            raise self.error(event, f"tag {quoted(tag)} is not known to roslaunch; write plain data")
        kind = tag.removeprefix(_TAG)
        if kind == "binary":
            return Opaque("binary data (base64), which is none of the plain types")
        if kind == "timestamp":
            return Opaque("a date, which is none of the plain types; quote it if it is text", shown=event.value)
        if kind not in ("int", "float", "bool", "null"):
            return str(event.value)
        if len(event.value) > MAX_NUMBER:
            raise self.error(event, "number too long; quote it if it is text")
        node = self.yaml.ScalarNode(tag, event.value, event.start_mark, event.end_mark)
        try:
            return self.loader.construct_object(node)
        except (ValueError, KeyError, IndexError, OverflowError) as err:
            raise self.error(event, f"{quoted(event.value)} is no {kind}; correct or quote it") from err

    def unknown(self, event: Any, tag: str) -> Opaque:
        first = self.text.raw.count(MARK, 0, event.start_mark.index)
        count = event.value.count(MARK)
        reasons = self.text.reasons[first : first + count] or ("part of it is not known",)
        is_text = not event.implicit[0] or "/" in event.value or (tag == _TAG + "str" and event.tag is not None)
        text = Text(event.value, tuple((*reasons, *reasons * count)[:count]))
        return Opaque("; ".join(dict.fromkeys(reasons)), "str" if is_text else None, text.shown, text)

    def angle(self, event: Any, kind: str) -> Any:
        """``deg(90)``, ``!degrees 90``: a number; ``rad(pi/2)``, ``!radians pi/2``: an expression."""
        source = event.value.strip()
        if source.startswith(kind + "("):
            source = source[4:-1]
        try:
            if kind == "deg":
                return float(source[:MAX_NUMBER]) * math.pi / 180.0
            number = compute(source, Scopes({}, unknown, {}, ""))
            return float(str(number)) if isinstance(number, (int, float)) else self.no_angle(event)
        except Undecided as err:
            return Opaque(str(err).replace("$(eval ...)", quoted(event.value)), "double")
        except (ValueError, OverflowError, Wrong):
            return self.no_angle(event)

    def no_angle(self, event: Any) -> Any:
        raise self.error(event, f"{quoted(event.value)} is no angle; write deg(90) or rad(pi/2)")

    def tag(self, event: Any) -> str:
        if event.tag is not None and event.tag != "!":
            return str(event.tag)
        match = _ANGLE.match(event.value) if event.implicit[0] else None
        if match:
            return "!degrees" if match[1] == "deg" else "!radians"
        return str(self.loader.resolve(self.yaml.ScalarNode, event.value, event.implicit))

    def check_tag(self, event: Any, kind: str) -> None:
        if event.tag not in (None, "!", _TAG + kind):
            raise self.error(event, f"tag {quoted(event.tag)} is not allowed; write plain lists and maps")

    def count(self, event: Any, values: int) -> None:
        self.values += values
        if self.values > MAX_VALUES:
            raise self.error(event, f"more than {MAX_VALUES} values, aliases counted; split it")

    def error(self, event: Any, message: str) -> YamlError:
        return YamlError(message, event.start_mark.line + 1)
