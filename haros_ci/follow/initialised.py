# SPDX-License-Identifier: Apache-2.0
"""What variables at namespace scope and static members do before ``main``: they register classes and functions ([basic.start.dynamic])."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import lookup
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.syntax import Field
from haros_ci.syntax.walk import everything

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
            lookup.global_cell(walk, source, variable.name, variable.init, variable.type)


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
    kind = walk.type_in(variable.type, Frame(source, scope))
    constructors = walk.index.functions.get(f"{kind.name}::{kind.name.rpartition('::')[2]}", ())
    return any(type(node) is syntax.Call for _, function in constructors for node in everything(function.body))
