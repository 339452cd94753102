# SPDX-License-Identifier: Apache-2.0
"""Which node and callback group a client, subscription or timer belongs to, by the call that makes it."""

from __future__ import annotations

from collections.abc import Sequence

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call, last_part
from haros_ci.code.callbacks import group_of
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.records import dataclass
from haros_ci.syntax import Expression

#: What gives the node itself, or an interface of it.
SELVES = frozenset(("shared_from_this", "get_node_base_interface", "weak_from_this"))


@dataclass(frozen=True, slots=True)
class ClientOrigin:
    """A client: the *node* that it is of and its callback *group*, as in ``Callback``."""

    node: str
    group: str | None


def node_name(code: Codebase, routine: Routine, expression: Expression | None) -> str | None:
    """A name for the node that an expression is: ``Class.this``, ``Class.member``; None if it is not known to be one of these."""
    while expression is not None and isinstance(expression, (syntax.Dereference, syntax.Address)):
        expression = expression.value
    if expression is None or isinstance(expression, syntax.This):
        return f"{routine.owner}.this" if routine.owner else None
    if isinstance(expression, syntax.Call) and not expression.arguments:
        callee = expression.callee
        if isinstance(callee, syntax.Name) and callee.name in SELVES:
            return node_name(code, routine, None)
        is_self = isinstance(callee, syntax.Member) and callee.name in SELVES
        return node_name(code, routine, callee.object) if isinstance(callee, syntax.Member) and is_self else None
    if isinstance(expression, syntax.Member) and isinstance(expression.object, syntax.This):
        return f"{routine.owner}.{expression.name}"
    if isinstance(expression, syntax.Name) and not routine.is_python and routine.owner:
        if "::" not in expression.name and not kinds.is_local(code, routine, expression.name):
            return f"{routine.owner}.{expression.name}"
    return None


def client_made(code: Codebase, routine: Routine, expression: Expression) -> ClientOrigin | None:
    """How the service client that an expression is was made: a member or local variable that has one origin; None if that is not known."""
    values: Sequence[tuple[Routine, Expression]] = ()
    if isinstance(expression, syntax.Name) and kinds.is_local(code, routine, expression.name) and not routine.is_python:
        found = kinds.variable(code, routine, expression.name)
        if isinstance(found, tuple) and len(found) == 2 and found[1].assigned is not None:
            values = ((found[0], found[1].assigned),)
    elif isinstance(expression, syntax.Name) and routine.is_python:
        values = [(routine, value) for target, _, value, _ in code.body(routine).sets if target == expression]
    else:
        is_member = isinstance(expression, syntax.Member) and isinstance(expression.object, syntax.This)
        owner = classes.owner_of(code, routine) if is_member or isinstance(expression, syntax.Name) else None
        values = kinds.attribute_values(code, owner, syntax.name_of(expression)) if owner is not None else ()
    made: set[ClientOrigin | None] = set()
    for where, value in values:
        if (
            not isinstance(value, syntax.Call)
            or last_part(value.callee) != "create_client"
            or where.owner != routine.owner
        ):
            return None
        call = Call("create_client", value, ())
        node = node_name(code, where, call.receiver)
        made.add(ClientOrigin(node, group_of(code, where, call)) if node is not None else None)
    return made.pop() if len(made) == 1 else None


#: The node classes of rclcpp, and roscpp's handles.
NODES = frozenset(("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode", "rclcpp::node_interfaces::NodeBaseInterface"))
HANDLES = frozenset(("ros::NodeHandle", "image_transport::ImageTransport"))


def is_node(code: Codebase, routine: Routine, expression: Expression | None) -> bool:
    """Whether an expression (None: ``this``) is a node or node handle for sure, with the methods of the library's."""
    if expression is None or isinstance(expression, syntax.This):
        owner = classes.owner_of(code, routine)
    else:
        name = kinds.type_name(code, routine, expression)
        if name in NODES or name in HANDLES:
            return True
        owner = classes.class_named(code, name, routine.source) if name else None
    return owner is not None and bool(NODES & classes.base_names(code, owner))


def own_method(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether the class of the receiver, or one of its bases in the workspace, has a method of that name itself."""
    if call.receiver is None or isinstance(call.receiver, syntax.This):
        owner = classes.owner_of(code, routine)
    else:
        owner = kinds.class_of(code, routine, call.receiver)
    if owner is None:
        return False
    every = [owner, *(above for above, _ in classes.bases(code, owner) if above is not None)]
    index = code.index(routine.source)
    return any(f"{definition[1].name}{definition[0].separator}{call.name}" in index.functions for definition in every)
