# SPDX-License-Identifier: Apache-2.0
"""Two servers of one service or action."""

from __future__ import annotations

import re
from collections.abc import Iterator
from weakref import WeakKeyDictionary

from haros_ci.api import (
    Channel,
    Check,
    End,
    Finding,
    Level,
    System,
    SystemNode,
    Whole,
    can_meet,
    named_at,
    regex,
    way_to,
)

#: Code of programs.
CODE = (".cpp", ".hpp", ".cc", ".cxx", ".h", ".hh", ".hxx", ".ipp", ".py")
#: What libraries offer by themselves, once for a node however many objects ask for it: tf2_ros.Buffer, roscpp.
_OF_LIBRARIES = frozenset(
    ("tf2_msgs/FrameGraph", "tf2_msgs/srv/FrameGraph", "roscpp/GetLoggers", "roscpp/SetLoggerLevel", "roscpp/Empty")
)
#: How servers are ended in rclpy, with what is given.
_DESTROYED = regex(r"\bdestroy_service\s*\(\s*([\w.]{0,80})\s{0,9}(\[?)")
#: A request of which a handler looks whom it is for: ``if request.drone_id != self.id``.
_ADDRESSED = regex(
    r"\b(?:if|switch)\b[^\n]{0,80}?\b(?:req|goal)\w{0,20}(?:\.|->)(?:goal(?:\.|->))?\w{0,40}(?:id|name|robot|target|namespace|agent|vehicle|drone|joint)s?\b",
    re.IGNORECASE,
)
#: What makes an action server of ROS 1 that does not start by itself (wiki.ros.org/actionlib, auto_start), and what starts one.
_WAITING = regex(r",\s*(?:auto_start\s*=\s*)?(?:false|False)\s*[)}]")
_STARTED = regex(r"\b(\w+)\s{0,9}(?:\.|->)\s{0,9}start\s{0,9}\(")
#: Lines of a call.
_LINES = 4
#: What a call is assigned to, before it.
_KEPT = regex(r"([A-Za-z_][\w.]{0,80})\s{0,9}(?::[^=\n]{0,80})?=(?!=)\s{0,80}\Z")
#: Two nodes, and what both offer: the channel with the server of each.
_Pairs = dict[tuple[str, str], list[tuple[Channel, End, End]]]

_Key = tuple[str, ...]

#: Of all systems that are seen together, where each pair of nodes is reported, and all that have it.
_SEEN: WeakKeyDictionary[Whole, dict[_Key, list[tuple[System, SystemNode]]]] = WeakKeyDictionary()
#: The services and actions, by kind and name, of which it was looked up whether something calls them.
_CALLED: WeakKeyDictionary[Whole, dict[tuple[str, str], bool]] = WeakKeyDictionary()


def check(system: System) -> Iterator[Finding]:
    for pair in _pairs(system).values():
        first, *others = _systems_with(pair, system)
        if first[0] is system:
            systems = [first[0], *(other for other, _ in others)]
            yield _finding(pair, [node for _, node in others], _level(pair, systems), system)


def _level(pairs: list[tuple[Channel, End, End]], systems: list[System]) -> Level | None:
    """How grave two servers are: a note where nothing calls one of them."""
    channels = [channel for channel, _, _ in pairs]
    _, first, second = pairs[0]
    if first.node is second.node:
        return None if first.in_source and second.in_source else Level.WARNING
    if not any(_is_called(channel, system) for channel in channels for system in systems):
        return Level.NOTE
    is_near = any(_is_called_in(channel, system) for channel in channels for system in systems)
    # other releases of a library may have other services
    return None if is_near and first.in_source and second.in_source else Level.WARNING


def _is_called_in(channel: Channel, system: System) -> bool:
    """Whether a node of *system* has a client of *channel*."""
    every = system.services if channel.kind == "service" else system.actions
    return any(other_channel.name == channel.name and other_channel.takers for other_channel in every)


def _systems_with(pairs: list[tuple[Channel, End, End]], system: System) -> list[tuple[System, SystemNode]]:
    """The systems in which the same two nodes offer the same, each with the second node: first one that has it by default."""
    if system.whole not in _SEEN:
        seen: dict[_Key, list[tuple[System, SystemNode]]] = {}
        for other_system in system.whole.systems:
            for found in _pairs(other_system).values() if not other_system.is_refused else ():
                seen.setdefault(_key(found), []).append((other_system, found[0][2].node))
        for every in seen.values():
            every.sort(key=lambda one: bool(one[1].presence) or not one[1].is_default)
        _SEEN[system.whole] = seen
    return _SEEN[system.whole].get(_key(pairs)) or [(system, pairs[0][2].node)]


