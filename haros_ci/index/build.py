# SPDX-License-Identifier: Apache-2.0
"""The index of programs, built from their files."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.index.index import EITHER, Index, Source, aliased
from haros_ci.index.trace import Traced
from haros_ci.syntax import Alias, Field, Function, Program


def build_index(sources: Iterable[Source]) -> Index:
    """Index *sources*, sorted by path."""
    index = Index()
    for source in sources:
        _add(index, source)
    for source in index.sources.values():
        for function in source.program.functions:
            if function.owner and function.owner not in index.classes:
                if function.owner in index.aliases:
                    _through_alias(index, source, function)
                elif function.kind != "lambda" and function.name:
                    _in_open_namespace(index, source, function)
    for name in ("classes", "functions", "variables", "aliases", "macros", "by_tail"):
        setattr(index, name, Traced(getattr(index, name)))
    return index


def _add(index: Index, source: Source) -> None:
    """Enter all that the file defines under its names."""
    program = source.program
    is_cpp = program.language != "python"
    if is_cpp:
        _add_file(index, source)
    else:
        index.by_place[source.path.removesuffix(".py").removesuffix("/__init__")] = source
    for definition in program.classes:
        fields = _without_doubles(definition.fields) if is_cpp else definition.fields
        whole = definition if fields is definition.fields else syntax.replace(definition, fields=fields)
        index.classes[definition.name].append((source, whole))
    for function in program.functions:
        if function.kind != "lambda" and function.name:
            _add_function(index, source, function)
    for variable in _without_doubles(program.variables) if is_cpp else program.variables:
        index.variables[variable.name].append((source, variable))
    for alias in program.aliases:
        index.aliases[alias.name].append((source, alias))
    for name, parameters, body in program.macros:
        if parameters is None:
            index.macros[name].append((source, body))
    if source.module:
        index.modules[source.module].append(source)
    index.included[source.path] = _included(program)


def _add_file(index: Index, source: Source) -> None:
    """Enter a file of C++ under its path and name, and what is defined inside of its functions."""
    program = source.program
    index.sources[source.path] = source
    index.file_names[posixpath.basename(source.path)].append(source.path)
    functions = {function.name for function in program.functions if function.name and function.kind != "lambda"}
    index.local[source.path] = _local(program, functions)
    spaces = (alias.name for alias in program.aliases if alias.type.marks == "namespace")
    inside = (*(item.name for item in program.classes), *spaces)
    index.inner |= functions.intersection(name.rpartition("::")[0] for name in inside)


def _add_function(index: Index, source: Source, function: Function) -> None:
    index.functions[function.name].append((source, function))
    if function.owner and source.program.language != "python":
        parts = function.name.split("::")
        index.by_tail["::".join(parts[-2:])].append((source, function))


def _in_open_namespace(index: Index, source: Source, function: Function) -> None:
    """A method whose class is named under a using-directive, or in full within its own namespace, is the class's."""
    head, rest = "", function.owner
    names: list[str] = []
    while rest:
        names += [rest] if head else []
        names += [f"{around}{space}::{rest}" for space in index.opened(source) for around in {"", head}]
        part, _, rest = rest.partition("::")
        head += f"{part}::"
    owners = {name for name in names if name in index.classes and index.includes(source, index.classes[name])}
    if len(owners) != 1:
        return
    owner, last = owners.pop(), function.name.rpartition("::")[2]
    found = syntax.replace(function, name=f"{owner}::{last}", owner=owner)
    index.functions[function.name] = [item for item in index.functions[function.name] if item[1] is not function]
    index.functions[found.name].append((source, found))
    tail = "::".join(function.name.split("::")[-2:])
    index.by_tail[tail] = [(where, found if item is function else item) for where, item in index.by_tail[tail]]


def _through_alias(index: Index, source: Source, function: Function) -> None:
    """A method that is defined with a typedef's name before its own is the class's."""
    owner = aliased(index, function.owner, source)
    if owner is None:
        return
    last = function.name.rpartition("::")[2]
    own = owner.rpartition("::")[2]
    if last in (own, function.owner.rpartition("::")[2]):
        function = syntax.replace(function, kind="constructor")
        last = own
    found = syntax.replace(function, name=f"{owner}::{last}", owner=owner)
    index.functions[found.name].append((source, found))
    index.by_tail[f"{own}::{last}"].append((source, found))


def _without_doubles(fields: tuple[Field, ...]) -> tuple[Field, ...]:
    """*fields* with one of each name: what the branches of an #if define starts as the one says that is compiled."""
    if len({field.name for field in fields}) == len(fields):
        return fields
    every: dict[str, list[Field]] = {}
    for field in fields:
        every.setdefault(field.name, []).append(field)
    return tuple(_one_of(found) for found in every.values())


def _one_of(fields: list[Field]) -> Field:
    """What several definitions of one variable come to: the first that says what it starts as, or either."""
    with_init = [field for field in fields if field.init is not None]
    first = (with_init or fields)[0]
    if all(field.init == first.init for field in with_init):
        return first
    value = _start(with_init[-1].init)
    for field in reversed(with_init[:-1]):
        test = syntax.Compiled(field.guards) if field.guards else syntax.Unknown(EITHER)
        value = syntax.Conditional(test, _start(field.init), value)
    return syntax.replace(first, init=syntax.Equals(value))


def _start(init: syntax.Init | None) -> syntax.Expression:
    """The expression that a variable starts with."""
    if type(init) is syntax.Equals:
        return init.value
    return init.arguments[0] if init is not None and len(init.arguments) == 1 else syntax.Unknown(EITHER)


def _local(program: Program, functions: set[str]) -> dict[str, Alias | None]:
    found: dict[str, Alias | None] = {}
    for alias in program.aliases:
        around, colons, name = alias.name.rpartition("::")
        if colons and around in functions:
            known = found.get(name, alias)
            is_same = known is not None and known.type == alias.type and _above(known) == _above(alias)
            found[name] = known if is_same else None
    return found


def _above(alias: Alias) -> str:
    """What the function of a local alias is in."""
    return alias.name.rpartition("::")[0].rpartition("::")[0]


#: Directories of generated headers of ROS 2 (``pkg/msg/some_type.hpp``).
INTERFACES = ("/msg", "/srv", "/action")


def _included(program: Program) -> dict[str, str]:
    found: dict[str, str] = {}
    for include in program.includes:
        head, slash, tail = include.strip('<>"').rpartition("/")
        if slash and head and "/" not in head and tail.endswith((".h", ".hpp")):
            name = tail.rpartition(".")[0]
            found.setdefault(name, f"{head}::{name}")
        elif head.endswith(INTERFACES) and head.count("/") == 1 and tail.endswith(".hpp"):
            found.setdefault(f"{head.partition('/')[2]}/{tail[:-4]}", head.replace("/", "::"))
    return found
