# SPDX-License-Identifier: Apache-2.0
"""The types of expressions as declarations tell them, without running anything; None where they do not tell."""

from __future__ import annotations

from typing import Any

from haros_ci.code import classes
from haros_ci.code.body import Variable, names_in
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.link.types import MAPS, SEQUENCES, SMART_POINTERS, is_type, pointee
from haros_ci.model.program import Expression, Type

#: What the methods of ROS libraries return, by their last names: a type with the call's template arguments.
RETURNS = {
    "create_subscription": "rclcpp::Subscription",
    "create_publisher": "rclcpp::Publisher",
    "create_service": "rclcpp::Service",
    "create_client": "rclcpp::Client",
    "create_wall_timer": "rclcpp::TimerBase",
    "create_callback_group": "rclcpp::CallbackGroup",
    "advertise": "ros::Publisher",
    "serviceClient": "ros::ServiceClient",
}
PYTHON_RETURNS = {
    "create_subscription": "rclpy.subscription.Subscription",
    "create_publisher": "rclpy.publisher.Publisher",
    "create_service": "rclpy.service.Service",
    "create_client": "rclpy.client.Client",
    "create_timer": "rclpy.timer.Timer",
    "create_rate": "rclpy.timer.Rate",
    "call_async": "rclpy.task.Future",
    "create_node": "rclpy.node.Node",
}
MAKERS = frozenset(("make_shared", "make_unique", "static_pointer_cast", "dynamic_pointer_cast"))
STEPS = 12


def type_of(code: Codebase, routine: Routine, expression: Expression, steps: int = STEPS) -> Type | None:
    """The resolved type of *expression* in *routine*: for Python a type with a dotted name."""
    if steps <= 0:
        return None
    found = _python(code, routine, expression, steps) if routine.is_python else _cpp(code, routine, expression, steps)
    return found if found is not None and found[0] not in ("", "auto") else None


def class_of(code: Codebase, routine: Routine, expression: Expression, steps: int = STEPS) -> classes.Owner | None:
    """The class of the workspace that an expression is of or points to."""
    if expression[0] == "this":
        return classes.owner_of(code, routine)
    name = classes.pointed(type_of(code, routine, expression, steps))
    return classes.class_named(code, name, routine.source) if name else None


def type_name(code: Codebase, routine: Routine, expression: Expression) -> str:
    """The name of the class that an expression is of or points to, of whatever library; "" if it is not known."""
    return classes.pointed(type_of(code, routine, expression))


def variable(code: Codebase, routine: Routine, name: str) -> tuple[Routine, Variable] | Type | None:
    """The local variable of that name, with the routine that has it; a parameter's type; None if there is no one such."""
    around: Routine | None = routine
    while around is not None:
        found = code.body(around).variables.get(name)
        if found:
            told = {repr((each.type, _placeless(each.init))) for each in found} if len(found) > 1 else {""}
            return (around, found[0]) if len(told) == 1 else None
        for parameter in around.function.parameters:
            if parameter.name == name:
                return _written(code, around, parameter.type)
        around = around.outer
    return None


def _placeless(node: Any) -> Any:
    """An initialiser without the lines and columns of its calls."""
    if isinstance(node, (tuple, list)):
        if len(node) == 6 and node[0] == "call":
            node = node[:4]
        return tuple(_placeless(each) for each in node)
    return node


def is_local(code: Codebase, routine: Routine, name: str) -> bool:
    """Whether a name is a local variable or a parameter here."""
    around: Routine | None = routine
    while around is not None:
        if name in code.body(around).variables or any(p.name.lstrip("*") == name for p in around.function.parameters):
            return True
        around = around.outer
    return False


def _written(code: Codebase, routine: Routine, kind: Type) -> Type | None:
    if not kind[0] or kind[0] == "auto":
        return None
    if routine.is_python:
        return (dotted(code, routine, ("name", kind[0])), kind[1], kind[2])
    if kind[0] in routine.function.templates or kind[0] in routine.method.function.templates:
        return None
    return classes.resolved(code, kind, routine.method.function.name.rpartition("::")[0], routine.source)


def _cpp(code: Codebase, routine: Routine, expression: Expression, steps: int) -> Type | None:
    tag = expression[0]
    if tag in ("&", "*", "kw"):
        return type_of(code, routine, expression[-1], steps - 1)
    if tag == "this":
        owner = classes.owner_of(code, routine)
        return (owner[1].name, (), "*") if owner is not None else None
    if tag in ("cast", "new"):
        return _written(code, routine, expression[1])
    if tag == "name":
        return _name(code, routine, expression[1], steps)
    if tag == "field":
        owner = class_of(code, routine, expression[1], steps - 1)
        return _member(code, owner, expression[2])
    if tag == "index":
        return _element(type_of(code, routine, expression[1], steps - 1))
    if tag == "call":
        return _call(code, routine, expression, steps)
    return None


