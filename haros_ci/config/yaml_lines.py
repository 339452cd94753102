# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin as values that know their lines, within fixed limits.

Works on parser events, so that neither nesting nor aliases are expanded before they are counted; no tag constructs
anything but a scalar, a list or a map.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, cast

from haros_ci.config.suggestion import quoted
from haros_ci.errors import UserError

if TYPE_CHECKING:
    import yaml

MAX_BYTES = 1_000_000
MAX_DEPTH = 50
MAX_ALIASES = 1_000
MAX_VALUES = 100_000
MAX_NUMBER = 100  # characters; YAML 1.1 base-60 numbers take quadratic time

Scalar = str | int | float | bool | None
_TAG = "tag:yaml.org,2002:"
_NO_TEXT = re.compile("[\0\ud800-\udfff]")
_SCALARS = {_TAG + name for name in ("str", "int", "float", "bool", "null", "timestamp", "value")}
_MERGE = _TAG + "merge"
_BREAK = re.compile("\r\n|[\r\n\x85\u2028\u2029]")  # what libyaml counts as the end of a line


@dataclass(frozen=True, slots=True)
class Value:
    """A scalar, list or map and the line it begins on; ``key_line`` is the line of the key it stands under.

    ``size`` counts the values in it, itself included, aliases as often as they are used.
    """

    line: int
    data: Scalar | tuple[Value, ...] | dict[Scalar, Value]
    key_line: int = 0
    size: int = 1


@dataclass(frozen=True, slots=True)
class Duplicate:
    """A key that stands twice in one map; the last one counts, as everywhere in YAML loaders."""

    key: Scalar
    line: int
    first: int


@dataclass(frozen=True, slots=True)
class Document:
    """A parsed file: its top value (None if it is empty) and its repeated keys."""

    top: Value | None
    duplicates: tuple[Duplicate, ...] = ()


def parse(data: bytes, name: str) -> Document:
    """Parse one YAML document; UserError with *name* and line for whatever is not plain, bounded data."""
    if len(data) > MAX_BYTES:
        raise UserError(f"{name}: larger than {MAX_BYTES} bytes", help="a project file is a page or two of settings")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as err:
        line = data.count(b"\n", 0, err.start) + 1
        raise UserError(f"{name}:{line}: not UTF-8 text", help="save the file as UTF-8") from err

    import yaml

    loader_class = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        loader = loader_class(text)
        try:
            return _Builder(yaml, loader, name).document()
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        lines = _BREAK.split(text)
        at = min(mark.line, len(lines) - 1) if mark else 0  # libyaml counts one more at an end without a line feed
        where = f"{name}:{at + 1}" if mark else name
        if "maximum nesting depth" in str(err.problem):  # libyaml's own limit; it looks ahead of what is built here
            raise UserError(f"{where}: nested deeper than {MAX_DEPTH} levels", help="flatten the file") from err
        tab = mark is not None and "\t" in _indent(lines[at])
        signs = "quote text that holds YAML's own signs, such as * or :"
        help_ = "indent with spaces: YAML forbids tabs" if tab else signs
        raise UserError(f"{where}: not valid YAML: {err.problem}", help=help_) from err
    except yaml.reader.ReaderError as err:
        odd = yaml.reader.Reader.NON_PRINTABLE.search(text)
        where = f"{name}:{text.count(chr(10), 0, odd.start()) + 1}" if odd else name
        raise UserError(f"{where}: not valid YAML: it holds a control character", help="remove it") from err


def plain(value: Value) -> object:
    """The value as bare lists, dicts and scalars."""
    match value.data:
        case dict():
            return {key: plain(item) for key, item in value.data.items()}
        case tuple():
            return [plain(item) for item in value.data]
        case _:
            return value.data


def _indent(here: str) -> str:
    return here[: len(here) - len(here.lstrip())]


