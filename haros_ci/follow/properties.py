# SPDX-License-Identifier: Apache-2.0
"""Python's properties, where what is read calls a method and what is assigned to calls another, and class methods (docs.python.org/3/library/functions.html)."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, expressions, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.mentions import PROPERTIES
from haros_ci.syntax import Function
from haros_ci.values.abstract import Callable, ClassValue, Object, Value

#: Decorators of methods that are called on the class.
OF_CLASS = frozenset(("classmethod", "abstractclassmethod"))


def is_property(function: Function) -> bool:
    """Whether a method is called where its name is read."""
    return any(isinstance(d, (syntax.Name, syntax.Member)) and d.name in PROPERTIES for d in function.decorators)


def _is_of_class(function: Function | None) -> bool:
    """Whether the first argument of a method is its class."""
    return (
        function is not None
        and function.is_static
        and any(isinstance(d, (syntax.Name, syntax.Member)) and d.name in OF_CLASS for d in function.decorators)
    )


def of_class(owner: ClassValue, source: Source, function: Function) -> Callable:
    """A method as the class *owner* has it: a class method is called on it."""
    if not _is_of_class(function):
        return Callable(source, function)
    return Callable(source, function, Object(owner.definition.name, (), (owner.source, owner.definition)))


def this(function: Function | None, held: Object) -> Value:
    """What the first argument of a method is that is called on *held*: the object, or its class."""
    return ClassValue(*held.definition) if held.definition is not None and _is_of_class(function) else held


def assigned(walk: Walk, frame: Frame, target: syntax.Member, value: Value) -> bool:
    """Whether a property of a class of the workspace is assigned to, which its setter does."""
    if not _has_setter(walk, target.name):
        return False
    owner = expressions.evaluate(walk, frame, target.object)
    method = _setter(walk, owner, target.name) if isinstance(owner, Object) else None
    if method is not None:
        activation.invoke(walk, frame, method, (call_arguments.PassedArgument(value),))
    return method is not None


def _setter(walk: Walk, this: Object, name: str) -> Callable | None:
    """The method that an assignment to an attribute calls, of the object's class or its bases; None if there is none."""
    if this.definition is None:
        return None
    found = methods.method_of(walk, this, name)
    if found is None:
        return None
    owner = found.function.owner
    own = [
        (source, function)
        for source, function in walk.index.functions.get(f"{owner}.{name}", ())
        if source.path == found.source.path and _is_setter(function)
    ]
    return Callable(own[-1][0], own[-1][1], this) if own else None


def _has_setter(walk: Walk, name: str) -> bool:
    """Whether an attribute of that name has a setter in some class."""
    key = ("setters",)
    if key not in walk.found:
        walk.found[key] = frozenset(
            name.rpartition(".")[2]
            for name, found in dict.items(walk.index.functions)
            if any(source.separator == "." and _is_setter(function) for source, function in found)
        )
    return name in walk.found[key]


def _is_setter(function: Function) -> bool:
    return any(type(d) is syntax.Member and d.name == "setter" for d in function.decorators)
