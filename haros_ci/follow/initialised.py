# SPDX-License-Identifier: Apache-2.0
"""Variables at namespace scope and static members, and what they do before ``main``: they register classes and functions ([basic.start.dynamic])."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import construct
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import EITHER, Source
from haros_ci.index.types import MAPS, SEQUENCES
from haros_ci.model.location import Location
from haros_ci.syntax import Field, Type
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Cell, tick

#: Variables of one program that are followed so.
MOST = 200


def before_main(walk: Walk) -> None:
    """Follow the initialisers of the program's files that call something of the workspace, in the order of the files and their lines."""
    found = 0
    for path in sorted(walk.files):
        source = walk.index.sources.get(path)
        for variable in _doing(walk, source) if source is not None else ():
            found += 1
            if found > MOST:
                return
            assert source is not None
            global_cell(walk, source, variable.name, variable.init, variable.type)


def _doing(walk: Walk, source: Source) -> tuple[Field, ...]:
    key = ("initialised", source.path)
    if key not in walk.found:
        walk.found[key] = tuple(field for field in source.program.variables if _does(walk, source, field))
    known: tuple[Field, ...] = walk.found[key]
    return known


def _does(walk: Walk, source: Source, variable: Field) -> bool:
    """Whether the start of a variable calls a function of the workspace, or its class has a constructor that calls something."""
    scope = variable.name.rpartition("::")[0]
    for node in everything(variable.init):
        if type(node) is syntax.Call and type(node.callee) is syntax.Name:
            if any(walk.index.functions.get(name) for name in walk.index.scopes(node.callee.name, scope, source)):
                return True
    if "*" in variable.type.marks or "&" in variable.type.marks:
        return False
    return begins_with_calls(walk, walk.type_in(variable.type, Frame(source, scope)).name)


def begins_with_calls(walk: Walk, name: str) -> bool:
    """Whether a constructor of the class of that qualified name calls something."""
    constructors = walk.index.functions.get(f"{name}::{name.rpartition('::')[2]}", ())
    return any(type(node) is syntax.Call for _, function in constructors for node in everything(function.body))


def global_cell(walk: Walk, source: Source, name: str, init: syntax.Init | None, kind: Type) -> Cell:
    """The one cell of a namespace-scope variable or static member, made when it is first used."""
    key = (source.path, name)
    if key in walk.globals:
        return walk.globals[key]
    definitions = _definitions(walk, source, name) if init is None else []
    where, init = (definitions[0][0], definitions[0][1].init) if definitions else (source, init)
    if any(other.init != init for _, other in definitions):
        where, init = source, syntax.Equals(syntax.Unknown(EITHER))
    if where.path != source.path and source.separator == "::":  # a static member: its cell is that of the definition
        cell = walk.globals[key] = global_cell(walk, where, name, init, kind)
        return cell
    frame = Frame(where, name.rpartition(source.separator)[0])
    resolved = walk.type_in(kind, Frame(source, frame.scope))
    mark, begun = walk.state.mark(), tick()
    cell = walk.globals[key] = Cell(walk.opaque(f"{name} is not set", frame, None, resolved), resolved)
    if init is not None or (definitions and _is_container(resolved)):  # a container begins without an element
        cell.value = construct.initial(walk, frame, resolved, init, Location(where.path))
    elif definitions and _does_something(walk, source, resolved):
        construct.initial(walk, frame, resolved, None, Location(where.path))
    walk.state.settle(mark, begun)
    walk.lasting.add(cell)
    return cell


def _definitions(walk: Walk, source: Source, name: str) -> list[tuple[Source, Field]]:
    """The definitions of a variable that *source* declares: those with an initialiser if there are any, and those of *source* itself if there are any."""
    found = walk.index.near(walk.index.variables, name, source, walk.files)
    begun = [one for one in found if one[1].init is not None] or found
    return [one for one in begun if one[0].path == source.path] or begun


def _is_container(kind: Type) -> bool:
    return (kind.name in SEQUENCES or kind.name in MAPS) and not {"*", "&"} & set(kind.marks)


def _does_something(walk: Walk, source: Source, kind: Type) -> bool:
    """Whether ``T x;`` calls something. What x holds is not known then: what has changed it before it is looked at first may not have been followed."""
    is_object = not {"*", "&"} & set(kind.marks) and walk.class_of(kind.name, source) is not None
    return is_object and begins_with_calls(walk, kind.name)
