# SPDX-License-Identifier: Apache-2.0
"""Programs of commands that click or Typer makes of functions: which commands there are, and how one of them runs.

A group runs before the command in it that the command line names (click.palletsprojects.com, typer.tiangolo.com). Each command is a way that the
program may run: what it makes stands under the condition ``command`` with its name.
"""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Sequence
from functools import partial

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, calls, expressions, python_names
from haros_ci.follow.command import Command
from haros_ci.follow.command_contexts import CONTEXT, DEEP, PASSING, UNKNOWN, context_of, of_class, passed
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import argparse, argparse_words, python_modules
from haros_ci.follow.walk import Walk
from haros_ci.graph.words import PART
from haros_ci.index.index import Source
from haros_ci.index.mentions import GROUPING, MODULES, grouped
from haros_ci.model.architecture import Condition
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.syntax import Expression, Function
from haros_ci.values.abstract import NONE, Callable, Cell, Known, Library, Object, Value

#: Classes whose objects are groups without a function.
TYPER = "typer.Typer"
GROUPS = frozenset(("click.Group", "rich_click.Group", TYPER))
#: The kinds of values that may be one.
KINDS = frozenset((Callable, Object))
#: Commands of one group.
MOST = 200
FUNCTIONS = GROUPS | {PASSING, "click.get_current_context", "typer.run"}


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """A command that may be run: its name, below those of the commands around it, where it stands, and how it runs."""

    names: tuple[str, ...]
    location: Location
    run: Function_[[], object]


def either(walk: Walk, ways: Sequence[Way], taken: str | None) -> None:
    """One of the *ways* is gone, each under the condition of its command; where the command line names one (*taken*), the others are ruled out."""
    mark = walk.state.mark()
    branches = []
    for way in ways:
        can_be = taken is None or way.names[0] == taken
        walk.conditions += [Condition("command", name, way.location) for name in way.names]
        walk.dead += not can_be
        try:
            way.run()
        finally:
            walk.dead -= not can_be
            del walk.conditions[len(walk.conditions) - len(way.names) :]
        writes = walk.state.undo(mark)
        if can_be:
            branches.append(writes)
    if branches:
        walk.state.merge(branches)


def command(walk: Walk, value: Value) -> Command | None:
    """What the decorators of click or Typer make of a function, or a group that is an object; None if they do not."""
    if isinstance(value, Object):
        return Command("", None, group=id(value), is_typer=value.name == TYPER) if value.name in GROUPS else None
    if not isinstance(value, Callable) or not value.function.decorators or value.source.separator != ".":
        return None
    function = value.function
    key = (function.line, function.name, value.source.path)
    known = walk.commands.known
    if key not in known:
        known[key] = None  # as long as it is looked for
        known[key] = _decorated(walk, value.source, function)
    return known[key]


def _decorated(walk: Walk, source: Source, function: Function) -> Command | None:
    if function.owner:
        return None
    for decorator in function.decorators:
        callee = decorator.callee if type(decorator) is syntax.Call else decorator
        word = syntax.name_of(callee)
        if word not in GROUPING:
            continue
        arguments = decorator.arguments if type(decorator) is syntax.Call else ()
        own = Callable(source, function)
        group = id(function) if word == "group" else None
        owner = _owner(walk, source, callee)
        if owner is None or (owner == 0 and word not in ("command", "group")):
            continue
        return Command(_name(function, arguments), own, owner or None, word == "callback", group)
    return None


def _owner(walk: Walk, source: Source, callee: Expression) -> int | None:
    """The group that ``group.command`` adds to, by identity; 0 for click's own ``command``, None for anything else."""
    frame = python_names.module_frame(walk, source)
    if type(callee) is syntax.Name:
        value: Value = expressions.evaluate(walk, frame, callee)
        return 0 if isinstance(value, Library) and value.name.partition(".")[0] in MODULES else None
    if type(callee) is not syntax.Member or not syntax.dotted(callee.object):
        return None
    value = expressions.evaluate(walk, frame, callee.object)
    if isinstance(value, Library):
        return 0 if value.name.partition(".")[0] in MODULES else None
    found = command(walk, value)
    return found.group if found is not None else None


