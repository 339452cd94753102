# SPDX-License-Identifier: Apache-2.0
"""API rows applied to calls: which row fits, what its templates select, what the call makes, returns and stores."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from haros_ci.link import calls, expressions, operators
from haros_ci.link import construct as classes
from haros_ci.link.emit import emit
from haros_ci.link.names import clean, pattern, resolve
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import SEQUENCES, STRINGS, is_type, parameter_type, pointee
from haros_ci.link.values import (
    FALSE,
    NONE,
    TRUE,
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
    concatenate,
    join,
)
from haros_ci.model.api import Entry, Row, Template
from haros_ci.model.location import Location
from haros_ci.model.program import Type

if TYPE_CHECKING:
    from haros_ci.link.calls import Argument

HANDLES = frozenset(("ros::NodeHandle",))
#: Methods that no other class has: a receiver of unknown type is taken for a node handle.
UNMISTAKABLE = frozenset(("advertise", "advertiseService", "serviceClient"))


@dataclass(frozen=True, slots=True)
class TypeValue:
    """A type where a value is expected."""

    type: Type


@dataclass(frozen=True, slots=True, eq=False)
class Applied:
    """A row at one call: what its templates may select from."""

    run: Run
    frame: Frame
    row: Row
    receiver: Value | None
    args: tuple[Argument, ...]
    types: tuple[Any, ...]
    location: Location
    item: Mapping[str, Any] | None = None
    parameter: Value | None = None


def call(
    run: Run,
    frame: Frame,
    name: str,
    receiver: Value | None,
    args: tuple[Argument, ...],
    targs: Any,
    location: Location,
    types: tuple[Any, ...] | None = None,
) -> Value | None:
    """The value of a call that a row describes; None if no row does."""
    row = select(run, name, args)
    if row is None:
        return None
    if types is None:
        types = tuple(run.type_in(t, frame) if is_type(t) else t for t in targs)
    made: Object | None = None
    returns = row.returns
    if returns is not None and all(isinstance(part, str) for part in returns.parts):
        made = Object("".join(str(part) for part in returns.parts), types, location=location)
    elif returns is None and (any(e.kind == "handle" for e in row.makes) or (row.fills and not receiver)):
        made = Object(name, types, location=location)
    is_class = re.split(r"::|\.", name)[-1][:1].isupper()
    if made is None and is_class and receiver is None and row.transparent is None and returns is None:
        made = Object(name, types, location=location)
    applied = Applied(run, frame, row, receiver, args, types, location)
    parameter = _apply(applied, made)
    if row.transparent is not None:
        return value_of(applied, row.transparent) or NONE
    if made is not None:
        return made
    if returns is not None:
        found = value_of(Applied(run, frame, row, receiver, args, types, location, None, parameter), returns)
        if found is not None:
            return found
        return run.opaque("a parameter that is not set", frame, location.line)
    if any(entry.kind == "getters" and entry.each is None for entry in row.makes) and "value" not in row.makes[0].values:
        return FALSE if parameter is None else run.opaque("it is set", frame, location.line) if isinstance(
            parameter, Opaque
        ) else TRUE
    return run.opaque(f"what {name} returns", frame, location.line)


def construct(
    run: Run, frame: Frame, this: Object, kind: Type, args: tuple[Argument, ...], location: Location
) -> None:
    """What constructing a library's class makes; nothing if no row knows it."""
    row = select(run, kind[0], args)
    if row is not None:
        _apply(Applied(run, frame, row, this, args, kind[1], location), this, kind)


def select(run: Run, name: str, args: tuple[Argument, ...]) -> Row | None:
    """The first row for *name* whose conditions hold."""
    for row in run.rows.get(name, ()):
        if row.is_class or (row.args and len(args) not in row.args):
            continue
        if all(_has_type(_argument(args, where), kind, run) for where, kind in row.when):
            return row
    return None


def _argument(args: tuple[Argument, ...], where: str) -> Argument | None:
    if where.isdigit():
        positional = [argument for argument in args if not argument.keyword]
        return positional[int(where)] if int(where) < len(positional) else None
    return next((argument for argument in args if argument.keyword == where), None)


