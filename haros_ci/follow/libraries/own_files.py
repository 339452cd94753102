# SPDX-License-Identifier: Apache-2.0
"""Files that a Python program finds by where it lies itself: ``os.path.join(os.path.dirname(__file__), "../config/a.yaml")``."""

from __future__ import annotations

import posixpath

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.records import dataclass
from haros_ci.values.abstract import Opaque, Text, Value

#: Functions of ``os.path`` that give a path which is absolute the same, and the one that gives what is above it.
_SAME, _ABOVE = frozenset(("abspath", "realpath", "normpath")), "dirname"
#: Modules that have them.
_MODULES = frozenset(("os.path", "posixpath"))


@dataclass(frozen=True, slots=True)
class Directory(Opaque):
    """The directory of a program: its name on the machine is not known, but where it is in the workspace is (*path*, "" for the root)."""

    path: str = ""


def own_file(walk: Walk, frame: Frame) -> Text:
    """``__file__``. Of ROS 1 a devel space runs programs where they lie (docs.ros.org, catkin's develspace); of ROS 2 they are installed elsewhere."""
    directory, _, name = frame.source.path.rpartition("/")
    unknown = walk.opaque("where the file lies is not known", frame)
    if walk.context.process is None:
        unknown = Directory(unknown.reason, unknown.location, None, directory)
    return Text((unknown, f"/{name}"))


def of_path(name: str, value: Value) -> Value | None:
    """What a function of ``os.path`` gives for a path that begins in such a directory; None for all else."""
    module, _, function = name.rpartition(".")
    if module not in _MODULES or (function not in _SAME and function != _ABOVE):
        return None
    if isinstance(value, Directory):
        if function in _SAME:
            return value
        return Directory(value.reason, value.location, None, posixpath.dirname(value.path)) if value.path else None
    if not isinstance(value, Text) or not isinstance(value.parts[0], Directory) or function != "realpath":
        return None
    return value


def in_workspace(value: Value) -> str | None:
    """The path of a file that is found so, as ``YamlFiles`` reads it; None for all else."""
    if not isinstance(value, Text) or len(value.parts) != 2:
        return None
    directory, rest = value.parts
    if not isinstance(directory, Directory) or not isinstance(rest, str) or not rest.startswith("/"):
        return None
    return f"$(workspace {directory.path or '.'}){rest}"