def _name(function: Function, arguments: tuple[Expression, ...]) -> str:
    """The name of a command: the first argument, or that of the function with ``-`` for ``_``."""
    for argument in arguments:
        if type(argument) is syntax.Keyword and argument.name == "name":
            argument = argument.value
        if type(argument) is syntax.String:
            return argument.value
        break
    return function.name.rpartition(".")[2].lower().replace("_", "-")


def run(walk: Walk, frame: Frame, value: Value, args: tuple[call_arguments.PassedArgument, ...] = ()) -> Value | None:
    """A program of commands is started by calling one of them, or what argparse has for one of several; None if *value* is none."""
    if isinstance(value, Object) and value.name == argparse.CHOSEN:
        return _chosen(walk, frame, value, args)
    found = command(walk, value)
    if found is None:
        return None
    given = next((argument.value for argument in args if argument.keyword == "obj"), NONE)
    words = () if PART in "".join(walk.context.arguments or ()) else walk.context.arguments
    _run(walk, frame, found, context_of(NONE, given), tuple(words or ()))
    return walk.opaque("what a command returns is not known", frame)


def begin(walk: Walk, frame: Frame, function: Callable) -> None:
    """A program begins with a call of *function*, which may be a command."""
    if run(walk, frame, function) is None:
        activation.invoke(walk, frame, function, ())


def _chosen(walk: Walk, frame: Frame, value: Object, args: tuple[call_arguments.PassedArgument, ...]) -> Value:
    """The function that the command of argparse has set which the command line names."""
    ways = []
    for cell in value.fields.values():
        assert isinstance(cell.value, Object)
        names, called = cell.value.fields[argparse_words.NAMES].value, cell.value.fields[argparse.FUNCTION].value
        assert isinstance(called, Callable) and isinstance(names, Known)
        place = Location(called.source.path, called.function.line, called.function.column)
        ways.append(Way(tuple(names.of(list)), place, partial(activation.invoke, walk, frame, called, args)))
    either(walk, ways, None)
    return walk.opaque("what a command returns is not known", frame)


def start(name: str, source: Source, walk: Walk, _: Frame) -> None:
    """A program is started by calling what *name* means in a module: a group of commands, a function that it imports or computes, ``Class.method``."""
    first, *rest = name.split(".")
    called: Expression = syntax.Name(first)
    for part in rest:
        called = syntax.Member(called, part)
    expressions.evaluate(walk, python_names.module_frame(walk, source), syntax.Call(called, (), (), 1, 1))


def _run(walk: Walk, frame: Frame, found: Command, context: Object, words: tuple[str, ...], depth: int = 0) -> None:
    """A command runs, or a group with one of its commands, which the first of the *words* names where it is the name of one."""
    every = _commands(walk, found.group) if found.group is not None and depth < DEEP else []
    for item in (found, *every):
        if item.function is not None and (item is found or item.is_callback):
            _callback(walk, frame, item.function, context)
    inside = [item for item in every if not item.is_callback]
    if found.is_typer and len(every) == len(inside) == 1 and inside[0].function is not None:
        _run(walk, frame, inside[0], context, words, depth + 1)
    elif inside:
        _one_of(walk, frame, inside, context, words, depth + 1)


def _one_of(
    walk: Walk, frame: Frame, commands: list[Command], context: Object, words: tuple[str, ...], depth: int
) -> None:
    taken = next((item.name for item in commands if words[:1] == (item.name,)), None)
    rest = words[1:] if taken else ()
    either(walk, [_way(walk, frame, item, context, rest, depth) for item in commands], taken)


def _way(walk: Walk, frame: Frame, found: Command, around: Object, words: tuple[str, ...], depth: int) -> Way:
    """A command of a group as one that may run."""
    context = context_of(around, around.fields["obj"].value)
    source, function = (found.function.source, found.function.function) if found.function else (frame.source, None)
    place = Location(source.path, function.line, function.column) if function is not None else Location(source.path)
    return Way((found.name,), place, partial(_run, walk, frame, found, context, words, depth))


