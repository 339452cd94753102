# SPDX-License-Identifier: Apache-2.0
"""Calls into libraries: functions, constructors, and methods that a class of the workspace has from a library."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import (
    beside,
    braces,
    call_arguments,
    calling_macros,
    construct,
    copies,
    expressions,
    follow,
    linear,
    methods,
    specialisations,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import harmless, library
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import api_rows, given_nodes, outside_nodes, ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.index.types import MAPS, SEQUENCES, STRINGS, is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Expression
from haros_ci.values.abstract import NONE, Callable, Cell, ClassValue, Library, Object, Opaque, Sequence, Value


def inherited_call(
    walk: Walk,
    frame: Frame,
    this: Object,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A method of a library's class that *this* has from it, called by its name or as ``Base::method``."""
    head, _, last = name.rpartition("::")
    owners = library_objects.owners(walk, this)
    if head:
        meant = walk.type_in(syntax.Type(head), frame).name
        named = [n for n, owner in enumerate(owners) if meant == owner or head == owner.rpartition("::")[2]]
        owners = owners[named[0] :] if named else []
    for owner in owners:
        if (called := f"{owner}::{last}") not in walk.rows:
            continue
        found = api_rows.call(walk, frame, called, this, args, targs, location)
        if found is not None:
            return found
    return outside_nodes.method(walk, frame, this, name, args, targs, location)


