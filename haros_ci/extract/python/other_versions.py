# SPDX-License-Identifier: Apache-2.0
"""Text of other versions of Python for the parser of this one: what it lacks is respelled on its lines.

Of Python 2: print, exec and raise with a comma, ``except A, e``, backquotes, ``<>``, ``0777``, ``1L``, ``ur""``, tabs mixed with
spaces and parameters in brackets (docs.python.org/3/whatsnew/3.0.html). Of Python 3.12: type parameters, and the word of ``type`` statements (PEP 695).
Nothing else changes, and no line moves.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from haros_ci.extract.python.source import Edit
from haros_ci.extract.python.tokens import OPENING, Token, logical_lines
from haros_ci.regex import regex

#: (start, end, replacement) in the whole text.
_Change = tuple[int, int, str]

_COMPOUND = frozenset(("if", "elif", "else", "for", "while", "try", "except", "finally", "with", "def", "class"))
_PRINT_FUNCTION = regex(r"^from[ \t]+__future__[ \t]+import\b[^\n]*\bprint_function\b", re.MULTILINE)
_OCTAL = regex(r"0([0-7]*[1-7][0-7]*)[lL]?")
_LONG = regex(r"(\d+|0[xX][\da-fA-F]+|0[oO][0-7]+|0[bB][01]+)[lL]")
_OPERAND = frozenset("([{`-+~")
#: Words after print that go on with an expression in which print is a name.
_INFIX = frozenset(("in", "is", "and", "or", "if", "else", "for", "as"))


def repair(text: str) -> tuple[str, dict[int, list[Edit]]]:
    """The respelled text and, by line, what changed; *text* itself where nothing did. Line ends are ``\\n``."""
    prints = not _PRINT_FUNCTION.search(text)
    tabs = "\t" in text
    changes: list[_Change] = []
    lines = list(logical_lines(text))
    for number, line in enumerate(lines):
        if tabs:
            changes.extend(_indentation(text, line[0]))
        if line[0].text == "def":
            changes.extend(_unpacked(text, line, lines[number + 1 : number + 2]))
        changes.extend(_literals(line))
        for statement in _statements(line):
            changes.extend(_statement(statement, prints))
    return _apply(text, sorted(changes, key=lambda change: change[:2])) if changes else (text, {})


def _apply(text: str, changes: list[_Change]) -> tuple[str, dict[int, list[Edit]]]:
    starts = [0, *(found.end() for found in re.finditer("\n", text))]
    edits: dict[int, list[Edit]] = {}
    pieces: list[str] = []
    done = before = shift = 0
    for start, end, replacement in changes:
        if start < done:
            continue
        pieces += (text[done:start], replacement)
        done = end
        line = bisect_right(starts, start)
        shift = shift if line == before else 0
        column = start - starts[line - 1]
        edits.setdefault(line, []).append((column + shift, column, len(replacement), end - start))
        shift += len(replacement) - (end - start)
        before = line
    pieces.append(text[done:])
    return "".join(pieces), edits


def _indentation(text: str, first: Token) -> Iterator[_Change]:
    start = text.rfind("\n", 0, first.start) + 1
    indent = text[start : first.start]
    if "\t" in indent and not indent.strip(" \t"):
        yield start, first.start, indent.expandtabs(8)


def _unpacked(text: str, line: list[Token], after: list[list[Token]]) -> list[_Change]:
    """``def f(a, (b, c)):`` as ``def f(a, _1):``, with ``(b, c) = _1;`` before the first statement (PEP 3113).

    Where that is a compound one, ``b`` and ``c`` are what a function gives of which nothing is known.
    """
    made: list[_Change] = []
    unpacking, names = "", ""
    colon = next((index for index, token in enumerate(line) if token.text == ":" and not token.depth), len(line))
    for index, token in enumerate(line[:colon]):
        if token.text == "(" and token.depth == 1 and line[index - 1].text in ("(", ","):
            end = next((other.end for other in line[index:] if other.text == ")" and other.depth == 1), None)
            if end is not None:
                made.append((token.start, end, f"_{token.start}"))
                unpacking += f"{' '.join(text[token.start : end].split())} = _{token.start}; "
                inside = (other.text for other in line if token.start < other.start < end and other.kind == "name")
                names += "".join(f", {name}=_unpacked_()" for name in inside)
    body = line[colon + 1 :] or (after[0] if after else [])
    if made and body and (body[0].text in _COMPOUND or body[0].text in ("@", "async")):
        close = next((token for token in reversed(line[:colon]) if token.text == ")" and not token.depth), line[0])
        is_last = not any(token.text == "**" and token.depth == 1 for token in line)
        return [*made, (close.start, close.start, names)] if is_last else []
    return [*made, (body[0].start, body[0].start, unpacking)] if made and body else []


def _literals(line: list[Token]) -> Iterator[_Change]:
    opened = False
    for token in line:
        if token.text == "`":
            yield token.start, token.end, ")" if opened else "repr("
            opened = not opened
        elif token.text == "<>":
            yield token.start, token.end, "!="
        elif token.kind == "number":
            if octal := _OCTAL.fullmatch(token.text):
                yield token.start, token.end, "0o" + octal[1]
            elif long := _LONG.fullmatch(token.text):
                yield token.start, token.end, long[1]
        elif token.kind == "string" and token.text[:2].lower() == "ur":
            yield token.start, token.start + 1, ""


def _statements(line: list[Token]) -> Iterator[list[Token]]:
    """The simple statements of a logical line, and its header (``except A, e:``) if it has one."""
    start = 0
    in_header, lambdas = line[0].text in _COMPOUND, 0
    for index, token in enumerate(line):
        if token.depth:
            continue
        if token.text == "lambda":
            lambdas += 1
        elif token.text == ":" and lambdas:
            lambdas -= 1
        elif token.text == ";" or (token.text == ":" and in_header):
            yield line[start : index + (token.text == ":")]
            start, in_header = index + 1, False
    yield line[start:]


def _statement(tokens: list[Token], prints: bool) -> Iterator[_Change]:
    word = tokens[0].text if tokens else ""
    if word in ("def", "class"):
        yield from _without_parameters(tokens, 1)
    elif word == "async" and len(tokens) > 2 and tokens[1].text == "def":
        yield from _without_parameters(tokens, 2)
    elif word == "type" and len(tokens) > 3 and tokens[1].kind == "name" and tokens[2].text in ("=", "["):
        yield tokens[0].start, tokens[1].start, ""
        yield from _without_parameters(tokens, 1)
    elif word == "print" and prints:
        yield from _print(tokens)
    elif word == "exec" and _has_operand(tokens):
        yield tokens[0].end, tokens[0].end, "("
        yield from ((t.start, t.end, ",") for t in tokens if t.text == "in" and not t.depth)
        yield tokens[-1].end, tokens[-1].end, ")"
    elif word == "raise":
        commas = [t for t in tokens if t.text == "," and not t.depth]
        if commas and len(tokens) > 2 and tokens[-1] is not commas[-1]:
            spellings = ("(", ").with_traceback(")
            yield from ((t.start, t.end, new) for t, new in zip(commas, spellings, strict=False))
            yield tokens[-1].end, tokens[-1].end, ")"
    elif word == "except" and tokens[-1].text == ":":
        comma = next((i for i, t in enumerate(tokens) if t.text == "," and not t.depth), 0)
        if comma and len(tokens) - comma == 3 and tokens[comma + 1].kind == "name":
            yield tokens[comma].start, tokens[comma].end, " as "
        elif comma and tokens[comma + 1].text in OPENING:
            yield tokens[comma].start, tokens[-1].start, ""


def _without_parameters(tokens: list[Token], name: int) -> Iterator[_Change]:
    """What is named by the token at *name* without its type parameters: ``class A[T]:``, ``def f[T: B](a: T):``, ``type A[T] = B[T]``."""
    after = name + 1
    if len(tokens) > after and tokens[name].kind == "name" and tokens[after].text == "[":
        end = next((token.end for token in tokens[after:] if token.text == "]" and not token.depth), None)
        if end is not None:
            yield tokens[after].start, end, ""


def _print(tokens: list[Token]) -> Iterator[_Change]:
    """``print >>f, x`` becomes ``print(f, x)``: what is called in it is the same."""
    end = tokens[-1].end
    if len(tokens) == 1:
        yield end, end, "()"
    elif tokens[1].text == ">>":
        yield tokens[1].start, tokens[1].end, "("
        yield end, end, ")"
    elif _has_operand(tokens):
        yield tokens[0].end, tokens[0].end, "("
        yield end, end, ")"


def _has_operand(tokens: list[Token]) -> bool:
    """Whether a keyword statement's operand follows that is not a call's parentheses already."""
    if len(tokens) < 2:
        return False
    first = tokens[1]
    if first.text == "(":
        return next((t for t in tokens if t.text == ")" and not t.depth), tokens[-1]) is not tokens[-1]
    return first.text in _OPERAND or (first.kind in ("string", "number", "name") and first.text not in _INFIX)