def _key(pairs: list[tuple[Channel, End, End]]) -> _Key:
    """The two nodes with their programs, and what both offer."""
    _, first, second = pairs[0]
    nodes = (f"{end.node.name} {end.node.type}" for end in (first, second))
    return (*nodes, *(f"{channel.kind} {channel.name}" for channel, _, _ in pairs))


def _pairs(system: System) -> _Pairs:
    """The services and actions with two servers, by the nodes that offer them."""
    found: _Pairs = {}
    for channel in (*system.services, *system.actions):
        if len(channel.servers) < 2:
            continue
        servers = [end for end in channel.servers if not end.implicit and not end.conditions]
        if channel.kind == "action":
            servers = [end for end in servers if not _is_unstarted(end, system)]
        pair = next(((a, b) for a, b in can_meet(servers, servers) if _are_two(a, b, system)), None)
        if pair is not None and (pair[0].in_source or pair[1].in_source or _is_called(channel, system)):
            found.setdefault((pair[0].node.name, pair[1].node.name), []).append((channel, *pair))
    return found


def _is_called(channel: Channel, system: System) -> bool:
    """Whether something in the workspace has a client of *channel*, or a command that calls it: seen in a system, or written in a file.

    A client that a node of a library has by itself counts in its own system alone.
    """
    if _is_called_in(channel, system):
        return True
    known = _CALLED.setdefault(system.whole, {})
    if (channel.kind, channel.name) not in known:
        known[channel.kind, channel.name] = _calls(channel, system)
    return known[channel.kind, channel.name]


def _calls(channel: Channel, system: System) -> bool:
    for other_channel in _channels(system):
        if (
            other_channel.name == channel.name
            and other_channel.kind == channel.kind
            and any(end.in_source for end in other_channel.takers)
        ):
            return True
    if system.workspace is None:
        return False
    name = re.escape(channel.name.lstrip("/"))
    command = re.compile(rf"""(?:\bcall|\bsend_goal)["',\s]{{1,40}}(?:-\w{{1,40}}\s{{1,9}}){{0,5}}/?{name}(?![\w/])""")
    client = re.compile(
        rf"""(?:[cC]lient|ServiceProxy)\w{{0,60}}\s{{0,9}}(?:<[^;]{{0,200}}?>\s{{0,9}}\w{{0,60}}\s{{0,9}})?[({{][^;"']{{0,200}}["']/?{name}["']"""
    )
    value = re.compile(rf"""[:-][ \t]+["']?/{name}["']?[ \t]*$""", re.MULTILINE)
    for file in system.workspace.files:
        text = system.workspace.text(file.path)
        if channel.name.lstrip("/") not in text:
            continue
        if command.search(text) or (file.path.endswith((".yaml", ".yml")) and value.search(text)):
            return True
        if file.path.endswith(CODE) and file.language != "launch" and client.search(text):
            return True
    return False


def _channels(system: System) -> Iterator[Channel]:
    for other_system in system.whole.systems:
        yield from other_system.services
        yield from other_system.actions


def _are_two(one: End, other: End, system: System) -> bool:
    """Whether both exist; two nodes of one name are reported for their name instead."""
    if one.node is other.node:
        return (
            one.location != other.location
            and _OF_LIBRARIES.isdisjoint((one.type, other.type))
            and not any(_is_destroyed(end, system) for end in (one, other))
        )
    return one.node.name != other.node.name


def _is_destroyed(end: End, system: System) -> bool:
    """Whether the code around *end* ends the server again: by its variable, or by one that is not known."""
    if system.workspace is None or not end.in_source:
        return False
    text = system.workspace.text(end.location.path)
    kept = _KEPT.search(_statement(text.splitlines()[: end.location.line], end.location.column))
    ended = {match[1] for match in _DESTROYED.finditer(text) if not match[2]}
    if kept is None:  # it may be in a list, which a loop goes over
        return any(match[2] or "." not in match[1] for match in _DESTROYED.finditer(text))
    name = kept[1]
    last = name.rpartition(".")[2]
    if name in ended:
        return True
    if end.location.path.endswith(".py"):
        return end.node.ros == 1 and re.search(rf"{re.escape(name)}\.shutdown\s*\(", text) is not None
    ends = rf"\b{re.escape(last)}\s*(?:\.\s*(?:reset|shutdown)\s*\(\s*\)|=\s*nullptr)"
    again = rf"\b{re.escape(last)}\s*=[^=;]{{0,80}}create_service"
    return re.search(ends, text) is not None or (end.node.ros == 2 and len(re.findall(again, text)) > 1)


