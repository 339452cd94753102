# SPDX-License-Identifier: Apache-2.0
"""What the lowering of one file carries along: its text, its positions, and what was found so far."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp.branches import Split
from haros_ci.records import dataclass, field
from haros_ci.syntax import Alias, Class, Field, Function, Type

#: Statements and expressions nested deeper than this are unknown: what reads them may recurse.
DEEPEST = 100
MOST_PROBLEMS = 5
TOO_DEEP = "nested too deeply: what is inside is not read"
_LONGEST_TEXT = 200


@dataclass(slots=True)
class Found:
    """The contents of the Program under construction, shared by the file and its macro expansions.

    *guarded* are the macros that are defined under an ``#if``; *expansions* counts expansions; *reread* are the offsets of what was parsed again, whose errors do not matter; *splits*
    are branches of conditionals of which the others were not read.
    """

    functions: list[Function | None] = field(default_factory=list)
    classes: list[Class | None] = field(default_factory=list)
    variables: list[Field] = field(default_factory=list)
    aliases: list[Alias] = field(default_factory=list)
    scopes: list[tuple[str, str]] = field(default_factory=list)
    includes: list[str] = field(default_factory=list)
    macros: list[tuple[str, tuple[str, ...] | None, str]] = field(default_factory=list)
    guarded: set[str] = field(default_factory=set)
    registered: list[tuple[str, tuple[str, ...], int, int]] = field(default_factory=list)
    problems: list[tuple[int, str]] = field(default_factory=list)
    callable_macros: dict[str, tuple[tuple[str, ...], str]] = field(default_factory=dict)
    expansions: int = 0
    reread: list[tuple[int, int]] = field(default_factory=list)
    splits: tuple[Split, ...] = ()
    #: Those of them that what is read is known to stand in, the outermost first.
    within: tuple[Split, ...] = ()
    #: The text with the directives of these conditionals; empty where it has none.
    directed: str = ""


@dataclass(slots=True)
class Unit:
    """A text being lowered: the file, or a piece of it that was parsed again.

    *text* has one character per UTF-8 byte. *shift* leads from its offsets to the file's; *fixed* is the position
    of everything in a macro expansion, *level* how many expansions deep it is. *function* and *owner* are the
    qualified names of the function, and of its class, in which lambdas, aliases and classes are now found.
    """

    text: str
    starts: Sequence[int]
    continuations: Sequence[int]
    found: Found
    shift: int = 0
    fixed: tuple[int, int] | None = None
    level: int = 0
    function: str = ""
    owner: str = ""

    def cut(self, node: Node) -> str:
        """The source text of *node*."""
        return decoded(self.text[node.start_byte : node.end_byte])

    def collapsed(self, start: int, end: int) -> str:
        """The source text between two offsets on one line, shortened to what a person reads."""
        return _shortened(self.text, start, end)

    def written(self, start: int, end: int) -> str:
        """The same, with the directives and branches of conditionals of which only one branch is read."""
        if not self.found.directed or self.fixed is not None or self.level:
            return self.collapsed(start, end)
        return _shortened(self.found.directed, start + self.shift, end + self.shift)

    def position(self, node: Node) -> tuple[int, int]:
        """Line and column of the start of *node* in the file."""
        return self.fixed or self.locate(node.start_byte + self.shift)

    def locate(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset into the file, 1-based; columns count code points."""
        line = bisect_right(self.starts, offset)
        start = self.starts[line - 1]
        column = offset - start + 1
        if self.continuations:
            column -= bisect_left(self.continuations, offset) - bisect_left(self.continuations, start)
        return line, column

    def split(self, node: Node, whole: bool = True) -> Split | None:
        """The branch alone left of a conditional in which *node* begins, and ends if it is *whole*; None where that is known already."""
        if self.fixed is not None or self.level:
            return None
        first = self.position(node)[0]
        for split in self.found.splits:
            if split not in self.found.within and split.first <= first <= split.last:
                last = self.locate(max(node.end_byte - 1, node.start_byte) + self.shift)[0]
                if not whole or last <= split.last:
                    return split
        return None

    def opaque(self, node: Node) -> syntax.Expression:
        """The expression that stands for what has no other form."""
        return syntax.Unknown(self.collapsed(node.start_byte, node.end_byte))

    def problem(self, node: Node, message: str) -> None:
        """Record that something at *node* is lost; the first few per file are enough."""
        entry = (self.position(node)[0], message)
        if len(self.found.problems) < MOST_PROBLEMS and entry not in self.found.problems:
            self.found.problems.append(entry)


@dataclass(frozen=True, slots=True)
class CppScope:
    """Where declarations stand: *name* is qualified; *space* is the namespace around it, for friends.

    *members* collects the data members of a class.
    """

    name: str = ""
    space: str = ""
    members: list[Field] | None = None
    guards: tuple[tuple[int, int, str], ...] = ()
    templates: tuple[str, ...] = ()
    #: The types that template parameters stand for by default.
    defaults: tuple[tuple[str, Type], ...] = ()

    def qualified(self, name: str) -> str:
        """*name* as seen from outside this scope."""
        if name.startswith("::"):
            return name[2:]
        return f"{self.name}::{name}" if self.name else name


def decoded(piece: str) -> str:
    """*piece* of a Unit's text as it was written."""
    return piece if piece.isascii() else piece.encode("latin-1").decode("utf-8", "replace")


def _shortened(text: str, start: int, end: int) -> str:
    if end - start > 4 * _LONGEST_TEXT:
        end = start + 4 * _LONGEST_TEXT
    return " ".join(decoded(text[start:end]).split())[:_LONGEST_TEXT]


def unit_of(data: bytes) -> Unit:
    """A Unit over the UTF-8 text of a file."""
    text = data.decode("latin-1")
    starts = [0, *(match.end() for match in re.finditer("\n", text))]
    continuations = [] if text.isascii() else [match.start() for match in re.finditer("[\x80-\xbf]", text)]
    return Unit(text, starts, continuations, Found())
