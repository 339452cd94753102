# SPDX-License-Identifier: Apache-2.0
"""A unit's answer as JSON for the cache, grouped by rule so that unwanted rules cost nothing to read."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from sys import float_info
from typing import Any

from haros_ci.linters.linter import GaveUp
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.results.result import Related, Result
from haros_ci.results.rule import Level

IsSelected = Callable[[str, str, str], bool]

#: What a row leaves out at its end: scope, value, limit, subject, related.
_DEFAULTS: tuple[Any, ...] = ("", None, None, (), ())

#: Results of one unit; the largest file that is read has fewer lines.
MOST = 100_000
#: The last line or column that a place can have.
_LAST = 2**53

LEVELS = {level.value: level for level in Level}


@dataclass(frozen=True, slots=True)
class Answer:
    """What a tool said of one unit."""

    results: tuple[Result, ...] = ()
    gave_up: tuple[GaveUp, ...] = ()


def encode(answer: Answer) -> dict[str, Any]:
    """``{"rules": [[tool, rule, [row, …]], …], "gave_up": [[message, line], …]}``; every list sorted."""
    groups: dict[tuple[str, str], list[list[Any]]] = {}
    for result in sorted(set(answer.results), key=lambda r: r.sort_key):
        groups.setdefault((result.tool, result.rule), []).append(_row(result))
    return {
        "rules": [[tool, rule, rows] for (tool, rule), rows in sorted(groups.items())],
        "gave_up": sorted(([g.message, g.line] for g in set(answer.gave_up)), key=str),
    }


def decode(value: object, unit: str, is_selected: IsSelected, known: Collection[str]) -> Answer | None:
    """The part of a cached answer whose rules are selected; None if *value* is no answer: the contents of a cache are not trusted.

    Results outside the *known* files are dropped, as they are when a tool reports them.
    """
    try:
        rules, gave_up = value["rules"], value["gave_up"]  # type: ignore[index]  # a TypeError is answered below
        if sum(len(rows) for _, _, rows in rules) > MOST:
            return None
        results = [result for tool, rule, rows in rules for result in _results(tool, rule, rows, is_selected, known)]
        return Answer(tuple(results), tuple(GaveUp(unit, _text(message), _number(line)) for message, line in gave_up))
    except (TypeError, ValueError, KeyError, IndexError):
        return None


def _row(result: Result) -> list[Any]:
    related = [[*_place(r.location), r.message] for r in result.related]
    extra = [result.scope, result.value, result.limit, list(result.subject), related]
    while extra and extra[-1] in (None, "", []):  # 0 is a value
        extra.pop()
    return [result.level.value, result.message, *_place(result.location), *extra]


def _place(location: Location) -> list[Any]:
    return [location.path, location.line, location.column, location.end_line, location.end_column]


def _results(
    tool: object, rule: object, rows: Any, is_selected: IsSelected, known: Collection[str]
) -> Iterator[Result]:
    tool, rule = _text(tool), _text(rule)
    selected: dict[str, bool] = {}
    for row in rows:
        if not isinstance(row, list):
            raise ValueError("not a row")
        path = row[2]
        if path not in selected:
            selected[path] = path in known and is_selected(tool, rule, path)
        if selected[path]:
            extra = [*row[7:], *_DEFAULTS[len(row) - 7 :]]
            scope, value, limit, subject, related = extra
            if isinstance(subject, str) or isinstance(related, str):
                raise ValueError("not a list")
            yield Result(
                tool,
                rule,
                LEVELS[row[0]],
                _text(row[1]),
                _location(row[2:7]),
                related=tuple(Related(_location(r[:5]), _text(r[5])) for r in related if r[0] in known),
                scope=_text(scope),
                value=_real(value),
                limit=_real(limit),
                subject=tuple(map(_text, subject)),
            )


def _location(place: list[object]) -> Location:
    path, *numbers = place
    line, column, end_line, end_column = map(_number, numbers)
    return Location(_text(path), line, column, end_line, end_column)


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise ValueError("not a text")
    return value


def _number(value: object) -> int | None:
    if value is not None and (type(value) is not int or not 1 <= value <= _LAST):
        raise ValueError("not a line or column")
    return value


def _real(value: object) -> float | None:
    if value is not None and (type(value) not in (int, float) or not abs(value) <= float_info.max):  # type: ignore[arg-type]  # the type is looked at first
        raise ValueError("not a number")
    return value  # type: ignore[return-value]  # a number or None by then


__all__ = ["Answer", "IsSelected", "decode", "encode"]
