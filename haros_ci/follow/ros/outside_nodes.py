# SPDX-License-Identifier: Apache-2.0
"""ROS 2: nodes whose class, or base class, is in no package here: what is seen of them, and why there may be more."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, construct, methods, specialisations
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import harmless
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.libraries.given_away import BEGINNING, is_known
from haros_ci.follow.ros import api_rows, ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.types import pointee
from haros_ci.model.location import Location
from haros_ci.values.abstract import Known, Object, Opaque, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Why a node may have more than is seen.
OF_CLASS = "the class {}, which the node is of, is not in the workspace: what it makes is not known"
OF_BASE = "the base class {} is not in the workspace: what it makes and calls is not known"
GIVEN = "{} is not in the workspace, which is given the class {} and may make one"
#: Functions that begin a process, and why one has no node.
STARTING = frozenset(("rclcpp::init", "rclpy.init"))
NO_NODE = "it initialises the client library, but no node of it is seen"
#: Methods of an executor that are given a node; ``spin_until_future_complete`` is given what it waits for.
HANDED = ("add_node", "spin_node")
#: Types of which a value may be of any class.
ANYTHING = frozenset(("auto", "object", *(f"typing.{name}" for name in "Any Optional Union".split())))
#: Methods of nodes that other classes have, too, and that are given the class of a service first.
OF_SERVICES = ("create_service", "create_client")
#: Parts of names of classes that interfaces are generated to.
INTERFACES = ("::msg::", "::srv::", "::action::", ".msg.", ".srv.", ".action.")
#: Pointers to nodes in the parameters of classes that are given one.
NODES = ("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode")
POINTERS = ("::SharedPtr", "::WeakPtr", "::ConstSharedPtr", "::ConstWeakPtr", "::UniquePtr")


def method(
    walk: Walk,
    frame: Frame,
    this: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A method of a node that *this* has from a base class outside: no other class has one of that name, or *this* is known to be a node."""
    separator = frame.source.separator
    handle = ros2_nodes.NODE[separator]
    if walk.context.process is None or "::" in name or this.name == handle:
        return None
    if f"{handle}{separator}{name}" not in walk.rows:
        return None
    if name not in ros2_nodes.UNMISTAKABLE and this.node is None:
        return None
    base = _base(walk, this)
    if base is None:
        return None
    _name_it(walk, this, base, location)
    return api_rows.call(walk, frame, f"{handle}{separator}{name}", this, args, targs, location)


