# SPDX-License-Identifier: Apache-2.0
"""Calls that a change adds to functions in which a known finding lies, with the argument by which it is one.

cppcheck reports what an argument leads to where it is used, in the function, and once for all calls. So a further call of that kind makes no
new finding.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import NamedTuple

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import BaselineState, Notification, Result
from haros_ci.results.rule import Level

#: Places that are named; the rest is counted.
MOST = 20
#: What cppcheck says of the call that gives a function a value (``ValueFlow``).
_CALLING = regex(
    r"Calling function '(?P<name>[\w~]{1,200})', (?P<number>\d{1,2})(?:st|nd|rd|th) argument '(?P<value>[^']{1,200})' value is "
)
_NULL = frozenset(("nullptr", "NULL", "0", "0L", "0UL", "{}"))
_KNOWN = frozenset((BaselineState.UNCHANGED, BaselineState.UPDATED))
_CALL = regex(r"\b[A-Za-z_]\w{0,200}(?=[ \t\n]{0,20}\()")
#: Characters before and behind a call that are looked through; calls in a file, and causes, that are.
_LONGEST = 200
MOST_CALLS = 20_000
MOST_CAUSES = 200


class _Cause(NamedTuple):
    """A *value* that a function called *name* gets as its argument *number*, and the finding in which that ends."""

    name: str
    number: int
    value: str
    result: Result


def notes(
    results: Iterable[Result], workspace: Workspace, base: Workspace, renames: Mapping[str, str]
) -> tuple[Notification, ...]:
    """A note for each such call in a file of *workspace* that *base* has otherwise; *results* have their states."""
    causes: dict[str, list[_Cause]] = {}
    for one in islice({(one.name, one.number, one.value): one for one in _causes(results)}.values(), MOST_CAUSES):
        causes.setdefault(one.name, []).append(one)
    if not causes:
        return ()
    old = {file.path: file.digest for file in base.files}
    found = [
        (file.path, line, one)
        for file in workspace.files
        if file.language == "cpp" and old.get(before := renames.get(file.path, file.path)) != file.digest
        for line, one in _new_calls(causes, workspace.text(file.path), base.text(before))
    ]
    shown = tuple(Notification(Level.NOTE, _message(one), path=path, line=line) for path, line, one in found[:MOST])
    left = len(found) - MOST
    more = f"{left} more calls give functions what known findings in them come from, since this change"
    return (*shown, Notification(Level.NOTE, more)) if left > 0 else shown


def _message(one: _Cause) -> str:
    where = f"{one.result.location.path}:{one.result.location.line}"
    return (
        f"since this change {one.name}() is given {one.value} here, too: the known finding {one.result.full_id} at {where} says what that leads to; "
        "look at it"
    )


def _causes(results: Iterable[Result]) -> Iterator[_Cause]:
    for result in results:
        if result.state in _KNOWN:
            for step in (*result.related, *result.flow):
                match = _CALLING.search(step.message)
                if match is not None:
                    yield _Cause(match["name"], int(match["number"]), match["value"], result)


def _new_calls(causes: Mapping[str, list[_Cause]], now: str, before: str) -> Iterator[tuple[int, _Cause]]:
    """The lines of such calls in the text *now* that are more than in *before*, of like lines the last ones."""
    if not any(name in now for name in causes):
        return
    known = Counter((text, one[:3]) for _, text, one in _calls(causes, before))
    for line, text, one in _calls(causes, now):
        if known[text, one[:3]]:
            known[text, one[:3]] -= 1
        else:
            yield line, one


def _calls(causes: Mapping[str, list[_Cause]], text: str) -> Iterator[tuple[int, str, _Cause]]:
    """The lines of the calls, their texts as far as they are near, and the causes that they are like."""
    line, last = 1, 0
    every = (match for match in _CALL.finditer(text) if match[0] in causes)
    for match in islice(every, MOST_CALLS):
        begin = match.start()
        for one in causes[match[0]]:
            given = _argument(text, text.index("(", begin) + 1, one.number)
            if given is not None and _plain(given) == _plain(one.value):
                line, last = line + text.count("\n", last, begin), begin
                around = text[max(0, begin - _LONGEST) : begin].rpartition("\n")[2]
                yield line, (around + text[begin : begin + _LONGEST].partition("\n")[0]).strip(), one


def _argument(text: str, at: int, number: int) -> str | None:
    """The argument *number* of the call whose arguments begin at *at*; None if it has none, or is too long."""
    depth, begin, count = 0, at, 1
    for place in range(at, min(len(text), at + _LONGEST)):
        sign = text[place]
        if sign in "([{":
            depth += 1
        elif sign in ")]}" and depth:
            depth -= 1
        elif sign == ")" or (sign == "," and not depth):
            if count == number:
                return text[begin:place].strip()
            if sign == ")":
                return None
            begin, count = place + 1, count + 1
    return None


def _plain(value: str) -> str:
    """*value* without blanks; one word for all null pointers."""
    value = "".join(value.split())
    return "nullptr" if value in _NULL else value