@dataclass(slots=True)
class _Builder:
    """Turns the events of one document into a Value; recursion is bounded by MAX_DEPTH."""

    yaml: Any  # the module, imported only when there is a file to read
    loader: Any
    name: str
    anchors: dict[str, Value | None] = field(default_factory=dict)
    aliases: int = 0
    values: int = 0
    duplicates: list[Duplicate] = field(default_factory=list)

    def document(self) -> Document:
        self.loader.get_event()  # stream start
        if isinstance(self.loader.peek_event(), self.yaml.StreamEndEvent):
            return Document(None)
        self.loader.get_event()  # document start
        top = self.value(0)
        self.loader.get_event()  # document end
        after = self.loader.get_event()
        if not isinstance(after, self.yaml.StreamEndEvent):
            raise self.error(after, "a second document begins here", "keep one document in the file")
        return Document(top, tuple(self.duplicates))

    def value(self, depth: int) -> Value:
        event = self.loader.get_event()
        if isinstance(event, self.yaml.AliasEvent):
            return self.alias(event)
        if depth >= MAX_DEPTH:
            raise self.error(event, f"nested deeper than {MAX_DEPTH} levels", "flatten the file")
        if event.anchor is not None:
            self.anchors[event.anchor] = None  # known, but not complete: an alias to it inside it is a cycle
        if isinstance(event, self.yaml.ScalarEvent):
            made = Value(event.start_mark.line + 1, self.scalar(event))
        elif isinstance(event, self.yaml.SequenceStartEvent):
            made = self.sequence(event, depth)
        else:
            made = self.mapping(event, depth)
        self.count(event, 1)
        if event.anchor is not None:
            self.anchors[event.anchor] = made
        return made

    # haros: ignore[undefined-variable] imported for type checkers, above
    def alias(self, event: yaml.AliasEvent) -> Value:
        self.aliases += 1
        if self.aliases > MAX_ALIASES:
            raise self.error(event, f"more than {MAX_ALIASES} aliases", "write the values out")
        if event.anchor not in self.anchors:
            raise self.error(event, f"no anchor {quoted(event.anchor)}", "define it above, as &name")
        target = self.anchors[event.anchor]
        if target is None:
            raise self.error(event, f"{quoted(event.anchor)} contains itself", "a value cannot be part of itself")
        self.count(event, target.size)
        return replace(target, line=event.start_mark.line + 1)

    def sequence(self, event: yaml.SequenceStartEvent, depth: int) -> Value:
        self.check_tag(event, "seq")
        items: list[Value] = []
        while not isinstance(self.loader.peek_event(), self.yaml.SequenceEndEvent):
            items.append(self.value(depth + 1))
        self.loader.get_event()
        return Value(event.start_mark.line + 1, tuple(items), size=1 + sum(i.size for i in items))

    def mapping(self, event: yaml.MappingStartEvent, depth: int) -> Value:
        self.check_tag(event, "map")
        own: dict[Scalar, Value] = {}
        merged: list[dict[Scalar, Value]] = []
        while not isinstance(key_event := self.loader.peek_event(), self.yaml.MappingEndEvent):
            is_merge = isinstance(key_event, self.yaml.ScalarEvent) and self.tag(key_event) == _MERGE
            key = "<<" if is_merge else self.key(depth)
            if is_merge:
                self.loader.get_event()
            item = self.value(depth + 1)
            line = key_event.start_mark.line + 1
            if is_merge:
                merged.extend(self.merged(key_event, item))
                continue
            if key in own:
                self.duplicates.append(Duplicate(key, line, own[key].key_line))
            own[key] = replace(item, key_line=line)
        self.loader.get_event()
        entries: dict[Scalar, Value] = {}
        for base in reversed(merged):  # the first merged map wins, own keys win over all (yaml.org/type/merge)
            entries.update(base)
        entries.update(own)
        return Value(event.start_mark.line + 1, entries, size=1 + sum(1 + v.size for v in entries.values()))

    def key(self, depth: int) -> Scalar:
        event = self.loader.peek_event()
        key = self.value(depth + 1).data
        if isinstance(key, (dict, tuple)):
            raise self.error(event, "a list or map cannot be a key", "use text as the key")
        return key

    def merged(self, event: yaml.ScalarEvent, item: Value) -> list[dict[Scalar, Value]]:
        maps = item.data if isinstance(item.data, tuple) else (item,)
        if not all(isinstance(m.data, dict) for m in maps):
            raise self.error(event, "'<<' merges maps only", "give it an alias of a map")
        return [cast("dict[Scalar, Value]", m.data) for m in maps]

    def scalar(self, event: yaml.ScalarEvent) -> Scalar:
        tag = self.tag(event)
        if _NO_TEXT.search(event.value):
            raise self.error(
                event,
                "the text holds NUL or half a character, which no path and no name can hold",
                "remove \\0 or \\ud8..",
            )
        if tag not in _SCALARS and tag != _MERGE:
            raise self.error(event, f"tag {quoted(event.tag)} is not allowed", "write plain text, numbers, lists, maps")
        if tag not in (_TAG + "int", _TAG + "float", _TAG + "bool", _TAG + "null"):
            return str(event.value)
        if len(event.value) > MAX_NUMBER:
            raise self.error(event, "number too long", "quote it if it is text")
        node = self.yaml.ScalarNode(tag, event.value, event.start_mark, event.end_mark)
        try:
            return cast(Scalar, self.loader.construct_object(node))
        except (ValueError, KeyError, IndexError, OverflowError) as err:
            kind = tag.removeprefix(_TAG)
            raise self.error(event, f"{quoted(event.value)} is no {kind}", "fix or quote it") from err

    def tag(self, event: yaml.ScalarEvent) -> str:
        if event.tag is not None and event.tag != "!":
            return str(event.tag)
        return str(self.loader.resolve(self.yaml.ScalarNode, event.value, event.implicit))

    def check_tag(self, event: Any, kind: str) -> None:
        if event.tag not in (None, "!", _TAG + kind):
            raise self.error(event, f"tag {quoted(event.tag)} is not allowed", "write plain lists and maps")

    def count(self, event: Any, values: int) -> None:
        self.values += values
        if self.values > MAX_VALUES:
            raise self.error(event, f"more than {MAX_VALUES} values, aliases counted", "shorten the file")

    def error(self, event: Any, message: str, help_: str) -> UserError:
        return UserError(f"{self.name}:{event.start_mark.line + 1}: {message}", help=help_)
