# SPDX-License-Identifier: Apache-2.0
"""Functions of the workspace that wrap an API: what they make stands where they are called.

``node->create_publisher<T>(topic)`` of a node class that is built on rclcpp's is, to its users, the call that makes the
publisher. A function is taken for a wrapper if it has the name of an API function and is given a text.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from haros_ci.link.run import Run
from haros_ci.link.types import STRINGS
from haros_ci.model.location import Location
from haros_ci.model.program import Function

#: Functions of rclcpp and rclpy that are given a name, and what wrappers of them are called besides.
NAMES = frozenset(
    "create_publisher create_lifecycle_publisher create_subscription create_service create_client create_server "
    "create_generic_publisher create_generic_subscription create_generic_service create_generic_client "
    "create_action_server create_action_client declare_parameter declare_parameter_if_not_declared "
    "declare_or_get_parameter get_or_declare_parameter get_parameter get_parameter_or set_parameter".split()
)


@contextmanager
def through(run: Run, function: Function, location: Location) -> Iterator[None]:
    """While *function* is followed that is called at *location*: the outermost wrapper's call counts."""
    is_outermost = run.context.process is not None and run.outer is None and _is_wrapper(function)
    if is_outermost:
        run.outer = location
    try:
        yield
    finally:
        if is_outermost:
            run.outer = None


def _is_wrapper(function: Function) -> bool:
    name = function.name.rpartition("::")[2].rpartition(".")[2]
    return name in NAMES and any(each.type[0] in STRINGS or not each.type[0] for each in function.parameters)
