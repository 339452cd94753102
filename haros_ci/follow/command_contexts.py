# SPDX-License-Identifier: Apache-2.0
"""The context that a command of click runs in: its object, and what decorators pass of it (click.palletsprojects.com, Context)."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.follow import construct, expressions, python_names
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.index.mentions import MODULES
from haros_ci.model.location import Location
from haros_ci.syntax import Expression, dotted
from haros_ci.values.abstract import Cell, ClassValue, Known, Library, Object, Opaque, Value

CONTEXT, PASSING = "click.Context", "click.make_pass_decorator"
#: Contexts around one that are looked through.
DEEP = 8
#: Why what an option says is not known.
UNKNOWN = "the command line is not known"


def context_of(parent: Value, obj: Value) -> Object:
    """A context inside of *parent*, with this object."""
    fields = {"obj": Cell(obj), "parent": Cell(parent), "invoked_subcommand": Cell[Value](Opaque(UNKNOWN))}
    return Object(CONTEXT, fields=fields)


def passed(walk: Walk, frame: Frame, source: Source, decorator: Expression, context: Object) -> Iterable[Value]:
    """What a decorator passes as an argument of its own: the context, its object, or an object of a class."""
    if not dotted(decorator):
        return
    value = expressions.evaluate(walk, python_names.module_frame(walk, source), decorator)
    if isinstance(value, Library) and value.name.partition(".")[0] in MODULES:
        word = value.name.rpartition(".")[2]
        if word == "pass_context":
            yield context
        elif word == "pass_obj":
            yield context.fields["obj"].value
    elif isinstance(value, Object) and value.name == PASSING:
        yield of_class(walk, frame, context, value.fields["of"].value, value.fields["ensure"].value == Known(True))


def of_class(walk: Walk, frame: Frame, context: Object, kind: Value, is_made: bool) -> Value:
    """The nearest object of a context that is of a class (``Context.find_object``); *is_made* where there is none yet."""
    here: Value = context
    for _ in range(DEEP):
        if not isinstance(here, Object):
            break
        held = here.fields["obj"].value
        is_it = isinstance(held, Object) and isinstance(kind, ClassValue) and held.definition is not None
        if is_it or not (isinstance(held, Known) and held.value is None):
            return held
        here = here.fields["parent"].value
    if is_made and isinstance(kind, ClassValue):
        owner = (kind.source, kind.definition)
        made = construct.instance(walk, frame, owner, (), (), Location(kind.source.path, kind.definition.line))
        walk.state.write(context.fields["obj"], made)
        return made
    return walk.opaque("the object of the context is not known", frame)
