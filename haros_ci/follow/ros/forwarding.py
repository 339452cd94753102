# SPDX-License-Identifier: Apache-2.0
"""Functions of the workspace that wrap an API: what they make stands where they are called.

``node->create_publisher<T>(topic)`` of a node class that is built on rclcpp's is, to its users, the call that makes the
publisher. A function is taken for a wrapper if it has the name of an API function and is given a text.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING

from haros_ci.follow.walk import Walk
from haros_ci.graph.names import UNKNOWN, pattern
from haros_ci.index.types import STRINGS
from haros_ci.model.location import Location
from haros_ci.syntax import Function
from haros_ci.values import iterators
from haros_ci.values.abstract import Choice, Known, Library, Opaque, Text, Value
from haros_ci.values.given import Given, marked

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Functions of rclcpp and rclpy that are given a name, and what wrappers of them are called besides.
NAMES = frozenset(
    "create_publisher create_lifecycle_publisher create_subscription create_service create_client create_server "
    "create_generic_publisher create_generic_subscription create_generic_service create_generic_client "
    "create_action_server create_action_client declare_parameter declare_parameter_if_not_declared "
    "declare_or_get_parameter get_or_declare_parameter get_parameter get_parameter_or set_parameter "
    "declareParameter declare_param getParameter getParam get_param readParameter read_parameter".split()
)

#: The context in which the body of a wrapper is followed; a no-op context for calls that are not the outermost wrapper.
INSIDE = nullcontext()


def through(
    walk: Walk, function: Function, args: tuple[PassedArgument, ...], location: Location
) -> AbstractContextManager[None]:
    """While *function* is followed that is called at *location*: the outermost wrapper's call counts."""
    is_outermost = walk.context.process is not None and walk.outer is None and _is_wrapper(function)
    return _outermost(walk, args, location) if is_outermost else INSIDE


@contextmanager
def _outermost(walk: Walk, args: tuple[PassedArgument, ...], location: Location) -> Iterator[None]:
    values = [argument.value for argument in args if isinstance(argument.value, (Known, Text, Choice, Opaque, Library))]
    every = [_marked(option) for value in values for option in (value, *iterators.options(value))]
    # A number that is given from outside, which has no mark, is no name; it is not looked at.
    texts = [pattern(option)[0] for option in every if not isinstance(option, Given)]
    walk.outer = location, frozenset(text or UNKNOWN for text in texts)
    try:
        yield
    finally:
        walk.outer = None


def _marked(value: Value) -> Value:
    """*value* with marks, also in each of several that it may be."""
    return Choice(tuple(map(marked, value.options))) if isinstance(value, Choice) else marked(value)


def place(walk: Walk, name: str, location: Location) -> Location:
    """Where an endpoint of that *name* stands that the call at *location* makes."""
    if walk.outer is None:
        return location
    marks = walk.context.marks
    whole, texts = marks.real(name), [marks.real(text) for text in walk.outer[1]]
    is_through = any(text in whole for text in texts)
    if is_through is not any(text in name for text in walk.outer[1]):
        marks.looked_at("".join((name, *walk.outer[1])))
    return walk.outer[0] if is_through else location


def _is_wrapper(function: Function) -> bool:
    name = function.name.rpartition("::")[2].rpartition(".")[2]
    return name in NAMES and any(
        parameter.type.name in STRINGS or not parameter.type.name for parameter in function.parameters
    )
