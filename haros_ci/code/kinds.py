# SPDX-License-Identifier: Apache-2.0
"""The types of expressions as declarations tell them, without running anything; None where they do not tell."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from haros_ci import syntax
from haros_ci.code import classes
from haros_ci.code.body import Iterated, Variable, names_in
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.index.index import Source
from haros_ci.index.types import MAPS, SEQUENCES, SMART_POINTERS, pointee
from haros_ci.syntax import Expression, Field, Type
from haros_ci.syntax.codec import plain
from haros_ci.syntax.walk import placeless

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
    return found if found is not None and found.name not in ("", "auto") else None


def class_of(code: Codebase, routine: Routine, expression: Expression, steps: int = STEPS) -> classes.Owner | None:
    """The class of the workspace that an expression is of or points to."""
    if isinstance(expression, syntax.This):
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
            facts = {_declared(other_variable) for other_variable in found} if len(found) > 1 else {()}
            return (around, found[0]) if len(facts) == 1 else None
        for parameter in around.function.parameters:
            if parameter.name == name:
                return _written(code, around, parameter.type)
        around = around.outer
    return None


def _declared(variable: Variable) -> tuple[object, ...]:
    """What a declaration says, but for the lines and columns of calls."""
    return plain(variable.type), type(variable.init), tuple(plain(placeless(part)) for part in variable.parts)


def is_local(code: Codebase, routine: Routine, name: str) -> bool:
    """Whether a name is a local variable or a parameter here."""
    around: Routine | None = routine
    while around is not None:
        if name in code.body(around).variables or any(p.name.lstrip("*") == name for p in around.function.parameters):
            return True
        around = around.outer
    return False


def _written(code: Codebase, routine: Routine, kind: Type) -> Type | None:
    if not kind.name or kind.name == "auto":
        return None
    if routine.is_python:
        return syntax.Type(dotted(code, routine, syntax.Name(kind.name)), kind.arguments, kind.marks)
    if kind.name in routine.function.templates or kind.name in routine.method.function.templates:
        return None
    return classes.resolved(code, kind, routine.method.function.name.rpartition("::")[0], routine.source)


def _cpp(code: Codebase, routine: Routine, expression: Expression, steps: int) -> Type | None:
    if isinstance(expression, (syntax.Address, syntax.Dereference, syntax.Keyword)):
        return type_of(code, routine, expression.value, steps - 1)
    if isinstance(expression, syntax.This):
        owner = classes.owner_of(code, routine)
        return syntax.Type(owner[1].name, (), "*") if owner is not None else None
    if isinstance(expression, (syntax.Cast, syntax.New)):
        return _written(code, routine, expression.type)
    if isinstance(expression, syntax.Name):
        return _name(code, routine, expression.name, steps)
    if isinstance(expression, syntax.Member):
        owner = class_of(code, routine, expression.object, steps - 1)
        return _member(code, owner, expression.name)
    if isinstance(expression, syntax.Subscript):
        return _element(type_of(code, routine, expression.object, steps - 1))
    if isinstance(expression, syntax.Call):
        return _call(code, routine, expression, steps)
    return None


def _element(kind: Type | None) -> Type | None:
    kind = pointee(kind) if kind is not None else None
    if kind is None:
        return None
    if kind.name in SEQUENCES:
        return kind.of(0)
    return kind.of(1) if kind.name in MAPS else None


def _name(code: Codebase, routine: Routine, name: str, steps: int) -> Type | None:
    found = variable(code, routine, name)
    if isinstance(found, tuple) and len(found) == 2 and isinstance(found[1], Variable):
        where, local = found
        if local.type.name not in ("", "auto"):
            return _written(code, where, local.type)
        if local.init is None or any(name in names_in(part) for part in local.parts):  # itself, or one that it hides
            return None
        if isinstance(local.init, Iterated):
            return _element(type_of(code, where, local.init.value, steps - 1))
        return type_of(code, where, local.value, steps - 1) if local.value is not None else None
    if found is not None:
        return found
    if is_local(code, routine, name):
        return None
    owner = classes.owner_of(code, routine)
    if owner is not None and "::" not in name:
        member = _member(code, owner, name)
        if member is not None:
            return member
    every = variables_outside(code, routine, name)
    if len(every) != 1:
        return None
    where_, field = every[0]
    return classes.resolved(code, field.type, field.name.rpartition("::")[0], where_)


def variables_outside(code: Codebase, routine: Routine, name: str) -> Sequence[tuple[Source, Field]]:
    """The C++ variables outside of functions and objects that *name* may mean in a routine, of the innermost scope that has any."""
    scope = routine.method.function.name.rpartition("::")[0]
    for candidate in code.cpp.scopes(name, scope, routine.source):
        every = code.cpp.near(code.cpp.variables, candidate, routine.source, frozenset())
        if every:
            return every
    return ()


def _member(code: Codebase, owner: classes.Owner | None, name: str) -> Type | None:
    found = classes.field_of(code, owner, name) if owner is not None else None
    if found is None:
        return None
    (source, definition), field = found
    if field.type.name in definition.templates:
        return None
    return classes.resolved(code, field.type, definition.name, source)


def _call(code: Codebase, routine: Routine, call: syntax.Call, steps: int) -> Type | None:  # noqa: C901 - one branch for each form of a call whose type is known
    callee, args, templates = call.callee, call.arguments, call.templates
    if isinstance(callee, syntax.Name):
        head, _, last = callee.name.rpartition("::")
        if last in MAKERS and templates and isinstance(templates[0], syntax.Type):
            inner = _written(code, routine, templates[0])
            if last == "make_shared" or last == "make_unique" or head in ("std", "boost"):
                return syntax.Type("std::shared_ptr", (inner,)) if inner is not None else None
        if last == "make_shared" and head:
            inner = _written(code, routine, syntax.Type(head, templates))
            return syntax.Type("std::shared_ptr", (inner,)) if inner is not None else None
        if last == "move" and head == "std" and len(args) == 1:
            return type_of(code, routine, args[0], steps - 1)
        if last in ("shared_from_this", "weak_from_this"):
            return type_of(code, routine, syntax.This(), steps - 1)
        if last in RETURNS:
            return syntax.Type(RETURNS[last], _all_written(code, routine, templates))
        made = _written(code, routine, syntax.Type(callee.name, templates))
        if made is not None and classes.class_named(code, made.name, routine.source) is not None:
            return made
        if head in ("ros", "rclcpp", "tf2_ros", "tf2", "tf", "std") and last[:1].isupper():
            return made
    if isinstance(callee, syntax.Member):
        last = callee.name
        if last in RETURNS:
            return syntax.Type(RETURNS[last], _all_written(code, routine, templates))
        if last in ("get", "lock", "release", "value") and not args:
            kind = type_of(code, routine, callee.object, steps - 1)
            if kind is not None and kind.name in SMART_POINTERS:
                return pointee(kind)
        if last in ("at", "front", "back"):
            return _element(type_of(code, routine, callee.object, steps - 1))
        if last == "shared_from_this":
            return type_of(code, routine, callee.object, steps - 1)
    return _returned(code, routine, call, steps)


def _all_written(
    code: Codebase, routine: Routine, templates: tuple[syntax.Argument, ...]
) -> tuple[syntax.Argument, ...]:
    return tuple(
        _written(code, routine, template) or template if isinstance(template, syntax.Type) else template
        for template in templates
    )


def _returned(code: Codebase, routine: Routine, call: syntax.Call, steps: int) -> Type | None:
    """What a function of the workspace says that it returns."""
    from haros_ci.code.calls import called

    found = called(code, routine, call, steps - 1)
    kinds = {plain(other_routine.function.returns): other_routine for other_routine in found}
    if len(kinds) != 1:
        return None
    (target,) = kinds.values()
    return _written(code, target, target.function.returns)


def _python(code: Codebase, routine: Routine, expression: Expression, steps: int) -> Type | None:
    if isinstance(expression, syntax.This):
        owner = classes.owner_of(code, routine)
        return syntax.Type(owner[1].name) if owner is not None else None
    if isinstance(expression, syntax.Call):
        return _python_call(code, routine, expression, steps)
    if isinstance(expression, syntax.Name):
        found = variable(code, routine, expression.name)
        if isinstance(found, tuple) and len(found) == 2:
            return None
        if found is not None:
            return found
        values = _assigned(code, routine, expression.name)
        return type_of(code, routine, values[0], steps - 1) if len(values) == 1 else None
    if isinstance(expression, syntax.Member) and isinstance(expression.object, syntax.This):
        owner = classes.owner_of(code, routine)
        every = attribute_values(code, owner, expression.name) if owner is not None else ()
        kinds = {plain(kind): kind for where, value in every if (kind := type_of(code, where, value, steps - 1))}
        return next(iter(kinds.values())) if len(kinds) == 1 else None
    return None


def _assigned(code: Codebase, routine: Routine, name: str) -> list[Expression]:
    """What a Python name is assigned to in the routine, or else in the module."""
    found = code.body(routine).assigned(name)
    if found or routine.outer is None:
        return found
    return _assigned(code, routine.outer, name)


def attribute_values(code: Codebase, owner: classes.Owner, name: str) -> tuple[tuple[Routine, Expression], ...]:
    """All that the methods of a class (and of its bases) assign to a member of ``this``; None-values are left out."""
    return values_by_attribute(code, owner).get(name, ())


def values_by_attribute(code: Codebase, owner: classes.Owner) -> Mapping[str, tuple[tuple[Routine, Expression], ...]]:
    """``attribute_values`` of all members, by their names."""
    key = ("attributes", id(owner[1]))
    if key not in code.kept:
        found: dict[str, list[tuple[Routine, Expression]]] = {}
        every = [owner, *(above for above, _ in classes.bases(code, owner) if above is not None)]
        for source, definition in every:
            for routine in _methods_of(code, source, definition.name):
                for target, operator, value, _ in code.body(routine).sets:
                    member = _own_member(code, routine, target)
                    if member and operator == "=" and not isinstance(value, syntax.Null):
                        found.setdefault(member, []).append((routine, value))
        code.kept[key] = {item: tuple(values) for item, values in found.items()}
    known: dict[str, tuple[tuple[Routine, Expression], ...]] = code.kept[key]
    return known


def _own_member(code: Codebase, routine: Routine, target: Expression) -> str:
    if isinstance(target, syntax.Member) and isinstance(target.object, syntax.This):
        return str(target.name)
    if isinstance(target, syntax.Name) and not routine.is_python and not is_local(code, routine, target.name):
        return str(target.name)
    return ""


def _methods_of(code: Codebase, source: Source, name: str) -> list[Routine]:
    """All routines whose ``this`` is the class: lambdas included, in whatever file."""
    key = ("routines of", source.separator)
    if key not in code.kept:
        by_owner: dict[str, set[str]] = {}
        for other_source in code.sources:
            if other_source.separator == source.separator:
                for function in other_source.program.functions:
                    if function.owner:
                        by_owner.setdefault(function.owner, set()).add(other_source.path)
        code.kept[key] = by_owner
    paths: dict[str, set[str]] = code.kept[key]
    found: list[Routine] = []
    for path in sorted(paths.get(name, ())):
        if path == source.path or (source.separator == "::" and source.path in code.cpp.reach(path)):
            found += code.routines_of(path, name)
    return found


def _python_call(code: Codebase, routine: Routine, call: syntax.Call, steps: int) -> Type | None:
    callee = call.callee
    if isinstance(callee, syntax.Member) and callee.name in PYTHON_RETURNS:
        return syntax.Type(PYTHON_RETURNS[callee.name])
    name = dotted(code, routine, callee)
    if name and name.rpartition(".")[2][:1].isupper():
        return syntax.Type(name)
    return None


def dotted(code: Codebase, routine: Routine, expression: Expression) -> str:
    """A Python name or attribute as a dotted name through imports: ``time.sleep``; "" if a variable is in it."""
    if isinstance(expression, syntax.Member):
        head = dotted(code, routine, expression.object)
        return f"{head}.{expression.name}" if head else ""
    if not isinstance(expression, syntax.Name):
        return ""
    name = str(expression.name)
    around: Routine | None = routine
    while around is not None:
        imports = code.body(around).imports
        if name in imports:
            return classes.absolute(routine.source, imports[name])
        around = around.outer
    if is_local(code, routine, name) or _assigned(code, routine, name):
        return ""
    return classes.dotted_name(routine.source, name)
