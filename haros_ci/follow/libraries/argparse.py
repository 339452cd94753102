# SPDX-License-Identifier: Apache-2.0
"""Python's argparse: what a program's options are when a launch file gives its words (docs.python.org, argparse).

The words are read by argparse itself, from a parser with the same options; nothing of the workspace is executed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NoReturn

from haros_ci.follow import comprehensions, slices
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    Elements,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Sequence,
    Value,
    data_of,
)

if TYPE_CHECKING:
    from argparse import ArgumentParser, _SubParsersAction

    from haros_ci.follow.call_arguments import PassedArgument

PARSER, COMMANDS = "argparse.ArgumentParser", "argparse._SubParsersAction"
#: The member of a parser that holds its options, and what they are kept as.
DECLARED, OPTION = "[options]", "[option]"
#: Members of a parser that hold its defaults, and its names as a command; of options why they are not known.
DEFAULTS, NAMES, UNREAD = "[defaults]", "[names]", "[unread]"
#: What one of several commands calls, and the member that has its function.
CHOSEN, FUNCTION = "[chosen]", "[function]"
#: Why options are not known.
UNKNOWN = "the command line is not known"
#: Arguments of a parser that do not change what words mean.
PLAIN = frozenset(("", "prog", "usage", "description", "epilog", "formatter_class", "add_help"))
GROUPS = frozenset(("add_argument_group", "add_mutually_exclusive_group"))
#: Arguments of ``add_subparsers`` that change nothing of how words are read but the name of their result.
OF_COMMANDS = frozenset(("title", "dest", "required", "help", "description", "metavar", "prog"))
ACTIONS = frozenset(("store", "store_true", "store_false", "store_const", "append", "count"))
TYPES: dict[str, type[int | float | str]] = {"int": int, "float": float, "str": str}
#: Words on one command line, options of one parser, and positional ones of these that take a number of words that is not
#: fixed, and commands in commands: argparse matches with expressions that try each way to share the words among them.
MOST, OPEN, DEEP = 64, 3, 4


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
    found = _parsed(this, args, is_partly) if args or not is_partly else _launched(walk, frame, this)
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
    for key, cell in _defaults(this).items():
        ways = found.setdefault(key, []) if isinstance(cell.value, Callable) else None
        if ways is not None and len(ways) < MOST:
            ways.append(Cell(Object(CHOSEN, fields={NAMES: Cell(Known(list(names))), FUNCTION: cell})))
    for option in _elements(this) if depth < DEEP else ():
        for command in _elements(option) if option.name == COMMANDS else ():
            called = _names(command)
            _functions(command, (*names, called[0] if called else "?"), found, depth + 1)


def _elements(this: Object) -> list[Object]:
    """The options of a parser, or the parsers of its commands, as far as they are known."""
    held = this.fields[DECLARED].value if DECLARED in this.fields else None
    cells = held.content.value if isinstance(held, Sequence) else ()
    return [cell.value for cell in cells if isinstance(cell.value, Object)] if isinstance(cells, tuple) else []


def _defaults(this: Object) -> dict[str, Cell]:
    held = this.fields[DEFAULTS].value
    pairs = held.content.value if isinstance(held, Mapped) else None
    return {str(key): cell for key, cell in pairs.items()} if isinstance(pairs, dict) else {}


def _names(this: Object) -> list[str]:
    """The name of a command's parser and its other names; empty if they are not known."""
    held = this.fields[NAMES].value
    return [str(item) for item in held.of(list)] if isinstance(held, Known) else []


def _parsed(this: Object, args: tuple[PassedArgument, ...], is_partly: bool) -> Value | None:
    """The options as an object; None if the words, or what they mean, are not known.

    Without words they are ``sys.argv``, to which roslaunch adds some that no program declares.
    """
    is_given = len(args) == 1 and args[0].keyword in ("", "args")
    items = _words(args[0].value) if is_given else None
    if items is None or len(items) > MOST:
        return None
    words = [item.of(str) for item in items if isinstance(item, Known) and issubclass(item.kind, str)]
    if len(words) < len(items):
        return None
    try:
        space, rest, kept = _read(this, words)
    except (ValueError, TypeError, KeyError, IndexError, AttributeError):
        return None
    if rest and not is_partly:
        return None
    made = Object("argparse.Namespace", fields={key: Cell(_value(data, kept)) for key, data in space.items()})
    if not is_partly:
        return made
    return Sequence(Cell((Cell(made), Cell(_value(rest, kept)))))


