# SPDX-License-Identifier: Apache-2.0
"""One cause, one finding: what cppcheck derives several times from one assumption, with the other places as related ones."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence

from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.same_cause import OF_A_NAME, put_together
from haros_ci.results.scope import scopes

TOOL = "cppcheck"

#: Rules whose findings follow from what a variable is at some place: several of one variable in one function have
#: one cause.
RULES = frozenset(
    """
    accessMoved arrayIndexOutOfBounds arrayIndexOutOfBoundsCond containerOutOfBounds containerOutOfBoundsIndexExpression
    danglingLifetime danglingReference danglingTemporaryLifetime deallocuse derefInvalidIterator derefInvalidIteratorRedundantCheck eraseDereference
    invalidContainer legacyUninitvar memleak resourceLeak sprintfOverlappingData
    negativeContainerIndex negativeIndex nullPointer nullPointerArithmetic nullPointerOutOfMemory
    nullPointerRedundantCheck uninitdata
    uninitStructMember uninitvar zerodiv zerodivcond
    """.split()
)

#: Rules that speak once of each variable that leaks where a function is left, and at each such place.
OF_LEAKS = frozenset(("memleak", "resourceLeak"))

#: Rules that speak once of each argument of a call, each name of an import, or each backslash of a string: those of one line have one cause.
OF_A_LINE = frozenset(
    """
    pylint:no-value-for-parameter pylint:unexpected-keyword-arg pylint:missing-kwoa pylint:reimported ruff:F811 ruff:F507 flake8:F811
    pylint:anomalous-backslash-in-string ruff:W605 flake8:W605
    """.split()
)

#: Rules that speak once of each call of a function whose parameters are others: those of one function in one file have one cause.
OF_A_CALL = frozenset(
    """
    pylint:no-value-for-parameter pylint:too-many-function-args pylint:unexpected-keyword-arg pylint:missing-kwoa
    pylint:redundant-keyword-arg
    """.split()
)

#: So many names that are not there in one file have one cause: it is a sketch, or its imports are missing.
MANY_NAMES = 4

#: Rules that both speak of iterators of two containers: those of one line have one cause.
OF_A_PAIR = frozenset(("cppcheck:mismatchingContainerIterator", "cppcheck:mismatchingContainers"))

#: Rules that both speak of a pointer into a text that ends with the function: those of one line have one cause.
OF_A_TEXT = frozenset(("cppcheck:stlcstr", "cppcheck:returnDanglingLifetime"))

#: Rules that both speak of an exception that leaves a function which lets none out: those of one line have one cause.
OF_A_THROW = frozenset(("cppcheck:exceptThrowInDestructor", "cppcheck:throwInNoexceptFunction"))

#: Rules that both speak of ``raise NotImplemented``: those of one line have one cause.
OF_A_RAISE = frozenset(("pylint:notimplemented-raised", "pylint:raising-bad-type"))

#: Rules that speak once of each variable of a declaration (``int a, b;``): those of one statement have one cause.
OF_A_DECLARATION = frozenset(("cppcheck:unusedVariable",))

#: Rules that speak once of each text or letter that stands alone in a condition: those of one condition have one cause.
OF_A_CONDITION = frozenset(
    """
    cppcheck:incorrectStringBooleanError cppcheck:incorrectCharBooleanError cppcheck:incorrectStringCompare
    cppcheck:literalWithCharPtrCompare cppcheck:charLiteralWithCharPtrCompare
    """.split()
)

#: Rules that speak once of each item of ``__all__``, which a file has once, or of each line of a file in another encoding.
OF_A_FILE = frozenset(("pylint:invalid-all-object", "cpplint:readability/utf8"))

#: A finding names no more other places than this; the rest of a cause follows in another finding.
MOST = 40

_BRACKET = regex(r"[()\[\]{}]")
_STRING = regex(r"'[^'\n]*'|\"[^\"\n]*\"")
_CALLEE = regex(r"(?<!\w)(\w+)\s*$")
#: Lines of a call, and characters before its bracket, that are looked at.
_LONGEST = 200

_REMARK = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
#: Lines of a declaration that are looked at.
_DECLARATION = 8

#: The arguments of a template, which cppcheck names at each of its instances.
_INSTANCE = regex(r"\s*<[^<>']{0,200}>")

#: A variable in a message: in quotes, or after the colon at the end, where a full stop may follow.
_NAME = regex(r"'(\w+)'|: ([\w.>-]*[\w>-])\.?$")

#: A rule, a path, and what tells the causes in a file apart.
_Key = tuple[str, str, object]


def one_cause(results: Iterable[Result], text: Callable[[str], str]) -> tuple[Result, ...]:
    """*results* in their order, those of one cause as one: the first by place, whose ``related`` also name the others.

    Findings of one rule in one function have one cause if they name one variable, or explain themselves by one line.
    Call it after selection;
    *text* reads a path.
    """
    found = tuple(results)
    candidates: dict[tuple[str, str], list[int]] = defaultdict(list)
    for i, result in enumerate(found):
        if result.tool == TOOL and result.rule in RULES and result.location.line:
            candidates[result.rule, result.location.path].append(i)
    merged: dict[int, Result] = {}
    dropped: set[int] = set()
    lines: dict[_Key, list[int]] = defaultdict(list)
    calls = _Calls()
    for i, result in enumerate(found):
        cause = _cause(result, text, calls)
        if cause is not None:
            lines[cause].append(i)
    for i, result in enumerate(found):  # the template itself beside its instances
        key = (result.full_id, result.location.path, (result.location.line, result.message))
        if result.tool == TOOL and key in lines and "<" not in result.message:
            lines[key].append(i)
    for here in _with_sketches(lines, found):
        first, *others = sorted(here, key=lambda i: found[i].sort_key)[: MOST + 1]
        if others:
            merged[first] = put_together(found[first], [found[i] for i in others])
            dropped.update(others)
    for (_, path), indexes in candidates.items():
        if len(indexes) > 1:
            for group in _groups(found, indexes, text(path)):
                first, *others = sorted(group, key=lambda i: found[i].sort_key)
                merged[first] = put_together(found[first], [found[i] for i in others])
                dropped.update(others)
    return tuple(merged.get(i, result) for i, result in enumerate(found) if i not in dropped)


def _cause(result: Result, text: Callable[[str], str], calls: _Calls) -> _Key | None:
    """What *result* is put together with others by, its rule and place alone; None where it stands for itself."""
    rule, path, line = result.full_id, result.location.path, result.location.line
    if rule in OF_A_CALL and line:
        return calls.key((rule, path, _called(result, text) or line), result)
    if rule in OF_A_LINE and line:
        return rule, path, line
    if rule in OF_A_TEXT and line:
        return "stlcstr", path, line
    if rule in OF_A_THROW and line:
        return "throw", path, line
    if rule in OF_A_RAISE and line:
        return "raise", path, line
    if rule in OF_A_PAIR and line:
        return "iterators", path, line
    if result.tool == TOOL and result.rule not in RULES and line and "<" in result.message:
        return rule, path, (line, _template(result.message))
    if rule in OF_A_NAME:
        return rule, path, result.message
    if rule in (OF_A_DECLARATION | OF_A_CONDITION) and line:
        return rule, path, _start_of(result, text)
    return (rule, path, None) if rule in OF_A_FILE else None


def _with_sketches(lines: dict[_Key, list[int]], found: Sequence[Result]) -> Iterator[list[int]]:
    """The positions of *found* by cause; MANY_NAMES undefined names of one file, rule and level or more are one."""
    names: dict[tuple[str, str, object], list[list[int]]] = defaultdict(list)
    for (rule, path, _), here in lines.items():
        key = (rule, path, found[here[0]].level) if rule in OF_A_NAME else (rule, path, here[0])
        names[key].append(here)
    for groups in names.values():
        if len(groups) < MANY_NAMES:
            yield from groups
        else:
            every = sorted((i for here in groups for i in here), key=lambda i: found[i].sort_key)
            yield from (every[start : start + MOST + 1] for start in range(0, len(every), MOST + 1))


class _Calls:
    """What is wrong with one call, by several rules, is of one cause: it lacks an argument, and has one by the old name."""

    def __init__(self) -> None:
        self._at: dict[tuple[str, int | None, int | None], _Key] = {}
        self._same: dict[_Key, _Key] = {}

    def key(self, key: _Key, result: Result) -> _Key:
        """The key that *result* is put together by: *key*, or that of the finding on the same call before it."""
        at = result.location
        here = self._at.setdefault((at.path, at.line, at.column), self._same.get(key, key))
        return self._same.setdefault(key, here)


def _template(message: str) -> str:
    """*message* without the arguments of templates: alike for all instances of one."""
    for _ in range(4):
        message = _INSTANCE.sub("", message)
    return message


def _start_of(result: Result, text: Callable[[str], str]) -> tuple[int, int, bool]:
    """The place where the statement that *result* is in begins, line and column; the place itself where that is not seen."""
    at = result.location
    line, column = at.line or 0, at.column or 0
    lines = text(at.path).split("\n")[max(line - _DECLARATION, 0) : line]
    if not column or len(lines) < min(line, _DECLARATION):
        return line, column, False
    lines[-1] = lines[-1][: column - 1]
    before = _REMARK.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), "\n".join(lines))
    end = max(before.rfind(mark) for mark in ";{}")
    if end < 0:
        return line, column, False
    return line - before.count("\n", end), end - before.rfind("\n", 0, end), True


def _called(result: Result, text: Callable[[str], str]) -> str:
    """The name of the function whose call *result* is about; "" where it is not seen, or is one that each class has its own of."""
    at = result.location
    if not at.line or not at.column or not at.end_line or not at.end_column or at.end_line - at.line > _LONGEST:
        return ""
    lines = text(at.path).split("\n")[at.line - 1 : at.end_line]
    if len(lines) <= at.end_line - at.line:
        return ""
    lines[-1] = lines[-1][: at.end_column - 1]
    lines[0] = lines[0][at.column - 1 :]
    call = _STRING.sub(lambda text: " " * len(text[0]), "\n".join(lines))
    if not call.endswith(")"):
        return ""
    depth, start = 0, 0
    for bracket in reversed(list(_BRACKET.finditer(call))):
        depth += 1 if bracket[0] in ")]}" else -1
        if depth == 0:
            start = bracket.start()
            break
    name = _CALLEE.search(call[max(start - _LONGEST, 0) : start])
    return "" if name is None or name[1].startswith("__") else name[1]


def _groups(found: Sequence[Result], indexes: list[int], text: str) -> Iterator[list[int]]:
    """The positions of findings with one cause, where they are several; at most MOST + 1 each."""
    inside = scopes(text, "cpp")
    heads: dict[object, int] = {}
    group_of = {i: i for i in indexes}

    def find(i: int) -> int:
        while group_of[i] != i:
            group_of[i] = group_of[group_of[i]]
            i = group_of[i]
        return i

    for i in indexes:
        result = found[i]
        scope = inside.at(result.location.line or 0)
        marks: list[object] = [(scope, "name", name) for pair in _NAME.findall(result.message) for name in pair if name]
        marks += [(scope, near.location.path, near.location.line) for near in result.related if near.location.line]
        if result.rule in OF_LEAKS:
            marks.append((scope, "line", result.location.line))
        for mark in marks if scope else ():
            group_of[find(i)] = find(heads.setdefault(mark, i))
    groups: dict[int, list[int]] = defaultdict(list)
    for i in indexes:
        groups[find(i)].append(i)
    for group in groups.values():
        for start in range(0, len(group), MOST + 1):
            part = group[start : start + MOST + 1]
            if len(part) > 1:
                yield part
