# SPDX-License-Identifier: Apache-2.0
"""Functions that make nothing and only compute with numbers: they are not followed, what they change is forgotten."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from haros_ci import syntax
from haros_ci.follow import call_arguments, initialised, methods, partials, thrown
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import qos_profiles
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Index, Source
from haros_ci.index.mentions import last
from haros_ci.syntax import Function, Type
from haros_ci.syntax.walk import Part, everything
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
)

#: Objects inside objects that are looked into.
NESTED = 3
#: Statements of a function that is followed for what it returns alone, and how many.
STRAIGHT = (syntax.Return, syntax.Variable, syntax.Do, syntax.If)
SHORT = 3
#: Kinds of values that can be called, and those that may hold such.
CALLED = frozenset((Callable, ClassValue, Library, Object))
#: Values that a Python object is given to be called, classes before all.
HELD = frozenset((ClassValue, Library))
CALLABLE = CALLED | {Choice, Pointer, Sequence, Mapped}


def may_make(
    walk: Walk,
    function: Callable,
    args: tuple[call_arguments.PassedArgument, ...],
    templates: Mapping[str, syntax.Argument] | None = None,
) -> bool:
    """Whether a call may make something: the function by itself, or something that it is given and may call.

    *templates* are what its template parameters stand for: it may construct them.
    """
    if walk.relevance.makes(function.function, function.source):
        return True
    for kind in (templates or {}).values():
        if type(kind) is syntax.Type and kind.name in walk.index.classes and walk.relevance.named(kind.name):
            return True
    return (
        any(a.value.__class__ in CALLABLE and _makes(walk, a.value) for a in args)
        or any(value.__class__ in CALLABLE and _makes(walk, value) for value in function.bound)
        or (function.source.separator == "." and function.this is not None and _holds(walk, function.this))
        or (function.source.separator == "." and isinstance(function.frame, Frame) and _calls_outer(walk, function))
    )


def _calls_outer(walk: Walk, function: Callable) -> bool:
    """Whether a Python function calls a parameter of the function around it that holds one that makes something."""
    frame = function.frame
    if (
        not isinstance(frame, Frame)
        or frame.function is None
        or frame.function.kind == "module"
        or function.function.body is None
    ):
        return False
    called = walk.relevance.names(function.function.body, function.source)
    cells = [frame.find(parameter.name) for parameter in frame.function.parameters if parameter.name in called]
    return any(cell is not None and isinstance(cell.value, Callable) and _makes(walk, cell.value) for cell in cells)


def _holds(walk: Walk, this: Object) -> bool:
    """Whether a member of a Python object holds a function or class that makes something."""
    held = (cell.value for cell in this.fields.values())
    return any(value.__class__ in HELD and _makes(walk, value) for value in held)


def _makes(walk: Walk, value: Value | None) -> bool:
    if isinstance(value, Callable):
        return may_make(walk, value, ())
    if isinstance(value, ClassValue):
        return walk.relevance.named(value.definition.name)
    if isinstance(value, Library):
        return walk.relevance.named(value.name)
    if isinstance(value, Object):
        if value.definition is None:
            return value.name == partials.PARTIAL and any(_makes(walk, cell.value) for cell in value.fields.values())
        source, definition = value.definition
        found = methods.class_method(walk, source, definition, "operator()" if source.separator == "::" else "__call__")
        return found is not None and walk.relevance.makes(found[1], found[0])
    if isinstance(value, Choice):
        return any(_makes(walk, option) for option in value.options)
    if isinstance(value, Pointer):
        return value.cell.value.__class__ in CALLED
    content = value.content.value if isinstance(value, (Sequence, Mapped)) else None
    cells = content.values() if isinstance(content, dict) else content if isinstance(content, tuple) else ()
    return any(cell.value.__class__ in CALLED for cell in cells)


def is_inert(
    walk: Walk, function: Callable, definition: Function, returns: Type, args: tuple[call_arguments.PassedArgument, ...]
) -> bool:
    """Whether a function that makes nothing need not be followed: it gives and changes numbers only."""
    if definition.kind == "constructor" or _is_short(definition):
        return False
    if returns.name and not call_arguments.is_scalar(returns) and returns.name != "bool":
        return False
    changed = walk.relevance.changes(definition, function.source)
    if not changed.isdisjoint(walk.relevance.shared) or not changed.isdisjoint(walk.relevance.holding):
        return False
    if function.source.separator == "::" and _pointers(walk, changed):
        return False
    if isinstance(function.frame, Frame) and any(function.frame.find(name) is not None for name in changed):
        return False
    if not returns.name and function.source.program.language == "python" and _returns_value(definition.body):
        return False
    for argument in args:
        value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
        if isinstance(value, (Sequence, Mapped, Callable, ClassValue, Choice)) or (
            isinstance(value, Known)
            and issubclass(value.kind, (str, list, dict))
            and (argument.cell is not None or value is not argument.value)
        ):
            return False
        if isinstance(value, Object) and not _only_numbers(value, changed):
            return False
    if function.this is not None and not _only_numbers(function.this, changed):
        return False
    return not any(_is_profile(argument) for argument in args[: len(definition.parameters)])


def _is_profile(argument: call_arguments.PassedArgument) -> bool:
    """Whether a function is given a quality of service, whose methods change what no assignment names."""
    value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
    return isinstance(value, Object) and value.name in qos_profiles.CLASSES


Pointers = dict[str, tuple[tuple[Source, str, syntax.Init | None, Type], ...]]


def _pointers(walk: Walk, names: frozenset[str]) -> Pointers:
    """The namespace-scope variables and static members of those *names* (their last parts) that point to constants, or begin without a value.

    They are no constants themselves: for each its file, qualified name, initialiser and type.
    """
    key = ("pointers", names)
    known: Pointers | None = walk.found.get(key)
    if known is None:
        shared = walk.index.caches.setdefault("pointers", {})  # by all node types of the workspace
        if not shared:
            shared["all"] = _all_pointers(walk.index)
        every: Pointers = shared["all"]
        known = walk.found[key] = {name: every[name] for name in sorted(every.keys() & names)}
        trace = walk.index.trace
        if trace is not None:
            trace.names |= names
            trace.paths.update(where.path for item in known.values() for where, _, _, _ in item)
    return known


def _all_pointers(index: Index) -> Pointers:
    variables = [(where, v.name, v) for item in dict.values(index.variables) for where, v in item]
    for item in dict.values(index.classes):
        variables += [(where, f"{c.name}::{f.name}", f) for where, c in item for f in c.fields if f.is_static]
    found: Pointers = {}
    for where, name, variable in variables:
        if variable.init is None or ("*" in variable.type.marks and not variable.type.marks.endswith("c")):
            last = name.rpartition("::")[2]
            found[last] = (*found.get(last, ()), (where, name, variable.init, variable.type))
    return found


def _is_constant(cell: Cell) -> bool:
    """Whether a variable keeps what it has, whatever else is of its name."""
    marks = cell.type.marks if cell.type is not None else ""
    return "c" in marks and "*" not in marks and "&" not in marks


def _is_short(definition: Function) -> bool:
    """Whether a function tells a value in few steps: as getters do, and conversions."""
    body = definition.body or ()
    return (
        0 < len(body) <= SHORT
        and type(body[-1]) is syntax.Return
        and body[-1].value is not None
        and all(isinstance(statement, STRAIGHT) for statement in body)
    )


def _only_numbers(this: Object, changed: frozenset[str], depth: int = 0) -> bool:
    if depth > NESTED:
        return False
    for name, cell in this.fields.items():
        if name not in changed:
            if isinstance(cell.value, Object) and cell.value.definition is not None and cell.value is not this:
                if not _only_numbers(cell.value, changed, depth + 1):
                    return False
            continue
        if isinstance(cell.value, Known) and issubclass(cell.value.kind, (int, float)):
            continue
        if isinstance(cell.value, Opaque) and (
            cell.type is None or call_arguments.is_scalar(cell.type) or cell.value.type is None
        ):
            continue
        if isinstance(cell.value, Object) and cell.value.definition is None and cell.value.namespace is None:
            continue
        return False
    return True


def _returns_value(block: Part) -> bool:
    return any(type(node) is syntax.Return and node.value is not None for node in everything(block))


def skipped(  # noqa: C901 - one branch for each place that a function can change
    walk: Walk,
    inner: Frame,
    function: Callable,
    definition: Function,
    returns: Type,
    args: tuple[call_arguments.PassedArgument, ...],
) -> Value:
    """What is known after a function that was not followed: the numbers that it may change are not."""
    if walk.trials and thrown.may_come_from(walk, definition):
        thrown.may_throw(walk)
    changed = walk.relevance.changes(definition, function.source)
    reason = f"{definition.name} may change it"
    unknown = walk.opaque(reason, inner, definition.line)
    objects = [a.value.cell.value if isinstance(a.value, Pointer) else a.value for a in args] + [function.this]
    for this in objects:
        if isinstance(this, Object):
            _forget_members(walk, this, changed, unknown, 0)
    if function.source.separator == "::":
        for pointers in _pointers(walk, changed).values():  # those that are used later begin with what they are now
            for pointer in pointers:
                initialised.global_cell(walk, *pointer)
    for (_, name), cell in walk.globals.items():
        if last(name) in changed and not _is_constant(cell):
            _forget(walk, cell, replace(unknown, type=cell.type))
    for module in walk.modules.values():
        for name in changed & module.scopes[0].keys():
            _forget(walk, module.scopes[0][name], unknown)
    if isinstance(function.frame, Frame):
        for name in changed:
            outer = function.frame.find(name)
            if outer is not None:
                _forget(walk, outer, replace(unknown, type=outer.type))
    for parameter, argument in zip(definition.parameters, args, strict=False):
        marks = parameter.type.marks
        is_changed = "&" in marks and not marks.rstrip("&").endswith("c")
        if parameter.name in changed and (is_changed or ("*" in marks and "c" not in marks)):
            target = argument.value.cell if isinstance(argument.value, Pointer) else argument.cell
            if target is not None:
                _forget(walk, target, walk.opaque(reason, inner, definition.line, target.type))
    if returns.name == "void":
        return NONE
    return walk.opaque(
        f"what {definition.name} returns is computed", inner, definition.line, returns if returns.name else None
    )


def _forget_members(walk: Walk, this: Object, changed: frozenset[str], unknown: Opaque, depth: int) -> None:
    for name, cell in this.fields.items():
        if name in changed:
            _forget(walk, cell, replace(unknown, type=cell.type))
        elif isinstance(cell.value, Object) and cell.value.definition is not None and depth < NESTED:
            _forget_members(walk, cell.value, changed, unknown, depth + 1)


def _forget(walk: Walk, cell: Cell, unknown: Opaque) -> None:
    value = cell.value
    if isinstance(value, (Sequence, Mapped)):
        walk.state.forget(value.content, unknown)
    elif isinstance(value, (Known, Choice, Text)):
        walk.state.write(cell, unknown)
