# SPDX-License-Identifier: Apache-2.0
"""What a name of a launch file may stand for: Python data as it is, and the things below."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.model.launch_actions import Action, LaunchContext, Phrase, Substitution, Test
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

#: A value: None, bool, int, float, str, bytes, list, tuple, dict, set or range, or one of the classes below.
Value = Any


@dataclass(frozen=True, slots=True, eq=False)
class Unknown:
    """A value that cannot be known."""

    reason: str
    location: Location | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Choice(Unknown):
    """One of several values, each under its tests: what branches on an unknown condition leave."""

    options: tuple[tuple[tuple[Test, ...], Value], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Absent(Unknown):
    """Among the options of a Choice: on this way there is no value, and to ask for it is an error."""


@dataclass(frozen=True, slots=True, eq=False)
class Rest(Unknown):
    """In a list, set or dictionary: any number of further items that are not known."""


@dataclass(frozen=True, slots=True, eq=False)
class Maybe:
    """An item of a list that is there only if the tests hold."""

    value: Value
    tests: tuple[Test, ...]


@dataclass(frozen=True, slots=True, eq=False)
class PartialText:
    """A str with parts that only the context knows."""

    phrase: Phrase


@dataclass(frozen=True, slots=True, eq=False)
class Sub:
    """A launch Substitution object (of class *name*)."""

    phrase: Phrase
    name: str


@dataclass(frozen=True, slots=True)
class PathValue:
    """A pathlib.Path; *text* is a str or a Text."""

    text: Value


@dataclass(frozen=True, slots=True, eq=False)
class LaunchObject:
    """An object that a library made: *name* is its class, *fields* what it keeps (may be changed by its methods)."""

    name: str
    location: Location
    fields: dict[str, Value] = field(default_factory=dict)
    action: Action | None = None


@dataclass(frozen=True, slots=True)
class Library:
    """A name of a module that is not interpreted, by its dotted name."""

    dotted: str


@dataclass(frozen=True, slots=True, eq=False)
class Native:
    """A method of a value, bound to it: *call* does it."""

    name: str
    call: Callable[[Any, Any], Value]


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A module of the workspace: *variables* as its statements left them."""

    name: str
    path: str
    variables: dict[str, Value]


@dataclass(frozen=True, slots=True, eq=False)
class ScriptScope:
    """Variables, and where to look further; a class's body is not looked through by its methods."""

    variables: dict[str, Value]
    parent: ScriptScope | None
    source: ScriptSource
    is_class: bool = False
    outer_names: dict[str, ScriptScope] = field(default_factory=dict)

    @property
    def module(self) -> ScriptScope:
        scope = self
        while scope.parent is not None:
            scope = scope.parent
        return scope


@dataclass(frozen=True, slots=True, eq=False)
class ScriptSource:
    """A file that is interpreted: its root-relative path and lines; *package* is what relative imports begin at."""

    path: str
    lines: tuple[str, ...]
    package: str = ""

    def place(self, node: ast.AST) -> Location:
        """The place of *node*, its column in code points."""
        line, offset = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
        return Location(self.path, line, self.column(line, offset) + 1)

    def column(self, line: int, offset: int) -> int:
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        return offset if text.isascii() else len(text.encode("utf-8", "replace")[:offset].decode("utf-8", "replace"))

    def segment(self, node: ast.expr) -> str:
        """The text of *node*, its white space as one blank, at most 200 characters."""
        last = node.end_lineno or node.lineno
        if last - node.lineno > 40:
            return ""
        lines = list(self.lines[node.lineno - 1 : last])
        if not lines:
            return ""
        lines[-1] = lines[-1][: self.column(last, node.end_col_offset or 0)]
        lines[0] = lines[0][self.column(node.lineno, node.col_offset) :]
        return " ".join(" ".join(lines).split())[:200]


@dataclass(frozen=True, slots=True, eq=False)
class ScriptFunction:
    """A function or lambda of an interpreted file."""

    name: str
    node: ast.FunctionDef | ast.Lambda
    scope: ScriptScope
    defaults: tuple[Value, ...] = ()
    keyword_defaults: tuple[Value, ...] = ()
    kind: str = "function"  # or staticmethod, classmethod, property
    owner: ScriptClass | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Bound:
    """A function with its first argument."""

    function: ScriptFunction
    owner: Value


@dataclass(frozen=True, slots=True, eq=False)
class ScriptClass:
    """A class of an interpreted file; *bases* are such classes, *library* the first base that is not."""

    name: str
    variables: dict[str, Value]
    bases: tuple[ScriptClass, ...] = ()
    library: str = ""
    fields: tuple[str, ...] = ()  # of a dataclass


