# SPDX-License-Identifier: Apache-2.0
"""A parameter library as the C++ header that is generated from it."""

from __future__ import annotations

import sys

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
from haros_ci.model.program import Alias, Block, Class, Expression, Field, Function, Parameter, Program, Statement, Type

_TYPES = {"bool": "bool", "int": "int64_t", "double": "double", "string": "std::string"}
_STRING: Type = ("std::string", (), "")
_VOID: Type = ("void", (), "")
_BOOL: Type = ("bool", (), "")
_INTERFACE: Type = ("std::shared_ptr", (("rclcpp::node_interfaces::NodeParametersInterface", (), ""),), "c&")
_DOUBLE: tuple[Type, ...] = (("double", (), ""),)
#: The members of the range of a number that a validator leaves open.
_OPEN = {"double": (-sys.float_info.max, sys.float_info.max), "int": (-(2**63), 2**63 - 1)}
_SET_LATER: Expression = ("?", "whether a parameter was set since")


def cpp_program(library: Library) -> Program:
    """The header's classes. Arrays and strings of a fixed size are a std::vector and a std::string here."""
    space = library.name
    listener = f"{space}::ParamListener"
    line, column = library.root.line, library.root.column
    params: Type = (f"{space}::Params", (), "")
    fields = (
        Field("prefix_", _STRING, None, line, column),
        Field("params_", params, None, line, column),
        Field("parameters_interface_", ("auto", (), ""), None, line, column),
    )
    classes: list[Class] = []
    _structs(library.root, f"{space}::Params", classes)
    classes.append(Class(listener, (), fields, line, column))
    prefix = Parameter("prefix", ("std::string", (), "c&"), ("str", ""))
    interface = Parameter("parameters_interface", _INTERFACE)
    logger = Parameter("logger", ("rclcpp::Logger", (), ""))
    makers = [
        _constructor(library, (Parameter("node", ("NodeT", (), "")), prefix), ("NodeT",)),
        _constructor(library, (interface, prefix)),
        _constructor(library, (interface, logger, prefix)),
    ]
    stored = field(THIS, "params_")
    target = Parameter("params", (f"{space}::Params", (), "&"))
    other = Parameter("other", (f"{space}::Params", (), "c&"))
    callback = Parameter("callback", ("std::function", (("()", (_VOID, (f"{space}::Params", (), "c&")), ""),), "c&"))
    called: Statement = ("do", ("call", name("callback"), (stored,), (), line, column))
    later: Statement = ("if", line, column, "a parameter is set", _SET_LATER, (called,), 0, 0, ())
    copied = (assign(name("params"), stored), ("return", _SET_LATER))
    declared = tuple(_declaration(parameter) for parameter in library.order)
    methods = (
        _method(library, "get_params", params, (), (("return", stored),)),
        _method(library, "get_stack_params", params, (), (("return", stored),)),
        _method(library, "try_get_params", _BOOL, (target,), copied),
        _method(library, "try_update_params", _BOOL, (target,), copied),
        _method(library, "is_old", _BOOL, (other,), (("return", _SET_LATER),)),
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
    inner: Type = (_TYPES[parameter.base], (), "")
    return ("std::vector", (inner,), "") if parameter.is_array else inner


def _not_finite(parameter: Declared) -> dict[str, Expression]:
    callees = {"nan": "std::numeric_limits::quiet_NaN", "inf": "std::numeric_limits::infinity"}
    return {key: call(name(callee), (), parameter, _DOUBLE) for key, callee in callees.items()}


def _structs(struct: Struct, qualified: str, classes: list[Class]) -> None:
    fields = []
    for parameter in struct.parameters:
        default = default_of(parameter, _not_finite(parameter))
        init = None if default is None else ("=", default)
        fields.append(Field(parameter.path[-1], _type(parameter), init, parameter.line, parameter.column))
    for inner in struct.structs:
        key = inner.path[-1]
        kind: Type = (f"{qualified}::{pascal(key)}", (), "")
        if inner.is_map:
            fields.append(Field(_map_name(key), ("std::map", (_STRING, kind), ""), None, inner.line, inner.column))
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
    last: Expression = ("call", field(prefix, "back"), (), (), line, column)
    test: Expression = (
        "op",
        "&&",
        (
            ("op", "!", (("call", field(prefix, "empty"), (), (), line, column),)),
            ("op", "!=", (last, ("cast", ("char", (), ""), ("num", ord("."))))),
        ),
    )
    dot: Statement = ("do", ("set", "+=", prefix, text(".")))
    body: Block = (
        assign(prefix, name("prefix")),
        ("if", line, column, "!prefix_.empty() && prefix_.back() != '.'", test, (dot,), 0, 0, ()),
        assign(field(THIS, "parameters_interface_"), name(parameters[0].name)),
        ("do", ("call", field(THIS, "declare_params"), (), (), line, column)),
    )
    owner = f"{library.name}::ParamListener"
    return Function(
        name=f"{owner}::ParamListener",
        owner=owner,
        kind="constructor",
        parameters=parameters,
        returns=("", (), ""),
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
        return ("block", _declared(parameter, full, field(stored, *parameter.path)))
    before, maps, inside = map_place(parameter)
    parts: list[Expression] = [prefix, *([text(".".join(before) + ".")] if before else [])]
    place = field(stored, *before)
    for number, key in enumerate(maps, start=1):
        parts += [name(f"value_{number}"), text(".")]
        place = ("index", field(place, _map_name(key)), name(f"value_{number}"))
    parts[-1] = text("." + ".".join(inside))
    statement: Statement = ("block", _declared(parameter, joined(*parts), field(place, *inside)))
    for number in range(len(maps), 0, -1):
        keys = parameter.keys[number - 1]
        shown = f"const auto & value_{number} : updated_params.{'.'.join(keys)}"
        over = field(stored, *keys)
        kind: Type = ("auto", (), "c&")
        line, column = parameter.line, parameter.column
        statement = ("each", line, column, shown, f"value_{number}", kind, over, (statement,))
    return statement


def _declared(parameter: Declared, full: Expression, place: Expression) -> Block:
    descriptor = name("descriptor")
    default = default_of(parameter, _not_finite(parameter))
    arguments = (full, descriptor) if default is None else (full, default, descriptor)
    callee = field(THIS, "parameters_interface_", "declare_parameter")
    kind: Type = ("rcl_interfaces::msg::ParameterDescriptor", (), "")
    return (
        ("var", "descriptor", kind, None, parameter.line, parameter.column),
        assign(field(descriptor, "description"), text(parameter.description)),
        assign(field(descriptor, "read_only"), ("bool", parameter.read_only)),
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
        ("var", "range", (f"rcl_interfaces::msg::{what}", (), ""), None, parameter.line, parameter.column),
        assign(field(made, "from_value"), ("num", least if lower is None else lower)),
        assign(field(made, "to_value"), ("num", greatest if upper is None else upper)),
        assign(field(name("descriptor"), member), ("list", (made,))),
    )
