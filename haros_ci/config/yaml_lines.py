# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin as values that know their lines, within fixed limits.

Neither nesting nor aliases are expanded before they are counted; no tag constructs anything but a scalar, a list or a map.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar

from haros_ci.bounded_yaml import MERGE, TAG, Composer, Scalar, YamlFault, YamlLimits
from haros_ci.config.suggestion import quoted
from haros_ci.errors import UserError
from haros_ci.records import dataclass
from haros_ci.regex import regex

MAX_BYTES = 1_000_000
MAX_DEPTH = 50
MAX_ALIASES = 1_000
MAX_VALUES = 100_000
LIMITS = YamlLimits(MAX_BYTES, MAX_DEPTH, MAX_VALUES, MAX_ALIASES)

_NO_TEXT = regex("[\0\ud800-\udfff]")
_NUMBERS = {TAG + name for name in ("int", "float", "bool", "null")}
_SCALARS = _NUMBERS | {TAG + name for name in ("str", "timestamp", "value")}
_BREAK = regex("\r\n|[\r\n\x85\u2028\u2029]")  # what libyaml counts as the end of a line


@dataclass(frozen=True, slots=True)
class YamlValue:
    """A scalar, list or map and the line it begins on; ``key_line`` is the line of the key it stands under.

    ``size`` counts the values in it, itself included, aliases as often as they are used.
    """

    line: int
    data: Scalar | tuple[YamlValue, ...] | dict[Scalar, YamlValue]
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

    top: YamlValue | None
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

    composer = _LineComposer(text)
    try:
        top = composer.document()
    except YamlFault as fault:
        raise _refused(fault, text, name) from fault
    return Document(top, tuple(composer.duplicates))


def _refused(fault: YamlFault, text: str, name: str) -> UserError:
    """*fault* as it is said of the file *name*; what the parser says itself is placed and advised on here."""
    import yaml

    err = fault.__cause__
    if isinstance(err, yaml.MarkedYAMLError):
        mark = err.problem_mark or err.context_mark
        lines = _BREAK.split(text)
        at = min(mark.line, len(lines) - 1) if mark else 0  # libyaml counts one more at an end without a line feed
        where = f"{name}:{at + 1}" if mark else name
        if "maximum nesting depth" in str(err.problem):  # libyaml's own limit; it looks ahead of what is built here
            return UserError(f"{where}: nested deeper than {MAX_DEPTH} levels", help="flatten the file")
        tab = mark is not None and "\t" in _indent(lines[at])
        signs = "quote text that holds YAML's own signs, such as * or :"
        help_ = "indent with spaces: YAML forbids tabs" if tab else signs
        return UserError(f"{where}: not valid YAML: {err.problem}", help=help_)
    if isinstance(err, yaml.reader.ReaderError):
        odd = yaml.reader.Reader.NON_PRINTABLE.search(text)
        where = f"{name}:{text.count(chr(10), 0, odd.start()) + 1}" if odd else name
        return UserError(f"{where}: not valid YAML: it holds a control character", help="remove it")
    return UserError(f"{name}:{fault.line}: {fault.problem}", help=fault.advice)


def plain(value: YamlValue) -> object:
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


class _LineComposer(Composer[YamlValue]):
    quoted = staticmethod(quoted)
    SAYS: ClassVar = {
        **Composer.SAYS,
        "depth": ("nested deeper than {} levels", "flatten the file"),
        "values": ("more than {} values, aliases counted", "shorten the file"),
        "undefined": ("no anchor {}", "define it above, as &name"),
        "cycle": ("{} contains itself", "a value cannot be part of itself"),
        "key": ("a list or map cannot be a key", "use text as the key"),
        "kind": ("{} is no {}", "fix or quote it"),
        "second": ("a second document begins here", "keep one document in the file"),
        "scalar": ("tag {} is not allowed", "write plain text, numbers, lists, maps"),
        "no-text": (
            "the text holds NUL or half a character, which no path and no name can hold",
            "remove \\0 or \\ud8..",
        ),
    }

    def __init__(self, text: str) -> None:
        super().__init__(text, LIMITS)
        self.duplicates: list[Duplicate] = []

    def scalar(self, event: Any, tag: str) -> Scalar:
        if _NO_TEXT.search(event.value):
            raise self.fault(event, "no-text")
        if tag not in _SCALARS and tag != MERGE:
            raise self.fault(event, "scalar", quoted(event.tag))
        return self.number(event, tag) if tag in _NUMBERS else str(event.value)

    def made(self, event: Any, data: Any, size: int) -> YamlValue:
        return YamlValue(event.start_mark.line + 1, data, size=size)

    def under(self, value: YamlValue, event: Any) -> YamlValue:
        return replace(value, key_line=event.start_mark.line + 1)

    def again(self, value: YamlValue, event: Any) -> YamlValue:
        return replace(value, line=event.start_mark.line + 1)

    def twice(self, key: Any, event: Any, first: YamlValue) -> None:
        self.duplicates.append(Duplicate(key, event.start_mark.line + 1, first.key_line))