def _element(kind: Type | None) -> Type | None:
    kind = pointee(kind) if kind is not None else None
    if kind is None:
        return None
    if kind[0] in SEQUENCES and kind[1] and is_type(kind[1][0]):
        return tuple(kind[1][0])
    if kind[0] in MAPS and len(kind[1]) > 1 and is_type(kind[1][1]):
        return tuple(kind[1][1])
    return None


def _name(code: Codebase, routine: Routine, name: str, steps: int) -> Type | None:
    found = variable(code, routine, name)
    if isinstance(found, tuple) and len(found) == 2 and isinstance(found[1], Variable):
        where, local = found
        if local.type[0] not in ("", "auto"):
            return _written(code, where, local.type)
        if local.init is None or name in _read_by(local.init):  # itself, or one that it hides
            return None
        if local.init[0] == "each":
            return _element(type_of(code, where, local.init[1], steps - 1))
        inner = local.init[1] if local.init[0] == "=" else local.init[1][0] if len(local.init[1]) == 1 else None
        return type_of(code, where, inner, steps - 1) if inner is not None else None
    if found is not None:
        return found
    if is_local(code, routine, name):
        return None
    owner = classes.owner_of(code, routine)
    if owner is not None and "::" not in name:
        member = _member(code, owner, name)
        if member is not None:
            return member
    scope = routine.method.function.name.rpartition("::")[0]
    for candidate in code.cpp.scopes(name, scope, routine.source):
        every = code.cpp.near(code.cpp.variables, candidate, routine.source, frozenset())
        if every:
            where_, field = every[0]
            around = field.name.rpartition("::")[0]
            return classes.resolved(code, field.type, around, where_) if len(every) == 1 else None
    return None


def _read_by(init: Any) -> frozenset[str]:
    """The names that an initialiser reads."""
    inner = init[1] if init[0] in ("(", "{") else (init[1],)
    return frozenset().union(*(names_in(each) for each in inner))


def _member(code: Codebase, owner: classes.Owner | None, name: str) -> Type | None:
    found = classes.field_of(code, owner, name) if owner is not None else None
    if found is None:
        return None
    (source, definition), field = found
    if field.type[0] in definition.templates:
        return None
    return classes.resolved(code, field.type, definition.name, source)


def _call(code: Codebase, routine: Routine, call: Expression, steps: int) -> Type | None:
    callee, args, templates = call[1], call[2], call[3]
    if callee[0] == "name":
        head, _, last = callee[1].rpartition("::")
        if last in MAKERS and templates and is_type(templates[0]):
            inner = _written(code, routine, templates[0])
            if last == "make_shared" or last == "make_unique" or head in ("std", "boost"):
                return ("std::shared_ptr", (inner,), "") if inner is not None else None
        if last == "make_shared" and head:
            inner = _written(code, routine, (head, tuple(templates), ""))
            return ("std::shared_ptr", (inner,), "") if inner is not None else None
        if last == "move" and head == "std" and len(args) == 1:
            return type_of(code, routine, args[0], steps - 1)
        if last in ("shared_from_this", "weak_from_this"):
            return type_of(code, routine, ("this",), steps - 1)
        if last in RETURNS:
            return (RETURNS[last], _all_written(code, routine, templates), "")
        made = _written(code, routine, (callee[1], tuple(templates), ""))
        if made is not None and classes.class_named(code, made[0], routine.source) is not None:
            return made
        if head in ("ros", "rclcpp", "tf2_ros", "tf2", "tf", "std") and last[:1].isupper():
            return made
    if callee[0] == "field":
        last = callee[2]
        if last in RETURNS:
            return (RETURNS[last], _all_written(code, routine, templates), "")
        if last in ("get", "lock", "release", "value") and not args:
            kind = type_of(code, routine, callee[1], steps - 1)
            if kind is not None and kind[0] in SMART_POINTERS:
                return pointee(kind)
        if last in ("at", "front", "back"):
            return _element(type_of(code, routine, callee[1], steps - 1))
        if last == "shared_from_this":
            return type_of(code, routine, callee[1], steps - 1)
    return _returned(code, routine, call, steps)


def _all_written(code: Codebase, routine: Routine, templates: Any) -> tuple[Any, ...]:
    return tuple(_written(code, routine, each) or each if is_type(each) else each for each in templates)


