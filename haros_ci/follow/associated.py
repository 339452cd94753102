# SPDX-License-Identifier: Apache-2.0
"""Functions that are found by the namespaces of their arguments' types ([basic.lookup.argdep])."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import bases, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import pointee
from haros_ci.values.abstract import Callable, Library, Object, Opaque, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.index.index import Source


def meant(
    walk: Walk, frame: Frame, callee: syntax.Expression, function: Value, arguments: tuple[PassedArgument, ...]
) -> Value:
    """What the unqualified name *callee* calls, where *function* is what it means without its arguments: a library's if nothing has been found."""
    if type(callee) is not syntax.Name or "::" in callee.name or frame.source.separator != "::":
        return function
    if not isinstance(function, Library) or function.this is not None or function.name != callee.name:
        return function
    for namespace in dict.fromkeys(_namespaces(walk, frame, arguments)):
        found = walk.index.near(walk.index.functions, f"{namespace}::{callee.name}", frame.source, walk.files)
        if found:
            return Callable(*methods.with_body(walk, found))
    return function


def _namespaces(walk: Walk, frame: Frame, arguments: tuple[PassedArgument, ...]) -> Iterator[str]:
    """The namespaces around the arguments' classes of the workspace and their bases."""
    for argument in arguments:
        owner = _class(walk, frame, argument)
        for source, definition in bases.classes(walk, *owner) if owner is not None else ():
            name = definition.name
            while name and walk.class_of(name, source) is not None:
                name = name.rpartition("::")[0]
            if name:
                yield name


def _class(walk: Walk, frame: Frame, argument: PassedArgument) -> tuple[Source, syntax.Class] | None:
    value = argument.value
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object):
        return value.definition
    kind = value.type if isinstance(value, Opaque) else argument.type
    return walk.class_of(pointee(kind).name, frame.source) if kind is not None and kind.name else None
