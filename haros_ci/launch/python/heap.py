# SPDX-License-Identifier: Apache-2.0
"""The budget of an interpretation, and journals of what a branch changes, so that branches can be joined."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.values import (
    Absent,
    Choice,
    LaunchObject,
    Maybe,
    PartialText,
    Rest,
    ScriptInstance,
    Unknown,
    Value,
)
from haros_ci.model.launch_actions import Test
from haros_ci.records import dataclass, field

STEPS = 100_000
SIZE = 4_000_000  # characters and items made, all together
LARGEST = 200_000  # characters of one text, items of one list
DEPTH = 110  # expressions, statements and calls within one another
CALLS = 16
LOOP = 5_000


class ScriptBudgetExhausted(Exception):
    """The budget is used up."""


@dataclass(slots=True)
class Budget:
    """What is used of the limits above: *steps* and *size* never exceed theirs."""

    steps: int = 0
    size: int = 0
    depth: int = 0
    calls: int = 0
    failures: int = 0

    def step(self, count: int = 1) -> None:
        if self.steps + count > STEPS:
            self.steps = STEPS
            raise ScriptBudgetExhausted("it takes too many steps")
        self.steps += count

    def restart(self) -> None:
        """Begin anew, for a function that is interpreted later."""
        self.steps = self.size = self.depth = self.calls = 0

    def take(self, count: int) -> None:
        if self.size + count > SIZE:
            raise ScriptBudgetExhausted("it makes too much data")
        self.size += count


Journal = dict[int, tuple[Any, Any]]


@dataclass(slots=True)
class Heap:
    """Journals, innermost last: each knows the contents that a container had when it was opened."""

    budget: Budget
    journals: list[Journal] = field(default_factory=list)
    births: list[dict[int, Any]] = field(default_factory=list)

    def born(self, container: Any) -> None:
        """*container* has just been made: for the journals that are open it has no earlier contents."""
        if self.births:
            self.births[-1][id(container)] = container

    def touch(self, container: Any) -> None:
        """To be called before *container* (a list, dict or set) is changed."""
        saved = None
        for journal, births in zip(reversed(self.journals), reversed(self.births), strict=True):
            if id(container) in journal or id(container) in births:
                return
            if saved is None:
                self.budget.take(len(container) + 1)
                saved = container.copy()
            journal[id(container)] = (container, saved)

    def open(self) -> Journal:
        if len(self.journals) >= 40:
            raise ScriptBudgetExhausted("it has too many branches within one another")
        journal: Journal = {}
        self.journals.append(journal)
        self.births.append({})
        return journal

    def close(self, journal: Journal) -> Journal:
        """End *journal* (and those within) and put everything back; what was there at the end is given."""
        index = next(i for i, item in enumerate(self.journals) if item is journal)
        for births in self.births[index:]:
            if index:
                self.births[index - 1].update(births)
        del self.journals[index:], self.births[index:]
        after = {key: (container, container.copy()) for key, (container, _) in journal.items()}
        for container, saved in journal.values():
            put(container, saved)
        return after

    def join(self, first: Journal, second: Journal, tests: tuple[Test, Test], drop: tuple[bool, bool]) -> None:
        """Leave what either of two branches left; of a branch that is to be dropped nothing counts."""
        keys = {**first, **second}
        for key, (container, _) in keys.items():
            self.touch(container)
            one = first[key][1] if key in first else container.copy()
            other = second[key][1] if key in second else container.copy()
            self.budget.step(len(one) + len(other) + 1)
            if drop[0] or drop[1]:
                put(container, one if drop[1] else other)
            else:
                put(container, joined(container, one, other, tests))


def put(container: Any, contents: Any) -> None:
    """Give *container* other contents."""
    if isinstance(container, list):
        container[:] = contents
    else:
        container.clear()
        container.update(contents)


def joined(base: Any, one: Any, other: Any, tests: tuple[Test, Test]) -> Any:
    """The contents that a container has after one branch or the other."""
    if isinstance(base, dict):
        return joined_maps(one, other, tests)
    if isinstance(base, set):
        return one if one == other else {*(one & other), Rest(reason(tests[0]), tests[0].location)}
    common = 0
    while common < min(len(one), len(other)) and same(one[common], other[common]):
        common += 1
    if common < len(base):
        if len(one) == len(other):
            return [either(a, b, tests) for a, b in zip(one, other, strict=True)]
        return [*one[:common], Rest(reason(tests[0]), tests[0].location)]
    return [
        *one[:common],
        *(guarded(item, tests[0]) for item in one[common:]),
        *(guarded(item, tests[1]) for item in other[common:]),
    ]


def guarded(item: Value, test: Test) -> Value:
    """*item* of a list, if *test* holds as well."""
    if isinstance(item, Rest):
        return item
    return Maybe(item.value, (test, *item.tests)) if isinstance(item, Maybe) else Maybe(item, (test,))


def joined_maps(one: dict[Any, Value], other: dict[Any, Value], tests: tuple[Test, Test]) -> dict[Any, Value]:
    result = {}
    for key in {**one, **other}:
        if key in one and key in other:
            result[key] = either(one[key], other[key], tests)
        else:
            index = 0 if key in one else 1
            value = one[key] if key in one else other[key]
            lost = Absent(reason(tests[0]), tests[0].location)
            result[key] = Choice(lost.reason, lost.location, (((tests[index],), value), ((tests[1 - index],), lost)))
    return result


def either(one: Value, other: Value, tests: tuple[Test, Test]) -> Value:
    """One value or the other: itself if they are the same."""
    if same(one, other):
        return one
    options = (*options_of(one, tests[0]), *options_of(other, tests[1]))
    if len(options) > 16:
        return Unknown(reason(tests[0]), tests[0].location)
    return Choice(reason(tests[0]), tests[0].location, options)


def options_of(value: Value, test: Test) -> tuple[tuple[tuple[Test, ...], Value], ...]:
    if isinstance(value, Choice):
        return tuple(((test, *tests), item) for tests, item in value.options)
    return (((test,), value),)


def same(one: Value, other: Value) -> bool:
    """Whether two values are surely the same; data is not compared in depth."""
    if one is other:
        return True
    if type(one) is not type(other) or isinstance(
        one, (Unknown, PartialText, LaunchObject, ScriptInstance, list, dict, set, tuple, Maybe)
    ):
        return (
            isinstance(one, tuple)
            and isinstance(other, tuple)
            and len(one) == len(other) < 20
            and all(map(same, one, other))
        )
    return bool(one == other)


def reason(test: Test) -> str:
    """Why what stands under *test* is not known."""
    return test.reason or (f"depends on `{test.text}`" if test.text else "depends on a condition")
