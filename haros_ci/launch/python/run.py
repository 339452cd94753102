# SPDX-License-Identifier: Apache-2.0
"""The state of one interpretation."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.heap import LARGEST, Budget, Heap
from haros_ci.launch.python.values import LibraryCall, Module, ScriptScope, ScriptSource, Unknown, Value
from haros_ci.model.launch_actions import Test
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field


@dataclass(slots=True)
class ScriptFrame:
    """A function in progress: what it has returned under tests, what it yields, the journals of its rest."""

    returns: list[tuple[tuple[Test, ...], Value]] = field(default_factory=list)
    yields: list[Value] | None = None
    pending: list[tuple[Any, Test, Test]] = field(default_factory=list)


@dataclass(slots=True)
class ScriptEvaluation:
    """One interpretation: its *budget* and *heap*, and the doors to the workspace.

    *known* says whether a library's name has a summary, *evaluate* gives the value of an expression, *call* calls
    a value, *attribute* is ``x.y``: they are here so that the summaries need not know the interpreter. *places*
    keeps where a literal stands, by the identity of its value. *locate* gives the root-relative path and text of a file by such a path as
    *read* takes; modules are looked for in the directories *first*, before those of packages, and *last*.
    """

    read: Callable[[str], str | None]
    environment: dict[str, Value]
    module: Callable[[str], tuple[str, str] | None]
    locate: Callable[[str], tuple[str, str] | None]
    known: Callable[[str], bool]
    evaluate: Callable[[ScriptEvaluation, ScriptScope, ast.expr], Value]
    block: Callable[[ScriptEvaluation, ScriptScope, list[ast.stmt]], Any]
    call: Callable[[ScriptEvaluation, Value, LibraryCall], Value]
    attribute: Callable[[ScriptEvaluation, Value, str, Location], Value]
    budget: Budget = field(default_factory=Budget)
    heap: Heap = field(default_factory=lambda: Heap(Budget()))
    modules: dict[str, Module] = field(default_factory=dict)
    #: The syntax of the files of modules, by path; None for what is no Python.
    trees: dict[str, ast.Module | None] = field(default_factory=dict)
    frames: list[ScriptFrame] = field(default_factory=list)
    places: dict[int, tuple[Value, Location]] = field(default_factory=dict)
    texts: dict[str, str | None] = field(default_factory=dict)
    first: list[str] = field(default_factory=list)
    last: list[str] = field(default_factory=list)
    #: The files that it writes, in order, and how many paths of temporary ones it has asked for.
    written: list[Value] = field(default_factory=list)
    temporaries: int = 0
    #: How many containers have been made; what loads into one names it by its number.
    containers: int = 0
    #: What launch_ros must accept for this file to be launched at all, by its text.
    doubts: dict[str, Test] = field(default_factory=dict)

    def unknown(self, reason: str, location: Location | None) -> Unknown:
        self.budget.failures += 1
        return Unknown(reason, location)

    def made(self, value: Value, location: Location | None) -> Value:
        """*value*, if it is not too large; its size is taken from the budget."""
        if isinstance(value, (str, bytes, list, tuple, dict, set)):
            if len(value) > LARGEST:
                return self.unknown("it is too large", location)
            if len(value) > 32:
                self.budget.take(len(value))
            if isinstance(value, (list, dict, set)):
                self.heap.born(value)
        elif isinstance(value, int) and not isinstance(value, bool) and value.bit_length() > 4096:
            return self.unknown("the number is too large", location)
        return value

    def place(self, value: Value, default: Location) -> Location:
        found = self.places.get(id(value))
        return found[1] if found is not None and found[0] is value else default

    def apply(self, function: Value, args: tuple[Value, ...], location: Location) -> Value:
        """Call *function* with positional arguments."""
        return self.call(self, function, LibraryCall(name="", location=location, args=args, keywords={}))


def condition(scope: ScriptScope, node: ast.expr, value: Value, word: str = "") -> tuple[Test, Test]:
    """The tests of a branch on a condition that is not known, and of the other one."""
    source: ScriptSource = scope.source
    text, place = source.segment(node), source.place(node)
    cause = value.reason if isinstance(value, Unknown) else "the condition is not known"
    shown = f"{word} {text}".strip()
    return (
        Test(kind="?", text=shown, location=place, reason=cause),
        Test(kind="?", text=f"not ({shown})", location=place, reason=cause),
    )
