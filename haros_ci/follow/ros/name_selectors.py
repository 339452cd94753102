# SPDX-License-Identifier: Apache-2.0
"""Selectors of graph names: how the name that a call is given is resolved, remapped or searched for."""

from __future__ import annotations

from functools import reduce

from haros_ci.follow import handles
from haros_ci.follow.ros import ros2_nodes, ros2_parameters, selectors
from haros_ci.follow.ros.own_names import own_names
from haros_ci.graph import ros2_process
from haros_ci.graph.names import clean, pattern, resolve
from haros_ci.graph.parameters import Perhaps, SetByNode
from haros_ci.model.location import Location
from haros_ci.values.abstract import FALSE, NONE, TRUE, Choice, Known, Object, Opaque, Text, Value, join
from haros_ci.values.given import marked

#: A name as a pattern, with why and where it is not wholly known.
Name = tuple[str, str | None, Location | None]


def resolved(applied: selectors.Applied, selector: str, flag: str) -> Value:
    """The name as ``resolveName`` gives it (wiki.ros.org/Names); the argument at *flag* says whether it is remapped.

    In ROS 2 that argument is ``only_expand``, which says that it is not (rclcpp/node_interfaces/node_topics.hpp).
    """
    value = _first(applied, selector)
    result: Value | None = None
    for option in value.options if isinstance(value, Choice) else (value,):
        found = _full(applied, option, flag)
        result = found if result is None else join(result, found)
    return result if result is not None else applied.walk.opaque("a name that is not known", applied.frame)


def _full(applied: selectors.Applied, value: Value | None, flag: str) -> Value:
    if value == Known(""):
        return applied.walk.opaque("the namespace that an empty name is resolved to", applied.frame)
    full, unknown = _absolute(applied, _name(value))
    if unknown is not None:
        pieces: list[str | Opaque] = []
        for number, piece in enumerate(full.split("?")):
            pieces += ([unknown] if number else []) + ([piece] if piece else [])
        return applied.walk.context.marks.partly(Text(tuple(pieces))) if "?" in full else unknown
    name = _remap(applied, full)
    argument = selectors.given(applied.args, flag) if flag else None
    remaps, expands = (TRUE, FALSE) if applied.walk.context.process is None else (FALSE, TRUE)  # ROS 2: only_expand
    known = applied.walk.context.marks.known
    if argument is None or name == full or argument.value == remaps:
        return known(name)
    return (
        known(full) if argument.value == expands else applied.walk.opaque("whether the name is remapped", applied.frame)
    )


def remapped(applied: selectors.Applied, selector: str) -> Value:
    """The name as ``remap`` gives it: what it is remapped to, else the name as it is."""
    value: Value | None = _first(applied, selector)
    if value is None:
        return applied.walk.opaque("a name that is not known", applied.frame)
    full, unknown = _absolute(applied, _name(value))
    name = _remap(applied, full) if unknown is None else full
    return applied.walk.context.marks.known(name) if name != full else value


def canonical(applied: selectors.Applied, selector: str) -> Value | None:
    """A name without doubled and trailing slashes; one that is not known stays as it is."""
    value: Value | None = _first(applied, selector)
    if isinstance(value, Known) and issubclass(value.kind, str):
        name = "/".join(part for part in value.of(str).split("/") if part)
        return Known(f"/{name}" if value.of(str).startswith("/") else name)
    return value


def parent(applied: selectors.Applied, selector: str) -> Value:
    """The namespace of a name as it is resolved and remapped, with its last slash."""
    full, why = _absolute(applied, _name(_first(applied, selector)))
    if why is None:
        return Known(f"{applied.walk.context.marks.looked_at(_remap(applied, full)).rpartition('/')[0]}/")
    full = applied.walk.context.marks.looked_at(full)
    head = f"{full.rpartition('/')[0]}/"
    return Text((head.partition("?")[0] or "/", why))


def above(applied: selectors.Applied, selector: str) -> Value | None:
    """The text of a name up to its last slash, as an absolute name; nothing of it is resolved or remapped."""
    value: Value | None = _first(applied, selector)
    if isinstance(value, Choice):
        found = [_above(option) for option in value.options]
        return reduce(join, found)
    return _above(value) if value is not None else None


def _above(value: Value) -> Value:
    text, why, where = pattern(value)
    head = "/".join(part for part in text.split("/")[:-1] if part)
    if why is None:
        return Known(f"/{head}/" if head else "/")
    return Text((f"/{head}/" if head and "?" not in head else "/", Opaque(why, where)))


def expanded(applied: selectors.Applied, name: str, node: str, space: str) -> Value:
    """A name as rclcpp::expand_topic_or_service_name gives it for a node's name and namespace, without remapping."""
    found = [_first(applied, where) for where in (name, node, space)]
    texts = [value.of(str) if isinstance(value, Known) and issubclass(value.kind, str) else None for value in found]
    if isinstance(found[0], Text) and str(found[0].parts[0])[:1] == "/":
        return found[0]
    if texts[0] is None or "{" in texts[0] or (texts[0][:1] != "/" and (texts[1] is None or texts[2] is None)):
        return applied.walk.opaque("what a name is expanded to", applied.frame)
    return Known(resolve(texts[0], texts[2] or "/", f"{texts[2]}/{texts[1]}"))


