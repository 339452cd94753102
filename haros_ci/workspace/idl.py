# SPDX-License-Identifier: Apache-2.0
"""Definitions in IDL (OMG IDL 4.2), as far as rosidl takes them: one structure for each part, constants in a module beside it.

What is not of this form leaves the definition incomplete, and is never guessed.
"""

from __future__ import annotations

import re

from haros_ci.model.build import InterfaceField
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

MAX_TOKENS = 100_000
MAX_DEPTH = 8
#: Types as .msg files call them; IDL's char is another one than theirs, and its integers without a size are not of rosidl.
TYPES = {
    "boolean": "bool",
    "octet": "byte",
    "float": "float32",
    "double": "float64",
    "string": "string",
    "wstring": "wstring",
}
TYPES |= {f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_TOKEN = regex(
    r"(?P<skip>\s+|//[^\n]*|/\*.*?(?:\*/|\Z)|\#[^\n]*)"
    r'|(?P<token>L?"(?:[^"\\\n]|\\[^\n])*"?|\'(?:[^\'\\\n]|\\[^\n])*\'?|[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*|[-+]?(?:0[xX][0-9a-fA-F]+|\d[\w.]*(?:[eE][-+]?\d+)?|\.\d+)|.)',
    re.S,
)
_PARTS = {"msg": ("",), "srv": ("_Request", "_Response"), "action": ("_Goal", "_Result", "_Feedback")}


class _Other(Exception):
    """The text has another form."""


@dataclass(slots=True)
class _IdlReader:
    tokens: list[tuple[str, int]]
    at: int = 0
    typedefs: dict[str, str] = field(default_factory=dict)
    structs: dict[str, list[InterfaceField]] = field(default_factory=dict)
    constants: dict[str, list[InterfaceField]] = field(default_factory=dict)

    def peek(self) -> str:
        return self.tokens[self.at][0] if self.at < len(self.tokens) else ""

    def next(self) -> str:
        token = self.peek()
        if not token:
            raise _Other
        self.at += 1
        return token

    def take(self, *names: str) -> None:
        for item in names:
            if self.next() != item:
                raise _Other

    @property
    def line(self) -> int:
        return self.tokens[min(self.at, len(self.tokens) - 1)][1]


def read_idl(text: str, name: str, kind: str) -> tuple[tuple[InterfaceField, ...], ...] | None:
    """The parts of the interface *name*; None where the text is not of the form that rosidl generates from."""
    try:
        reader = _IdlReader(_tokens(text))
        while reader.peek():
            _module(reader, "")
        names = [f"{name}{part}" for part in _PARTS[kind]]
        if set(reader.structs) != set(names) or not reader.constants.keys() <= set(names):
            return None
        return tuple((*reader.constants.get(item, ()), *reader.structs[item]) for item in names)
    except (_Other, ValueError):
        return None


def _tokens(text: str) -> list[tuple[str, int]]:
    made = []
    line = 1
    for match in _TOKEN.finditer(text):
        if match["token"] is not None:
            made.append((match["token"], line))
        line += match[0].count("\n")
        if len(made) > MAX_TOKENS:
            raise _Other
    return made


def _module(reader: _IdlReader, of: str, depth: int = 0) -> None:
    """One definition inside of the module *of*."""
    _annotations(reader)
    word = reader.next()
    if word == "module":
        name = reader.next()
        reader.take("{")
        if depth > MAX_DEPTH:
            raise _Other
        while reader.peek() != "}":
            _module(reader, name, depth + 1)
        reader.take("}", ";")
    elif word == "typedef":
        kind, name = _type(reader), reader.next()
        reader.typedefs[name] = kind + _array(reader, kind)
        reader.take(";")
    elif word == "const":
        line, kind, name = reader.line, _type(reader), reader.next()
        reader.take("=")
        value = reader.next()
        reader.take(";")
        owner = of.removesuffix("_Constants")
        made = InterfaceField(
            name=name, type=kind, line=line, is_constant=True, default=_value(kind, value), value=value
        )
        reader.constants.setdefault(owner, []).append(made)
    elif word == "struct":
        name = reader.next()
        reader.take("{")
        fields = reader.structs.setdefault(name, [])
        while reader.peek() != "}":
            fields += _members(reader)
        reader.take("}", ";")
    else:
        raise _Other


def _members(reader: _IdlReader) -> list[InterfaceField]:
    default = _annotations(reader)
    kind = _type(reader)
    made = []
    while True:
        line, name = reader.line, reader.next()
        whole = kind + _array(reader, kind)
        value = _value(kind, default) if default else None
        made.append(InterfaceField(name=name, type=whole, line=line, written=whole, default=value, value=default))
        if reader.peek() != ",":
            break
        reader.take(",")
    reader.take(";")
    return made


def _type(reader: _IdlReader) -> str:
    word = reader.next()
    if word == "sequence":
        reader.take("<")
        if reader.peek() == "sequence":
            raise _Other
        inner, bound = _type(reader), ""
        if reader.peek() == ",":
            reader.take(",")
            bound = f"<={int(reader.next())}"
        reader.take(">")
        if inner.endswith("]"):
            raise _Other
        return f"{inner}[{bound}]"
    if word in ("string", "wstring") and reader.peek() == "<":
        reader.take("<")
        bound = f"<={int(reader.next())}"
        reader.take(">")
        return f"{word}{bound}"
    if word in TYPES:
        return TYPES[word]
    if word in reader.typedefs:
        return reader.typedefs[word]
    parts = word.split("::")
    if len(parts) == 3 and parts[1] == "msg":
        return f"{parts[0]}/{parts[2]}"
    raise _Other


def _array(reader: _IdlReader, kind: str) -> str:
    if reader.peek() != "[":
        return ""
    reader.take("[")
    size = int(reader.next())
    reader.take("]")
    if kind.endswith("]") or reader.peek() == "[":
        raise _Other
    return f"[{size}]"


def _annotations(reader: _IdlReader) -> str:
    """Pass annotations; the default value among them as it stands, "" if there is none."""
    default = ""
    while reader.peek() == "@":
        reader.take("@")
        name = reader.next()
        if reader.peek() != "(":
            continue
        inside, depth = [reader.next()], 1
        while depth:
            inside.append(reader.next())
            depth += {"(": 1, ")": -1}.get(inside[-1], 0)
        if name == "default" and inside[1:3] == ["value", "="]:
            default = " ".join(inside[3:-1])
    return default


def _value(kind: str, text: str) -> object:
    """A constant's or default value for comparison: a number where it is one."""
    if kind.startswith(("string", "wstring")):
        return text
    try:
        return float(text) if kind.startswith("float") else int(text, 0)
    except ValueError:
        return text
