# SPDX-License-Identifier: Apache-2.0
"""A parameter library as the C++ header that is generated from it."""

from __future__ import annotations

import sys

from haros_ci import syntax
from haros_ci.extract.parameter_library_terms import (
    THIS,
    assign,
    bounds_of,
    call,
    default_of,
    field,
    joined,
    map_place,
    name,
    pascal,
    text,
)
from haros_ci.extract.parameter_library_tree import MAP, Declared, Library, Struct
from haros_ci.syntax import Alias, Block, Class, Expression, Field, Function, Parameter, Program, Statement, Type

_TYPES = {"bool": "bool", "int": "int64_t", "double": "double", "string": "std::string"}
_STRING: Type = syntax.Type("std::string")
_VOID: Type = syntax.Type("void")
_BOOL = syntax.Type("bool")
_INTERFACE = syntax.Type("std::shared_ptr", (syntax.Type("rclcpp::node_interfaces::NodeParametersInterface"),), "c&")
_DOUBLE: tuple[Type, ...] = (syntax.Type("double"),)
#: The members of the range of a number that a validator leaves open.
_OPEN = {"double": (-sys.float_info.max, sys.float_info.max), "int": (-(2**63), 2**63 - 1)}
_SET_LATER: Expression = syntax.Unknown("whether a parameter was set since")


def cpp_program(library: Library) -> Program:
    """The header's classes. Arrays and strings of a fixed size are a std::vector and a std::string here."""
    space = library.name
    listener = f"{space}::ParamListener"
    line, column = library.root.line, library.root.column
    params: Type = syntax.Type(f"{space}::Params")
    fields = (
        Field("prefix_", _STRING, None, line, column),
        Field("params_", params, None, line, column),
        Field("parameters_interface_", syntax.Type("auto"), None, line, column),
    )
    classes: list[Class] = []
    _structs(library.root, f"{space}::Params", classes)
    classes.append(Class(listener, (), fields, line, column))
    prefix = Parameter("prefix", syntax.Type("std::string", (), "c&"), syntax.String(""))
    interface = Parameter("parameters_interface", _INTERFACE)
    logger = Parameter("logger", syntax.Type("rclcpp::Logger"))
    makers = [
        _constructor(library, (Parameter("node", syntax.Type("NodeT")), prefix), ("NodeT",)),
        _constructor(library, (interface, prefix)),
        _constructor(library, (interface, logger, prefix)),
    ]
    stored = field(THIS, "params_")
    target = Parameter("params", syntax.Type(f"{space}::Params", (), "&"))
    other = Parameter("other", syntax.Type(f"{space}::Params", (), "c&"))
    callback = Parameter("callback", syntax.Type("std::function", (syntax.Type("()", (_VOID, other.type)),), "c&"))
    called: Statement = syntax.Do(syntax.Call(name("callback"), (stored,), (), line, column))
    later: Statement = syntax.If(line, column, "a parameter is set", _SET_LATER, (called,), 0, 0, ())
    copied = (assign(name("params"), stored), syntax.Return(_SET_LATER))
    declared = tuple(_declaration(parameter) for parameter in library.order)
    methods = (
        _method(library, "get_params", params, (), (syntax.Return(stored),)),
        _method(library, "get_stack_params", params, (), (syntax.Return(stored),)),
        _method(library, "try_get_params", _BOOL, (target,), copied),
        _method(library, "try_update_params", _BOOL, (target,), copied),
        _method(library, "is_old", _BOOL, (other,), (syntax.Return(_SET_LATER),)),
        _method(library, "refresh_dynamic_parameters", _VOID, (), ()),
        _method(library, "declare_params", _VOID, (), declared),
        _method(library, "setUserCallback", _VOID, (callback,), (later,)),
        _method(library, "clearUserCallback", _VOID, (), ()),
    )
    return Program(
        "cpp",
        functions=(*makers, *methods),
        classes=tuple(classes),
        aliases=(Alias(f"{space}::StackParams", params),),
        problems=tuple(library.problems),
    )


def _type(parameter: Declared) -> Type:
    inner: Type = syntax.Type(_TYPES[parameter.base])
    return syntax.Type("std::vector", (inner,)) if parameter.is_array else inner


def _not_finite(parameter: Declared) -> dict[str, Expression]:
    callees = {"nan": "std::numeric_limits::quiet_NaN", "inf": "std::numeric_limits::infinity"}
    return {key: call(name(callee), (), parameter, _DOUBLE) for key, callee in callees.items()}


def _structs(struct: Struct, qualified: str, classes: list[Class]) -> None:
    fields = []
    for parameter in struct.parameters:
        default = default_of(parameter, _not_finite(parameter))
        init = None if default is None else syntax.Equals(default)
        fields.append(Field(parameter.path[-1], _type(parameter), init, parameter.line, parameter.column))
    for inner in struct.structs:
        key = inner.path[-1]
        kind: Type = syntax.Type(f"{qualified}::{pascal(key)}")
        if inner.is_map:
            fields.append(
                Field(_map_name(key), syntax.Type("std::map", (_STRING, kind)), None, inner.line, inner.column)
            )
        else:
            fields.append(Field(key, kind, None, inner.line, inner.column))
    classes.append(Class(qualified, (), tuple(fields), struct.line, struct.column))
    for inner in struct.structs:
        _structs(inner, f"{qualified}::{pascal(inner.path[-1])}", classes)


