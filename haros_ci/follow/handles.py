# SPDX-License-Identifier: Apache-2.0
"""Node handles: the namespace that each stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import api_rows, ros2_nodes, selectors
from haros_ci.follow.ros.own_names import own_names
from haros_ci.follow.walk import Walk
from haros_ci.graph.names import pattern, resolve
from haros_ci.index.types import STRINGS, pointee
from haros_ci.model.api import Entry
from haros_ci.values.abstract import NONE, Callable, Known, Object, Opaque, Pointer, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument


def handle(applied: selectors.Applied, entry: Entry) -> Value:
    """The namespace of a node handle: its parent's, and the text below it.

    A handle that a nodelet makes itself is its process's, the manager's, and not its own (wiki.ros.org/nodelet). The text ``/`` adds nothing: roscpp
    cleans it away (names.cpp, ``clean``), so that ``ros::NodeHandle("/")`` is in the namespace of the node.
    """
    own, above = own_names(applied)
    parent: Value = Known(above)
    if "parent" in entry.values:
        found = selectors.value_of(applied, entry.values["parent"])
        parent = namespace_of(applied, found) if found is not None else parent
    text = selectors.value_at(applied, entry.values["namespace"]) if "namespace" in entry.values else Known("")
    if text is None or text == NONE or (isinstance(text, Known) and text.value in ("", "/", "//")):
        return parent
    if "parent" in entry.values and pattern(text)[0].startswith("~"):
        return applied.walk.opaque("roscpp throws at a private name below a node handle", applied.frame)
    return _remapped(applied, below(applied, parent, text, own), own)


def _remapped(applied: selectors.Applied, space: Value, own: str) -> Value:
    """What roscpp remaps the namespace of a handle to where it is constructed (``NodeHandle::construct``), by its whole name alone.

    It does so again with each copy. A remapping of the node's own name counts or not by how it is written (``names::init``).
    """
    context = applied.walk.context
    if not isinstance(space, Known) or applied.row.call != "ros::NodeHandle" or not context.remaps_process:
        return space
    name = context.remap(space.of(str))
    if name == space.of(str):
        return space
    if space.of(str) == own or context.remap(name) != name:
        return applied.walk.opaque("what the namespace of the handle is remapped to", applied.frame)
    return context.marks.known(name)


def below(applied: selectors.Applied, parent: Value, text: Value, node: str) -> Value:
    """The namespace *text* seen from *parent*, where *node* is what ``~`` stands for."""
    name, why, where = pattern(text)
    space, space_why, space_where = pattern(parent)
    if name == "~":
        return Known(node)
    full = resolve(name, space, node)
    if why is None and (space_why is None or name[:1] in "/~"):
        return Known(full)
    return Text((full.partition("?")[0], Opaque(why or space_why or "", where or space_where), full.partition("?")[2]))


def namespace_of(applied: selectors.Applied, value: object) -> Value:
    """The absolute namespace that a handle or text stands for."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object):
        if value.namespace is not None:
            return value.namespace
        return applied.walk.opaque(f"the namespace of a {value.name}", applied.frame, applied.location.line)
    if isinstance(value, Opaque) and value.type is not None and pointee(value.type).name not in STRINGS:
        return Opaque(f"the node handle is not known: {value.reason}", value.location)
    if isinstance(value, (Known, Text, Opaque)):
        own, above = own_names(applied)
        return below(applied, Known(above), value, own) if value != Known("") else Known(above)
    return applied.walk.opaque("the namespace is not known", applied.frame, applied.location.line)


def by_method(frame: Frame, name: str, args: tuple[PassedArgument, ...], targs: tuple[syntax.Argument, ...]) -> str:
    """The class, a node handle's or another, that a method of an object that is not declared in the workspace must be of; "" if none."""
    if frame.source.separator != "::":
        return ""
    calls_back = name == "subscribe" and len(args) > 2 and any(isinstance(one.value, Callable) for one in args)
    return api_rows.handle(name, len(args), bool(targs)) or ("ros::NodeHandle" if calls_back else "")


def node_class(
    walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...], targs: tuple[syntax.Argument, ...]
) -> str:
    """The class that a method can only be of, whatever it is called on: a node handle's or, in ROS 2, a node's; else ""."""
    if walk.context.process is not None:
        return ros2_nodes.NODE[frame.source.separator] if name in ros2_nodes.UNMISTAKABLE else ""
    return by_method(frame, name, args, targs)