def library_method(
    walk: Walk,
    frame: Frame,
    this: Object,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """The method *name* that a library's class gives *this*, as rows know it; None where none does."""
    for owner in library_objects.owners(walk, this):
        if (called := f"{owner}{frame.source.separator}{name}") not in walk.rows:
            continue
        found = api_rows.call(walk, frame, called, this, args, targs, location)
        if found is not None:
            return found
    return None


def of_object(
    walk: Walk,
    frame: Frame,
    receiver: Value,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """Python's ``Class.method(this, ...)``, also as ``type(this).method(this, ...)``: the method *name* that a library's class gives the object which comes first; None for all else."""
    if frame.source.separator != "." or not args or args[0].keyword or name.startswith("__"):
        return None
    this = args[0].value
    if not isinstance(this, Object):
        return None
    if isinstance(receiver, ClassValue):
        if this.definition is None or methods.class_method(walk, receiver.source, receiver.definition, name):
            return None
        above = linear.of_workspace(linear.order(walk, *this.definition))
        is_one = any(definition is receiver.definition for _, definition in above)
    elif isinstance(receiver, Library) and receiver.this is None:
        is_one = receiver.name in library_objects.owners(walk, this)
    else:
        return None
    return library_method(walk, frame, this, name, args[1:], targs, location) if is_one else None


#: Functions in which callbacks are called; loops are another matter (``Loop.runs_on``).
SPINNING = frozenset(
    "ros::spin ros::spinOnce ros::waitForShutdown rospy.spin rospy.sleep rospy.wait_for_message rospy.wait_for_service "
    "rclcpp::spin rclcpp::spin_some rclcpp::spin_until_future_complete rclpy.spin rclpy.spin_once "
    "rclpy.spin_until_future_complete".split()
)


def library_call(  # noqa: C901 - one branch for each kind of library
    walk: Walk,
    frame: Frame,
    function: Library,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
    callee: Expression,
) -> Value:
    """A function, method or constructor of a library."""
    name = function.name
    if name in SPINNING:
        outside_nodes.spun(walk, args, location)
        follow.interlude(walk, frame)
    elif beside.come_while_waiting(walk, name):
        follow.meanwhile(walk, frame)
    if name in outside_nodes.STARTING and not walk.quiet:
        walk.started = walk.started or location
    base, dot, last = name.rpartition(".")
    if last == "__init__" and dot and args and base in walk.rows and isinstance(args[0].value, Object):
        library_objects.construct_library(walk, frame, args[0].value, syntax.Type(base), args[1:], location)
        return NONE
    unbound = _of_first_argument(walk, frame, name, args, targs, location)
    if unbound is not None:
        return unbound
    kind = frame.templates.get(callee.name) if type(callee) is syntax.Name else None
    if type(kind) is syntax.Type:  # what a template parameter stands for
        return construct.of_template(walk, frame, kind, args, location)
    if function.this is None and frame.this is not None and type(callee) is syntax.Name:  # an inherited method
        inherited = inherited_call(walk, frame, frame.this, callee.name, args, targs, location)
        if inherited is not None:
            return inherited
    if isinstance(function.this, Object) and frame.source.separator == ".":  # a method under another name
        for owner in library_objects.owners(walk, function.this):
            called = f"{owner}.{last}"
            bound = (
                api_rows.call(walk, frame, called, function.this, args, targs, location)
                if called in walk.rows
                else None
            )
            if bound is not None:
                return bound
    modelled = library.function(walk, frame, name, args, targs, location)
    if modelled is not None:
        return modelled
    kinds = tuple(walk.type_in(t, frame) if type(t) is syntax.Type else t for t in targs)
    if name == ros2_nodes.NODE_OPTIONS and len(args) == 1 and isinstance(args[0].value, (Object, Opaque)):
        return copies.copied(walk, args[0].value, syntax.Type(name))
    found = api_rows.call(walk, frame, name, function.this, args, targs, location, kinds)
    if found is not None:
        return found
    if name in STRINGS or name in SEQUENCES or name in MAPS:
        return _filled(walk, frame, syntax.Type(name, kinds), callee, args, location)
    modelled = construct.made_by_its_class(walk, frame, callee, kinds, args, location)
    modelled = modelled or library.instance(walk, frame, syntax.Type(name, kinds), args)
    if modelled is not None:
        return modelled
    if type(callee) is syntax.Name and "::" not in name and frame.source.separator == "::":
        resolved = walk.type_in(syntax.Type(callee.name, targs), frame)
        if resolved.name != name or is_smart_pointer(resolved) or resolved.name in STRINGS:
            return construct.create(walk, frame, resolved, args, location)
    made = _made(walk, frame, name, kinds, args, location) or _one(walk, frame, name, args, location)
    if made is None:
        calling_macros.note(walk, frame, name, location)
    if made is not None:
        return made
    given_nodes.to_function(walk, name, args, location)
    return library.unknown_call(walk, frame, name, args)


def _of_first_argument(
    walk: Walk,
    frame: Frame,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """``Node.create_publisher(self, ...)`` of Python: the method of a library's class, called with its object; None where it is none."""
    base, dot, last = name.rpartition(".")
    this = args[0].value if dot and args and frame.source.separator == "." else None
    if not isinstance(this, Object) or this.definition is None or base not in library_objects.owners(walk, this):
        return None
    return library_method(walk, frame, this, last, args[1:], targs, location)


#: Arguments from which on a list under another name of its type has braces around them.
BRACED = 3


def _filled(
    walk: Walk,
    frame: Frame,
    kind: syntax.Type,
    callee: Expression,
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value:
    """A text or container that is constructed.

    The facts of the code do not say which of ``Names(2, "a")`` and ``Names{"a", "b"}`` stands there, of another name of a list's type.
    """
    if type(callee) is not syntax.Name or _last(callee.name) == _last(kind.name):
        return construct.create(walk, frame, kind, args, location)
    kind = kind if kind.arguments else walk.type_in(syntax.Type(callee.name), frame)
    if kind.name not in SEQUENCES or not args or isinstance(args[0].value, Sequence):
        return construct.create(walk, frame, kind, args, location)
    if len(args) >= BRACED or all(map(braces.is_text, args)):
        return braces.from_list(walk, frame, kind, Sequence(Cell(tuple(Cell(argument.value) for argument in args))))
    return walk.opaque("whether it is made with braces is not known under another name of its type", frame, None, kind)


def _last(name: str) -> str:
    return name.rpartition("::")[2]


def _made(
    walk: Walk,
    frame: Frame,
    name: str,
    kinds: tuple[syntax.Argument, ...],
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value | None:
    """``make_it<T>(args)`` of a library that is not known, as ``std::make_unique``, for a class T of the workspace: an object of it."""
    if not name.rpartition("::")[2].startswith("make_") or not kinds or type(kinds[0]) is not syntax.Type:
        return None
    if walk.class_of(kinds[0].name, frame.source) is None:
        return None
    return construct.create(walk, frame, kinds[0].bare(), args, location)


def _one(
    walk: Walk, frame: Frame, name: str, args: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value | None:
    """``T::instance()`` that a class T of the workspace has from a base class ``Singleton<T>`` which is not here: the one object of it."""
    head, _, last = name.rpartition("::")
    owner = walk.class_of(walk.type_in(syntax.Type(head), frame).name, frame.source) if head and not args else None
    if owner is None or not last.lower().endswith("instance"):
        return None
    own = owner[1].name.rpartition("::")[2]
    named = (argument.name for base in owner[1].bases for argument in base.arguments if type(argument) is syntax.Type)
    if own not in {item.rpartition("::")[2] for item in named}:
        return None
    key = (f"the one of {owner[0].path}", owner[1].name)
    cell = walk.statics.get(key)
    if cell is None:
        cell = Cell(construct.instance(walk, frame, owner, (), (), location))
        if not walk.quiet:  # what is made in a rehearsal is made again
            walk.statics[key] = cell
    found: Value = cell.value
    return found


def of_no_specialisation(
    walk: Walk,
    frame: Frame,
    function: Callable,
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value:
    """A call of a template of which only specialisations for other arguments are seen."""
    name = function.function.name
    if walk.relevance.makes(function.function, function.source) or walk.relevance.named(name):
        walk.gaps.setdefault(specialisations.NOT_SEEN.format(name), location)
    return library.unknown_call(walk, frame, name, args)


def ends_the_program(walk: Walk, frame: Frame, expression: Expression) -> bool:
    """Whether a statement is a call of ``exit`` and its kin: nothing comes after it."""
    callee = expression.callee if type(expression) is syntax.Call else None
    if callee is None or syntax.name_of(callee).rpartition("::")[2] not in harmless.EXITS:
        return False
    called = expressions.evaluate(walk, frame, callee)
    return isinstance(called, Library) and called.name.removeprefix("::") in harmless.ENDING
