# SPDX-License-Identifier: Apache-2.0
"""Types that selectors find at a call: of variables, template parameters and callbacks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.ros_types import is_hidden
from haros_ci.records import dataclass
from haros_ci.syntax import Type
from haros_ci.values.abstract import Callable, Object, Pointer

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.follow.ros.selectors import Applied


@dataclass(frozen=True, slots=True)
class TypeValue:
    """A type where a value is expected."""

    type: Type


def hidden_type(applied: Applied, argument: PassedArgument | None) -> TypeValue | None:
    """The type of a variable of C++, the *argument* of a call, that stands for one that nothing tells (``Scalar x = 3``): what it holds does not, either."""
    kind = argument.cell.type if argument is not None and argument.cell is not None else None
    if (
        kind is None
        or kind.arguments
        or "*" in kind.marks
        or not is_hidden(kind)
        or applied.frame.source.separator == "."
    ):
        return None
    index = applied.walk.index
    is_known = kind.name in index.classes or kind.name in index.aliases or kind.name in index.library
    return None if is_known or is_open(applied, kind) else TypeValue(kind)


def is_open(applied: Applied, kind: syntax.Type) -> bool:
    """Whether a type is, or is made of, a template parameter of the function around the call: who calls it is not seen."""
    function = applied.frame.function
    names = {*applied.frame.templates, *(function.templates if function is not None else ())}
    inner = kind.of(0)
    return kind.name in names or (inner is not None and inner.name in names)


def _templates_of(owner: str, every: tuple[PassedArgument, ...]) -> Mapping[str, syntax.Argument]:
    """What the template parameters of the class *owner* stand for in an object of it among the arguments (``&C<T>::cb, &c``)."""
    for argument in every if owner else ():
        value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
        if isinstance(value, Object) and value.definition is not None and value.definition[1].name == owner:
            return value.templates
    return {}


def callback_type(
    walk: Walk, argument: PassedArgument, every: tuple[PassedArgument, ...], index: int
) -> TypeValue | None:
    """The type of a callback's parameter that is not bound; *every* argument of the call may be the object that it is a method of."""
    value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
    if isinstance(value, Object) and value.definition is not None:
        value = methods.method_of(walk, value, "operator()") or value
    if isinstance(value, Callable):
        free = [p for n, p in enumerate(value.function.parameters) if n >= len(value.bound) or value.bound[n] is None]
        if index >= len(free):
            return None
        scope = value.function.owner or value.function.name.rpartition("::")[0]
        templates = value.templates or _templates_of(value.function.owner, every)
        inner = Frame(value.source, scope, value.function, value.this, templates=templates)
        return TypeValue(walk.type_in(free[index].type, inner))
    kind = argument.type or conversions.value_type(value)
    if kind is not None and kind.name in ("boost::function", "std::function") and kind.arguments:
        inner_type = kind.of(0)
        taken = inner_type.of(index + 1) if inner_type is not None and inner_type.name == "()" else None
        if taken is not None:
            return TypeValue(taken)
    return None
