# SPDX-License-Identifier: Apache-2.0
"""Functions of the workspace, followed with their arguments; what they return, and leave behind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import (
    around,
    barren,
    call_arguments,
    construct,
    conversions,
    converting,
    copies,
    expressions,
    guarded,
    inert,
    members,
    methods,
    overloads,
    recursion,
    setters,
    statements,
    template_arguments,
    thrown,
)
from haros_ci.follow.frames import NEXT, RAISED, Frame
from haros_ci.follow.libraries import library
from haros_ci.follow.walk import Walk
from haros_ci.index.index import EITHER
from haros_ci.index.types import STRINGS, is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Expression, Function
from haros_ci.values.abstract import NONE, Callable, Cell, Known, Mapped, Object, Opaque, Sequence, Value, join

#: Steps that may go into one function that makes nothing; after that its results are not known.
SPENT = 300
#: Steps of one call up to which a function that makes nothing is short, and steps that may go into one that is.
SHORT, SPENT_SHORT = 10, 4000
#: The same for one that is asked of a plug-in's name, as whether a list leaves it out.
SPENT_ASKED = 20_000
#: Steps that may go into one function in rehearsals, even if it makes something.
REHEARSED = 10_000
#: Steps of rehearsals after which a function is rehearsed no longer than one that makes nothing is followed.
MANY = 30_000
#: Why a node may have more than what was made, and why a value is not known.
#: Why what is made may not be, of sources of which a build has one.
ONE_OF = "it is in one of several files of which a build has one"
TOO_DEEP = "the code is nested too deeply to be followed"


def choose(walk: Walk, frame: Frame, function: Callable, args: tuple[call_arguments.PassedArgument, ...]) -> Callable:
    """The overload of a free function or method that takes these arguments."""
    definition = function.function
    if not definition.name or definition.kind == "lambda" or overloads.is_any(walk, definition):
        return function
    if function.source.separator == ".":
        chosen = overloads.decorated(walk, definition)
        return function if chosen is definition else replace(function, function=chosen)
    if function.frame is not None:
        return function
    candidates = walk.index.near(walk.index.functions, definition.name, function.source, walk.files)
    if len(candidates) < 2:
        return function
    arguments = (*(call_arguments.PassedArgument(value or Opaque("an argument")) for value in function.bound), *args)
    source, chosen = methods.overload(walk, candidates, arguments)
    return replace(function, source=source, function=chosen)


def invoke(
    walk: Walk,
    frame: Frame,
    function: Callable,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...] = (),
) -> Value:
    """Follow a function of the workspace with these arguments."""
    walk.step()
    definition = function.function
    if definition.decorators and (around_it := around.called(walk, frame, function, args)) is not None:
        return around_it
    if definition.body is None:
        source, definition = methods.with_body(walk, [(function.source, definition)])
        function = Callable(source, definition, function.this, function.bound, function.frame, function.templates)
    ways = overloads.ways(walk, definition)
    if ways:
        others = [replace(function, source=source, function=other) for source, other in ways]
        return walk.either_way([partial(invoke, walk, frame, other, args, targs) for other in others], ONE_OF)
    inner_scope = definition.owner or definition.name.rpartition(function.source.separator)[0]
    templates: Mapping[str, syntax.Argument] = function.templates
    if function.this is not None and definition.owner:
        of_base = methods.templates_of(walk, function.this, definition.owner)
        templates = {**templates, **of_base} if of_base else templates
    if definition.templates:
        explicit = {
            n: walk.type_in(t, frame) if type(t) is syntax.Type else t
            for n, t in zip(definition.templates, targs, strict=False)
            if isinstance(t, (syntax.Type, syntax.Number))
        }
        templates = {**templates, **template_arguments.deduced(definition, args), **explicit}
        templates = template_arguments.defaulted(walk, function.source, inner_scope, definition, templates, args)
    inner = Frame(
        function.source,
        inner_scope,
        definition,
        function.this,
        templates=templates,
        outer=function.frame if isinstance(function.frame, Frame) else None,
        mark=walk.state.mark(),
    )
    returns = walk.type_in(definition.returns, inner)
    if definition.body is None:
        found = library.unknown_call(walk, frame, definition.name, args)
        return conversions.converted(found, returns) if returns.name not in ("", "void", "auto") else found
    if recursion.is_over(walk, frame, inner, function, args):
        library.unknown_call(walk, frame, definition.name, args)
        inert.skipped(walk, inner, function, definition, returns, _with_bound(function.bound, args))
        return walk.opaque("calls are nested too deeply to be followed", frame, None, returns)
    arguments = _with_bound(function.bound, args)
    makes_nothing = not inert.may_make(walk, function, arguments, inner.templates)
    spent, times = walk.spent.get(id(definition), (0, 0))
    is_long = spent > SPENT and (spent > SHORT * times or spent > SPENT_SHORT)
    if (
        is_long
        and walk.listed
        and spent <= SPENT_ASKED
        and any(barren.is_plugin(walk, argument.value) for argument in arguments)
    ):
        is_long = False
    if not makes_nothing and barren.is_idle(walk, inner, definition, arguments):
        return inert.skipped(walk, inner, function, definition, returns, arguments)
    is_inert = makes_nothing and not is_long and inert.is_inert(walk, function, definition, returns, arguments)
    is_setter = is_inert and setters.is_setter(walk, definition, function.source)
    if (
        (makes_nothing and is_long)
        or (is_inert and not is_setter)
        or (walk.quiet and spent > (REHEARSED if walk.quiet_steps < MANY else SPENT))
    ):
        return inert.skipped(walk, inner, function, definition, returns, arguments)
    bind(walk, frame, inner, definition, arguments)
    before, there = walk.steps, walk.extent()
    walk.beyond += frame.is_dead
    walk.setting += is_setter
    try:
        value = follow_body(walk, inner, definition)
        value = converting.converted(walk, inner, value, returns, Location(inner.source.path, definition.line))
        value = conversions.converted(value, returns)
    finally:
        walk.beyond -= frame.is_dead
        walk.setting -= is_setter
    value = copies.returned(walk, inner, definition, returns, value)
    if makes_nothing or walk.quiet:
        spent, times = walk.spent.get(id(definition), (0, 0))
        walk.spent[id(definition)] = spent + walk.steps - before, times + 1
        if is_setter:
            setters.followed(walk, function, inner.mark)
    else:
        barren.count(walk, definition, before, there)
    return value


def _with_bound(
    bound: tuple[Value | None, ...], args: tuple[call_arguments.PassedArgument, ...]
) -> tuple[call_arguments.PassedArgument, ...]:
    """The arguments of a bound function: a placeholder (None) takes the next one that is given."""
    rest = list(args)
    spread = [
        call_arguments.PassedArgument(value) if value is not None else rest.pop(0) if rest else None for value in bound
    ]
    return (
        *(
            a if a is not None else call_arguments.PassedArgument(Opaque("an argument that is given from outside"))
            for a in spread
        ),
        *rest,
    )


def bind(
    walk: Walk, frame: Frame, inner: Frame, function: Function, args: tuple[call_arguments.PassedArgument, ...]
) -> None:
    """Declare the parameters of *function* in *inner*: references are the caller's cells, the rest are copies."""
    positional = [argument for argument in args if not argument.keyword]
    named = {argument.keyword: argument for argument in args if argument.keyword}
    for number, parameter in enumerate(function.parameters):
        kind = walk.type_in(parameter.type, inner)
        if parameter.name.startswith("*"):
            value: Value = _collected(walk, frame, function, parameter.name, positional, named)
            inner.declare(parameter.name.lstrip("*"), Cell(value))
            positional = []
            continue
        argument = positional.pop(0) if positional else named.get(parameter.name)
        if argument is None and ("*" in named or "**" in named):
            argument = named.get("*", named.get("**"))
        if argument is None:
            default = parameter.default or _declared_default(walk, function, number)
            if default is not None:
                value = _default(walk, inner, function, parameter.name, default)
                if inner.source.separator != ".":
                    value = conversions.in_braces(value, kind)
                value = conversions.converted(value, kind)
            else:
                value = walk.opaque("an argument that is given from outside", inner, function.line, kind)
            inner.declare(parameter.name, Cell(value, kind if kind.name else None))
            continue
        if "&" in kind.marks and argument.cell is not None and not kind.marks.rstrip("&").endswith("c"):
            inner.declare(parameter.name, copies.referred(walk, argument.cell, kind))
            continue
        value = argument.value
        if inner.source.separator != ".":
            value = conversions.in_braces(value, kind)
        is_open = parameter.type.name in ("", "auto") or parameter.type.name in function.templates
        if isinstance(value, (Sequence, Mapped)) or argument.cell is not None or argument.is_lent:
            value = copies.passed(walk, inner, value, kind, argument, is_open)
        if kind.name and isinstance(value, Known) and issubclass(value.kind, str) and not is_smart_pointer(kind):
            owner = walk.class_of(kind.name, inner.source) if kind.name not in STRINGS else None
            if owner is not None:
                value = construct.create(walk, inner, kind.bare(), (argument,), Location(inner.source.path))
        if kind.name:
            value = converting.converted(walk, inner, value, kind, Location(inner.source.path, function.line))
            value = conversions.converted(value, kind)
        declared = kind if kind.name and kind.name != "auto" and kind.name not in inner.templates else argument.type
        if is_open and isinstance(value, Object):  # it may be a pointer
            declared = argument.cell.type if argument.cell is not None else None
        inner.declare(parameter.name, Cell(value, declared))


