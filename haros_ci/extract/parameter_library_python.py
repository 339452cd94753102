# SPDX-License-Identifier: Apache-2.0
"""A parameter library as the Python module that is generated from it: one class, in it Params and ParamListener."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.extract.parameter_library_terms import (
    NO_TYPE,
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
from haros_ci.extract.parameter_library_tree import Declared, Library, Struct
from haros_ci.syntax import Alias, Block, Class, Expression, Function, Parameter, Program, Statement

_IMPORTS = {
    "FloatingPointRange": "rcl_interfaces.msg.FloatingPointRange",
    "IntegerRange": "rcl_interfaces.msg.IntegerRange",
    "ParameterDescriptor": "rcl_interfaces.msg.ParameterDescriptor",
    "rclpy": "rclpy",
}
_OPEN: dict[str, tuple[float, float]] = {"int": (-(2**31) - 1, 2**31 - 1)}
_SET_LATER: Expression = syntax.Unknown("whether a parameter was set since")


def python_program(library: Library) -> Program:
    """The module's classes. The entries of maps are reached by add_entry and get_entry alone."""
    space = library.name
    if ":" in space:
        return Program("python", problems=((library.root.line, f"the namespace {space!r} is no name of Python"),))
    line, column = library.root.line, library.root.column
    listener = f"{space}.ParamListener"
    params = field(name(space), "Params")
    classes = [Class(space, (), (), line, column)]
    functions: list[Function] = []
    _structs(library.root, f"{space}.Params", params, classes, functions)
    classes.append(Class(listener, (), (), line, column))
    stored = field(THIS, "params_")
    made: Block = (
        assign(field(THIS, "prefix_"), name("prefix")),
        assign(stored, syntax.Call(params, (), (), line, column)),
        assign(field(THIS, "node_"), name("node")),
        syntax.Do(syntax.Call(field(THIS, "declare_params"), (), (), line, column)),
    )
    called: Statement = syntax.Do(syntax.Call(name("callback"), (stored,), (), line, column))
    later: Statement = syntax.If(line, column, "a parameter is set", _SET_LATER, (called,), 0, 0, ())
    declared = tuple(_declaration(parameter) for parameter in library.order)
    prefix = Parameter("prefix", NO_TYPE, syntax.String(""))
    functions += [
        _function(listener, "__init__", (Parameter("node", NO_TYPE), prefix), made, line, column),
        _function(listener, "get_params", (), (syntax.Return(stored),), line, column),
        _function(listener, "is_old", (Parameter("other_param", NO_TYPE),), (syntax.Return(_SET_LATER),), line, column),
        _function(listener, "refresh_dynamic_parameters", (), (), line, column),
        _function(listener, "declare_params", (), declared, line, column),
        _function(listener, "set_user_callback", (Parameter("callback", NO_TYPE),), (later,), line, column),
        _function(listener, "clear_user_callback", (), (), line, column),
    ]
    module = Function("", "", "module", (), NO_TYPE, 1, 1, (syntax.NestedClass(space),), 1, 1)
    return Program(
        "python",
        functions=(module, *functions),
        classes=tuple(classes),
        aliases=tuple(Alias(local, syntax.Type(target)) for local, target in _IMPORTS.items()),
        problems=tuple(library.problems),
    )


def _function(
    owner: str, called: str, parameters: tuple[Parameter, ...], body: Block, line: int, column: int
) -> Function:
    kind = "constructor" if called == "__init__" else "function"
    return Function(f"{owner}.{called}", owner, kind, parameters, NO_TYPE, line, column, body, line, column)


def _structs(
    struct: Struct, qualified: str, written: Expression, classes: list[Class], functions: list[Function]
) -> None:
    line, column = struct.line, struct.column
    body: list[Statement] = []
    for parameter in struct.parameters:
        default = default_of(parameter, _not_finite(parameter))
        body.append(assign(field(THIS, parameter.path[-1]), syntax.Null() if default is None else default))
    inner_classes = [(inner, f"__{pascal(inner.path[-1])}") for inner in struct.structs]
    body += [
        assign(field(THIS, inner.path[-1]), syntax.Call(field(written, kind), (), (), inner.line, inner.column))
        for inner, kind in inner_classes
        if not inner.is_map
    ]
    if any(inner.is_map for inner in struct.structs):
        body.append(assign(field(THIS, "entries_"), syntax.DictLiteral(())))
    classes.append(Class(qualified, (), (), line, column))
    functions.append(_function(qualified, "__init__", (), tuple(body), line, column))
    for inner, kind in inner_classes:
        if inner.is_map:
            functions += _entries(qualified, field(written, kind), inner)
        _structs(inner, f"{qualified}.{kind}", field(written, kind), classes, functions)


