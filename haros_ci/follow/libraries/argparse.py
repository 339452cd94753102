# SPDX-License-Identifier: Apache-2.0
"""Python's argparse: what a program's options are when a launch file gives its words (docs.python.org, argparse).

The words are read by argparse itself, from a parser with the same options; nothing of the workspace is executed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

from haros_ci.follow import comprehensions, slices
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, Elements, Known, Library, Object, Opaque, Sequence, Value, data_of

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

PARSER = "argparse.ArgumentParser"
#: The member of a parser that holds its options, and what they are kept as.
DECLARED, OPTION = "[options]", "[option]"
#: Arguments of a parser that do not change what words mean.
PLAIN = frozenset(("", "prog", "usage", "description", "epilog", "formatter_class", "add_help"))
GROUPS = frozenset(("add_argument_group", "add_mutually_exclusive_group"))
ACTIONS = frozenset(("store", "store_true", "store_false", "store_const", "append", "count"))
TYPES: dict[str, type[int | float | str]] = {"int": int, "float": float, "str": str}
#: Words on one command line, options of one parser, and positional ones of these that take a number of words that is not
#: fixed: argparse matches with expressions that try each way to share the words among them.
MOST, OPEN = 64, 3


def parser(args: tuple[PassedArgument, ...]) -> Object:
    """What ``argparse.ArgumentParser(...)`` makes; its options are not known if words are read in another way."""
    is_plain = all(argument.keyword in PLAIN for argument in args)
    options: Elements = () if is_plain else Opaque("the parser has rules of its own")
    return Object(PARSER, fields={DECLARED: Cell(Sequence(Cell(options)))})


def method(walk: Walk, frame: Frame, this: Object, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method of a parser: options are declared, the command line is read; anything else makes the options unknown."""
    declared = this.fields[DECLARED].value
    assert isinstance(declared, Sequence)
    options = declared.content.value
    if name in GROUPS:
        return this
    if name == "add_argument" and isinstance(options, tuple) and len(options) < MOST:
        members = {str(n): Cell(a.value) for n, a in enumerate(a for a in args if not a.keyword)}
        members |= {a.keyword: Cell(a.value) for a in args if a.keyword}
        option: Cell = Cell(Object(OPTION, fields=members))
        walk.state.write(declared.content, (*options, option))
        return Opaque("an option")
    if name in ("parse_args", "parse_known_args"):
        found = _parsed(options, args, name == "parse_known_args")
        return found if found is not None else walk.opaque("the command line is not known", frame)
    if name not in ("print_help", "print_usage", "format_help", "error", "exit"):
        walk.state.write(declared.content, Opaque(f"{name} may add options"))
    return None


def _parsed(options: Elements, args: tuple[PassedArgument, ...], is_partly: bool) -> Value | None:
    """The options as an object; None if the words, or what they mean, are not known.

    Without words they are ``sys.argv``, to which roslaunch adds some that no program declares.
    """
    is_given = len(args) == 1 and args[0].keyword in ("", "args")
    items = _words(args[0].value) if is_given else None
    if items is None or len(items) > MOST or not isinstance(options, tuple):
        return None
    words = [item.of(str) for item in items if isinstance(item, Known) and issubclass(item.kind, str)]
    if len(words) < len(items):
        return None
    try:
        space, rest, kept = _read(options, words)
    except (ValueError, TypeError, KeyError, IndexError, AttributeError):
        return None
    if rest and not is_partly:
        return None
    made = Object("argparse.Namespace", fields={key: Cell(_value(data, kept)) for key, data in space.items()})
    if not is_partly:
        return made
    return Sequence(Cell((Cell(made), Cell(_value(rest, kept)))))


def _words(value: Value) -> list[Value] | None:
    content = value.content.value if isinstance(value, Sequence) else None
    if isinstance(content, Opaque) and content.reason == slices.NOTHING:
        return []
    return comprehensions.items(value)


def _read(options: tuple[Cell, ...], words: list[str]) -> tuple[dict[str, object], list[str], dict[int, Value]]:
    """What argparse makes of *words*: values by name, words left over, and defaults that are not data by their stand-in."""
    import argparse

    class Reader(argparse.ArgumentParser):
        def error(self, message: str) -> NoReturn:
            raise ValueError(message)

    reader = Reader(add_help=False, conflict_handler="resolve")
    kept: dict[int, Value] = {}
    is_open = 0
    for cell in options:
        members = cell.value.fields if isinstance(cell.value, Object) else {}
        provided = {key: member.value for key, member in members.items() if not key.isdigit()}
        flags = [_text(members[key].value) for key in members if key.isdigit()]
        action = _data(provided["action"]) if "action" in provided else "store"
        if action not in ACTIONS:
            if action in ("help", "version"):
                continue
            raise ValueError("an action of its own")
        requested: dict[str, Any] = {"action": action}
        for key in ("dest", "nargs", "const", "required"):
            if key in provided:
                requested[key] = _data(provided[key])
        count = requested.get("nargs")
        if isinstance(count, int) and not 0 < count <= MOST:
            raise ValueError("a number of words that no command line has")
        is_open += isinstance(count, str) and not flags[0].startswith("-")
        if is_open > OPEN:
            raise ValueError("too many ways to share the words")
        if "type" in provided:
            kind = provided["type"]
            requested["type"] = TYPES[kind.name if isinstance(kind, Library) else ""]
        if "default" in provided:
            known, data = data_of(provided["default"])
            if not known:
                data = object()
                kept[id(data)] = provided["default"]
            requested["default"] = data
        reader.add_argument(*flags, **requested)
    space, rest = reader.parse_known_args(words)
    for key, data in list(vars(space).items()):
        if id(data) not in kept and not isinstance(data, (str, int, float, bool, list, type(None))):
            raise ValueError(f"{key} is no data")
    return vars(space), rest, kept


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