def _returned(code: Codebase, routine: Routine, call: Expression, steps: int) -> Type | None:
    """What a function of the workspace says that it returns."""
    from haros_ci.code.calls import called

    found = called(code, routine, call, steps - 1)
    kinds = {repr(each.function.returns): each for each in found}
    if len(kinds) != 1:
        return None
    (target,) = kinds.values()
    return _written(code, target, target.function.returns)


def _python(code: Codebase, routine: Routine, expression: Expression, steps: int) -> Type | None:
    tag = expression[0]
    if tag == "this":
        owner = classes.owner_of(code, routine)
        return (owner[1].name, (), "") if owner is not None else None
    if tag == "call":
        return _python_call(code, routine, expression, steps)
    if tag == "name":
        found = variable(code, routine, expression[1])
        if isinstance(found, tuple) and len(found) == 2:
            return None
        if found is not None:
            return found
        values = _assigned(code, routine, expression[1])
        return type_of(code, routine, values[0], steps - 1) if len(values) == 1 else None
    if tag == "field" and expression[1][0] == "this":
        owner = classes.owner_of(code, routine)
        every = attribute_values(code, owner, expression[2]) if owner is not None else ()
        kinds = {repr(kind): kind for where, value in every if (kind := type_of(code, where, value, steps - 1))}
        return next(iter(kinds.values())) if len(kinds) == 1 else None
    return None


def _assigned(code: Codebase, routine: Routine, name: str) -> list[Expression]:
    """What a Python name is assigned to in the routine, or else in the module."""
    found = [
        value
        for target, _, value, _ in code.body(routine).sets
        if target == ("name", name) or list(target) == ["name", name]
    ]
    if found or routine.outer is None:
        return found
    return _assigned(code, routine.outer, name)


def attribute_values(code: Codebase, owner: classes.Owner, name: str) -> tuple[tuple[Routine, Expression], ...]:
    """All that the methods of a class (and of its bases) assign to a member of ``this``; None-values are left out."""
    key = ("attributes", id(owner[1]))
    if key not in code.kept:
        found: dict[str, list[tuple[Routine, Expression]]] = {}
        every = [owner, *(above for above, _ in classes.bases(code, owner) if above is not None)]
        for source, definition in every:
            for routine in _methods_of(code, source, definition.name):
                for target, operator, value, _ in code.body(routine).sets:
                    member = _own_member(code, routine, target)
                    if member and operator == "=" and value[0] != "none":
                        found.setdefault(member, []).append((routine, value))
        code.kept[key] = {each: tuple(values) for each, values in found.items()}
    known: dict[str, tuple[tuple[Routine, Expression], ...]] = code.kept[key]  # type: ignore[assignment]
    return known.get(name, ())


def _own_member(code: Codebase, routine: Routine, target: Expression) -> str:
    if target[0] == "field" and target[1][0] == "this":
        return str(target[2])
    if target[0] == "name" and not routine.is_python and not is_local(code, routine, target[1]):
        return str(target[1])
    return ""


def _methods_of(code: Codebase, source: Any, name: str) -> list[Routine]:
    """All routines whose ``this`` is the class: lambdas included, in whatever file."""
    key = ("routines of", source.separator)
    if key not in code.kept:
        by_owner: dict[str, set[str]] = {}
        for each in code.sources:
            if each.separator == source.separator:
                for function in each.program.functions:
                    if function.owner:
                        by_owner.setdefault(function.owner, set()).add(each.path)
        code.kept[key] = by_owner
    paths: dict[str, set[str]] = code.kept[key]  # type: ignore[assignment]
    found = []
    for path in sorted(paths.get(name, ())):
        if path == source.path or (source.separator == "::" and source.path in code.cpp.reach(path)):
            found += [routine for routine in code.routines(path) if routine.owner == name]
    return found


def _python_call(code: Codebase, routine: Routine, call: Expression, steps: int) -> Type | None:
    callee = call[1]
    if callee[0] == "field" and callee[2] in PYTHON_RETURNS:
        return (PYTHON_RETURNS[callee[2]], (), "")
    name = dotted(code, routine, callee)
    if name and name.rpartition(".")[2][:1].isupper():
        return (name, (), "")
    return None


def dotted(code: Codebase, routine: Routine, expression: Expression) -> str:
    """A Python name or attribute as a dotted name through imports: ``time.sleep``; "" if a variable is in it."""
    if expression[0] == "field":
        head = dotted(code, routine, expression[1])
        return f"{head}.{expression[2]}" if head else ""
    if expression[0] != "name":
        return ""
    name = str(expression[1])
    around: Routine | None = routine
    while around is not None:
        imports = code.body(around).imports
        if name in imports:
            return classes.absolute(routine.source, imports[name])
        around = around.outer
    if is_local(code, routine, name) or _assigned(code, routine, name):
        return ""
    return classes.dotted_name(routine.source, name)
