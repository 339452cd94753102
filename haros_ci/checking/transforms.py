# SPDX-License-Identifier: Apache-2.0
"""The transforms that the nodes of a system broadcast: by robot_state_publisher, static_transform_publisher and own code."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping

from haros_ci.checking.broadcasts import resolved, sent
from haros_ci.checking.poses import Pose, are_same, of_options, of_origin, of_words
from haros_ci.checking.project import Project
from haros_ci.checking.system import System, SystemNode
from haros_ci.model.launch_facts import CommandUse
from haros_ci.model.location import Location
from haros_ci.model.presence import together
from haros_ci.model.robot import Robot
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Joints that robot_state_publisher leaves out, and those that it broadcasts as fixed (kdl_parser knows no planar ones).
_LEFT_OUT = "floating"
_FIXED = ("fixed", "planar")
#: The declaration of a listener of tf.
_LISTENER = regex(
    r"\btf::(?:TransformListener|Transformer)\b[ \t]*[>*&]*[ \t]*(\w+)|\b(\w+)[ \t]*=[ \t]*tf\.(?:TransformListener|TransformerROS|Transformer)\b"
)
#: Packages whose node publishes a state for every joint that moves.
_STATES = ("joint_state_publisher", "joint_state_publisher_gui")


@dataclass(frozen=True, slots=True)
class Broadcast:
    """*node* says where *child* is in *parent* (None if not known), at *at* in words *what*, on the tf topic *topic*.

    *values* are the same for two static ones that say the same, in one form; *pose* is that in numbers, if it is known.
    """

    child: str
    parent: str | None
    is_static: bool
    node: SystemNode
    at: Location
    what: str
    topic: str
    values: str = ""
    pose: Pose | None = None


def at_odds(one: Broadcast, other: Broadcast) -> bool:
    """Whether two nodes say where one frame is, both are there at once, and they do not say the same.

    Two nodes of one name are none: duplicate-node-name tells of them.
    """
    if one.node is other.node or (one.node.known and one.node.name == other.node.name):
        return False
    if together(one.node.presence, other.node.presence) is None:
        return False
    first, second = one.node.raw.conditions, other.node.raw.conditions
    if first and second and first != second:
        return False
    is_said_twice = one.values == other.values or are_same(one.pose, other.pose)
    if one.parent != other.parent or one.is_static != other.is_static or not is_said_twice:
        return True
    # a static publisher of tf sends the same again and again; of code that is not static the values are those of a moment
    return not one.is_static and not (_origin(one.node) == _origin(other.node) == "publisher")


def called(node: SystemNode) -> str:
    """The name of *node*, for a message; of one that gets another name at each start (``/?``), its program in words."""
    if "?" not in node.name:
        return str(node)
    return f"{'an' if node.raw.type[:1] in 'aeiou' else 'a'} {node.raw.type} without a name of its own"


def origin(one: Broadcast) -> str:
    """Who knows of it: a ``publisher`` of static transforms, a ``robot`` description, or ``code``."""
    return _origin(one.node)


def _origin(node: SystemNode) -> str:
    program, package = node.raw.type, node.package
    if program == "static_transform_publisher" and package in ("tf", "tf2_ros"):
        return "publisher"
    if program in ("robot_state_publisher", "state_publisher") and package == "robot_state_publisher":
        return "robot"
    return "code"


def broadcasts(project: Project, system: System) -> Iterator[Broadcast]:
    """All that is known to be broadcast in *system* with its default arguments."""
    for node in system.nodes:
        if not node.is_default or not node.is_launched:
            continue
        kind = _origin(node)
        if kind == "publisher":
            yield from _static(node)
        elif kind == "robot":
            yield from _of_robot(project, system, node)
        else:
            yield from _of_code(project, system, node)


def _topic(node: SystemNode, name: str) -> str | None:
    """The name of tf's topic after remapping, as that of ``/tf``; None if it is not known."""
    for end in node.of("publishers"):
        if end.original_name == name:
            return end.name.removesuffix("_static") if end.known else None
    for before, after in node.raw.remaps:
        if before.rpartition("/")[2] == name[1:]:
            return after.removesuffix("_static") if "?" not in after else None
    return "/tf"


def _static(node: SystemNode) -> Iterator[Broadcast]:
    """static_transform_publisher: eight or nine arguments (tf: and a period), or ``--frame-id a --child-frame-id b``."""
    try:
        words = shlex.split(node.raw.arguments)
    except ValueError:
        return
    named = dict(zip(words, words[1:]))
    if "--frame-id" in named or "--child-frame-id" in named:
        parent, child = named.get("--frame-id", ""), named.get("--child-frame-id", "")
        values = " ".join(sorted(f"{k} {v}" for k, v in named.items() if k.startswith("--")))
        pose = of_options(named)
    else:
        if node.package == "tf":
            words = words[:-1]
        if len(words) not in (8, 9):
            return
        parent, child = words[-2:]
        values = " ".join(words)
        pose = of_words(words[:-2])
    topic = _topic(node, "/tf" if node.package == "tf" else "/tf_static")
    if topic is None or not child or "?" in parent + child:
        return
    if parent != child and parent.lstrip("/") == child.lstrip("/"):
        return  # kept apart by a tf_prefix in tf, and nothing at all in tf2
    is_static = node.package == "tf2_ros"
    yield Broadcast(
        child.lstrip("/"),
        parent.lstrip("/"),
        is_static,
        node,
        node.location,
        f"{called(node)} publishes it",
        topic,
        values,
        pose,
    )


