# SPDX-License-Identifier: Apache-2.0
"""Pointers to virtual methods of C++: the object's own class decides which method is called by them ([expr.mptr.oper], [class.virtual])."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.follow import bases, methods
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.syntax import Function
from haros_ci.values.abstract import Callable, Object


def final(walk: Walk, function: Callable) -> Callable:
    """The method that overrides *function* in the class of its object; *function* itself where none does, or it is not seen to be virtual."""
    this = function.this
    owner = function.function.owner
    if this is None or this.definition is None or not owner or function.frame is not None:
        return function
    if function.source.separator != "::" or this.definition[1].name == owner:
        return function
    key = ("final", id(this.definition[1]), id(function.function))
    if key not in walk.found:
        walk.found[key] = _overrider(walk, this, function.function)
    found: tuple[Source, Function] | None = walk.found[key]
    return function if found is None else replace(function, source=found[0], function=found[1])


def _overrider(walk: Walk, this: Object, function: Function) -> tuple[Source, Function] | None:
    """The method of the class of *this* that overrides *function*, if it is the only one of its name and number of parameters."""
    assert this.definition is not None
    last = function.name.rpartition("::")[2]
    every = [class_.name for _, class_ in bases.classes(walk, *this.definition)]
    if function.owner not in every or last.startswith("~"):
        return None
    if not any(one.is_virtual for name in every for _, one in walk.index.functions.get(f"{name}::{last}", ())):
        return None
    found = methods.class_method(walk, *this.definition, last)
    if found is None or found[1].owner == function.owner or len(found[1].parameters) != len(function.parameters):
        return None
    is_only = all(_is_only(walk, this.definition[0], f"{name}::{last}") for name in (function.owner, found[1].owner))
    return found if is_only else None


def _is_only(walk: Walk, source: Source, name: str) -> bool:
    """Whether there is one method of that *name* and no overload, but for its declaration."""
    every = [one for _, one in walk.index.near(walk.index.functions, name, source, walk.files)]
    return all(sum((one.body is None) is is_declared for one in every) <= 1 for is_declared in (True, False))
