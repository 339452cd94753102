# SPDX-License-Identifier: Apache-2.0
"""What one file tells for the metrics of functions and classes; it depends on the file's bytes alone."""

from __future__ import annotations

from dataclasses import astuple
from typing import Any

from haros_ci.records import dataclass, field

#: Counts of paths stop here: nobody tests so many, and products of them would grow without end.
MOST_PATHS = 10**9
#: Nested deeper than this, statements and expressions are not measured.
DEEPEST = 100
MOST_PROBLEMS = 5
TOO_DEEP = "nested too deeply: what is inside is not measured"


@dataclass(frozen=True, slots=True)
class FunctionFacts:
    """A function with a body. *name* is qualified as in a Program; *line* and *column* are its name's.

    *class_name* is the class around it, or for C++ what stands before the last ``::`` of a definition outside (a class
    or a namespace), qualified as far as the file tells. *complexity* is McCabe's, *nesting* the depth of control
    structures, *calls* all calls and *distinct* those of different functions, *paths* Nejmeh's count. *mentions* are the
    names that may be classes, as written; they are kept for functions with a *class_name*.
    """

    name: str
    class_name: str
    line: int
    column: int
    complexity: int
    nesting: int
    calls: int
    distinct: int
    paths: int
    mentions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ClassFacts:
    """A class with a body: *methods* are those that it declares, *available* the public ones that a user may call."""

    name: str
    line: int
    column: int
    methods: int
    available: int
    mentions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FileFacts:
    """The functions and classes of a file in the order of the text, and ``(line, message)`` of what is not measured."""

    functions: tuple[FunctionFacts, ...] = ()
    classes: tuple[ClassFacts, ...] = ()
    problems: tuple[tuple[int, str], ...] = ()


@dataclass(slots=True)
class FunctionCounts:
    """Counters of one function. *apart* counts the paths of its lambdas beyond the first: these run separately."""

    complexity: int = 1
    nesting: int = 0
    calls: int = 0
    names: set[str] = field(default_factory=set)
    apart: int = 0
    is_too_deep: bool = False

    def called(self, name: str) -> None:
        """A call of the function *name*."""
        self.calls += 1
        self.names.add(name)

    def nested(self, depth: int) -> None:
        """A control structure inside *depth* - 1 others."""
        self.nesting = max(self.nesting, depth)


def times(one: int, other: int) -> int:
    """Paths of a sequence, bounded."""
    return min(one * other, MOST_PATHS)


def to_json(facts: FileFacts) -> object:
    """Lists of numbers and texts, for the cache."""
    return [
        [list(astuple(function)) for function in facts.functions],
        [list(astuple(class_)) for class_ in facts.classes],
        [list(problem) for problem in facts.problems],
    ]


def from_json(data: Any) -> FileFacts | None:
    """None if *data* is not what ``to_json`` gives: what lies in a cache is data, not trust."""
    try:
        functions, classes, problems = data
        found = FileFacts(
            tuple(_function(*function) for function in functions),
            tuple(_class(*class_) for class_ in classes),
            tuple((line, message) for line, message in problems),
        )
    except (TypeError, ValueError):
        return None
    return found if _is_sound(found) else None


def _function(*item: Any) -> FunctionFacts:
    *values, mentions = item
    return FunctionFacts(*(*values, tuple(mentions)))


def _class(*item: Any) -> ClassFacts:
    *values, mentions = item
    return ClassFacts(*(*values, tuple(mentions)))


def _is_sound(facts: FileFacts) -> bool:
    texts = [t for f in facts.functions for t in (f.name, f.class_name, *f.mentions)]
    texts += [t for c in facts.classes for t in (c.name, *c.mentions)]
    texts += [message for _, message in facts.problems]
    numbers = [
        n for f in facts.functions for n in (f.line, f.column, f.complexity, f.nesting, f.calls, f.distinct, f.paths)
    ]
    numbers += [n for c in facts.classes for n in (c.line, c.column, c.methods, c.available)]
    numbers += [line for line, _ in facts.problems]
    return all(isinstance(t, str) for t in texts) and all(type(n) is int and 0 <= n <= MOST_PATHS for n in numbers)
