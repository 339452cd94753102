# SPDX-License-Identifier: Apache-2.0
"""Variables at namespace scope and static members, and what they do before ``main``: they register classes and functions ([basic.start.dynamic])."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import construct
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
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
    cell = walk.globals.get(key)
    if cell is None and init is None and (of := _defined(walk, source, name)) is not None:
        cell = walk.globals[key] = global_cell(walk, of[0], name, of[1].init, kind)
    if cell is None:
        frame = Frame(source, name.rpartition(source.separator)[0])
        resolved = walk.type_in(kind, frame)
        mark, begun = walk.state.mark(), tick()
        cell = walk.globals[key] = Cell(walk.opaque(f"{name} is not set", frame, None, resolved), resolved)
        if init is not None:
            cell.value = construct.initial(walk, frame, resolved, init, Location(source.path))
        elif not init:
            # Its definition: in the file itself, or that of a static member elsewhere in the program.
            definitions = walk.index.near(walk.index.variables, name, source, walk.files)
            for where, variable in definitions:
                if variable.init is not None:
                    there = Frame(where, frame.scope)
                    cell.value = construct.initial(walk, there, resolved, variable.init, Location(where.path))
                    break
            else:
                if definitions and _is_container(resolved):  # it begins without an element
                    cell.value = construct.initial(walk, frame, resolved, None, Location(source.path))
                elif definitions and _does_something(walk, source, resolved):
                    construct.initial(walk, frame, resolved, None, Location(source.path))
        walk.state.settle(mark, begun)
        walk.lasting.add(cell)
    return cell


def _defined(walk: Walk, source: Source, name: str) -> tuple[Source, Field] | None:
    """The definition in another file of a static member that *source* declares; None if there is none, or several differ."""
    found = walk.index.near(walk.index.variables, name, source, walk.files) if source.separator == "::" else []
    if not found or any(where.path == source.path or other.init != found[0][1].init for where, other in found):
        return None
    return found[0]


def _is_container(kind: Type) -> bool:
    return (kind.name in SEQUENCES or kind.name in MAPS) and not {"*", "&"} & set(kind.marks)


def _does_something(walk: Walk, source: Source, kind: Type) -> bool:
    """Whether ``T x;`` calls something. What x holds is not known then: what has changed it before it is looked at first may not have been followed."""
    is_object = not {"*", "&"} & set(kind.marks) and walk.class_of(kind.name, source) is not None
    return is_object and begins_with_calls(walk, kind.name)
