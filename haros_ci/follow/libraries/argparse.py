# SPDX-License-Identifier: Apache-2.0
"""Python's argparse: what a program's options are when a launch file gives its words (docs.python.org, argparse).

The words are read by argparse itself, from a parser with the same options; nothing of the workspace is executed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.follow import comprehensions, slices
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import argparse_words, ros_words
from haros_ci.follow.libraries.argparse_words import COMMANDS, DECLARED, DEEP, DEFAULTS, MOST, NAMES, OPTION, UNREADABLE
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import (
    NONE,
    TRUE,
    Callable,
    Cell,
    Elements,
    Known,
    Mapped,
    Object,
    Opaque,
    Sequence,
    Value,
    data_of,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

PARSER = "argparse.ArgumentParser"
#: A member of options: why they are not known.
UNREAD = "[unread]"
#: What one of several commands calls, and the member that has its function.
CHOSEN, FUNCTION = "[chosen]", "[function]"
#: A member of a parser: that it ends without one of the options of a group.
NEEDED = "[needed]"
#: Why options are not known.
UNKNOWN = "the command line is not known"
#: Arguments of a parser that do not change what words mean.
PLAIN = frozenset(("", "prog", "usage", "description", "epilog", "formatter_class", "add_help"))
GROUPS = frozenset(("add_argument_group", "add_mutually_exclusive_group"))
#: Arguments of ``add_subparsers`` that change nothing of how words are read but the name of their result.
OF_COMMANDS = frozenset(("title", "dest", "required", "help", "description", "metavar", "prog"))


def parser(args: tuple[PassedArgument, ...]) -> Object:
    """What ``argparse.ArgumentParser(...)`` makes; its options are not known if words are read in another way."""
    is_plain = all(argument.keyword in PLAIN for argument in args)
    options: Elements = () if is_plain else Opaque("the parser has rules of its own")
    made: dict[str, Cell] = {
        DECLARED: Cell(Sequence(Cell(options))),
        DEFAULTS: Cell(Mapped(Cell({}))),
        NAMES: Cell(Known([])),
    }
    return Object(PARSER, fields=made)


def method(walk: Walk, frame: Frame, this: Object, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method of a parser: options are declared, the command line is read; anything else makes the options unknown."""
    declared = this.fields[DECLARED].value
    assert isinstance(declared, Sequence)
    if name in GROUPS:
        if any(argument.keyword == "required" and argument.value != Known(False) for argument in args):
            this.fields[NEEDED] = Cell(TRUE)
        return this
    if name in ("parse_args", "parse_known_args"):
        return _options(walk, frame, this, args, name == "parse_known_args")
    done = _set(walk, this, args) if name == "set_defaults" else _declared(walk, declared, name, args)
    if done is None and name not in ("print_help", "print_usage", "format_help", "error", "exit"):
        walk.state.write(declared.content, Opaque(f"{name} may add options"))
    return done


def _set(walk: Walk, this: Object, args: tuple[PassedArgument, ...]) -> Value | None:
    """``set_defaults`` with keywords."""
    defaults = this.fields[DEFAULTS].value
    pairs = defaults.content.value if isinstance(defaults, Mapped) else None
    if not isinstance(pairs, dict) or not all(argument.keyword.isidentifier() for argument in args):
        return None
    assert isinstance(defaults, Mapped)
    walk.state.write(defaults.content, {**pairs, **{argument.keyword: Cell(argument.value) for argument in args}})
    return NONE


