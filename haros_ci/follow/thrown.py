# SPDX-License-Identifier: Apache-2.0
"""Exceptions that reading a parameter raises which nothing sets: they end a loop that has no other known end.

``rospy.get_param`` raises KeyError (rospy/client.py), ``get_parameter`` ParameterNotDeclaredException (rclpy/node.py, rclcpp/exceptions.hpp).
Elsewhere a node is followed as if its parameters were set: what it makes then is of interest.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from haros_ci import syntax

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk
    from haros_ci.model.location import Location
    from haros_ci.syntax import Expression

#: What a handler's text has that catches these exceptions; one without a type catches all.
CATCHING = ("KeyError", "LookupError", "Exception", "exception", "ParameterNotDeclared", "runtime_error", "...")


def raises(walk: Walk, name: str, location: Location, is_set: bool) -> bool:
    """Whether reading a parameter without a default, which something sets or nothing, raises an exception that ends a loop.

    In the first turn a loop goes on as if it were set. A later turn that asks for another name at that place raises, and has
    not come to that (``walk.is_raised``) where the first one had nothing either.
    """
    loop = next((loop for loop in reversed(walk.turning) if loop.is_endless), None)
    if loop is None or walk.dead or "?" in name:
        return False
    requested = loop.asked.setdefault(location, {})
    if is_set or not loop.turn:
        requested[name] = is_set
        return False
    if not requested or requested.get(name) is False:
        return False
    walk.is_raised = not all(requested.values())
    return True


def catches(handler: syntax.Handler) -> bool:
    """Whether a handler catches what ``raises`` tells of."""
    text = f"{handler.text} {handler.type.name}"
    return not text.strip() or any(word in text for word in CATCHING)


def is_endless(test: Expression | None) -> bool:
    """Whether the test of a loop tells nothing of how long it goes on: it is always true, or a flag."""
    if isinstance(test, (syntax.Boolean, syntax.Number)):
        return bool(test.value)
    return test is None or isinstance(test, (syntax.Name, syntax.Member))


@contextmanager
def left(walk: Walk, handlers: tuple[syntax.Handler, ...]) -> Iterator[None]:
    """In the block of a ``try`` whose *handlers* leave the loop around it, exceptions end that loop."""
    loop = walk.loops[-1] if walk.loops else None
    if loop is None or loop.is_endless or not _leaves(handlers):
        yield
        return
    loop.is_endless = True
    try:
        yield
    finally:
        loop.is_endless = False


def _leaves(handlers: tuple[syntax.Handler, ...]) -> bool:
    """Whether a handler of these exceptions leaves the loop around it."""
    return any(
        catches(handler) and any(isinstance(last, (syntax.Break, syntax.Return)) for last in handler.body[-1:])
        for handler in handlers
    )
