# SPDX-License-Identifier: Apache-2.0
"""The names that functions, and all that they call, assign to."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import chain
from sys import intern

from haros_ci.index.assigned import targets
from haros_ci.index.index import Index, Source
from haros_ci.syntax import Class, Function
from haros_ci.syntax.walk import Part

#: The functions and classes that a name may mean; the names that are called in a block.
Meant = Callable[[str], Iterable[tuple[Source, Function | Class]]]
Called = Callable[[Part, Source], frozenset[str]]
Names = frozenset[str]


class NameSets:
    """Sets of names that are equal are one object: functions of one library mostly reach the same."""

    def __init__(self) -> None:
        self._sets: dict[Names, Names] = {}
        self._pairs: dict[tuple[Names, Names], tuple[Names, Names]] = {}
        self._targets: dict[int, tuple[Part, Names]] = {}

    def one(self, names: Iterable[str]) -> Names:
        """The set of *names*, which are ones of the index."""
        return self._sets.setdefault(made := frozenset(names), made)

    def pair(self, one: Names, other: Names) -> tuple[Names, Names]:
        """The pair of two sets that ``one`` has given."""
        return self._pairs.setdefault(made := (one, other), made)

    def assigned(self, block: Part) -> Names:
        """The names that *block* assigns to by itself."""
        known = self._targets.get(id(block))
        if known is None:
            found: set[str] = set()
            targets(block, found)
            known = self._targets[id(block)] = (block, self.one(map(intern, found)))
        return known[1]


class ChangedNames:
    """For functions of one view of the workspace, what *meant* gives for names there, and *called* for blocks."""

    def __init__(self, index: Index, sets: NameSets, meant: Meant, called: Called) -> None:
        self._index, self._sets, self._meant, self._called = index, sets, meant, called
        self._known: dict[int, tuple[Function, Names, Names]] = {}
        #: By name, what its functions assign to by themselves, and what they call.
        self._steps: dict[str, tuple[Names, Names]] = {}

    def of(self, function: Function, source: Source) -> Names:
        """The names that a function, or anything that it calls, assigns to; the trace of the index learns all names that this depends on."""
        if id(function) not in self._known:
            self._known[id(function)] = (function, *self._reached(function, source))
        _, known, names = self._known[id(function)]
        trace = self._index.trace
        if trace is not None and trace.effects.get(id(function), (None, None, None))[2] is not known:
            trace.names |= names
            trace.effects[id(function)] = (source, function, known)
        return known

    def _reached(self, function: Function, source: Source) -> tuple[Names, Names]:
        """The names that a function, or anything that it calls, assigns to, and those that are called."""
        assigned, reached, waiting = set[str](), set[str](), set[str]()
        if function.body is not None:
            assigned |= self._sets.assigned(function.body)
            waiting |= self._called(function.body, source)
        while waiting:
            name = waiting.pop()
            reached.add(name)
            inner, calls = self._steps.get(name) or self._step(name)
            assigned |= inner
            waiting |= calls - reached
        return self._sets.one(assigned), self._sets.one(reached)

    def _step(self, name: str) -> tuple[Names, Names]:
        found = [(f.body, where) for where, f in self._meant(name) if isinstance(f, Function) and f.body is not None]
        assigned = self._sets.one(chain.from_iterable(self._sets.assigned(body) for body, _ in found))
        calls = self._sets.one(chain.from_iterable(self._called(body, where) for body, where in found))
        step = self._steps[name] = self._sets.pair(assigned, calls)
        return step
