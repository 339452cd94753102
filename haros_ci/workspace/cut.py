# SPDX-License-Identifier: Apache-2.0
"""Lists of notes that are cut: none hides what stands behind its end, so the rest is counted, and named in a row."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.model.workspace import Problem

#: Files of the rest that are named.
_MOST_NAMED = 100


def cut(problems: Iterable[Problem], most: int) -> tuple[Problem, ...]:
    """The first *most* of *problems*, and one beside the first that counts the rest and names its files: notes are sorted by their files, and a report cuts them again."""
    every = tuple(problems)
    rest = every[most:]
    if not rest:
        return every
    paths = list(dict.fromkeys(problem.path for problem in rest))
    more = f" and {len(paths) - _MOST_NAMED:,} other files" if len(paths) > _MOST_NAMED else ""
    text = f"there are {len(rest):,} more than the next {most} of this kind, in {', '.join(paths[:_MOST_NAMED])}{more}; look at them, too"
    return (every[0], Problem(every[0].path, text), *every[1:most])