def _map_name(key: str) -> str:
    return f"{key.removeprefix(MAP)}_map"


def _constructor(library: Library, parameters: tuple[Parameter, ...], templates: tuple[str, ...] = ()) -> Function:
    """Sets the members from the first and last parameter, a dot behind a prefix that lacks it, and declares."""
    line, column = library.root.line, library.root.column
    prefix = field(THIS, "prefix_")
    last: Expression = syntax.Call(field(prefix, "back"), (), (), line, column)
    test: Expression = syntax.Operation(
        "&&",
        (
            syntax.Operation("!", (syntax.Call(field(prefix, "empty"), (), (), line, column),)),
            syntax.Operation("!=", (last, syntax.Cast(syntax.Type("char"), syntax.Number(ord("."))))),
        ),
    )
    dot: Statement = syntax.Do(syntax.Assignment("+=", prefix, text(".")))
    body: Block = (
        assign(prefix, name("prefix")),
        syntax.If(line, column, "!prefix_.empty() && prefix_.back() != '.'", test, (dot,), 0, 0, ()),
        assign(field(THIS, "parameters_interface_"), name(parameters[0].name)),
        syntax.Do(syntax.Call(field(THIS, "declare_params"), (), (), line, column)),
    )
    owner = f"{library.name}::ParamListener"
    return Function(
        name=f"{owner}::ParamListener",
        owner=owner,
        kind="constructor",
        parameters=parameters,
        returns=syntax.Type(""),
        line=line,
        column=column,
        body=body,
        body_line=line,
        body_column=column,
        templates=templates,
    )


def _method(library: Library, called: str, returns: Type, parameters: tuple[Parameter, ...], body: Block) -> Function:
    owner = f"{library.name}::ParamListener"
    line, column = library.root.line, library.root.column
    return Function(f"{owner}::{called}", owner, "function", parameters, returns, line, column, body, line, column)


def _declaration(parameter: Declared) -> Statement:
    """The block that declares one parameter and keeps its value; within loops where it is in maps."""
    stored = field(THIS, "params_")
    prefix = field(THIS, "prefix_")
    if not parameter.keys:
        full = joined(prefix, text(".".join(parameter.path)))
        return syntax.Nested(_declared(parameter, full, field(stored, *parameter.path)))
    before, maps, inside = map_place(parameter)
    parts: list[Expression] = [prefix, *([text(".".join(before) + ".")] if before else [])]
    place = field(stored, *before)
    for number, key in enumerate(maps, start=1):
        parts += [name(f"value_{number}"), text(".")]
        place = syntax.Subscript(field(place, _map_name(key)), name(f"value_{number}"))
    parts[-1] = text("." + ".".join(inside))
    statement: Statement = syntax.Nested(_declared(parameter, joined(*parts), field(place, *inside)))
    for number in range(len(maps), 0, -1):
        keys = parameter.keys[number - 1]
        shown = f"const auto & value_{number} : updated_params.{'.'.join(keys)}"
        over = field(stored, *keys)
        kind: Type = syntax.Type("auto", (), "c&")
        line, column = parameter.line, parameter.column
        statement = syntax.Each(line, column, shown, f"value_{number}", kind, over, (statement,))
    return statement


def _declared(parameter: Declared, full: Expression, place: Expression) -> Block:
    descriptor = name("descriptor")
    default = default_of(parameter, _not_finite(parameter))
    arguments = (full, descriptor) if default is None else (full, default, descriptor)
    callee = field(THIS, "parameters_interface_", "declare_parameter")
    kind: Type = syntax.Type("rcl_interfaces::msg::ParameterDescriptor")
    return (
        syntax.Variable("descriptor", kind, None, parameter.line, parameter.column),
        assign(field(descriptor, "description"), text(parameter.description)),
        assign(field(descriptor, "read_only"), syntax.Boolean(parameter.read_only)),
        *(
            [assign(field(descriptor, "additional_constraints"), text(parameter.constraints))]
            if parameter.constraints
            else []
        ),
        *_range(parameter),
        assign(place, call(callee, arguments, parameter, (_type(parameter),))),
    )


def _range(parameter: Declared) -> Block:
    lower, upper = bounds_of(parameter, is_exact=True)
    if lower is None and upper is None:
        return ()
    least, greatest = _OPEN[parameter.base]
    what, member = (
        ("FloatingPointRange", "floating_point_range")
        if parameter.base == "double"
        else ("IntegerRange", "integer_range")
    )
    made = name("range")
    return (
        syntax.Variable("range", syntax.Type(f"rcl_interfaces::msg::{what}"), None, parameter.line, parameter.column),
        assign(field(made, "from_value"), syntax.Number(least if lower is None else lower)),
        assign(field(made, "to_value"), syntax.Number(greatest if upper is None else upper)),
        assign(field(name("descriptor"), member), syntax.ListLiteral((made,))),
    )
