# SPDX-License-Identifier: Apache-2.0
"""What the template parameters of a class stand for in its static methods: ``C<T>::make()``, through an alias or a derived class."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import methods
from haros_ci.values.abstract import Callable, Object, Value

if TYPE_CHECKING:
    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk

Arguments = tuple[syntax.Argument, ...]


def of_class(arguments: Arguments) -> tuple[Arguments, Arguments]:
    """The template arguments of a call: those of the class before the function's name, and those of the function."""
    first = arguments[0] if arguments else None
    if type(first) is syntax.Type and first.name == syntax.OF_CLASS:
        return first.arguments, ()
    return (), arguments


def bound(walk: Walk, frame: Frame, callee: syntax.Expression, function: Value, arguments: Arguments) -> Value:
    """*function*, which *callee* names, with the *arguments* of its class template, or those that the name before it stands for."""
    if not isinstance(function, Callable) or function.this is not None or type(callee) is not syntax.Name:
        return function
    owner = function.function.owner
    if not owner or frame.source.separator != "::" or "::" not in callee.name:
        return function
    known = walk.class_of(owner, function.source)
    if known is None or not known[1].templates:
        return function
    kind = walk.type_in(syntax.Type(callee.name.rpartition("::")[0], arguments), frame)
    named = walk.class_of(kind.name, frame.source)
    if named is None:
        return function
    if named[1].name == owner:
        templates = dict(zip(known[1].templates, kind.arguments, strict=False)) or frame.templates
    else:
        own = dict(zip(named[1].templates, kind.arguments, strict=False))
        of_base = methods.templates_of(walk, Object(named[1].name, kind.arguments, named, templates=own), owner)
        templates = dict(of_base or {})
    return replace(function, templates=templates) if templates else function
