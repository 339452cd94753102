# SPDX-License-Identifier: Apache-2.0
"""What a change makes too large, or too deeply nested, to be analysed: what is wrong in it would not be found."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from haros_ci.model.workspace import Problem
from haros_ci.systems.following import FAULT
from haros_ci.systems.work import TOO_MUCH

#: Words of the messages that say that a limit was reached: no file that people write does so by chance.
_LIMITS = (
    FAULT,
    TOO_MUCH,
    "; split it",
    "aliases; write them out",
    "flatten or split",
    "followed for the first ones",
    "is not read",
    "nested deeper than",
    "nested too deep",
    "split the file",
    "takes too long to follow",
    "takes too many steps",
    "the rest is ignored",
    "the rest is not read",
    "too large to be followed",
    "too long to be read",
    "too long to follow",
    "too many branches",
)
#: Code that compilers understand and haros-ci does not: a macro in the way, which many files have.
_NO_LIMIT = "syntax that is not understood"


def cut_short(
    problems: Iterable[Problem], past: Callable[[], Iterable[Problem]], renames: Mapping[str, str]
) -> Iterator[Problem]:
    """The first of *problems* of each file that says that a limit was reached, where the base revision has none that says so of this file.

    *past* gives the problems of the base revision, *renames* maps paths there to those of now. The limit of the workspace is named once, with the
    number of programs that are left out, at the first of them.
    """
    now: dict[tuple[str, bool], Problem] = {}
    for problem in problems:
        if _is_limit(problem):
            now.setdefault((problem.path, problem.message == TOO_MUCH), problem)
    if not now:
        return
    for problem in filter(_is_limit, past()):
        now.pop((renames.get(problem.path, problem.path), problem.message == TOO_MUCH), None)
    left_out = [problem for problem in now.values() if problem.message == TOO_MUCH]
    yield from (problem for problem in now.values() if problem.message != TOO_MUCH)
    if left_out:
        more = f" ({len(left_out) - 1} more likewise)" if len(left_out) > 1 else ""
        yield replace(left_out[0], message=f"{TOO_MUCH}{more}")


def _is_limit(problem: Problem) -> bool:
    message = problem.message
    return _NO_LIMIT not in message and any(words in message for words in _LIMITS)
