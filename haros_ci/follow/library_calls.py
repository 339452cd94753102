# SPDX-License-Identifier: Apache-2.0
"""Calls into libraries: functions, constructors, and methods that a class of the workspace has from a library."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import call_arguments, construct, copies, expressions, follow
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import harmless, library
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import api_rows, ros2_nodes
from haros_ci.follow.run import Walk
from haros_ci.index.types import MAPS, SEQUENCES, STRINGS, is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Expression
from haros_ci.values.abstract import NONE, Cell, Library, Object, Opaque, Value


def inherited_call(
    run: Walk,
    frame: Frame,
    this: Object,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A method of a library's class that *this* has from it, called by its name or as ``Base::method``."""
    head, _, last = name.rpartition("::")
    owners = library_objects.owners(run, this)
    if head:
        meant = run.type_in(syntax.Type(head), frame).name
        named = [n for n, owner in enumerate(owners) if meant == owner or head == owner.rpartition("::")[2]]
        owners = owners[named[0] :] if named else []
    for owner in owners:
        if (called := f"{owner}::{last}") not in run.rows:
            continue
        found = api_rows.call(run, frame, called, this, args, targs, location)
        if found is not None:
            return found
    return None


#: Functions in which callbacks are called.
SPINNING = frozenset(
    "ros::spin ros::spinOnce ros::waitForShutdown rospy.spin rospy.sleep rospy.wait_for_message rospy.wait_for_service "
    "rclcpp::spin rclcpp::spin_some rclcpp::spin_until_future_complete rclpy.spin rclpy.spin_once "
    "rclpy.spin_until_future_complete".split()
)


def library_call(
    run: Walk,
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
        follow.interlude(run, frame)
    base, dot, last = name.rpartition(".")
    if last == "__init__" and dot and args and base in run.rows and isinstance(args[0].value, Object):
        library_objects.construct_library(run, frame, args[0].value, syntax.Type(base), args[1:], location)
        return NONE
    kind = frame.templates.get(callee.name) if isinstance(callee, syntax.Name) else None
    if isinstance(kind, syntax.Type):  # what a template parameter stands for
        return construct.of_template(run, frame, kind, args, location)
    if function.this is None and frame.this is not None and isinstance(callee, syntax.Name):  # an inherited method
        inherited = inherited_call(run, frame, frame.this, callee.name, args, targs, location)
        if inherited is not None:
            return inherited
    if isinstance(function.this, Object) and frame.source.separator == ".":  # a method under another name
        for owner in library_objects.owners(run, function.this):
            called = f"{owner}.{last}"
            bound = (
                api_rows.call(run, frame, called, function.this, args, targs, location) if called in run.rows else None
            )
            if bound is not None:
                return bound
    modelled = library.function(run, frame, name, args, targs, location)
    if modelled is not None:
        return modelled
    kinds = tuple(run.type_in(t, frame) if isinstance(t, syntax.Type) else t for t in targs)
    if name == ros2_nodes.NODE_OPTIONS and len(args) == 1 and isinstance(args[0].value, (Object, Opaque)):
        return copies.copied(run, args[0].value, syntax.Type(name))
    found = api_rows.call(run, frame, name, function.this, args, targs, location, kinds)
    if found is not None:
        return found
    if name in STRINGS or name in SEQUENCES or name in MAPS:
        return construct.create(run, frame, syntax.Type(name, kinds), args, location)
    modelled = construct.made_by_its_class(run, frame, callee, kinds, args, location)
    modelled = modelled or library.instance(run, frame, syntax.Type(name, kinds), args)
    if modelled is not None:
        return modelled
    if isinstance(callee, syntax.Name) and "::" not in name and frame.source.separator == "::":
        resolved = run.type_in(syntax.Type(callee.name, targs), frame)
        if resolved.name != name or is_smart_pointer(resolved) or resolved.name in STRINGS:
            return construct.create(run, frame, resolved, args, location)
    made = _made(run, frame, name, kinds, args, location) or _one(run, frame, name, args, location)
    return made if made is not None else library.unknown_call(run, frame, name, args)


def _made(
    run: Walk,
    frame: Frame,
    name: str,
    kinds: tuple[syntax.Argument, ...],
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> Value | None:
    """``make_it<T>(args)`` of a library that is not known, as ``std::make_unique``, for a class T of the workspace: an object of it."""
    if not name.rpartition("::")[2].startswith("make_") or not kinds or not isinstance(kinds[0], syntax.Type):
        return None
    if run.class_of(kinds[0].name, frame.source) is None:
        return None
    return construct.create(run, frame, kinds[0].bare(), args, location)


def _one(
    run: Walk, frame: Frame, name: str, args: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value | None:
    """``T::instance()`` that a class T of the workspace has from a base class ``Singleton<T>`` which is not here: the one object of it."""
    head, _, last = name.rpartition("::")
    owner = run.class_of(run.type_in(syntax.Type(head), frame).name, frame.source) if head and not args else None
    if owner is None or not last.lower().endswith("instance"):
        return None
    own = owner[1].name.rpartition("::")[2]
    named = (
        argument.name for base in owner[1].bases for argument in base.arguments if isinstance(argument, syntax.Type)
    )
    if own not in {item.rpartition("::")[2] for item in named}:
        return None
    key = (f"the one of {owner[0].path}", owner[1].name)
    cell = run.statics.get(key)
    if cell is None:
        cell = Cell(construct.instance(run, frame, owner, (), (), location))
        if not run.quiet:  # what is made in a rehearsal is made again
            run.statics[key] = cell
    found: Value = cell.value
    return found


def ends_the_program(run: Walk, frame: Frame, expression: Expression) -> bool:
    """Whether a statement is a call of ``exit`` and its kin: nothing comes after it."""
    callee = expression.callee if isinstance(expression, syntax.Call) else None
    if not isinstance(callee, (syntax.Name, syntax.Member)) or callee.name.rpartition("::")[2] not in harmless.EXITS:
        return False
    called = expressions.evaluate(run, frame, callee)
    return isinstance(called, Library) and called.name.removeprefix("::") in harmless.ENDING