def _declared(walk: Walk, declared: Sequence, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """``add_argument``, and ``add_subparsers``, which gives what the parsers of commands are added to."""
    options = declared.content.value
    if not isinstance(options, tuple) or len(options) >= MOST:
        return None
    if name == "add_subparsers" and all(argument.keyword in OF_COMMANDS for argument in args):
        fields: dict[str, Cell] = {DECLARED: Cell(Sequence(Cell(())))}
        fields |= {a.keyword: Cell(a.value) for a in args if a.keyword in ("dest", "required")}
        made = Object(COMMANDS, fields=fields)
    elif name == "add_argument":
        members = {str(n): Cell(a.value) for n, a in enumerate(a for a in args if not a.keyword)}
        members |= {a.keyword: Cell(a.value) for a in args if a.keyword}
        made = Object(OPTION, fields=members)
    else:
        return None
    option: Cell = Cell(made)
    walk.state.write(declared.content, (*options, option))
    return made if name == "add_subparsers" else Opaque("an option")


def _options(walk: Walk, frame: Frame, this: Object, args: tuple[PassedArgument, ...], is_partly: bool) -> Value:
    """What ``parse_args`` gives, and with it what is left over if *is_partly*."""
    is_given = len(args) == 1 and args[0].keyword in ("", "args")
    is_own = not args or (is_given and args[0].value == NONE)  # then it reads sys.argv
    own = walk.context.own_words() if is_own else ros_words.launched(_words(args[0].value)) if is_given else None
    items = walk.context.words_by_hand() if is_own else _words(args[0].value) if is_given else None
    if own is not None:
        found = _launched(walk, frame, this, own, is_partly)
    elif not walk.context.is_launched and items == [] and _has_commands(this):
        found = _of_any_command(walk, frame, this)
    else:
        found = _parsed(walk, frame, this, items, is_partly)
    if found is not None:
        return found
    options = _unread(walk, frame, this)
    return Sequence(Cell((Cell(options), Cell(walk.opaque(UNKNOWN, frame))))) if is_partly else options


def added(walk: Walk, this: Object, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """``add_parser`` of what ``add_subparsers`` gives: the parser of a command."""
    held = this.fields[DECLARED].value
    assert isinstance(held, Sequence)
    parsers = held.content.value
    if name != "add_parser" or not isinstance(parsers, tuple) or len(parsers) >= MOST:
        return None
    made = parser(tuple(argument for argument in args[1:] if argument.keyword not in ("help", "aliases")))
    made.fields[NAMES] = Cell(_called(args))
    one: Cell = Cell(made)
    walk.state.write(held.content, (*parsers, one))
    return made


def _called(args: tuple[PassedArgument, ...]) -> Value:
    """The names of a command that ``add_parser`` is given."""
    names = [argument.value for argument in args[:1] if not argument.keyword]
    for argument in args:
        if argument.keyword == "aliases":
            names += comprehensions.items(argument.value) or [Opaque("another name")]
    known = [item.of(str) for item in names if isinstance(item, Known) and issubclass(item.kind, str)]
    return Known(known) if known and len(known) == len(names) else Opaque("the name of a command")


def _unread(walk: Walk, frame: Frame, this: Object) -> Object:
    """The options where the command line is not known: functions that commands set among them (``set_defaults(func=...)``) are."""
    found: dict[str, list[Cell]] = {}
    _functions(this, (), found, 0)
    fields: dict[str, Cell] = {UNREAD: Cell(walk.opaque(UNKNOWN, frame))}
    for key, ways in found.items():
        fields[key] = Cell(Object(CHOSEN, fields={str(number): cell for number, cell in enumerate(ways)}))
    return Object("argparse.Namespace", fields=fields)


def _functions(this: Object, names: tuple[str, ...], found: dict[str, list[Cell]], depth: int) -> None:
    """Collect the functions among the defaults of a parser and those of its commands, with the names of these."""
    for key, cell in argparse_words.defaults(this).items():
        ways = found.setdefault(key, []) if isinstance(cell.value, Callable) else None
        if ways is not None and len(ways) < MOST:
            ways.append(Cell(Object(CHOSEN, fields={NAMES: Cell(Known(list(names))), FUNCTION: cell})))
    for option in argparse_words.elements(this) if depth < DEEP else ():
        for command in argparse_words.elements(option) if option.name == COMMANDS else ():
            called = argparse_words.names(command)
            _functions(command, (*names, called[0] if called else "?"), found, depth + 1)


def _has_commands(this: Object) -> bool:
    return any(option.name == COMMANDS for option in argparse_words.elements(this))


def _of_any_command(walk: Walk, frame: Frame, this: Object) -> Object:
    """The options of a program that is given one of its commands and nothing else: those of the commands are not known, its own have their defaults."""
    options, every = _unread(walk, frame, this), argparse_words.elements(this)
    own: Elements = tuple(Cell(option) for option in every if option.name != COMMANDS)
    try:
        space, _, kept = argparse_words.read(
            Object(PARSER, fields={**this.fields, DECLARED: Cell(Sequence(Cell(own)))}), []
        )
    except (argparse_words.Ended, *UNREADABLE):
        return options
    others = {name for option in every if option.name == COMMANDS for name in _declared_inside(option, 0)}
    for key, data in space.items():
        if key not in others:
            options.fields.setdefault(key, Cell(argparse_words.value_of(data, kept)))
    return options


def _declared_inside(commands: Object, depth: int) -> Iterator[str]:
    """The names that the options of commands, and of those below, may have in the result."""
    for command in argparse_words.elements(commands) if depth < DEEP else ():
        yield from argparse_words.defaults(command)
        for option in argparse_words.elements(command):
            if option.name == COMMANDS:
                yield from _declared_inside(option, depth + 1)
            for cell in option.fields.values():
                if isinstance(cell.value, Known) and issubclass(cell.value.kind, str):
                    yield cell.value.of(str).lstrip("-").replace("-", "_")


def _parsed(walk: Walk, frame: Frame, this: Object, items: list[Value] | None, is_partly: bool) -> Value | None:
    """The options as an object where *items* are the words; None if these, or what they mean, are not known.

    Lists that nothing fills are not known of a program that nothing starts: who starts it gives what they are for.
    """
    is_by_hand = items == [] and not walk.context.is_launched
    if items is None or len(items) > MOST or (is_by_hand and NEEDED in this.fields):
        return None
    words = [item.of(str) for item in items if isinstance(item, Known) and issubclass(item.kind, str)]
    if len(words) < len(items):
        return None
    try:
        space, rest, kept = argparse_words.read(this, words)
    except (argparse_words.Ended, *UNREADABLE):
        return None
    if rest and not is_partly:
        return None
    fields = {key: Cell(argparse_words.value_of(data, kept)) for key, data in space.items()}
    for key in argparse_words.lists(this) if is_by_hand else ():
        if not space.get(key):
            fields[key] = Cell(walk.opaque(UNKNOWN, frame))
    made = Object("argparse.Namespace", fields=fields)
    if not is_partly:
        return made
    return Sequence(Cell((Cell(made), Cell(argparse_words.value_of(rest, kept)))))


def _launched(walk: Walk, frame: Frame, this: Object, words: list[str], is_partly: bool) -> Value | None:
    """The options of a program that a launch file starts with these words and some that are added: what they are with all that it is not ended by.

    None if it is ended by all of them, or is without them, or if that is not known. What is not the same with all is not known.
    """
    read: list[tuple[dict[str, object], dict[int, Value]]] = []
    for more in walk.context.added():
        try:
            space, rest, kept = argparse_words.read(this, [*words, *more])
        except UNREADABLE:
            return None
        except argparse_words.Ended:
            rest, is_ended = [], True
        else:
            is_ended = bool(rest) and not is_partly
        if not is_ended:
            read.append((space, kept))
        elif not more:
            return None
    if len(read) < 2 or len(words) > MOST:
        return None
    fields = {
        key: Cell(_alike([argparse_words.value_of(space[key], kept) for space, kept in read], walk, frame))
        for key in read[0][0]
    }
    made = Object("argparse.Namespace", fields=fields)
    left = walk.opaque("the words that are left over are not known", frame)
    return Sequence(Cell((Cell(made), Cell(left)))) if is_partly else made


def _alike(values: list[Value], walk: Walk, frame: Frame) -> Value:
    """The one value that all of *values* are."""
    first, *others = values
    known = data_of(first)
    if known[0]:
        is_same = all(data_of(other) == known for other in others)
    else:
        is_same = all(other is first for other in others)
    return first if is_same else walk.opaque(UNKNOWN, frame)


def _words(value: Value) -> list[Value] | None:
    content = value.content.value if isinstance(value, Sequence) else None
    if isinstance(content, Opaque) and content.reason == slices.NOTHING:
        return []
    return comprehensions.items(value)
