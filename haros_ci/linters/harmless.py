# SPDX-License-Identifier: Apache-2.0
"""Findings of linters that are so and change nothing: what is written twice is the same, what is too much is nothing."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from haros_ci.linters.call_arguments import arguments
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.function_text import function_text
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments
from haros_ci.results.python_nodes import is_same
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

_KEY = regex(r"Duplicate key (.{1,200}) in dictionary")
_REDECLARED = regex(r"Redeclared variable '(\w+)'")
#: ``sprintf format string requires 1 parameter but 2 are given.``
_SURPLUS = regex(r"(\w+) format string requires (\d+) parameters? but (?:only )?(\d+) (?:is|are) given")
_NOTHING = frozenset("NULL nullptr 0".split())
_NUMBER = regex(r"\(no\. (\d{1,3})\)")
_PRINTS = regex(r"\b(\w*printf)\s*\(")
_WORD = regex(r"[A-Za-z_]\w*")
#: What a template's function itself says of a type.
_BUILT_IN = (
    r"\b(?:int|unsigned|signed|short|long|float|double|char|bool|size_t|u?int\d+_t)\b[^;{{}}()]{{0,60}}[\s*&,]{name}\b"
)
_TEMPLATE = regex(r"\s*template\s*<[^{};]{1,300}>")
_OF_TEMPLATE = regex(r"\w+\s*<[\w\s,]{1,80}>\s*::\s*~?\w+\s*\(")
#: Format strings stand at these places of the arguments.
_PLACES = {"printf": 0, "fprintf": 1, "sprintf": 1, "snprintf": 2}
_LAYOUT = frozenset((tokenize.NL, tokenize.COMMENT))
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef)


def with_harmless(
    results: Iterable[Result], text: Callable[[str], str], is_given: Callable[[Result], bool]
) -> tuple[Result, ...]:
    """*results*, those as notes that are so and change nothing; where the level *is_given* by the settings it stands. *text* reads a path.

    That is a key that a dictionary has twice with the same value, a name that an assignment sets twice and nothing reads, words side by side that are joined with a
    blank, arguments of printf() that are no more than NULL, and a format in a template that is not for all types that cppcheck puts in.
    """
    doubting = Doubting()

    def is_harmless(result: Result) -> bool:
        asks, line = _ASKS.get(result.full_id), result.location.line
        if asks is None or not line or result.level is Level.NOTE or is_given(result):
            return False
        whole = text(result.location.path)
        return doubting.may(result.location.path, result.full_id, whole) and asks(result.message, line, whole)

    return tuple(replace(result, level=Level.NOTE) if is_harmless(result) else result for result in results)


def _has_same_values(message: str, line: int, text: str) -> bool:
    """Whether the dictionary at *line* has the key of *message* with one value each time."""
    key = _KEY.search(message)
    for node in nodes(text):
        if isinstance(node, ast.Dict) and node.lineno == line and key is not None:
            pairs = zip(node.keys, node.values, strict=True)
            values = [value for one, value in pairs if one is not None and _is_key(one, key[1])]
            if len(values) > 1:
                return all(is_same(values[0], value) for value in values[1:])
    return False


def _is_key(node: ast.expr, written: str) -> bool:
    return isinstance(node, ast.Constant) and repr(node.value) == written


def _is_unread(message: str, line: int, text: str) -> bool:
    """Whether no other line of the function, or of the module, reads the name that the assignment at *line* sets twice."""
    name = _REDECLARED.search(message)
    every = nodes(text)
    around = [node for node in every if isinstance(node, _SCOPES) and node.lineno <= line <= (node.end_lineno or 0)]
    scope = max(around, key=lambda node: node.lineno, default=next(iter(every), None))
    if name is None or scope is None:
        return False
    return not any(
        isinstance(node, ast.Name) and node.id == name[1] and isinstance(node.ctx, ast.Load) for node in ast.walk(scope)
    )


def _is_joined_text(message: str, line: int, text: str) -> bool:
    """Whether the texts side by side at *line* are joined with a blank, each with the next: words of one text, as a comma that was forgotten leaves none."""
    found = False
    for one, other in _joints(text, line):
        if not (one[-1:].isspace() or other[:1].isspace()):
            return False
        found = True
    return found


def _joints(text: str, line: int) -> Iterator[tuple[str, str]]:
    """The literals that stand side by side on *line*, each with the next; nothing of formatted ones, whose ends are not seen."""
    try:
        tokens = [token for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type not in _LAYOUT]
    except (tokenize.TokenError, SyntaxError, ValueError):
        return
    for one, other in zip(tokens, tokens[1:], strict=False):
        if one.type == other.type == tokenize.STRING and one.end[0] == other.start[0] == line:
            try:
                ends = ast.literal_eval(one.string), ast.literal_eval(other.string)
            except (SyntaxError, ValueError):
                yield "", ""
                continue
            yield str(ends[0]), str(ends[1])


def _is_surplus_nothing(message: str, line: int, text: str) -> bool:
    """Whether what printf() is given beyond its format is NULL: C evaluates it, and does not look at it ("fprintf", 7.21.6.1 of the standard)."""
    counted = _SURPLUS.search(message)
    given = _given(counted[1], line, text) if counted is not None else []
    if counted is None or len(given) <= int(counted[3]) - int(counted[2]):
        return False
    surplus = int(counted[3]) - int(counted[2])
    return surplus > 0 and all(one.strip() in _NOTHING for one in given[-surplus:])


def _is_of_template(message: str, line: int, text: str) -> bool:
    """Whether the argument of a format in a template has the type that cppcheck puts in: who does not call it with that type has no such call."""
    code = without_comments(text, "c")
    function, number = function_text(line, code), _NUMBER.search(message)
    head = function.partition("{")[0]
    if number is None or not (_TEMPLATE.match(head) or _OF_TEMPLATE.search(head)):
        return False
    here = code.split("\n")[line - 1]
    call = _PRINTS.search(here)
    given = _given(call[1], line, text) if call is not None else []
    place = _PLACES.get(call[1], 0) + int(number[1]) if call is not None else 0
    name = _WORD.match(given[place].strip()) if place < len(given) else None
    if name is None or re.match(r"\w+\s*[(<]", given[place].strip()):
        return False
    return re.search(_BUILT_IN.format(name=name[0]), function) is None


def _given(name: str, line: int, text: str) -> list[str]:
    """The arguments of the first call of *name* at *line*."""
    lines = without_comments(text, "c").split("\n")
    if not 0 < line <= len(lines):
        return []
    call = re.search(rf"\b{name}\s*\(", lines[line - 1])
    return arguments("\n".join(lines[line - 1 :]), call.end() - 1) if call is not None else []


_ASKS: dict[str, Callable[[str, int, str], bool]] = {
    "pylint:duplicate-key": _has_same_values,
    "pylint:redeclared-assigned-name": _is_unread,
    "pylint:implicit-str-concat": _is_joined_text,
    "cppcheck:wrongPrintfScanfArgNum": _is_surplus_nothing,
    **dict.fromkeys(
        (f"cppcheck:invalidPrintfArgType_{kind}" for kind in ("float", "sint", "uint", "s", "p")), _is_of_template
    ),
}