def _launched(walk: Walk, frame: Frame, this: Object) -> Value | None:
    """``parse_known_args()`` of a program that a launch file starts: what launch adds to its words is left over. None if that is not certain."""
    try:
        read = [_read(this, words) for words in walk.context.lines()]
    except (ValueError, TypeError, KeyError, IndexError, AttributeError):
        return None
    known = [{key: data for key, data in space.items() if id(data) not in kept} for space, _, kept in read]
    if not read or known != known[:1] * len(known):
        return None
    space, _, kept = read[0]
    made = Object("argparse.Namespace", fields={key: Cell(_value(data, kept)) for key, data in space.items()})
    return Sequence(Cell((Cell(made), Cell(walk.opaque("the words that are left over are not known", frame)))))


def _words(value: Value) -> list[Value] | None:
    content = value.content.value if isinstance(value, Sequence) else None
    if isinstance(content, Opaque) and content.reason == slices.NOTHING:
        return []
    return comprehensions.items(value)


def _read(this: Object, words: list[str]) -> tuple[dict[str, object], list[str], dict[int, Value]]:
    """What argparse makes of *words*: values by name, words left over, and defaults that are not data by their stand-in."""
    import argparse

    class Reader(argparse.ArgumentParser):
        def error(self, message: str) -> NoReturn:
            raise ValueError(message)

    reader = Reader(add_help=False, conflict_handler="resolve")
    kept: dict[int, Value] = {}
    _fill(reader, this, kept, [MOST, OPEN], 0)
    space, rest = reader.parse_known_args(words)
    for key, data in list(vars(space).items()):
        if id(data) not in kept and not isinstance(data, (str, int, float, bool, list, type(None))):
            raise ValueError(f"{key} is no data")
    return vars(space), rest, kept


def _fill(reader: ArgumentParser, this: Object, kept: dict[int, Value], left: list[int], depth: int) -> None:
    """Give *reader* the options, commands and defaults of a parser; *left* are how many options it may still have, and of them open ones."""
    held = this.fields[DECLARED].value
    if not isinstance(held, Sequence) or not isinstance(held.content.value, tuple) or depth > DEEP:
        raise ValueError("the options are not known")
    for option in _elements(this):
        if option.name == COMMANDS:
            asked = {key: _data(option.fields[key].value) for key in ("dest", "required") if key in option.fields}
            commands: _SubParsersAction[ArgumentParser]
            commands = reader.add_subparsers(**asked)  # type: ignore[call-overload]  # argparse looks at them itself
            for command in _elements(option):
                name, *others = _names(command)
                inner = commands.add_parser(name, aliases=others, add_help=False, conflict_handler="resolve")
                _fill(inner, command, kept, left, depth + 1)
        else:
            _declare(reader, option.fields, kept, left)
    reader.set_defaults(**{key: _kept(cell.value, kept) for key, cell in _defaults(this).items()})


def _declare(reader: ArgumentParser, members: Mapping[str, Cell], kept: dict[int, Value], left: list[int]) -> None:
    """Give *reader* an option, as *members* have it."""
    provided = {key: member.value for key, member in members.items() if not key.isdigit()}
    flags = [_text(members[key].value) for key in members if key.isdigit()]
    action = _data(provided["action"]) if "action" in provided else "store"
    if action in ("help", "version"):
        return
    if action not in ACTIONS:
        raise ValueError("an action of its own")
    requested: dict[str, Any] = {"action": action}
    requested |= {key: _data(provided[key]) for key in ("dest", "nargs", "const", "required") if key in provided}
    _count(requested.get("nargs"), flags, left)
    if "type" in provided:
        kind = provided["type"]
        requested["type"] = TYPES[kind.name if isinstance(kind, Library) else ""]
    if "default" in provided:
        requested["default"] = _kept(provided["default"], kept)
    reader.add_argument(*flags, **requested)


def _count(count: object, flags: list[str], left: list[int]) -> None:
    """Count an option that takes *count* words, which are bounded."""
    if isinstance(count, int) and not 0 < count <= MOST:
        raise ValueError("a number of words that no command line has")
    left[0] -= 1
    left[1] -= isinstance(count, str) and not flags[0].startswith("-")
    if min(left) < 0:
        raise ValueError("too many options, or ways to share the words")


def _kept(value: Value, kept: dict[int, Value]) -> object:
    """A default as data, or what stands for it among those that are *kept*."""
    known, data = data_of(value)
    if not known:
        data = object()
        kept[id(data)] = value
    return data


def _data(value: Value) -> object:
    known, data = data_of(value)
    if not known:
        raise ValueError("not known")
    return data


def _text(value: Value) -> str:
    data = _data(value)
    if not isinstance(data, str):
        raise ValueError("not a text")
    return data


def _value(data: object, kept: dict[int, Value]) -> Value:
    if id(data) in kept:
        return kept[id(data)]
    if isinstance(data, list):
        return Sequence(Cell(tuple(Cell(_value(item, kept)) for item in data)))
    return Known(data)
