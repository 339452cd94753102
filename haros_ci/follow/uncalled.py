# SPDX-License-Identifier: Apache-2.0
"""Functions that a program keeps, in containers before all, and that it is not seen to call: which is called there is not known.

Lambdas and bound functions that could make something, and have neither been called nor registered once all callbacks have been followed,
are called back after these, where the program calls a function that is not known. A doubt says of what they make that this is not certain.
A lambda in a variable of which the code has no use but calls is kept nowhere. So are, in Python, the methods of objects whose base class a
library has: nothing says which of them it calls, and one that the program calls itself is known by that call.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow.made import Root
from haros_ci.follow.walk import ROOTS, Walk
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Callable, Value
from haros_ci.values.state import Writes

#: Why what they make may not be made.
KEPT = "the function around it is kept, and it is not seen which of those that are kept is called"


def keep(walk: Walk, value: Value) -> Value:
    """Note a function that the program has made, and give it."""
    if isinstance(value, Callable) and not walk.quiet and not walk.is_raised and not walk.setting:
        key = (id(value.function), value.this)
        if key not in walk.held and len(walk.held) < ROOTS:
            walk.held[key] = Root(value, tuple(walk.conditions), doubt=KEPT, dead=walk.ruled_out())
    return value


def offer(walk: Walk, function: Callable, doubt: str) -> None:
    """Note a method that a library may call, for the reason *doubt*."""
    key = (id(function.function), function.this)
    if key not in walk.held and len(walk.held) < ROOTS and not (walk.quiet or walk.is_raised or walk.setting):
        walk.held[key] = Root(function, tuple(walk.conditions), doubt=doubt, dead=walk.ruled_out())


def hand_on(walk: Walk, known: int, writes: Writes) -> None:
    """The functions that were kept after the first *known* ones begin with the *writes* of the callback that did it."""
    for key in list(walk.held)[known:]:
        walk.held[key] = replace(walk.held[key], writes=writes)


def register(walk: Walk) -> bool:
    """Whether some that are kept have not been called, and a call may be of them: they are called back now, each once."""
    called = walk.invoked | {id(root.function.function) for root in walk.roots}
    waiting = []
    for key, root in walk.held.items():
        function = root.function
        if key in walk.offered or key[0] in called or (root.doubt == KEPT and not walk.calls_unknown):
            continue
        if walk.relevance.makes(function.function, function.source) and key[0] not in _called_by_name(walk, function):
            walk.offered.add(key)
            waiting.append(root)
    walk.roots += waiting
    return bool(waiting)


def _called_by_name(walk: Walk, function: Callable) -> frozenset[int]:
    """The lambdas of a function's file, by identity, that are in variables whose names the file has in calls of them only."""
    source = function.source
    key = ("called by name", source.path)
    if key not in walk.found:
        held: dict[str, list[int]] = {}
        uses: Counter[str] = Counter()
        for node in everything(source.program.functions):
            if type(node) is syntax.Variable and type(node.init) is syntax.Equals:
                if type(node.init.value) is syntax.Lambda and node.type.name == "auto":
                    held.setdefault(node.name, []).append(node.init.value.function)
            elif type(node) is syntax.Name:
                uses[node.name] += 1
            elif type(node) is syntax.Call and type(node.callee) is syntax.Name:
                uses[node.callee.name] -= 1
        numbers = [number for name, found in held.items() if not uses[name] for number in found]
        walk.found[key] = frozenset(id(source.program.functions[number]) for number in numbers)
    found: frozenset[int] = walk.found[key]
    return found