@dataclass(frozen=True, slots=True, eq=False)
class ScriptInstance:
    """An object of a class of an interpreted file."""

    type: ScriptClass
    variables: dict[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Opened:
    """A file opened for reading."""

    path: Value


@dataclass(frozen=True, slots=True, eq=False)
class Context:
    """The launch context that an OpaqueFunction runs in; *depth* is that of the branches when it was called."""

    launch: LaunchContext
    depth: int


@dataclass(frozen=True, slots=True, eq=False)
class Configurations:
    """``context.launch_configurations``."""

    context: Context


@dataclass(frozen=True, slots=True, kw_only=True)
class LibraryCall:
    """A call of a library's name: *args* and *keywords* are values; *unknown* says why there may be more of them."""

    name: str
    location: Location
    args: tuple[Value, ...] = ()
    keywords: dict[str, Value]
    unknown: str = ""
    text: str = ""

    def bind(self, names: str, start: int = 0) -> dict[str, Value]:
        """The arguments by the parameter *names* (``a b * c``: after the star by keyword only)."""
        positional = names.split("*")[0].split()
        return {**dict(zip(positional, self.args[start:], strict=False)), **self.keywords}


MAX_PHRASE = 400_000


def present(value: Value) -> Value:
    """*value* of a name, attribute or item that is asked for: then it is there, whatever way was gone."""
    if isinstance(value, Choice) and any(isinstance(item, Absent) for _, item in value.options):
        kept = tuple(option for option in value.options if not isinstance(option[1], Absent))
        if len(kept) == 1:
            return kept[0][1]
        return Choice(value.reason, value.location, kept) if kept else Unknown(value.reason, value.location)
    return value


def uncertain(value: Value) -> bool:
    """Whether *value* is not one that Python's own operators can work on."""
    return isinstance(value, (Unknown, PartialText, Maybe))


def holes(items: Any) -> Unknown | None:
    """The first reason why the number of *items* is not known."""
    for item in items:
        if isinstance(item, Rest):
            return item
        if isinstance(item, Maybe):
            return Unknown(item.tests[0].reason or "depends on a condition", item.tests[0].location)
    return None


def merged(parts: Any) -> Phrase:
    """A phrase of *parts*, neighbouring literals joined, empty ones dropped; one that is too large is not known."""
    result: list[str | Substitution] = []
    literal: list[str] = []
    size = 0
    for part in parts:
        size += len(part) if isinstance(part, str) else 1
        if size > MAX_PHRASE:
            return (mystery("it is too large"),)
        if isinstance(part, str):
            literal.append(part)
            continue
        if text := "".join(literal):
            result.append(text)
        literal.clear()
        result.append(part)
    if text := "".join(literal):
        result.append(text)
    return tuple(result)


def mystery(reason: str, location: Location | None = None) -> Substitution:
    """A part of a text that is not known."""
    return Substitution("?", location=location, reason=reason)


def phrase(value: Value, depth: int = 0) -> Phrase:
    """*value* as launch takes a text: a str, a Substitution, a Path, or a sequence of such one after the other."""
    if isinstance(value, str):
        return (value,) if value else ()
    if isinstance(value, (PartialText, Sub)):
        return value.phrase
    if isinstance(value, PathValue):
        return phrase(value.text)
    if isinstance(value, Unknown):
        return (mystery(value.reason, value.location),)
    if isinstance(value, Maybe):
        return (mystery(value.tests[0].reason or "depends on a condition", value.tests[0].location),)
    if isinstance(value, (list, tuple)) and depth < 8:
        return merged(part for item in value for part in phrase(item, depth + 1))
    if isinstance(value, (bool, int, float)):
        return (str(value),)
    if value is None:
        return ()
    return (mystery(f"{describe(value)} is no text"),)


def text_of(value: Phrase) -> Value:
    """A phrase as a str value."""
    if not value:
        return ""
    if len(value) == 1 and isinstance(value[0], str):
        return value[0]
    return PartialText(value)


def why(value: Value) -> str:
    """Why *value* is not known."""
    if isinstance(value, Unknown):
        return value.reason
    if isinstance(value, Maybe):
        return value.tests[0].reason or "depends on a condition"
    if isinstance(value, PartialText):
        return next((p.reason or f"depends on $({p.kind})" for p in value.phrase if isinstance(p, Substitution)), "")
    return f"{describe(value)} is not supported here"


def describe(value: Value) -> str:
    """What *value* is, for a reason."""
    if isinstance(value, (LaunchObject, Sub)):
        return value.name
    if isinstance(value, Library):
        return value.dotted
    if isinstance(value, (ScriptFunction, ScriptClass, Native, Module)):
        return f"`{value.name}`"
    if isinstance(value, ScriptInstance):
        return f"an object of `{value.type.name}`"
    if isinstance(value, Bound):
        return f"`{value.function.name}`"
    if isinstance(value, PartialText):
        return "a text that the context knows"
    return {"NoneType": "None", "PathValue": "a path", "Opened": "a file"}.get(
        type(value).__name__, f"a {type(value).__name__}"
    )
