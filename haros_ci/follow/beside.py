# SPDX-License-Identifier: Apache-2.0
"""ROS 2: executors that are spun in a thread (``threading.Thread(target=rclpy.spin)``): callbacks are called beside the rest from then on.

A thread begins with a function that is given to one of ``BEGINNING``, or to a library of which nothing is known.
"""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Callable, Library, Object, Pointer, Value
from haros_ci.values.effects import Effects

#: How the last words of what spins begin (rclcpp/executors.hpp, rclpy/__init__.py, rclpy/executors.py).
SPINS = "spin"
#: How the names of what begins threads begin, of the rows that call functions back.
BEGINNING = ("threading.", "concurrent.futures.", "multiprocessing.pool.", "std::", "boost::")
#: The last words of functions that wait: of threads, rates, clocks, futures and clients.
WAITING = ("sleep", "wait")


def note(walk: Walk, *values: Value) -> None:
    """*values* are given to a function that may begin a thread with one of them."""
    if walk.context.process is not None and walk.beside is None and any(_spins(walk, value) for value in values):
        walk.beside = Effects()


def _spins(walk: Walk, value: Value) -> bool:
    """Whether a function that is a value spins, in its own body."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Library):
        return _last(value.name).startswith(SPINS)
    if isinstance(value, Object) and value.definition is None:  # what is bound to its arguments
        return any(
            isinstance(cell.value, (Callable, Library)) and _spins(walk, cell.value) for cell in value.fields.values()
        )
    if not isinstance(value, Callable) or value.function.body is None:
        return False
    key = ("spins", value.source.path, value.function.line, id(value.function))
    found = walk.found.get(key)
    if found is None:
        calls = (part.callee for part in everything(value.function.body) if isinstance(part, syntax.Call))
        found = walk.found[key] = any(_last(_name(callee)).startswith(SPINS) for callee in calls)
    return bool(found)


def come_between_turns(walk: Walk) -> bool:
    """Whether callbacks are called while a loop goes on as long as the program does."""
    return not walk.is_called_back and (walk.context.process is None or walk.beside is not None)


def come_while_waiting(walk: Walk, name: str) -> bool:
    """Whether callbacks are called while the function or method *name* waits."""
    return walk.beside is not None and not walk.is_called_back and _last(name).startswith(WAITING)


def _name(callee: Expression) -> str:
    return callee.name if isinstance(callee, (syntax.Name, syntax.Member)) else ""


def _last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2]