def _collected(
    walk: Walk,
    frame: Frame,
    function: Function,
    name: str,
    positional: list[call_arguments.PassedArgument],
    named: Mapping[str, call_arguments.PassedArgument],
) -> Value:
    """What ``*name`` or ``**name`` holds: the arguments that no other parameter takes, if all of them are known."""
    if not name.startswith("**"):
        if "*" in named:
            return Sequence(Cell(walk.opaque(call_arguments.UNPACKED, frame)))
        return Sequence(Cell(tuple(Cell(argument.value) for argument in positional)))
    if "*" in named or "**" in named:
        return Mapped(Cell(walk.opaque("keyword arguments", frame)))
    taken = {parameter.name for parameter in function.parameters}
    return Mapped(Cell({key: Cell(argument.value) for key, argument in named.items() if key not in taken}))


def _default(walk: Walk, inner: Frame, function: Function, name: str, default: Expression) -> Value:
    """The value of a default argument: in Python as the function was made, in a class with the names of the class."""
    if inner.source.separator == ".":
        kept = inner.outer.scopes[-1].get(f"{name}=") if inner.outer is not None else None
        owner = walk.class_of(function.owner, inner.source) if function.owner else None
        if kept is None and owner is not None and type(default) is syntax.Name:
            kept = members.static_cell(walk, *owner, default.name)
        if kept is not None:
            return kept.value
        if isinstance(default, (syntax.ListLiteral, syntax.DictLiteral)) and not walk.quiet:  # one for all calls
            key = (inner.source.path, f"{function.name}:{function.line}:{name}=")
            if key not in walk.statics:
                walk.statics[key] = Cell(expressions.evaluate(walk, inner, default))
            return walk.statics[key].value
    return expressions.evaluate(walk, inner, default)


