# SPDX-License-Identifier: Apache-2.0
"""``pathlib``: a path is its text, and what ``os.path`` gives for it (docs.python.org/3/library/pathlib.html)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow import call_arguments
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import formats, own_files, python
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, Known, Object, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What a function of os.path gives for a path as a whole, by the attribute or method.
_ATTRIBUTES = {"parent": "os.path.dirname"}
_WHOLE = {"resolve": "os.path.realpath", "absolute": "os.path.abspath"}
#: Methods that give the same path, and those that read the file.
_SAME, _READING = ("as_posix", "__str__", "__fspath__"), ("open", "read_text")


def is_path(value: Value) -> bool:
    """Whether a value may be a path: a text, known or in part, or the directory of a program."""
    return isinstance(value, (Text, own_files.Directory)) or (isinstance(value, Known) and issubclass(value.kind, str))


def method(walk: Walk, frame: Frame, path: Value, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method that paths have and texts have not."""
    if not is_path(path):
        return None
    if name == "joinpath":
        return joined(walk, frame, (call_arguments.PassedArgument(path), *args))
    if name in _READING:
        return Object("file", fields={"[path]": Cell(path)})
    if name in _SAME and not args:
        return path
    return _of_function(walk, frame, _WHOLE[name], path) if name in _WHOLE else None


def attribute(walk: Walk, frame: Frame, path: Value, name: str) -> Value | None:
    """An attribute that paths have and texts have not."""
    return _of_function(walk, frame, _ATTRIBUTES[name], path) if name in _ATTRIBUTES and is_path(path) else None


def joined(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value:
    """``Path(a, b)`` and ``a / b``."""
    return formats.path(walk, frame, args)


def divided(walk: Walk, frame: Frame, left: Value, right: Value) -> Value:
    """``left / right``, of which one is a path: no text can be divided."""
    return joined(walk, frame, (call_arguments.PassedArgument(left), call_arguments.PassedArgument(right)))


def _of_function(walk: Walk, frame: Frame, name: str, path: Value) -> Value | None:
    return python.function(walk, frame, name, (call_arguments.PassedArgument(path),))
