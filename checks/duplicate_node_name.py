# SPDX-License-Identifier: Apache-2.0
"""Two nodes of one system, or of one process, under the same full name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System, SystemNode, line_of, listed, regex, together

#: Programs of ROS 2 that do one thing and end: nobody sets their parameters or calls their services.
_ENDING = {
    "controller_manager": r"(?:un)?spawner(?:\.py)?|hardware_spawner|spawner_.*",
    "gazebo_ros": r"spawn_entity(?:\.py)?",
    "ros_gz_sim": r"create|remove",
    "ros_ign_gazebo": r"create",
    "nav2_map_server": r"map_saver_cli",
}
#: Ends of a program that calls a service or an action, and has nothing that others would reach under its name.
_ASKING = frozenset(("clients", "action_clients"))
#: Ends of a node that only has parameters.
_OF_PARAMETERS = frozenset(("parameters", "getters", "setters"))
#: What `ros2 bag record` runs as: nobody talks to a recorder by its name.
_RECORDER = "ros2bag/record"
_PARAMETER_FILE = (".yaml", ".yml")
_KEY = regex(r"([ \t]*)([\"']?)([^\s\"'#:][^\"'#:]{0,200})\2[ \t]*:")


def check(system: System) -> Iterator[Finding]:
    by_name: dict[str, list[SystemNode]] = {}
    for node in system.nodes if system.is_launched else ():
        if node.known and node.is_launched and not node.raw.conditions and not _ends(node):
            by_name.setdefault(node.name, []).append(node)
    twice: dict[str, list[tuple[SystemNode, SystemNode]]] = {}
    for nodes in by_name.values():
        pair = _pair(nodes)
        if pair is not None and pair[0].location == pair[1].location:
            twice.setdefault(pair[0].location.path, []).append(pair)
        elif pair is not None:
            yield _finding(*pair, is_one=len(system.launch) == 1, section=_shared_section(system, nodes))
    for (first, second), *others in twice.values():
        also = tuple(other.name for other, _ in others)
        yield _finding(first, second, is_one=len(system.launch) == 1, also=also)
    for node in system.nodes:
        if len(node.raw.twins) == 2:
            yield _of_one_process(node, *node.raw.twins)


def _ends(node: SystemNode) -> bool:
    """Whether the program ends at once, or does nothing but ask others. roslaunch of ROS 1 refuses two of one name all the same."""
    package, _, program = node.type.partition("/")
    if node.ros == 2 and package in _ENDING and re.fullmatch(_ENDING[package], program) is not None:
        return True
    own = [end.raw.kind for end in node.ends if not end.raw.implicit]
    return node.ros == 2 and node.complete and not node.given and bool(own) and _ASKING.issuperset(own)


def _pair(nodes: list[SystemNode]) -> tuple[SystemNode, SystemNode] | None:
    """The first two that can be there at the same time."""
    for number, second in enumerate(nodes):
        for first in nodes[:number]:
            if first.location == second.location and first.presence != second.presence:
                continue  # one tag under other arguments
            if together(first.presence, second.presence) is not None:
                return first, second
    return None


def _shared_section(system: System, nodes: list[SystemNode]) -> tuple[str, str]:
    """The section of a parameter file, and the file, that each of *nodes* (ROS 2) is given by their name; two empty texts if there is none."""
    if system.workspace is None or any(node.ros != 2 for node in nodes):
        return "", ""
    tags: dict[Location, set[Location]] = {}
    sections: dict[str, list[str]] = {}
    for given in nodes[0].given:  # nodes of one name have all that is given to any of them
        at = given.at
        if given.raw.origin is None or not at.path.endswith(_PARAMETER_FILE):
            continue
        tags.setdefault(at, set()).add(given.tag)
        if len(tags[at]) == len(nodes):
            if at.path not in sections:
                sections[at.path] = _sections(system.workspace.text(at.path))
            line = (at.line or 0) - 1
            section = sections[at.path][line] if 0 <= line < len(sections[at.path]) else ""
            if section and "*" not in section:
                return section, at.path
    return "", ""


def _sections(text: str) -> list[str]:
    """For each line of a parameter file the name of the node whose parameters stand there: what ``ros__parameters`` is below; "" where it is not seen."""
    found = []
    above: list[tuple[int, str]] = []
    section, width = "", -1
    for line in text.splitlines():
        key = _KEY.match(line)
        if key is not None:
            indent = len(key[1])
            while above and above[-1][0] >= indent:
                above.pop()
            if indent <= width:
                section, width = "", -1
            if key[3].rstrip() == "ros__parameters":
                section, width = (above[-1][1] if above else ""), indent
            above.append((indent, key[3].rstrip()))
        found.append(section)
    return found


def _has_parameters_alone(node: SystemNode) -> bool:
    return node.complete and all(end.raw.implicit or end.raw.kind in _OF_PARAMETERS for end in node.ends)


def _finding(
    first: SystemNode,
    second: SystemNode,
    *,
    is_one: bool,
    also: tuple[str, ...] = (),
    section: tuple[str, str] = ("", ""),
) -> Finding:
    """The finding about both; *is_one* if one roslaunch starts them: it looks at names before it starts anything (add_node).

    *also* are further names that the same launch file has given twice, as it is included twice. *section* is the one of a parameter file, and the
    file, from which both have their parameters by this name. It is a note where they have nothing else.
    """
    if second.ros == 1 and not is_one:
        effect = "the node that starts later shuts the other one down"
    elif second.ros == 1:
        effect = 'roslaunch refuses to start ("multiple nodes named")'
    else:
        effect = "their parameters and services have the same names"
    kinds = f" ({first.type} and {second.type})" if first.type != second.type else f" ({first.type})"
    if first.location == second.location:
        is_code = first.location.path.endswith(".py")
        other = "the same call starts both" if is_code else f"{first.location.path} is included twice"
        other += f", so that there are two {listed(also)}, too" if also else ""
    else:
        other = f"the other node is at {line_of(first.location)}"
    todo = "give one of them another name or namespace"
    if section[0]:
        todo = f"both have parameters of the section {section[0]} of {section[1]}: give one of them another name, and a section of that name there (or call the section /**)"
    is_meant = bool(section[0]) and _has_parameters_alone(first) and _has_parameters_alone(second)
    return Finding(
        at=second.location,
        message=f"two nodes are named {second.name}{kinds}: {effect}; {todo}; {other}",
        about=(first, second),
        related=((first.location, f"the other {first.name}"),),
        level=Level.ERROR
        if second.ros == 1
        else Level.NOTE
        if is_meant or first.type == second.type == _RECORDER
        else None,
    )


def _of_one_process(node: SystemNode, first: Location, second: Location) -> Finding:
    return Finding(
        at=second,
        message=f"{node.type} makes two nodes named {node.name} in one process: their parameters and services have the same "
        f"names; give one of them another name or namespace; the other node is made at {line_of(first)}",
        about=(node,),
        related=((first, f"the other {node.name}"),),
    )


CHECK = Check(
    id="duplicate-node-name",
    summary="Two nodes with the same name.",
    level=Level.WARNING,
    catalogue="G12",
    tags=("nodes",),
    run=check,
)
