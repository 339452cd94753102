# SPDX-License-Identifier: Apache-2.0
"""The same defect once: of results that several rules give for one defect, one is kept and names the others."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from haros_ci.linters.catalogue.same_defect import SAME_DEFECT
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.result import Result

#: pylint cannot know these names when a wildcard import brings them from a package that is not installed, as messages
#: and dynamic_reconfigure seldom are where no ROS is (``from std_msgs.msg import *``).
_UNFOUNDED = "pylint:undefined-variable"
_WILDCARD = regex(r"^[ \t]*from[ \t]+[\w.]+[ \t]+import[ \t]*(?:\([ \t]*)?\*", re.MULTILINE)

#: cpplint counts a function's lines and reports them at its closing brace, the others at its head.
_AT_THE_END = "cpplint:readability/fn_size"

#: pylint reports a mutable default at the head of its function, once; ruff each where it stands.
_DEFAULT, _OF_FUNCTION = "ruff:B006", "pylint:dangerous-default-value"
#: pylint reports a key that a dict has twice at the brace that begins the dict; ruff and flake8 where it stands again.
_KEY, _AGAIN = "pylint:duplicate-key", frozenset(("ruff:F601", "flake8:F601"))
_QUOTED = regex(r"(['\"])([^'\"]*)\1")
#: The head of a function is no longer than so many lines.
_HEAD = 30


def merge_same_defects(
    results: Iterable[Result], same_defect: Sequence[Sequence[str]] = SAME_DEFECT
) -> tuple[Result, ...]:
    """*results* in their order, without those that repeat another; call it after selection and :func:`keep_worst_band`.

    Results in one file, on one line, whose rules stand in one set of *same_defect* are one defect. The one whose rule
    stands first is kept with its message; ``also`` names the others, and its level is the worst of theirs. Where a
    line has the defect several times (two unused imports), the n-th result of a rule goes with the n-th of the other.
    """
    found = tuple(results)
    order = sorted(range(len(found)), key=lambda i: found[i].sort_key)
    places: dict[str, list[int]] = {}
    for place, i in enumerate(order):
        places.setdefault(found[i].full_id, []).append(place)
    lines = _lines(found)
    merged: dict[int, Result] = {}
    dropped: set[int] = set()
    for rules in same_defect:
        concerned = [order[place] for place in sorted(place for rule in {*rules} for place in places.get(rule, ()))]
        for group in _groups(found, concerned, lines, rules, dropped):
            if len(group) > 1:
                first = group[0]
                merged[first] = _merge(merged.get(first, found[first]), [merged.get(i, found[i]) for i in group[1:]])
                dropped.update(group[1:])
    return tuple(merged.get(i, result) for i, result in enumerate(found) if i not in dropped)


def drop_unfounded(
    results: Iterable[Result], text: Callable[[str], str], workspace: Workspace | None = None
) -> tuple[Result, ...]:
    """*results* without names that pylint calls undefined in a file with a wildcard import that may bring them; *text* reads a path.

    Without a *workspace* each wildcard import may bring any name.
    """
    found = tuple(results)
    paths = {result.location.path for result in found if result.full_id == _UNFOUNDED}
    blind = {path for path in paths if _WILDCARD.search(code_alone(text(path), "python"))}

    def is_unfounded(result: Result) -> bool:
        if result.full_id != _UNFOUNDED or result.location.path not in blind:
            return False
        name = _QUOTED.search(result.message)
        if name is None or workspace is None:
            return True
        from haros_ci.linters.star_imports import may_bring

        return may_bring(name[2], result.location.path, workspace)

    return tuple(result for result in found if not is_unfounded(result))


def _groups(
    found: Sequence[Result], order: Iterable[int], lines: Sequence[int], rules: Sequence[str], dropped: set[int]
) -> Iterable[list[int]]:
    """Of *order*, the positions of results of *rules*, those that are one defect, the one to keep first."""
    rank = {rule: place for place, rule in enumerate(rules)}
    groups: dict[tuple[str, int, int], list[int]] = {}
    seen: dict[tuple[str, int, str], int] = {}
    for i in order:
        result = found[i]
        if i in dropped:
            continue
        path, line = result.location.path, lines[i]
        nth = 0 if result.full_id in (_DEFAULT, _OF_FUNCTION) else seen.get((path, line, result.full_id), 0)
        seen[path, line, result.full_id] = nth + 1
        groups.setdefault((path, line, nth), []).append(i)
    for group in groups.values():
        yield sorted(group, key=lambda i: rank[found[i].full_id])


def _merge(kept: Result, others: Sequence[Result]) -> Result:
    also = dict.fromkeys((*kept.also, *(name for other in others for name in (other.full_id, *other.also))))
    level = min((kept.level, *(other.level for other in others)), key=lambda level: level.rank)
    return replace(kept, level=level, also=tuple(sorted(also)))


def _lines(found: Sequence[Result]) -> list[int]:
    """The line by which each result is compared."""
    heads: dict[tuple[str, str], list[int]] = {}
    for result in found:
        if result.tool == "metrics" and result.scope and result.location.line:
            name = result.scope.rpartition("::")[2]
            heads.setdefault((result.location.path, name), []).append(result.location.line)
    functions: dict[str, list[int]] = {}
    for result in found:
        if result.full_id == _OF_FUNCTION and result.location.line:
            functions.setdefault(result.location.path, []).append(result.location.line)
    keys: dict[tuple[str, str], list[int]] = {}
    for result in found:
        if result.full_id in _AGAIN and result.location.line:
            keys.setdefault((result.location.path, _key(result)), []).append(result.location.line)
    lines = []
    for result in found:
        line = result.location.line or 0
        if result.full_id == _KEY:
            last = result.location.end_line or line
            again = keys.get((result.location.path, _key(result)), ())
            line = min((number for number in again if line <= number <= last), default=line)
        if result.full_id == _DEFAULT:
            above = [head for head in functions.get(result.location.path, ()) if line - _HEAD <= head <= line]
            line = max(above, default=line)
        if result.full_id == _AT_THE_END:
            name = result.message.partition(": ")[2].partition("(")[0].rpartition("::")[2]
            line = max((head for head in heads.get((result.location.path, name), ()) if head <= line), default=line)
        lines.append(line)
    return lines


def _key(result: Result) -> str:
    """The key that a message quotes, in whatever quotes."""
    quoted = _QUOTED.search(result.message)
    return quoted[2] if quoted else ""
