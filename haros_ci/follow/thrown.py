# SPDX-License-Identifier: Apache-2.0
"""Exceptions: where a block of a ``try`` may be left, with what it has done by then; and those that end a loop.

A call of what is not known may throw, and so may a ``throw`` that is reached. Python raises for certain where a known list has no such
element, a known dictionary no such key, a text is no number; reading a parameter that nothing sets raises, too:
``rospy.get_param`` raises KeyError (rospy/client.py), ``get_parameter`` ParameterNotDeclaredException (rclpy/node.py, rclcpp/exceptions.hpp).
Outside of a ``try`` that catches it a node is followed as if its parameters were set: what it makes then is of interest.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.graph.parameters import Perhaps
from haros_ci.records import dataclass, field
from haros_ci.syntax.walk import everything

if TYPE_CHECKING:
    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk
    from haros_ci.model.location import Location
    from haros_ci.syntax import Expression
    from haros_ci.values.state import Writes

#: The last words of functions that a loop asks whether the program goes on (``early.RUNNING``, and methods such as ``nh.ok()``).
RUNNING = frozenset(("ok", "is_shutdown", "isShuttingDown"))
#: What Python raises where a list has no such element, a dictionary no such key, a text is no number.
INDEX, KEY, NUMBER = ("IndexError", "LookupError"), ("KeyError", "LookupError"), ("ValueError",)
#: What Python raises where an object has no such attribute.
ATTRIBUTE = ("AttributeError",)
#: What is thrown where a parameter is read that ROS 2 has not declared.
UNDECLARED = ("ParameterNotDeclared", "runtime_error", "std::exception")
#: Exceptions of C++ with their bases but for std::exception ([std.exceptions]).
_STANDARD = {
    **{name: (name, "runtime_error") for name in ("runtime_error", "range_error", "overflow_error", "underflow_error")},
    **{
        name: (name, "logic_error")
        for name in ("logic_error", "invalid_argument", "domain_error", "length_error", "out_of_range")
    },
}
#: Places where one block may be left that are kept; the last one stands for all after it.
PLACES = 16

#: What a handler's text has that catches these exceptions; one without a type catches all.
CATCHING = ("KeyError", "LookupError", "Exception", "exception", "ParameterNotDeclared", "runtime_error", "...")


@dataclass(slots=True, eq=False)
class Trial:
    """The block of a ``try`` that is followed in *frame*: what it had written since *mark* wherever it may be left.

    *dead* are the branches around it that are not taken as things are, *depth* the conditions and doubts around it. *is_left* once it is
    left for certain: what follows in it is gone through for what it makes otherwise. *is_read* once a file of the workspace is read in it.
    """

    frame: Frame
    mark: int
    handlers: tuple[syntax.Handler, ...]
    dead: int
    depth: int
    places: list[Writes] = field(default_factory=list)
    is_left: bool = False
    is_read: bool = False


@contextmanager
def tried(walk: Walk, frame: Frame, handlers: tuple[syntax.Handler, ...]) -> Iterator[Trial]:
    """Follow the block of a ``try`` inside; it begins where the state is now."""
    trial = Trial(frame, walk.state.mark(), handlers, walk.dead, depth(walk))
    was_dead, dead = frame.is_dead, walk.dead
    walk.trials.append(trial)
    try:
        yield trial
    finally:
        walk.trials.pop()
        frame.is_dead, walk.dead = was_dead, dead


def may_throw(walk: Walk) -> None:
    """Something is called here that may throw, or does: blocks around it may be left as things are now."""
    for trial in reversed(walk.trials):
        if walk.dead > trial.dead or trial.is_left or trial.frame.is_dead:
            return
        if len(trial.places) == PLACES:
            trial.places.pop()
        trial.places.append(walk.state.since(trial.mark))
        if any(map(_catches_all, trial.handlers)):
            return


def throws(walk: Walk, names: tuple[str, ...] = ()) -> None:
    """An exception of one of the classes *names* (any where there are none) is thrown here, if this is reached."""
    before = [(trial, len(trial.places) if len(trial.places) < PLACES else -1) for trial in walk.trials]
    may_throw(walk)
    for trial, count in reversed(before):
        if len(trial.places) == count or depth(walk) != trial.depth:
            return
        if any(_catches(handler, names) for handler in trial.handlers):
            trial.is_left = trial.frame.is_dead = True
            walk.dead += 1
            return


def may_come_from(walk: Walk, function: syntax.Function) -> bool:
    """Whether a function that is not followed may throw: it calls something, or does so itself."""
    key = ("throws", id(function))
    if key not in walk.found:
        kinds = (syntax.Call, syntax.Throw, syntax.New)
        walk.found[key] = any(isinstance(part, kinds) for part in everything(function.body or ()))
    return bool(walk.found[key])


def is_read(walk: Walk, found: object, names: tuple[str, ...]) -> None:
    """A parameter is read, and *found* (None if nothing sets it); without one an exception of the classes *names* is thrown."""
    if found is None:
        throws(walk, names)
    elif isinstance(found, Perhaps):
        may_throw(walk)


def depth(walk: Walk) -> int:
    """How many conditions there are around what is followed that are not known to hold, and doubts."""
    return len(walk.conditions) - walk.holding + len(walk.doubts)


def classes(walk: Walk, frame: Frame, statement: syntax.Throw) -> tuple[str, ...]:
    """The names of the class that a ``throw`` or ``raise`` names, and of its bases; none where that is not known."""
    value = statement.value
    name = syntax.name_of(value.callee if type(value) is syntax.Call else value) if value is not None else ""
    if not name:
        return ()
    short, found = name.rpartition("::")[2].rpartition(".")[2], [name]
    known = getattr(builtins, short, None) if frame.source.separator == "." else None
    if isinstance(known, type) and issubclass(known, BaseException):
        return tuple(base.__name__ for base in known.__mro__ if base is not object)
    if short in _STANDARD:
        return (*_STANDARD[short], "std::exception")
    owner = walk.class_of(
        walk.type_in(syntax.Type(name), frame).name if frame.source.separator == "::" else name, frame.source
    )
    bases = owner[1].bases if owner is not None else ()
    found += [base.name for base in bases]
    return tuple(item.rpartition("::")[2].rpartition(".")[2] for item in found)


def _catches_all(handler: syntax.Handler) -> bool:
    return _catches(handler, ("...", "Exception"))


def _catches(handler: syntax.Handler, names: tuple[str, ...]) -> bool:
    """Whether a handler catches an exception of one of the classes *names*, or of their bases."""
    text = f"{handler.text} {handler.type.name}"
    return not text.strip() or "..." in text or any(name in text for name in (*names, "Exception"))


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


def asks_whether_it_goes_on(test: Expression | None) -> bool:
    """Whether a loop goes on as long as the program does: other threads call callbacks meanwhile, or functions in it do.

    rospy calls each in a thread of its own, and so does ``ros::AsyncSpinner``.
    """
    calls = (node.callee for node in everything(test) if type(node) is syntax.Call) if test is not None else ()
    names = (callee.name for callee in calls if isinstance(callee, (syntax.Name, syntax.Member)))
    return any(name.rpartition("::")[2].rpartition(".")[2] in RUNNING for name in names)


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
