# SPDX-License-Identifier: Apache-2.0
"""CMake text as commands in nested blocks: the grammar of cmake-language(7), nothing evaluated."""

from __future__ import annotations

import re

from haros_ci.records import dataclass, field
from haros_ci.regex import regex

MAX_DEPTH = 60
MAX_COMMANDS = 50_000

_BEFORE = regex(r"(?:[ \t\r\n;]+|#(?!\[=*\[)[^\n]*)+")
_NAME = regex(r"([A-Za-z_][A-Za-z0-9_]*)[ \t]*\(")
_BRACKET = regex(r"#?\[(=*)\[\n?")
_TOKEN = regex(
    r"""[ \t\r\n]+
    | \#(?!\[=*\[)[^\n]*
    | (?P<bracket>\#?\[=*\[)
    | (?P<paren>[()])
    | "(?P<quoted>[^"\\]*(?:\\.[^"\\]*)*)"
    | (?P<word>(?:[^\s()\#"\\$]+|\\.|\$\([^()\s"\#]*\)|\$
        |"[^"\\]*(?:\\.[^"\\]*)*")+)
    """,
    re.DOTALL | re.VERBOSE,
)
_ACTIVE = regex(r"[$\\;]")


@dataclass(slots=True)
class CMakeArgument:
    """*text* as written, without delimiters.

    ``is_literal``: bracketed, never evaluated; ``is_plain``: nothing in it to evaluate.
    """

    text: str
    is_quoted: bool = False
    is_literal: bool = False
    is_plain: bool = True


@dataclass(slots=True)
class ParsedCommand:
    """One invocation, or a block: *branches* are the bodies, each with the command that opens it.

    ``if`` has one branch per if, elseif and else; foreach, while, function, macro and block have one.
    """

    name: str
    arguments: tuple[CMakeArgument, ...]
    line: int
    column: int
    branches: list[tuple[ParsedCommand, list[ParsedCommand]]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Script:
    """The commands of a file up to its first error; *errors* are (line, message)."""

    commands: tuple[ParsedCommand, ...]
    errors: tuple[tuple[int, str], ...] = ()


def parse_cmake(text: str) -> Script:
    """The commands of *text*, blocks nested. Where it is not CMake, what precedes is kept and an error says so."""
    errors: list[tuple[int, str]] = []
    return Script(tuple(_nest(_scan(text, errors), errors)), tuple(errors))


def _scan(text: str, errors: list[tuple[int, str]]) -> list[ParsedCommand]:
    found: list[ParsedCommand] = []
    position, line, counted, end = 0, 1, 0, len(text)
    while position < end:
        if blank := _BEFORE.match(text, position):
            position = blank.end()
            continue
        line += text.count("\n", counted, position)
        counted = position
        if text[position] == "#":
            position = _bracket(text, position)[1]
            if position < 0:
                errors.append((line, "the bracket comment is not closed"))
                break
            continue
        name = _NAME.match(text, position)
        if name is None:
            errors.append((line, "a command was expected; what follows is not read"))
            break
        if len(found) >= MAX_COMMANDS:
            errors.append((line, f"more than {MAX_COMMANDS} commands; the rest is not read"))
            break
        arguments, after = _arguments(text, name.end())
        if after < 0:
            errors.append((line, f"{name[1]}(...) is not closed; what follows is not read"))
            break
        column = position - text.rfind("\n", 0, position)
        found.append(ParsedCommand(name[1].lower(), tuple(arguments), line, column))
        position = after
    return found


def _arguments(text: str, position: int) -> tuple[list[CMakeArgument], int]:
    """The arguments from behind the parenthesis, and the place behind the closing one (-1: none)."""
    found: list[CMakeArgument] = []
    depth = 0
    while match := _TOKEN.match(text, position):
        position = match.end()
        kind = match.lastgroup
        if kind is None:
            continue
        if kind == "word":
            word = match["word"]
            found.append(CMakeArgument(word, is_plain=_ACTIVE.search(word) is None))
        elif kind == "quoted":
            value = match["quoted"]
            found.append(CMakeArgument(value, is_quoted=True, is_plain="$" not in value and "\\" not in value))
        elif kind == "paren":
            if match["paren"] == ")":
                if not depth:
                    return found, position
                depth -= 1
            else:
                depth += 1
            found.append(CMakeArgument(match["paren"]))
        else:
            content, position = _bracket(text, match.start())
            if position < 0:
                break
            if match["bracket"][0] != "#":
                found.append(CMakeArgument(content, is_quoted=True, is_literal=True))
    return found, -1


def _bracket(text: str, position: int) -> tuple[str, int]:
    """The content of the bracket argument or comment at *position* and the place behind it (-1: not closed)."""
    opening = _BRACKET.match(text, position)
    if opening is None:
        return "", -1
    closing = f"]{opening[1]}]"
    end = text.find(closing, opening.end())
    return ("", -1) if end < 0 else (text[opening.end() : end], end + len(closing))


_OPENING = {"if": "endif", **{name: f"end{name}" for name in ("foreach", "while", "function", "macro", "block")}}
_CLOSING = {end: name for name, end in _OPENING.items()}


def _nest(flat: list[ParsedCommand], errors: list[tuple[int, str]]) -> list[ParsedCommand]:
    """Commands with the blocks' bodies in them. A lone end is dropped, an open block ends with the file."""
    top: list[ParsedCommand] = []
    open_blocks: list[ParsedCommand] = []
    body = top
    skipped = 0
    for command in flat:
        if command.name in _OPENING:
            if skipped or len(open_blocks) >= MAX_DEPTH:
                if not skipped:
                    errors.append((command.line, f"blocks nested deeper than {MAX_DEPTH}; what is deeper is not read"))
                skipped += 1
                continue
            body.append(command)
            open_blocks.append(command)
            body = []
            command.branches.append((command, body))
        elif command.name in _CLOSING:
            if skipped:
                skipped -= 1
            elif open_blocks and open_blocks[-1].name == _CLOSING[command.name]:
                open_blocks.pop()
                body = open_blocks[-1].branches[-1][1] if open_blocks else top
            else:
                errors.append((command.line, f"{command.name}() closes nothing"))
        elif skipped:
            continue
        elif command.name in ("else", "elseif"):
            if open_blocks and open_blocks[-1].name == "if":
                body = []
                open_blocks[-1].branches.append((command, body))
            else:
                errors.append((command.line, f"{command.name}() outside of if()"))
        else:
            body.append(command)
    errors.extend((block.line, f"{block.name}() is not closed") for block in open_blocks)
    return top
