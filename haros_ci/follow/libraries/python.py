# SPDX-License-Identifier: Apache-2.0
"""Models of Python's own library: text methods, containers, paths, YAML files, rospkg."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import commands, comprehensions, dispatch, dynamic, members, methods, partials, thrown
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import argparse as command_lines
from haros_ci.follow.libraries import (
    argparse_words,
    attribute_names,
    formats,
    made_classes,
    own_files,
    partly_texts,
    python_kinds,
    python_lists,
    python_numbers,
    python_paths,
    python_texts,
    ros_words,
)
from haros_ci.follow.libraries import yaml as library_yaml
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import (
    LIST_LIMIT,
    NONE,
    Callable,
    Cell,
    ClassValue,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Sequence,
    Text,
    Value,
    concatenate,
    data_of,
    printed,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What makes a dictionary; ``[dict]`` is the one of a comprehension.
DICTS = frozenset(("dict", "[dict]", "collections.OrderedDict"))
#: What gives back its second argument (docs.python.org/3/library/typing.html#typing.cast).
CASTS = frozenset(("typing.cast", "typing_extensions.cast"))
#: Numbers in a row; ``xrange`` of Python 2 goes through the same (docs.python.org/2/library/functions.html#xrange).
RANGES = frozenset(("range", "xrange", "six.moves.range", "six.moves.xrange", "past.builtins.xrange"))
YAML = frozenset(("yaml.load", "yaml.safe_load", "yaml.full_load"))


def function(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> Value | None:  # noqa: C901 - one branch for each modelled function
    """A modelled function."""
    first = args[0].value if args else None
    if name == "str" and first is not None:
        return concatenate((first,), printed)
    if name in ("int", "float", "bool") and isinstance(first, Known) and len(args) == 1:
        try:
            return Known({"int": int, "float": float, "bool": bool}[name](first.value))
        except (TypeError, ValueError, OverflowError):
            thrown.throws(walk, thrown.NUMBER)
            return walk.opaque("it is no number", frame)
    if name in ("int", "float", "bool", "str"):
        kind = {"int": "int", "float": "double", "bool": "bool", "str": "std::string"}[name]
        return walk.opaque("it is converted from what is not known", frame, None, syntax.Type(kind)) if args else None
    if name == "len" and first is not None:
        known, data = data_of(first)
        if known and isinstance(data, (str, list, dict)):
            return Known(len(data))
        if isinstance(first, Sequence) and isinstance(first.content.value, tuple):
            return Known(len(first.content.value))
        return walk.opaque("the length of what is not known", frame, None, syntax.Type("int"))
    if name in RANGES:
        bounds = [a.value.value for a in args if isinstance(a.value, Known) and isinstance(a.value.value, int)]
        if args and len(bounds) == len(args):
            try:
                numbers = range(*bounds)
            except (TypeError, ValueError):
                return None
            if len(numbers) <= 1000:
                return Known(list(numbers))
        return walk.opaque("a range that is not known", frame)
    if (found := python_lists.function(name, args)) is not None:
        return found
    if name in ("list", "tuple", "sorted", "set", "frozenset", "reversed", "iter") and first is not None:
        items = comprehensions.items(first)
        if name == "sorted" and items is not None:
            items = python_lists.ordered(items) if len(args) == 1 else None
        elif items is not None and python_lists.is_set(first) and len(items) > 1:
            items = None  # in no order that is known
        if items is not None and name == "reversed":
            items = items[::-1]
        if items is not None:
            return Sequence(Cell(tuple(Cell(item) for item in items)))
        return Sequence(Cell(walk.opaque(f"a list made by {name}", frame)))
    if name == "next" and isinstance(first, Sequence):
        return python_lists.taken(walk, first, args[1].value if len(args) > 1 else None)
    if name == "enumerate" and first is not None:
        items = comprehensions.items(first)
        begin = args[1].value if len(args) > 1 else Known(0)
        if items is not None and isinstance(begin, Known) and issubclass(begin.kind, int):
            pairs = [Sequence(Cell((Cell(Known(n)), Cell(item)))) for n, item in enumerate(items, begin.of(int))]
            return Sequence(Cell(tuple(Cell(pair) for pair in pairs)))
    if name == "zip":
        columns = [None if a.keyword else comprehensions.items(a.value) for a in args]
        if columns and all(column is not None for column in columns):
            rows = list(zip(*(c for c in columns if c is not None), strict=False))
            made: tuple[Cell, ...] = tuple(Cell(Sequence(Cell(tuple(Cell(v) for v in row)))) for row in rows)
            return Sequence(Cell(made))
    if name in DICTS:
        return comprehensions.dictionary(walk, frame, args)
    if name in ("[for]", "[for in]"):
        return comprehensions.comprehension(walk, frame, name == "[for in]", args)
    if name in ("map", "filter"):
        return comprehensions.applied(walk, frame, name, args)
    if name == "[slice]" and all(isinstance(a.value, Known) for a in args):
        return Object("slice", fields={str(n): Cell(a.value) for n, a in enumerate(args)})
    plain = python_texts.computed(walk, frame, name, args) or python_numbers.called(walk, frame, name, args)
    if plain is not None:
        return plain
    if name in CASTS and len(args) == 2:
        return args[1].value
    if name == "re.sub":
        return partly_texts.substituted(args)
    if name in formats.JOINING and args:
        return formats.path(walk, frame, args)
    if name in formats.PATHS and isinstance(first, Known) and issubclass(first.kind, str) and len(args) == 1:
        return formats.of_path(name, first.of(str))
    if len(args) == 1 and first is not None and (place := own_files.of_path(name, first)) is not None:
        return place
    if isinstance(first, Text) and len(args) == 1 and (found := partly_texts.of_path(name, first)) is not None:
        return found
    if name in ("open", "io.open", "file") and first is not None:
        return Object("file", fields={"[path]": Cell(first)})
    if name in YAML and first is not None:
        if isinstance(first, Object) and "[path]" in first.fields:
            return library_yaml.yaml_file(walk, first.fields["[path]"].value)
        return library_yaml.yaml_stream(walk, first)
    if name == command_lines.PARSER:
        return command_lines.parser(args)
    if name in ("rospkg.RosPack", "rospkg.rospack.RosPack"):
        return Object("rospkg.RosPack")
    if name == "roslib.packages.get_pkg_dir":
        return Known(f"$(find {first.value})") if isinstance(first, Known) else None
    if (made_class := made_classes.called(walk, frame, name, args)) is not None:
        return made_class
    if name == "functools.partial" and first is not None:
        return partials.partial(first, args[1:])
    if name == "type" and len(args) == 1 and isinstance(first, Object) and first.definition is not None:
        return ClassValue(*first.definition)
    if name == "type" and len(args) == 1 and first is not None:
        return python_kinds.type_of(first)
    if name == "isinstance":
        return python_kinds.is_instance(args)
    if name in ("rospy.myargv", "sys.argv") and walk.context.arguments is not None:
        return argv(walk, frame, name == "rospy.myargv")
    if name == ros_words.REMOVE:
        return ros_words.removed(argv(walk, frame) if first in (None, NONE) else first)
    if name in dynamic.IMPORTS:
        return dynamic.module(walk, frame, name, args)
    if name in dynamic.CLASSES:
        return dynamic.interface(name, args)
    if name == "getattr" and len(args) >= 2 and isinstance(first, Opaque) and first.reason == dynamic.IMPORTED:
        return dynamic.of_module(walk, first, args[1].value, frame)
    if name == "object.__getattribute__" and len(args) == 2:
        return _own_attribute(walk, frame, args[0].value, args[1].value)
    if name == "getattr" and len(args) >= 2 and isinstance(args[1].value, Known):
        return members.attribute(walk, args[0].value, str(args[1].value.value), frame)
    if name == "getattr" and len(args) >= 2 and first is not None:
        return attribute_names.possible(walk, first, args[1].value, tuple(a.value for a in args[2:]), frame)
    if name == "setattr" and len(args) == 3 and first is not None:
        return attribute_names.assigned(walk, first, args[1].value, args[2].value, frame)
    if name == attribute_names.UPDATE and first is not None:
        return attribute_names.updated(walk, first, args[1:], frame)
    if name == "callable" and isinstance(first, (Callable, ClassValue, Known, Text, Sequence, Mapped)):
        return Known(isinstance(first, (Callable, ClassValue)))
    if name == "dir" and len(args) == 1 and first is not None:
        return attribute_names.directory(walk, first)
    if name == attribute_names.MEMBERS and first is not None:
        return attribute_names.pairs(walk, first, args[1].value if len(args) > 1 else None, frame)
    if name == "super":
        return Library("super")
    return commands.function(walk, frame, name, args) if name in commands.FUNCTIONS else None


def _own_attribute(walk: Walk, frame: Frame, this: Value, name: Value) -> Value | None:
    """``object.__getattribute__``: what an object has without ``__getattr__``, else an exception."""
    if not isinstance(this, Object) or not isinstance(name, Known):
        return None
    cell = members.member(walk, this, str(name.value), frame)
    found: Value | None = cell.value if cell is not None else methods.method_of(walk, this, str(name.value))
    if found is None:
        thrown.throws(walk, thrown.ATTRIBUTE)
    return found


def argv(walk: Walk, frame: Frame, is_own: bool = False) -> Value:
    """The command line of the launch file, with words that a launch adds (wiki.ros.org/roslaunch/XML/node); else that of a node without words.

    ``rospy.myargv`` is without them, and without all other remappings.
    """
    context = walk.context
    is_launched = context.is_launched
    is_other = bool(walk.ruled_out() or walk.beyond or frame.is_dead)
    if context.arguments is None or (is_other and not is_launched):
        return Opaque("the command line")
    words: list[Value] = [Opaque("the program's name"), *context.words()]
    if is_own:
        words = [word for word in words if not (isinstance(word, Known) and ":=" in word.of(str))]
    elif is_launched:
        words += ros_words.BY_ROSLAUNCH if context.process is None else ros_words.BY_LAUNCH
    return Sequence(Cell(tuple(Cell(word) for word in words)))


def _may_be_text(value: Value) -> bool:
    return not isinstance(value, Known) or issubclass(value.kind, str)


def method(walk: Walk, frame: Frame, receiver: Value, name: str, args: tuple[PassedArgument, ...]) -> Value | None:  # noqa: C901 - one branch for each kind of receiver and method
    """A modelled method."""
    if receiver.__class__ in commands.KINDS and (found := commands.method(walk, frame, receiver, name, args)):
        return found
    if isinstance(receiver, Known) and issubclass(receiver.kind, str):
        if name == "format":
            return formats.braces(walk, frame, receiver.of(str), args)
        if name == "join" and args:
            items = comprehensions.items(args[0].value)
            if items is not None and all(_may_be_text(item) for item in items):
                parts: list[Value] = []
                for item in items:
                    parts += [receiver, item] if parts else [item]
                return concatenate(tuple(parts), printed)
        of_text = python_texts.method(walk, frame, receiver.of(str), name, args)
        return of_text or python_paths.method(walk, frame, receiver, name, args)
    if isinstance(receiver, (Text, own_files.Directory)):
        of_text = partly_texts.method(receiver, name, args) if isinstance(receiver, Text) else None
        return of_text or python_paths.method(walk, frame, receiver, name, args)
    if isinstance(receiver, Sequence):
        cells = receiver.content.value
        if (found := python_lists.method(walk, receiver, name, args)) is not None:
            return found
        if name == "append" and args and isinstance(cells, tuple) and len(cells) < LIST_LIMIT:
            walk.state.write(receiver.content, (*cells, Cell(args[0].value)))
            return NONE
        if name == "extend" and args and isinstance(cells, tuple):
            more = comprehensions.items(args[0].value)
            if more is not None and len(cells) + len(more) <= LIST_LIMIT:
                walk.state.write(receiver.content, (*cells, *(Cell(item) for item in more)))
                return NONE
        if name in ("sort", "reverse") and isinstance(cells, tuple) and not args:
            held = [cell.value for cell in cells]
            turned = held[::-1] if name == "reverse" else python_lists.ordered(held)
            if turned is not None:
                walk.state.write(receiver.content, tuple(Cell(item) for item in turned))
                return NONE
        if name == "pop" and isinstance(cells, tuple) and cells and not args and not python_lists.is_set(receiver):
            walk.state.write(receiver.content, cells[:-1])
            return cells[-1].value
        if name == "pop":
            walk.state.write(receiver.content, walk.opaque("a list that is changed", frame))
            return walk.opaque("an element that is not known", frame)
        if name in ("append", "extend", "insert", "remove", "pop", "sort", "reverse", "add", "discard", "update"):
            walk.state.write(receiver.content, walk.opaque("a list that is changed", frame))
            return NONE
    if isinstance(receiver, Known) and issubclass(receiver.kind, dict):
        pairs: dict[object, Cell] = {key: Cell(Known(item)) for key, item in receiver.of(dict).items()}
        return _dictionary(walk, frame, pairs, name, args)
    if isinstance(receiver, Mapped) and name in ("update", "pop", "setdefault", "clear", "copy"):
        return _changed(walk, frame, receiver, name, args)
    if isinstance(receiver, Mapped) and isinstance(receiver.content.value, dict):
        if name == "get" and args and not isinstance(args[0].value, Known):
            return dispatch.entry(receiver, args[1].value if len(args) > 1 else NONE)
        return _dictionary(walk, frame, receiver.content.value, name, args)
    if isinstance(receiver, ClassValue) and name == "__subclasses__" and not args:
        return Sequence(Cell(tuple(Cell(subclass) for subclass in dispatch.subclasses(walk, receiver))))
    if isinstance(receiver, Object) and receiver.name == command_lines.PARSER:
        return command_lines.method(walk, frame, receiver, name, args)
    if isinstance(receiver, Object) and receiver.name == argparse_words.COMMANDS:
        return command_lines.added(walk, receiver, name, args)
    if isinstance(receiver, Object) and receiver.name == "rospkg.RosPack" and name == "get_path":
        return Known(f"$(find {args[0].value.value})") if args and isinstance(args[0].value, Known) else None
    if isinstance(receiver, Object) and receiver.name == "file" and name in ("read", "__enter__"):
        return receiver
    return None


def _changed(walk: Walk, frame: Frame, receiver: Mapped, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method that changes a dictionary."""
    pairs = receiver.content.value
    if name == "clear":
        walk.state.write(receiver.content, {})
        return NONE
    first = args[0].value if args else NONE
    if isinstance(pairs, dict):
        if name == "copy":
            return Mapped(Cell({key: Cell(cell.value, cell.type) for key, cell in pairs.items()}))
        named: dict[object, Cell] = {argument.keyword: Cell(argument.value) for argument in args if argument.keyword}
        if name == "update" and "**" not in named and len(args) - len(named) < 2:
            more = first.content.value if isinstance(first, Mapped) else None
            if args and args[0].keyword:
                more = {}
            if isinstance(first, Known) and issubclass(first.kind, dict):
                more = {key: Cell(Known(item)) for key, item in first.of(dict).items()}
            if isinstance(more, dict) and len(pairs) + len(more) <= LIST_LIMIT:
                fresh = {key: Cell(cell.value, cell.type) for key, cell in {**more, **named}.items()}
                walk.state.write(receiver.content, {**pairs, **fresh})
                return NONE
        if isinstance(first, Known) and issubclass(first.kind, (str, int)) and name in ("pop", "setdefault"):
            found = pairs.get(first.value)
            default = args[1].value if len(args) > 1 else NONE
            if found is None and name == "setdefault":
                walk.state.write(receiver.content, {**pairs, first.value: Cell(default)})
            elif found is not None and name == "pop":
                walk.state.write(receiver.content, {key: cell for key, cell in pairs.items() if key != first.value})
            return found.value if found is not None else default
    if name == "copy":
        return Mapped(Cell(pairs))
    walk.state.write(receiver.content, walk.opaque("a dictionary that is changed", frame))
    return walk.opaque("an entry that is not known", frame)


def _dictionary(
    walk: Walk, frame: Frame, pairs: dict[object, Cell], name: str, args: tuple[PassedArgument, ...]
) -> Value | None:
    if name in ("keys", "iterkeys"):
        return Known(list(pairs))
    if name in ("values", "itervalues"):
        return Sequence(Cell(tuple(pairs.values())))
    if name in ("items", "iteritems"):
        made: tuple[Cell, ...] = tuple(Cell(Sequence(Cell((Cell(Known(key)), cell)))) for key, cell in pairs.items())
        return Sequence(Cell(made))
    if name == "get" and args and isinstance(args[0].value, Known):
        try:
            found = pairs.get(args[0].value.value)
        except TypeError:
            return None
        if found is not None:
            return found.value
        return args[1].value if len(args) > 1 else NONE
    return None
