# SPDX-License-Identifier: Apache-2.0
"""A query, ready to be asked of one set of variables after the other."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from haros_ci.query.evaluate import Compiler
from haros_ci.query.fault import QueryError
from haros_ci.query.functions import BUILTINS
from haros_ci.query.machine import STEPS, Machine
from haros_ci.query.parser import parse
from haros_ci.query.syntax import Flwr
from haros_ci.query.values import QueryEntity, QueryList, QueryRecord, Value


class Query:
    """The query with this *text*, for the *variables* with these names; QueryError if it cannot be read."""

    def __init__(self, text: str, variables: Collection[str], steps: int = STEPS) -> None:
        self.text = text
        self.machine = Machine(left=steps)
        self._steps = steps
        tree = parse(text)
        self._is_collection = isinstance(tree, Flwr) and bool(tree.collects)
        try:
            self._run = Compiler(self.machine, {*BUILTINS, *variables}).make(tree, frozenset())
        except RecursionError:
            raise QueryError("the query is nested too deeply") from None

    @property
    def taken(self) -> int:
        """The steps that it has taken so far."""
        return self._steps - self.machine.left

    def matches(self, variables: Mapping[str, Value]) -> tuple[Value, ...]:
        """What the query gives for *variables*, one after the other; QueryError if it cannot be evaluated.

        All the evaluations of one query share its steps.
        """
        machine = self.machine
        machine.variables = {**BUILTINS, **variables}
        machine.cache.clear()
        machine.depth = 0
        try:
            found = self._run({})
        except (RecursionError, MemoryError):
            raise QueryError("the query goes too deep") from None
        except (ArithmeticError, TypeError, ValueError, AttributeError) as err:
            raise QueryError(f"the query cannot be evaluated: {type(err).__name__}") from None
        if self._is_collection:
            maps = (found,) if isinstance(found, QueryRecord) else found
            return tuple(QueryRecord({"key": key, "value": value}) for one in maps for key, value in one.items())
        return tuple(found)

    def notes(self) -> tuple[tuple[int, str], ...]:
        """What HAROS passes over in silence: steps of paths that some element had no attribute for; and where."""
        helps: dict[tuple[int, str], str] = {}
        for (at, name, kind), (_, help) in sorted(self.machine.missing.items()):
            key = (at, f"a {kind} has no attribute {name!r}, so this step gives nothing for it, as in HAROS")
            helps.setdefault(key, help)
        return tuple((at, f"{message}; {help}" if help else message) for (at, message), help in helps.items())


def entities_of(match: Value) -> tuple[QueryEntity, ...]:
    """The entities of a match: itself, or those in the tuple or map that it is (HAROS ``_report``)."""
    if isinstance(match, QueryEntity):
        return (match,)
    if isinstance(match, QueryRecord):
        return tuple(found for item in match.values() for found in entities_of(item))
    if isinstance(match, QueryList):
        return tuple(found for item in match for found in entities_of(item))
    return ()