def _has_type(argument: Argument | None, wanted: str, run: Run) -> bool:
    if argument is None:
        return False
    value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
    kind = operators.value_type(value) or argument.type
    name = pointee(kind)[0] if kind is not None else ""
    if wanted == "string":
        return isinstance(value, Text) or (isinstance(value, Known) and isinstance(value.value, str)) or name in STRINGS or name == "char"
    if wanted == "function":
        return isinstance(value, (Callable,)) or name in ("boost::function", "std::function", "function")
    if wanted == "list":
        return isinstance(value, Sequence) or name in SEQUENCES or name == "list"
    if wanted == "bool":
        return (isinstance(value, Known) and isinstance(value.value, bool)) or name == "bool"
    if wanted == "int":
        return parameter_type(kind) == "int"
    if wanted == "double":
        return name in ("double", "float")
    if isinstance(value, Object):
        return value.name == wanted or wanted in calls.owners(run, value)
    return name == wanted


def _apply(applied: Applied, made: Object | None, kind: Type | None = None) -> Value | None:
    """Make, fill, store and register what the row says; the value that its getter reads is returned."""
    run, row = applied.run, applied.row
    parameter: Value | None = None
    known = False
    for entry in row.makes:
        if entry.kind == "handle":
            target = made if made is not None else applied.receiver
            if isinstance(target, Object):
                target.namespace = _handle(applied, entry)
            continue
        for item in _items(applied, entry):
            inner = Applied(run, applied.frame, row, applied.receiver, applied.args, applied.types, applied.location, item)
            found = emit(inner, entry, kind)
            if entry.kind == "getters" and item is None:
                parameter, known = found, True
    target = made if made is not None else applied.receiver
    if isinstance(target, Object):
        for name, template in row.fills:
            value = value_of(applied, template)
            if value is not None:
                filled = value if not isinstance(value, TypeValue) else Library(value.type[0])
                if name in target.fields:
                    run.state.write(target.fields[name], filled)
                else:
                    target.fields[name] = Cell(filled)
    with_parameter = Applied(
        run, applied.frame, row, applied.receiver, applied.args, applied.types, applied.location, None, parameter
    )
    for where, template in row.sets:
        argument = _argument(applied.args, where)
        if argument is None:
            continue
        cell = argument.cell
        if cell is None and isinstance(argument.value, Pointer):
            cell = argument.value.cell
        if cell is None:
            continue
        value = value_of(with_parameter, template)
        if value is not None and not isinstance(value, TypeValue):
            run.state.write(cell, operators.converted(value, cell.type))
        elif not known:
            run.state.write(cell, run.opaque("it is filled by a call", applied.frame, applied.location.line, cell.type))
    for where in row.calls:
        value = select_value(applied, where)
        if value is not None and not isinstance(value, TypeValue):
            calls.register(run, value, applied.args)
    return parameter


def _handle(applied: Applied, entry: Entry) -> Value:
    """The namespace of a node handle: its parent's, and the text below it."""
    context = applied.run.context
    parent: Value = Known(context.namespace)
    if "parent" in entry.values:
        found = value_of(applied, entry.values["parent"])
        parent = namespace_of(applied, found) if found is not None else parent
    text = value_of(applied, entry.values["namespace"]) if "namespace" in entry.values else Known("")
    if text is None or text == Known("") or text == NONE:
        return parent
    return below(applied, parent, text)


def below(applied: Applied, parent: Value, text: Value) -> Value:
    """The namespace *text* seen from *parent*."""
    context = applied.run.context
    name, why, where = pattern(text)
    space, space_why, space_where = pattern(parent)
    if name == "~":
        return Known(context.name)
    full = resolve(name, space, context.name)
    if why is None and (space_why is None or name[:1] in "/~"):
        return Known(full)
    return Text((full.partition("?")[0], Opaque(why or space_why or "", where or space_where), full.partition("?")[2]))