def _entries(owner: str, kind: Expression, struct: Struct) -> list[Function]:
    """add_entry and get_entry of the class that a map is in; entries are kept in a dictionary here."""
    line, column = struct.line, struct.column
    parameters = (Parameter("name", NO_TYPE),)
    entry: Expression = syntax.Subscript(field(THIS, "entries_"), name("name"))
    added = assign(entry, syntax.Call(kind, (), (), line, column))
    test: Expression = syntax.Operation("not in", (name("name"), field(THIS, "entries_")))
    guarded: Statement = syntax.If(line, column, "not hasattr(self, name)", test, (added,), 0, 0, ())
    got: Statement = syntax.Return(entry)
    return [
        _function(owner, "add_entry", parameters, (guarded, got), line, column),
        _function(owner, "get_entry", parameters, (got,), line, column),
    ]


def _not_finite(parameter: Declared) -> dict[str, Expression]:
    return {key: call(name("float"), (text(key),), parameter) for key in ("nan", "inf")}


def _declaration(parameter: Declared) -> Statement:
    stored = field(THIS, "params_")
    prefix = field(THIS, "prefix_")
    if not parameter.keys:
        full = joined(prefix, text(".".join(parameter.path)))
        return syntax.Nested(_declared(parameter, full, field(stored, *parameter.path)))
    before, maps, inside = map_place(parameter)
    parts: list[Expression] = [prefix, *([text(".".join(before) + ".")] if before else [])]
    place = field(stored, *before)
    for number in range(1, len(maps) + 1):
        value = name(f"value_{number}")
        parts += [value, text(".")]
        place = call(field(place, "add_entry"), (value,), parameter)
    parts[-1] = text("." + ".".join(inside))
    entry = name("entry")
    body = (assign(entry, place), *_declared(parameter, syntax.Format(tuple(parts)), field(entry, *inside)))
    for number in range(len(maps), 0, -1):
        keys = parameter.keys[number - 1]
        shown = f"value_{number} in updated_params.{'.'.join(keys)}"
        line, column = parameter.line, parameter.column
        body = (syntax.Each(line, column, shown, f"value_{number}", NO_TYPE, field(stored, *keys), body),)
    return body[0]


def _declared(parameter: Declared, full: Expression, place: Expression) -> Block:
    descriptor = name("descriptor")
    default = default_of(parameter, _not_finite(parameter))
    kind = "INTEGER" if parameter.base == "int" else parameter.base.upper()
    if default is None:
        default = field(name("rclpy"), "Parameter", "Type", f"{kind}_ARRAY" if parameter.is_array else kind)
    described: tuple[Expression, ...] = (
        syntax.Keyword("description", text(parameter.description)),
        syntax.Keyword("read_only", syntax.Boolean(parameter.read_only)),
    )
    declared = call(field(THIS, "node_", "declare_parameter"), (full, default, descriptor), parameter)
    return (
        assign(descriptor, call(name("ParameterDescriptor"), described, parameter)),
        *(
            [assign(field(descriptor, "additional_constraints"), text(parameter.constraints))]
            if parameter.constraints
            else []
        ),
        *_range(parameter),
        assign(place, field(declared, "value")),
    )


def _range(parameter: Declared) -> Block:
    lower, upper = bounds_of(parameter, is_exact=False)
    if lower is None and upper is None:
        return ()
    endless = _not_finite(parameter)["inf"]
    least: Expression = (
        syntax.Operation("-", (endless,)) if parameter.base == "double" else syntax.Number(_OPEN["int"][0])
    )
    greatest = endless if parameter.base == "double" else syntax.Number(_OPEN["int"][1])
    what, member = (
        ("FloatingPointRange", "floating_point_range")
        if parameter.base == "double"
        else ("IntegerRange", "integer_range")
    )
    provided: tuple[Expression, ...] = (
        syntax.Keyword("from_value", least if lower is None else syntax.Number(lower)),
        syntax.Keyword("to_value", greatest if upper is None else syntax.Number(upper)),
    )
    return (assign(field(name("descriptor"), member), syntax.ListLiteral((call(name(what), provided, parameter),))),)