def _is_unstarted(end: End, system: System) -> bool:
    """Whether *end* is an action server of ROS 1 that waits for a start(), and its file starts none of the names beside it."""
    if end.node.ros != 1 or not end.in_source or not end.location.line:
        return False
    text = _text(end, system)
    lines, line = text.splitlines(), end.location.line
    column = max((end.location.column or 1) - 1, 0)
    made = _call("\n".join(lines[line - 1 : line - 1 + 2 * _LINES])[column:])
    if _WAITING.search(made) is None:
        return False
    member = re.match(r"(?!new\b|make_|actionlib\b|Simple|Action)(\w+)\s*[({]", made)
    beside = member[1] if member else "\n".join(lines[max(line - 2, 0) : line])
    return not any(re.search(rf"\b{name}\b", beside) for name in {match[1] for match in _STARTED.finditer(text)})


def _call(text: str) -> str:
    """*text* up to the end of the first brackets in it."""
    depth = 0
    for bracket in re.finditer(r"[({})]", text):
        depth += 1 if bracket[0] in "({" else -1
        if depth == 0:
            return text[: bracket.end()]
    return text


def _statement(lines: list[str], column: int | None) -> str:
    """The text before the call in the last of *lines*, with the lines before it where it begins its own."""
    last = lines[-1] if lines else ""
    call = re.search(r"(?<![\w.>-])[\w.>-]*\b(?:create_service|advertiseService|Service)\b", last)
    before = last[: column - 1] if column else last[: call.start()] if call is not None else ""
    return before if before.strip() else "\n".join((*lines[-3:-1], before))


def _is_addressed(first: End, second: End, system: System) -> bool:
    """Whether the code of both servers looks whom a request is for."""
    return all(end.in_source and _ADDRESSED.search(_text(end, system)) is not None for end in (first, second))


def _is_absolute(end: End, system: System) -> bool:
    """Whether the code around *end* has its name with a slash before it: no namespace changes that."""
    lines = _text(end, system).splitlines()[(end.location.line or 1) - 1 :][:_LINES] if end.in_source else []
    return re.search(rf"[\"']{re.escape(end.original_name)}[\"']", "\n".join(lines)) is not None


def _text(end: End, system: System) -> str:
    return system.workspace.text(end.location.path) if system.workspace is not None else ""


def _finding(
    found: list[tuple[Channel, End, End]], likewise: list[SystemNode], level: Level | None, system: System
) -> Finding:
    channel, first, second = found[0]
    if second.node.ros == 1 and channel.kind == "service":
        effect = "the server that registers later takes over, and the other one gets no calls"
    elif channel.kind == "action":
        effect = "both get every goal, and a client sees the answers of both"
    elif _is_addressed(first, second, system):
        effect = "both get each request, and the client takes the first answer, which may be that of the one that it is not for"
    else:
        effect = "both execute each request, and the client takes the first answer"
    is_twice = first.node is not second.node and first.node.type == second.node.type and second.node.is_launched
    whose = f"{first.node} and {second.node}" if first.node is not second.node else f"two places of {first.node}"
    more = f" and {len(found) - 1} more" if len(found) > 1 else ""
    namespaces = "give it a relative name and start them in" if _is_absolute(second, system) else "start them in"
    advice = f"; remap it for one of them, or {namespaces} different namespaces"
    if not is_twice:
        advice = (
            "; give one of them another name, or start one of them alone"
            if first.node is not second.node
            else "; keep one of them"
        )
    return Finding(
        at=second.node.location if is_twice else named_at(second),
        message=f"{whose} offer the {channel.kind} {channel}{more}: {effect}{advice}",
        about=tuple(part for item in found for part in item),
        related=(
            *((end.location, f"{end.word} {end.name}") for _, one, two in found for end in (one, two)),
            *((node.location, f"{node} is started beside {first.node} here, too") for node in likewise),
        ),
        flow=way_to(second),
        level=level,
    )


CHECK = Check(
    id="several-servers",
    summary="Service or action with several servers.",
    level=Level.ERROR,
    catalogue="G10",
    tags=("services", "actions"),
    run=check,
)