def namespace_of(applied: Applied, value: Any) -> Value:
    """The absolute namespace that a handle or text stands for."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object):
        if value.namespace is not None:
            return value.namespace
        return applied.run.opaque(f"the namespace of a {value.name}", applied.frame, applied.location.line)
    if isinstance(value, Opaque) and value.type is not None and pointee(value.type)[0] not in STRINGS:
        return Opaque(f"the node handle is not known: {value.reason}", value.location)
    if isinstance(value, (Known, Text, Opaque)):
        return below(applied, Known(applied.run.context.namespace), value) if value != Known("") else Known(
            applied.run.context.namespace
        )
    return applied.run.opaque("the namespace is not known", applied.frame, applied.location.line)


def _items(applied: Applied, entry: Entry) -> list[Mapping[str, Any] | None]:
    if entry.each is None:
        return [None]
    inside = re.fullmatch(r"(config|keys)\((.+)\)", entry.each)
    if inside is None:
        return []
    value = select_value(applied, inside[2])
    if inside[1] == "keys":
        if isinstance(value, Mapped) and isinstance(value.content.value, dict):
            return [{"name": Known(str(k)), "default": c.value} for k, c in value.content.value.items()]
        return []
    name = config_name(value)
    config = applied.run.configs.get(name)
    if config is None:
        return []
    return [
        {"name": Known(p.name), "type": Known(p.type), "default": Known(p.default), "group": Known(p.group)}
        for p in config.parameters
    ]


def config_name(value: Any) -> str:
    """``pkg::NameConfig`` of a dynamic_reconfigure type, in C++ and in Python (``pkg.cfg.NameConfig``)."""
    if isinstance(value, TypeValue):
        name = value.type[0]
    elif isinstance(value, Library):
        name = value.name
    elif isinstance(value, ClassValue):
        name = value.definition.name
    else:
        return ""
    parts = name.replace(".", "::").split("::")
    return "::".join((parts[0], parts[-1])) if len(parts) > 2 and "cfg" in parts else name


def value_of(applied: Applied, template: Template) -> Any:
    """What a template stands for: a Value, a TypeValue if it is one selector of a type, None if nothing is there."""
    parts = template.parts
    if len(parts) == 1 and not isinstance(parts[0], str):
        alternatives, default = parts[0]
        for alternative in alternatives:
            found = select_value(applied, alternative)
            if found is not None:
                return found
        return literal(default) if default is not None else None
    if len(parts) == 1 and isinstance(parts[0], str):
        return literal(parts[0])
    if not parts:
        return Known("")
    values: list[Value] = []
    for part in parts:
        if isinstance(part, str):
            values.append(Known(part))
            continue
        found = value_of(applied, Template((part,)))
        if isinstance(found, TypeValue):
            found = Known(found.type[0])
        values.append(found if found is not None else applied.run.opaque("an argument is missing", applied.frame))
    return concatenate(tuple(values))


def literal(text: str) -> Known:
    """A literal of a row: true, false, none, a number or text."""
    if text in ("true", "false"):
        return Known(text == "true")
    try:
        return Known(int(text))
    except ValueError:
        try:
            return Known(float(text))
        except ValueError:
            return Known(text)


def select_value(applied: Applied, selector: str) -> Any:
    """What one alternative of a selector finds: a Value, a TypeValue, or None."""
    run = applied.run
    if selector[0].isdigit():
        where, *members = selector.split(".")
        argument = _argument(applied.args, where)
        return _members(applied, argument.value, members) if argument is not None else None
    if selector[0] == "<":
        return _template_argument(applied.types, int(selector[1:-1]))
    if selector.startswith("this<"):
        this = applied.receiver
        return _template_argument(this.arguments, int(selector[5:-1])) if isinstance(this, Object) else None
    if selector == "this" or selector.startswith("this."):
        if selector == "this.namespace":
            return namespace_of(applied, applied.receiver)
        return _members(applied, applied.receiver, selector.split(".")[1:]) if applied.receiver is not None else None
    if selector.startswith("item."):
        return applied.item.get(selector[5:]) if applied.item is not None else None
    if selector == "parameter":
        return applied.parameter
    context = run.context
    if selector in ("node.name", "node.namespace", "process.name", "process.namespace"):
        return Known(getattr(context, selector.replace("node.", "").replace(".", "_")))
    function, bracket, inside = selector.partition("(")
    if not bracket:
        argument = _argument(applied.args, selector.split(".")[0])
        return _members(applied, argument.value, selector.split(".")[1:]) if argument is not None else None
    inside = inside[:-1]
    if function == "handle":
        return Object("ros::NodeHandle", namespace=Known(context.name if inside == "~" else context.namespace))
    if function == "parent":
        return _parent(applied, inside)
    if function == "search":
        return _search(applied, inside)
    where, _, index = inside.partition(",")
    if function == "typeof":
        return next((kind for kind in (_type_of(applied, part) for part in where.split("|")) if kind is not None), None)
    found = next((f for f in (_argument(applied.args, part) for part in where.split("|")) if f is not None), None)
    if found is None:
        return None
    if function == "callback":
        return _callback_type(run, found, int(index or 0))
    if isinstance(found.value, Library):
        return TypeValue((found.value.name, (), ""))
    if isinstance(found.value, ClassValue):
        return TypeValue((found.value.definition.name, (), ""))
    kind = found.type or operators.value_type(found.value)
    return TypeValue(kind) if kind is not None else None


def _type_of(applied: Applied, selector: str) -> TypeValue | None:
    """The type of an argument, if it is one that parameters have."""
    if selector[0] in "<t":
        found = select_value(applied, selector)
        return found if isinstance(found, TypeValue) and parameter_type(found.type) is not None else None
    argument = _argument(applied.args, selector)
    if argument is None:
        return None
    for kind in (argument.type, operators.value_type(argument.value)):
        if parameter_type(kind) is not None:
            return TypeValue(kind)
    return None


def _absolute(applied: Applied, selector: str) -> tuple[str, Opaque | None]:
    """The full name that a selected name has at the receiver, and why it is not wholly known."""
    context = applied.run.context
    value = select_value(applied, selector)
    name, why, where = pattern(value) if isinstance(value, (Known, Text, Opaque, Choice)) else ("?", "it is not known", None)
    receiver = applied.receiver
    space = receiver.namespace if isinstance(receiver, Object) and receiver.namespace is not None else None
    prefix, space_why, _ = pattern(space if space is not None else Known(context.namespace))
    reason = why or (space_why if name[:1] not in ("/", "~") else None)
    full = resolve(name, prefix, context.name)
    return (full, Opaque(reason, where)) if reason else (context.remap(full), None)


def _parent(applied: Applied, selector: str) -> Value:
    full, why = _absolute(applied, selector)
    head = f"{full.rpartition('/')[0]}/"
    return Known(head) if why is None else Text((head.partition("?")[0] or "/", why)) if "?" in head else Text((head, why))


def _search(applied: Applied, selector: str) -> Value:
    """searchParam: the nearest namespace upwards that has the parameter (wiki.ros.org/Parameter Server).

    Where nothing sets it, the first that is looked at: there it would be found before all others.
    """
    context = applied.run.context
    value = select_value(applied, selector)
    name, why, where = pattern(value) if isinstance(value, (Known, Text, Opaque, Choice)) else ("?", "it is not known", None)
    if why is not None:
        return Opaque(why, where)
    if name.startswith("/"):
        return Known(name)
    receiver = applied.receiver
    space: Value = Known(context.name)
    if isinstance(receiver, Object) and receiver.namespace is not None:
        space = receiver.namespace
    prefix, why, where = pattern(space)
    while why is None:
        full = clean(f"{prefix}/{name}")
        if applied.run.parameter(full) is not None:
            return Known(full)
        if prefix in ("", "/"):
            return Known(clean(f"{pattern(space)[0]}/{name}"))
        prefix = prefix.rpartition("/")[0]
    return Opaque(why, where)


def _members(applied: Applied, value: Value, names: list[str]) -> Any:
    for name in names:
        if isinstance(value, Pointer):
            value = value.cell.value
        if isinstance(value, Object):
            cell = expressions.member(applied.run, value, name, applied.frame)
            if cell is None:
                return None
            value = cell.value
        elif isinstance(value, Opaque):
            return value
        else:
            return None
    return value


def _template_argument(types: tuple[Any, ...], index: int) -> TypeValue | None:
    if index < len(types) and is_type(types[index]):
        return TypeValue(types[index])
    return None


def _callback_type(run: Run, argument: Argument, index: int) -> TypeValue | None:
    """The type of a callback's parameter that is not bound."""
    value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
    if isinstance(value, Object) and value.definition is not None:
        value = classes.method_of(run, value, "operator()") or value
    if isinstance(value, Callable):
        free = [p for n, p in enumerate(value.function.parameters) if n >= len(value.bound) or value.bound[n] is None]
        if index >= len(free):
            return None
        scope = value.function.owner or value.function.name.rpartition("::")[0]
        inner = Frame(value.source, scope, value.function, value.this, templates=value.templates)
        return TypeValue(run.type_in(free[index].type, inner))
    kind = argument.type or operators.value_type(value)
    if kind is not None and kind[0] in ("boost::function", "std::function") and kind[1]:
        inner_type = kind[1][0]
        if inner_type[0] == "()" and len(inner_type[1]) > index + 1:
            return TypeValue(inner_type[1][index + 1])
    return None


def parameter_value(applied: Applied, name: str, default: Value | None) -> Value | None:
    """What reading parameter *name* gives: what the configuration sets, else the default; None if there is neither."""
    if "?" in name:
        return default if default is None else join(default, Opaque("the parameter's name is not known"))
    found = applied.run.parameter(clean(name))
    if found is None:
        return default
    return found
