# SPDX-License-Identifier: Apache-2.0
"""What argparse makes of the words of a command line, of a parser with the options that a program declares."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NoReturn

from haros_ci.values.abstract import Cell, Known, Library, Mapped, Object, Sequence, Value, data_of

if TYPE_CHECKING:
    from argparse import ArgumentParser, _SubParsersAction

COMMANDS = "argparse._SubParsersAction"
#: The member of a parser that holds its options, and what they are kept as.
DECLARED, OPTION = "[options]", "[option]"
#: Members of a parser that hold its defaults, and its names as a command.
DEFAULTS, NAMES = "[defaults]", "[names]"
ACTIONS = frozenset(("store", "store_true", "store_false", "store_const", "append", "count"))
#: What is raised where it is not known what a parser does.
UNREADABLE = (ValueError, TypeError, KeyError, IndexError, AttributeError)
TYPES: dict[str, type[int | float | str]] = {"int": int, "float": float, "str": str}
COUNTS = {
    f"argparse.{name}": sign
    for name, sign in zip(("REMAINDER", "OPTIONAL", "ZERO_OR_MORE", "ONE_OR_MORE"), ("...", *"?*+"), strict=True)
}
#: Words on one command line, options of one parser, and positional ones of these that take a number of words that is not
#: fixed, and commands in commands: argparse matches with expressions that try each way to share the words among them.
MOST, OPEN, DEEP = 64, 3, 4


class Ended(Exception):
    """The program says how it is used, and ends."""


def read(this: Object, words: list[str]) -> tuple[dict[str, object], list[str], dict[int, Value]]:
    """What argparse makes of *words*: values by name, words left over, and defaults that are not data by their stand-in."""
    kept: dict[int, Value] = {}
    space, rest = _reader(this, kept).parse_known_args(words)
    for key, data in list(vars(space).items()):
        if id(data) not in kept and not isinstance(data, (str, int, float, bool, list, type(None))):
            raise ValueError(f"{key} is no data")
    return vars(space), rest, kept


def lists(this: Object) -> frozenset[str]:
    """The names of the options of a parser that are lists of what they are given: of several words, or given several times."""
    import argparse

    several = (argparse._AppendAction,)
    actions = _reader(this, {})._actions
    return frozenset(one.dest for one in actions if isinstance(one, several) or one.nargs not in (None, "?", 0))


def _reader(this: Object, kept: dict[int, Value]) -> ArgumentParser:
    """An argparse parser with the options of a parser; it raises Ended where the program would end."""
    import argparse

    class Reader(argparse.ArgumentParser):
        def error(self, message: str) -> NoReturn:
            raise Ended(message)

    reader = Reader(add_help=False, conflict_handler="resolve")
    _fill(reader, this, kept, [MOST, OPEN], 0)
    return reader


def _fill(reader: ArgumentParser, this: Object, kept: dict[int, Value], left: list[int], depth: int) -> None:
    """Give *reader* the options, commands and defaults of a parser; *left* are how many options it may still have, and of them open ones."""
    held = this.fields[DECLARED].value
    if not isinstance(held, Sequence) or not isinstance(held.content.value, tuple) or depth > DEEP:
        raise ValueError("the options are not known")
    for option in elements(this):
        if option.name == COMMANDS:
            asked = {key: _data(option.fields[key].value) for key in ("dest", "required") if key in option.fields}
            commands: _SubParsersAction[ArgumentParser]
            commands = reader.add_subparsers(**asked)  # type: ignore[call-overload]  # argparse looks at them itself
            for command in elements(option):
                name, *others = names(command)
                inner = commands.add_parser(name, aliases=others, add_help=False, conflict_handler="resolve")
                _fill(inner, command, kept, left, depth + 1)
        else:
            _declare(reader, option.fields, kept, left)
    reader.set_defaults(**{key: _kept(cell.value, kept) for key, cell in defaults(this).items()})


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
    if isinstance(value, Library) and value.name in COUNTS:
        return COUNTS[value.name]
    if not known:
        raise ValueError("not known")
    return data


def _text(value: Value) -> str:
    data = _data(value)
    if not isinstance(data, str):
        raise ValueError("not a text")
    return data


def value_of(data: object, kept: dict[int, Value]) -> Value:
    """What *data* of argparse is as a value; for a stand-in what is *kept* of it."""
    if id(data) in kept:
        return kept[id(data)]
    if isinstance(data, list):
        return Sequence(Cell(tuple(Cell(value_of(item, kept)) for item in data)))
    return Known(data)


def elements(this: Object) -> list[Object]:
    """The options of a parser, or the parsers of its commands, as far as they are known."""
    held = this.fields[DECLARED].value if DECLARED in this.fields else None
    cells = held.content.value if isinstance(held, Sequence) else ()
    return [cell.value for cell in cells if isinstance(cell.value, Object)] if isinstance(cells, tuple) else []


def defaults(this: Object) -> dict[str, Cell]:
    """What ``set_defaults`` has set of a parser, by name."""
    held = this.fields[DEFAULTS].value
    pairs = held.content.value if isinstance(held, Mapped) else None
    return {str(key): cell for key, cell in pairs.items()} if isinstance(pairs, dict) else {}


def names(this: Object) -> list[str]:
    """The name of a command's parser and its other names; empty if they are not known."""
    held = this.fields[NAMES].value
    return [str(item) for item in held.of(list)] if isinstance(held, Known) else []
