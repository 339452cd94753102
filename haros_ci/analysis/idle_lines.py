# SPDX-License-Identifier: Apache-2.0
"""The lines of a text that have nothing but idle statements (haros_ci/index/idle.py)."""

from __future__ import annotations

import re

from haros_ci import syntax
from haros_ci.coverage.blanked import blanked
from haros_ci.regex import regex
from haros_ci.syntax import Program
from haros_ci.syntax.walk import everything

#: What stands before the name of a variable.
_TYPE = regex(r"\s*[A-Za-z_][\w:]*(?:[\s*]+[A-Za-z_][\w:]*)*[\s*]+")
_SIGN = regex(r"[()\[\]{};,]")


def idle_lines(text: str, program: Program, rest: Program) -> dict[int, str]:
    """The lines of *text*, without comments and what stands in quotes, that statements of its *program* take which *rest*, the same without idle statements, has not; those that share no line with others."""
    lines = blanked(text, "cpp").split("\n")
    found = set[int]()
    for whole, bare in zip(program.functions, rest.functions, strict=True):
        if whole is bare:
            continue
        left = {id(part) for part in everything(bare.body)}
        for part in everything(whole.body):
            if id(part) in left:
                continue
            if isinstance(part, syntax.Variable):
                found.update(_taken(lines, part.line, part.column, _TYPE))
            elif isinstance(part, syntax.Do) and isinstance(part.value, syntax.Call):
                found.update(_taken(lines, part.value.line, part.value.column, re.compile(r"\s*")))
    return {number: lines[number - 1].strip() for number in sorted(found)}


def _taken(lines: list[str], line: int, column: int, before: re.Pattern[str]) -> range:
    """The lines of the statement that begins at a place behind what *before* matches and ends with its line; none if it shares one."""
    depth = 0
    if not 0 < line <= len(lines) or before.fullmatch(lines[line - 1][: column - 1]) is None:
        return range(0)
    for number in range(line, len(lines) + 1):
        row = lines[number - 1]
        for sign in _SIGN.finditer(row, column - 1 if number == line else 0):
            depth += (sign[0] in "([{") - (sign[0] in ")]}")
            if depth < 0 or (depth == 0 and sign[0] == ","):
                return range(0)
            if depth == 0 and sign[0] == ";":
                return range(line, number + 1) if not row[sign.end() :].strip() else range(0)
    return range(0)
