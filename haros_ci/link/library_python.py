# SPDX-License-Identifier: Apache-2.0
"""Models of Python's own library: text methods, containers, paths, YAML files, rospkg."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from haros_ci.link import activation, call_arguments, library_yaml, members
from haros_ci.link.run import Frame, Run
from haros_ci.link.values import (
    NONE,
    Callable,
    Cell,
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
)

if TYPE_CHECKING:
    from haros_ci.link.call_arguments import Argument

TEXT_METHODS = frozenset(
    "strip lstrip rstrip lower upper replace split startswith endswith title capitalize rsplit".split()
)
YAML = frozenset(("yaml.load", "yaml.safe_load", "yaml.full_load"))


def function(run: Run, frame: Frame, name: str, args: tuple[Argument, ...]) -> Value | None:
    """A modelled function."""
    first = args[0].value if args else None
    if name == "str" and first is not None:
        return concatenate((first,)) if not (isinstance(first, Known) and first.value is None) else Known("None")
    if name in ("int", "float", "bool") and isinstance(first, Known) and len(args) == 1:
        try:
            return Known({"int": int, "float": float, "bool": bool}[name](first.value))
        except (TypeError, ValueError, OverflowError):
            return run.opaque("it is no number", frame)
    if name in ("int", "float", "bool", "str"):
        kind = {"int": "int", "float": "double", "bool": "bool", "str": "std::string"}[name]
        return run.opaque("it is converted from what is not known", frame, None, (kind, (), "")) if args else None
    if name == "len" and first is not None:
        known, data = data_of(first)
        if known and isinstance(data, (str, list, dict)):
            return Known(len(data))
        if isinstance(first, Sequence) and isinstance(first.content.value, tuple):
            return Known(len(first.content.value))
        return run.opaque("the length of what is not known", frame, None, ("int", (), ""))
    if name == "range":
        bounds = [a.value.value for a in args if isinstance(a.value, Known) and isinstance(a.value.value, int)]
        if args and len(bounds) == len(args):
            try:
                numbers = range(*bounds)
            except (TypeError, ValueError):
                return None
            if len(numbers) <= 1000:
                return Known(list(numbers))
        return run.opaque("a range that is not known", frame)
    if name in ("list", "tuple", "sorted", "set") and first is not None:
        if isinstance(first, (Sequence, Known)):
            return first
    if name == "enumerate" and isinstance(first, (Sequence, Known)):
        items = _items(first)
        if items is not None:
            pairs = [Sequence(Cell((Cell(Known(n)), Cell(item)))) for n, item in enumerate(items)]
            return Sequence(Cell(tuple(Cell(pair) for pair in pairs)))
    if name == "zip":
        columns = [_items(a.value) for a in args]
        if columns and all(column is not None for column in columns):
            rows = list(zip(*(c for c in columns if c is not None), strict=False))
            made = tuple(Cell(Sequence(Cell(tuple(Cell(v) for v in row)))) for row in rows)
            return Sequence(Cell(made))
    if name == "dict" and not args:
        return Mapped(Cell({}))
    if name == "[for]" and len(args) == 2 and isinstance(args[1].value, Callable):
        return _comprehension(run, frame, args[0].value, args[1].value)
    if name in ("os.path.join", "posixpath.join") and args:
        parts: list[Value] = []
        for argument in args:
            parts += [Known("/"), argument.value] if parts else [argument.value]
        return concatenate(tuple(parts))
    if name in ("open", "io.open", "file") and first is not None:
        return Object("file", fields={"[path]": Cell(first)})
    if name in YAML and first is not None:
        if isinstance(first, Object) and "[path]" in first.fields:
            return library_yaml.yaml_file(run, first.fields["[path]"].value)
        return library_yaml.yaml_stream(run, first)
    if name in ("rospkg.RosPack", "rospkg.rospack.RosPack"):
        return Object("rospkg.RosPack")
    if name in ("roslib.packages.get_pkg_dir", "ament_index_python.packages.get_package_share_directory"):
        return Known(f"$(find {first.value})") if isinstance(first, Known) else None
    if name in ("functools.partial", "partial") and isinstance(first, Callable):
        bound = tuple(a.value for a in args[1:] if not a.keyword)
        return Callable(first.source, first.function, first.this, (*first.bound, *bound), first.frame, first.templates)
    if name in ("rospy.myargv", "sys.argv") and run.context.arguments is not None:
        return argv(run)
    if name == "getattr" and len(args) >= 2 and isinstance(args[1].value, Known):
        return members.attribute(run, args[0].value, str(args[1].value.value), frame)
    if name == "super":
        return Library("super")
    return None


def argv(run: Run) -> Value:
    """The command line that the launch file gives."""
    if run.context.arguments is None:
        return Opaque("the command line")
    cells = [Cell(Opaque("the program's name")), *(Cell(Known(a)) for a in run.context.arguments)]
    return Sequence(Cell(tuple(cells)))


def _items(value: Value) -> list[Value] | None:
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        return [cell.value for cell in value.content.value]
    if isinstance(value, Known) and isinstance(value.value, list):
        return [Known(item) for item in value.value]
    return None


def _comprehension(run: Run, frame: Frame, iterable: Value, element: Callable) -> Value:

    items = _items(iterable)
    if items is None or len(items) > 256:
        return Sequence(Cell(run.opaque("a list made from one that is not known", frame)))
    made = [activation.invoke(run, frame, element, (call_arguments.Argument(item),), None) for item in items]
    return Sequence(Cell(tuple(Cell(value) for value in made)))


def method(run: Run, frame: Frame, receiver: Value, name: str, args: tuple[Argument, ...]) -> Value | None:
    """A modelled method."""
    if isinstance(receiver, Known) and isinstance(receiver.value, str):
        if name == "format":
            return _format(run, frame, receiver.value, args)
        if name == "join" and args:
            items = _items(args[0].value)
            if items is not None:
                parts: list[Value] = []
                for item in items:
                    parts += [receiver, item] if parts else [item]
                return concatenate(tuple(parts))
        values = [argument.value.value if isinstance(argument.value, Known) else None for argument in args]
        if name in TEXT_METHODS and None not in values:
            try:
                return Known(getattr(receiver.value, name)(*values))
            except (TypeError, ValueError):
                return None
        return None
    if isinstance(receiver, Text) and name in ("strip", "rstrip"):
        return receiver
    if isinstance(receiver, Sequence):
        cells: Any = receiver.content.value
        if name == "append" and args and isinstance(cells, tuple) and len(cells) < 1000:
            run.state.write(receiver.content, (*cells, Cell(args[0].value)))
            return NONE
        if name in ("append", "extend", "insert", "remove", "pop", "sort", "reverse"):
            run.state.write(receiver.content, run.opaque("a list that is changed", frame))
            return NONE
    if isinstance(receiver, Known) and isinstance(receiver.value, dict):
        pairs = {key: Cell(Known(item)) for key, item in receiver.value.items()}
        return _dictionary(run, frame, pairs, name, args)
    if isinstance(receiver, Mapped) and isinstance(receiver.content.value, dict):
        return _dictionary(run, frame, receiver.content.value, name, args)
    if isinstance(receiver, Object) and receiver.name == "rospkg.RosPack" and name == "get_path":
        return Known(f"$(find {args[0].value.value})") if args and isinstance(args[0].value, Known) else None
    if isinstance(receiver, Object) and receiver.name == "file" and name in ("read", "__enter__"):
        return receiver
    return None


def _dictionary(run: Run, frame: Frame, pairs: Any, name: str, args: tuple[Argument, ...]) -> Value | None:
    if name in ("keys", "iterkeys"):
        return Known(list(pairs))
    if name in ("values", "itervalues"):
        return Sequence(Cell(tuple(pairs.values())))
    if name in ("items", "iteritems"):
        made = tuple(Cell(Sequence(Cell((Cell(Known(key)), cell)))) for key, cell in pairs.items())
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


def _format(run: Run, frame: Frame, text: str, args: tuple[Argument, ...]) -> Value:
    """``str.format`` with ``{}``, ``{0}`` and ``{name}`` only."""
    import re

    positional = [a.value for a in args if not a.keyword]
    named = {a.keyword: a.value for a in args if a.keyword}
    parts: list[Value] = []
    end = count = 0
    for found in re.finditer(r"\{(\w*)\}", text):
        parts.append(Known(text[end : found.start()]))
        end = found.end()
        key = found[1]
        if key.isdigit() or not key:
            index = int(key) if key else count
            count += 1
            parts.append(positional[index] if index < len(positional) else run.opaque("an argument is missing", frame))
        else:
            parts.append(named.get(key) or run.opaque("an argument is missing", frame))
    parts.append(Known(text[end:]))
    rest = re.sub(r"\{\w*\}", "", text)
    if "{" in rest or "}" in rest:
        return run.opaque("its format is not understood", frame)
    return concatenate(tuple(parts))