def _of_robot(project: Project, system: System, node: SystemNode) -> Iterator[Broadcast]:
    """robot_state_publisher: every joint of the robot but the floating ones, and those that move where nobody is seen to send the states of all."""
    robot = robot_of(project, system, node)
    prefix = _prefix(system, node)
    static, dynamic = _topic(node, "/tf_static"), _topic(node, "/tf")
    if robot is None or prefix is None or static is None or dynamic is None:
        return
    moves = _is_sent_all_states(system, node)
    for joint in robot.joints:
        if not (joint.type in _FIXED or moves):
            continue
        if joint.certain and joint.child and joint.parent and joint.type and joint.type != _LEFT_OUT:
            is_static = joint.type in _FIXED
            yield Broadcast(
                (prefix + joint.child).strip("/"),
                (prefix + joint.parent).strip("/"),
                is_static,
                node,
                joint.location,
                f"{node} publishes the {joint.type} joint {joint.name}",
                static if is_static else dynamic,
                f"joint {joint.name}",
                of_origin(*joint.origin) if joint.type == "fixed" else None,
            )


def _is_sent_all_states(system: System, node: SystemNode) -> bool:
    """Whether joint_state_publisher publishes where robot_state_publisher *node* listens, which sends no joint of which it has heard no state.

    Of other nodes, controllers and simulators nobody knows here which joints they publish.
    """
    heard = {end.name for end in node.of("subscribers") if end.original_name.rpartition("/")[2] == "joint_states"}
    return any(
        end.name in heard
        for other in system.nodes
        if other.package in _STATES and other.is_default
        for end in other.of("publishers")
    )


def _prefix(system: System, node: SystemNode) -> str | None:
    """What robot_state_publisher puts before all names; None if that is not known."""
    found = ""
    around = node.name.split("/")
    above = {f"{'/'.join(around[:count])}/tf_prefix" for count in range(1, len(around) + 1)}
    for name, places in (("frame_prefix", {f"{node.name}:frame_prefix"}), ("tf_prefix", above)):
        for parameter in system.parameters:
            if parameter.name in places:
                if not isinstance(parameter.value, str) or parameter.unknowns:
                    return None
                found = parameter.value if name == "frame_prefix" else f"{parameter.value.rstrip('/')}/".lstrip("/")
    return found


def robot_of(project: Project, system: System, node: SystemNode) -> Robot | None:
    """The robot that robot_state_publisher *node* gets; None if it is not known."""
    names = {f"{node.name}:robot_description"}
    names |= {end.name for end in node.of("getters", "parameters") if end.name.endswith("robot_description")}
    parameters = [parameter for parameter in system.parameters if parameter.name in names]
    if len(parameters) != 1:
        return None
    parameter = parameters[0]
    if isinstance(parameter.value, str) and "<robot" in parameter.value:
        texts = (
            description.robot
            for description in project.descriptions
            if project.text(description.robot.path) == parameter.value
        )
        return next(texts, None)
    reasons = " ".join(unknown.reason for unknown in parameter.unknowns)
    commands = {
        use.text
        for use in system.facts(CommandUse)
        if (use.location == parameter.location if use.ros == 1 else _shown(use.text) in reasons)
    }
    described = (
        project.described(commands.pop()) if len(commands) == 1 else None
    )  # one launch file may be included twice
    return None if described is None else described.robot


def _shown(text: str) -> str:
    """A command as a reason quotes it, whole."""
    line = " ".join(text.split())
    return f"'{line if len(line) <= 100 else line[:97] + '...'}'"


def _of_code(project: Project, system: System, node: SystemNode) -> Iterator[Broadcast]:
    """A node of the workspace: what the class that makes its broadcaster, or the file, sends."""
    ends = [end for end in node.of("publishers") if end.original_name in ("/tf", "/tf_static") and end.in_source]
    if not ends or not node.complete:
        return
    kinds = {end.original_name for end in ends}
    parameters = _parameters(system, node)
    for path in dict.fromkeys(end.location.path for end in ends):
        program = project.programs.get(path)
        for other_sent in sent(program) if program is not None and project.has_word(path, "sendTransform") else ():
            is_static = "static" in other_sent.receiver.lower() if len(kinds) == 2 else kinds == {"/tf_static"}
            child = resolved(other_sent.child, parameters)
            topic = _topic(node, "/tf_static" if is_static else "/tf")
            if child is not None and topic is not None:
                at = Location(path, other_sent.line, other_sent.column)
                yield Broadcast(
                    child, resolved(other_sent.parent, parameters), is_static, node, at, f"{node} sends it", topic
                )


def _parameters(system: System, node: SystemNode) -> Mapping[str, str]:
    """The parameters of *node* whose values are known texts."""
    found: dict[str, str] = {}
    outside = {parameter.name: parameter for parameter in system.parameters}
    for end in node.of("parameters", "getters"):
        key = end.name.rpartition(":")[2].rpartition("/")[2] if node.ros == 1 else end.name.rpartition(":")[2]
        set_parameter = outside.get(end.name)
        value = (
            end.raw.effective
            if end.kind == "parameters"
            else end.raw.value
            if set_parameter is None
            else set_parameter.value
        )
        if isinstance(value, str) and not end.raw.unknowns and (set_parameter is None or not set_parameter.unknowns):
            found[key] = value
    return found


def listeners_of_tf(package: str, system: System) -> frozenset[str]:
    """The variables of a *package* of ROS 1 that are listeners of tf, and not of tf2."""
    workspace = system.workspace
    if workspace is None:
        return frozenset()
    own = (file.path for file in workspace.files if file.package == package and file.language in ("cpp", "python"))
    texts = (text for text in map(workspace.text, own) if "Transform" in text)
    return frozenset(found[1] or found[2] for text in texts for found in _LISTENER.finditer(text))