def _callback(
    walk: Walk,
    frame: Frame,
    function: Callable,
    context: Object,
    more: tuple[call_arguments.PassedArgument, ...] = (),
) -> Value:
    """The function of a command is called: with what its decorators pass, and options that are not known."""
    first = [
        call_arguments.PassedArgument(item)
        for decorator in reversed(function.function.decorators)
        for item in passed(walk, frame, function.source, decorator, context)
    ]
    named = {argument.keyword: argument for argument in more if argument.keyword}
    inner = Frame(function.source, "")
    for parameter in function.function.parameters[len(first) :]:
        if parameter.name.startswith("*") or parameter.name in named:
            continue
        kind = walk.type_in(parameter.type, inner)
        is_context = kind.name.rpartition(".")[2] == "Context"
        value: Value = context if is_context else walk.opaque(UNKNOWN, inner, function.function.line, kind)
        named[parameter.name] = call_arguments.PassedArgument(value, keyword=parameter.name)
    before = walk.commands.context
    walk.commands.context = context
    try:
        return activation.invoke(walk, frame, function, (*first, *named.values()))
    finally:
        walk.commands.context = before


def _commands(walk: Walk, group: int, depth: int = 0) -> list[Command]:
    """The commands of a group, by name: those of modules that the program has imported, and those that are added to it."""
    found: dict[str, Command] = {}
    for source in _imported(walk):
        for function in source.program.functions:
            item = command(walk, Callable(source, function)) if function.decorators else None
            if item is not None and item.within == group:
                found[f"{item.name} {source.path}"] = item
    for item in walk.commands.added.get(group, ()):
        inside = _commands(walk, item.group, depth + 1) if not item.name and item.group and depth < DEEP else [item]
        found |= {f"{one.name} +": one for one in inside}
    return [item for _, item in sorted(found.items())][:MOST]


def _imported(walk: Walk) -> list[Source]:
    """The modules that are imported by the time a command runs, the bodies followed of those that have commands."""
    loaded = [frame.source for frame in walk.modules.values()]
    paths = python_modules.imported(walk, loaded)
    if walk.index.trace is not None:
        walk.index.trace.paths |= paths
    every = {source.path: source for source in (*walk.index.by_place.values(), *loaded)}
    found = [every[path] for path in sorted(paths) if path in every and grouped(every[path].program)]
    for source in found:
        python_names.module_frame(walk, source)
    return found


def method(
    walk: Walk, frame: Frame, receiver: Value, name: str, args: tuple[call_arguments.PassedArgument, ...]
) -> Value | None:
    """A method of a command, a group or a context; None if it is of something else."""
    if isinstance(receiver, Object) and receiver.name == CONTEXT:
        return _of_context(walk, frame, receiver, name, args)
    if name == "main":
        return run(walk, frame, receiver, args)
    if name not in ("add_command", "add_typer") or not args:
        return None
    found, added = command(walk, receiver), command(walk, args[0].value)
    if found is None or found.group is None or added is None:
        return None
    named = next((a.value for a in args[1:] if a.keyword in ("", "name")), NONE)
    other = named.of(str) if isinstance(named, Known) and issubclass(named.kind, str) else added.name
    item = Command(other, added.function, found.group, False, added.group)
    walk.commands.added[found.group] = (*walk.commands.added.get(found.group, ()), item)[:MOST]
    return NONE


def _of_context(
    walk: Walk, frame: Frame, context: Object, name: str, args: tuple[call_arguments.PassedArgument, ...]
) -> Value | None:
    if name == "find_root":
        return context
    if name in ("ensure_object", "find_object") and args:
        held = context.fields["obj"].value
        if name == "find_object" or held != NONE:
            return of_class(walk, frame, context, args[0].value, False)
        made = calls.apply(walk, frame, args[0].value, (), (), Location(frame.source.path), syntax.Name("object"))
        walk.state.write(context.fields["obj"], made)
        return made
    if name in ("invoke", "forward") and args:
        found = command(walk, args[0].value)
        if found is not None and found.function is not None:
            return _callback(walk, frame, found.function, context, args[1:])
        location = Location(frame.source.path)
        return calls.apply(walk, frame, args[0].value, args[1:], (), location, syntax.Name(name))
    return None


def function(walk: Walk, frame: Frame, name: str, args: tuple[call_arguments.PassedArgument, ...]) -> Value | None:
    """A function or class of click or Typer."""
    if name == PASSING and args:
        ensure = next((argument.value for argument in args[1:] if argument.keyword in ("", "ensure")), NONE)
        return Object(PASSING, fields={"of": Cell(args[0].value), "ensure": Cell(ensure)})
    if name in GROUPS:
        return Object(name)
    if name == "click.get_current_context":
        return walk.commands.context
    if name == "typer.run" and args and isinstance(args[0].value, Callable):
        return _callback(walk, frame, args[0].value, context_of(NONE, NONE))
    return None