def search(applied: selectors.Applied, selector: str) -> Value:
    """searchParam: the nearest namespace upwards that has the parameter (wiki.ros.org/Parameter Server).

    It begins at the entry's namespace, the handle's or the node's own name. Of ``a/b`` it looks for ``a`` alone. Where
    nothing sets it, the first that is looked at: there it would be found before all others.
    """
    walk = applied.walk
    name, why, where = _name(_first(applied, selector))
    if why is not None:
        return Text(("/", Opaque(why, where)))
    if name.startswith("/"):
        return Known(clean(name))
    if not name.strip("/") or name.startswith("~"):
        return walk.opaque("a name that cannot be searched for", applied.frame)
    return _searched(applied, name)[0]


def search_result(applied: selectors.Applied, selector: str) -> Value:
    """What rospy's search_param returns: the name, or None where no namespace has the parameter (rospy/client.py)."""
    found = search(applied, selector)
    name, why, _ = _name(_first(applied, selector))
    if not isinstance(found, Known) or why is not None:
        return found
    is_found = (
        applied.walk.parameter(found.of(str)) is not None if name.startswith("/") else _searched(applied, name)[1]
    )
    return found if is_found else join(found, NONE)


def _searched(applied: selectors.Applied, name: str) -> tuple[Value, bool]:
    """The name that is found, and whether something sets it for certain."""
    walk = applied.walk
    start, why, where = pattern(_start(applied))
    first = name.split("/")[0]
    prefix = start
    while why is None:
        found = walk.parameter(clean(f"{prefix}/{name}"))
        if found is None and first != name:
            found = walk.parameter(clean(f"{prefix}/{first}"))
        if isinstance(found, Perhaps) and not (isinstance(found, SetByNode) and prefix == start):
            return Text(("/", found)), False
        if found is not None:
            return Known(clean(f"{prefix}/{name}")), not isinstance(found, Perhaps)
        if prefix in ("", "/"):
            return Known(clean(f"{start}/{name}")), False
        prefix = prefix.rpartition("/")[0]
    return Text(("/", Opaque(why, where))), False


def _start(applied: selectors.Applied) -> Value:
    """Where the search begins."""
    for entry in applied.row.makes:
        if "namespace" in entry.values:
            chosen = selectors.value_of(applied, entry.values["namespace"])
            if chosen is not None:
                return handles.namespace_of(applied, chosen)
    receiver = applied.receiver
    if isinstance(receiver, Object) and receiver.namespace is not None:
        return receiver.namespace
    return Known(own_names(applied)[0])


def _absolute(applied: selectors.Applied, name: Name) -> tuple[str, Opaque | None]:
    """The full name before it is remapped, as the receiver resolves it, and why it is not wholly known."""
    context = applied.walk.context
    text, why, where = name
    if context.process is not None:
        node = _node(applied)
        if node is None and not text.startswith("/"):
            return "/?", Opaque(ros2_nodes.UNKNOWN_NODE, applied.location)
        full = node.expand(text) if node is not None else text
        if why is not None:
            return full, Opaque(why, where)
        return full, Opaque(*node.why) if node is not None and node.why is not None and "?" in full else None
    receiver = applied.receiver
    own, above = own_names(applied)
    space: Value = Known(above)
    if isinstance(receiver, Object) and (receiver.namespace is not None or receiver.name == "ros::NodeHandle"):
        space = handles.namespace_of(applied, receiver)
    prefix, space_why, space_where = pattern(space)
    full = resolve(text, prefix, own)
    if why is not None:
        return full, Opaque(why, where)
    if space_why is not None and text[:1] not in ("/", "~"):
        return full, Opaque(space_why, space_where)
    return full, None


def _node(applied: selectors.Applied) -> ros2_process.RosNode | None:
    """The ROS 2 node that the row's first entry, else the receiver, belongs to."""
    entry = next(iter(applied.row.makes), None)
    if entry is not None:
        return ros2_nodes.of_entry(applied, entry)[0]
    return ros2_nodes.of_value(applied.walk, applied.receiver)


def _remap(applied: selectors.Applied, full: str) -> str:
    """What the full name is remapped to, by the ROS 2 node's rules where there is one."""
    node = _node(applied) if applied.walk.context.process is not None else None
    return ros2_nodes.remapped(applied.walk, node, full) if node is not None else applied.walk.context.remap(full)


def _first(applied: selectors.Applied, alternatives: str) -> Value | None:
    """What the first alternative that is there finds; None if none is."""
    for selector in alternatives.split("|"):
        found = selectors.select_value(applied, selector)
        if found is not None:
            return found if not isinstance(found, selectors.TypeValue) else Opaque("it is a type")
    return None


def _name(value: Value | None) -> Name:
    if isinstance(value, (Known, Text, Opaque, Choice)):
        return pattern(marked(value))
    return "?", "it is not known", None


def declared(applied: selectors.Applied, selector: str) -> Value:
    """Whether the ROS 2 node that is the receiver has declared the parameter of that name."""
    node = ros2_nodes.of_value(applied.walk, applied.receiver)
    value: Value | None = _first(applied, selector)
    return ros2_parameters.is_declared(applied, node, value if value is not None else Opaque("a name"))