def _declared_default(walk: Walk, function: Function, number: int) -> Expression | None:
    """A default argument that stands at the function's declaration, and not at its definition."""
    found = None
    declarations = [*walk.index.functions.get(function.name, ())]
    if function.owner and function.owner not in walk.index.classes:  # defined under a using-directive
        tail = "::".join(function.name.split("::")[-2:])
        declarations += [
            definition
            for definition in walk.index.by_tail.get(tail, ())
            if definition[1].name.endswith(f"::{function.name}")
        ]
    for _, declared in declarations:
        if declared is not function and len(declared.parameters) == len(function.parameters):
            default = declared.parameters[number].default
            if default is not None:
                if found is not None and found != default:
                    return syntax.Unknown(EITHER)
                found = default
    return found


def follow_body(walk: Walk, inner: Frame, function: Function) -> Value:
    """Execute a function's body in its frame and join what all its ways out return and leave behind."""

    trace = walk.index.trace
    if trace is not None:
        trace.bodies.add((inner.source.path, function.name))
    walk.enter(function, thrown.depth(walk))
    mark = inner.mark
    path = inner.source.path
    inner.is_start = walk.judged == len(walk.active) - 1
    loops, walk.loops = walk.loops, []
    try:
        with guarded.under(walk, path, function.guards):
            ended = statements.execute(walk, inner, function.body or ())
    except RecursionError:
        if not walk.quiet:
            walk.gaps.setdefault(TOO_DEEP, Location(path, function.line))
        return walk.opaque(TOO_DEEP, inner, function.line)
    finally:
        walk.loops = loops
        walk.active.pop()
        walk.entered.pop()
    walk.is_raised = walk.is_raised or (ended == RAISED and not inner.exits)
    if inner.exits:
        branches = list(inner.exits)
        if ended == NEXT and not inner.is_dead:
            branches.append(walk.state.since(mark))
        walk.state.undo(mark)
        walk.state.merge(branches)
    if not inner.returned:
        return NONE if ended == NEXT else walk.opaque("it does not return as things are", inner, function.line)
    value = inner.returned[0]
    for other in inner.returned[1:]:
        value = join(value, other)
    return value