def of_type(
    walk: Walk,
    frame: Frame,
    this: Object,
    receiver: Opaque,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A method that only a node has, of what is not known; *this* is of the type that it is declared with, of a class from outside or one that tells nothing."""
    separator = frame.source.separator
    if walk.context.process is None or name not in ros2_nodes.UNMISTAKABLE:
        return None
    if name in OF_SERVICES and not targs and args and isinstance(args[0].value, Known):  # the client of something else
        return None
    base = None if this.name in ANYTHING else _base(walk, this)
    if base is None and this.name not in ANYTHING:
        return None
    if base is not None and separator in base:
        walk.gaps.setdefault(OF_CLASS.format(base), receiver.location or location)
    handle = ros2_nodes.NODE[separator]
    node = Object(handle, namespace=receiver)
    return api_rows.call(walk, frame, f"{handle}{separator}{name}", node, args, targs, location)


def _name_it(walk: Walk, this: Object, base: str, location: Location) -> None:
    """*this* is a node, that of a class or base class *base* which is not here."""
    if this.node is None:
        this.node = ros2_nodes.made(walk, this, None, None, None, this.location or location)
    if this.definition is None:
        walk.gaps.setdefault(OF_CLASS.format(base), this.location or location)
    else:
        walk.gaps.setdefault(OF_BASE.format(base), Location(this.definition[0].path, this.definition[1].line))


def _base(walk: Walk, this: Object) -> str | None:
    """The first base class of *this* of which nothing is known."""
    return next((name for name in library_objects.owners(walk, this) if is_strange(walk, name)), None)


def is_strange(walk: Walk, name: str) -> bool:
    """Whether a class or function is of a library of which nothing is known."""
    if not name or name in walk.rows or any(part in name for part in INTERFACES):
        return False
    return not is_known(name) and not harmless.is_harmless(name, False)


def spun(walk: Walk, args: Sequence[PassedArgument], location: Location) -> None:
    """A process goes on with the first of *args*, which is a node: one of a class that is not here has a name and endpoints of which nothing is known."""
    if walk.context.process is None or not args:
        return
    value = args[0].value.cell.value if isinstance(args[0].value, Pointer) else args[0].value
    if isinstance(value, Object) and ros2_nodes.of_value(walk, value) is None:
        _is_node(walk, value, location)
    elif isinstance(value, Opaque) and not walk.nodes and not walk.quiet:
        message = f"the node is not known: {value.reason}"
        walk.gaps.setdefault(message, value.location or location)
        ros2_nodes.made(walk, Object(""), Opaque(value.reason, value.location), None, None, location)


def _is_node(walk: Walk, value: Object, location: Location) -> None:
    """*value* is a node, as the process spins it."""
    base = _base(walk, value)
    if base is not None:
        _name_it(walk, value, base, location)


def without_node(walk: Walk) -> None:
    """A process that begins as one of ROS 2 and has no node, as far as it is seen, has one that is not."""
    if walk.started is not None and not walk.nodes and not (walk.context.process is None and walk.names):
        walk.gaps.setdefault(NO_NODE, walk.started)


def given(walk: Walk, frame: Frame, kind: syntax.Type, this: Object, location: Location) -> None:
    """An object of a class template from outside is made, of which an argument is a class of the workspace: what that may make is made by it.

    A template of the workspace gets here if it has specialisations: it is no node for that.
    """
    if walk.context.process is None or walk.quiet or not is_strange(walk, kind.name):
        return
    for inner in kind.arguments:
        owner = walk.class_of(inner.name, frame.source) if type(inner) is syntax.Type else None
        if owner is None or not (walk.relevance.named(owner[1].name) or _called(walk, *owner)):
            continue
        key = ("given", id(owner[1]))
        if key in walk.offered:
            continue
        walk.offered.add(key)
        if walk.class_of(kind.name, frame.source) is not None:
            walk.gaps.setdefault(specialisations.OF_CLASS.format(kind.name), location)
            continue
        _name_it(walk, this, kind.name, location)
        with walk.doubted(GIVEN.format(kind.name, owner[1].name)):
            _made(walk, frame, owner, Object(NODES[0], node=this.node), location)


def _made(walk: Walk, frame: Frame, owner: tuple[Source, syntax.Class], node: Object, location: Location) -> None:
    """An object of *owner* as a library may make it, with *node* wherever it takes one: it is initialised, and what it overrides is called later."""
    source, definition = owner
    short = definition.name.rpartition("::")[2]
    constructor = methods.class_method(walk, source, definition, short)
    args = _arguments(walk, constructor, node) if constructor is not None else ()
    made = construct.instance(walk, frame, owner, (), args, location)
    if not isinstance(made, Object) or made.node is not None:
        return
    for name in _called(walk, source, definition):
        found = methods.method_of(walk, made, name)
        if found is not None:
            activation.invoke(walk, frame, found, _arguments(walk, (found.source, found.function), node))


def _called(walk: Walk, source: Source, definition: syntax.Class) -> list[str]:
    """The methods of a class that make something and that others are known to call: those that begin and virtual ones, by the last parts of their names."""
    found: dict[str, None] = {}
    for function in source.program.functions:
        last = function.name.rpartition("::")[2]
        if function.owner != definition.name or last.startswith("~") or not (function.is_virtual or last in BEGINNING):
            continue
        if walk.relevance.makes(methods.with_body(walk, [(source, function)])[1], source):
            found[last] = None
    return sorted(found, key=lambda name: name not in BEGINNING)


def _arguments(walk: Walk, function: methods.Found, node: Object) -> tuple[PassedArgument, ...]:
    """*node* for the parameters that take one; what else is given is not known."""
    source, definition = function
    inner = Frame(source, definition.owner, definition)
    found = []
    for parameter in definition.parameters:
        kind = pointee(walk.type_in(parameter.type, inner))
        name = next((kind.name.removesuffix(end) for end in POINTERS if kind.name.endswith(end)), kind.name)
        value: Value = node
        if name not in NODES:
            value = walk.opaque("what a library gives", inner, definition.line, kind)
        found.append(call_arguments.PassedArgument(value, None, kind, parameter.name))
    return tuple(found)
