# SPDX-License-Identifier: Apache-2.0
"""A policy of SROS2 (version 0.2.0) from what the nodes of a configuration do.

A process has one enclave: the one that its arguments name, else one called like the process, and in it a profile for each of
its nodes. Names are written as ``ros2 security generate_policy`` writes them: a node's own with ``~``, those of its namespace
relative, others in full. Lists and entries are sorted, so that the same system gives the same text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape, quoteattr

from haros_ci.model.architecture import Node
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.security.enclaves import enclave_of
from haros_ci.security.permissions import ENDS, LISTS

VERSION = "0.2.0"
#: A name that can stand in a policy: no pattern, and nothing that XML or a terminal takes for something else.
_NAME = regex(r"/[^\s*?\[\]#]*")
#: What each node takes besides what the model has: time sources listen to /clock and /parameter_events (rclcpp, rclpy).
LISTENS = ("/clock", "/parameter_events")


@dataclass(frozen=True, slots=True)
class Written:
    """The *text* of a policy, and what it does not allow because it is not known, one line each."""

    text: str
    gaps: tuple[str, ...]


def policy_of(nodes: Iterable[Node]) -> Written | None:
    """The policy of *nodes* of ROS 2; None if there are none with a known name."""
    gaps: list[str] = []
    enclaves: dict[str, dict[str, list[Node]]] = {}
    selected = [node for node in nodes if node.ros == 2 and node.kind != "library"]
    by_process = {
        node.process: path for node in selected if (path := enclave_of(node)) is not None and node.process is not None
    }
    for node in selected:
        process = node.process or node.name
        path = by_process.get(process, process)
        if "?" not in node.name + path and not (_is_plain(node.name) and _is_plain(path)):
            gaps.append(f"{node.name}: ROS 2 takes no such name, so it has no profile")
            continue
        if "?" in node.name or "?" in path:
            gaps.append(f"{node.package}/{node.type}: the name of its node is not known, so it has no profile")
            continue
        enclaves.setdefault(path, {}).setdefault(node.name, []).append(node)
    if not enclaves:
        return None
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', f'<policy version="{VERSION}">', "  <enclaves>"]
    for path in sorted(enclaves):
        lines += [f"    <enclave path={quoteattr(path)}>", "      <profiles>"]
        for name in sorted(enclaves[path]):
            lines += _profile(name, enclaves[path][name], gaps)
        lines += ["      </profiles>", "    </enclave>"]
    return Written("\n".join((*lines, "  </enclaves>", "</policy>", "")), tuple(dict.fromkeys(gaps)))


def _profile(name: str, nodes: list[Node], gaps: list[str]) -> Iterator[str]:
    """The profile of the node called *name*; several *nodes* of one name are alternatives, all of which are allowed."""
    space, _, own = name.rpartition("/")
    names: dict[str, set[str]] = {kind: set() for kind in ENDS.values()}
    for node in nodes:
        if any(unknown.field == "endpoints" for unknown in node.unknowns) or not node.endpoints:
            gaps.append(f"{name}: not all that it publishes, subscribes to, serves and calls is known")
        for end in node.endpoints:
            if end.kind in names and "?" in end.name:
                gaps.append(f"{name}: it has {_WORDS[end.kind]} whose name is not known ({end.name})")
            elif end.kind in names and not _is_plain(end.name):
                gaps.append(f"{name}: it has {_WORDS[end.kind]} with a name that ROS 2 does not take ({end.name})")
            elif end.kind in names:
                names[end.kind].add(end.name)
    names["subscribers"].update(LISTENS)
    yield f"        <profile ns={quoteattr(space or '/')} node={quoteattr(own)}>"
    for rows, (word, verbs) in LISTS.items():
        for verb in verbs:
            entries = sorted(_relative(item, name, space) for item in names[ENDS[verb]])
            if entries:
                yield f'          <{rows} {verb}="ALLOW">'
                yield from (f"            <{word}>{escape(entry)}</{word}>" for entry in entries)
                yield f"          </{rows}>"
    yield "        </profile>"


_WORDS = {
    "publishers": "a publisher",
    "subscribers": "a subscriber",
    "servers": "a service",
    "clients": "a service client",
    "action_servers": "an action server",
    "action_clients": "an action client",
}


def _is_plain(name: str) -> bool:
    return _NAME.fullmatch(name) is not None and name.isprintable()


def _relative(name: str, node: str, space: str) -> str:
    """*name* as it is written in the profile of *node* in the namespace *space* ("" for the root)."""
    if name.startswith(f"{node}/"):
        return "~" + name[len(node) :]
    return name[len(space) + 1 :] if name.startswith(f"{space}/") else name
